//! The surface that the ply is laid on.
//!
//! What contact and the ideal drape ask of a mold: how far a point is from it, its closest point, normal
//! and curvatures, and where a length of fabric lies that is laid along it in a vertical plane. Distances
//! in meters, positive outside; normals are unit vectors out of the mold, towards the ply.

pub mod formula;
mod front_surface;
mod graph;
mod height;
mod height_grid;
mod layered;
pub mod mesh;
pub mod patch;
mod plane;
mod raised;
mod round;
mod saddle;
mod section;
mod tuning;
mod wavy;

pub use crate::geometry::{Pose, distance};
pub use formula::Formula;
pub use front_surface::{FrontSurface, Rise};
pub use graph::{Graph, Surface};
pub use height::{Height, Steepness};
pub use height_grid::HeightGrid;
pub use layered::{Layer, Layers, overlap, ramp};
pub use mesh::{Mesh, MeshReport};
pub use plane::Plane;
pub use raised::{Raise, Raised, Relief};
pub use round::{Cylinder, Face, Sphere, Torus};
pub use saddle::Saddle;
pub use wavy::Waves;

use crate::geometry::vector::{along, dot, norm, sub};
use section::{Until, trace};
use std::sync::Arc;
use tuning::TUNING;

/// A mold.
#[derive(Debug, Clone, PartialEq)]
pub enum Mold {
    /// Flat, of any position and tilt.
    Plane(Plane),
    /// A cylinder, or a trough.
    Cylinder(Cylinder),
    /// A sphere, or a bowl.
    Sphere(Sphere),
    /// A torus, or a ring-shaped channel.
    Torus(Torus),
    /// A height over a plane, z = f(x, y).
    Graph(Graph),
    /// Triangles.
    Mesh(Arc<Mesh>),
    /// Any of these with waves on it; made by `plydrape::errors::Draw::apply` only.
    Wavy(Arc<Raised<Waves>>),
    /// Any of these with plies on it.
    Layered(Arc<Raised<Layers>>),
}

/// What lies closest to a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosestPoint {
    /// The closest point of the mold (m).
    pub point: [f64; 3],
    /// Smooth unit normal of the mold there, out of it.
    pub normal: [f64; 3],
    /// Distance (m), negative inside the mold; beyond an open boundary the plain distance to the boundary.
    pub distance: f64,
    /// The point is off to the side of an open boundary: there is no mold.
    pub beyond: bool,
}

/// How far a point is from a mold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Distance (m), as in [`ClosestPoint`].
    pub distance: f64,
    /// The point is off to the side of an open boundary, as in [`ClosestPoint`].
    pub beyond: bool,
}

/// A line of fabric on a mold.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SurfaceCurve {
    /// Points, all on the mold (m).
    pub points: Vec<[f64; 3]>,
    /// Arc length at each point (m), ascending.
    pub arc: Vec<f64>,
}

impl SurfaceCurve {
    /// Appends a point (m) at an arc length (m).
    pub fn push(&mut self, point: [f64; 3], arc: f64) {
        self.points.push(point);
        self.arc.push(arc);
    }

    /// From its first to its last point (m).
    #[must_use]
    pub fn length(&self) -> f64 {
        match (self.arc.first(), self.arc.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        }
    }

    /// Last point (m).
    ///
    /// # Panics
    /// Never for a line that a mold has given: it has at least one point.
    #[must_use]
    pub fn end(&self) -> [f64; 3] {
        self.points[self.points.len() - 1]
    }

    /// Point at an arc length (m), on the chord between two of its points.
    #[must_use]
    pub fn point_at(&self, arc: f64) -> [f64; 3] {
        let last = self.points.len() - 1;
        let n = self.arc.partition_point(|s| *s < arc).clamp(1, last.max(1)).min(last);
        if n == 0 {
            return self.points[0];
        }
        let (a, b) = (self.arc[n - 1], self.arc[n]);
        let t = if b > a { ((arc - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 };
        let [p, q] = [self.points[n - 1], self.points[n]];
        [0, 1, 2].map(|c| p[c] + t * (q[c] - p[c]))
    }
}

/// How a mold curves: positive where it curves away from its normal, as a sphere seen from outside.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Curvatures {
    /// Principal curvatures (1/m), the larger one first.
    pub principal: [f64; 2],
    /// Unit tangents along which they are.
    pub directions: [[f64; 3]; 2],
}

impl Curvatures {
    /// Curvatures (1/m) along two unit tangents at right angles, in either order.
    #[must_use]
    pub fn new(principal: [f64; 2], directions: [[f64; 3]; 2]) -> Self {
        let ([a, b], [s, t]) = (principal, directions);
        if a >= b {
            Curvatures { principal, directions }
        } else {
            Curvatures { principal: [b, a], directions: [t, s] }
        }
    }

    /// From the second fundamental form (1/m) over two unit tangents at right angles: its components
    /// (1,1), (1,2) and (2,2).
    #[must_use]
    fn of_form([a, b, c]: [f64; 3], [s, t]: [[f64; 3]; 2]) -> Self {
        let angle = 0.5 * (2.0 * b).atan2(a - c);
        let (sin, cos) = angle.sin_cos();
        let (mean, radius) = (0.5 * (a + c), (0.5 * (a - c)).hypot(b));
        let first = [0, 1, 2].map(|n| cos * s[n] + sin * t[n]);
        let second = [0, 1, 2].map(|n| cos * t[n] - sin * s[n]);
        Curvatures { principal: [mean + radius, mean - radius], directions: [first, second] }
    }

    /// Normal curvature along a unit tangent (1/m), after Euler.
    #[must_use]
    pub fn along(&self, tangent: [f64; 3]) -> f64 {
        (0..2).map(|n| self.principal[n] * dot(self.directions[n], tangent).powi(2)).sum()
    }
}

impl Mold {
    /// The mold without the plies that lie on it.
    #[must_use]
    pub fn bare(&self) -> &Mold {
        match self {
            Mold::Layered(layered) => layered.mold.bare(),
            mold => mold,
        }
    }

    /// What lies closest to `p` (m).
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        match self {
            Mold::Plane(plane) => plane.closest_point(p),
            Mold::Cylinder(cylinder) => cylinder.closest_point(p),
            Mold::Sphere(sphere) => sphere.closest_point(p),
            Mold::Torus(torus) => torus.closest_point(p),
            Mold::Graph(graph) => graph.closest_point(p),
            Mold::Mesh(mesh) => mesh.closest_point(p),
            Mold::Wavy(wavy) => wavy.closest_point(p),
            Mold::Layered(layered) => layered.closest_point(p),
        }
    }

    /// Gradient of the signed distance at `p` (m), whose closest point is `closest`: the unit vector along which the
    /// distance grows. On a smooth mold it is the normal; the normal of triangles is blended between their corners and
    /// differs from it.
    #[must_use]
    pub fn distance_gradient(&self, p: [f64; 3], closest: &ClosestPoint) -> [f64; 3] {
        match self {
            Mold::Mesh(_) if closest.distance.abs() > TUNING.direction * norm(p) => {
                sub(p, closest.point).map(|c| c / closest.distance)
            }
            Mold::Wavy(wavy) => wavy.distance_gradient(p),
            Mold::Layered(layered) => layered.distance_gradient(p),
            _ => closest.normal,
        }
    }

    /// Distance of `p` (m) from the mold (m), negative inside it.
    #[must_use]
    pub fn signed_distance(&self, p: [f64; 3]) -> f64 {
        match self {
            Mold::Plane(plane) => plane.signed_distance(p),
            _ => self.separation(p, f64::INFINITY).distance,
        }
    }

    /// How far `p` (m) is from the mold, as [`Mold::closest_point`] says it.
    ///
    /// It is known to be no farther than `most` (m), perhaps infinite, which saves a search among triangles.
    #[must_use]
    pub fn separation(&self, p: [f64; 3], most: f64) -> Separation {
        match self {
            Mold::Plane(plane) => Separation { distance: plane.signed_distance(p), beyond: false },
            Mold::Cylinder(cylinder) => cylinder.separation(p),
            Mold::Sphere(sphere) => sphere.separation(p),
            Mold::Torus(torus) => torus.separation(p),
            Mold::Mesh(mesh) => mesh.separation(p, most),
            Mold::Wavy(wavy) => wavy.separation(p),
            Mold::Layered(layered) => layered.separation(p),
            Mold::Graph(graph) => {
                let ClosestPoint { distance, beyond, .. } = graph.closest_point(p);
                Separation { distance, beyond }
            }
        }
    }

    /// Bounds of slope and bend for [`Mold::clear`]; only a height over a plane needs them.
    #[must_use]
    pub fn steepness(&self) -> Steepness {
        match self {
            Mold::Graph(graph) => graph.steepness(),
            Mold::Wavy(wavy) => wavy.mold.steepness(),
            Mold::Layered(layered) => layered.mold.steepness(),
            _ => Steepness::default(),
        }
    }

    /// Radius (m) of a ball around `p` (m) that holds nothing of the mold and lies outside of it, from how far
    /// `p` is away and [`Mold::steepness`]; zero if no such ball is known, and for a point inside the
    /// mold or to the side of its boundary.
    #[must_use]
    pub fn clear(&self, p: [f64; 3], apart: Separation, bound: Steepness) -> f64 {
        match self {
            Mold::Graph(graph) => graph.clear(p, apart, bound),
            Mold::Wavy(wavy) => wavy.clear(p, apart, bound),
            Mold::Layered(layered) => layered.clear(p, apart, bound),
            _ if apart.beyond => 0.0,
            _ => apart.distance.max(0.0),
        }
    }

    /// Smooth unit normal of the mold at its point closest to `p` (m).
    #[must_use]
    pub fn normal(&self, p: [f64; 3]) -> [f64; 3] {
        self.closest_point(p).normal
    }

    /// Principal curvatures of the mold at its point closest to `p` (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        match self {
            Mold::Plane(plane) => {
                Curvatures::new([0.0; 2], crate::geometry::vector::tangents(plane.normal))
            }
            Mold::Cylinder(cylinder) => cylinder.curvatures(p),
            Mold::Sphere(sphere) => sphere.curvatures(p),
            Mold::Torus(torus) => torus.curvatures(p),
            Mold::Graph(graph) => graph.curvatures(self.closest_point(p).point),
            Mold::Mesh(mesh) => mesh.curvatures(p),
            Mold::Wavy(wavy) => wavy.curvatures(p),
            Mold::Layered(layered) => layered.curvatures(p),
        }
    }

    /// The line on which fabric of arc length `length` (m) comes to lie that is laid along the mold from
    /// its point `from` (m), in the vertical plane of the horizontal unit vector `heading`; a negative
    /// length is laid against it. It ends early at an open boundary.
    #[must_use]
    pub fn lay(&self, from: [f64; 3], heading: [f64; 2], length: f64) -> SurfaceCurve {
        let heading = if length < 0.0 { heading.map(|c| -c) } else { heading };
        match self {
            Mold::Plane(plane) => {
                let slope = plane.slope(heading);
                let run = length.abs() / slope.hypot(1.0);
                let end = along(from, run, [heading[0], heading[1], slope]);
                SurfaceCurve { points: vec![from, end], arc: vec![0.0, length.abs()] }
            }
            Mold::Mesh(mesh) => mesh.section(from, heading, length.abs()),
            _ => trace(self, from, heading, Until::Length(length.abs())),
        }
    }

    /// The line along the mold from one of its points to another (m) in the vertical plane of both; none
    /// where it leads over an open boundary or onto another part of the mold.
    #[must_use]
    pub fn path(&self, a: [f64; 3], b: [f64; 3]) -> Option<SurfaceCurve> {
        let run = (b[0] - a[0]).hypot(b[1] - a[1]);
        let chord = distance(a, b);
        let straight = || SurfaceCurve { points: vec![a, b], arc: vec![0.0, chord] };
        match self {
            Mold::Plane(_) => Some(straight()),
            _ if chord <= TUNING.same_point * (norm(a) + norm(b)) => Some(straight()),
            _ if run < TUNING.above * chord => None,
            Mold::Mesh(mesh) => mesh.section_to(a, b),
            _ => {
                let heading = [(b[0] - a[0]) / run, (b[1] - a[1]) / run];
                let line = trace(self, a, heading, Until::Run(run));
                (distance(line.end(), b) < TUNING.arrival * chord).then_some(line)
            }
        }
    }

    /// Length of the fabric that lies taut between two points of the mold (m): along it, or straight where
    /// no line leads along it.
    #[must_use]
    pub fn path_length(&self, a: [f64; 3], b: [f64; 3]) -> f64 {
        match self {
            Mold::Plane(_) => distance(a, b),
            _ => self.path(a, b).map_or_else(|| distance(a, b), |line| line.length()),
        }
    }

    /// The highest point of the mold at the place (x, y) (m), if it has one there.
    #[must_use]
    pub fn highest_point(&self, [x, y]: [f64; 2]) -> Option<[f64; 3]> {
        let (position, reach) = match self {
            Mold::Plane(plane) => {
                let [nx, ny, nz] = plane.normal;
                let [px, py, pz] = plane.point;
                return Some([x, y, pz - (nx * (x - px) + ny * (y - py)) / nz]);
            }
            Mold::Graph(graph) => return graph.highest_point([x, y]),
            Mold::Mesh(mesh) => return mesh.highest_point([x, y]),
            Mold::Wavy(wavy) => return wavy.highest_point([x, y]),
            Mold::Layered(layered) => return layered.highest_point([x, y]),
            Mold::Cylinder(cylinder) => (cylinder.pose.position, None),
            Mold::Sphere(sphere) => (sphere.pose.position, Some(sphere.radius)),
            Mold::Torus(torus) => {
                (torus.pose.position, Some(torus.ring_radius + torus.tube_radius))
            }
        };
        self.trace_down([x, y], position, reach)
    }

    /// Sphere tracing from above (Hart 1996): down by as much as the distance to the mold allows, then by Newton's
    /// method.
    fn trace_down(
        &self,
        [x, y]: [f64; 2],
        position: [f64; 3],
        reach: Option<f64>,
    ) -> Option<[f64; 3]> {
        // an endless cylinder may be inclined: ten times as high is above slopes of up to 84°
        let aside = (x - position[0]).hypot(y - position[1]);
        let beside = self.signed_distance([x, y, position[2]]).abs();
        let reach = reach.unwrap_or(10.0 * (aside + beside));
        let mut p = [x, y, position[2] + 1.01 * reach];
        let floor = position[2] - 3.0 * reach;
        for _ in 0..TUNING.tracing_steps {
            let closest = self.closest_point(p);
            let is_near = closest.distance.abs() < TUNING.tracing_end * reach;
            if is_near && !closest.beyond && closest.normal[2] > TUNING.upright {
                let step = closest.distance / closest.normal[2];
                p[2] -= step;
                if step.abs() < TUNING.tracing_tolerance * reach {
                    return Some(p);
                }
                continue;
            }
            p[2] -= closest.distance.abs().max(TUNING.tracing_step * reach);
            if p[2] < floor {
                return None;
            }
        }
        (self.signed_distance(p).abs() < TUNING.tracing_tolerance * reach).then_some(p)
    }

    /// A distance (m) from the mold that no point of a curve of `length` (m) between `a` and `b` falls
    /// short of.
    #[must_use]
    pub fn clearance(&self, a: [f64; 3], b: [f64; 3], length: f64) -> f64 {
        let [da, db] = [self.signed_distance(a), self.signed_distance(b)];
        match self {
            Mold::Plane(_) => {
                let chord = distance(a, b);
                let sag = 0.5 * (length * length - chord * chord).max(0.0).sqrt();
                da.min(db) - sag
            }
            Mold::Wavy(wavy) => wavy.mold.clearance(a, b, length) - wavy.relief.most(),
            Mold::Layered(layered) => layered.mold.clearance(a, b, length) - layered.relief.most(),
            // no two points are farther apart in their distances than along the curve
            _ => 0.5 * (da + db - length),
        }
    }
}
