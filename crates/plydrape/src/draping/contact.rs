//! Where the ply touches the mold, and how what touches is laid, section 2.4 of Krogh et al. 2018.
//!
//! Infinite friction: what touches stays. Fabric is laid, not snapped: the deepest point goes to its
//! closest point of the mold, the rest of the run along the mold in the vertical plane of its span,
//! over the same arc length, so that no fabric is made or lost. A run that reaches a gripper starts
//! from it, since there the ply is held.
//!
//! A segment grows where the span next to it dips below the mold, up to where the ply is farther than
//! the tolerance. A span that leaves the mold upwards does not grow its segment, though it is within
//! the tolerance for a while: otherwise every step would lay a bit more of a ply that does not move, and
//! the result would depend on the number of steps.

use super::gap::{GapSamples, Run, farthest, largest_gap};
use super::spans::{FreeSpan, Point};
use crate::mold::vector::{cross, unit};
use crate::mold::{Mold, Strand, distance};
use crate::ply::{Laid, LandedCell, shear};
use crate::scene::Contact;

/// Depth from which a span dips, as a share of the tolerance.
const DIP: f64 = 1e-3;

/// Stretch that laying a run may add to what it leaves free, as a share of what it leaves.
const PULL: f64 = 1e-4;

/// A touch away from the contact segment: the ply bridges what is between.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Bridge {
    /// Place of the largest gap between segment and touch (m).
    pub place: Point,
    /// That gap (m).
    pub gap: f64,
    /// Straight distance between the touches on both sides of it (m).
    pub width: f64,
}

/// A diagonal about to land, and its cell at that moment.
///
/// A diagonal is no fibre. When it lands its cell keeps the shear that it has: its length is the one that this shear gives on the mold,
/// √(a² + b² ± 2ab sin γ) times [`shear::curved_scale`], on a plane the length that it hangs with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Diagonal {
    /// Fabric sides of the cell a, b (m).
    pub sides: [f64; 2],
    /// Its shear angle γ (rad), positive where the rising diagonal is the longer one.
    pub shear: f64,
    /// 1 for the rising diagonal, −1 for the falling one.
    pub sign: f64,
}

impl Diagonal {
    /// Its length (m) on the mold where `place` (m) touches it, and how its cell lands.
    fn landed(&self, mold: &Mold, place: Point) -> (f64, LandedCell) {
        let [first, second] = mold.curvatures(place).principal;
        let scale = shear::curved_scale(self.sides, self.shear, first * second);
        let flat = shear::diagonal(self.sides, self.shear, self.sign);
        (scale * flat, LandedCell { shear: self.shear, scale })
    }
}

/// What a look at one catenary found.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Look {
    /// The contact as it is from now on, if it has changed.
    pub laid: Option<Laid>,
    /// A touch that the model does not follow.
    pub bridge: Option<Bridge>,
}

/// One line from two that start at the same point, at fabric arc length `arc` (m): the first is gone
/// back along.
fn joined(back: Option<Strand>, arc: f64, on: Option<Strand>) -> Strand {
    let mut line = Strand::default();
    if let Some(back) = back {
        let from = usize::from(on.is_some());
        for n in (from..back.points.len()).rev() {
            line.push(back.points[n], arc - back.arc[n]);
        }
    }
    if let Some(on) = on {
        let start = arc - on.arc[0];
        for (point, s) in on.points.into_iter().zip(on.arc) {
            line.push(point, start + s);
        }
    }
    line
}

/// The line of a catenary that lies whole, from foot to foot of its grippers (m), over its fabric length.
fn whole(mold: &Mold, a: [f64; 3], b: [f64; 3], length: f64) -> Strand {
    let straight = || Strand { points: vec![a, b], arc: vec![0.0, length] };
    let Some(mut line) = mold.path(a, b).filter(|line| line.length() > 0.0) else {
        return straight();
    };
    // what the fabric is too long or too short is spread along it here, and reported as misfit
    let (last, way) = (line.points.len() - 1, line.length());
    line.arc = line.arc.iter().map(|s| s / way * length).collect();
    (line.points[last], line.arc[last]) = (b, length);
    line
}

/// Unit tangent of the mold (with this unit normal) out of the first (0) or second (1) end of what is laid along a
/// horizontal unit vector.
fn outward(normal: [f64; 3], [x, y]: [f64; 2], end: usize) -> [f64; 3] {
    let ahead = unit(cross([-y, x, 0.0], normal)).unwrap_or([0.0; 3]);
    if end == 0 { ahead.map(|c| -c) } else { ahead }
}

/// Depth below the mold (m) that a new touch of a span has: that of its deepest point, or of a span that is in contact already, of the
/// run at its contact end. What a gripper is deeper than the `tolerance` (m) itself is no touch.
pub fn new_depth(
    span: &FreeSpan,
    gaps: &GapSamples,
    mold: &Mold,
    caught: bool,
    tolerance: f64,
) -> f64 {
    let own = |end: usize| {
        let depth = -mold.signed_distance(span.ends[end]);
        if depth > tolerance { depth } else { 0.0 }
    };
    match (caught, span.rest) {
        (false, _) => gaps.depth() - own(0).max(own(1)),
        (true, 0) => gaps.depth_from(1) - own(0),
        (true, _) => gaps.depth_from(0) - own(1),
    }
}

/// Looks at a catenary that nothing has caught yet.
pub fn first_touch(
    span: &FreeSpan,
    gaps: &GapSamples,
    mold: &Mold,
    contact: &Contact,
    diagonal: Option<Diagonal>,
) -> Look {
    let runs = gaps.runs(span, mold, contact.tolerance);
    let Some(run) = runs.iter().min_by(|a, b| a.depth.total_cmp(&b.depth)) else {
        return Look::default();
    };
    let heading = span.heading();
    let landed = diagonal.map(|diagonal| diagonal.landed(mold, span.point(run.deepest)));
    let length = landed.map_or(span.length, |(length, _)| length);
    let arc = |t: f64| length / span.length * span.arc(t);
    let (held_first, held_last) = (run.from <= 0.0, run.to >= 1.0);
    let [a, b] = span.ends.map(|end| mold.closest_point(end));
    // where laying starts: at a gripper that stands on the mold, else at the deepest point
    let (seed, seed_arc) = match (held_first, held_last) {
        (true, _) => (a, 0.0),
        (false, true) => (b, length),
        (false, false) => (mold.closest_point(span.point(run.deepest)), arc(run.deepest)),
    };
    let piece_to = |arc: f64| mold.lay(seed, heading, arc - seed_arc);
    let piece = |t: f64| piece_to(arc(t));
    // laying a run must not stretch what it leaves free
    let reach = |side: usize, far: f64| {
        let excess = |t: f64| {
            let arc = arc(t);
            let left = if side == 0 { arc } else { length - arc };
            let pull = distance(piece_to(arc).end(), span.ends[side]) - left;
            pull - (span.chord() - length).max(0.0) - PULL * left
        };
        if run.depth < -contact.tolerance || excess(far) <= 0.0 {
            return far;
        }
        farthest(run.deepest, far, excess)
    };
    let line = match (held_first, held_last) {
        (true, true) => whole(mold, a, b, length),
        (true, false) => joined(None, 0.0, Some(piece(reach(1, run.to)))),
        (false, true) => joined(Some(piece(reach(0, run.from))), length, None),
        (false, false) => {
            let [back, on] = [reach(0, run.from), reach(1, run.to)].map(piece);
            joined(Some(back), seed_arc, Some(on))
        }
    };
    // the gap to any other run: whatever lies between the two
    let bridge = runs
        .iter()
        .filter(|other| *other != run)
        .map(|other| {
            let (a, b) =
                if other.to < run.from { (other.to, run.from) } else { (run.to, other.from) };
            largest_gap(span, mold, a, b)
        })
        .max_by(|a, b| a.gap.total_cmp(&b.gap));
    let normal = [line.points[0], line.end()].map(|p| mold.normal(p));
    let outward = [0, 1].map(|end| outward(normal[end], heading, end));
    let laid = Laid {
        length,
        normal,
        line,
        lying: [held_first && held_last; 2],
        arch: [0.0; 2],
        outward,
        landed: landed.map(|(_, cell)| cell),
    };
    Look { laid: Some(laid), bridge }
}

/// Looks at a rest of a catenary that the mold has caught before.
pub fn next_touch(
    span: &FreeSpan,
    gaps: &GapSamples,
    laid: &Laid,
    mold: &Mold,
    contact: &Contact,
) -> Look {
    // a span that leaves the mold upwards changes nothing
    if gaps.only_leaves(1 - span.rest, contact.tolerance, DIP * contact.tolerance) {
        return Look::default();
    }
    let runs = gaps.runs(span, mold, contact.tolerance);
    let rest = span.rest;
    // the contact end: the second end of the first rest, the first end of the second
    let at_contact = |run: &&Run| {
        if rest == 0 { run.to >= 1.0 } else { run.from <= 0.0 }
    };
    let Some(run) = runs.iter().find(at_contact) else {
        return Look::default();
    };
    let mut look = Look {
        laid: None,
        bridge: runs
            .iter()
            .filter(|other| *other != run)
            .map(|other| {
                let (a, b) = if rest == 0 { (other.to, run.from) } else { (run.to, other.from) };
                largest_gap(span, mold, a, b)
            })
            .max_by(|a, b| a.gap.total_cmp(&b.gap)),
    };
    let mut laid = laid.clone();
    if run.from <= 0.0 && run.to >= 1.0 {
        laid.lying[rest] = true;
        let (gripper, point) = (mold.closest_point(span.ends[rest]), span.ends[1 - rest]);
        laid.arch[rest] = mold.path_length(gripper, point) - distance(gripper, point);
        look.laid = Some(laid);
        return look;
    }
    // fabric that leads back over what is in contact is not laid there a second time
    if laid.is_behind(rest, span.ends[rest]) {
        return look;
    }
    // at a point of the mold the distance is zero but for rounding: what dips goes clearly below
    if run.depth > -DIP * contact.tolerance || span.run() == 0.0 {
        return look;
    }
    let heading = span.heading();
    let (end, arc) = (laid.point()[rest], laid.arc()[rest]);
    // from the contact end towards the gripper, up to a fabric arc length of the span
    let piece = |at: f64| match rest {
        0 => mold.lay(end, heading, at - span.length),
        _ => mold.lay(end, heading, at),
    };
    let excess = |t: f64| {
        let at = span.arc(t);
        let left = if rest == 0 { at } else { span.length - at };
        let pull = distance(piece(at).end(), span.ends[rest]) - left;
        pull - (span.chord() - span.length).max(0.0) - PULL * left
    };
    let far = if rest == 0 { run.from } else { run.to };
    let to = if run.depth < -contact.tolerance || excess(far) <= 0.0 {
        far
    } else {
        farthest(1.0 - rest as f64, far, excess)
    };
    let line = std::mem::take(&mut laid.line);
    laid.line = if rest == 0 {
        joined(Some(piece(span.arc(to))), arc, Some(line))
    } else {
        let mut grown = line;
        let on = piece(span.arc(to));
        for (point, s) in on.points.into_iter().zip(on.arc).skip(1) {
            grown.push(point, arc + s);
        }
        grown
    };
    laid.normal[rest] = mold.normal(laid.point()[rest]);
    laid.outward[rest] = outward(laid.normal[rest], heading, rest);
    look.laid = Some(laid);
    look
}
