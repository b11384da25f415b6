//! Which triangles touch, and which way they face.
//!
//! Two triangles that share an edge face the same way if they run along it in opposite directions. From
//! one triangle of each surface the others follow, edge by edge. Then a closed surface is turned so that
//! its volume Σ p·(q × r)/6 is positive, an open one so that its vector area points up.

use super::join::{Joined, middle};
use super::report::MeshReport;
use crate::Error;
use crate::geometry::vector::{cross, dot, norm, sub};
use crate::mold::tuning::TUNING;

/// No triangle: a boundary.
pub(super) const NONE: u32 = u32::MAX;
/// For each triangle its neighbors across the edges from corner k to corner k + 1.
pub(super) type Neighbors = Vec<[u32; 3]>;

/// One connected surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Component {
    pub closed: bool,
}

/// Both vertices of each edge in one number, the lower one first, and the side of a triangle that it is: 3 n + k for the side
/// from corner k to corner k + 1 of triangle n. Sorted, so that sides along the same edge follow each other.
pub(super) fn edges(triangles: &[[u32; 3]]) -> Vec<(u64, u32)> {
    let mut edges: Vec<(u64, u32)> = Vec::with_capacity(3 * triangles.len());
    for (corners, n) in triangles.iter().zip(0u32..) {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            edges.push(((u64::from(a.min(b)) << 32) | u64::from(a.max(b)), 3 * n + k as u32));
        }
    }
    edges.sort_unstable();
    edges
}

/// Finds the neighbors of all triangles; refuses edges of three triangles or more.
pub(super) fn neighbors(mesh: &Joined, noun: &'static str) -> Result<Neighbors, Error> {
    let mut neighbors = vec![[NONE; 3]; mesh.triangles.len()];
    for same in edges(&mesh.triangles).chunk_by(|a, b| a.0 == b.0) {
        match *same {
            [] | [_] => {}
            [(_, s), (_, t)] => {
                neighbors[s as usize / 3][s as usize % 3] = t / 3;
                neighbors[t as usize / 3][t as usize % 3] = s / 3;
            }
            [(_, s), (_, t), (_, u), ..] => {
                return Err(Error::MeshBranching {
                    noun,
                    numbers: [s, t, u].map(|side| mesh.numbers[side as usize / 3]),
                    place: edge_middle(mesh, s as usize / 3, s as usize % 3),
                });
            }
        }
    }
    Ok(neighbors)
}

/// Turns triangles over until each surface faces one way: outwards, or upwards if it is open.
/// Gives the component of each triangle, and the components.
pub(super) fn orient(
    mesh: &mut Joined,
    neighbors: &mut Neighbors,
    noun: &'static str,
    report: &mut MeshReport,
) -> Result<(Vec<u32>, Vec<Component>), Error> {
    let count = mesh.triangles.len();
    let (mut component, mut components) = (vec![NONE; count], Vec::new());
    let mut turn = vec![false; count];
    let mut members: Vec<u32> = Vec::new();
    for seed in 0..count {
        if component[seed] != NONE {
            continue;
        }
        // over each edge the neighbor must run the other way, else it is turned; a surface that asks for both has one side only
        let id = components.len() as u32;
        component[seed] = id;
        members.clear();
        members.push(seed as u32);
        let mut next = 0;
        let mut closed = true;
        while let Some(&t) = members.get(next) {
            next += 1;
            let t = t as usize;
            for k in 0..3 {
                let other = neighbors[t][k];
                if other == NONE {
                    closed = false;
                    continue;
                }
                let o = other as usize;
                let turned = turn[t] ^ along_same(mesh.triangles[t], k, mesh.triangles[o]);
                if component[o] == NONE {
                    component[o] = id;
                    turn[o] = turned;
                    members.push(other);
                } else if turn[o] != turned {
                    return Err(Error::MeshOneSided {
                        noun,
                        numbers: [mesh.numbers[t], mesh.numbers[o]],
                        place: edge_middle(mesh, t, k),
                    });
                }
            }
        }
        // a closed surface has its volume inside; an open one faces upwards, unless it stands on edge
        let sides = Sides::new(mesh, &members, &turn);
        let over = if closed {
            sides.volume < 0.0
        } else {
            let upwards = sides.vector_area[2] / sides.area;
            if upwards.abs() < TUNING.sideways {
                return Err(Error::MeshSideways {
                    noun,
                    number: mesh.numbers[seed],
                    triangles: members.len(),
                    upwards,
                });
            }
            upwards < 0.0
        };
        for &t in &members {
            turn[t as usize] ^= over;
        }
        components.push(Component { closed });
    }
    // turning swaps two corners, and with them two neighbors
    for t in 0..count {
        if turn[t] {
            mesh.triangles[t].swap(1, 2);
            neighbors[t].swap(0, 2);
            let corners = mesh.triangles[t].map(|n| mesh.vertices[n as usize]);
            report.flipped.note(mesh.numbers[t], middle(corners));
        }
    }
    Ok((component, components))
}

/// Whether another triangle runs along edge k of `corners` in the same direction.
fn along_same(corners: [u32; 3], k: usize, other: [u32; 3]) -> bool {
    let (a, b) = (corners[k], corners[(k + 1) % 3]);
    (0..3).any(|n| other[n] == a && other[(n + 1) % 3] == b)
}

fn edge_middle(mesh: &Joined, triangle: usize, k: usize) -> [f64; 3] {
    let corners = mesh.triangles[triangle].map(|n| mesh.vertices[n as usize]);
    [0, 1, 2].map(|n| 0.5 * (corners[k][n] + corners[(k + 1) % 3][n]))
}

/// Volume, vector area and area of some triangles.
struct Sides {
    volume: f64,
    vector_area: [f64; 3],
    area: f64,
}

impl Sides {
    fn new(mesh: &Joined, members: &[u32], turn: &[bool]) -> Self {
        let mut sides = Sides { volume: 0.0, vector_area: [0.0; 3], area: 0.0 };
        // volumes are counted from a vertex, so that a far origin costs no digits
        let origin = members
            .first()
            .map_or([0.0; 3], |&t| mesh.vertices[mesh.triangles[t as usize][0] as usize]);
        for &t in members {
            let corners = mesh.triangles[t as usize];
            let [a, b, c] = corners.map(|n| sub(mesh.vertices[n as usize], origin));
            let sign = if turn[t as usize] { -1.0 } else { 1.0 };
            let area = cross(sub(b, a), sub(c, a)).map(|x| 0.5 * sign * x);
            sides.volume += sign * dot(a, cross(b, c)) / 6.0;
            sides.area += norm(area);
            sides.vector_area = [0, 1, 2].map(|n| sides.vector_area[n] + area[n]);
        }
        sides
    }
}
