//! Sides of triangles that lie on a boundary, and which of them face each other over a gap.

use super::bounds;
use super::orient::edges;
use super::tree::Tree;
use crate::geometry::vector::{along, direction, distance, dot, sub, unit};
use crate::mold::tuning::TUNING;

/// A side of a triangle that has no other triangle beyond it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Side {
    pub triangle: u32,
    /// The vertices at its ends.
    pub ends: [u32; 2],
    /// Their places (m).
    pub points: [[f64; 3]; 2],
    /// Length (m).
    pub length: f64,
    /// Unit vector from its first end to its second.
    pub direction: [f64; 3],
    /// Unit vector in the plane of its triangle, away from it.
    pub outward: [f64; 3],
}

/// The sides of a mesh that lie on a boundary, and a tree over them.
pub(super) struct Sides {
    pub all: Vec<Side>,
    tree: Option<Tree>,
}

impl Side {
    fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]], triangle: u32, corner: usize) -> Self {
        let corners = triangles[triangle as usize];
        let [a, b, c] = [0, 1, 2].map(|n| corners[(corner + n) % 3]);
        let [p, q, r] = [a, b, c].map(|n| vertices[n as usize]);
        let direction = direction(sub(q, p)).unwrap_or([0.0; 3]);
        let inward = sub(r, p);
        let inward = along(inward, -dot(inward, direction), direction);
        let outward = unit(inward).unwrap_or([0.0; 3]).map(|x| -x);
        let length = distance(p, q);
        Side { triangle, ends: [a, b], points: [p, q], length, direction, outward }
    }

    /// Where along it a point is closest, from 0 to 1, and how far away (m).
    pub fn closest(&self, p: [f64; 3]) -> (f64, f64) {
        let share = (dot(sub(p, self.points[0]), self.direction) / self.length).clamp(0.0, 1.0);
        (share, distance(p, self.point_at(share)))
    }

    /// Point at a share of its length (m).
    pub fn point_at(&self, share: f64) -> [f64; 3] {
        along(self.points[0], share * self.length, self.direction)
    }

    /// Whether another side runs beside it for a part of its length, with its triangle turned away: both lie on a gap, a
    /// step or an overlap. Sides of the same boundary that follow each other do not, nor do those of two faces back to back.
    pub fn faces(&self, other: &Side) -> bool {
        let [from, to] = other.points.map(|p| dot(sub(p, self.points[0]), self.direction));
        let overlap = from.max(to).min(self.length) - from.min(to).max(0.0);
        overlap > TUNING.beside * self.length.min(other.length)
            && dot(self.direction, other.direction).abs() > TUNING.parallel_sides
            && dot(self.outward, other.outward) < TUNING.back_to_back
    }
}

impl Sides {
    /// All boundary sides of a mesh, in the order of their triangles.
    pub fn new(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Self {
        let edges = edges(triangles);
        let lone = edges.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
        let mut numbers: Vec<u32> = lone.map(|same| same[0].1).collect();
        numbers.sort_unstable();
        let side = |n: &u32| Side::new(vertices, triangles, n / 3, *n as usize % 3);
        let all: Vec<Side> = numbers.iter().map(side).collect();
        let tree = (!all.is_empty())
            .then(|| Tree::new(all.iter().map(|side| bounds(side.points.into_iter()))));
        Sides { all, tree }
    }

    /// The numbers of those whose boxes are within a distance (m) of the box around some points (m), in ascending order.
    pub fn near(&self, points: impl Iterator<Item = [f64; 3]>, distance: f64) -> Vec<usize> {
        let [low, high] = bounds(points);
        let region = [low.map(|x| x - distance), high.map(|x| x + distance)];
        let mut found: Vec<usize> =
            self.tree.iter().flat_map(|tree| tree.touching(region)).map(|n| n as usize).collect();
        found.sort_unstable();
        found
    }
}
