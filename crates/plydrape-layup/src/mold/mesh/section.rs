//! The line along which a vertical plane cuts a mesh, followed from triangle to triangle.
//!
//! Every vertex lies to the left or to the right of the plane. A triangle with vertices on both sides is
//! crossed: seen from outside, the line enters it over the edge that runs from left to right and leaves
//! over the one from right to left. A vertex in the plane itself is taken as lying to the left, or to
//! the right, consistently; this moves the plane by less than any length, and the line never has to pass
//! through a vertex or along an edge, although its points lie on them.

use super::Mesh;
use super::orient::NONE;
use crate::geometry::vector::{along, distance, distance_from_segment, sub};
use crate::mold::SurfaceCurve;
use crate::mold::tuning::TUNING;

/// A vertical plane, with the side that its vertices count to.
#[derive(Clone, Copy)]
struct Cut<'a> {
    mesh: &'a Mesh,
    from: [f64; 3],
    /// Horizontal unit vector to the left.
    left: [f64; 2],
    in_plane_is_left: bool,
}

/// Where a line ends.
#[derive(Clone, Copy)]
enum Goal {
    Length(f64),
    Point { point: [f64; 3], most: f64 },
}

/// How a walk ended.
#[derive(PartialEq)]
enum End {
    Goal,
    Boundary,
}

impl Mesh {
    /// The line along the mesh from its point `from` (m), in the vertical plane of the horizontal unit
    /// vector `heading`, over an arc length (m); a negative length leads the other way. It ends early at
    /// an open boundary.
    #[must_use]
    pub fn section(&self, from: [f64; 3], heading: [f64; 2], length: f64) -> SurfaceCurve {
        let heading = if length < 0.0 { heading.map(|c| -c) } else { heading };
        let length = if length.is_finite() { length.abs() } else { 0.0 };
        self.follow(from, heading, Goal::Length(length)).0
    }

    /// The line along the mesh from one of its points to another (m) in the vertical plane of both; none
    /// where it runs over a boundary, or does not get there within four times their distance.
    #[must_use]
    pub fn section_to(&self, a: [f64; 3], b: [f64; 3]) -> Option<SurfaceCurve> {
        let run = (b[0] - a[0]).hypot(b[1] - a[1]);
        let chord = distance(a, b);
        if chord <= TUNING.on_curve * self.size {
            return Some(SurfaceCurve { points: vec![a, b], arc: vec![0.0, chord] });
        }
        let heading = [(b[0] - a[0]) / run, (b[1] - a[1]) / run];
        if !heading[0].is_finite() || !heading[1].is_finite() {
            return None;
        }
        let (curve, end) =
            self.follow(a, heading, Goal::Point { point: b, most: TUNING.longest_way * chord });
        (end == End::Goal).then_some(curve)
    }

    fn follow(&self, from: [f64; 3], heading: [f64; 2], goal: Goal) -> (SurfaceCurve, End) {
        let place = self.surface_point(from);
        let start = place.point;
        let mut curve = SurfaceCurve { points: vec![start], arc: vec![0.0] };
        // seen from outside, a heading below an overhang is reversed
        let ahead = self.normal_at(&place)[2] >= 0.0;
        let sign = if ahead { 1.0 } else { -1.0 };
        let left = [-sign * heading[1], sign * heading[0]];
        let mut cut = Cut { mesh: self, from: start, left, in_plane_is_left: true };
        // where vertices in the plane are a boundary on one side, the other may go on
        let mut idle = 0;
        while idle < 2 {
            let before = curve.points.len();
            if cut.walk(&mut curve, goal) == End::Goal {
                return (curve, End::Goal);
            }
            idle = if curve.points.len() > before { 0 } else { idle + 1 };
            cut.in_plane_is_left = !cut.in_plane_is_left;
        }
        (curve, End::Boundary)
    }
}

impl Cut<'_> {
    /// Goes on from the last point of a line.
    fn walk(&self, curve: &mut SurfaceCurve, goal: Goal) -> End {
        let mesh = self.mesh;
        if matches!(goal, Goal::Length(length) if length <= curve.length()) {
            return End::Goal;
        }
        let Some(mut triangle) = self.start(curve.end()) else { return End::Boundary };
        // around a vertex that the plane only touches the walk goes in circles
        let mut idle = 0;
        while let Some((edge, next)) = self.crossing(triangle, false) {
            let from = curve.end();
            let (step, arc) = (distance(from, next), curve.length());
            match goal {
                Goal::Length(length) if arc + step >= length => {
                    let share = (length - arc) / step;
                    let end = if share >= 1.0 { next } else { along(from, share, sub(next, from)) };
                    curve.push(end, length);
                    return End::Goal;
                }
                Goal::Point { point, .. } if self.is_on(from, next, point) => {
                    curve.push(point, arc + distance(from, point));
                    return End::Goal;
                }
                Goal::Point { most, .. } if arc > most => return End::Boundary,
                _ => {}
            }
            if step > TUNING.in_plane * mesh.size {
                curve.push(next, arc + step);
                idle = 0;
            } else {
                idle += 1;
            }
            match mesh.neighbors[triangle][edge] {
                NONE => return End::Boundary,
                _ if idle.max(curve.points.len() / TUNING.rounds) > mesh.triangles.len() => {
                    return End::Boundary;
                }
                other => triangle = other as usize,
            }
        }
        End::Boundary
    }

    /// The crossed triangle that `p` (m) lies in.
    fn start(&self, p: [f64; 3]) -> Option<usize> {
        let tolerance = TUNING.on_curve * self.mesh.size;
        let mut best: Option<(f64, usize)> = None;
        let near = [p.map(|x| x - tolerance), p.map(|x| x + tolerance)];
        for triangle in self.mesh.tree.touching(near) {
            let triangle = triangle as usize;
            let ends = (self.crossing(triangle, true), self.crossing(triangle, false));
            let (Some((_, a)), Some((_, b))) = ends else { continue };
            let off = distance_from_segment(p, a, b);
            if off <= tolerance && best.is_none_or(|(least, _)| off < least) {
                best = Some((off, triangle));
            }
        }
        best.map(|(_, triangle)| triangle)
    }

    /// The edge of a triangle over which the line leaves it, or enters it, and where; `None` if the plane
    /// does not cross the triangle.
    fn crossing(&self, triangle: usize, entry: bool) -> Option<(usize, [f64; 3])> {
        let corners = self.mesh.corners(triangle);
        let sides = corners.map(|p| self.side(p));
        let is_left = sides.map(|s| if s == 0.0 { self.in_plane_is_left } else { s > 0.0 });
        let edge = (0..3).find(|&k| is_left[k] == entry && is_left[(k + 1) % 3] != entry)?;
        let [(p, s), (q, t)] = [edge, (edge + 1) % 3].map(|k| (corners[k], sides[k]));
        // from the same end for both triangles, so that they agree to the last digit
        let point = if s == 0.0 {
            p
        } else if t == 0.0 {
            q
        } else if s > 0.0 {
            along(p, s / (s - t), sub(q, p))
        } else {
            along(q, t / (t - s), sub(p, q))
        };
        Some((edge, point))
    }

    /// Distance of `p` to the left of the plane (m).
    fn side(&self, p: [f64; 3]) -> f64 {
        let s = self.left[0] * (p[0] - self.from[0]) + self.left[1] * (p[1] - self.from[1]);
        if s.abs() <= TUNING.in_plane * self.mesh.size { 0.0 } else { s }
    }

    fn is_on(&self, a: [f64; 3], b: [f64; 3], p: [f64; 3]) -> bool {
        distance_from_segment(p, a, b) <= TUNING.on_curve * self.mesh.size
    }
}
