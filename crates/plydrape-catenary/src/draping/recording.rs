//! The record of the catenaries of a solved step.

use super::landing::Landing;
use super::misfit::{LyingSegment, Misfit};
use super::record::{CatenaryState, CatenaryStep, Cell, ContactState, Hold, Solver, SpanState};
use super::solved_step::SolvedStep;
use super::spans::FreeSpan;
use super::{CellShear, Snapshot};
use crate::catenary;
use crate::layup::Layup;
use crate::ply::{ContactSegment, Kind, LineCell, shear};

/// The catenaries of a step as they are recorded.
#[must_use]
pub fn catenary_step(step: &SolvedStep) -> CatenaryStep {
    let snapshot = step.snapshot;
    CatenaryStep {
        solver: Solver {
            status: snapshot.solved.status,
            iterations: snapshot.solved.iterations,
            residual: snapshot.solved.residual,
            equilibria: snapshot.equilibria,
            contact: snapshot.contact_status,
        },
        slopes: step.attitudes().iter().map(|attitude| attitude.slope).collect(),
        catenaries: catenaries(step),
        cells: cells(step.layup, snapshot),
    }
}

fn catenaries(step: &SolvedStep) -> Vec<CatenaryState> {
    let (layup, lines, snapshot) = (step.layup, step.layup.ply.lines(), step.snapshot);
    let mut spans = snapshot.shape.spans.iter().zip(step.hanging()).peekable();
    let mut out = Vec::with_capacity(lines.catenaries());
    for n in 0..lines.catenaries() {
        let c = lines.catenary(n);
        let contact = snapshot.contacts[n].as_ref();
        // a bias line that shear stretches has the force of the cells that shear along it
        let stretched = step.solver.problem().stretched(n);
        let shear_force = stretched.and_then(|path| {
            let is_falling = c.kind == Kind::Falling;
            let shears = lines.cells_of(n).filter_map(|cell| snapshot.shear[cell]);
            shear_force(layup, path, shears.filter(|shear| shear.falling == is_falling))
        });

        // the line without its segments
        let mut line = CatenaryState {
            kind: c.kind,
            from: c.from,
            to: c.to,
            length: contact.map_or_else(|| layup.ply.flat_length(n), |contact| contact.length),
            shearing: stretched.is_some(),
            shear_force_n: shear_force,
            spans: Vec::with_capacity(2),
            contact: None,
            bridging: snapshot.bridges[n],
        };

        // segments that do not lie; spans come in the order of the catenaries
        while let Some((span, misfit)) = spans.next_if(|(span, _)| span.catenary == n) {
            if contact.is_none() {
                line.length = span.length;
            }
            line.spans.push(free_state(span, misfit));
        }

        // in contact: what touches the mold, and the other segments, in order along the line
        if let Some(contact) = contact {
            line.contact = Some(contact_state(contact, step.landings()[n].as_ref()));
            line.spans.extend(step.lying()[n].iter().map(lying_state));
            line.spans.sort_by_key(|span| span.segment);
        }
        out.push(line);
    }
    out
}

/// Force (N) of a stretched bias line of a taut path (m) from the cells that it shears, where the material has a shear curve.
fn shear_force(layup: &Layup, path: f64, shears: impl Iterator<Item = CellShear>) -> Option<f64> {
    let curve = layup.ply.material.shear_curve.as_ref()?;
    let forces = shears.map(|shear| shear::force(shear.angle, path, curve.force(shear.angle).0));
    let force: f64 = forces.sum();
    force.is_finite().then_some(force)
}

fn cells(layup: &Layup, snapshot: &Snapshot) -> Vec<Cell> {
    let lines = layup.ply.lines();
    let landed = |n: &usize| snapshot.contacts[*n].as_ref().and_then(|contact| contact.landed);
    let cell = |(line_cell, shear): (&LineCell, &Option<CellShear>)| Cell {
        cell: line_cell.id,
        shear_deg: shear.map_or(0.0, |shear| shear.angle.to_degrees()),
        shearing: shear.map(|shear| match shear.falling {
            true => Kind::Falling,
            false => Kind::Rising,
        }),
        landed_deg: line_cell.bias.map(|bias| {
            bias.list().iter().find_map(landed).map(|landed| landed.shear.to_degrees())
        }),
    };
    lines.cells().iter().zip(&snapshot.shear).map(cell).collect()
}

/// A segment that hangs or is straight.
fn free_state(span: &FreeSpan, misfit: &Misfit) -> SpanState {
    SpanState {
        segment: span.segment,
        hold: match span.state {
            _ if span.shearing => Hold::Straight,
            catenary::SpanState::Hanging => Hold::Hanging,
            catenary::SpanState::Overstretched => Hold::Overstretched,
            catenary::SpanState::Straight => Hold::Straight,
        },
        length: span.length,
        path: misfit.path,
        force: span.force,
        slopes: span.slopes,
        prescribed: span.prescribed,
    }
}

/// A segment that lies on the mold, or one of no length.
fn lying_state(LyingSegment { which, misfit, line }: &LyingSegment) -> SpanState {
    let [a, b] = [line.points[0], line.end()];
    let run = (b[0] - a[0]).hypot(b[1] - a[1]);
    let slope = if run > 0.0 { (b[2] - a[2]) / run } else { 0.0 };
    SpanState {
        segment: which.unwrap_or(0),
        hold: Hold::Lying,
        length: misfit.length,
        path: misfit.path,
        force: None,
        slopes: [slope; 2],
        prescribed: [false; 2],
    }
}

fn contact_state(contact: &ContactSegment, landing: Option<&Landing>) -> ContactState {
    let errors = |landing: &Landing| landing.errors.iter().map(|e| e.map(|e| e * 1e3)).collect();
    let angle = landing.and_then(|landing| landing.fiber_angle);
    ContactState {
        points: contact.line.points.clone(),
        arc: contact.line.arc.clone(),
        landing_error_mm: landing.map(errors),
        fiber_angle_deg: angle.map(|(angle, _)| angle.to_degrees()),
    }
}
