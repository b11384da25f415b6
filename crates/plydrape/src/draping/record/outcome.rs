//! How a drape came out: worst values of every step, limits, the verdict.

use super::CatenaryKind;
use crate::ply::GripperId;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// A worst value and where it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Worst {
    /// The value, in the unit that the measure names.
    pub value: f64,
    /// Which part of the ply: a catenary, a cell or a gripper, in words.
    #[serde(rename = "where")]
    pub at: String,
    /// Place in space (m).
    pub place: [f64; 3],
}

/// Worst values of one step; null where a measure has no meaning.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measures {
    /// Slack (mm).
    pub slack_mm: Option<Worst>,
    /// Slack of all rests of a catenary as a share of its length.
    pub slack_ratio: Option<Worst>,
    /// Wrinkle amplitude of the worst slack (mm).
    pub wrinkle_mm: Option<Worst>,
    /// Chord of an edge's span beyond its free length, as a share of the whole edge.
    pub overstretch: Option<Worst>,
    /// Chord of an edge's span beyond its free length (mm).
    pub overstretch_mm: Option<Worst>,
    /// Gap of a bridge (mm).
    pub bridging_mm: Option<Worst>,
    /// Shear angle (°).
    pub shear_deg: Option<Worst>,
    /// Gripper tilt (°).
    pub tilt_deg: Option<Worst>,
    /// Horizontal force (N).
    pub force_n: Option<Worst>,
    /// Distance of landed points and landed grippers from their ideal place (mm).
    pub landing_error_mm: Option<Worst>,
    /// Angle between landed edges and the fibres of the ideal drape (°).
    pub fibre_angle_deg: Option<Worst>,
    /// Largest distance between ply and mold (mm).
    pub gap_mm: Option<Worst>,
    /// Smallest distance between any two grippers (mm).
    pub gripper_distance_mm: Option<Worst>,
    /// Farthest that a gripper is outside the workspace (mm), where there is one.
    pub workspace_mm: Option<Worst>,
    /// Share of the edges' length that lies on the mold.
    pub contact_share: Option<f64>,
}

/// The worst values as plain numbers.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numbers {
    /// Slack (mm).
    pub slack_mm: Option<f64>,
    /// Slack of all rests of a catenary as a share of its length.
    pub slack_ratio: Option<f64>,
    /// Overstretch of an edge, as a share of the whole edge.
    pub overstretch: Option<f64>,
    /// Gap of a bridge (mm).
    pub bridging_mm: Option<f64>,
    /// Shear angle (°).
    pub shear_deg: Option<f64>,
    /// Gripper tilt (°).
    pub tilt_deg: Option<f64>,
    /// Landing error (mm).
    pub landing_error_mm: Option<f64>,
    /// Angle between landed edges and the fibres of the ideal drape (°).
    pub fibre_angle_deg: Option<f64>,
}

/// A limit and whether it holds.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Verdict {
    /// Key of the limit in the scene.
    pub name: Cow<'static, str>,
    /// Worst value, in the unit of the limit as reported.
    pub value: f64,
    /// The limit, in the same unit: the least allowed of `contact_share` and `gripper_distance`, else the most.
    pub limit: f64,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// Whether it holds.
    pub ok: bool,
    /// Step of the worst value; none where it belongs to no step, as the speed of a motion.
    pub step: Option<usize>,
    /// Place of the worst value, in words.
    #[serde(rename = "where")]
    pub at: String,
    /// Place of the worst value in space (m), where it has one.
    pub place: Option<[f64; 3]>,
}

/// A catenary by its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CatenaryId {
    /// `edge` or `diagonal`.
    pub kind: CatenaryKind,
    /// Gripper at its first end.
    pub from: GripperId,
    /// Gripper at its second end.
    pub to: GripperId,
}

/// The outcome of a drape: what `plydrape simulate --json` prints, but for its timing.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Summary {
    /// Every limit holds.
    pub accepted: bool,
    /// Steps done.
    pub steps: usize,
    /// Steps of the scene; more than `steps` if the run was interrupted.
    pub steps_planned: usize,
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
    #[serde(rename = "final")]
    pub last: Numbers,
    /// Share of the edges' length that lies on the mold at the end.
    pub contact_share: Option<f64>,
    /// Every limit, judged.
    pub limits: Vec<Verdict>,
    /// Equilibria solved.
    pub equilibria: usize,
}

impl Summary {
    /// Judges the drape by more limits, such as those of the motion that it came from.
    pub fn judge_also(&mut self, verdicts: impl IntoIterator<Item = Verdict>) {
        for verdict in verdicts {
            self.accepted &= verdict.ok;
            self.limits.push(verdict);
        }
    }
}
