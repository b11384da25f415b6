//! A worst value and the part of the ply that has it.

use super::Sense;
use crate::clearance::{Near, Part, label};
use crate::draping::spans::Point;
use crate::ply::{Fibres, gripper_name};
use crate::scene::Scene;

/// A part of the ply.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Site {
    /// A catenary by its index.
    Catenary(usize),
    /// A gripper by its index.
    Gripper(usize),
    /// Two grippers by their indices.
    Grippers(usize, usize),
    /// A body and what it is near to.
    Bodies {
        /// The body.
        part: Part,
        /// What it is near to.
        near: Near,
        /// When (s).
        time: f64,
    },
    /// A cell by its index.
    Cell(usize),
    /// All edges together.
    AllEdges,
    /// All grippers together.
    AllGrippers,
    /// No part of it has any.
    Nowhere,
}

impl Site {
    /// As a label.
    #[must_use]
    pub fn label(self, scene: &Scene) -> String {
        let ply = &scene.ply;
        let id = |n: usize| gripper_name(ply.id(n));
        match self {
            Site::Catenary(n) => {
                let lines = ply.lines();
                let c = lines.catenary(n);
                let is_side =
                    lines.cells_of(n).any(|cell| lines.cells()[cell].fibres == Fibres::Diagonals);
                let kind = match (c.kind.is_edge(), is_side) {
                    (true, _) => "edge",
                    (false, true) => "bias line",
                    (false, false) => "diagonal",
                };
                format!("{kind} {}–{}", gripper_name(c.from), gripper_name(c.to))
            }
            Site::Gripper(n) => format!("gripper {}", id(n)),
            Site::Grippers(a, b) => format!("grippers {} and {}", id(a), id(b)),
            Site::Bodies { part, near, time } => {
                format!("{} at {time:.2} s", label(scene, part, near))
            }
            Site::Cell(n) => {
                let [i, j] = ply.lines().cells()[n].id;
                format!("cell [{i},{j}]")
            }
            Site::AllEdges => "all edges".into(),
            Site::AllGrippers => "all grippers".into(),
            Site::Nowhere => "nowhere".into(),
        }
    }
}

/// A value of a measure, in its unit, and where it is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found {
    /// The value.
    pub value: f64,
    /// Which part of the ply has it.
    pub site: Site,
    /// Place in space (m), where it has one.
    pub place: Option<Point>,
}

impl Found {
    /// The value zero, without a place.
    pub const NONE: Found = Found { value: 0.0, site: Site::Nowhere, place: None };
}

/// Collects the largest of several values, the first of those that are equal; one that is no number is the largest.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Most(Option<Found>);

impl Most {
    /// Another value.
    pub fn meet(&mut self, value: f64, site: Site, place: Point) {
        if self.0.is_none_or(|most| Sense::AtMost.is_worse(value, most.value)) {
            self.0 = Some(Found { value, site, place: Some(place) });
        }
    }

    /// The largest of them, none of none.
    #[must_use]
    pub fn found(self) -> Option<Found> {
        self.0
    }

    /// The largest of them in a unit of so much (SI).
    #[must_use]
    pub fn in_units_of(self, unit: f64) -> Option<Found> {
        self.0.map(|most| Found { value: most.value / unit, ..most })
    }
}
