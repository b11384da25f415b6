//! From snapshots to the record: what every step looked like, and the verdict at the end.

use super::crossing::{STATIONS, lowered};
use super::landing::Landing;
use super::misfit::{LyingSegment, Misfit};
use super::record::{
    Bridging, CatenaryDirection, CatenaryId, CatenaryKind, CatenaryState, Cell, ContactState,
    Gripper, Hold, Solver as SolverRecord, SpanState, Step, Summary,
};
use super::spans::{FreeSpan, Point};
use super::{Snapshot, stop};
use crate::catenary;
use crate::equilibrium::Solver;
use crate::measure::{Before, Judge, Name, State, last_numbers, worst_numbers};
use crate::mold::vector::along;
use crate::mold::{Mold, distance};
use crate::ply::{ContactSegment, Kind, Ruck, shear};
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
        let (scene, grid) = (self.scene, self.scene.ply.grid);
        let state = State::new(scene, snapshot, solver, self.before.as_ref());
        let measures = self.judge.see_all(&state);
        let mut points = state.stations().to_vec();
        for (span, through) in lowered(scene, &snapshot.shape.spans, &snapshot.contacts) {
            points[span] = through;
        }
        let mut grippers = Vec::with_capacity(grid.grippers());
        for (n, attitude) in state.attitudes().iter().enumerate() {
            let position = snapshot.positions[n];
            let target = scene.target.as_ref().map(|t| distance(position, t.grippers[n]) * 1e3);
            grippers.push(Gripper {
                id: grid.id(n),
                position,
                slope_u: attitude.slope[0],
                slope_v: attitude.slope[1],
                tilt_deg: attitude.tilt.to_degrees(),
                quaternion: attitude.quaternion,
                target_distance_mm: target,
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
            catenaries: self.catenaries(&state, points),
            cells: self.cells(snapshot),
            measures,
        });
        let goes_on = !stop::breaks(&state);
        self.before = Some(state.as_before());
        goes_on
    }

    fn catenaries(&self, state: &State, points: Vec<Vec<Point>>) -> Vec<CatenaryState> {
        let (scene, grid) = (self.scene, self.scene.ply.grid);
        let (snapshot, landings) = (state.snapshot, state.landings());
        let mut misfits = state.misfits().iter();
        let mut spans = snapshot.shape.spans.iter().zip(points).peekable();
        let mut out = Vec::with_capacity(grid.catenaries());
        for n in 0..grid.catenaries() {
            let c = grid.catenary(n);
            let (kind, direction) = described(c.kind);
            let contact = snapshot.contacts[n].as_ref();
            let shear = (n >= grid.edges())
                .then(|| snapshot.shear[(n - grid.edges()) / 2])
                .flatten()
                .filter(|shear| shear.falling == (direction == CatenaryDirection::Falling));
            let mut line = CatenaryState {
                kind,
                direction,
                from: c.from,
                to: c.to,
                length: contact
                    .map_or_else(|| scene.ply.flat_length(c.kind), |contact| contact.length),
                shearing: shear.is_some(),
                shear_force_n: shear.and_then(|shear| self.shear_force(&shear)),
                spans: Vec::with_capacity(2),
                contact: None,
                bridging: snapshot.bridges[n].map(|b| Bridging {
                    place: b.place,
                    gap: b.gap,
                    width: b.width,
                }),
            };
            while let Some((span, points)) = spans.next_if(|(span, _)| span.catenary == n) {
                if contact.is_none() {
                    line.length = span.length;
                }
                if let Some(misfit) = misfits.next() {
                    line.spans.push(self.span_state(span, points, misfit));
                }
            }
            if let (Some(contact), Some(mold)) = (contact, &scene.mold) {
                line.contact = Some(contact_state(contact, landings[n].as_ref()));
                for segment in &state.lying()[n] {
                    line.spans.push(self.lying_state(contact, segment, mold));
                }
                line.spans.sort_by(|a, b| a.arc[0].total_cmp(&b.arc[0]));
            }
            out.push(line);
        }
        out
    }

    /// Force of a stretched diagonal (N), where the material has a shear curve.
    fn shear_force(&self, shear: &super::CellShear) -> Option<f64> {
        let curve = self.scene.ply.material.shear_curve.as_ref()?;
        let force = shear::force(shear.angle, shear.path, curve.force(shear.angle).0);
        force.is_finite().then_some(force)
    }

    fn cells(&self, snapshot: &Snapshot) -> Vec<Cell> {
        let (across, edges) = (self.scene.ply.grid.nu - 1, self.scene.ply.grid.edges());
        let cell = |(n, shear): (usize, &Option<super::CellShear>)| Cell {
            cell: [n % across, n / across],
            shear_deg: shear.map_or(0.0, |shear| shear.angle.to_degrees()),
            shearing: shear.map(|shear| match shear.falling {
                true => CatenaryDirection::Falling,
                false => CatenaryDirection::Rising,
            }),
            landed_deg: [0, 1].map(|k| {
                let contact = snapshot.contacts[edges + 2 * n + k].as_ref()?;
                contact.landed.map(|landed| landed.shear.to_degrees())
            }),
        };
        snapshot.shear.iter().enumerate().map(cell).collect()
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
            let caught = step.catenaries.iter().filter(|c| c.contact.is_some());
            caught.map(|c| CatenaryId { kind: c.kind, from: c.from, to: c.to }).collect()
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
        }
    }

    fn span_state(&self, span: &FreeSpan, points: Vec<Point>, misfit: &Misfit) -> SpanState {
        SpanState {
            arc: [span.start, span.start + span.length],
            length: span.length,
            run: span.run(),
            rise: span.ends[1][2] - span.ends[0][2],
            state: match span.state {
                _ if span.shearing => Hold::Straight,
                catenary::SpanState::Hanging => Hold::Hanging,
                catenary::SpanState::Overstretched => Hold::Overstretched,
                catenary::SpanState::Straight => Hold::Straight,
            },
            force: span.force,
            slopes: span.slopes,
            prescribed: span.prescribed,
            points,
            ..self.fitted(misfit)
        }
    }

    /// A segment that lies on the mold, or one of no length; `None` for a catenary that lies whole.
    fn lying_state(
        &self,
        contact: &ContactSegment,
        segment: &LyingSegment,
        mold: &Mold,
    ) -> SpanState {
        let LyingSegment { which, misfit, line } = segment;
        let arc = match which {
            None => [0.0, contact.length],
            Some(0) => [0.0, contact.arc()[0]],
            Some(_) => [contact.arc()[1], contact.length],
        };
        let [a, b] = [line.points[0], line.end()];
        let run = (b[0] - a[0]).hypot(b[1] - a[1]);
        let slope = if run > 0.0 { (b[2] - a[2]) / run } else { 0.0 };
        // its slack stands up as a ruck in its middle; a catenary that lies whole is drawn by its contact
        let ruck = self.ruck(misfit);
        let points = match which {
            Some(_) if misfit.length > 0.0 => (0..STATIONS)
                .map(|n| {
                    let s = line.length() * n as f64 / (STATIONS - 1) as f64;
                    let place = line.at(s);
                    let height = ruck.map_or(0.0, |ruck| ruck.at(s - 0.5 * line.length()));
                    along(place, height, mold.normal(place))
                })
                .collect(),
            _ => Vec::new(),
        };
        SpanState {
            arc,
            length: misfit.length,
            run,
            rise: b[2] - a[2],
            slopes: [slope; 2],
            points,
            ..self.fitted(misfit)
        }
    }

    fn ruck(&self, misfit: &Misfit) -> Option<Ruck> {
        let ply = &self.scene.ply;
        let line = ply.line(ply.grid.catenary(misfit.catenary).kind);
        Ruck::of(misfit.slack(), line.flexural_rigidity, line.mass * self.scene.settings.gravity)
    }

    /// What a segment has of its misfit; it lies, and all else is empty.
    fn fitted(&self, misfit: &Misfit) -> SpanState {
        let length = misfit.length;
        SpanState {
            arc: [0.0; 2],
            length,
            run: 0.0,
            rise: 0.0,
            state: Hold::Lying,
            force: None,
            slopes: [0.0; 2],
            prescribed: [false; 2],
            points: Vec::new(),
            slack_mm: misfit.slack() * 1e3,
            slack_ratio: if length > 0.0 { misfit.slack() / length } else { 0.0 },
            wrinkle_mm: self.ruck(misfit).map_or(0.0, |ruck| ruck.height() * 1e3),
            overstretch_mm: misfit.overstretch() * 1e3,
            overstretch: misfit.overstretch() / misfit.whole,
        }
    }
}

fn contact_state(contact: &ContactSegment, landing: Option<&Landing>) -> ContactState {
    let errors = |landing: &Landing| landing.errors.iter().map(|e| e.map(|e| e * 1e3)).collect();
    let angle = landing.and_then(|landing| landing.fibre_angle);
    ContactState {
        arc: contact.arc(),
        points: contact.line.points.clone(),
        landing_error_mm: landing.map(errors),
        fibre_angle_deg: angle.map(|(angle, _)| angle.to_degrees()),
    }
}

/// The kind of a catenary as the record has it.
fn described(kind: Kind) -> (CatenaryKind, CatenaryDirection) {
    match kind {
        Kind::EdgeU => (CatenaryKind::Edge, CatenaryDirection::U),
        Kind::EdgeV => (CatenaryKind::Edge, CatenaryDirection::V),
        Kind::Rising => (CatenaryKind::Diagonal, CatenaryDirection::Rising),
        Kind::Falling => (CatenaryKind::Diagonal, CatenaryDirection::Falling),
    }
}
