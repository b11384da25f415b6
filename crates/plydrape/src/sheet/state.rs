//! The sheet at one moment.

use super::gripper::Pad;

/// The sheet after one step of the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct ClothState {
    /// Counts from 1, the start.
    pub step: usize,
    /// Time of the motion (s); after its end that of the release.
    pub time: f64,
    /// Positions of the nodes (m).
    pub positions: Vec<[f64; 3]>,
    /// Distance of each node from the mold (m); empty where there is none.
    pub heights: Vec<f64>,
    /// Whether each node is held along the mold, or lies on it under a gripper.
    pub contact: Vec<bool>,
    /// Shear angle of each cell (rad).
    pub shear: Vec<f64>,
    /// Tension of each segment per width (N/m).
    pub tension: Vec<f64>,
    /// The grippers' pads.
    pub pads: Vec<Pad>,
    /// Whether each of them holds the ply.
    pub holds: Vec<bool>,
    /// Force of the ply on each gripper (N); none on one that has let go.
    pub forces: Vec<[f64; 3]>,
    /// Energy of the ply without its motion (J): weight, stretch, shear, bending, contact and mounts.
    pub energy: f64,
    /// Kinetic energy (J), in the time that the drape took.
    pub kinetic_energy: f64,
}
