//! The tuning constants of clearances. None is a length.

/// Resolutions of clearances.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ClearanceTuning {
    /// By how much two bodies may come nearer between two samples than is reported, as a share of what is reported, or of
    /// the limit where that is more. A hundredth is 0.05 mm of 5 mm: less than a gripper repeats its place.
    pub resolution: f64,
    /// By how much two bodies may be nearer at a sample than is reported, as a share of that resolution: far below what is printed.
    pub sampled: f64,
    /// Parts of a motion between whose ends the first distances are taken; they only help to drop what is farther.
    pub first: usize,
    /// Times that an interval is halved at most: 2⁻³⁰ of a step is less than any resolution needs.
    pub halvings: u32,
    /// Parts of a body's surface that are divided at most for one distance from the mold: a cylinder takes some ten.
    pub patches: usize,
    /// Reach of a part of a body's surface, as a share of its distance from the mold, to which it is divided farther from the mold than
    /// the radius of its hollows, and as a share of the body's own for the depth in a mold of triangles.
    pub far: f64,
}

/// The constants in use.
pub(super) const TUNING: ClearanceTuning = ClearanceTuning {
    resolution: 0.01,
    sampled: 1e-3,
    first: 8,
    halvings: 30,
    patches: 200_000,
    far: 0.05,
};
