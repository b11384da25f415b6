//! Where the ply runs over a sharp edge of its mold.
//!
//! Only triangles have edges. One is sharp if the mold turns across it by more than facets of a curved surface do. Parts of it
//! lie under the ply if they are close to one of the net's cells and their fabric point there is on the ply.

use super::Net;
use super::boundary::PlyPoint;
use super::tuning::TUNING;
use crate::geometry::vector::{between, distance};
use crate::mold::Mold;
use crate::mold::mesh::{Closest, closest};
use std::collections::HashMap;

/// Sharp edges of the mold under the ply.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SharpEdges {
    /// Their length under the ply (m).
    pub length: f64,
    /// The largest angle by which the mold turns across one of them (rad), and where; `None` without any.
    pub sharpest: Option<(f64, PlyPoint)>,
}

impl Net {
    /// The sharp edges of a mold that the ply runs over; `None` for a mold that has no edges to tell.
    #[must_use]
    pub fn sharp_edges(&self, mold: &Mold) -> Option<SharpEdges> {
        let Mold::Mesh(mesh) = mold else { return None };
        let outline = self.ply_outline()?;
        let width = self.placement.mesh[0].max(self.placement.mesh[1]);
        let cells = Cells::new(self, 2.0 * width);
        let mut found = SharpEdges { length: 0.0, sharpest: None };
        for edge in mesh.sharp_edges(TUNING.sharp) {
            let [a, b] = edge.ends;
            let length = distance(a, b);
            let parts = (length / (TUNING.edge_part * width)).ceil().max(1.0) as usize;
            for n in 0..parts {
                let place = between(a, b, (n as f64 + 0.5) / parts as f64);
                let Some(fabric) = cells.fabric(self, place, TUNING.under * width) else {
                    continue;
                };
                if !outline.contains(fabric) || self.is_at_its_end(fabric) {
                    continue;
                }
                found.length += length / parts as f64;
                if found.sharpest.is_none_or(|(turn, _)| edge.turn > turn) {
                    found.sharpest = Some((edge.turn, PlyPoint { fabric, place }));
                }
            }
        }
        Some(found)
    }

    /// Whether a fabric point (m) is where the net ends: places beside the net are closest to such points.
    fn is_at_its_end(&self, uv: [f64; 2]) -> bool {
        (0..2).any(|n| {
            let share = (uv[n] - self.placement.origin[n]) / self.placement.mesh[n];
            let last = (self.placement.nodes[n] - 1) as f64;
            share < TUNING.boundary_rounding || share > last - TUNING.boundary_rounding
        })
    }
}

/// The cells of a net by the cubes of space that they lie in.
struct Cells {
    side: f64,
    by_cube: HashMap<[i64; 3], Vec<[usize; 2]>>,
}

impl Cells {
    fn new(net: &Net, side: f64) -> Self {
        let [nu, nv] = net.placement.nodes;
        let mut by_cube: HashMap<[i64; 3], Vec<[usize; 2]>> = HashMap::new();
        for j in 0..nv - 1 {
            for i in 0..nu - 1 {
                let Some([a, _, c, _]) = corners(net, [i, j]) else { continue };
                let middle = between(a, c, 0.5);
                by_cube.entry(cube(middle, side)).or_default().push([i, j]);
            }
        }
        Cells { side, by_cube }
    }

    /// Fabric coordinates of the net's point closest to a place, if it is no farther than `most` (m).
    fn fabric(&self, net: &Net, place: [f64; 3], most: f64) -> Option<[f64; 2]> {
        let mut best: Option<(f64, [f64; 2])> = None;
        let middle = cube(place, self.side);
        for n in 0..27 {
            let beside = [n % 3, n / 3 % 3, n / 9].map(|c| c - 1);
            let key = [0, 1, 2].map(|c| middle[c] + beside[c]);
            for &cell in self.by_cube.get(&key).into_iter().flatten() {
                let Some([a, b, c, d]) = corners(net, cell) else { continue };
                // two triangles, from the lowest corner and from the highest
                for (triangle, [p, q, r]) in
                    [([a, b, d], [[0, 0], [1, 0], [0, 1]]), ([c, d, b], [[1, 1], [0, 1], [1, 0]])]
                {
                    let Closest { weights: [_, s, t], square, .. } = closest(triangle, place);
                    let away = square.sqrt();
                    if away <= most && best.is_none_or(|(least, _)| away < least) {
                        let fabric_place = |n: usize| {
                            let [p, q, r] = [p, q, r].map(|corner: [usize; 2]| corner[n] as f64);
                            cell[n] as f64 + p + s * (q - p) + t * (r - p)
                        };
                        let [du, dv] = net.placement.mesh;
                        let [u, v] = net.placement.origin;
                        best = Some((away, [u + fabric_place(0) * du, v + fabric_place(1) * dv]));
                    }
                }
            }
        }
        best.map(|(_, fabric)| fabric)
    }
}

fn cube(place: [f64; 3], side: f64) -> [i64; 3] {
    place.map(|c| (c / side).floor() as i64)
}

/// Corners of a cell whose nodes are on the mold (m).
fn corners(net: &Net, [i, j]: [usize; 2]) -> Option<[[f64; 3]; 4]> {
    Some([
        net.node([i, j])?,
        net.node([i + 1, j])?,
        net.node([i + 1, j + 1])?,
        net.node([i, j + 1])?,
    ])
}
