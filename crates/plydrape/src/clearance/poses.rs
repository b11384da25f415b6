//! Where the pads, the stems and the flange are at one time.

use crate::mold::Pose;

/// Where everything is that bodies are mounted on, at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Poses {
    /// The pad of each gripper, in the order of [`crate::ply::Ply::index`].
    pub pads: Vec<Pose>,
    /// The stem of each gripper.
    pub stems: Vec<Pose>,
    /// The robot's flange, where one robot carries the grippers.
    pub flange: Option<Pose>,
}

impl Poses {
    /// Of grippers that each move by themselves: where they hold the ply (m), how they are turned (x, y, z, w), and where the robot
    /// holds them (m). Stems are upright.
    #[must_use]
    pub fn free(positions: &[[f64; 3]], turned: &[[f64; 4]], commanded: &[[f64; 3]]) -> Self {
        let pads = positions.iter().zip(turned);
        Poses {
            pads: pads.map(|(p, q)| Pose::of_quaternion(*p, *q)).collect(),
            stems: commanded.iter().map(|p| Pose::upright(*p)).collect(),
            flange: None,
        }
    }
}
