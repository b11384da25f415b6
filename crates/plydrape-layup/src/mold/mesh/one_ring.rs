//! The triangles around a vertex: its one-ring, which begins and ends at the boundary if there is one.

use super::join::Joined;
use super::orient::{NONE, Neighbors};

/// Corner `k` of triangle `t`.
pub(super) type Corner = (usize, usize);

/// The next corner at the same vertex, anticlockwise seen from outside; `None` at the boundary.
pub(super) fn next(
    triangles: &[[u32; 3]],
    neighbors: &[[u32; 3]],
    (t, k): Corner,
) -> Option<Corner> {
    across(triangles, neighbors, (t, k), (k + 2) % 3)
}

/// The next corner at the same vertex, clockwise; `None` at the boundary.
fn previous(triangles: &[[u32; 3]], neighbors: &[[u32; 3]], (t, k): Corner) -> Option<Corner> {
    across(triangles, neighbors, (t, k), k)
}

fn across(
    triangles: &[[u32; 3]],
    neighbors: &[[u32; 3]],
    (t, k): Corner,
    edge: usize,
) -> Option<Corner> {
    let other = neighbors[t][edge];
    let index = triangles.get(other as usize)?.iter().position(|n| *n == triangles[t][k])?;
    Some((other as usize, index))
}

/// Gives every vertex one one-ring: a vertex at which several of them meet in a point only is doubled.
/// Returns the first corner of each one-ring.
pub(super) fn split(mesh: &mut Joined, neighbors: &Neighbors) -> Vec<Corner> {
    let unknown: Corner = (NONE as usize, 0);
    let mut first = vec![unknown; mesh.vertices.len()];
    let mut done = vec![[false; 3]; mesh.triangles.len()];
    for t in 0..mesh.triangles.len() {
        for k in 0..3 {
            if done[t][k] {
                continue;
            }
            // around the vertex back to a boundary, or once around
            let mut start = (t, k);
            while let Some(before) = previous(&mesh.triangles, neighbors, start) {
                start = before;
                if start == (t, k) {
                    break;
                }
            }
            // and forth over all triangles of this ring
            let mut corners = Vec::with_capacity(8);
            let mut corner = Some(start);
            while let Some((t, k)) = corner.filter(|&(t, k)| !done[t][k]) {
                done[t][k] = true;
                corners.push((t, k));
                corner = next(&mesh.triangles, neighbors, (t, k));
            }
            // a vertex with a ring already is doubled for the further one
            let vertex = mesh.triangles[t][k] as usize;
            if first[vertex] == unknown {
                first[vertex] = start;
                continue;
            }
            let twin = mesh.vertices.len() as u32;
            mesh.vertices.push(mesh.vertices[vertex]);
            first.push(start);
            for (t, k) in corners {
                mesh.triangles[t][k] = twin;
            }
        }
    }
    first
}
