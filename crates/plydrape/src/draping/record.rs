//! The result file: every force, slope, shape, contact and measure of every step.
//!
//! Lengths in metres, forces in newtons, angles in radians, unless the name says otherwise. All other
//! outputs can be made from it.

use crate::equilibrium::Status;
use crate::material::Material;
use crate::mold::Mold;
use crate::motion::{Attitudes, Bounds, MotionError, TimedMotion};
use crate::net::Net;
use crate::ply::{Direction, Grid, GripperId};
use crate::scene::{Limits, PlanMethod, Settings};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use std::fmt;
use std::sync::Arc;

/// Name of the format, the first key of every result file.
pub const FORMAT: &str = "plydrape-result";
/// Version of the format; it grows when a key changes its meaning.
pub const VERSION: u32 = 4;

/// A whole result file.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResultFile {
    /// [`FORMAT`].
    pub format: Cow<'static, str>,
    /// [`VERSION`].
    pub version: u32,
    /// Check sum of the whole file with nothing here; empty until it is written.
    pub checksum: String,
    /// Version of the program that wrote it.
    pub program: String,
    /// The scene, as it was understood.
    pub scene: SceneEcho,
    /// The plan that the drape follows, if it was planned.
    pub plan: Option<PlanRecord>,
    /// One entry a step, the start being step 1.
    pub steps: Vec<Step>,
    /// The outcome.
    pub summary: Summary,
}

/// The scene, as it was understood.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SceneEcho {
    /// Its title.
    pub title: String,
    /// The scene file; none of a scene that was made in a program.
    pub input: Option<Arc<str>>,
    /// Grippers along u and v.
    pub grid: Grid,
    /// Fabric length of a cell along u and v (m).
    pub cell: [f64; 2],
    /// The ply's material.
    pub material: Material,
    /// The grid direction of the warp.
    pub warp: Direction,
    /// The mold, if any.
    pub mold: Option<Mold>,
    /// Final gripper positions of the ideal drape (m), if the ply is to be draped.
    pub target_grippers: Option<Vec<[f64; 3]>>,
    /// The ideal drape, a net, where it is known.
    pub ideal_drape: Option<Arc<Net>>,
    /// Rules of the model.
    pub settings: Settings,
    /// Limits of an accepted drape.
    pub limits: Limits,
}

/// A plan: what a motion is made from again, see [`ResultFile::motion`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PlanRecord {
    /// The planner.
    pub method: PlanMethod,
    /// Drapes that the search took.
    pub evaluations: usize,
    /// Samples a second of the motion as it is written (Hz).
    pub rate: f64,
    /// Planned positions of all grippers (m): control points of the smooth path, one list a step.
    pub path: Vec<Vec<[f64; 3]>>,
}

impl ResultFile {
    /// The motion of a planned drape at any time, and the orientations along it; none of a simulated one.
    ///
    /// # Errors
    /// [`MotionError`] if plan and steps are none that a planner has written.
    pub fn motion(&self) -> Result<Option<(TimedMotion, Attitudes)>, MotionError> {
        let Some(plan) = &self.plan else { return Ok(None) };
        let motion = TimedMotion::new(&plan.path, &Bounds::from(&self.scene.limits))?;
        Ok(Some((motion, self.attitudes()?)))
    }

    /// Orientations of the grippers between the steps.
    ///
    /// # Errors
    /// [`MotionError`] if there are no steps.
    pub fn attitudes(&self) -> Result<Attitudes, MotionError> {
        let times: Vec<f64> = self.steps.iter().map(|step| step.time).collect();
        let quaternions: Vec<Vec<[f64; 4]>> = (self.steps.iter())
            .map(|step| step.grippers.iter().map(|gripper| gripper.quaternion).collect())
            .collect();
        Attitudes::new(&times, &quaternions)
    }
}

/// The ply in one step.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Step {
    /// Counts from 1, the start.
    pub step: usize,
    /// Time (s).
    pub time: f64,
    /// Grippers, i running fastest.
    pub grippers: Vec<Gripper>,
    /// How the equilibrium was found.
    pub solver: Solver,
    /// Edges along u, edges along v, then two diagonals per cell.
    pub catenaries: Vec<CatenaryState>,
    /// Cells, i running fastest.
    pub cells: Vec<Cell>,
    /// Worst values of this step, each with its place.
    pub measures: Measures,
}

/// A gripper in one step.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Gripper {
    /// Grid indices.
    pub id: GripperId,
    /// Position (m).
    pub position: [f64; 3],
    /// Slope of the ply along u, where there is one.
    pub slope_u: Option<f64>,
    /// Slope of the ply along v, where there is one.
    pub slope_v: Option<f64>,
    /// Angle between the ply's normal and the vertical (°).
    pub tilt_deg: f64,
    /// Orientation (x, y, z, w): z axis along the ply's normal, x axis along u.
    pub quaternion: [f64; 4],
    /// Distance from where the ideal drape puts it (mm), where that is known.
    pub target_distance_mm: Option<f64>,
}

/// How the equilibrium of a step was found.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Solver {
    /// `converged`, or what stopped it.
    pub status: Status,
    /// Iterations of the last equilibrium.
    pub iterations: usize,
    /// Its optimality residual.
    pub residual: f64,
    /// Equilibria solved in this step.
    pub equilibria: usize,
}

/// Whether a catenary bounds cells or crosses one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CatenaryKind {
    /// Along a fibre direction, between two cells or at the ply's border.
    Edge,
    /// Across a cell.
    Diagonal,
}

/// Where a catenary leads.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CatenaryDirection {
    /// Along the first gripper index.
    U,
    /// Along the second gripper index.
    V,
    /// From `[i, j]` to `[i+1, j+1]`.
    Rising,
    /// From `[i+1, j]` to `[i, j+1]`.
    Falling,
}

/// What holds a span in its shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Hold {
    /// It hangs freely.
    Hanging,
    /// It is pulled straight beyond its length.
    Overstretched,
    /// It is straight: shearing, or taut without a force.
    Straight,
    /// It lies on the mold.
    Lying,
}

/// The word of the file.
macro_rules! words {
    ($name:ident: $($variant:ident $word:literal),*) => {
        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(match self { $($name::$variant => $word),* })
            }
        }
    };
}

words!(CatenaryKind: Edge "edge", Diagonal "diagonal");
words!(CatenaryDirection: U "u", V "v", Rising "rising", Falling "falling");
words!(Hold: Hanging "hanging", Overstretched "overstretched", Straight "straight", Lying "lying");

/// One catenary in one step.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CatenaryState {
    /// `edge` or `diagonal`.
    pub kind: CatenaryKind,
    /// `u`, `v`, `rising` or `falling`.
    pub direction: CatenaryDirection,
    /// Gripper at its first end.
    pub from: GripperId,
    /// Gripper at its second end.
    pub to: GripperId,
    /// Set length (m).
    pub length: f64,
    /// A diagonal stretched by the shear of its cell: straight.
    pub shearing: bool,
    /// Force of a shearing diagonal (N), where the material has a shear curve.
    pub shear_force_n: Option<f64>,
    /// Rests, in order: those that hang, and those that lie on the mold with what slack they keep.
    pub spans: Vec<SpanState>,
    /// What the mold has caught.
    pub contact: Option<ContactState>,
    /// A touch away from the contact segment.
    pub bridging: Option<Bridging>,
}

/// One free span in one step.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SpanState {
    /// Fabric arc length of its ends from the first gripper (m).
    pub arc: [f64; 2],
    /// Fabric length (m).
    pub length: f64,
    /// Horizontal distance of its ends (m).
    pub run: f64,
    /// Height of its second end above its first (m).
    pub rise: f64,
    /// Whether it hangs, is pulled or lies.
    pub state: Hold,
    /// Horizontal force (N); null where the model gives none.
    #[serde(rename = "H_N")]
    pub force: Option<f64>,
    /// Slopes at its ends.
    pub slopes: [f64; 2],
    /// Which of these slopes were prescribed; the others are free.
    pub prescribed: [bool; 2],
    /// Its shape at equally spaced stations (m); slack of a lying rest is drawn as a wrinkle.
    pub points: Vec<[f64; 3]>,
    /// Free length minus the path between its ends (mm), not negative.
    pub slack_mm: f64,
    /// Slack as a share of its free length.
    pub slack_ratio: f64,
    /// Amplitude of the wrinkle that the slack makes, (2/π)√(chord·slack) (mm).
    pub wrinkle_mm: f64,
    /// Chord beyond the free length (mm), not negative.
    pub overstretch_mm: f64,
    /// Chord beyond the free length as a share of the whole catenary.
    pub overstretch: f64,
}

/// The segment of a catenary that the mold has caught; rests beside it may lie there too.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ContactState {
    /// Fabric arc length of its ends from the first gripper (m).
    pub arc: [f64; 2],
    /// Its line on the mold (m), first to last.
    pub points: Vec<[f64; 3]>,
    /// Distance of each of these points from its place in the ideal drape (mm); null where that is not
    /// known.
    pub landing_error_mm: Option<Vec<Option<f64>>>,
    /// Angle between the line, from end to end, and the same fabric in the ideal drape (°); edges only.
    pub fibre_angle_deg: Option<f64>,
}

/// A touch away from the contact segment, which the model does not follow.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Bridging {
    /// Place of the largest gap between segment and touch (m).
    pub place: [f64; 3],
    /// That gap (m).
    pub gap: f64,
    /// Straight distance between the touches on both sides of it (m).
    pub width: f64,
}

/// A cell in one step.
#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// Its lowest gripper.
    pub cell: GripperId,
    /// Shear angle (°), 0 where no diagonal shears.
    pub shear_deg: f64,
    /// The shearing diagonal, `rising` or `falling`.
    pub shearing: Option<CatenaryDirection>,
}

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
