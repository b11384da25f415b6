//! What a result keeps of a plan: the motion is made from it again.

use super::cycle::Cycle;
use super::tried::Tried;
use crate::LayupError;
use crate::measure::Name;
use crate::motion::TimedMotion;
use crate::pick_up::Offset;
use crate::ply::GripperId;
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
    /// How many plans the sample of cells with errors refused in the search; `None` if it refused none.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub refused: Option<usize>,
    /// Samples a second of the motion as it is written (Hz).
    pub rate: f64,
    /// What limits the time of the motion; what does for the longest comes first.
    pub limited_by: Vec<LimitedBy>,
    /// How many times slower the motion is than its limits ask for, because the resin of the ply takes its time; `None` if it is not.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub slowed: Option<f64>,
    /// Planned positions of all grippers (m): control points of the smooth path, one list a step.
    pub path: Vec<Vec<[f64; 3]>>,
    /// Distances of the knots of the path (m).
    pub spacing: Vec<f64>,
    /// The time law: a row for each phase, see [`TimedMotion::law`](crate::motion::TimedMotion::law).
    pub law: Vec<[f64; 5]>,
    /// What the grippers do before the motion of the drape and after it; `None` of a scene whose ply is not picked up.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub cycle: Option<Cycle>,
    /// Where the ply was picked up, if the plan was corrected for that.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub picked_up: Option<PickedUp>,
    /// Of a plan that is not accepted, the changes of its scene that were tried, what helps most first.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Vec::is_empty"))]
    pub tried: Vec<Tried>,
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
    /// The gripper that is nearest to the limit for the longest; `None` of the frame of a tool.
    pub gripper: Option<GripperId>,
}

/// Where the ply was picked up, and how a plan was corrected for it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PickedUp {
    /// How far it lay from where it was planned, about the middle of the grippers at the planned start.
    pub offset: Offset,
    /// The largest distance of a seen point from where the offset puts it (m); `None` where the offset was given.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub residual: Option<f64>,
    /// Share of the offset in each step, 1 at the pick-up and 0 from before the first contact on.
    pub weights: Vec<f64>,
}

impl PlanRecord {
    /// The record of a motion of planned positions.
    #[must_use]
    pub fn new(
        method: PlanMethod,
        evaluations: usize,
        rate: f64,
        path: Vec<Vec<[f64; 3]>>,
        motion: &TimedMotion,
        limited_by: Vec<LimitedBy>,
    ) -> Self {
        let (spacing, law) = (motion.spacing(), motion.law());
        let (refused, slowed, cycle, picked_up) = (None, None, None, None);
        PlanRecord {
            method,
            evaluations,
            refused,
            rate,
            limited_by,
            slowed,
            path,
            spacing,
            law,
            cycle,
            picked_up,
            tried: Vec::new(),
        }
    }

    /// The motion at any time, with all that the grippers do before the drape and after it.
    ///
    /// # Errors
    /// The errors of [`TimedMotion::recorded`] if the plan is none that a planner has made.
    pub fn motion(&self) -> Result<TimedMotion, LayupError> {
        let drape = self.drape_motion()?;
        self.cycle.as_ref().map_or(Ok(drape.clone()), |cycle| cycle.whole(&drape))
    }

    /// The motion of the drape alone.
    ///
    /// # Errors
    /// As [`Self::motion`].
    pub fn drape_motion(&self) -> Result<TimedMotion, LayupError> {
        TimedMotion::recorded(&self.path, &self.spacing, &self.law)
    }
}
