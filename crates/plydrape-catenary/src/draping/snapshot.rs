//! The ply in one step.

use super::bridge::Bridge;
use super::spans::{Equilibrium, Point};
use crate::equilibrium::{Solved, Status};
use crate::ply::ContactSegment;

/// The ply in one step, with everything that is known of it.
#[derive(Debug, Clone)]
pub(crate) struct Snapshot {
    /// Counts from 1, the start.
    pub step: usize,
    /// Time (s).
    pub time: f64,
    /// Where the grippers are (m), which hold the fabric there.
    pub positions: Vec<Point>,
    /// Free spans and the equilibrium that holds them.
    pub shape: Equilibrium,
    /// Contact segment of each catenary.
    pub contacts: Vec<Option<ContactSegment>>,
    /// Touches that the model does not follow, by catenary.
    pub bridges: Vec<Option<Bridge>>,
    /// Depth of the deepest span below the mold (m), its catenary and the place (m): at the end of the step, and where an edge jumped
    /// onto the mold on the way. None if all are clear of it.
    pub deepest: Option<(f64, usize, Point)>,
    /// Shear of each cell that shears.
    pub shear: Vec<Option<CellShear>>,
    /// Equilibria solved in this step.
    pub equilibria: usize,
    /// The first equilibrium of this step that did not converge, or else the last one.
    pub solved: Solved,
    /// How the contact was followed.
    pub contact_status: ContactStatus,
}

impl Snapshot {
    /// Why this step is no solution, if it is none.
    #[must_use]
    pub fn failure(&self) -> Option<&'static str> {
        match (self.solved.status, self.contact_status) {
            (Status::Converged, ContactStatus::RoundLimit) => {
                Some("contact that changes without end")
            }
            (Status::Converged, _) => None,
            (status, _) => Some(status.name()),
        }
    }
}

/// Shear of a cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CellShear {
    /// Shear angle γ (rad).
    pub angle: f64,
    /// Taut path of the stretched diagonal (m).
    pub path: f64,
    /// Whether the falling diagonal is the stretched one.
    pub falling: bool,
}

impl CellShear {
    /// Shear angle (rad), negative where the falling diagonal is the stretched one.
    #[must_use]
    pub fn signed(&self) -> f64 {
        if self.falling { -self.angle } else { self.angle }
    }
}

/// How the contact of a step was followed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ContactStatus {
    /// Until nothing changed any more, no new touch deeper than the tolerance.
    Followed,
    /// It still changed when the rounds at one place were spent.
    RoundLimit,
    /// An edge jumped onto the mold deeper than the tolerance, however short the step was cut: its depth is penetration.
    CutLimit,
}

impl ContactStatus {
    /// Name in tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            ContactStatus::Followed => "followed",
            ContactStatus::RoundLimit => "round-limit",
            ContactStatus::CutLimit => "cut-limit",
        }
    }
}
