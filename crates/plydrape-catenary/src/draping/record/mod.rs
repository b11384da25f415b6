//! What a record keeps of the catenaries of one step: every force, slope and contact; shapes are made from it by
//! [`crate::draping::curves`].
//!
//! Lengths in meters, forces in newtons, angles in radians, unless the name says otherwise.

mod catenary;

pub use super::bridge::Bridge;
pub use catenary::{CatenaryState, CatenaryStep, ContactState, Hold, SpanState};

use crate::draping::ContactStatus;
use crate::equilibrium::Status;
use crate::ply::{GripperId, Kind};

/// A catenary by its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct CatenaryId {
    /// Family.
    pub kind: Kind,
    /// Gripper at its first end.
    pub from: GripperId,
    /// Gripper at its second end.
    pub to: GripperId,
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
    /// Optimality residual (a slope).
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
    /// Lowest gripper.
    pub cell: GripperId,
    /// Shear angle (°), 0 where no diagonal shears.
    pub shear_deg: f64,
    /// The shearing diagonal, `rising` or `falling`.
    pub shearing: Option<Kind>,
    /// Shear angle (°) that each of its diagonals landed with, rising and falling, positive where the rising one is the
    /// longer one; null where it has not.
    pub landed_deg: [Option<f64>; 2],
}
