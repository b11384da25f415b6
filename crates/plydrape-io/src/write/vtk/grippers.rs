//! The grippers: a point for each, in the order of the grid.
//!
//! | point data | |
//! |---|---|
//! | `name` | name, `g2_0` |
//! | `i`, `j` | grid indices |
//! | `tilt_deg` | angle between the ply's normal and the vertical (°) |
//! | `Normals` | the ply's normal, the gripper's z axis |
//! | `quaternion` | orientation (x, y, z, w) |
//! | `target_distance_mm`, `has_target` | distance from where the ideal drape puts it (mm), and 1 where that is known; else both 0 |

use super::polydata::{Array, Kind, PolyData};
use plydrape::outcome::{Gripper, Step};
use plydrape::ply::gripper_name;

/// The grippers of a step.
pub(super) fn grippers(step: &Step) -> PolyData {
    let grippers = &step.grippers;
    let numbers =
        |name, value: fn(&Gripper) -> f64| Array::new(name, grippers.iter().map(value).collect());
    let normals: Vec<[f64; 3]> = grippers.iter().map(|g| g.normal()).collect();
    let quaternions: Vec<[f64; 4]> = grippers.iter().map(|g| g.quaternion).collect();
    let known = grippers.iter().map(|g| g.target_distance_mm.is_some().into()).collect();
    PolyData {
        points: grippers.iter().map(|g| g.position).collect(),
        kind: Kind::Verts,
        cells: (0..grippers.len()).map(|k| vec![k]).collect(),
        at_points: vec![
            Array::texts("name", grippers.iter().map(|g| gripper_name(g.id))),
            Array::whole("i", grippers.iter().map(|g| g.id[0])),
            Array::whole("j", grippers.iter().map(|g| g.id[1])),
            numbers("tilt_deg", |g| g.tilt_deg),
            Array::vectors("Normals", &normals),
            Array::vectors("quaternion", &quaternions),
            numbers("target_distance_mm", |g| g.target_distance_mm.unwrap_or(0.0)),
            Array::codes("has_target", known),
        ],
        in_cells: Vec::new(),
        fields: Vec::new(),
    }
}
