//! The boundaries of an open surface.

use super::orient::{Component, NONE, Neighbors};
use crate::geometry::vector::distance;

/// A closed line of edges that have a triangle on one side only.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Boundary {
    /// Vertices in turn, the surface to the left.
    pub vertices: Vec<u32>,
    /// Length (m).
    pub length: f64,
    /// Corners of the box around it (m): lowest and highest coordinates.
    pub bounds: [[f64; 3]; 2],
    /// The connected surface it belongs to.
    pub surface: usize,
    /// Not the longest boundary of its surface.
    pub hole: bool,
}

/// All boundaries: around each surface the longest is the outer one, the others are holes.
pub(super) fn boundaries(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    neighbors: &Neighbors,
    component: &[u32],
    components: &[Component],
) -> Vec<Boundary> {
    let mut done = vec![[false; 3]; triangles.len()];
    let mut boundaries: Vec<Boundary> = Vec::new();
    // follow edges without a neighbor until they close
    for start in 0..triangles.len() {
        for side in 0..3 {
            if neighbors[start][side] != NONE || done[start][side] {
                continue;
            }
            let mut line = Vec::new();
            let (mut t, mut k) = (start, side);
            while !done[t][k] {
                done[t][k] = true;
                line.push(triangles[t][k]);
                (t, k) = next_on_boundary(triangles, neighbors, t, k);
            }
            boundaries.push(boundary(vertices, line, component[start] as usize));
        }
    }
    // the longest boundary of a surface is its outer one
    let mut outer: Vec<Option<usize>> = vec![None; components.len()];
    for (n, boundary) in boundaries.iter().enumerate() {
        let best = &mut outer[boundary.surface];
        if best.is_none_or(|m| boundary.length > boundaries[m].length) {
            *best = Some(n);
        }
    }
    for (n, boundary) in boundaries.iter_mut().enumerate() {
        boundary.hole = outer[boundary.surface] != Some(n);
    }
    boundaries
}

/// The boundary edge that begins where boundary edge k of triangle t ends: around that vertex over the
/// triangles in between.
fn next_on_boundary(
    triangles: &[[u32; 3]],
    neighbors: &Neighbors,
    t: usize,
    k: usize,
) -> (usize, usize) {
    let (mut t, mut k) = (t, (k + 1) % 3);
    let pivot = triangles[t][k];
    while neighbors[t][k] != NONE {
        t = neighbors[t][k] as usize;
        k = (0..3).find(|&n| triangles[t][n] == pivot).unwrap_or(0);
    }
    (t, k)
}

fn boundary(points: &[[f64; 3]], vertices: Vec<u32>, surface: usize) -> Boundary {
    let vertex = |n: usize| points[vertices[n % vertices.len()] as usize];
    let length = (0..vertices.len()).map(|n| distance(vertex(n), vertex(n + 1))).sum();
    let bounds = super::bounds(vertices.iter().map(|n| points[*n as usize]));
    Boundary { vertices, length, bounds, surface, hole: false }
}
