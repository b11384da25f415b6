//! The catenaries of a step: what their shapes and measures follow from, and how they were found.

use super::{Bridge, Cell, Solver};
use crate::ply::{GripperId, Kind, Ply, Ruck};
use crate::state::excess;

/// The catenaries of one step.
#[derive(Debug, Clone, PartialEq)]
pub struct CatenaryStep {
    /// How the equilibrium was found.
    pub solver: Solver,
    /// Slope of the ply along u and along v at each gripper; `None` where no edge runs in that direction.
    pub slopes: Vec<[Option<f64>; 2]>,
    /// Edges along u, edges along v, then two diagonals per cell.
    pub catenaries: Vec<CatenaryState>,
    /// Cells, i running fastest.
    pub cells: Vec<Cell>,
}

/// What holds a span in its shape.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Hold {
    /// It hangs freely.
    Hanging,
    /// It is pulled straight beyond its length.
    Overstretched,
    /// It is straight: shearing, or taut without a force.
    Straight,
    /// It lies on the mold.
    Lying,
}

/// One catenary in one step.
#[derive(Debug, Clone, PartialEq)]
pub struct CatenaryState {
    /// Family.
    pub kind: Kind,
    /// Gripper at its first end.
    pub from: GripperId,
    /// Gripper at its second end.
    pub to: GripperId,
    /// Set length (m).
    pub length: f64,
    /// A diagonal stretched by the shear of its cell: straight.
    pub shearing: bool,
    /// Force of a shearing diagonal (N), where the material has a shear curve.
    pub shear_force_n: Option<f64>,
    /// Segments outside of contact, in order: those that hang, and those that lie on the mold with what slack they keep.
    pub spans: Vec<SpanState>,
    /// The segment in contact with the mold.
    pub contact: Option<ContactState>,
    /// A touch away from the contact segment.
    pub bridging: Option<Bridge>,
}

impl CatenaryState {
    /// Fabric arc length of the ends of one of its spans from the first gripper (m).
    #[must_use]
    pub fn arc(&self, span: &SpanState) -> [f64; 2] {
        match (&self.contact, span.segment) {
            (Some(contact), 1) => [contact.ends()[1], self.length],
            (Some(contact), _) if span.hold != Hold::Lying || span.length < self.length => {
                [0.0, contact.ends()[0]]
            }
            _ => [0.0, self.length],
        }
    }

    /// Way of one of its spans beyond its fabric, as a share of the whole catenary.
    #[must_use]
    pub fn overstretch(&self, span: &SpanState) -> f64 {
        1e-3 * span.overstretch_mm(self.length) / self.length
    }
}

/// One segment outside of contact in one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpanState {
    /// 0 for a whole catenary or the segment before the one in contact, 1 for the segment after it.
    pub segment: usize,
    /// Whether it hangs, is pulled or lies.
    pub hold: Hold,
    /// Fabric length (m).
    pub length: f64,
    /// Way between its ends (m), negative where a gripper has passed the end of what is in contact: a fold.
    pub path: f64,
    /// Horizontal force (N); `None` where the model gives none.
    pub force: Option<f64>,
    /// Slopes at its ends.
    pub slopes: [f64; 2],
    /// Which of these slopes were prescribed; the others are free.
    pub prescribed: [bool; 2],
}

impl SpanState {
    /// Fabric beyond the path (mm), not negative; `whole` is the length of its catenary (m).
    #[must_use]
    pub fn slack_mm(&self, whole: f64) -> f64 {
        1e3 * excess(self.length - self.path, whole)
    }

    /// Slack as a share of its fabric.
    #[must_use]
    pub fn slack_ratio(&self, whole: f64) -> f64 {
        if self.length > 0.0 { excess(self.length - self.path, whole) / self.length } else { 0.0 }
    }

    /// Way beyond the fabric (mm), not negative.
    #[must_use]
    pub fn overstretch_mm(&self, whole: f64) -> f64 {
        1e3 * excess(self.path - self.length, whole)
    }

    /// The ruck that its slack makes on the mold, if it has any.
    #[must_use]
    pub fn ruck(&self, ply: &Ply, gravity: f64, catenary: &CatenaryState) -> Option<Ruck> {
        let line = ply.line(catenary.kind);
        let slack = excess(self.length - self.path, catenary.length);
        Ruck::from_slack(slack, line.flexural_rigidity, line.mass * gravity)
    }
}

/// The segment of a catenary that is in contact; segments beside it may lie there too.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactState {
    /// Line on the mold (m), first to last.
    pub points: Vec<[f64; 3]>,
    /// Fabric arc length of each of these points from the first gripper (m).
    pub arc: Vec<f64>,
    /// Distance of each of these points from its place in the ideal drape (mm); `None` where that is not known.
    pub landing_error_mm: Option<Vec<Option<f64>>>,
    /// Angle between the line, from end to end, and the same fabric in the ideal drape (°); edges only.
    pub fiber_angle_deg: Option<f64>,
}

impl ContactState {
    /// Fabric arc length of its ends from the first gripper (m).
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.arc[0], self.arc[self.arc.len() - 1]]
    }

    /// Fabric length (m).
    #[must_use]
    pub fn length(&self) -> f64 {
        let [from, to] = self.ends();
        to - from
    }
}
