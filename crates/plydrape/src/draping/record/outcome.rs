//! How a drape came out: worst values of every step, limits, the verdict.

use crate::errors::{SampleVerdict, Stands};
use crate::measure::{Name, Numbers, Site, Subject, Verdict, Worst};
use crate::ply::{GripperId, Kind};
use crate::scene::Scene;
use crate::sheet;
use crate::sheet::event::last_release;
use crate::tool::ToolRecord;

/// A catenary by its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CatenaryId {
    /// Its family.
    pub kind: Kind,
    /// Gripper at its first end.
    pub from: GripperId,
    /// Gripper at its second end.
    pub to: GripperId,
}

/// The outcome of a drape: what `plydrape simulate --json` prints, but for its timing. All but `accepted` and `sheet` is that
/// of the catenaries.
#[derive(Debug, Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Summary {
    /// Every limit holds, by the model that decides, and in as many cells of the sample as must keep them.
    pub accepted: bool,
    /// Steps done.
    pub steps: usize,
    /// Steps of the scene; more than `steps` if the run was interrupted or stopped.
    pub steps_planned: usize,
    /// Why the drape ended before its last step, if no ply would have survived it.
    pub stopped: Option<String>,
    /// First step with contact.
    pub first_contact_step: Option<usize>,
    /// The catenaries that touched in that step.
    pub first_contact: Vec<CatenaryId>,
    /// First step in which a cell shears.
    pub first_shear_step: Option<usize>,
    /// First step in which all cells shear.
    pub all_shear_step: Option<usize>,
    /// Worst values over all steps.
    pub worst: Numbers,
    /// The same of the last step.
    #[cfg_attr(feature = "serde", serde(rename = "final"))]
    pub last: Numbers,
    /// Share of the edges' length that lies on the mold at the end.
    pub contact_share: Option<f64>,
    /// Every limit, judged.
    pub limits: Vec<Verdict>,
    /// Equilibria solved.
    pub equilibria: usize,
    /// The outcome of the same drape by the sheet, which then decides; none where the catenaries decide.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub sheet: Option<sheet::measure::Summary>,
    /// The verdict over a sample of cells with the errors of the scene; none where the scene has none.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub sample: Option<SampleVerdict>,
    /// The largest errors that the motion stands; none where it was not asked for.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub stands: Option<Stands>,
    /// What the motion takes of the tool; none where each gripper moves by itself.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub tool: Option<ToolRecord>,
}

impl Summary {
    /// Whether somebody broke it off before its last step.
    #[must_use]
    pub fn interrupted(&self) -> bool {
        let sheet = self.sheet.as_ref().map(|sheet| sheet.status);
        self.catenaries_interrupted() || sheet == Some(sheet::Status::Interrupted)
    }

    /// Whether somebody broke the drape by the catenaries off.
    #[must_use]
    pub fn catenaries_interrupted(&self) -> bool {
        self.steps < self.steps_planned && self.stopped.is_none()
    }

    /// Whether every limit of the catenaries holds, through all steps.
    #[must_use]
    pub fn catenaries_accepted(&self) -> bool {
        self.steps == self.steps_planned && self.limits.iter().all(|verdict| verdict.ok)
    }

    /// Whether every limit of the motion alone holds, whichever model drapes.
    #[must_use]
    pub fn motion_accepted(&self) -> bool {
        let of_motion = |v: &&Verdict| v.name.measure().subject() == Subject::Motion;
        self.limits.iter().filter(of_motion).all(|verdict| verdict.ok)
    }

    /// Whether every limit holds by the model that decides, whatever a sample of cells with errors says.
    #[must_use]
    pub fn accepted_without_errors(&self) -> bool {
        match &self.sheet {
            Some(sheet) => sheet.accepted && self.motion_accepted(),
            None => self.catenaries_accepted(),
        }
    }

    /// Lets the sheet decide: the drape is accepted if all limits of the sheet and of the motion hold. The motion takes until the last
    /// pads have let go.
    pub fn decide_by(&mut self, sheet: sheet::measure::Summary) {
        if let Some(released) = last_release(&sheet.events) {
            self.takes_until(released);
        }
        self.accepted = sheet.accepted && self.motion_accepted();
        self.sheet = Some(sheet);
    }

    /// Takes a later end of the motion (s) for how long it takes, and judges that if the scene limits it.
    fn takes_until(&mut self, end: f64) {
        let later = |time: f64| time < end;
        for numbers in [&mut self.worst, &mut self.last] {
            if numbers.value(Name::Duration).is_some_and(later) {
                numbers.set(Name::Duration, Some(Some(end)));
            }
        }
        for verdict in self.limits.iter_mut().filter(|verdict| verdict.name == Name::Duration) {
            let Verdict { value, limit, step, at, place, .. } = verdict.clone();
            if later(value) {
                *verdict =
                    Verdict::of(Name::Duration, Worst { value: end, at, place }, limit, step);
            }
        }
    }

    /// Keeps what the motion takes of the tool of a scene, in place of what was kept before, and judges its residual if the
    /// scene limits that.
    pub fn follow_tool(&mut self, scene: &Scene, record: ToolRecord) {
        self.limits.retain(|verdict| verdict.name != Name::ToolResidual);
        if let Some(limit) = Name::ToolResidual.measure().limit(scene) {
            let at = Site::Gripper(record.gripper).label(scene);
            let worst = Worst { value: record.residual_mm, at, place: None };
            self.judge_also([Verdict::of(Name::ToolResidual, worst, limit, Some(record.step))]);
        }
        self.tool = Some(record);
    }

    /// Judges the drape by more limits, such as those of the motion that it came from.
    pub fn judge_also(&mut self, verdicts: impl IntoIterator<Item = Verdict>) {
        for mut verdict in verdicts {
            // an interrupted drape ends before the motion does
            verdict.step = verdict.step.filter(|step| *step <= self.steps);
            self.accepted &= verdict.ok;
            self.limits.push(verdict);
        }
    }
}
