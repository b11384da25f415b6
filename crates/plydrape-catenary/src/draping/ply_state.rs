//! A solved step as any model says it.
//!
//! The catenaries know the ply along lines alone: its points have no normals and stand for no area. Landing errors and fiber angles are
//! those of fibers; a diagonal is none, and where it lands follows from the shear that its cell lands with. Grippers are where they are
//! commanded, and no fabric slides under them.

use super::curves::hanging;
use super::load::forces;
use super::misfit::Misfit;
use super::solved_step::SolvedStep;
use super::spans::FreeSpan;
use crate::geometry::vector::between;
use crate::geometry::{Point, distance};
use crate::layup::Model;
use crate::mold::Mold;
use crate::ply::shear::{mean_path, signed_angle};
use crate::ply::{BiasLines, ContactSegment};
use crate::state::{CellState, FabricPoint, GripperState, LineState, PlyState, Site, Unsolved};

/// How much is said of a step.
#[derive(Debug, Clone, Copy)]
pub struct Detail {
    /// Whether it is the last one, which says how the ply has landed.
    pub last: bool,
    /// Whether everything is said, as a record needs it.
    pub full: bool,
}

/// The ply of a solved step.
#[must_use]
pub fn ply_state(step: &SolvedStep, detail: Detail) -> PlyState {
    let snapshot = step.snapshot;
    let residual = snapshot.solved.residual;
    PlyState {
        model: Model::Catenaries,
        step: snapshot.step,
        time: snapshot.time,
        points: points(step, detail),
        lines: lines(step, detail),
        cells: cells(step, detail),
        grippers: grippers(step),
        unsolved: snapshot.failure().map(|why| Unsolved { why, residual }),
    }
}

fn grippers(step: &SolvedStep) -> Vec<GripperState> {
    let snapshot = step.snapshot;
    let forces = forces(step.layup, snapshot);
    let gripper = |n: usize| {
        let attitude = &step.attitudes()[n];
        GripperState {
            position: snapshot.positions[n],
            commanded: snapshot.positions[n],
            quaternion: attitude.quaternion,
            tilt: attitude.tilt,
            force: forces[n],
            slide: 0.0,
            holds: true,
        }
    };
    (0..snapshot.positions.len()).map(gripper).collect()
}

/// Segments that hang, then those beside a contact that do not, then those in contact.
fn lines(step: &SolvedStep, detail: Detail) -> Vec<LineState> {
    let (snapshot, edges) = (step.snapshot, step.layup.ply.lines().edges());
    let segment = |misfit: &Misfit| LineState {
        site: Site::Catenary(misfit.catenary),
        catenary: Some(misfit.catenary),
        is_fiber: misfit.catenary < edges,
        place: misfit.place,
        length: misfit.length,
        whole: misfit.whole,
        path: misfit.path,
        force: None,
        hangs: false,
        lies: false,
        sag: None,
        slope: None,
        bridge: None,
        fiber_angle: None,
    };
    let mut out = Vec::with_capacity(snapshot.shape.spans.len() + 2 * snapshot.contacts.len());
    for (span, misfit) in snapshot.shape.spans.iter().zip(step.hanging()) {
        let hangs = snapshot.contacts[span.catenary].is_none();
        let line = LineState { force: span.force, hangs, ..segment(misfit) };
        out.push(match detail.full {
            true => LineState { sag: sag(span), slope: slope(span), ..line },
            false => line,
        });
    }
    // what has landed of a catenary says how
    let landed = |line: LineState| {
        let bridge = line.catenary.and_then(|n| snapshot.bridges[n]);
        let landing = (detail.last || detail.full)
            .then(|| line.catenary.and_then(|n| step.landings()[n].as_ref()))
            .flatten();
        LineState {
            lies: true,
            bridge: bridge.map(|bridge| (bridge.gap, bridge.place)),
            fiber_angle: landing.and_then(|landing| landing.fiber_angle.map(|(angle, _)| angle)),
            ..line
        }
    };
    for lying in step.lying().iter().flatten() {
        let line = segment(&lying.misfit);
        let contact = snapshot.contacts[lying.misfit.catenary].as_ref();
        out.push(match lying.which {
            // a catenary that lies whole has no other segment
            None => landed(line),
            Some(which) => {
                LineState { lies: contact.is_some_and(|contact| contact.lying[which]), ..line }
            }
        });
    }
    for (n, contact) in snapshot.contacts.iter().enumerate() {
        if let Some(contact) = contact.as_ref().filter(|contact| !contact.is_whole()) {
            out.push(landed(segment(&in_contact(n, contact))));
        }
    }
    out
}

/// The segment in contact itself, which has neither slack nor stretch.
fn in_contact(catenary: usize, contact: &ContactSegment) -> Misfit {
    let ([a, b], length) = (contact.point(), contact.line.length());
    let place = between(a, b, 0.5);
    Misfit { catenary, length, path: length, whole: contact.length, place }
}

/// How deep a span hangs below its chord, as a share of its run; `None` if it has no shape.
fn sag(span: &FreeSpan) -> Option<f64> {
    let run = span.run();
    if span.profile.is_none() || run <= 0.0 {
        return None;
    }
    let ([a, b], points) = (span.ends, hanging(span));
    let last = (points.len() - 1) as f64;
    let below = points.iter().enumerate().map(|(n, point)| {
        let chord = a[2] + (b[2] - a[2]) * n as f64 / last;
        (chord - point[2]) / run
    });
    Some(below.fold(0.0, larger))
}

/// The steepest that a span leaves its ends against its chord, rise over run; `None` if it has no shape.
fn slope(span: &FreeSpan) -> Option<f64> {
    let (run, [a, b]) = (span.run(), span.ends);
    if span.profile.is_none() || run <= 0.0 {
        return None;
    }
    let chord = (b[2] - a[2]) / run;
    Some(span.slopes.iter().map(|slope| (slope - chord).abs()).fold(0.0, larger))
}

/// The larger of two numbers; what is no number is the largest.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

fn points(step: &SolvedStep, detail: Detail) -> Vec<FabricPoint> {
    let (snapshot, edges) = (step.snapshot, step.layup.ply.lines().edges());
    let point = |catenary: usize, place: Point, height: f64| FabricPoint {
        site: Site::Catenary(catenary),
        place,
        normal: None,
        height: Some(height),
        lies: false,
        area: 0.0,
        error: None,
    };
    let mut out = Vec::new();
    let Some(mold) = &step.layup.mold else { return out };
    if let Some((depth, catenary, place)) = snapshot.deepest {
        out.push(point(catenary, place, -depth));
    }
    // where fibers have landed, if the ideal drape is known
    if detail.last || detail.full {
        let landings = snapshot.contacts.iter().zip(step.landings()).enumerate().take(edges);
        for (n, (contact, landing)) in landings {
            let Some((contact, landing)) = contact.as_ref().zip(landing.as_ref()) else { continue };
            let landed = contact.line.points.iter().zip(&landing.errors);
            out.extend(landed.map(|(place, error)| FabricPoint {
                lies: true,
                error: *error,
                ..point(n, *place, 0.0)
            }));
        }
    }
    if detail.full {
        for span in &snapshot.shape.spans {
            out.extend(
                above(span, mold).map(|(place, height)| point(span.catenary, place, height)),
            );
        }
    }
    out
}

/// The stations of a span (m) that are not below the mold, and their heights over it (m): the deepest point is found exactly, and a
/// diagonal that has landed may hang through the mold.
fn above(span: &FreeSpan, mold: &Mold) -> impl Iterator<Item = (Point, f64)> {
    let stations = hanging(span).into_iter().map(|place| (place, mold.signed_distance(place)));
    // a distance that is no number stays
    stations.filter(|(_, height)| *height >= 0.0 || height.is_nan())
}

fn cells(step: &SolvedStep, detail: Detail) -> Vec<CellState> {
    let (snapshot, lines) = (step.snapshot, step.layup.ply.lines());
    let cell = |(n, shear): (usize, &Option<super::CellShear>)| {
        let [low, _, top, _] = lines.cells()[n].corners.map(|gripper| snapshot.positions[gripper]);
        CellState {
            site: Site::Cell(n),
            place: between(low, top, 0.5),
            shear: shear.map_or(0.0, |shear| shear.angle),
            directions: None,
            landing_error: (detail.last || detail.full)
                .then(|| landing_shear_error(step, n))
                .flatten(),
        }
    };
    snapshot.shear.iter().enumerate().map(cell).collect()
}

/// How much the shear of a cell (rad) differs from the one that it had when a diagonal of it landed; `None` if none has. The shear is that
/// of the four grippers, along the mold where both ends of a diagonal stand on it.
fn landing_shear_error(step: &SolvedStep, cell: usize) -> Option<f64> {
    let (layup, snapshot, lines) = (step.layup, step.snapshot, step.layup.ply.lines());
    let (mold, tolerance) = (layup.mold.as_ref()?, layup.settings.contact.tolerance);
    let cell = &lines.cells()[cell];
    let diagonals = cell.bias.iter().flat_map(BiasLines::list);
    let mut landed = diagonals.filter_map(|n| snapshot.contacts[*n].as_ref()?.landed).peekable();
    landed.peek()?;
    let path = |n: usize| {
        let [a, b] = lines.ends(n).map(|gripper| snapshot.positions[gripper]);
        let stand = [a, b].iter().all(|p| mold.signed_distance(*p) <= tolerance);
        if stand { mold.path_length(a, b) } else { distance(a, b) }
    };
    let [rising, falling] = cell.bias.map(|bias| mean_path(bias.list().iter().map(|n| path(*n))));
    let end = signed_angle(layup.ply.trellis(cell, &snapshot.contacts), rising, falling);
    Some(landed.map(|landed| (end - landed.shear).abs()).fold(0.0, larger))
}
