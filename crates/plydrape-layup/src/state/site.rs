//! A part of the layup that has a value, as reports name it.

use crate::clearance::{Near, Part, label};
use crate::layup::Layup;
use crate::ply::{Fibers, gripper_name};

/// A part of the layup.
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
    /// A cell between grippers by its index.
    Cell(usize),
    /// A point of the fabric by its coordinates (m).
    Fabric([f64; 2]),
    /// The frame of the tool.
    Frame,
    /// An axis of the tool by its index, at a gripper by its index.
    Axis(usize, usize),
    /// A joint of the arm by its index.
    Joint(usize),
    /// The flange of the arm.
    Flange,
    /// All edges together.
    AllEdges,
    /// All grippers together.
    AllGrippers,
    /// No part, because the layup has none that could have the value.
    Nowhere,
}

impl Site {
    /// The name of the part in reports.
    #[must_use]
    pub fn label(self, layup: &Layup) -> String {
        let ply = &layup.ply;
        let name = |n: usize| gripper_name(ply.id(n));
        match self {
            Site::Catenary(n) => {
                let lines = ply.lines();
                let c = lines.catenary(n);
                // where the fibers are the diagonals of the cells, bias lines are their sides
                let is_side =
                    lines.cells_of(n).any(|cell| lines.cells()[cell].fibers == Fibers::Diagonals);
                let kind = match (c.kind.is_edge(), is_side) {
                    (true, _) => "edge",
                    (false, true) => "bias line",
                    (false, false) => "diagonal",
                };
                format!("{kind} {}–{}", gripper_name(c.from), gripper_name(c.to))
            }
            Site::Gripper(n) => format!("gripper {}", name(n)),
            Site::Grippers(a, b) => format!("grippers {} and {}", name(a), name(b)),
            Site::Bodies { part, near, time } => {
                format!("{} at {time:.2} s", label(layup, part, near))
            }
            Site::Cell(n) => {
                let [i, j] = ply.lines().cells()[n].id;
                format!("cell [{i},{j}]")
            }
            Site::Fabric(uv) => {
                let [u, v] = uv.map(|c| c * 1e3);
                format!("fabric point ({u:.1}, {v:.1}) mm")
            }
            // parts of the tool and of the robot, by name where the layup has them
            Site::Frame => "frame of the tool".into(),
            Site::Axis(axis, n) => match layup.tool.as_ref().and_then(|tool| tool.axes.get(axis)) {
                Some(axis) => format!("axis {} of gripper {}", axis.name, name(n)),
                None => format!("gripper {}", name(n)),
            },
            Site::Joint(n) => match layup.tool.as_ref().and_then(|tool| tool.arm.as_ref()) {
                Some(arm) => arm.joints.get(n).map_or_else(String::new, |joint| joint.name.clone()),
                None => format!("joint {}", n + 1),
            },
            Site::Flange => "the flange".into(),
            // no single part
            Site::AllEdges => "all edges".into(),
            Site::AllGrippers => "all grippers".into(),
            Site::Nowhere => "nowhere".into(),
        }
    }
}
