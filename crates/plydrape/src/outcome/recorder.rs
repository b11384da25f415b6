//! Collects the steps of one drape, and makes the summary at its end.

use super::summary::CatenaryReport;
use super::{Status, Step, Summary};
use crate::draping::Followed;
use crate::draping::record::{CatenaryId, CatenaryStep};
use crate::layup::{Layup, Model};
use crate::measure::{Judge, Limits, Name, last_numbers, worst_numbers};
use crate::scene::World;
use crate::sheet;
use crate::state::PlyState;

/// Collects the steps of one drape.
pub(super) struct Recorder<'a> {
    layup: &'a Layup,
    limits: &'a Limits,
    judge: Judge<'a>,
    steps: Vec<Step>,
    /// What is said of the ply as a whole at the end.
    whole: Whole,
}

/// What is said of the ply as a whole, by the area of its points.
#[derive(Debug, Clone, Copy, Default)]
struct Whole {
    height_rms_mm: Option<f64>,
    height_share: Option<f64>,
    position_rms_mm: Option<f64>,
}

impl<'a> Recorder<'a> {
    pub fn new(layup: &'a Layup, limits: &'a Limits) -> Self {
        Recorder {
            layup,
            limits,
            judge: Judge::new(layup, limits, true),
            steps: Vec::with_capacity(layup.motion.positions.len()),
            whole: Whole::default(),
        }
    }

    /// Measures and records a step; `last` if no other follows. A ply that has been released after the motion is measured with its last
    /// step, whose grippers stay as they were.
    pub fn add(&mut self, state: &PlyState, catenaries: Option<CatenaryStep>, last: bool) {
        let measures = self.judge.see_all(state);
        if last {
            self.whole = Whole::new(state, self.limits);
        }
        match self.steps.last_mut().filter(|before| before.step == state.step) {
            Some(released) => released.measures = measures,
            None => self.steps.push(Step::new(self.layup, state, measures, catenaries)),
        }
    }

    /// The judge of the steps.
    pub fn judge(&self) -> &Judge<'a> {
        &self.judge
    }

    /// The summary and the steps of a drape by the sheet.
    pub fn finish_sheet(self, drape: &sheet::SheetDrape) -> (Summary, Vec<Step>) {
        let status = match drape.status {
            sheet::Status::Converged => Status::Converged,
            sheet::Status::NotAtRest => Status::NotAtRest,
            sheet::Status::NotSolved | sheet::Status::NotInTheAir => Status::NotSolved,
            sheet::Status::Interrupted => Status::Interrupted,
        };
        let events = drape.events.clone();
        let summary = self.summary(Model::Sheet, status);
        (Summary { events, sheet: Some(drape.report.clone()), ..summary }, self.steps)
    }

    /// The summary and the steps of a drape by catenaries.
    pub fn finish_catenaries(self, followed: &Followed) -> (Summary, Vec<Step>) {
        let status = match () {
            () if followed.torn.is_some() => Status::Torn,
            () if followed.steps < self.layup.motion.positions.len() => Status::Interrupted,
            () => Status::Converged,
        };
        let summary = self.summary(Model::Catenaries, status);
        let catenaries = Some(self.catenary_report(followed.equilibria));
        (Summary { stopped: followed.torn.clone(), catenaries, ..summary }, self.steps)
    }

    fn summary(&self, model: Model, status: Status) -> Summary {
        let Whole { height_rms_mm, height_share, position_rms_mm } = self.whole;
        Summary {
            model,
            world: World::new(&self.layup.settings.pad, false),
            status,
            steps: self.steps.last().map_or(0, |step| step.step),
            steps_planned: self.layup.motion.positions.len(),
            stopped: None,
            worst: worst_numbers(self.steps.iter().map(|step| &step.measures)),
            last: last_numbers(self.steps.last().map(|step| &step.measures)),
            height_rms_mm,
            height_share,
            position_rms_mm,
            limits: self.judge.verdicts(),
            events: Vec::new(),
            sheet: None,
            catenaries: None,
            sample: None,
            tolerance: None,
            rate_tolerance: None,
            tool: None,
        }
    }

    fn catenary_report(&self, equilibria: usize) -> CatenaryReport {
        let recorded = || self.steps.iter().filter_map(|s| Some((s.step, s.catenaries.as_ref()?)));
        let touching = |line: &&crate::draping::record::CatenaryState| line.contact.is_some();
        let first = recorded().find(|(_, step)| step.catenaries.iter().any(|c| touching(&c)));
        let id = |c: &crate::draping::record::CatenaryState| CatenaryId {
            kind: c.kind,
            from: c.from,
            to: c.to,
        };
        let shears = |cell: &crate::draping::record::Cell| cell.shearing.is_some();
        let all = |step: &CatenaryStep| !step.cells.is_empty() && step.cells.iter().all(shears);
        CatenaryReport {
            first_contact_step: first.map(|(step, _)| step),
            first_contact: first.map_or_else(Vec::new, |(_, step)| {
                step.catenaries.iter().filter(touching).map(id).collect()
            }),
            first_shear_step: recorded()
                .find(|(_, step)| step.cells.iter().any(shears))
                .map(|(step, _)| step),
            all_shear_step: recorded().find(|(_, step)| all(step)).map(|(step, _)| step),
            equilibria,
        }
    }
}

impl Whole {
    fn new(state: &PlyState, limits: &Limits) -> Self {
        let limit = limits.get(Name::Height);
        let heights = || state.points.iter().filter_map(|p| Some((p.area, p.height?)));
        let area: f64 = heights().map(|(area, _)| area).sum();
        let mean = |squares: f64, area: f64| (area > 0.0).then(|| (squares / area).sqrt() * 1e3);
        let errors = || state.points.iter().filter_map(|p| Some((p.area, p.error?)));
        let landed: f64 = errors().map(|(area, _)| area).sum();
        // an empty sum of numbers is -0
        let above = |limit: f64| {
            let high = heights().filter(|(_, height)| *height > limit);
            high.fold(0.0, |sum, (area, _)| sum + area)
        };
        Whole {
            height_rms_mm: mean(heights().map(|(area, h)| area * h * h).sum(), area),
            height_share: limit.filter(|_| area > 0.0).map(|limit| above(limit) / area),
            position_rms_mm: mean(errors().map(|(area, e)| area * e * e).sum(), landed),
        }
    }
}
