//! The part of a catenary that is in contact with the mold.

use super::tuning::TUNING;
use crate::geometry::vector::{dot, sub};
use crate::mold::SurfaceCurve;

/// The contact segment of a catenary: fixed in space and in fabric arc length.
///
/// Two free segments remain, each a span of its own: from the first gripper to the contact segment, and
/// from the contact segment to the second gripper.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSegment {
    /// Length of the catenary (m); from the first touch on it no longer follows the shear.
    pub length: f64,
    /// The segment's line on the mold; fabric arc lengths from the first gripper (m).
    pub line: SurfaceCurve,
    /// Unit normal of the mold at the segment's ends.
    pub normal: [[f64; 3]; 2],
    /// Whether each free segment has come to lie on the mold over its whole length: then it is no span any more.
    pub lying: [bool; 2],
    /// Excess of the path along the mold over the straight distance to the gripper (m), for each free segment that
    /// lies on the mold.
    pub excess_length: [f64; 2],
    /// Unit tangents of the mold out of the segment, at its two ends.
    pub outward: [[f64; 3]; 2],
    /// Of a diagonal, how its cell landed.
    pub landed: Option<LandedCell>,
}

/// A cell at the moment when one of its diagonals landed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LandedCell {
    /// Shear angle γ (rad), positive where the rising diagonal is the longer one.
    pub shear: f64,
    /// By how much the mold's curvature scales its diagonals, [`crate::ply::shear::curved_scale`].
    pub scale: f64,
}

impl ContactSegment {
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

    /// Fabric length of the first (0) or second (1) free segment (m).
    #[must_use]
    pub fn free_length(&self, which: usize) -> f64 {
        let [from, to] = self.arc();
        if which == 0 { from } else { self.length - to }
    }

    /// Whether the catenary lies from gripper to gripper, without a segment of its own.
    #[must_use]
    pub fn is_whole(&self) -> bool {
        self.lying == [true, true] && self.arc() == [0.0, self.length]
    }

    /// Taut path (m) from an end of the segment to a point, with a sign: √(x² + y²) ahead of the end, y + x behind it, x along the
    /// outward tangent of the mold and y across it.
    ///
    /// On the mold behind the end it is minus the distance, because a gripper there has folded the fabric back.
    #[must_use]
    pub fn path_length(&self, which: usize, point: [f64; 3]) -> f64 {
        let to = sub(point, self.point()[which]);
        let (along, square) = (dot(to, self.outward[which]), dot(to, to));
        if along >= 0.0 {
            return square.sqrt();
        }
        (square - along * along).max(0.0).sqrt() + along
    }

    /// Whether a point is behind an end of the segment, on the side of the contact.
    #[must_use]
    pub fn is_behind(&self, which: usize, point: [f64; 3]) -> bool {
        dot(sub(point, self.point()[which]), self.outward[which]) < 0.0
    }

    /// Whether a free segment is a fold, not stretched and without a catenary: its gripper, at `point` (m), has passed the end of the
    /// segment, or is so near to it that no curve of small sag is as long as the fabric between them.
    #[must_use]
    pub fn is_folded(&self, which: usize, point: [f64; 3]) -> bool {
        let (path, length) = (self.path_length(which, point), self.free_length(which));
        path < length && (self.is_behind(which, point) || path < TUNING.shortest_path * length)
    }

    /// Whether a free segment hangs: it has a length and does not lie on the mold.
    #[must_use]
    pub fn hangs(&self, which: usize) -> bool {
        !self.lying[which] && self.free_length(which) > TUNING.shortest_segment * self.length
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ahead of the end the path is as long as the distance, also at a right angle; on the mold behind it, minus the distance.
    /// It is continuous where the two meet.
    #[test]
    fn the_path_has_the_sign_of_the_side_that_the_gripper_is_on() {
        let line = SurfaceCurve { points: vec![[1.0, 2.0, 0.0]; 2], arc: vec![0.02, 0.08] };
        let outward = [[-0.6, -0.8, 0.0], [0.6, 0.8, 0.0]];
        let contact = ContactSegment {
            length: 0.1,
            line,
            normal: [[0.0, 0.0, 1.0]; 2],
            lying: [false; 2],
            excess_length: [0.0; 2],
            outward,
            landed: None,
        };
        let place = |along: f64, up: f64| [1.0 + 0.6 * along, 2.0 + 0.8 * along, up];
        for (which, sense) in [(0, -1.0), (1, 1.0)] {
            let path = |along: f64, up: f64| contact.path_length(which, place(sense * along, up));
            assert!((path(0.03, 0.04) - 0.05).abs() < 1e-15);
            assert!((path(-0.03, 0.0) + 0.03).abs() < 1e-15);
            assert!((path(0.0, 0.04) - 0.04).abs() < 1e-15);
            assert!((path(-1e-9, 0.04) - path(1e-9, 0.04)).abs() < 2e-9);
            // 20 mm of fabric: behind is a fold, and so is 5 mm ahead; 15 mm ahead hangs, 30 mm ahead or above is stretched
            let folded = |along: f64, up: f64| contact.is_folded(which, place(sense * along, up));
            assert!(folded(-0.03, 0.0) && folded(-0.01, 0.0) && folded(0.005, 0.0));
            assert!(!folded(0.015, 0.0) && !folded(0.03, 0.0) && !folded(-0.001, 0.03));
        }
    }
}
