//! Slack and overstretch of a free segment: its fabric is longer or shorter than the taut path between its ends.
//!
//! The path of a segment between two grippers is the straight line. The path between a gripper and the end of a contact segment
//! has a sign. Let x be the part of the vector from the end to the gripper along the outward tangent of the mold, and
//! y the part across it: the path is √(x² + y²) ahead of the end and y + x behind it (x < 0). So a gripper that has moved inwards
//! past the end makes a fold, which is all slack and never stretch. The path of a segment that lies on the mold runs along the mold.

use super::spans::{FreeSpan, Point};
use crate::mold::{Mold, SurfaceCurve, distance};
use crate::ply::ContactSegment;
use crate::state::excess;

/// Fabric length and taut path of one free or lying segment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Index of its catenary.
    pub catenary: usize,
    /// Fabric length (m).
    pub length: f64,
    /// Taut path between its ends (m), negative where a gripper has passed the end of the contact segment.
    pub path: f64,
    /// Fabric length of the whole catenary (m).
    pub whole: f64,
    /// Middle of its ends (m).
    pub place: Point,
}

impl Misfit {
    /// Fabric length beyond the path (m), negative where the fabric is too short.
    #[must_use]
    pub fn excess(&self) -> f64 {
        self.length - self.path
    }

    /// Path beyond the fabric length (m), not negative.
    #[must_use]
    pub fn overstretch(&self) -> f64 {
        excess(-self.excess(), self.whole)
    }
}

fn middle(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|n| 0.5 * (a[n] + b[n]))
}

/// Misfit of a free span; `contact` is the contact segment of its catenary.
#[must_use]
pub fn misfit(span: &FreeSpan, contact: Option<&ContactSegment>) -> Misfit {
    let [a, b] = span.ends;
    let path = match contact {
        None => span.chord(),
        Some(contact) => contact.path_length(span.segment, if span.segment == 0 { a } else { b }),
    };
    Misfit {
        catenary: span.catenary,
        length: span.length,
        path,
        whole: contact.map_or(span.length, |contact| contact.length),
        place: middle(a, b),
    }
}

/// A segment of a catenary that does not hang: one that lies, or one of no length whose gripper has moved on.
pub struct LyingSegment {
    /// 0 before the contact segment, 1 after it; `None` for a catenary that lies whole.
    pub which: Option<usize>,
    /// Slack or overstretch.
    pub misfit: Misfit,
    /// The taut line between its ends, from first to last.
    pub line: SurfaceCurve,
}

/// The segments of a catenary that do not hang.
///
/// A gripper within `tolerance` (m) of the mold counts as standing on it; one that has lifted off pulls
/// straight.
#[must_use]
pub fn lying_segments(
    catenary: usize,
    contact: &ContactSegment,
    grippers: [Point; 2],
    mold: &Mold,
    tolerance: f64,
) -> Vec<LyingSegment> {
    if !contact.is_whole() && contact.hangs(0) && contact.hangs(1) {
        return Vec::new();
    }
    let fit = |length, path, line: &SurfaceCurve| {
        let place = middle(line.points[0], line.end());
        Misfit { catenary, length, path, whole: contact.length, place }
    };
    if contact.is_whole() {
        let line = match grippers.map(|gripper| standing(gripper, mold, tolerance)) {
            [Some(a), Some(b)] => mold.path(a, b).unwrap_or_else(|| straight(a, b)),
            _ => straight(grippers[0], grippers[1]),
        };
        let misfit = fit(contact.length, line.length(), &line);
        return vec![LyingSegment { which: None, misfit, line }];
    }
    let segment = |which: usize| {
        let (line, gripper) = taut(which, contact.point()[which], grippers[which], mold, tolerance);
        let place = gripper.unwrap_or(grippers[which]);
        // behind the end the line leads back over the contact segment
        let behind = contact.is_behind(which, place);
        let path = match gripper {
            Some(_) if behind => -line.length(),
            Some(_) => line.length(),
            None => contact.path_length(which, place),
        };
        LyingSegment {
            which: Some(which),
            misfit: fit(contact.free_length(which), path, &line),
            line,
        }
    };
    (0..2).filter(|&which| !contact.hangs(which)).map(segment).collect()
}

/// The taut line before (0) or after (1) a contact segment that ends at `end`, from first to last, and the surface point
/// that its gripper stands on; `None` for a gripper farther from the mold than `tolerance` (m), which pulls straight.
#[must_use]
pub fn taut(
    which: usize,
    end: Point,
    gripper: Point,
    mold: &Mold,
    tolerance: f64,
) -> (SurfaceCurve, Option<Point>) {
    let stands = standing(gripper, mold, tolerance);
    let place = stands.unwrap_or(gripper);
    let [a, b] = if which == 0 { [place, end] } else { [end, place] };
    let along = stands.and_then(|_| mold.path(a, b));
    (along.unwrap_or_else(|| straight(a, b)), stands)
}

/// The surface point that a gripper stands on, within a tolerance (m).
fn standing(gripper: Point, mold: &Mold, tolerance: f64) -> Option<Point> {
    let closest = mold.closest_point(gripper);
    (closest.distance <= tolerance).then_some(closest.point)
}

fn straight(a: Point, b: Point) -> SurfaceCurve {
    SurfaceCurve { points: vec![a, b], arc: vec![0.0, distance(a, b)] }
}
