//! Sharp edges: where a mesh turns from one triangle to the next.

use super::Mesh;
use super::orient::NONE;
use crate::geometry::vector::{cross, dot, norm};

/// An edge across which the mesh turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SharpEdge {
    /// Ends (m).
    pub ends: [[f64; 3]; 2],
    /// Angle between the normals of its two triangles (rad).
    pub turn: f64,
}

impl Mesh {
    /// Edges across which it turns by more than an angle (rad).
    pub fn sharp_edges(&self, angle: f64) -> impl Iterator<Item = SharpEdge> + '_ {
        let sides = (0..self.triangles.len()).flat_map(|t| (0..3).map(move |k| (t, k)));
        sides.filter_map(move |(t, k)| {
            let other = self.neighbors[t][k];
            // of two triangles the first one says it
            if other == NONE || (other as usize) < t {
                return None;
            }
            let [p, q] = [t, other as usize].map(|n| self.triangle_normals[n]);
            let turn = norm(cross(p, q)).atan2(dot(p, q));
            let corners = self.corners(t);
            (turn > angle).then_some(SharpEdge { ends: [corners[k], corners[(k + 1) % 3]], turn })
        })
    }
}
