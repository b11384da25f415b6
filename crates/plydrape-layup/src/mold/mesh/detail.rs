//! Details of a mold that no ply follows: pits and studs that are narrower than the net of the ideal drape can see.
//!
//! A triangle that faces up belongs to a detail if it lies below or above the surface around it. That surface is a
//! paraboloid through the highest points of the mold over two rings around the triangle, wider than the detail. Its
//! coefficients minimize the sum of the distances, not of their squares, so that a groove that crosses the rings, or a
//! step beside them, does not bend it; they are found by weights that are made anew from the distances (IRLS, Schlossmacher
//! 1973). A detail ends at the level of the surface around it: what goes on at its own level is a step, an edge or a top of
//! the mold itself.
//!
//! Fabric spans a pit. So the triangles of a pit can be replaced by a flat cap, and so can an open hole.

use super::join::middle;
use super::orient::NONE;
use super::soup::Soup;
use super::{Mesh, MeshReport};
use crate::geometry::vector::{along, cross, norm, sub};
use crate::mold::Pose;
use crate::mold::tuning::TUNING;
use nalgebra::{SMatrix, SVector};
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

/// A pit, a stud or a hole of a mold.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Detail {
    /// What it is.
    pub kind: DetailKind,
    /// Width in plan, of a long one across (m).
    pub width: f64,
    /// Length in plan (m).
    pub length: f64,
    /// How far it goes below the surface around it, or above (m); 0 of a hole.
    pub depth: f64,
    /// Middle, on the surface around it (m).
    pub place: [f64; 3],
    /// The ply spans it: a cap was put in its place.
    pub spanned: bool,
}

/// What a detail is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "lowercase"))]
pub enum DetailKind {
    /// Below the surface around it: a blind hole, a groove, an engraved mark.
    Pit,
    /// Above it: an ejector pin, a screw.
    Stud,
    /// There is nothing below it.
    Hole,
}

/// The surface around a place: a paraboloid over the plan.
#[derive(Clone, Copy)]
struct Around {
    center: [f64; 2],
    /// Length of one unit of its coordinates (m).
    unit: f64,
    coefficients: SVector<f64, 6>,
    /// Half of the highest points that it is made from are within this distance of it (m).
    spread: f64,
}

/// A triangle of a detail, with the surface around it.
struct Off {
    triangle: usize,
    around: Around,
    below: bool,
}

impl Mesh {
    /// The mold as plies see it: with a flat cap over every pit and hole in plan that is no wider than `spanned` (m), and with
    /// what is found of pits, holes, studs and gaps of up to `width` (m), or of up to `spanned` if that is more, added to its
    /// report. What is less than `tolerance` (m) deep or high is no detail.
    #[must_use]
    pub fn spanned(
        self,
        report: MeshReport,
        spanned: f64,
        width: f64,
        tolerance: f64,
    ) -> (Self, MeshReport) {
        let width = width.max(spanned);
        let (capped, mut details) = self.capped(spanned, width, tolerance);
        let still = Pose::new([0.0; 3], [0.0; 3]);
        let (mesh, mut report) = match capped.map(|soup| Self::of_soup(soup, 1.0, &still, 0.0)) {
            Some(Ok((mesh, own))) => {
                let MeshReport { vertices, triangles, surfaces, closed, holes, .. } = own;
                let report = MeshReport { vertices, triangles, surfaces, closed, holes, ..report };
                (mesh, report)
            }
            // a mold that is none any more stays as it was
            Some(Err(_)) => {
                details.iter_mut().for_each(|detail| detail.spanned = false);
                (self, report)
            }
            None => (self, report),
        };
        report.gaps = mesh.gaps(width);
        report.details = details;
        (mesh, report)
    }

    /// Pits, holes and studs of up to a width in plan (m), the widest first. What is less than `tolerance` (m) deep or high is no
    /// detail.
    #[must_use]
    pub fn details(&self, width: f64, tolerance: f64) -> Vec<Detail> {
        let (_, mut details) = self.capped(0.0, width, tolerance);
        details.sort_by(|a, b| b.width.total_cmp(&a.width));
        details
    }

    /// The triangles with caps, if there is something to cap, and all details.
    fn capped(&self, spanned: f64, width: f64, tolerance: f64) -> (Option<Soup>, Vec<Detail>) {
        let mut details = Vec::new();
        let mut left_out: HashSet<usize> = HashSet::new();
        let mut caps: Vec<Vec<u32>> = Vec::new();
        // holes of an open surface: level boundaries that are narrow enough
        for boundary in self.boundaries.iter().filter(|boundary| boundary.hole) {
            let points: Vec<[f64; 3]> =
                boundary.vertices.iter().map(|n| self.vertices[*n as usize]).collect();
            let Some(size) = Size::new(&points, None).filter(|size| size.width <= width) else {
                continue;
            };
            if boundary.vertices.len() <= TUNING.cap_corners
                && self.is_level(&boundary.vertices, width, tolerance)
            {
                let is_spanned = size.width <= spanned;
                if is_spanned {
                    caps.push(boundary.vertices.iter().rev().copied().collect());
                }
                let place = boundary_middle(&points);
                details.push(size.detail(DetailKind::Hole, 0.0, place, is_spanned));
            }
        }
        // pits and studs: what lies off the surface around it; a pit is capped unless another cap has taken its triangles
        for part in self.parts(self.off_surface(width, tolerance), tolerance) {
            let Some(mut detail) = self.detail(&part).filter(|detail| detail.width <= width) else {
                continue;
            };
            if detail.kind == DetailKind::Pit
                && detail.width <= spanned
                && let Some((region, cap)) = self.cap(&part, width, tolerance)
                && left_out.is_disjoint(&region)
            {
                left_out.extend(region);
                caps.push(cap);
                detail.spanned = true;
            }
            details.push(detail);
        }
        details.extend(self.through_holes(width, tolerance));
        if caps.is_empty() {
            return (None, details);
        }
        // the surface without the pits, and with the caps
        let mut soup = Soup::new("triangle");
        soup.points.clone_from(&self.vertices);
        for (n, corners) in self.triangles.iter().enumerate() {
            if !left_out.contains(&n) {
                soup.push(corners, n as u64 + 1);
            }
        }
        let number = self.triangles.len() as u64 + 1;
        caps.iter().for_each(|cap| soup.push(cap, number));
        (Some(soup), details)
    }

    /// The triangles that lie below or above the surface around them, by their numbers.
    fn off_surface(&self, width: f64, tolerance: f64) -> BTreeMap<usize, Off> {
        let candidates = self.rough(width);
        // a mesh that is rough everywhere has no details of its own
        if candidates.len() > TUNING.most_rough {
            return BTreeMap::new();
        }
        let mut out = BTreeMap::new();
        for triangle in candidates {
            let Some(middle) = self.seen_from_above(triangle, tolerance) else { continue };
            let place = [middle[0], middle[1]];
            let Some(around) = self.around(place, width, tolerance) else { continue };
            let rise = middle[2] - around.height(place);
            if rise.abs() > tolerance + TUNING.off_surface * around.spread {
                out.insert(triangle, Off { triangle, around, below: rise < 0.0 });
            }
        }
        out
    }

    /// Triangles near which the mesh turns sharply within a width (m), in ascending order.
    fn rough(&self, width: f64) -> Vec<usize> {
        let cell = |p: [f64; 3]| p.map(|x| (x / width).floor() as i64);
        let mut normals: HashMap<[i64; 3], [[f64; 3]; 2]> = HashMap::new();
        for (corners, normal) in self.triangles.iter().zip(&self.triangle_normals) {
            for n in corners {
                let start = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
                let [low, high] = normals.entry(cell(self.vertices[*n as usize])).or_insert(start);
                *low = [0, 1, 2].map(|c| low[c].min(normal[c]));
                *high = [0, 1, 2].map(|c| high[c].max(normal[c]));
            }
        }
        let is_rough = |n: &u32| {
            normals
                .get(&cell(self.vertices[*n as usize]))
                .is_some_and(|[low, high]| norm(sub(*high, *low)) > TUNING.rough)
        };
        (0..self.triangles.len()).filter(|t| self.triangles[*t].iter().any(is_rough)).collect()
    }

    /// The middle of a triangle (m), if it faces up and nothing lies above it.
    fn seen_from_above(&self, triangle: usize, tolerance: f64) -> Option<[f64; 3]> {
        if self.triangle_normals[triangle][2] < TUNING.wall {
            return None;
        }
        let middle = middle(self.corners(triangle));
        let top = self.highest_point([middle[0], middle[1]])?;
        (top[2] - middle[2] <= tolerance).then_some(middle)
    }

    /// The surface around a place, from rings that are wider than details of some width (m); `None` where the mold ends
    /// within them, or has no surface there that most of it lies on.
    fn around(&self, center: [f64; 2], width: f64, tolerance: f64) -> Option<Around> {
        let count = TUNING.ring_points;
        let mut rows: Vec<(SVector<f64, 6>, f64)> = Vec::with_capacity(2 * count);
        for (ring, radius) in TUNING.rings.into_iter().enumerate() {
            for n in 0..count {
                // the second ring half a step on
                let angle = std::f64::consts::TAU * (n as f64 + 0.5 * ring as f64) / count as f64;
                let [x, y] = [radius * angle.cos(), radius * angle.sin()];
                let place = [center[0] + width * x, center[1] + width * y];
                if let Some(top) = self.highest_point(place) {
                    rows.push((terms([x, y]), top[2]));
                }
            }
        }
        if (rows.len() as f64) < TUNING.ring_share * 2.0 * count as f64 {
            return None;
        }
        let mut weights = vec![1.0; rows.len()];
        let mut coefficients = SVector::<f64, 6>::zeros();
        let least = 0.01 * tolerance;
        for _ in 0..TUNING.ring_rounds {
            let mut left = SMatrix::<f64, 6, 6>::zeros();
            let mut right = SVector::<f64, 6>::zeros();
            for ((row, z), weight) in rows.iter().zip(&weights) {
                left += row * row.transpose() * *weight;
                right += row * (*z * *weight);
            }
            coefficients = left.cholesky()?.solve(&right);
            for ((row, z), weight) in rows.iter().zip(&mut weights) {
                *weight = 1.0 / (row.dot(&coefficients) - z).abs().max(least);
            }
        }
        let mut off: Vec<f64> =
            rows.iter().map(|(row, z)| (row.dot(&coefficients) - z).abs()).collect();
        off.sort_by(f64::total_cmp);
        let spread = off[off.len() / 2];
        let near = off.iter().filter(|off| **off <= tolerance + 3.0 * spread).count();
        (near as f64 >= TUNING.ring_share * off.len() as f64).then_some(Around {
            center,
            unit: width,
            coefficients,
            spread,
        })
    }

    /// Whether all of some vertices lie on the surface around them.
    fn is_level(&self, vertices: &[u32], width: f64, tolerance: f64) -> bool {
        vertices.iter().all(|n| {
            let [x, y, z] = self.vertices[*n as usize];
            self.around([x, y], width, tolerance).is_some_and(|around| {
                (z - around.height([x, y])).abs() <= tolerance + TUNING.off_surface * around.spread
            })
        })
    }

    /// The connected parts of what lies off the surface, without those that go on at their own level.
    fn parts(&self, mut off: BTreeMap<usize, Off>, tolerance: f64) -> Vec<Vec<Off>> {
        let all: BTreeSet<(usize, bool)> =
            off.values().map(|own| (own.triangle, own.below)).collect();
        let mut parts = Vec::new();
        while let Some((_, first)) = off.pop_first() {
            let below = first.below;
            let mut part = vec![first];
            let mut walls: HashSet<usize> = HashSet::new();
            let mut next = 0;
            while next < part.len() {
                // over the walls beside a triangle, as between a countersink and its hole
                let Around { center, unit, .. } = part[next].around;
                let mut waiting = vec![part[next].triangle];
                while let Some(triangle) = waiting.pop() {
                    for other in self.neighbors[triangle].into_iter().filter(|n| *n != NONE) {
                        let other = other as usize;
                        if off.get(&other).is_some_and(|own| own.below == below) {
                            part.extend(off.remove(&other));
                        } else if self.is_within(other, center, unit)
                            && !walls.contains(&other)
                            && self.seen_from_above(other, tolerance).is_none()
                        {
                            walls.insert(other);
                            waiting.push(other);
                        }
                    }
                }
                next += 1;
            }
            // how much of its boundary is at its own level, though the mold goes on there
            let (mut whole, mut open) = (0.0, 0.0);
            for own in &part {
                for k in 0..3 {
                    let other = self.neighbors[own.triangle][k];
                    if other != NONE && all.contains(&(other as usize, below)) {
                        continue;
                    }
                    let corners = self.corners(own.triangle);
                    let side = sub(corners[(k + 1) % 3], corners[k]);
                    let middle = along(corners[k], 0.5, side);
                    whole += norm(side);
                    let rise = middle[2] - own.around.height([middle[0], middle[1]]);
                    let is_level = rise.abs() <= tolerance + TUNING.off_surface * own.around.spread;
                    if !is_level
                        && other != NONE
                        && self.seen_from_above(other as usize, tolerance).is_some()
                    {
                        open += norm(side);
                    }
                }
            }
            if open <= TUNING.open_share * whole {
                parts.push(part);
            }
        }
        parts
    }

    /// Whether a triangle lies in plan within a distance (m) of a place.
    fn is_within(&self, triangle: usize, [x, y]: [f64; 2], distance: f64) -> bool {
        self.corners(triangle).iter().all(|p| (p[0] - x).hypot(p[1] - y) <= distance)
    }

    /// Holes through a solid that are no wider than `width` (m): closed lines between what is seen from above and walls,
    /// over whose middle there is nothing.
    fn through_holes(&self, width: f64, tolerance: f64) -> Vec<Detail> {
        let mut next: BTreeMap<u32, u32> = BTreeMap::new();
        // edges between a wall and what is seen from above
        let rough = self.rough(width);
        for triangle in rough.into_iter().take(TUNING.most_rough) {
            if self.triangle_normals[triangle][2] >= TUNING.wall {
                continue;
            }
            for k in 0..3 {
                let other = self.neighbors[triangle][k];
                if other != NONE && self.seen_from_above(other as usize, tolerance).is_some() {
                    let corners = self.triangles[triangle];
                    next.insert(corners[k], corners[(k + 1) % 3]);
                }
            }
        }
        // chained to closed lines; with nothing over their middle they are holes
        let mut out = Vec::new();
        while let Some((start, mut vertex)) = next.pop_first() {
            let mut points = vec![self.vertices[start as usize]];
            while let Some(after) = next.remove(&vertex) {
                points.push(self.vertices[vertex as usize]);
                vertex = after;
            }
            let Some(size) = Size::new(&points, None).filter(|size| size.width <= width) else {
                continue;
            };
            if vertex == start && points.len() > 2 && self.highest_point(size.middle).is_none() {
                out.push(size.detail(DetailKind::Hole, 0.0, boundary_middle(&points), false));
            }
        }
        out
    }

    /// Size and place of a detail.
    fn detail(&self, part: &[Off]) -> Option<Detail> {
        let numbers: HashSet<usize> = part.iter().map(|own| own.triangle).collect();
        let (mut points, mut area, mut depth) = (Vec::new(), 0.0, 0.0_f64);
        // sides in plan; those above and below an upright wall lie inside
        let mut sides: HashMap<[[i64; 2]; 2], (usize, f64)> = HashMap::new();
        for own in part {
            let plan = |p: [f64; 3]| {
                [p[0], p[1]].map(|x| (x / (TUNING.same_in_plan * own.around.unit)).round() as i64)
            };
            let corners = self.corners(own.triangle);
            points.extend(corners);
            area += 0.5 * cross(sub(corners[1], corners[0]), sub(corners[2], corners[0]))[2].abs();
            for k in 0..3 {
                if !numbers.contains(&(self.neighbors[own.triangle][k] as usize)) {
                    let ends = [corners[k], corners[(k + 1) % 3]];
                    let side = sub(ends[1], ends[0]);
                    let mut key = ends.map(plan);
                    key.sort_unstable();
                    let own = sides.entry(key).or_insert((0, side[0].hypot(side[1])));
                    own.0 += 1;
                }
                let rise = corners[k][2] - own.around.height([corners[k][0], corners[k][1]]);
                depth = depth.max(if own.below { -rise } else { rise });
            }
        }
        let perimeter = sides.values().filter(|(count, _)| *count == 1).map(|(_, length)| length);
        // in their order, because a sum of floats depends on it
        let mut lengths: Vec<f64> = perimeter.copied().collect();
        lengths.sort_by(f64::total_cmp);
        let size = Size::new(&points, Some([area, lengths.iter().sum()]))?;
        let around = part.first()?.around;
        let [x, y] = size.middle;
        let kind = if part[0].below { DetailKind::Pit } else { DetailKind::Stud };
        Some(size.detail(kind, depth, [x, y, around.height([x, y])], false))
    }

    /// The triangles of a pit with its walls, and the corners of the flat cap that takes their place; `None` where its boundary
    /// is not one closed line on the surface around it.
    fn cap(&self, part: &[Off], width: f64, tolerance: f64) -> Option<(HashSet<usize>, Vec<u32>)> {
        let mut region: HashSet<usize> = part.iter().map(|own| own.triangle).collect();
        let mut waiting: Vec<usize> = part.iter().map(|own| own.triangle).collect();
        while let Some(triangle) = waiting.pop() {
            for other in self.neighbors[triangle] {
                if other == NONE {
                    return None;
                }
                let other = other as usize;
                if region.contains(&other) || self.seen_from_above(other, tolerance).is_some() {
                    continue;
                }
                // a wall; what leads away from the pit is none of its own
                if region.len() > part.len() + TUNING.cap_corners * 4 {
                    return None;
                }
                region.insert(other);
                waiting.push(other);
            }
        }
        let mut next: BTreeMap<u32, u32> = BTreeMap::new();
        for &triangle in &region {
            for k in 0..3 {
                let other = self.neighbors[triangle][k];
                if other != NONE && region.contains(&(other as usize)) {
                    continue;
                }
                let corners = self.triangles[triangle];
                if next.insert(corners[k], corners[(k + 1) % 3]).is_some() {
                    return None;
                }
            }
        }
        let (&start, _) = next.first_key_value()?;
        let mut line = vec![start];
        while let Some(&vertex) = next.get(line.last()?) {
            if vertex == start {
                break;
            }
            if line.len() > next.len() {
                return None;
            }
            line.push(vertex);
        }
        let is_one = line.len() == next.len() && (3..=TUNING.cap_corners).contains(&line.len());
        (is_one && self.is_level(&line, width, tolerance)).then_some((region, line))
    }
}

impl Around {
    /// Height at a place of the plan (m).
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        let [x, y] = [(x - self.center[0]) / self.unit, (y - self.center[1]) / self.unit];
        terms([x, y]).dot(&self.coefficients)
    }
}

/// The terms of a paraboloid.
fn terms([x, y]: [f64; 2]) -> SVector<f64, 6> {
    SVector::<f64, 6>::from([1.0, x, y, x * x, x * y, y * y])
}

/// The middle of a line in plan, at the mean of its heights (m).
fn boundary_middle(points: &[[f64; 3]]) -> [f64; 3] {
    let [low, high] = super::bounds(points.iter().copied());
    let z = points.iter().map(|p| p[2]).sum::<f64>() / points.len() as f64;
    [0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), z]
}

/// Size of a detail in plan.
pub(super) struct Size {
    /// Across (m).
    pub width: f64,
    length: f64,
    middle: [f64; 2],
}

impl Size {
    /// Size of some points (m), which bound an area (m²) with a perimeter (m) if these are known.
    pub fn new(points: &[[f64; 3]], area_and_perimeter: Option<[f64; 2]>) -> Option<Self> {
        let extents = (0..TUNING.extents).map(|n| {
            let angle = std::f64::consts::PI * n as f64 / TUNING.extents as f64;
            let (sin, cos) = angle.sin_cos();
            let along = points.iter().map(|p| cos * p[0] + sin * p[1]);
            let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), s| {
                (low.min(s), high.max(s))
            });
            high - low
        });
        let (least, most) =
            extents.fold((f64::INFINITY, 0.0_f64), |(a, b), s| (a.min(s), b.max(s)));
        if !least.is_finite() {
            return None;
        }
        let slender = area_and_perimeter.and_then(|[area, perimeter]| {
            let quotient = 4.0 * std::f64::consts::PI * area / (perimeter * perimeter);
            (quotient < TUNING.slender).then_some((2.0 * area / perimeter, 0.5 * perimeter))
        });
        let (width, length) = match slender {
            Some(slender) => slender,
            // the diameter of what is round
            None if most < TUNING.round * least => (most, most),
            None => (least, most),
        };
        let [low, high] = super::bounds(points.iter().copied());
        let middle = [0, 1].map(|n| 0.5 * (low[n] + high[n]));
        Some(Size { width, length, middle })
    }

    fn detail(self, kind: DetailKind, depth: f64, place: [f64; 3], spanned: bool) -> Detail {
        let Size { width, length, .. } = self;
        Detail { kind, width, length, depth, place, spanned }
    }
}

#[cfg(test)]
mod tests {
    use super::{Detail, DetailKind};
    use crate::mold::Mesh;
    use crate::mold::mesh::MeshReport;
    use std::f64::consts::PI;

    type Point = [f64; 3];
    /// The tolerance of contact, and the mesh of an ideal drape over cells of 100 mm (m).
    const TOLERANCE: f64 = 2e-4;
    const WIDTH: f64 = 0.01;

    fn spanned(triangles: &[[Point; 3]]) -> (Mesh, MeshReport) {
        let vertices = triangles.as_flattened().to_vec();
        let numbers: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
        let (mesh, report) = Mesh::of_triangles(vertices, &numbers).unwrap();
        mesh.spanned(report, WIDTH, WIDTH, TOLERANCE)
    }

    /// A plate of 200 mm on a surface of height z, without its middle square of 40 mm.
    fn frame(z: impl Fn(f64, f64) -> f64) -> Vec<[Point; 3]> {
        let vertex = |node: [i32; 2]| {
            let [x, y] = node.map(|n| 0.02 * f64::from(n));
            [x, y, z(x, y)]
        };
        let cells = (-5..5).flat_map(|i| (-5..5).map(move |j| (i, j)));
        let around = cells.filter(|(i, j)| !(-1..1).contains(i) || !(-1..1).contains(j));
        around
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(vertex);
                [[a, b, c], [a, c, d]]
            })
            .collect()
    }

    /// A square of 40 mm with a round pit in it (depth below 0: a stud), with walls that lean outwards by `lean` (m); without
    /// its floor it is an open hole.
    fn round(
        radius: f64,
        depth: f64,
        lean: f64,
        has_floor: bool,
        z: impl Fn(f64, f64) -> f64,
    ) -> Vec<[Point; 3]> {
        let ring = |n: usize, r: f64, down: f64| {
            let (sin, cos) = (PI * n as f64 / 8.0).sin_cos();
            [r * cos, r * sin, z(r * cos, r * sin) - down]
        };
        let square = |n: usize| {
            let (sin, cos) = (PI * n as f64 / 4.0).sin_cos();
            let most = sin.abs().max(cos.abs());
            let [x, y] = [cos, sin].map(|c| (c / most * 1e9).round() * 0.02e-9);
            [x, y, z(x, y)]
        };
        let mut out = Vec::new();
        for q in 0..8 {
            let [p0, p1, p2] = [0, 1, 2].map(|n| ring(2 * q + n, radius, 0.0));
            let [s0, s1] = [square(q), square(q + 1)];
            out.extend([[s0, p1, p0], [s0, s1, p1], [s1, p2, p1]]);
        }
        for n in 0..16 {
            let [a, b] = [ring(n, radius, 0.0), ring(n + 1, radius, 0.0)];
            let [c, d] = [n, n + 1].map(|n| ring(n, radius - lean, depth));
            if has_floor {
                out.extend([[a, b, d], [a, d, c], [[0.0, 0.0, z(0.0, 0.0) - depth], c, d]]);
            }
        }
        out
    }

    fn only(report: &MeshReport) -> &Detail {
        let [detail] = &report.details[..] else { panic!("{:?}", report.details) };
        detail
    }

    fn near(a: f64, b: f64, within: f64) {
        assert!((a - b).abs() <= within, "{a} {b}");
    }

    /// A saddle with a radius of 0.5 m each way.
    fn saddle(x: f64, y: f64) -> f64 {
        x * x - y * y
    }

    /// Blind holes of 2 to 9 mm on a plate and on a saddle, with upright walls and with leaning ones: they have their size, depth
    /// and place, and are spanned, so that the highest point over them is that of the mold around them.
    #[test]
    fn a_pit_is_measured_and_spanned() {
        for (radius, lean) in
            [(0.001, 0.0), (0.003, 0.0), (0.003, 1e-3), (0.0045, 0.0), (0.0045, 4e-3)]
        {
            for z in [|_: f64, _: f64| 0.0, saddle] {
                let (mesh, report) =
                    spanned(&[frame(z), round(radius, 0.01, lean, true, z)].concat());
                let pit = only(&report);
                assert_eq!((pit.kind, pit.spanned), (DetailKind::Pit, true), "{radius} {lean}");
                near(pit.width, 2.0 * radius, 1e-4 + 2.0 * lean);
                near(pit.depth, 0.01, 3e-4);
                near(pit.place[0].hypot(pit.place[1]), 0.0, 1e-4);
                near(mesh.highest_point([0.0, 0.0]).unwrap()[2], 0.0, TOLERANCE);
                assert_eq!((report.surfaces, report.holes.len()), (1, 0));
                assert!(
                    report.warnings()[0].starts_with("the mold has a pit of "),
                    "{:?}",
                    report.warnings()
                );
            }
        }
    }

    /// An open hole of this size is spanned as a pit is; one that is wider stays, as does a wider pit.
    #[test]
    fn an_open_hole_is_spanned_and_what_is_wide_stays() {
        let flat = |_: f64, _: f64| 0.0;
        let (mesh, report) = spanned(&[frame(flat), round(0.003, 0.0, 0.0, false, flat)].concat());
        assert_eq!((only(&report).kind, only(&report).spanned), (DetailKind::Hole, true));
        near(only(&report).width, 0.006, 1e-4);
        assert!(report.holes.is_empty() && mesh.highest_point([0.0, 0.0]).is_some());

        let (mesh, report) = spanned(&[frame(flat), round(0.008, 0.0, 0.0, false, flat)].concat());
        assert_eq!((report.details.len(), report.holes.len()), (0, 1));
        assert!(mesh.highest_point([0.0, 0.0]).is_none());
        let (_, report) = spanned(&[frame(flat), round(0.012, 0.01, 0.0, true, flat)].concat());
        assert!(report.details.is_empty(), "{:?}", report.details);
    }

    /// What stands up is named and left as it is: grippers would run against it.
    #[test]
    fn a_stud_is_named_and_stays() {
        for z in [|_: f64, _: f64| 0.0, saddle] {
            let (mesh, report) = spanned(&[frame(z), round(0.003, -0.004, 0.0, true, z)].concat());
            let stud = only(&report);
            assert_eq!((stud.kind, stud.spanned), (DetailKind::Stud, false));
            near(stud.width, 0.006, 1e-4);
            near(stud.depth, 0.004, 2e-4);
            near(mesh.highest_point([0.0, 0.0]).unwrap()[2], 0.004, 1e-9);
        }
    }

    /// A strip of profiles along y, each point with its height; from −100 to 100 mm.
    fn profile(points: &[(f64, f64)]) -> Vec<[Point; 3]> {
        let rows: Vec<f64> = (-10..=10).map(|n| 0.01 * f64::from(n)).collect();
        let mut out = Vec::new();
        for ends in points.windows(2) {
            for y in rows.windows(2) {
                let vertex = |(x, z): (f64, f64), y: f64| [x, y, z];
                let [a, b] = [vertex(ends[0], y[0]), vertex(ends[1], y[0])];
                let [c, d] = [vertex(ends[1], y[1]), vertex(ends[0], y[1])];
                out.extend([[a, b, c], [a, c, d]]);
            }
        }
        out
    }

    /// A countersunk hole and a round bottom are one pit each; a hole through a solid is named and stays.
    #[test]
    fn holes_of_several_walls_are_one_pit_and_holes_through_solids_are_named() {
        let flat = |_: f64, _: f64| 0.0;
        // the walls of `round` lead to its floor; in its place a cylinder of 4 mm goes on, 9 mm deep
        let sunk = round(0.0045, 0.0025, 0.0025, true, flat);
        let sunk = sunk.into_iter().filter(|t| t[0][0].hypot(t[0][1]) > 1e-9);
        let mut faces: Vec<[Point; 3]> = frame(flat);
        faces.extend(sunk);
        let ring = |n: usize, z: f64| {
            let (sin, cos) = (PI * n as f64 / 8.0).sin_cos();
            [0.002 * cos, 0.002 * sin, z]
        };
        for n in 0..16 {
            let [a, b, c, d] = [(n, -0.0025), (n + 1, -0.0025), (n, -0.009), (n + 1, -0.009)]
                .map(|(n, z)| ring(n, z));
            faces.extend([[a, b, d], [a, d, c], [[0.0, 0.0, -0.009], c, d]]);
        }
        let (_, report) = spanned(&faces);
        let pit = only(&report);
        assert!(pit.spanned, "{pit:?}");
        near(pit.width, 0.009, 1e-4);
        near(pit.depth, 0.009, 1e-4);

        // a block of 200 mm with a hole of 6 mm through it
        let mut faces: Vec<[Point; 3]> =
            [frame(flat), round(0.003, 0.0, 0.0, false, flat)].concat();
        let down = |p: Point| [p[0], p[1], p[2] - 0.02];
        let under: Vec<[Point; 3]> = faces.iter().map(|[a, b, c]| [*a, *c, *b].map(down)).collect();
        faces.extend(under);
        let side = |k: usize, n: i32| {
            let s = 0.02 * f64::from(n) - 0.1;
            [[s, -0.1, 0.0], [0.1, s, 0.0], [-s, 0.1, 0.0], [-0.1, -s, 0.0]][k]
        };
        let mut wall = |a: Point, b: Point| faces.extend([[a, down(a), down(b)], [a, down(b), b]]);
        (0..4).for_each(|k| (0..10).for_each(|n| wall(side(k, n), side(k, n + 1))));
        let edge = |n: usize| {
            let (sin, cos) = (PI * n as f64 / 8.0).sin_cos();
            [0.003 * cos, 0.003 * sin, 0.0]
        };
        (0..16).for_each(|n| wall(edge(n + 1), edge(n)));
        let (_, report) = spanned(&faces);
        assert_eq!((report.surfaces, report.closed), (1, 1), "{report}");
        assert_eq!((only(&report).kind, only(&report).spanned), (DetailKind::Hole, false));
        near(only(&report).width, 0.006, 1e-4);
    }

    /// An engraved groove of 3 mm has its width, though not where it runs out of the mold.
    #[test]
    fn a_groove_is_measured_across() {
        let (_, report) = spanned(&profile(&[
            (-0.1, 0.0),
            (-0.0015, 0.0),
            (-0.00149, -0.001),
            (0.00149, -0.001),
            (0.0015, 0.0),
            (0.1, 0.0),
        ]));
        let groove = only(&report);
        assert_eq!(groove.kind, DetailKind::Pit);
        near(groove.width, 0.003, 2e-4);
        near(groove.depth, 0.001, 1e-5);
        assert!(groove.length > 0.15, "{groove:?}");
    }

    /// Edges, steps, ridges and corners of the mold itself are no details, and neither are waves and domes.
    #[test]
    fn the_shape_of_a_mold_is_no_detail() {
        let step = [(-0.1, 0.0), (0.0, 0.0), (1e-6, -0.02), (0.1, -0.02)];
        let fine_step: Vec<(f64, f64)> =
            (-50..=50).map(|n| (2e-3 * f64::from(n), if n < 0 { 0.0 } else { -0.02 })).collect();
        let roof: Vec<(f64, f64)> =
            (-50..=50).map(|n| (2e-3 * f64::from(n), -1.2e-3 * f64::from(n).abs())).collect();
        let waves: Vec<(f64, f64)> = (-100..=100)
            .map(|n| 1e-3 * f64::from(n))
            .map(|x| (x, 0.005 * (2.0 * PI * x / 0.05).cos()))
            .collect();
        for points in [&step[..], &fine_step, &roof, &waves] {
            let (_, report) = spanned(&profile(points));
            assert!(report.details.is_empty(), "{:?}", report.details);
        }

        // a block of 60 mm on a plate, and a cone, in triangles of 4 mm
        let block = |x: f64, y: f64| if x.abs().max(y.abs()) < 0.03 { 0.02 } else { 0.0 };
        let cone = |x: f64, y: f64| -0.6 * x.hypot(y);
        for z in [block, cone] {
            let vertex = |node: [i32; 2]| {
                let [x, y] = node.map(|n| 4e-3 * f64::from(n));
                [x, y, z(x, y)]
            };
            let cells = (-25..25).flat_map(|i| (-25..25).map(move |j| (i, j)));
            let triangles: Vec<[Point; 3]> = cells
                .flat_map(|(i, j)| {
                    let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(vertex);
                    [[a, b, c], [a, c, d]]
                })
                .collect();
            let (_, report) = spanned(&triangles);
            assert!(report.details.is_empty(), "{:?}", report.details);
        }
    }
}
