//! From snapshots to the record: what every step looked like, and the verdict at the end.

use super::landing::Landing;
use super::misfit::{LyingSegment, Misfit};
use super::record::{
    CatenaryId, CatenaryState, Cell, ContactState, Gripper, Hold, Mount, Solver as SolverRecord,
    SpanState, Step, Summary,
};
use super::spans::FreeSpan;
use super::{Snapshot, stop};
use crate::catenary;
use crate::equilibrium::Solver;
use crate::measure::{Before, Judge, Name, State, last_numbers, worst_numbers};
use crate::mold::distance;
use crate::ply::{ContactSegment, Kind, LineCell, shear};
use crate::scene::Scene;

/// Collects the steps of a drape.
pub struct Report<'a> {
    scene: &'a Scene,
    steps: Vec<Step>,
    before: Option<Before>,
    judge: Judge<'a>,
}

impl<'a> Report<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        Report {
            scene,
            steps: Vec::with_capacity(scene.motion.positions.len()),
            before: None,
            judge: Judge::new(scene, true),
        }
    }

    /// Records a step; false if no ply survives it.
    pub fn add(&mut self, snapshot: &Snapshot, solver: &Solver) -> bool {
        let (scene, ply) = (self.scene, &self.scene.ply);
        let state = State::new(scene, snapshot, solver, self.before.as_ref());
        let measures = self.judge.see_all(&state);
        let tilts = scene.tilts();
        let mut grippers = Vec::with_capacity(ply.grippers());
        for (n, attitude) in state.attitudes().iter().enumerate() {
            let position = snapshot.positions[n];
            let target = scene.target.as_ref().map(|t| distance(position, t.grippers[n]) * 1e3);
            grippers.push(Gripper {
                id: ply.id(n),
                position,
                slope_u: attitude.slope[0],
                slope_v: attitude.slope[1],
                tilt_deg: if tilts { attitude.tilt.to_degrees() } else { 0.0 },
                quaternion: attitude.quaternion,
                target_distance_mm: target,
                mount: snapshot.mounts.as_ref().map(|mounts| Mount {
                    commanded: mounts.commanded[n],
                    force: mounts.force[n],
                    slip: mounts.slip[n],
                    on_mold: mounts.standing[n],
                }),
            });
        }
        let equilibrium = snapshot.solved;
        self.steps.push(Step {
            step: snapshot.step,
            time: snapshot.time,
            grippers,
            solver: SolverRecord {
                status: equilibrium.status,
                iterations: equilibrium.iterations,
                residual: equilibrium.residual,
                equilibria: snapshot.equilibria,
                contact: snapshot.contact_status,
            },
            catenaries: self.catenaries(&state),
            cells: self.cells(snapshot),
            measures,
        });
        let goes_on = !stop::breaks(&state);
        self.before = Some(state.as_before());
        goes_on
    }

    fn catenaries(&self, state: &State) -> Vec<CatenaryState> {
        let (scene, lines) = (self.scene, self.scene.ply.lines());
        let (snapshot, landings) = (state.snapshot, state.landings());
        let mut misfits = state.misfits().iter();
        let mut spans = snapshot.shape.spans.iter().peekable();
        let mut out = Vec::with_capacity(lines.catenaries());
        for n in 0..lines.catenaries() {
            let c = lines.catenary(n);
            let contact = snapshot.contacts[n].as_ref();
            let stretched = state.solver.problem().stretched(n);
            let force = stretched.and_then(|path| {
                let is_falling = c.kind == Kind::Falling;
                let shears = lines.cells_of(n).filter_map(|cell| snapshot.shear[cell]);
                self.shear_force(path, shears.filter(|shear| shear.falling == is_falling))
            });
            let mut line = CatenaryState {
                kind: c.kind,
                from: c.from,
                to: c.to,
                length: contact.map_or_else(|| scene.ply.flat_length(n), |contact| contact.length),
                shearing: stretched.is_some(),
                shear_force_n: force,
                spans: Vec::with_capacity(2),
                contact: None,
                bridging: snapshot.bridges[n],
            };
            while let Some(span) = spans.next_if(|span| span.catenary == n) {
                if contact.is_none() {
                    line.length = span.length;
                }
                if let Some(misfit) = misfits.next() {
                    line.spans.push(span_state(span, misfit));
                }
            }
            if let Some(contact) = contact {
                line.contact = Some(contact_state(contact, landings[n].as_ref()));
                line.spans.extend(state.lying()[n].iter().map(lying_state));
                line.spans.sort_by_key(|span| span.segment);
            }
            out.push(line);
        }
        out
    }

    /// Force (N) of a stretched bias line of a taut path (m) from the cells that it shears, where the material has a shear curve.
    fn shear_force(
        &self,
        path: f64,
        shears: impl Iterator<Item = super::CellShear>,
    ) -> Option<f64> {
        let curve = self.scene.ply.material.shear_curve.as_ref()?;
        let of =
            |shear: super::CellShear| shear::force(shear.angle, path, curve.force(shear.angle).0);
        let force: f64 = shears.map(of).sum();
        force.is_finite().then_some(force)
    }

    fn cells(&self, snapshot: &Snapshot) -> Vec<Cell> {
        let lines = self.scene.ply.lines();
        let landed = |n: &usize| snapshot.contacts[*n].as_ref().and_then(|contact| contact.landed);
        let cell = |(line_cell, shear): (&LineCell, &Option<super::CellShear>)| Cell {
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

    /// The steps and the outcome, judged.
    pub fn finish(self) -> (Vec<Step>, Summary) {
        let summary = self.summary();
        (self.steps, summary)
    }

    fn summary(&self) -> Summary {
        let touched = |step: &&Step| step.catenaries.iter().any(|c| c.contact.is_some());
        let first = self.steps.iter().find(touched);
        let first_contact = first.map_or_else(Vec::new, |step| {
            let touching = step.catenaries.iter().filter(|c| c.contact.is_some());
            touching.map(|c| CatenaryId { kind: c.kind, from: c.from, to: c.to }).collect()
        });
        let shears = |cell: &Cell| cell.shearing.is_some();
        let first_shear = self.steps.iter().find(|step| step.cells.iter().any(shears));
        let all_shear =
            self.steps.iter().find(|s| !s.cells.is_empty() && s.cells.iter().all(shears));
        let limits = self.judge.verdicts();
        let last = self.steps.last().map(|step| &step.measures);
        Summary {
            accepted: limits.iter().all(|verdict| verdict.ok)
                && self.steps.len() == self.scene.motion.positions.len(),
            stopped: stop::reason(self.scene, &self.steps),
            steps: self.steps.len(),
            steps_planned: self.scene.motion.positions.len(),
            first_contact_step: first.map(|step| step.step),
            first_contact,
            first_shear_step: first_shear.map(|step| step.step),
            all_shear_step: all_shear.map(|step| step.step),
            worst: worst_numbers(self.steps.iter().map(|step| &step.measures)),
            last: last_numbers(last),
            contact_share: last.and_then(|measures| measures.value(Name::ContactShare)),
            limits,
            equilibria: self.steps.iter().map(|step| step.solver.equilibria).sum(),
            sheet: None,
            sample: None,
            stands: None,
            tool: None,
        }
    }
}

fn span_state(span: &FreeSpan, misfit: &Misfit) -> SpanState {
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
    let angle = landing.and_then(|landing| landing.fibre_angle);
    ContactState {
        points: contact.line.points.clone(),
        arc: contact.line.arc.clone(),
        landing_error_mm: landing.map(errors),
        fibre_angle_deg: angle.map(|(angle, _)| angle.to_degrees()),
    }
}
