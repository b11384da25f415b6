//! What the mold has caught of a catenary.

use crate::mold::SurfaceCurve;
use crate::mold::vector::{dot, sub};

/// The contact segment of a catenary: fixed in space and in fabric arc length.
///
/// What is left free are two rests, each a span of its own: from the first gripper to the segment, and
/// from the segment to the second gripper.
#[derive(Debug, Clone, PartialEq)]
pub struct Laid {
    /// Length of the catenary (m); from the first touch on it no longer follows the shear.
    pub length: f64,
    /// The segment's line on the mold; fabric arc lengths from the first gripper (m).
    pub line: SurfaceCurve,
    /// Unit normal of the mold at the segment's ends.
    pub normal: [[f64; 3]; 2],
    /// Whether each rest has lain down whole: it is no span any more.
    pub lying: [bool; 2],
    /// By how much the way along the mold is longer than straight to the gripper, for each rest that has
    /// lain down (m).
    pub arch: [f64; 2],
    /// Unit tangents of the mold out of the segment, at its two ends.
    pub outward: [[f64; 3]; 2],
    /// Of a diagonal, how its cell landed.
    pub landed: Option<LandedCell>,
}

/// A cell at the moment when one of its diagonals landed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LandedCell {
    /// Its shear angle γ (rad), positive where the rising diagonal is the longer one.
    pub shear: f64,
    /// By how much the mold's curvature scales its diagonals, [`crate::ply::shear::curved_scale`].
    pub scale: f64,
}

/// Rests shorter than this share of their catenary are nothing.
const NOTHING: f64 = 1e-9;

/// Way of a rest, as a share of its fabric, below which it is a fold. At one half a catenary sags by four fifths of its run, three times as
/// far as small-sag theory holds.
const SMALL_SAG: f64 = 0.5;

impl Laid {
    /// Fabric arc length of the segment's ends from the first gripper (m).
    #[must_use]
    pub fn arc(&self) -> [f64; 2] {
        [self.line.arc[0], self.line.arc[self.line.arc.len() - 1]]
    }

    /// Place of the segment's ends (m).
    #[must_use]
    pub fn point(&self) -> [[f64; 3]; 2] {
        [self.line.points[0], self.line.end()]
    }

    /// The piece of the segment's line at its first (0) or second (1) end, from first to last (m).
    #[must_use]
    pub fn end_piece(&self, end: usize) -> [[f64; 3]; 2] {
        let points = &self.line.points;
        let last = points.len() - 1;
        if end == 0 {
            [points[0], points[last.min(1)]]
        } else {
            [points[last.saturating_sub(1)], points[last]]
        }
    }

    /// Free fabric length of the first (0) or second (1) rest (m).
    #[must_use]
    pub fn rest(&self, which: usize) -> f64 {
        let [from, to] = self.arc();
        if which == 0 { from } else { self.length - to }
    }

    /// Whether the catenary lies from gripper to gripper, without a segment of its own.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.lying == [true, true] && self.arc() == [0.0, self.length]
    }

    /// Way (m) from an end of the segment to a point: √(x² + y²) ahead of the end, y + x behind it, x along the outward tangent
    /// of the mold and y across it.
    ///
    /// Behind the end, on the mold, it is minus the distance: a gripper there has folded the fabric back.
    #[must_use]
    pub fn way(&self, which: usize, point: [f64; 3]) -> f64 {
        let way = sub(point, self.point()[which]);
        let (along, square) = (dot(way, self.outward[which]), dot(way, way));
        if along >= 0.0 {
            return square.sqrt();
        }
        (square - along * along).max(0.0).sqrt() + along
    }

    /// Whether a point is behind an end of the segment, over what is in contact.
    #[must_use]
    pub fn is_behind(&self, which: usize, point: [f64; 3]) -> bool {
        dot(sub(point, self.point()[which]), self.outward[which]) < 0.0
    }

    /// Whether a rest is a fold, not stretched and without a catenary: its gripper, at `point` (m), has passed the end of the
    /// segment, or is so near to it that no curve of small sag is as long as the fabric between them.
    #[must_use]
    pub fn is_folded(&self, which: usize, point: [f64; 3]) -> bool {
        let (way, length) = (self.way(which, point), self.rest(which));
        way < length && (self.is_behind(which, point) || way < SMALL_SAG * length)
    }

    /// Whether a rest hangs: it has a length and has not lain down.
    #[must_use]
    pub fn hangs(&self, which: usize) -> bool {
        !self.lying[which] && self.rest(which) > NOTHING * self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ahead of the end the way is the distance, also at a right angle; on the mold behind it, minus the distance.
    /// It is continuous where the two meet.
    #[test]
    fn the_way_has_the_sign_of_the_side_that_the_gripper_is_on() {
        let line = SurfaceCurve { points: vec![[1.0, 2.0, 0.0]; 2], arc: vec![0.02, 0.08] };
        let outward = [[-0.6, -0.8, 0.0], [0.6, 0.8, 0.0]];
        let laid = Laid {
            length: 0.1,
            line,
            normal: [[0.0, 0.0, 1.0]; 2],
            lying: [false; 2],
            arch: [0.0; 2],
            outward,
            landed: None,
        };
        let place = |along: f64, up: f64| [1.0 + 0.6 * along, 2.0 + 0.8 * along, up];
        for (which, sense) in [(0, -1.0), (1, 1.0)] {
            let way = |along: f64, up: f64| laid.way(which, place(sense * along, up));
            assert!((way(0.03, 0.04) - 0.05).abs() < 1e-15);
            assert!((way(-0.03, 0.0) + 0.03).abs() < 1e-15);
            assert!((way(0.0, 0.04) - 0.04).abs() < 1e-15);
            assert!((way(-1e-9, 0.04) - way(1e-9, 0.04)).abs() < 2e-9);
            // 20 mm of fabric: behind is a fold, and so is 5 mm ahead; 15 mm ahead hangs, 30 mm ahead or above is stretched
            let folded = |along: f64, up: f64| laid.is_folded(which, place(sense * along, up));
            assert!(folded(-0.03, 0.0) && folded(-0.01, 0.0) && folded(0.005, 0.0));
            assert!(!folded(0.015, 0.0) && !folded(0.03, 0.0) && !folded(-0.001, 0.03));
        }
    }
}
