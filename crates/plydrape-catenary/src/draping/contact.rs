//! Where the ply touches the mold, and which line the touching fabric takes there, section 2.4 of Krogh et al. 2018.
//!
//! Friction is infinite: fabric that touches the mold stays where it is. The deepest point of a touching run goes to its
//! closest point of the mold. The other points of the run follow the mold in the vertical plane of the span, over the
//! arc length that the fabric has, so that no fabric is made or lost. A run that reaches a gripper starts
//! from the gripper, because the ply is held there.
//!
//! A contact segment grows where the span next to it penetrates the mold, up to where the ply is farther from the mold than
//! the tolerance. A span that leaves the mold upwards does not grow its segment, although it is within
//! the tolerance over a short length: otherwise every step would add a little contact to a ply that does not move, and
//! the result would depend on the number of steps.

use super::bracket::farthest;
use super::bridge::Bridge;
use super::gap::{GapSamples, Run};
use super::spans::{FreeSpan, Point};
use super::tuning::TUNING;
use crate::geometry::vector::{cross, unit};
use crate::layup::ContactSettings;
use crate::mold::{Mold, SurfaceCurve, distance};
use crate::ply::{ContactSegment, Fibers, LandedCell, shear};

/// A diagonal about to land, and its cell at that moment.
///
/// A diagonal is no fiber. When it lands its cell keeps the shear that it has: its length is the one that this shear gives on the mold,
/// √(a² + b² ± 2ab sin γ) times [`shear::curved_scale`], on a plane the length that it hangs with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Diagonal {
    /// Sides a, b (m) of the trellis of its cell.
    pub sides: [f64; 2],
    /// Which lines of the cell are fibers.
    pub fibers: Fibers,
    /// Shear angle γ (rad), positive where the rising diagonal is the longer one.
    pub shear: f64,
    /// 1 for the rising diagonal, −1 for the falling one.
    pub sign: f64,
}

impl Diagonal {
    /// Length (m) on the mold where `place` (m) touches it, and how its cell lands.
    fn landed(&self, mold: &Mold, place: Point) -> (f64, LandedCell) {
        let [first, second] = mold.curvatures(place).principal;
        let scale = shear::curved_scale(self.sides, self.fibers, self.shear, first * second);
        let flat = shear::diagonal(self.sides, self.shear, self.sign);
        (scale * flat, LandedCell { shear: self.shear, scale })
    }
}

/// How the contact of one catenary changes at a solved shape.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactChange {
    /// The contact segment from now on; none if it has not changed.
    pub segment: Option<ContactSegment>,
    /// A touch that the model does not follow.
    pub bridge: Option<Bridge>,
}

/// One line from two that start at the same point, at fabric arc length `arc` (m): the first runs towards smaller
/// arc lengths.
fn joined(back: Option<SurfaceCurve>, arc: f64, on: Option<SurfaceCurve>) -> SurfaceCurve {
    let mut line = SurfaceCurve::default();
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

/// The line of a catenary that lies whole, between the closest points of its grippers (m), over its fabric length.
fn whole(mold: &Mold, a: [f64; 3], b: [f64; 3], length: f64) -> SurfaceCurve {
    let straight = || SurfaceCurve { points: vec![a, b], arc: vec![0.0, length] };
    let Some(mut line) = mold.path(a, b).filter(|line| line.length() > 0.0) else {
        return straight();
    };
    // the difference of the fabric and the path is spread evenly along the line, and reported as misfit
    let (last, way) = (line.points.len() - 1, line.length());
    line.arc = line.arc.iter().map(|s| s / way * length).collect();
    (line.points[last], line.arc[last]) = (b, length);
    line
}

/// Unit tangent of the mold (with this unit normal) that points out of the first (0) or second (1) end of a contact segment
/// whose plan direction is a horizontal unit vector.
fn outward(normal: [f64; 3], [x, y]: [f64; 2], end: usize) -> [f64; 3] {
    let ahead = unit(cross([-y, x, 0.0], normal)).unwrap_or([0.0; 3]);
    if end == 0 { ahead.map(|c| -c) } else { ahead }
}

/// Depth below the mold (m) of a new contact of a span: the depth of its deepest point, or of the run at its contact end if its
/// catenary is in contact already. The depth of a gripper below the `tolerance` (m) is subtracted, because it is no contact of the span.
pub fn new_depth(
    span: &FreeSpan,
    gaps: &GapSamples,
    mold: &Mold,
    in_contact: bool,
    tolerance: f64,
) -> f64 {
    let own = |end: usize| {
        let depth = -mold.signed_distance(span.ends[end]);
        if depth > tolerance { depth } else { 0.0 }
    };
    match (in_contact, span.segment) {
        (false, _) => gaps.depth() - own(0).max(own(1)),
        (true, 0) => gaps.depth_from(1) - own(0),
        (true, _) => gaps.depth_from(0) - own(1),
    }
}

/// The first contact of a catenary.
pub fn first_contact(
    span: &FreeSpan,
    gaps: &GapSamples,
    mold: &Mold,
    settings: &ContactSettings,
    diagonal: Option<Diagonal>,
) -> ContactChange {
    let runs = gaps.runs(span, mold, settings.tolerance);
    let Some(run) = runs.iter().min_by(|a, b| a.depth.total_cmp(&b.depth)) else {
        return ContactChange::default();
    };
    let heading = span.heading();
    let landed = diagonal.map(|diagonal| diagonal.landed(mold, span.point(run.deepest)));
    let length = landed.map_or(span.length, |(length, _)| length);
    let arc = |t: f64| length / span.length * span.arc(t);
    let (held_first, held_last) = (run.from <= 0.0, run.to >= 1.0);
    let [a, b] = span.ends.map(|end| mold.closest_point(end).point);
    // the point from which the line runs: at a gripper that stands on the mold, else at the deepest point
    let (seed, seed_arc) = match (held_first, held_last) {
        (true, _) => (a, 0.0),
        (false, true) => (b, length),
        (false, false) => (mold.closest_point(span.point(run.deepest)).point, arc(run.deepest)),
    };
    let piece_to = |arc: f64| mold.lay(seed, heading, arc - seed_arc);
    let piece = |t: f64| piece_to(arc(t));
    let deep = run.depth < -settings.tolerance;
    let reach =
        |side: usize, far: f64| extent(span, side, length, [run.deepest, far], deep, arc, piece_to);
    let line = match (held_first, held_last) {
        (true, true) => whole(mold, a, b, length),
        (true, false) => joined(None, 0.0, Some(piece(reach(1, run.to)))),
        (false, true) => joined(Some(piece(reach(0, run.from))), length, None),
        (false, false) => {
            let [back, on] = [reach(0, run.from), reach(1, run.to)].map(piece);
            joined(Some(back), seed_arc, Some(on))
        }
    };
    let bridge = Bridge::widest(span, mold, &runs, run);
    let normal = [line.points[0], line.end()].map(|p| mold.normal(p));
    let outward = [0, 1].map(|end| outward(normal[end], heading, end));
    let segment = ContactSegment {
        length,
        normal,
        line,
        lying: [held_first && held_last; 2],
        excess_length: [0.0; 2],
        outward,
        landed: landed.map(|(_, cell)| cell),
    };
    ContactChange { segment: Some(segment), bridge }
}

/// Fraction of the run up to which a contact reaches on the side of one end (0 or 1) of a span: `to` of [from, to], or less, because
/// a contact must not stretch the free segment that is left. A run that is `deep` below the mold is in contact as a whole.
///
/// `length` is the fabric length of the span (m), `arc` its arc length to a fraction of the run, `piece` the line on the mold up to
/// an arc length.
fn extent(
    span: &FreeSpan,
    side: usize,
    length: f64,
    [from, to]: [f64; 2],
    deep: bool,
    arc: impl Fn(f64) -> f64,
    piece: impl Fn(f64) -> SurfaceCurve,
) -> f64 {
    let excess = |t: f64| {
        let arc = arc(t);
        let left = if side == 0 { arc } else { length - arc };
        let missing = distance(piece(arc).end(), span.ends[side]) - left;
        missing - (span.chord() - length).max(0.0) - TUNING.contact_stretch * left
    };
    if deep || excess(to) <= 0.0 { to } else { farthest(from, to, excess) }
}

/// How a contact segment grows over the free segment beside it.
pub fn next_contact(
    span: &FreeSpan,
    gaps: &GapSamples,
    contact: &ContactSegment,
    mold: &Mold,
    settings: &ContactSettings,
) -> ContactChange {
    // a span that leaves the mold upwards changes nothing
    if gaps.only_leaves(
        1 - span.segment,
        settings.tolerance,
        TUNING.penetration * settings.tolerance,
    ) {
        return ContactChange::default();
    }
    let runs = gaps.runs(span, mold, settings.tolerance);
    let side = span.segment;
    // the contact end: the second end of the first free segment, the first end of the second
    let at_contact = |run: &&Run| {
        if side == 0 { run.to >= 1.0 } else { run.from <= 0.0 }
    };
    let Some(run) = runs.iter().find(at_contact) else {
        return ContactChange::default();
    };
    let bridge = Bridge::widest(span, mold, &runs, run);
    let mut change = ContactChange { segment: None, bridge };
    let mut segment = contact.clone();
    if run.from <= 0.0 && run.to >= 1.0 {
        segment.lying[side] = true;
        let (gripper, point) = (mold.closest_point(span.ends[side]).point, span.ends[1 - side]);
        segment.excess_length[side] = mold.path_length(gripper, point) - distance(gripper, point);
        change.segment = Some(segment);
        return change;
    }
    // fabric that leads back over the contact segment is not put there a second time
    if segment.is_behind(side, span.ends[side]) {
        return change;
    }
    // at a point of the mold the distance is zero but for rounding: what penetrates is clearly below
    if run.depth > -TUNING.penetration * settings.tolerance || span.run() == 0.0 {
        return change;
    }
    let heading = span.heading();
    let (end, arc) = (segment.point()[side], segment.arc()[side]);
    // from the contact end towards the gripper, up to a fabric arc length of the span
    let piece = |length: f64| match side {
        0 => mold.lay(end, heading, length - span.length),
        _ => mold.lay(end, heading, length),
    };
    let far = if side == 0 { run.from } else { run.to };
    let deep = run.depth < -settings.tolerance;
    let arc_to = |t: f64| span.arc(t);
    let to = extent(span, side, span.length, [1.0 - side as f64, far], deep, arc_to, piece);
    let line = std::mem::take(&mut segment.line);
    segment.line = if side == 0 {
        joined(Some(piece(span.arc(to))), arc, Some(line))
    } else {
        let mut grown = line;
        let on = piece(span.arc(to));
        for (point, s) in on.points.into_iter().zip(on.arc).skip(1) {
            grown.push(point, arc + s);
        }
        grown
    };
    segment.normal[side] = mold.normal(segment.point()[side]);
    segment.outward[side] = outward(segment.normal[side], heading, side);
    change.segment = Some(segment);
    change
}
