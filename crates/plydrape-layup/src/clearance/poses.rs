//! Where the pads, the stems and the flange are at one time.

use crate::geometry::vector::{along, dot, sub};
use crate::layup::Layup;
use crate::mold::Pose;
use crate::ply::{Neighbors, orientations};

/// Where everything is that bodies are mounted on, at one time.
#[derive(Debug, Clone, PartialEq)]
pub struct Poses {
    /// The pad of each gripper, in the order of [`crate::ply::Ply::index`].
    pub pads: Vec<Pose>,
    /// The stem of each gripper.
    pub stems: Vec<Pose>,
    /// The robot's flange, where one robot carries the grippers.
    pub flange: Option<Pose>,
    /// The links of its arm, where their places are known: they depend on where the motion began.
    pub links: Vec<Pose>,
}

impl Poses {
    /// Poses of grippers that each move by themselves: where they hold the ply (m), how they are turned (x, y, z, w), and where the robot
    /// holds them (m). Stems are upright.
    #[must_use]
    pub fn free(positions: &[[f64; 3]], turned: &[[f64; 4]], commanded: &[[f64; 3]]) -> Self {
        let pads = positions.iter().zip(turned);
        Poses {
            pads: pads.map(|(p, q)| Pose::of_quaternion(*p, *q)).collect(),
            stems: commanded.iter().map(|p| Pose::upright(*p)).collect(),
            flange: None,
            links: Vec::new(),
        }
    }

    /// Poses of the grippers of a layup, with the stems and the flange of its tool if one carries them.
    #[must_use]
    pub fn new(
        layup: &Layup,
        positions: &[[f64; 3]],
        turned: &[[f64; 4]],
        commanded: &[[f64; 3]],
    ) -> Self {
        let free = Poses::free(positions, turned, commanded);
        let Some(tool) = &layup.tool else { return free };
        let frame = tool.posture(commanded).frame;
        let stem = |p: &[f64; 3]| Pose { position: *p, ..frame };
        let stems = commanded.iter().map(stem).collect();
        Poses { stems, flange: Some(frame.compose(&tool.flange)), ..free }
    }

    /// Poses of grippers with rigid mounts (m), whose pads are turned by the lines to their neighbors, or with the frame where they have no
    /// joints: before any drape.
    #[must_use]
    pub fn by_neighbors(layup: &Layup, neighbors: &[Neighbors], positions: &[[f64; 3]]) -> Self {
        let turned = match layup.fixed_pads(positions) {
            Some(fixed) => vec![fixed; positions.len()],
            None => orientations(&layup.ply, neighbors, positions),
        };
        Poses::new(layup, positions, &turned, positions)
    }

    /// These poses carried as one body: each place p becomes `center + R (p − from)`. Stems turn with a flange, and stay upright without.
    #[must_use]
    pub fn carried(&self, from: [f64; 3], center: [f64; 3], turn: &[[f64; 3]; 3]) -> Self {
        let turned = |v: [f64; 3]| turn.map(|row| dot(row, v));
        let position = |pose: &Pose| along(center, 1.0, turned(sub(pose.position, from)));
        let moved = |pose: &Pose| Pose { position: position(pose), axes: pose.axes.map(turned) };
        let stem = |pose: &Pose| match self.flange {
            Some(_) => moved(pose),
            None => Pose::upright(position(pose)),
        };
        Poses {
            pads: self.pads.iter().map(moved).collect(),
            stems: self.stems.iter().map(stem).collect(),
            flange: self.flange.as_ref().map(moved),
            links: Vec::new(),
        }
    }
}
