//! From loose triangles to joined ones: vertices that coincide become one, what has no area is left out.

use super::report::{Finding, MeshReport};
use super::soup::Soup;
use super::triangle::double_area;
use crate::geometry::vector::{cross, distance, dot, norm, sub};
use crate::mold::tuning::TUNING;
use std::collections::{HashMap, HashSet};

/// Triangles over shared vertices, each with its number in the file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Joined {
    pub vertices: Vec<[f64; 3]>,
    pub triangles: Vec<[u32; 3]>,
    pub numbers: Vec<u64>,
}

/// Joins triangles whose vertices coincide, exactly or within a share of `size`, the diagonal of the box
/// around them (m). Triangles without area and repeated ones are dropped and noted.
pub(super) fn join(soup: &Soup, size: f64, report: &mut MeshReport) -> Joined {
    let same = merge(&soup.points, TUNING.merge * size, &mut report.merged);
    let mut joined = Joined { vertices: Vec::new(), triangles: Vec::new(), numbers: Vec::new() };
    let mut seen: HashSet<[u32; 3]> = HashSet::with_capacity(soup.triangles.len());
    let mut index = vec![u32::MAX; soup.points.len()];
    for (triangle, &number) in soup.triangles.iter().zip(&soup.numbers) {
        let corners = triangle.map(|n| same[n as usize]);
        let points = corners.map(|n| soup.points[n as usize]);
        if !has_area(corners, points) {
            report.degenerate.note(number, points[0]);
            continue;
        }
        let mut key = corners;
        key.sort_unstable();
        if !seen.insert(key) {
            report.duplicate.note(number, middle(points));
            continue;
        }
        // vertices in the order of their first use; unused ones drop out
        let corners = corners.map(|n| {
            if index[n as usize] == u32::MAX {
                index[n as usize] = joined.vertices.len() as u32;
                joined.vertices.push(soup.points[n as usize]);
            }
            index[n as usize]
        });
        joined.triangles.push(corners);
        joined.numbers.push(number);
    }
    joined
}

impl Joined {
    /// Numbers the vertices in the order in which the triangles, as they are turned now, use them: a mold that is
    /// written and read again is numbered the same.
    pub fn renumber(&mut self) {
        let mut index = vec![u32::MAX; self.vertices.len()];
        let mut vertices = Vec::with_capacity(self.vertices.len());
        for corner in self.triangles.as_flattened_mut() {
            let new = &mut index[*corner as usize];
            if *new == u32::MAX {
                *new = vertices.len() as u32;
                vertices.push(self.vertices[*corner as usize]);
            }
            *corner = *new;
        }
        self.vertices = vertices;
    }

    /// Leaves out triangles that cap a vertex beside the middle of a side and are no higher than `least` (m), which is less than
    /// the digits of files tell: they face anywhere. The vertex then divides the side, once both are stitched.
    pub fn leave_out_caps(&mut self, least: f64, report: &mut MeshReport) {
        let is_cap = |corners: &[u32; 3]| {
            let points = corners.map(|n| self.vertices[n as usize]);
            (0..3).any(|k| {
                let [a, b, c] = [0, 1, 2].map(|n| points[(k + n) % 3]);
                let length = distance(a, b);
                let along = dot(sub(c, a), sub(b, a)) / length;
                let height = norm(cross(sub(b, a), sub(c, a))) / length;
                let inside = TUNING.cap_flatness * least;
                height <= least && along > inside && length - along > inside
            })
        };
        let caps: Vec<bool> = self.triangles.iter().map(is_cap).collect();
        // nothing is left of a strip that is as narrow
        if caps.iter().all(|cap| *cap) {
            return;
        }
        for (n, _) in caps.iter().enumerate().filter(|(_, cap)| **cap) {
            let points = self.triangles[n].map(|n| self.vertices[n as usize]);
            report.degenerate.note(self.numbers[n], points[0]);
        }
        let mut cap = caps.iter();
        self.triangles.retain(|_| cap.next() != Some(&true));
        let mut cap = caps.iter();
        self.numbers.retain(|_| cap.next() != Some(&true));
    }
}

/// Whether a triangle has three different vertices and, to rounding, an area.
pub(super) fn has_area([a, b, c]: [u32; 3], points: [[f64; 3]; 3]) -> bool {
    let [p, q, r] = points;
    let longest = distance(p, q).max(distance(q, r)).max(distance(r, p));
    let twice_area = norm(double_area(points));
    a != b && b != c && c != a && twice_area > TUNING.needle * longest * longest
}

/// The middle of a triangle.
pub(super) fn middle([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    [0, 1, 2].map(|n| (a[n] + b[n] + c[n]) / 3.0)
}

/// For each point the first one that it coincides with.
///
/// Exactly equal points are found by their bits; what is left goes into a grid of cells wide enough that
/// most points need to look into one cell only.
fn merge(points: &[[f64; 3]], tolerance: f64, merged: &mut Finding) -> Vec<u32> {
    let mut first: HashMap<[u64; 3], u32> = HashMap::with_capacity(points.len() / 3);
    let mut same: Vec<u32> = Vec::with_capacity(points.len());
    for (point, n) in points.iter().zip(0..) {
        // + 0.0 turns −0 into 0
        same.push(*first.entry(point.map(|x| (x + 0.0).to_bits())).or_insert(n));
    }

    let cell = 16.0 * tolerance;
    let mut cells: HashMap<[i64; 3], Vec<u32>> = HashMap::with_capacity(first.len());
    for n in 0..points.len() {
        if same[n] != n as u32 {
            same[n] = same[same[n] as usize];
            continue;
        }
        let p = points[n];
        let cell_at = |p: [f64; 3]| p.map(|x| (x / cell).floor() as i64);
        let (low, high) = (cell_at(p.map(|x| x - tolerance)), cell_at(p.map(|x| x + tolerance)));
        let mut near = None;
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    for &other in cells.get(&[x, y, z]).into_iter().flatten() {
                        if distance(points[other as usize], p) <= tolerance {
                            near = Some(near.map_or(other, |n: u32| n.min(other)));
                        }
                    }
                }
            }
        }
        match near {
            Some(other) => {
                same[n] = other;
                merged.note(n as u64 + 1, p);
            }
            None => cells.entry(cell_at(p)).or_default().push(n as u32),
        }
    }
    same
}
