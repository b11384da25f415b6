//! The record of a drape: every force, slope, contact and measure of every step; shapes are made from it by
//! [`crate::draping::curves`].
//!
//! Lengths in meters, forces in newtons, angles in radians, unless the name says otherwise.

mod catenary;
mod outcome;

pub use super::bridge::Bridge;
pub use crate::measure::{Measures, Numbers, Verdict, Worst};
pub use catenary::{CatenaryState, ContactState, Hold, SpanState};
pub use outcome::{CatenaryId, Summary};

use crate::draping::ContactStatus;
use crate::equilibrium::Status;
use crate::measure::Name;
use crate::pick_up::Offset;
use crate::ply::{GripperId, Kind};
use crate::scene::PlanMethod;

/// A plan: what a motion is made from again, see [`PlanRecord::motion`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PlanRecord {
    /// The planner.
    pub method: PlanMethod,
    /// Drapes that the search took; of the stepwise planner, steps.
    pub evaluations: usize,
    /// Samples a second of the motion as it is written (Hz).
    pub rate: f64,
    /// What limits the time of the motion, that of the longest time first.
    pub limited_by: Vec<LimitedBy>,
    /// Planned positions of all grippers (m): control points of the smooth path, one list a step.
    pub path: Vec<Vec<[f64; 3]>>,
    /// Distances of the knots of the path (m).
    pub spacing: Vec<f64>,
    /// The time law: a row for each phase, see [`TimedMotion::law`](crate::motion::TimedMotion::law).
    pub law: Vec<[f64; 5]>,
    /// Where the ply was picked up, if the plan was corrected for that.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub picked_up: Option<PickedUp>,
}

/// For how long a limit is what the speed of a motion is limited by.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct LimitedBy {
    /// The measure that is nearest to its limit.
    pub name: Name,
    /// For how long (s).
    pub time_s: f64,
    /// The gripper with which it is that for the longest; none of the frame of a tool.
    pub gripper: Option<GripperId>,
}

/// Where the ply was picked up, and how a plan was corrected for it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PickedUp {
    /// How far it lay from where it was planned, about the middle of the grippers at the planned start.
    pub offset: Offset,
    /// The largest distance of a seen point from where the offset puts it (m); none where the offset was given.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub residual: Option<f64>,
    /// Share of the offset in each step, 1 at the pick-up and 0 from before the first contact on.
    pub weights: Vec<f64>,
}

/// The ply in one step.
#[derive(Debug, Clone, PartialEq)]
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
#[derive(Debug, Clone, PartialEq)]
pub struct Gripper {
    /// Grid indices.
    pub id: GripperId,
    /// Where it holds the fabric (m).
    pub position: [f64; 3],
    /// Slope of the ply along u, where there is one.
    pub slope_u: Option<f64>,
    /// Slope of the ply along v, where there is one.
    pub slope_v: Option<f64>,
    /// Angle between the ply's normal and the stem of the gripper, which is upright unless a tool turns it (°).
    pub tilt_deg: f64,
    /// Orientation (x, y, z, w): z axis along the ply's normal, x axis along u.
    pub quaternion: [f64; 4],
    /// Distance from where the ideal drape puts it (mm), where that is known.
    pub target_distance_mm: Option<f64>,
    /// Its mount; none where all mounts are rigid.
    pub mount: Option<Mount>,
}

/// The mount of a gripper in one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mount {
    /// Where the robot holds it (m).
    pub commanded: [f64; 3],
    /// Force on the gripper (N): of its mount along the axes that yield, of the ply along rigid ones.
    pub force: [f64; 3],
    /// How far the fabric has slid under the pad since the start, along x and y (m).
    pub slip: [f64; 2],
    /// The pad stands on the mold, which carries the rest of what presses it down.
    pub on_mold: bool,
}

impl Mount {
    /// Distance that the fabric has slid (mm).
    #[must_use]
    pub fn slip_mm(&self) -> f64 {
        1e3 * self.slip[0].hypot(self.slip[1])
    }
}

impl Gripper {
    /// Where the robot holds it (m): its position, or where its mount is.
    #[must_use]
    pub fn commanded(&self) -> [f64; 3] {
        self.mount.map_or(self.position, |mount| mount.commanded)
    }

    /// Unit normal of the ply there: the z axis of the orientation.
    #[must_use]
    pub fn normal(&self) -> [f64; 3] {
        crate::draping::attitude::normal(self.quaternion)
    }
}

/// How the equilibrium of a step was found.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Solver {
    /// `converged`, or what stopped it.
    pub status: Status,
    /// Iterations of the last equilibrium.
    pub iterations: usize,
    /// Its optimality residual.
    pub residual: f64,
    /// Equilibria solved in this step.
    pub equilibria: usize,
    /// `followed`, or what ended the search for contact.
    pub contact: ContactStatus,
}

impl Solver {
    /// Whether equilibrium and contact were found.
    #[must_use]
    pub fn found(&self) -> bool {
        self.status == Status::Converged && self.contact != ContactStatus::RoundLimit
    }
}

/// A cell in one step.
#[derive(Debug, Clone, PartialEq)]
pub struct Cell {
    /// Its lowest gripper.
    pub cell: GripperId,
    /// Shear angle (°), 0 where no diagonal shears.
    pub shear_deg: f64,
    /// The shearing diagonal, `rising` or `falling`.
    pub shearing: Option<Kind>,
    /// Shear angle (°) that each of its diagonals landed with, rising and falling, positive where the rising one is the
    /// longer one; null where it has not.
    pub landed_deg: [Option<f64>; 2],
}
