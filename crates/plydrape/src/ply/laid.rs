//! What the mold has caught of a catenary.

/// The contact segment of a catenary: fixed in space and in fabric arc length.
///
/// What is left free are two rests, each a span of its own: from the first gripper to the segment, and
/// from the segment to the second gripper.
#[derive(Debug, Clone, PartialEq)]
pub struct Laid {
    /// Length of the catenary (m); from the first touch on it no longer follows the shear.
    pub length: f64,
    /// Fabric arc length of the segment's ends from the first gripper (m).
    pub arc: [f64; 2],
    /// Place of the segment's ends (m).
    pub point: [[f64; 3]; 2],
    /// Unit normal of the mold there.
    pub normal: [[f64; 3]; 2],
    /// Whether each rest has lain down whole: it is no span any more.
    pub lying: [bool; 2],
}

/// Rests shorter than this share of their catenary are nothing.
const NOTHING: f64 = 1e-9;

impl Laid {
    /// Free fabric length of the first (0) or second (1) rest (m).
    #[must_use]
    pub fn rest(&self, which: usize) -> f64 {
        if which == 0 { self.arc[0] } else { self.length - self.arc[1] }
    }

    /// Whether the catenary lies from gripper to gripper, without a segment of its own.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.lying == [true, true] && self.arc == [0.0, self.length]
    }

    /// Whether a rest hangs: it has a length and has not lain down.
    #[must_use]
    pub fn hangs(&self, which: usize) -> bool {
        !self.lying[which] && self.rest(which) > NOTHING * self.length
    }
}
