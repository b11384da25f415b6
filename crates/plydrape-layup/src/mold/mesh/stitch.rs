//! Stitching: faces that all but meet are joined along their boundaries.
//!
//! The faces of a CAD body are meshed one by one, and molds are split: between their boundaries are gaps, steps and
//! overlaps of a few hundredths of a millimeter. What is below the tolerance of contact is no boundary of the mold. Two
//! vertices on boundaries that face each other become one if each is the other's nearest; then a vertex that lies beside
//! the middle of a side divides it (Barequet and Kumar 1997 do the same over whole boundaries). Both are repeated until
//! nothing is left, and nothing is done that would turn a triangle over, leave it without area or give an edge a third
//! triangle.

use super::join::{Joined, has_area};
use super::report::Stitches;
use super::side::{Side, Sides};
use super::triangle::double_area;
use crate::geometry::vector::{between, distance, dot};
use crate::mold::tuning::TUNING;
use std::collections::{BTreeMap, HashMap, HashSet};

/// Joins boundaries that are no farther apart than `tolerance` (m); says where.
pub(super) fn stitch(mesh: &mut Joined, tolerance: f64) -> Stitches {
    let mut stitches = Stitches::default();
    if tolerance <= 0.0 {
        return stitches;
    }
    let mut sides = Sides::new(&mesh.vertices, &mesh.triangles);
    let mut around: HashMap<u32, Vec<u32>> =
        sides.all.iter().flat_map(|side| side.ends).map(|n| (n, Vec::new())).collect();
    for (corners, n) in mesh.triangles.iter().zip(0..) {
        for corner in corners {
            if let Some(own) = around.get_mut(corner) {
                own.push(n);
            }
        }
    }
    let mut work =
        Stitching { mesh, around, tolerance, refused: HashSet::new(), stitches: &mut stitches };
    for _ in 0..TUNING.stitch_rounds {
        if sides.all.is_empty() {
            break;
        }
        if !work.merge_vertices(&sides) && !work.divide_sides(&sides) {
            break;
        }
        sides = Sides::new(&work.mesh.vertices, &work.mesh.triangles);
    }
    stitches
}

/// A mesh being stitched.
struct Stitching<'a> {
    mesh: &'a mut Joined,
    /// The triangles around each vertex that lies on a boundary, or did.
    around: HashMap<u32, Vec<u32>>,
    tolerance: f64,
    /// Vertices that cannot become one, and vertices that cannot divide the side between two others.
    refused: HashSet<[u32; 3]>,
    stitches: &'a mut Stitches,
}

/// The sides at each vertex of a boundary, by the number of the vertex.
fn at_vertices(sides: &Sides) -> BTreeMap<u32, Vec<usize>> {
    let mut out: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for (n, side) in sides.all.iter().enumerate() {
        side.ends.iter().for_each(|end| out.entry(*end).or_default().push(n));
    }
    out
}

impl Stitching<'_> {
    /// Where a vertex is (m).
    fn place(&self, vertex: u32) -> [f64; 3] {
        self.mesh.vertices[vertex as usize]
    }

    fn around(&self, vertex: u32) -> &[u32] {
        self.around.get(&vertex).map_or(&[], Vec::as_slice)
    }

    /// Whether two vertices are corners of the same triangle.
    fn are_joined(&self, a: u32, b: u32) -> bool {
        self.around(a).iter().any(|t| self.mesh.triangles[*t as usize].contains(&b))
    }

    /// Makes one of every two vertices on facing boundaries that are each other's nearest; whether there were any.
    fn merge_vertices(&mut self, sides: &Sides) -> bool {
        let own = at_vertices(sides);
        let mut nearest: BTreeMap<u32, u32> = BTreeMap::new();
        for (&v, of_v) in &own {
            let p = self.place(v);
            let mut best: Option<(f64, u32)> = None;
            for n in sides.near([p].into_iter(), self.tolerance) {
                for w in sides.all[n].ends {
                    let away = distance(p, self.place(w));
                    let is_better = best
                        .is_none_or(|(least, other)| away < least || (away == least && w < other));
                    if w == v || away > self.tolerance || !is_better {
                        continue;
                    }
                    let faces = of_v
                        .iter()
                        .any(|&g| own[&w].iter().any(|&f| sides.all[g].faces(&sides.all[f])));
                    let pair = [v.min(w), v.max(w), v.max(w)];
                    if faces && !self.refused.contains(&pair) && !self.are_joined(v, w) {
                        best = Some((away, w));
                    }
                }
            }
            nearest.extend(best.map(|(_, w)| (v, w)));
        }
        let mut changed = false;
        for (&v, &w) in nearest.iter().filter(|(v, w)| v < w && nearest.get(w) == Some(v)) {
            let (p, q) = (self.place(v), self.place(w));
            // in the middle, or where one of them is if its triangles are too small to be moved
            let places = [between(p, q, 0.5), p, q];
            let place = places.into_iter().find(|place| self.may_merge(v, w, *place));
            match place {
                Some(place) => {
                    self.merge(v, w, place);
                    self.stitches.note(distance(p, q), place);
                    changed = true;
                }
                None => changed |= self.refused.insert([v, w, w]),
            }
        }
        changed
    }

    /// Whether two vertices may become one at a place (m).
    fn may_merge(&self, v: u32, w: u32, place: [f64; 3]) -> bool {
        if self.are_joined(v, w) {
            return false;
        }
        // how many triangles each edge to another vertex has then
        let mut count: HashMap<u32, usize> = HashMap::new();
        let mut seen: HashSet<[u32; 3]> = HashSet::new();
        for &t in self.around(v).iter().chain(self.around(w)) {
            let mut corners = self.mesh.triangles[t as usize].map(|n| if n == w { v } else { n });
            if !self.keeps_its_side(t, |n| if n == v || n == w { Some(place) } else { None }) {
                return false;
            }
            corners.iter().filter(|n| **n != v).for_each(|n| *count.entry(*n).or_default() += 1);
            corners.sort_unstable();
            if !seen.insert(corners) {
                return false;
            }
        }
        count.values().all(|count| *count <= 2)
    }

    /// Whether a triangle still has an area, and faces as before, with some of its vertices moved (m).
    fn keeps_its_side(&self, t: u32, moved: impl Fn(u32) -> Option<[f64; 3]>) -> bool {
        let corners = self.mesh.triangles[t as usize];
        let before = corners.map(|n| self.place(n));
        let after = corners.map(|n| moved(n).unwrap_or_else(|| self.place(n)));
        has_area(corners, after) && dot(double_area(before), double_area(after)) > 0.0
    }

    fn merge(&mut self, v: u32, w: u32, place: [f64; 3]) {
        self.mesh.vertices[v as usize] = place;
        let moved = self.around.remove(&w).unwrap_or_default();
        for &t in &moved {
            self.mesh.triangles[t as usize] =
                self.mesh.triangles[t as usize].map(|n| if n == w { v } else { n });
        }
        self.around.entry(v).or_default().extend(moved);
    }

    /// Divides every side that a vertex of a facing boundary lies beside; whether there were any.
    fn divide_sides(&mut self, sides: &Sides) -> bool {
        // for each side the vertices that divide it, by their place along it
        let mut dividing: BTreeMap<usize, Vec<(f64, u32)>> = BTreeMap::new();
        for (&v, of_v) in &at_vertices(sides) {
            let p = self.place(v);
            let mut best: Option<(f64, f64, usize)> = None;
            for n in sides.near([p].into_iter(), self.tolerance) {
                let side = &sides.all[n];
                let (share, away) = side.closest(p);
                let corners = self.mesh.triangles[side.triangle as usize];
                let [a, b] = side.ends;
                if away > self.tolerance
                    || share <= 0.0
                    || share >= 1.0
                    || corners.contains(&v)
                    || best.is_some_and(|(least, ..)| away >= least)
                    || self.refused.contains(&[v, a.min(b), a.max(b)])
                {
                    continue;
                }
                if of_v.iter().any(|&g| sides.all[g].faces(side)) {
                    best = Some((away, share, n));
                }
            }
            if let Some((_, share, n)) = best {
                dividing.entry(n).or_default().push((share, v));
            }
        }
        let mut changed = false;
        for (n, mut along) in dividing {
            along.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            changed |= self.divide(&sides.all[n], &along);
        }
        changed
    }

    /// Divides a side at vertices in their order along it; whether something changed.
    fn divide(&mut self, side: &Side, along: &[(f64, u32)]) -> bool {
        let t = side.triangle;
        let [mut a, b] = side.ends;
        let corners = self.mesh.triangles[t as usize];
        // another side of the same triangle was divided just now: this one has its turn in the next round
        if !corners.contains(&a) || !corners.contains(&b) {
            return true;
        }
        let Some(c) = corners.into_iter().find(|n| *n != a && *n != b) else { return false };
        let mut changed = false;
        for &(share, v) in along {
            let closest = side.point_at(share);
            let away = distance(self.place(v), closest);
            let mut places = [self.place(v), closest].into_iter();
            let Some(place) = places.find(|place| self.may_divide([a, b, c], v, *place)) else {
                let [low, high] = [a.min(b), a.max(b)];
                changed |= self.refused.insert([v, low, high]);
                continue;
            };
            self.mesh.vertices[v as usize] = place;
            // the new triangle lies between a and v, and the old one goes on from v
            let corners = self.mesh.triangles[t as usize];
            let new = self.mesh.triangles.len() as u32;
            self.mesh.triangles.push(corners.map(|n| if n == b { v } else { n }));
            self.mesh.numbers.push(self.mesh.numbers[t as usize]);
            self.mesh.triangles[t as usize] = corners.map(|n| if n == a { v } else { n });
            if let Some(own) = self.around.get_mut(&a) {
                own.retain(|n| *n != t);
                own.push(new);
            }
            if let Some(own) = self.around.get_mut(&c) {
                own.push(new);
            }
            self.around.entry(v).or_default().extend([new, t]);
            self.stitches.note(away, place);
            a = v;
            changed = true;
        }
        changed
    }

    /// Whether the side from a to b of a triangle a, b, c (in either order) may be divided at a vertex that is then at a
    /// place (m).
    fn may_divide(&self, [a, b, c]: [u32; 3], v: u32, place: [f64; 3]) -> bool {
        let whole = double_area([a, b, c].map(|n| self.place(n)));
        let keeps_its_side = |corners: [u32; 3]| {
            let points = corners.map(|n| if n == v { place } else { self.place(n) });
            has_area(corners, points) && dot(double_area(points), whole) > 0.0
        };
        let uses = |n: u32| {
            let around = self.around(v).iter();
            around.filter(|t| self.mesh.triangles[**t as usize].contains(&n)).count()
        };
        keeps_its_side([a, v, c])
            && keeps_its_side([v, b, c])
            && uses(a) <= 1
            && uses(b) <= 1
            && uses(c) == 0
            && self.around(v).iter().all(|t| self.keeps_its_side(*t, |n| (n == v).then_some(place)))
    }
}

#[cfg(test)]
mod tests {
    use crate::mold::Mesh;
    use crate::mold::mesh::MeshReport;

    type Point = [f64; 3];
    /// The tolerance of contact unless set (m).
    const TOLERANCE: f64 = 2e-4;

    /// A patch of nx by ny cells over the unit square, in its place.
    fn patch(nx: usize, ny: usize, place: impl Fn(f64, f64) -> Point) -> Vec<[Point; 3]> {
        let vertex = |[i, j]: [usize; 2]| place(i as f64 / nx as f64, j as f64 / ny as f64);
        let cells = (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j)));
        cells
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(vertex);
                [[a, b, c], [a, c, d]]
            })
            .collect()
    }

    /// A shallow dome of 1 m by 1 m.
    fn dome(x: f64, y: f64) -> Point {
        [x, y, 0.2 - 0.1 * (x * x + y * y)]
    }

    /// The mold of loose triangles, stitched.
    fn stitched(triangles: &[[Point; 3]]) -> (Mesh, MeshReport) {
        let vertices = triangles.as_flattened().to_vec();
        let numbers: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
        let (apart, report) = Mesh::of_triangles(vertices, &numbers).unwrap();
        apart.stitched(TOLERANCE).unwrap().unwrap_or((apart, report))
    }

    /// The left half of a dome, and the right one, in `fine` times as many cells along the seam, moved by `off`.
    fn halves(fine: usize, off: Point) -> Vec<[Point; 3]> {
        let left = patch(4, 4, |s, t| dome(-0.5 + 0.5 * s, t - 0.5));
        // along the seam the finer side has points on the chords of the coarser one
        let right = patch(4, 4 * fine, |s, t| {
            let [low, high] = [(4.0 * t).floor() / 4.0, (4.0 * t).ceil() / 4.0];
            let [x, y] = [0.5 * s, t - 0.5];
            let share = if high > low { (t - low) / (high - low) } else { 0.0 };
            let z = (1.0 - share) * dome(x, low - 0.5)[2] + share * dome(x, high - 0.5)[2];
            [x + off[0], y + off[1], z + off[2]]
        });
        [left, right].concat()
    }

    /// Gaps, overlaps, steps and shifts along the seam below the tolerance, between faces that are equally fine and not: one
    /// surface with one boundary, no vertex moved by more than the tolerance, and no triangle turned over.
    #[test]
    fn faces_that_all_but_meet_are_one_surface() {
        let offs = [
            [2e-6, 0.0, 0.0],
            [-1e-5, 0.0, 0.0],
            [1.5e-4, 0.0, 0.0],
            [-1.5e-4, 0.0, 0.0],
            [0.0, 0.0, 5e-5],
            [5e-5, 1e-4, -5e-5],
            [0.0, 0.0, 0.0],
        ];
        for fine in [1, 2, 3, 7] {
            for off in offs {
                if fine == 1 && off == [0.0; 3] {
                    continue;
                }
                let (mesh, report) = stitched(&halves(fine, off));
                assert_eq!(
                    (report.surfaces, report.holes.len()),
                    (1, 0),
                    "{fine} {off:?}: {report}"
                );
                assert_eq!((mesh.boundaries().len(), mesh.gaps(0.01)), (1, None));
                let widest = report.stitched.widest.unwrap().0;
                let most = off.iter().fold(0.0, |sum: f64, x| sum.hypot(*x));
                assert!(widest <= most + 1e-12, "{fine} {off:?}: {widest}");
                for p in [[1e-6, 0.1, 0.3], [1e-4, -0.2, 0.3], [0.0, 0.3, 0.3]] {
                    let closest = mesh.closest_point(p);
                    assert!(!closest.beyond && closest.normal[2] > 0.95, "{closest:?}");
                }
                assert!(
                    mesh.section_to(dome(-0.25, 0.0), mesh.closest_point([0.25, 0.0, 0.3]).point)
                        .is_some()
                );
            }
        }
    }

    /// A gap or a step above the tolerance stays a boundary.
    #[test]
    fn a_gap_above_the_tolerance_stays() {
        for off in [[3e-4, 0.0, 0.0], [0.0, 0.0, 3e-4]] {
            for fine in [1, 3] {
                let (apart, report) = stitched(&halves(fine, off));
                assert_eq!((report.surfaces, report.stitched.count), (2, 0), "{fine} {off:?}");
                // and is named with its width and length
                let gaps = apart.gaps(0.01).unwrap();
                assert!(
                    (gaps.widest - 3e-4).abs() < 1e-5 && gaps.place[0].abs() < 1e-3,
                    "{gaps:?}"
                );
                assert!((gaps.length - 1.0).abs() < 0.3, "{gaps:?}");
            }
        }
    }

    /// Four faces that meet in a point, each off by another hundredth of a millimeter.
    #[test]
    fn four_faces_that_meet_in_a_point_are_one_surface() {
        let mut faces = Vec::new();
        for (n, [x, y]) in
            [[-0.5, -0.5], [0.0, -0.5], [-0.5, 0.0], [0.0, 0.0]].into_iter().enumerate()
        {
            let off = 1e-5 * n as f64;
            faces.extend(patch(2 + n, 3, |s, t| {
                let [x, y] = [x + 0.5 * s, y + 0.5 * t];
                [x + off, y - off, off]
            }));
        }
        let (mesh, report) = stitched(&faces);
        assert_eq!((report.surfaces, report.holes.len()), (1, 0), "{report}");
        assert!(!mesh.closest_point([1e-5, 1e-5, 0.1]).beyond);
    }

    /// The six faces of a box, meshed one by one, are a closed solid, and its walls need face no way of their own.
    #[test]
    fn the_faces_of_a_box_are_a_closed_solid() {
        let mut faces = Vec::new();
        for (n, side) in [0.0, 1.0].into_iter().enumerate() {
            for axis in 0..3 {
                let off = 1e-5 * (n + 2 * axis) as f64;
                faces.extend(patch(3 + axis, 3 + axis + n, |s, t| {
                    let mut p = [off; 3];
                    p[axis] += side;
                    p[(axis + 1) % 3] += s;
                    p[(axis + 2) % 3] += t;
                    p
                }));
            }
        }
        let vertices = faces.as_flattened().to_vec();
        let mut soup = crate::mold::mesh::Soup::new("triangle");
        soup.points = vertices;
        for n in 0..faces.len() as u32 {
            soup.push(&[3 * n, 3 * n + 1, 3 * n + 2], u64::from(n) + 1);
        }
        let still = crate::mold::Pose::new([0.0; 3], [0.0; 3]);
        let (mesh, report) = Mesh::of_soup(soup, 1.0, &still, TOLERANCE).unwrap();
        assert_eq!((report.surfaces, report.closed), (1, 1), "{report}");
        assert!(mesh.closest_point([0.5, 0.5, 0.9]).distance < 0.0);
    }

    /// The two faces of a sheet that is thinner than the tolerance stay two, and a mesh whose triangles are smaller than the
    /// tolerance is left as it is.
    #[test]
    fn thin_sheets_and_fine_meshes_are_left_as_they_are() {
        let sheet = |z: f64| patch(3, 3, move |s, t| [s, t, z]);
        let (_, report) = stitched(&[sheet(0.0), sheet(1e-4)].concat());
        assert_eq!((report.surfaces, report.stitched.count), (2, 0), "{report}");

        let fine = patch(40, 40, |s, t| [2e-3 * s, 2e-3 * t, 0.0]);
        let (_, report) = stitched(&fine);
        assert_eq!((report.surfaces, report.stitched.count), (1, 0), "{report}");
    }

    /// A cap that rounding has given a height of a ten-thousandth of a millimeter, to either side, and so a normal to any side.
    #[test]
    fn a_cap_of_rounding_alone_turns_no_normal() {
        for off in [[0.0, 1e-7, 0.0], [0.0, -1e-7, 0.0], [0.0, 0.0, 1e-7], [0.0, 1e-7, -1e-7]] {
            let (a, b, c) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5 + off[0], off[1], off[2]]);
            let faces = [
                [a, b, [0.5, 1.0, 0.0]],
                [a, c, b],
                [a, [0.25, -1.0, 0.0], c],
                [c, [0.75, -1.0, 0.0], b],
                [c, [0.25, -1.0, 0.0], [0.75, -1.0, 0.0]],
            ];
            let (mesh, report) = stitched(&faces);
            assert_eq!((report.surfaces, mesh.boundaries().len()), (1, 1), "{report}");
            assert!(mesh.closest_point(c).normal[2] > 0.999, "{:?}", mesh.closest_point(c));
            assert_eq!(mesh.sharp_edges(0.1).count(), 0);
        }
    }

    /// A triangle without area between a coarse face and two of a finer one is left out, and what it held together is stitched.
    #[test]
    fn a_cap_without_area_leaves_no_gap() {
        let (a, b, c) = ([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0, 0.0]);
        let faces = [
            [a, b, [0.5, 1.0, 0.0]],
            [a, c, b],
            [a, [0.25, -1.0, 0.0], c],
            [c, [0.75, -1.0, 0.0], b],
            [c, [0.25, -1.0, 0.0], [0.75, -1.0, 0.0]],
        ];
        let (mesh, report) = stitched(&faces);
        assert_eq!((report.surfaces, report.stitched.count, report.triangles), (1, 1, 5));
        assert_eq!(mesh.boundaries().len(), 1, "{report}");
    }
}
