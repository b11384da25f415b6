//! How the fabric of a free segment fits the way that it has: slack where it is longer, stretch where it is shorter.
//!
//! The way of a segment between two grippers is the straight line. Between a gripper and the end of what is in contact it
//! has a sign: with the way from the end to the gripper split into x along the outward tangent of the mold and
//! y across it, it is √(x² + y²) ahead of the end and y + x behind it (x < 0). A gripper that has moved inwards past
//! the end thus makes a fold, all of it slack, and never stretch. A segment that lies has the way along the mold.

use super::spans::{FreeSpan, Point};
use crate::mold::{Mold, Strand, distance};
use crate::ply::Laid;

/// Fit of one free or lying segment between what holds it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Misfit {
    /// Index of its catenary.
    pub catenary: usize,
    /// Fabric length (m).
    pub length: f64,
    /// Way between its ends (m), negative where a gripper has passed the end of what is in contact.
    pub way: f64,
    /// Fabric length of the whole catenary (m).
    pub whole: f64,
    /// Middle of its ends (m).
    pub place: Point,
}

impl Misfit {
    /// Fabric beyond the way (m), negative where it is short.
    #[must_use]
    pub fn excess(&self) -> f64 {
        self.length - self.way
    }

    /// Fabric beyond the way (m), not negative.
    #[must_use]
    pub fn slack(&self) -> f64 {
        slack(self.excess(), self.whole)
    }

    /// Way beyond the fabric (m), not negative.
    #[must_use]
    pub fn overstretch(&self) -> f64 {
        slack(-self.excess(), self.whole)
    }
}

/// What is slack (m) of an excess of fabric (m): what rounding leaves of a taut line is none.
pub fn slack(excess: f64, whole: f64) -> f64 {
    // what is no number stays it
    if excess <= 1e-12 * whole { 0.0 } else { excess }
}

fn middle(a: Point, b: Point) -> Point {
    [0, 1, 2].map(|n| 0.5 * (a[n] + b[n]))
}

/// How a free span fits between its ends; `laid` is what is in contact of its catenary.
#[must_use]
pub fn misfit(span: &FreeSpan, laid: Option<&Laid>) -> Misfit {
    let [a, b] = span.ends;
    let way = match laid {
        None => span.chord(),
        Some(laid) => laid.way(span.rest, if span.rest == 0 { a } else { b }),
    };
    Misfit {
        catenary: span.catenary,
        length: span.length,
        way,
        whole: laid.map_or(span.length, |laid| laid.length),
        place: middle(a, b),
    }
}

/// A segment of a catenary that does not hang: one that lies, or one of no length whose gripper has moved on.
pub struct LyingSegment {
    /// 0 before the contact segment, 1 after it; none for a catenary that lies whole.
    pub which: Option<usize>,
    /// How its fabric fits.
    pub misfit: Misfit,
    /// The taut line between its ends, from first to last.
    pub line: Strand,
}

/// The segments of a catenary that do not hang.
///
/// A gripper within `tolerance` (m) of the mold counts as standing on it; one that has lifted off pulls
/// straight.
#[must_use]
pub fn lying_segments(
    catenary: usize,
    laid: &Laid,
    grippers: [Point; 2],
    mold: &Mold,
    tolerance: f64,
) -> Vec<LyingSegment> {
    if !laid.is_whole() && laid.hangs(0) && laid.hangs(1) {
        return Vec::new();
    }
    let fit = |length, way, line: &Strand| {
        let place = middle(line.points[0], line.end());
        Misfit { catenary, length, way, whole: laid.length, place }
    };
    if laid.is_whole() {
        let line = match grippers.map(|gripper| standing(gripper, mold, tolerance)) {
            [Some(a), Some(b)] => mold.path(a, b).unwrap_or_else(|| straight(a, b)),
            _ => straight(grippers[0], grippers[1]),
        };
        let misfit = fit(laid.length, line.length(), &line);
        return vec![LyingSegment { which: None, misfit, line }];
    }
    let segment = |which: usize| {
        let (line, gripper) = taut(which, laid.point()[which], grippers[which], mold, tolerance);
        let place = gripper.unwrap_or(grippers[which]);
        // behind the end the line leads back over what is in contact
        let behind = laid.is_behind(which, place);
        let way = match gripper {
            Some(_) if behind => -line.length(),
            Some(_) => line.length(),
            None => laid.way(which, place),
        };
        LyingSegment { which: Some(which), misfit: fit(laid.rest(which), way, &line), line }
    };
    (0..2).filter(|&which| !laid.hangs(which)).map(segment).collect()
}

/// The taut line before (0) or after (1) a contact segment that ends at `end`, from first to last, and the surface point
/// that its gripper stands on; none for a gripper farther from the mold than `tolerance` (m), which pulls straight.
#[must_use]
pub fn taut(
    which: usize,
    end: Point,
    gripper: Point,
    mold: &Mold,
    tolerance: f64,
) -> (Strand, Option<Point>) {
    let stands = standing(gripper, mold, tolerance);
    let place = stands.unwrap_or(gripper);
    let [a, b] = if which == 0 { [place, end] } else { [end, place] };
    let along = stands.and_then(|_| mold.path(a, b));
    (along.unwrap_or_else(|| straight(a, b)), stands)
}

/// The surface point that a gripper stands on, within a tolerance (m).
fn standing(gripper: Point, mold: &Mold, tolerance: f64) -> Option<Point> {
    let foot = mold.foot(gripper);
    (foot.distance <= tolerance).then_some(foot.point)
}

fn straight(a: Point, b: Point) -> Strand {
    Strand { points: vec![a, b], arc: vec![0.0, distance(a, b)] }
}
