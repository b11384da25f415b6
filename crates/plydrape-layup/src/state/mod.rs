//! The ply after one step of its motion, as any model can say it.
//!
//! A model of the ply hands over a [`PlyState`] after every step; measures, verdicts and records are made of nothing else. What one model
//! does not know is empty or `None` there: the catenaries know the ply along lines alone, the sheet knows no lines between grippers.

mod gripper;
mod line;
mod site;

pub use gripper::GripperState;
pub use line::{LineState, excess};
pub use site::Site;

use crate::geometry::Point;
use crate::layup::Model;

/// The ply after one step.
#[derive(Debug, Clone, PartialEq)]
pub struct PlyState {
    /// The model that says it.
    pub model: Model,
    /// Counts from 1, the start.
    pub step: usize,
    /// Time of the motion (s); after its end that of the release.
    pub time: f64,
    /// Points of the fabric.
    pub points: Vec<FabricPoint>,
    /// Lines of the fabric and other lines that the model follows.
    pub lines: Vec<LineState>,
    /// Cells of the fabric.
    pub cells: Vec<CellState>,
    /// The grippers, in the order of [`crate::ply::Ply::index`].
    pub grippers: Vec<GripperState>,
    /// Why the step is no solution, and what is left of its residual; `None` if it is one.
    pub unsolved: Option<Unsolved>,
}

/// Why a step is no solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unsolved {
    /// What did not come to an end.
    pub why: &'static str,
    /// Residual that is left (a slope).
    pub residual: f64,
}

/// A point of the fabric.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FabricPoint {
    /// Where it is in the fabric, or on which line.
    pub site: Site,
    /// Place in space (m).
    pub place: Point,
    /// Unit normal of the ply there, on the side of the grippers; `None` where the model knows no surface.
    pub normal: Option<Point>,
    /// Signed distance from the mold (m), positive outside; `None` without a mold and beyond the boundary of the mold.
    pub height: Option<f64>,
    /// Whether it lies on the mold.
    pub lies: bool,
    /// Area of fabric that it stands for (m²); zero for a point of the boundary or of a line.
    pub area: f64,
    /// Distance from where the ideal drape has it (m); `None` unless it lies and that place is known.
    pub error: Option<f64>,
}

/// A cell of the fabric.
#[derive(Debug, Clone, PartialEq)]
pub struct CellState {
    /// Which cell.
    pub site: Site,
    /// Middle in space (m).
    pub place: Point,
    /// Shear angle (rad), not negative.
    pub shear: f64,
    /// Unit vectors along its two mid-lines, u and v, and where its middle is in the fabric (m); `None` where the model knows no
    /// surface.
    pub directions: Option<([Point; 2], [f64; 2])>,
    /// How much its shear at the end differs from the one that it landed with (rad); `None` unless it has landed and the model follows
    /// that.
    pub landing_error: Option<f64>,
}
