//! The distance of two shapes, by `parry3d-f64`. No other file knows its types.
//!
//! Distances of convex shapes are those of the algorithm of Gilbert, Johnson and Keerthi, depths those of the expanding polytope
//! algorithm; of meshes the nearest or deepest triangle counts. A cylinder of parry is about its y axis, ours about z. A box is the
//! hull of its corners, because parry's own way from a cuboid to a triangle does not always find the nearest points: from the middle
//! of a cube of triangles it finds those of two edges.

use super::body::Shape;
use crate::geometry::vector::between;
use crate::mold::{Pose, distance};
use parry3d_f64::math::{Pose as ParryPose, Rotation, Vector};
use parry3d_f64::query::{self, ClosestPoints, details};
use parry3d_f64::shape::{Cylinder, Segment, SharedShape, TriMesh, TriMeshFlags};
use std::fmt;

/// A shape that distances can be taken from.
#[derive(Clone)]
pub(crate) struct Solid {
    shape: SharedShape,
    /// Where parry's shape is in the coordinates of the body.
    local: ParryPose,
    /// Middle of a ball around it (m), and the ball's radius (m).
    pub ball: ([f64; 3], f64),
    /// A segment (m), and the farthest distance of its points from there (m).
    pub capsule: ([[f64; 3]; 2], f64),
    /// The box around it: lowest and highest coordinates (m).
    pub bounds: [[f64; 3]; 2],
    /// A point of it (m), of which one asks whether it is inside a closed mesh.
    point: [f64; 3],
    /// Whether it is a mesh that encloses a volume.
    closed: bool,
}

impl fmt::Debug for Solid {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.debug_struct("Solid").field("ball", &self.ball).finish_non_exhaustive()
    }
}

/// How far two shapes are from each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Apart {
    /// Distance (m); minus the depth where they penetrate each other.
    pub distance: f64,
    /// The middle between their nearest points (m).
    pub place: [f64; 3],
}

impl Solid {
    pub fn new(shape: &Shape) -> Self {
        let ball = shape.ball();
        let (parry, local) = match shape {
            Shape::Cylinder { radius, from, to } => {
                let upright = Rotation::from_rotation_x(std::f64::consts::FRAC_PI_2);
                let local = ParryPose::from_parts(vector(ball.0), upright);
                (SharedShape::new(Cylinder::new(0.5 * (to - from), *radius)), local)
            }
            Shape::Box { size, at } => {
                let [low, high] = shape.bounds();
                let corner = |n: usize| {
                    vector([0, 1, 2].map(|c| if n >> c & 1 == 1 { high[c] } else { low[c] }))
                };
                let corners: Vec<Vector> = (0..8).map(corner).collect();
                match SharedShape::convex_hull(&corners) {
                    Some(hull) => (hull, ParryPose::IDENTITY),
                    // too thin for its hull
                    None => {
                        let [x, y, z] = size.map(|side| 0.5 * side);
                        (SharedShape::cuboid(x, y, z), ParryPose::from_translation(vector(*at)))
                    }
                }
            }
            Shape::Mesh { vertices, triangles } => {
                let corners = vertices.iter().map(|p| vector(*p)).collect();
                let mesh = TriMesh::with_flags(corners, triangles.clone(), TriMeshFlags::ORIENTED);
                match mesh {
                    Ok(mesh) => (SharedShape::new(mesh), ParryPose::IDENTITY),
                    // without triangles: the ball around its corners
                    Err(_) => {
                        (SharedShape::ball(ball.1), ParryPose::from_translation(vector(ball.0)))
                    }
                }
            }
        };
        let (point, closed) = match shape {
            Shape::Mesh { vertices, triangles } => {
                (vertices.first().copied().unwrap_or(ball.0), is_closed(triangles))
            }
            _ => (ball.0, false),
        };
        let (capsule, bounds) = (shape.capsule(), shape.bounds());
        Solid { shape: parry, local, ball, capsule, bounds, point, closed }
    }

    /// How far this shape, placed by a pose, is from another one.
    pub fn apart(&self, own: &Pose, other: &Solid, its: &Pose) -> Apart {
        let poses = [parry_pose(own) * self.local, parry_pose(its) * other.local];
        let (a, b) = (&*self.shape.0, &*other.shape.0);
        let inside = (self.closed && self.contains(own, its.place(other.point)))
            || (other.closed && other.contains(its, own.place(self.point)));
        let points = query::closest_points(&poses[0], a, &poses[1], b, f64::MAX);
        if let Ok(ClosestPoints::WithinMargin(p, q)) = points {
            // a shape that a mesh encloses must pass through its surface to be free again
            let distance = if inside { -(p - q).length() } else { (p - q).length() };
            return Apart { distance, place: array(0.5 * (p + q)) };
        }
        // they touch, or the search for the nearest points did not end: that for the deepest begins elsewhere
        let most = if points == Ok(ClosestPoints::Intersecting) { 0.0 } else { f64::MAX };
        if let Ok(Some(contact)) = query::contact(&poses[0], a, &poses[1], b, most) {
            let place = array(0.5 * (contact.point1 + contact.point2));
            let touches = points == Ok(ClosestPoints::Intersecting);
            let distance = if touches { contact.dist.min(0.0) } else { contact.dist };
            return Apart { distance, place };
        }
        // nothing more is known than that they touch, or that their balls are so far apart
        let [middle, its_middle] = [own.place(self.ball.0), its.place(other.ball.0)];
        let gap = distance(middle, its_middle) - self.ball.1 - other.ball.1;
        Apart { distance: gap.max(0.0), place: between(middle, its_middle, 0.5) }
    }

    /// Whether a point (m) is inside a closed mesh.
    fn contains(&self, own: &Pose, point: [f64; 3]) -> bool {
        self.shape.contains_point(&(parry_pose(own) * self.local), vector(point))
    }
}

/// The distance of two segments (m).
pub(crate) fn between_segments(one: &[[f64; 3]; 2], other: &[[f64; 3]; 2]) -> f64 {
    let [a, b] = [one, other].map(|[from, to]| Segment::new(vector(*from), vector(*to)));
    let (on_a, on_b) =
        details::closest_points_segment_segment_with_locations(&ParryPose::IDENTITY, &a, &b);
    (a.point_at(&on_a) - b.point_at(&on_b)).length()
}

/// Whether every edge of a mesh has one triangle on each of its sides.
fn is_closed(triangles: &[[u32; 3]]) -> bool {
    let mut edges: Vec<[u32; 2]> = Vec::with_capacity(3 * triangles.len());
    for [a, b, c] in triangles {
        edges.extend([[*a, *b], [*b, *c], [*c, *a]]);
    }
    let mut turned: Vec<[u32; 2]> = edges.iter().map(|[a, b]| [*b, *a]).collect();
    edges.sort_unstable();
    turned.sort_unstable();
    edges == turned && edges.windows(2).all(|pair| pair[0] != pair[1])
}

fn vector([x, y, z]: [f64; 3]) -> Vector {
    Vector::new(x, y, z)
}

fn array(v: Vector) -> [f64; 3] {
    [v.x, v.y, v.z]
}

fn parry_pose(pose: &Pose) -> ParryPose {
    let [x, y, z, w] = pose.quaternion();
    ParryPose::from_parts(vector(pose.position), Rotation::from_xyzw(x, y, z, w))
}
