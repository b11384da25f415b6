//! A whole motion as a tool makes it.

use super::rates::turn_between;
use super::tuning::TIPS;
use super::{Axis, Posture, Tool};
use crate::Error;
use crate::arm::ArmRecord;
use crate::geometry::Pose;
use crate::geometry::vector::{distance, dot, norm, sub};
use rayon::prelude::*;

/// A motion that a tool makes.
#[derive(Debug, Clone, PartialEq)]
pub struct Carried {
    /// The posture of each step.
    pub postures: Vec<Posture>,
    /// Where the grippers come to (m), one list a step.
    pub positions: Vec<Vec<[f64; 3]>>,
    /// What it takes of the tool.
    pub record: ToolRecord,
}

/// What a motion takes of its tool.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct ToolRecord {
    /// Largest distance between where a gripper should be and where the tool brings it (mm).
    pub residual_mm: f64,
    /// The gripper with that distance, by its number.
    pub gripper: usize,
    /// The step in which it has it, counted from 1.
    pub step: usize,
    /// Smallest and largest stroke of each axis (mm).
    pub strokes_mm: Vec<[f64; 2]>,
    /// Largest turn of the frame from its start (°).
    pub turn_deg: f64,
    /// The stroke that is missing most; none where all are long enough.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub missing: Option<MissingStroke>,
    /// The arm along the motion; `None` where it is not known.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub arm: Option<ArmRecord>,
}

/// A stroke that a motion asks for beyond an end of its axis.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct MissingStroke {
    /// The axis, by its number among those of a gripper.
    pub axis: usize,
    /// The gripper, by its number.
    pub gripper: usize,
    /// The step, counted from 1.
    pub step: usize,
    /// The stroke that brings the gripper as near as the axis can (mm).
    pub needs_mm: f64,
    /// The end of the axis on that side (mm).
    pub has_mm: f64,
}

impl MissingStroke {
    /// How much is missing (mm).
    #[must_use]
    pub fn by_mm(&self) -> f64 {
        (self.needs_mm - self.has_mm).abs()
    }
}

impl ToolRecord {
    /// The record of two motions in one, of which the first is that of the tool and the second only asked for places near it.
    #[must_use]
    pub fn with_residual_of(self, asked: &ToolRecord) -> Self {
        let ToolRecord { residual_mm, gripper, step, ref missing, .. } = *asked;
        ToolRecord { residual_mm, gripper, step, missing: missing.clone(), ..self }
    }

    /// Keeps the stroke of an axis that brings a gripper to a place off the zero of its axes (m), if more of it is missing than of any
    /// before.
    fn miss(&mut self, off: [f64; 3], axes: &[Axis], gripper: usize, step: usize) {
        for (n, axis) in axes.iter().enumerate() {
            let along = dot(axis.direction, off);
            let [needs_mm, has_mm] = [along, axis.stroke_to(along)].map(|stroke| 1e3 * stroke);
            let missing = MissingStroke { axis: n, gripper, step, needs_mm, has_mm };
            let before = self.missing.as_ref().map_or(0.0, MissingStroke::by_mm);
            if missing.by_mm() > before {
                self.missing = Some(missing);
            }
        }
    }
}

impl Carried {
    /// Refuses a motion in which the frame tips over: from one step to the next it turns so far that its grippers, without their strokes, would
    /// move much farther than they do.
    ///
    /// # Errors
    /// [`Error::ToolTips`] with the first such step.
    pub fn check(&self, tool: &Tool) -> Result<(), Error> {
        let size = tool.mounts.iter().map(|m| norm(*m)).fold(0.0, f64::max);
        for (k, pair) in self.postures.windows(2).enumerate() {
            let turn = norm(turn_between(&pair[0].frame.axes, &pair[1].frame.axes));
            let moves = self.positions[k].iter().zip(&self.positions[k + 1]);
            let moved = moves.map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
            if turn > TIPS[0] && turn * size > TIPS[1] * moved {
                let (turn_deg, moved_mm) = (turn.to_degrees(), 1e3 * moved);
                return Err(Error::ToolTips { step: k + 2, turn_deg, moved_mm });
            }
        }
        Ok(())
    }
}

impl Tool {
    /// The motion that the tool makes where one is asked for (m): one list of all grippers a step.
    #[must_use]
    pub fn carry(&self, asked: &[Vec<[f64; 3]>]) -> Carried {
        // errors of a cell put the grippers where the tool cannot, so they stay there
        let postures: Vec<Posture> = asked.par_iter().map(|places| self.posture(places)).collect();
        let positions: Vec<Vec<[f64; 3]>> = match self.with_errors {
            true => asked.to_vec(),
            false => postures.iter().map(|p| self.places(p)).collect(),
        };
        let mut record = ToolRecord {
            residual_mm: 0.0,
            gripper: 0,
            step: 1,
            strokes_mm: vec![[0.0; 2]; self.axes.len()],
            turn_deg: 0.0,
            missing: None,
            arm: None,
        };
        for (k, posture) in postures.iter().enumerate() {
            // the largest distance of a gripper from where it should be
            for (n, (a, b)) in asked[k].iter().zip(&positions[k]).enumerate() {
                let residual = 1e3 * distance(*a, *b);
                if residual > record.residual_mm {
                    (record.residual_mm, record.gripper, record.step) = (residual, n, k + 1);
                }
            }
            for (n, (place, mount)) in asked[k].iter().zip(&self.mounts).enumerate() {
                record.miss(sub(posture.frame.local(*place), *mount), &self.axes, n, k + 1);
            }
            // ranges of strokes and turns that the machine must have
            for strokes in &posture.strokes {
                for (range, stroke) in record.strokes_mm.iter_mut().zip(strokes) {
                    *range = [range[0].min(1e3 * stroke), range[1].max(1e3 * stroke)];
                }
            }
            let turn = turn_between(&Pose::ORIGIN.axes, &posture.frame.axes);
            record.turn_deg = record.turn_deg.max(norm(turn).to_degrees());
        }
        Carried { postures, positions, record }
    }

    /// The direction that pads tilt from (unit vector) where the tool follows places of the grippers (m): upwards along its stems, or
    /// that of pads without joints.
    #[must_use]
    pub fn direction(&self, places: &[[f64; 3]]) -> [f64; 3] {
        let frame = self.posture(places).frame;
        self.fixed_pads.map_or(frame.axes[2], |pads| frame.turn(pads[2]))
    }

    /// The axes of all pads in the scene where the tool follows places of the grippers (m); none where ball joints let each follow the
    /// ply.
    #[must_use]
    pub fn pads(&self, places: &[[f64; 3]]) -> Option<[[f64; 3]; 3]> {
        let pads = self.fixed_pads?;
        let frame = self.posture(places).frame;
        Some(pads.map(|axis| frame.turn(axis)))
    }
}
