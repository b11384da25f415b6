//! The arm: six turning joints between the foot of a robot and its flange, and how it follows a motion of the flange.
//!
//! 1. `kinematics`: where links and flange are by the angles of the joints, and how the flange moves with them;
//! 2. `inverse`: the angles that bring the flange to a pose, and all of them;
//! 3. `course`: the angles along a motion from each way to begin it, and what it takes of the joints.
//!
//! An arm with six joints reaches a pose by up to sixteen *configurations*: with the shoulder or the elbow on one side or the other, and
//! the wrist turned over. On the way the arm stays in the one it begins in, unless it passes a singularity. So which one it begins in
//! decides whether it comes to the end.

mod course;
mod inverse;
mod kinematics;
#[cfg(test)]
mod tests;
mod tuning;

pub use course::{ArmCourse, ArmPeaks, ArmRecord};
pub use tuning::{LEAST_MARGIN, LEAST_SINGULAR};

use crate::geometry::Pose;

/// How many joints an arm has.
pub const JOINTS: usize = 6;

/// The angle of each joint (rad).
pub type Angles = [f64; JOINTS];

/// An arm of six turning joints.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Arm {
    /// Name of the arm.
    pub name: String,
    /// The joints from the foot to the flange.
    pub joints: [Joint; JOINTS],
    /// Where the flange is in the frame of the last joint.
    pub flange: Pose,
    /// The configuration that the motion begins in: that nearest to these angles (rad); the best one where it is not given.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub start: Option<Angles>,
    /// Largest angular acceleration of a joint (rad/s²); no limit unless given, since makers do not publish it.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub acceleration: Option<f64>,
    /// Least distance of a joint from the ends of its range that is accepted (rad).
    pub margin: f64,
    /// Least singular value that is accepted; see [`Arm::least_singular`].
    pub singular: f64,
}

impl Arm {
    /// How much of a pose the arm may miss (m): as little as the numbers of a program are rounded by.
    #[must_use]
    pub fn allowed_miss(&self) -> f64 {
        tuning::ALLOWED * self.reach()
    }
}

/// A turning joint.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Joint {
    /// Name of the joint.
    pub name: String,
    /// Where its frame is in that of the joint before, or of the foot, at an angle of zero.
    pub pose: Pose,
    /// Unit vector in its frame that it turns about.
    pub axis: [f64; 3],
    /// Smallest and largest angle (rad).
    pub range: [f64; 2],
    /// Largest angular speed (rad/s).
    pub speed: f64,
}
