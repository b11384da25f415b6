//! Where the pads, the stems and the flange are at one time.

use crate::draping::attitude::by_neighbours;
use crate::mold::Pose;
use crate::mold::vector::{along, dot, sub};
use crate::ply::{Neighbours, Ply};

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

    /// Of such grippers with rigid mounts (m), whose pads are turned by the lines to their neighbours: before any drape.
    #[must_use]
    pub(crate) fn by_neighbours(
        ply: &Ply,
        neighbours: &[Neighbours],
        positions: &[[f64; 3]],
    ) -> Self {
        Poses::free(positions, &by_neighbours(ply, neighbours, positions), positions)
    }

    /// The same carried as one body: each place p becomes `centre + R (p − from)`. Stems stay upright.
    #[must_use]
    pub(crate) fn carried(&self, from: [f64; 3], centre: [f64; 3], turn: &[[f64; 3]; 3]) -> Self {
        let turned = |v: [f64; 3]| turn.map(|row| dot(row, v));
        let position = |pose: &Pose| along(centre, 1.0, turned(sub(pose.position, from)));
        let pad = |pose: &Pose| Pose { position: position(pose), axes: pose.axes.map(turned) };
        Poses {
            pads: self.pads.iter().map(pad).collect(),
            stems: self.stems.iter().map(|pose| Pose::upright(position(pose))).collect(),
            flange: None,
        }
    }
}
