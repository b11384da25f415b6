//! The ply's surface: quads between the catenaries, equally many along each side of a cell.
//!
//! | point data | |
//! |---|---|
//! | `u_m`, `v_m` | place in the fabric (m), from the gripper `[0, 0]` |
//! | `z_m` | height (m) |
//! | `gap_mm` | distance from the mold (mm), negative inside it; only with a mold |
//! | `warp`, `weft` | unit vectors along the fibers |
//!
//! | cell data | |
//! |---|---|
//! | `shear_deg` | shear angle of the cell of the ply that the quad is a part of (°) |
//! | `cell_i`, `cell_j` | that cell, by its lowest gripper |

use super::polydata::{Array, Kind, PolyData};
use crate::result::ResultFile;
use crate::write::surface::Surface;
use plydrape::outcome::Step;
use plydrape::ply::Direction;

/// Quads of a step, about, and intervals along a side of a cell, at most.
const QUADS: usize = 4000;
const INTERVALS: usize = 10;

/// The surface of a step.
pub(super) fn ply(result: &ResultFile, step: &Step) -> PolyData {
    let grid = result.scene.ply.lines().surface();
    let intervals = (QUADS / grid.cells().max(1)).isqrt().clamp(1, INTERVALS);
    let Surface { size: [nu, nv], vertices, gap } = Surface::new(result, step, intervals);

    // fabric coordinates and fibers
    let place = |k: usize| [k % nu, k / nu];
    let fabric = |direction: usize| -> Vec<f64> {
        let side = result.scene.ply.cell[direction];
        let coordinate = |k: usize| side * place(k)[direction] as f64 / intervals as f64;
        (0..vertices.len()).map(coordinate).collect()
    };
    let tangents = |direction: usize| -> Vec<[f64; 3]> {
        let (step, count) = if direction == 0 { (1, nu) } else { (nu, nv) };
        let along = |k: usize| {
            let n = place(k)[direction];
            let before = if n > 0 { k - step } else { k };
            let after = if n + 1 < count { k + step } else { k };
            unit([0, 1, 2].map(|c| vertices[after][c] - vertices[before][c]))
        };
        (0..vertices.len()).map(along).collect()
    };
    let names = match result.scene.ply.warp {
        Direction::U => ["warp", "weft"],
        Direction::V => ["weft", "warp"],
    };
    let mut at_points = vec![
        Array::new("u_m", fabric(0)),
        Array::new("v_m", fabric(1)),
        Array::new("z_m", vertices.iter().map(|p| p[2]).collect()),
    ];
    at_points
        .extend(gap.map(|gap| Array::new("gap_mm", gap.into_iter().map(|g| 1e3 * g).collect())));
    at_points.extend([0, 1].map(|d| Array::vectors(names[d], &tangents(d))));

    // quads, and the cell of the ply that each is in
    let quads = (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| [i, j]));
    let corners = |[i, j]: [usize; 2]| {
        let first = j * nu + i;
        vec![first, first + 1, first + nu + 1, first + nu]
    };
    let within: Vec<[usize; 2]> = quads.clone().map(|quad| quad.map(|k| k / intervals)).collect();
    let shear = |[i, j]: &[usize; 2]| {
        let cell = step.catenaries.as_ref().and_then(|step| step.cells.get(j * (grid.nu - 1) + i));
        cell.map_or(0.0, |cell| cell.shear_deg)
    };
    let in_cells = vec![
        Array::new("shear_deg", within.iter().map(shear).collect()),
        Array::whole("cell_i", within.iter().map(|id| id[0])),
        Array::whole("cell_j", within.iter().map(|id| id[1])),
    ];
    PolyData {
        points: vertices,
        kind: Kind::Polys,
        cells: quads.map(corners).collect(),
        at_points,
        in_cells,
        fields: Vec::new(),
    }
}

/// A vector of length one; zero stays zero.
fn unit(vector: [f64; 3]) -> [f64; 3] {
    plydrape::geometry::vector::direction(vector).unwrap_or_default()
}
