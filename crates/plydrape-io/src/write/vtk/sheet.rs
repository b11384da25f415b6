//! The sheet in a state that was kept: its cells, and a point for each pad.
//!
//! | `sheet`, point data | |
//! |---|---|
//! | `u_m`, `v_m` | place in the fabric (m) |
//! | `height_mm`, `has_height` | height over the mold (mm), and 1 where that is known; else both 0 |
//! | `contact` | 1 on nodes that touch the mold |
//! | `landing_step` | step in which the node landed for good, 0 for never |
//!
//! | `sheet`, cell data | |
//! |---|---|
//! | `shear_deg` | shear angle (°) |
//! | `strain`, `tension_N_per_m` | of the yarn on the cell's sides that is strained most: strain, tension per width (N/m) |
//!
//! | `pads`, point data | |
//! |---|---|
//! | `gripper` | its number, in the order of the grid |
//! | `force_N` | force of the sheet on the pad (N), a vector |
//! | `Normals` | the pad's normal |
//! | `quaternion` | its rotation (x, y, z, w) |

use super::polydata::{Array, Kind, PolyData};
use crate::result::sheet::{SheetMesh, SheetSides, SheetState, normal};

/// The cells of a state.
pub(super) fn sheet(
    mesh: &SheetMesh,
    landing_step: &[u32],
    sides: &SheetSides,
    state: &SheetState,
) -> PolyData {
    let known = |height: &f64| height.is_finite();
    let heights = state.height.iter().map(|h| if known(h) { 1e3 * h } else { 0.0 });
    let yarns = sides.strains(state);
    PolyData {
        points: state.positions.to_vec(),
        kind: Kind::Polys,
        cells: mesh.cells.iter().map(|cell| cell.map(|n| n as usize).to_vec()).collect(),
        at_points: vec![
            Array::new("u_m", mesh.places.iter().map(|place| place[0]).collect()),
            Array::new("v_m", mesh.places.iter().map(|place| place[1]).collect()),
            Array::new("height_mm", heights.collect()),
            Array::codes("has_height", state.height.iter().map(|h| known(h).into()).collect()),
            Array::codes("contact", state.contact.iter().map(|c| (*c).into()).collect()),
            Array::whole("landing_step", landing_step.iter().map(|step| *step as usize)),
        ],
        in_cells: vec![
            Array::new("shear_deg", state.shear.iter().map(|shear| shear.to_degrees()).collect()),
            Array::new("strain", yarns.iter().map(|yarn| yarn.0).collect()),
            Array::new("tension_N_per_m", yarns.iter().map(|yarn| yarn.1).collect()),
        ],
        fields: Vec::new(),
    }
}

/// The pads of a state.
pub(super) fn pads(state: &SheetState) -> PolyData {
    let count = state.grippers.len();
    let normals: Vec<[f64; 3]> = state.pad_rotation.iter().map(normal).collect();
    PolyData {
        points: state.grippers.to_vec(),
        kind: Kind::Verts,
        cells: (0..count).map(|k| vec![k]).collect(),
        at_points: vec![
            Array::whole("gripper", 0..count),
            Array::vectors("force_N", &state.pad_forces),
            Array::vectors("Normals", &normals),
            Array::vectors("quaternion", &state.pad_rotation),
        ],
        in_cells: Vec::new(),
        fields: Vec::new(),
    }
}
