//! From snapshots to the record: what every step looked like, and the verdict at the end.

use super::Snapshot;
use super::attitude::{Attitude, attitude};
use super::crossing::{STATIONS, hanging, lowered};
use super::landing::{Landing, landing};
use super::measures::{self, LyingRest, described, fit, name};
use super::record::{
    Bridging, CatenaryDirection, CatenaryId, CatenaryState, Cell, ContactState, FORMAT, Gripper,
    Hold, Measures, Numbers, ResultFile, SceneEcho, Solver as SolverRecord, SpanState, Step,
    Summary, VERSION, Verdict, Worst,
};
use super::spans::{FreeSpan, Point};
use crate::catenary;
use crate::equilibrium::{Solver, Status};
use crate::mold::vector::along;
use crate::mold::{Mold, distance};
use crate::ply::{Laid, shear};
use crate::scene::Scene;

/// Collects the steps of a drape.
pub struct Report<'a> {
    scene: &'a Scene,
    steps: Vec<Step>,
    quaternions: Vec<Option<[f64; 4]>>,
}

impl<'a> Report<'a> {
    pub fn new(scene: &'a Scene) -> Self {
        Report {
            scene,
            steps: Vec::with_capacity(scene.motion.positions.len()),
            quaternions: vec![None; scene.ply.grid.grippers()],
        }
    }

    /// Records a step.
    pub fn add(&mut self, snapshot: &Snapshot, solver: &Solver) {
        let (scene, grid) = (self.scene, self.scene.ply.grid);
        let spans = &snapshot.shape.spans;
        let mut points: Vec<Vec<Point>> = spans.iter().map(hanging).collect();
        let attitudes: Vec<Attitude> = (0..grid.grippers())
            .map(|n| attitude(solver, grid, &snapshot.positions, n, self.quaternions[n]))
            .collect();
        let landings: Vec<Option<Landing>> = (snapshot.laid.iter().enumerate())
            .map(|(n, laid)| laid.as_ref().and_then(|laid| landing(scene, n, laid)))
            .collect();
        let measures = measures::measures(scene, snapshot, &attitudes, &points, &landings);
        for (span, through) in lowered(scene, spans, &snapshot.laid) {
            points[span] = through;
        }
        let mut grippers = Vec::with_capacity(grid.grippers());
        for (n, attitude) in attitudes.iter().enumerate() {
            self.quaternions[n] = Some(attitude.quaternion);
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
        let equilibrium = snapshot.shape.equilibrium;
        self.steps.push(Step {
            step: snapshot.step,
            time: snapshot.time,
            grippers,
            solver: SolverRecord {
                status: equilibrium.status,
                iterations: equilibrium.iterations,
                residual: equilibrium.residual,
                equilibria: snapshot.equilibria,
            },
            catenaries: self.catenaries(snapshot, points, &landings),
            cells: self.cells(snapshot),
            measures,
        });
    }

    fn catenaries(
        &self,
        snapshot: &Snapshot,
        points: Vec<Vec<Point>>,
        landings: &[Option<Landing>],
    ) -> Vec<CatenaryState> {
        let (scene, grid) = (self.scene, self.scene.ply.grid);
        let mut spans = snapshot.shape.spans.iter().zip(points).peekable();
        let mut out = Vec::with_capacity(grid.catenaries());
        for n in 0..grid.catenaries() {
            let c = grid.catenary(n);
            let (kind, direction) = described(c.kind);
            let laid = snapshot.laid[n].as_ref();
            let shear = (n >= grid.edges())
                .then(|| snapshot.shear[(n - grid.edges()) / 2])
                .flatten()
                .filter(|shear| shear.falling == (direction == CatenaryDirection::Falling));
            let mut state = CatenaryState {
                kind,
                direction,
                from: c.from,
                to: c.to,
                length: laid.map_or_else(|| scene.ply.flat_length(c.kind), |laid| laid.length),
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
                if laid.is_none() {
                    state.length = span.length;
                }
                state.spans.push(span_state(span, points, state.length));
            }
            if let (Some(laid), Some(mold)) = (laid, &scene.mold) {
                let grippers = [c.from, c.to].map(|g| snapshot.positions[grid.index(g)]);
                state.contact = Some(ContactState {
                    arc: laid.arc(),
                    points: laid.line.points.clone(),
                    landing_error_mm: landings[n].as_ref().map(|landing| {
                        landing.errors.iter().map(|e| e.map(|error| error * 1e3)).collect()
                    }),
                    fibre_angle_deg: (landings[n].as_ref())
                        .and_then(|landing| landing.fibre_angle)
                        .map(|(angle, _)| angle.to_degrees()),
                });
                let tolerance = scene.settings.contact.tolerance;
                for rest in measures::lying_rests(laid, grippers, mold, tolerance) {
                    state.spans.push(lying_state(laid, &rest, mold));
                }
                state.spans.sort_by(|a, b| a.arc[0].total_cmp(&b.arc[0]));
            }
            out.push(state);
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
        let across = self.scene.ply.grid.nu - 1;
        let cell = |(n, shear): (usize, &Option<super::CellShear>)| Cell {
            cell: [n % across, n / across],
            shear_deg: shear.map_or(0.0, |shear| shear.angle.to_degrees()),
            shearing: shear.map(|shear| match shear.falling {
                true => CatenaryDirection::Falling,
                false => CatenaryDirection::Rising,
            }),
        };
        snapshot.shear.iter().enumerate().map(cell).collect()
    }

    /// The whole record, judged.
    pub fn finish(self) -> ResultFile {
        let scene = self.scene;
        let echo = SceneEcho {
            title: scene.title.clone(),
            input: scene.input.clone(),
            grid: scene.ply.grid,
            cell: scene.ply.cell,
            material: scene.ply.material.clone(),
            warp: scene.ply.warp,
            mold: scene.mold.clone(),
            target_grippers: scene.target.as_ref().map(|target| target.grippers.clone()),
            ideal_drape: scene.target.as_ref().and_then(|target| target.drape.clone()),
            settings: scene.settings,
            limits: scene.limits,
        };
        let summary = self.summary();
        ResultFile {
            format: FORMAT.into(),
            version: VERSION,
            checksum: String::new(),
            program: crate::PROGRAM.into(),
            scene: echo,
            plan: None,
            steps: self.steps,
            summary,
        }
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
        let limits = self.verdicts();
        let last = self.steps.last();
        Summary {
            accepted: limits.iter().all(|verdict| verdict.ok)
                && self.steps.len() == self.scene.motion.positions.len(),
            steps: self.steps.len(),
            steps_planned: self.scene.motion.positions.len(),
            first_contact_step: first.map(|step| step.step),
            first_contact,
            first_shear_step: first_shear.map(|step| step.step),
            all_shear_step: all_shear.map(|step| step.step),
            worst: numbers(|pick| self.worst(pick).map(|(_, worst)| worst.value)),
            last: numbers(|pick| last.and_then(|s| pick(&s.measures).as_ref()).map(|w| w.value)),
            contact_share: last.and_then(|step| step.measures.contact_share),
            limits,
            equilibria: self.steps.iter().map(|step| step.solver.equilibria).sum(),
        }
    }

    /// The worst of a measure over all steps, the first one where several are equal.
    fn worst(&self, pick: impl Fn(&Measures) -> &Option<Worst>) -> Option<(usize, &Worst)> {
        self.extreme(pick, |value, before| value > before)
    }

    /// The value of a measure over all steps that beats all others, the first one where several are equal.
    fn extreme(
        &self,
        pick: impl Fn(&Measures) -> &Option<Worst>,
        beats: impl Fn(f64, f64) -> bool,
    ) -> Option<(usize, &Worst)> {
        let mut out: Option<(usize, &Worst)> = None;
        for step in &self.steps {
            if let Some(worst) = pick(&step.measures)
                && out.is_none_or(|(_, before)| beats(worst.value, before.value))
            {
                out = Some((step.step, worst));
            }
        }
        out
    }

    /// Every limit that applies to the scene, see [`crate::scene::Limits`].
    fn verdicts(&self) -> Vec<Verdict> {
        let (limits, settings) = (&self.scene.limits, &self.scene.settings);
        let mut out = Vec::new();
        let mut judge = |name: &'static str,
                         unit: &'static str,
                         scale: f64,
                         limit: f64,
                         found: Option<(usize, &Worst)>| {
            let Some((step, worst)) = found else { return };
            let value = worst.value * scale;
            // a bound that holds a slope exactly at its limit is no breach
            let ok = value <= limit * (1.0 + 1e-9);
            let (step, at) = (Some(step), worst.at.clone());
            let place = Some(worst.place);
            let (name, unit) = (name.into(), unit.into());
            out.push(Verdict { name, value, limit, unit, ok, step, at, place });
        };
        let last = self.steps.last();
        let at_end = |pick: fn(&Measures) -> &Option<Worst>| {
            last.and_then(|step| pick(&step.measures).as_ref().map(|worst| (step.step, worst)))
        };
        let everywhere = |pick: fn(&Measures) -> &Option<Worst>| self.worst(pick);
        judge("overstretch", "%", 1e2, limits.overstretch * 1e2, everywhere(|m| &m.overstretch));
        judge("tilt", "°", 1.0, limits.tilt.to_degrees(), everywhere(|m| &m.tilt_deg));
        judge("shear", "°", 1.0, limits.shear.to_degrees(), everywhere(|m| &m.shear_deg));
        if let Some(force) = limits.force {
            judge("force", "N", 1.0, force, everywhere(|m| &m.force_n));
        }
        if limits.workspace.is_some() {
            judge("workspace", "mm", 1.0, 0.0, everywhere(|m| &m.workspace_mm));
        }
        if let (Some(target), Some(step)) = (&self.scene.target, last) {
            if self.scene.mold.is_some() {
                judge(
                    "slack_ratio",
                    "%",
                    1e2,
                    limits.slack_ratio * 1e2,
                    at_end(|m| &m.slack_ratio),
                );
                judge("bridging", "mm", 1.0, limits.bridging * 1e3, at_end(|m| &m.bridging_mm));
            }
            let contact = step.catenaries.iter().enumerate().filter_map(|(n, c)| {
                let contact = c.contact.as_ref()?;
                let errors = contact.landing_error_mm.as_ref()?;
                let known =
                    errors.iter().zip(&contact.points).filter_map(|(e, p)| Some(((*e)?, *p)));
                let (value, place) = known.max_by(|a, b| a.0.total_cmp(&b.0))?;
                Some(Worst { value, at: name(self.scene, n), place })
            });
            let contact = contact.max_by(|a, b| a.value.total_cmp(&b.value));
            let found = contact.as_ref().map(|worst| (step.step, worst));
            judge("landing_contact", "mm", 1.0, limits.landing_contact * 1e3, found);
            let gripper =
                step.grippers.iter().zip(&target.grippers).map(|(gripper, place)| Worst {
                    value: distance(gripper.position, *place) * 1e3,
                    at: format!("gripper [{},{}]", gripper.id[0], gripper.id[1]),
                    place: gripper.position,
                });
            let gripper = gripper.max_by(|a, b| a.value.total_cmp(&b.value));
            let found = gripper.as_ref().map(|worst| (step.step, worst));
            judge("landing_gripper", "mm", 1.0, limits.landing_gripper * 1e3, found);
            let fibre = at_end(|m| &m.fibre_angle_deg);
            judge("fibre_angle", "°", 1.0, limits.fibre_angle.to_degrees(), fibre);
            if let Some(share) = step.measures.contact_share {
                out.push(Verdict {
                    name: "contact_share".into(),
                    value: share * 1e2,
                    limit: limits.contact_share * 1e2,
                    unit: "%".into(),
                    ok: share >= limits.contact_share,
                    step: Some(step.step),
                    at: "all edges".into(),
                    place: None,
                });
            }
        }
        let closest = self.extreme(|m| &m.gripper_distance_mm, |value, before| value < before);
        if let Some((step, worst)) = closest {
            let limit = limits.gripper_distance * 1e3;
            out.push(Verdict {
                name: "gripper_distance".into(),
                value: worst.value,
                limit,
                unit: "mm".into(),
                // as above
                ok: worst.value >= limit * (1.0 - 1e-9),
                step: Some(step),
                at: worst.at.clone(),
                place: Some(worst.place),
            });
        }
        if let Some(step) = self.steps.iter().find(|step| step.solver.status != Status::Converged) {
            out.push(Verdict {
                name: "equilibrium".into(),
                value: step.solver.residual,
                limit: 1e-6,
                unit: "slope".into(),
                ok: false,
                step: Some(step.step),
                at: format!(
                    "solver {} with max_tilt {:.1}°",
                    step.solver.status.name(),
                    settings.max_tilt.to_degrees()
                ),
                place: None,
            });
        }
        out
    }
}

fn numbers(pick: impl Fn(fn(&Measures) -> &Option<Worst>) -> Option<f64>) -> Numbers {
    Numbers {
        slack_mm: pick(|m| &m.slack_mm),
        slack_ratio: pick(|m| &m.slack_ratio),
        overstretch: pick(|m| &m.overstretch),
        bridging_mm: pick(|m| &m.bridging_mm),
        shear_deg: pick(|m| &m.shear_deg),
        tilt_deg: pick(|m| &m.tilt_deg),
        landing_error_mm: pick(|m| &m.landing_error_mm),
        fibre_angle_deg: pick(|m| &m.fibre_angle_deg),
    }
}

fn span_state(span: &FreeSpan, points: Vec<Point>, whole: f64) -> SpanState {
    let fit = fit(span);
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
        slack_mm: fit.slack() * 1e3,
        slack_ratio: fit.slack_ratio(),
        wrinkle_mm: fit.wrinkle() * 1e3,
        overstretch_mm: fit.overstretch() * 1e3,
        overstretch: fit.overstretch() / whole,
    }
}

/// A rest that lies on the mold, or one of no length; `None` for a catenary that lies whole.
fn lying_state(laid: &Laid, rest: &LyingRest, mold: &Mold) -> SpanState {
    let LyingRest { which, fit, line } = rest;
    let arc = match which {
        None => [0.0, laid.length],
        Some(0) => [0.0, laid.arc()[0]],
        Some(_) => [laid.arc()[1], laid.length],
    };
    let [a, b] = [line.points[0], line.end()];
    let run = (b[0] - a[0]).hypot(b[1] - a[1]);
    let slope = if run > 0.0 { (b[2] - a[2]) / run } else { 0.0 };
    // its slack stands up as a wrinkle, half a sine; a catenary that lies whole is drawn by its contact
    let points = match which {
        Some(_) if fit.length > 0.0 => (0..STATIONS)
            .map(|n| {
                let t = n as f64 / (STATIONS - 1) as f64;
                let place = line.at(t * line.length());
                let height = fit.wrinkle() * (std::f64::consts::PI * t).sin();
                along(place, height, mold.normal(place))
            })
            .collect(),
        _ => Vec::new(),
    };
    SpanState {
        arc,
        length: fit.length,
        run,
        rise: b[2] - a[2],
        state: Hold::Lying,
        force: None,
        slopes: [slope; 2],
        prescribed: [false; 2],
        points,
        slack_mm: fit.slack() * 1e3,
        slack_ratio: fit.slack_ratio(),
        wrinkle_mm: fit.wrinkle() * 1e3,
        overstretch_mm: fit.overstretch() * 1e3,
        overstretch: fit.overstretch() / laid.length,
    }
}
