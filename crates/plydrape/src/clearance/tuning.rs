//! The tuning constants of clearances. None is a length.

/// Resolutions of clearances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Tuning {
    /// By how much two bodies may come nearer between two samples than is reported, as a share of what is reported, or of
    /// the limit where that is more. A hundredth is 0.05 mm of 5 mm: less than a gripper repeats its place.
    pub resolution: f64,
    /// Times that an interval is halved at most: 2⁻³⁰ of a step is less than any resolution needs.
    pub halvings: u32,
    /// Parts of a body's surface that are evaluated at most for one distance from the mold: a cylinder takes some hundred.
    pub patches: usize,
    /// Size of a part of a body's surface, as a share of its distance from the mold, up to which it is divided where the
    /// mold's distance is no exact one; only far from the mold is it none.
    pub far: f64,
}

/// The constants in use.
pub(super) const TUNING: Tuning =
    Tuning { resolution: 0.01, halvings: 30, patches: 200_000, far: 0.05 };
