//! The tool: how a robot carries the array of grippers.
//!
//! Without a tool each gripper moves by itself, as on a gantry of its own. A [`Tool`] is one frame at the flange of a robot, and
//! between frame and gripper up to three linear axes at right angles. What a frame and its axes cannot follow, grippers do not do: a
//! motion is split into poses of the frame and strokes ([`Tool::carry`]), and where the grippers come to by these is what drapes and
//! is judged. How far that is from what was asked is the residual. A ball joint at the end of each axis lets the pad follow the ply;
//! its tilt counts from the direction of the tool. Without joints ([`Tool::fixed_pads`]) pads turn with the frame alone: the sheet is
//! clamped at them, and lines of catenaries, which are not, say by their tilt how far they are from the direction of the pads.
//!
//! 1. `posture`: the pose of the frame that follows some places of the grippers best, and its strokes;
//! 2. `carried`: a whole motion, and where its residual is worst;
//! 3. `rates`: how fast the frame turns and the axes move.
//!
//! The frame's origin is in the middle of the grippers at the start, and its axes are those of the scene there.

mod carried;
mod posture;
mod rates;
#[cfg(test)]
mod tests;
mod tuning;

pub use carried::{Carried, MissingStroke, ToolRecord};
pub use posture::Posture;
pub use rates::{ToolPeaks, turn_between};

use crate::arm::Arm;
use crate::geometry::vector::{mean, sub};
use crate::mold::Pose;

/// A frame that carries all grippers.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Tool {
    /// Where the frame's origin is at the start (m).
    pub origin: [f64; 3],
    /// Where the grippers are in the frame with strokes of zero (m).
    pub mounts: Vec<[f64; 3]>,
    /// The axes between the frame and each gripper, at right angles to each other.
    pub axes: Vec<Axis>,
    /// Largest angular speed of the frame (rad/s).
    pub turn_rate: f64,
    /// Largest angular acceleration of the frame (rad/s²).
    pub turn_acceleration: f64,
    /// Largest residual that is accepted (m), if the scene says so.
    pub residual: Option<f64>,
    /// Axes of the pads in the frame, x along u and z off the ply, where no joints let them tilt; none where ball joints do.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub fixed_pads: Option<[[f64; 3]; 3]>,
    /// Whether the grippers are where the motion says although the tool cannot bring them there, as errors of a cell are
    /// (`plydrape::errors`).
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "is_exact"))]
    pub with_errors: bool,
    /// Where the flange of the robot is in the frame.
    pub flange: Pose,
    /// Where the origin of the scene is in the world of the robot, which is at the foot of its arm.
    pub world: Pose,
    /// The arm that carries the frame; `None` where it is not known.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub arm: Option<Arm>,
}

/// Whether a tool makes its motion without errors, which need not be written.
#[cfg(feature = "serde")]
fn is_exact(with_errors: &bool) -> bool {
    !with_errors
}

/// A linear axis of each gripper.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Axis {
    /// Name of the axis, `z` if it runs along z.
    pub name: String,
    /// Unit vector along which it moves, in the frame.
    pub direction: [f64; 3],
    /// Smallest and largest stroke (m); zero is the start, and lies between.
    pub stroke: [f64; 2],
    /// Largest speed (m/s).
    pub speed: f64,
}

impl Tool {
    /// A tool that holds grippers at their places at the start (m), with ball joints and turns as fast as usual.
    #[must_use]
    pub fn new(start: &[[f64; 3]], axes: Vec<Axis>) -> Self {
        let origin = mean(start);
        let mounts = start.iter().map(|p| sub(*p, origin)).collect();
        let [turn_rate, turn_acceleration] = tuning::TURN.map(f64::to_radians);
        let (residual, flange, world) = (None, Pose::ORIGIN, Pose::ORIGIN);
        let (fixed_pads, with_errors) = (None, false);
        Tool {
            origin,
            mounts,
            axes,
            turn_rate,
            turn_acceleration,
            residual,
            fixed_pads,
            with_errors,
            flange,
            world,
            arm: None,
        }
    }
}
