//! A line of the ply after one step: its fabric, the way between its ends, and its force.

use super::Site;
use crate::geometry::Point;

/// Length, as a share of the whole line, up to which slack and overstretch are rounding. 1e-12: sums of arc lengths keep some thirteen
/// digits.
const LENGTH_ROUNDING: f64 = 1e-12;

/// A line between two points of the ply, or a segment of one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineState {
    /// Which line it is, or where in the fabric it has its middle.
    pub site: Site,
    /// Index of the catenary that it is a segment of; `None` where no catenary hangs.
    pub catenary: Option<usize>,
    /// Whether it runs along a fiber; a diagonal does not.
    pub is_fiber: bool,
    /// Middle of its ends (m).
    pub place: Point,
    /// Fabric length (m).
    pub length: f64,
    /// Fabric length of the whole line that it is a segment of (m).
    pub whole: f64,
    /// Taut way between its ends (m), negative where a gripper has passed the end of what is in contact.
    pub path: f64,
    /// Force along it (N); of a catenary the horizontal part. `None` where the model gives none.
    pub force: Option<f64>,
    /// Whether it hangs from gripper to gripper.
    pub hangs: bool,
    /// Whether it lies on the mold.
    pub lies: bool,
    /// How deep it hangs below its chord, as a share of its horizontal run; `None` unless the model gives it a shape.
    pub sag: Option<f64>,
    /// The steepest that it leaves an end against its chord, rise over run; `None` unless the model gives it a shape.
    pub slope: Option<f64>,
    /// Gap between the ply and the mold where it spans a hollow between two touches (m); `None` if it spans none.
    pub bridge: Option<(f64, Point)>,
    /// Angle between what has landed of it, from end to end, and the same fabric in the ideal drape (rad); `None` if unknown.
    pub fiber_angle: Option<f64>,
}

impl LineState {
    /// Fabric length beyond the path (m), not negative.
    #[must_use]
    pub fn slack(&self) -> f64 {
        excess(self.length - self.path, self.whole)
    }

    /// Path beyond the fabric length (m), not negative.
    #[must_use]
    pub fn overstretch(&self) -> f64 {
        excess(self.path - self.length, self.whole)
    }
}

/// An excess of length (m) in a line of length `whole` (m): zero where it is negative or rounding; NaN stays NaN.
#[must_use]
pub fn excess(excess: f64, whole: f64) -> f64 {
    if excess <= LENGTH_ROUNDING * whole { 0.0 } else { excess }
}
