//! How a drape came out: worst values, limits, and the verdict that follows from them.

use super::{RateTolerance, SampleVerdict, Tolerance};
use crate::draping::record::CatenaryId;
use crate::layup::{Layup, Model};
use crate::measure::{self, Limits, Name, Numbers, Verdict};
use crate::scene::{Scene, World};
use crate::sheet::{self, Event};
use crate::state::Site;
use crate::tool::ToolRecord;

/// How a drape ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Status {
    /// Every step was done, and the ply is at rest.
    Converged,
    /// Every step was done, but the ply still moves.
    NotAtRest,
    /// A step could not be solved: the drape ends before it.
    NotSolved,
    /// No ply would survive the last step, see [`Summary::stopped`].
    Torn,
    /// It was broken off.
    Interrupted,
}

/// The outcome of a drape by one model: what `plydrape simulate --json` prints of the model that decides, but for its timing.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(remote = "Self"))]
pub struct Summary {
    /// The model that draped.
    pub model: Model,
    /// In which world it is judged; written beside `accepted`.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub world: World,
    /// How the drape ended.
    pub status: Status,
    /// Steps done.
    pub steps: usize,
    /// Steps of the motion; more than `steps` if the drape ended before the motion does.
    pub steps_planned: usize,
    /// Why the drape ended before its last step, if no ply would have survived it.
    pub stopped: Option<String>,
    /// Worst values over all steps.
    pub worst: Numbers,
    /// Values of the last step.
    #[cfg_attr(feature = "serde", serde(rename = "final"))]
    pub last: Numbers,
    /// Root mean square of the height over the area at the end (mm); `None` without a mold, and of catenaries.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub height_rms_mm: Option<f64>,
    /// Share of the area that is higher than the limit of the height at the end; `None` where there is no height.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub height_share: Option<f64>,
    /// Root mean square of the distance of landed points from their ideal places over their area (mm); `None` where those are not known.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub position_rms_mm: Option<f64>,
    /// Every limit, judged; nothing of the model that does not decide.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub limits: Vec<Verdict>,
    /// When pads grip, press and let go, in the order of time; nothing where they hold to the end.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub events: Vec<Event>,
    /// What the sheet says beside; `None` of catenaries.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub sheet: Option<sheet::Report>,
    /// What the catenaries say beside; `None` of the sheet.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub catenaries: Option<CatenaryReport>,
    /// The verdict over a sample of cells with the errors of the scene; `None` if the scene has none.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub sample: Option<SampleVerdict>,
    /// What the motion tolerates; `None` where it was not asked for.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tolerance: Option<Tolerance>,
    /// How fast the ply may be draped along the motion; `None` of a ply without resin, and of one that is draped quasi-statically.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub rate_tolerance: Option<RateTolerance>,
    /// What the motion takes of the tool; `None` where each gripper moves by itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tool: Option<ToolRecord>,
}

/// What a drape by catenaries says beside its measures.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CatenaryReport {
    /// First step with contact.
    pub first_contact_step: Option<usize>,
    /// The catenaries that touched in that step.
    pub first_contact: Vec<CatenaryId>,
    /// First step in which a cell shears.
    pub first_shear_step: Option<usize>,
    /// First step in which all cells shear.
    pub all_shear_step: Option<usize>,
    /// Equilibria solved.
    pub equilibria: usize,
}

impl Summary {
    /// Whether every step was done, every limit holds, and as many cells of the sample keep them as must.
    #[must_use]
    pub fn accepted(&self) -> bool {
        self.accepted_without_errors() && self.sample.as_ref().is_none_or(|sample| sample.ok)
    }

    /// Whether every step was done and every limit holds, whatever a sample of cells with errors says.
    #[must_use]
    pub fn accepted_without_errors(&self) -> bool {
        self.status == Status::Converged && self.limits.iter().all(|verdict| verdict.ok)
    }

    /// The verdict in words, with its world: `accepted in an ideal cell, without errors`, or `not accepted`.
    #[must_use]
    pub fn verdict(&self) -> String {
        match self.accepted() {
            true => format!("accepted{}", self.world.words()),
            false => "not accepted".into(),
        }
    }

    /// Without what judges the drape: that of the model that does not decide.
    #[must_use]
    pub fn unjudged(self) -> Self {
        let world = World::default();
        Summary {
            world,
            limits: Vec::new(),
            sample: None,
            tolerance: None,
            rate_tolerance: None,
            tool: None,
            ..self
        }
    }

    /// Whether the drape was broken off.
    #[must_use]
    pub fn interrupted(&self) -> bool {
        self.status == Status::Interrupted
    }

    /// The first step in which the ply touches the mold.
    #[must_use]
    pub fn first_contact_step(&self) -> Option<usize> {
        let catenaries = self.catenaries.as_ref().and_then(|report| report.first_contact_step);
        catenaries.or(self.sheet.as_ref().and_then(|report| report.first_contact_step))
    }

    /// The index of the last step, in a motion of this number of steps, at which nothing that happens depends on the mold: two before the first
    /// contact, or the last step of a motion that ends in the air.
    #[must_use]
    pub fn last_free(&self, steps: usize) -> usize {
        self.first_contact_step()
            .unwrap_or(steps + 1)
            .saturating_sub(2)
            .min(steps.saturating_sub(1))
    }

    /// Keeps what the motion takes of the tool of a scene, in place of what was kept before, and judges its residual if the
    /// scene limits that.
    pub fn follow_tool(&mut self, scene: &Scene, record: ToolRecord) {
        self.limits.retain(|verdict| verdict.name != Name::ToolResidual);
        if let Some(limit) = Name::ToolResidual.limit(&scene.layup, &scene.limits) {
            let at = Site::Gripper(record.gripper).label(&scene.layup);
            let worst = crate::measure::Worst { value: record.residual_mm, at, place: None };
            self.judge_also([Verdict::new(Name::ToolResidual, worst, limit, Some(record.step))]);
        }
        self.tool = Some(record);
    }

    /// Judges the drape by more limits, such as those of the motion that it came from; of a limit that it is judged by already, the
    /// worse verdict stays.
    pub fn judge_also(&mut self, verdicts: impl IntoIterator<Item = Verdict>) {
        for mut verdict in verdicts {
            // an interrupted drape ends before the motion does
            verdict.step = verdict.step.filter(|step| *step <= self.steps);
            match self.limits.iter_mut().find(|other| other.name == verdict.name) {
                Some(other) if verdict.ratio() > other.ratio() => *other = verdict,
                Some(_) => {}
                None => self.limits.push(verdict),
            }
        }
    }

    /// Judges the drape by a sample of cells too; without one it was broken off, and is not accepted. Returns whether there is one.
    pub(crate) fn judge_sample(&mut self, sample: Option<SampleVerdict>) -> bool {
        match sample {
            Some(_) => self.world = World::Errors,
            None => self.status = Status::Interrupted,
        }
        self.sample = sample;
        self.sample.is_some()
    }

    /// Judges the motion of a layup in time by its steps, as it was given.
    pub fn judge_motion(&mut self, layup: &Layup, limits: &Limits) {
        let last_free = self.last_free(layup.motion.times.len());
        let (verdicts, arm) = measure::verdicts_of_steps(layup, limits, last_free);
        self.judge_also(verdicts);
        if let Some(tool) = &mut self.tool {
            tool.arm = arm;
        }
        self.judge_rest(layup, limits);
    }

    /// Adds a verdict that a limit was not judged for limits of a finished drape on which there is none, so that it is not accepted: for limits
    /// that a scene sets, because a usual limit is of the model that measures it, and for limits of a motion in time.
    pub fn judge_rest(&mut self, layup: &Layup, limits: &Limits) {
        if self.status != Status::Converged {
            return;
        }
        for (name, limit) in limits.unjudged(layup, &self.limits) {
            let why = match name.measure().description().model {
                Some(Model::Sheet) if self.model != Model::Sheet => "the sheet alone measures it",
                Some(Model::Catenaries) if self.model != Model::Catenaries => {
                    "catenaries alone measure it"
                }
                _ => "this scene has nothing to measure it on",
            };
            self.limits.push(Verdict::unjudged(name, limit, why));
        }
    }

    /// Judges by another drape too, along the same motion with a step half-way between all its steps, as [`Summary::judge_beside`].
    pub(crate) fn judge_between(&mut self, between: &super::Judged) {
        // the steps of the motion are the odd ones of the other drape
        let step = |step| step / 2 + 1;
        self.judge_beside(between, "with steps half-way between all steps", step, |_| true);
    }

    /// Judges by another drape too: a limit that `counts` and that it does not keep is not kept, and its verdict says `how` that came.
    /// `step` is the step of the motion in which the other drape had one of its steps. What is measured stays as it is.
    pub(super) fn judge_beside(
        &mut self,
        beside: &super::Judged,
        how: &str,
        step: impl Fn(usize) -> usize,
        counts: impl Fn(&Verdict) -> bool,
    ) {
        for verdict in &mut self.limits {
            let other = beside.limits.iter().find(|other| other.name == verdict.name);
            if let Some(other) = other.filter(|other| verdict.ok && !other.ok && counts(other)) {
                *verdict = Verdict {
                    step: other.step.map(&step),
                    at: format!("{}, {how}", other.at),
                    ..other.clone()
                };
            }
        }
        if self.status == Status::Converged && !beside.complete {
            self.status = Status::NotAtRest;
        }
    }
}

/// The outcome of the model that does not decide, as it is written: without `accepted`, limits and sample.
#[cfg(feature = "serde")]
#[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(transparent)]
pub struct Unjudged<'a>(#[serde(with = "serial::unjudged")] pub std::borrow::Cow<'a, Summary>);

#[cfg(feature = "serde")]
mod serial {
    use super::{Summary, World};
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

    /// Without `accepted`.
    pub(super) mod unjudged {
        use super::Summary;
        use serde::{Deserializer, Serializer, de::Error};
        use std::borrow::Cow;

        pub fn serialize<S: Serializer>(summary: &Summary, to: S) -> Result<S::Ok, S::Error> {
            Summary::serialize(summary, to)
        }

        pub fn deserialize<'de, 'a, D: Deserializer<'de>>(
            from: D,
        ) -> Result<Cow<'a, Summary>, D::Error> {
            let summary = Summary::deserialize(from)?;
            match summary == summary.clone().unjudged() {
                true => Ok(Cow::Owned(summary)),
                false => Err(D::Error::custom("the drape beside is judged")),
            }
        }
    }

    /// With `accepted` in front, which follows from the rest, and the world of that verdict.
    impl Serialize for Summary {
        fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
            #[derive(Serialize)]
            struct Written<'a> {
                accepted: bool,
                world: World,
                #[serde(flatten, serialize_with = "Summary::serialize")]
                summary: &'a Summary,
            }
            Written { accepted: self.accepted(), world: self.world, summary: self }.serialize(to)
        }
    }

    impl<'de> Deserialize<'de> for Summary {
        fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
            #[derive(Deserialize)]
            struct Written {
                accepted: bool,
                world: World,
                #[serde(flatten, deserialize_with = "Summary::deserialize")]
                summary: Summary,
            }
            let Written { accepted, world, summary } = Written::deserialize(from)?;
            let summary = Summary { world, ..summary };
            if accepted != summary.accepted() {
                return Err(D::Error::custom(format!(
                    "`accepted` is {accepted}, and by its limits the drape is {}",
                    if summary.accepted() { "accepted" } else { "not accepted" }
                )));
            }
            Ok(summary)
        }
    }
}
