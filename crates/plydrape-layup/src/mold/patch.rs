//! A part of a mold in triangles, for pictures and other programs.
//!
//! Triangles of a mesh are given as they are. Any other mold is sampled from above: its highest points over the
//! corners of a grid, and where it ends within a cell of the grid, its boundary, found by bisection.

use super::Mold;
use std::collections::BTreeMap;

/// Triangles with shared corners, counterclockwise as seen from the side that the ply comes from.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Triangles {
    /// Corners (m).
    pub vertices: Vec<[f64; 3]>,
    /// Indices of the corners of each triangle.
    pub triangles: Vec<[u32; 3]>,
}

/// Most triangles that a mold is sampled in.
const MOST_SAMPLED: usize = 1_000_000;

/// The mold over the rectangle of the plan from `low` to `high` (m), in about `most` triangles or fewer; empty where there is nothing of
/// it. A mold of triangles that are no more has these; any other is sampled in a million at most.
#[must_use]
pub fn patch(mold: &Mold, low: [f64; 2], high: [f64; 2], most: usize) -> Triangles {
    if let Mold::Mesh(mesh) = mold {
        let near = |corners: &&[u32; 3]| {
            (0..2).all(|c| {
                let along = corners.map(|n| mesh.vertices()[n as usize][c]);
                along.iter().any(|x| *x >= low[c]) && along.iter().any(|x| *x <= high[c])
            })
        };
        let triangles: Vec<[u32; 3]> = mesh.triangles().iter().filter(near).copied().collect();
        if triangles.len() <= most {
            return used(mesh.vertices(), &triangles);
        }
    }
    sampled(&|[x, y]| mold.highest_point([x, y]), low, high, most)
}

/// Triangles with only the corners that they use, in the order in which they use them.
fn used(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Triangles {
    let mut out = Triangles::default();
    let mut number = BTreeMap::new();
    for corners in triangles {
        out.triangles.push(corners.map(|n| {
            *number.entry(n).or_insert_with(|| {
                out.vertices.push(vertices[n as usize]);
                out.vertices.len() as u32 - 1
            })
        }));
    }
    out
}

/// A height over a rectangle, in two triangles for each cell of a grid.
fn sampled(
    on: &dyn Fn([f64; 2]) -> Option<[f64; 3]>,
    low: [f64; 2],
    high: [f64; 2],
    most: usize,
) -> Triangles {
    let wide = [0, 1].map(|c| high[c] - low[c]);
    let most = most.clamp(2, MOST_SAMPLED);
    let side = (2.0 * wide[0] * wide[1] / most as f64).sqrt();
    let count = wide.map(|w| ((w / side).floor() as usize).clamp(1, most / 2));
    let plan = |[i, j]: [usize; 2]| {
        [(0, i), (1, j)].map(|(c, k)| low[c] + wide[c] * k as f64 / count[c] as f64)
    };
    let mut out = Triangles::default();
    // corners and boundary points by what they lie between
    let mut number: BTreeMap<[[usize; 2]; 2], Option<u32>> = BTreeMap::new();
    let mut point = |a: [usize; 2], b: [usize; 2], out: &mut Triangles| {
        *number.entry([a, b]).or_insert_with(|| {
            let inside = on(plan(a)).filter(|p| p.iter().all(|c| c.is_finite()))?;
            let [end, without] = [a, b].map(plan);
            let p = if a == b { inside } else { boundary(inside, end, without, on) };
            out.vertices.push(p);
            Some(out.vertices.len() as u32 - 1)
        })
    };
    for j in 0..count[1] {
        for i in 0..count[0] {
            let ring = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
            let found = ring.map(|corner| point(corner, corner, &mut out));
            let mut outline: Vec<u32> = Vec::with_capacity(6);
            for n in 0..4 {
                let (a, b) = (n, (n + 1) % 4);
                outline.extend(found[a]);
                match (found[a], found[b]) {
                    (Some(_), None) => outline.extend(point(ring[a], ring[b], &mut out)),
                    (None, Some(_)) => outline.extend(point(ring[b], ring[a], &mut out)),
                    _ => {}
                }
            }
            for n in 2..outline.len() {
                out.triangles.push([outline[0], outline[n - 1], outline[n]]);
            }
        }
    }
    out
}

/// The last point of the mold (m) on the way from a place with one to a place without.
fn boundary(
    mut last: [f64; 3],
    mut with: [f64; 2],
    mut without: [f64; 2],
    on: &dyn Fn([f64; 2]) -> Option<[f64; 3]>,
) -> [f64; 3] {
    for _ in 0..20 {
        let middle = [0, 1].map(|c| 0.5 * (with[c] + without[c]));
        match on(middle) {
            Some(point) => (last, with) = (point, middle),
            None => without = middle,
        }
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mold::{Face, Pose, Sphere};

    fn ball() -> Mold {
        let pose = Pose::new([0.0, 0.0, -0.2], [0.0; 3]);
        Mold::Sphere(Sphere { pose, radius: 0.2, face: Face::Outside })
    }

    fn area(patch: &Triangles) -> f64 {
        let twice = |[a, b, c]: [[f64; 3]; 3]| {
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        patch.triangles.iter().map(|t| 0.5 * twice(t.map(|n| patch.vertices[n as usize]))).sum()
    }

    /// From above, a ball of 0.2 m is a disc: its triangles face up, lie on it, end at its equator and cover πr².
    #[test]
    fn a_ball_is_a_disc_from_above() {
        let patch = patch(&ball(), [-0.3, -0.3], [0.3, 0.3], 20_000);
        assert!(patch.triangles.len() <= 20_000);
        assert!(patch.vertices.iter().all(|p| ball().signed_distance(*p).abs() < 1e-9));
        let disc = std::f64::consts::PI * 0.04;
        assert!((area(&patch) / disc - 1.0).abs() < 2e-3, "{}", area(&patch) / disc);
    }

    /// However many are asked for, there is room for what comes.
    #[test]
    fn a_sampled_mold_has_a_million_triangles_at_most() {
        let patch = patch(&ball(), [-0.1, -1e-4], [0.1, 1e-4], usize::MAX);
        assert!((500_000..=MOST_SAMPLED).contains(&patch.triangles.len()));
    }

    /// No more triangles than asked for, and the whole rectangle all the same.
    #[test]
    fn the_number_of_triangles_is_bounded() {
        for most in [2, 10, 333, 5000] {
            let patch = patch(&ball(), [-0.1, -0.02], [0.1, 0.02], most);
            assert!(!patch.triangles.is_empty() && patch.triangles.len() <= most, "{most}");
            assert!((area(&patch) - 0.2 * 0.04).abs() < 1e-12, "{most}");
        }
    }
}
