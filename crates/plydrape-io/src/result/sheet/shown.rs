//! What pictures of a sheet need beside its arrays: the state of each step, the yarns around each cell, normals of pads.

use super::{SheetMesh, SheetState, SheetStates};
use crate::Error;
use plydrape::geometry::distance;
use std::collections::HashMap;

impl SheetStates {
    /// The steps that have a state, each with the number of its last one.
    ///
    /// # Errors
    /// [`Error`] as for [`SheetStates::state`].
    pub fn steps(&mut self) -> Result<Vec<(usize, usize)>, Error> {
        let mut found: Vec<(usize, usize)> = Vec::new();
        for n in 0..self.states() {
            let Some(state) = self.state(n)? else { continue };
            let step = state.step as usize;
            found.pop_if(|(before, _)| *before == step);
            found.push((step, n));
        }
        Ok(found)
    }
}

/// The segments on the sides of each cell.
#[derive(Debug, Clone)]
pub struct SheetSides {
    cells: Vec<Vec<usize>>,
    /// Ends and length in the fabric (m) of each segment.
    segments: Vec<([usize; 2], f64)>,
}

impl SheetSides {
    /// The sides of the cells of a mesh.
    #[must_use]
    pub fn new(mesh: &SheetMesh) -> Self {
        let ends = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let number: HashMap<[u32; 2], usize> =
            mesh.segments.iter().map(|segment| ends(*segment)).zip(0..).collect();
        let cells = mesh.cells.iter().map(|cell| {
            let sides = (0..4).map(|k| ends([cell[k], cell[(k + 1) % 4]]));
            sides.filter_map(|side| number.get(&side).copied()).collect()
        });
        let place = |n: usize| [mesh.places[n][0], mesh.places[n][1], 0.0];
        let segments = mesh.segments.iter().map(|segment| {
            let [a, b] = segment.map(|n| n as usize);
            ([a, b], distance(place(a), place(b)))
        });
        SheetSides { cells: cells.collect(), segments: segments.collect() }
    }

    /// Of each cell the strain of the yarn on its sides that is strained most, and its tension (N/m).
    #[must_use]
    pub fn strains(&self, state: &SheetState) -> Vec<(f64, f64)> {
        let strain = |([a, b], length): &([usize; 2], f64)| {
            distance(state.positions[*a], state.positions[*b]) / length - 1.0
        };
        let all: Vec<f64> = self.segments.iter().map(strain).collect();
        let most = |sides: &Vec<usize>| {
            let found =
                sides.iter().copied().max_by(|m, n| all[*m].abs().total_cmp(&all[*n].abs()));
            found.map_or((0.0, 0.0), |n| (all[n], state.tension[n]))
        };
        self.cells.iter().map(most).collect()
    }
}

/// The normal of a pad: the third axis of its rotation, a quaternion x, y, z, w.
#[must_use]
pub(crate) fn normal(&[x, y, z, w]: &[f64; 4]) -> [f64; 3] {
    [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)]
}
