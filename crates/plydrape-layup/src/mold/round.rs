//! Molds with a circle for a profile: cylinder, sphere and torus.

use super::{ClosestPoint, Curvatures, Separation};
use crate::geometry::Pose;
use crate::geometry::vector::{cross, dot, unit};

/// Which side of a round mold the ply lies on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum Face {
    /// On the whole of it, from outside.
    Outside,
    /// In its lower half (local z ≤ 0), from inside: a trough, a bowl or a channel with an open boundary.
    Inside,
}

/// A cylinder about the local x axis, of any length.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Cylinder {
    /// Pose; the local x axis is the axis.
    pub pose: Pose,
    /// Radius (m).
    pub radius: f64,
    /// Where the ply lies.
    pub face: Face,
}

/// A sphere about the local origin.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Sphere {
    /// Pose; the local origin is the center.
    pub pose: Pose,
    /// Radius (m).
    pub radius: f64,
    /// Where the ply lies.
    pub face: Face,
}

/// A torus about the local z axis.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Torus {
    /// Ring lies in the local xy plane.
    pub pose: Pose,
    /// Radius of the ring that the tube follows (m).
    pub ring_radius: f64,
    /// Radius of the tube (m), smaller than that of the ring.
    pub tube_radius: f64,
    /// Where the ply lies.
    pub face: Face,
}

/// What lies closest to a point on a circle about the origin of the plane (h, z).
struct Arc {
    point: [f64; 2],
    normal: [f64; 2],
    distance: f64,
    beyond: bool,
}

impl Arc {
    fn separation(&self) -> Separation {
        Separation { distance: self.distance, beyond: self.beyond }
    }
}

fn arc(h: f64, z: f64, radius: f64, face: Face) -> Arc {
    let from_center = length(h, z);
    match face {
        Face::Outside => {
            let outward =
                if from_center > 0.0 { [h / from_center, z / from_center] } else { [0.0, 1.0] };
            Arc {
                point: outward.map(|c| radius * c),
                normal: outward,
                distance: from_center - radius,
                beyond: false,
            }
        }
        // a trough ends at its boundary, half-way up
        Face::Inside if z > 0.0 => {
            let side = 1.0_f64.copysign(h);
            Arc {
                point: [side * radius, 0.0],
                normal: [-side, 0.0],
                distance: (h.abs() - radius).hypot(z),
                beyond: true,
            }
        }
        Face::Inside => {
            let outward =
                if from_center > 0.0 { [h / from_center, z / from_center] } else { [0.0, -1.0] };
            Arc {
                point: outward.map(|c| radius * c),
                normal: outward.map(|c| -c),
                distance: radius - from_center,
                beyond: false,
            }
        }
    }
}

/// 1 seen from outside, −1 from inside.
fn sign(face: Face) -> f64 {
    match face {
        Face::Outside => 1.0,
        Face::Inside => -1.0,
    }
}

/// Length of a vector of ordinary size; `hypot` would spend most of a closest point on guarding against overflow.
fn length(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// Radial distance from the z axis and the unit vector of it in plan.
fn radial(x: f64, y: f64) -> (f64, [f64; 2]) {
    let rho = length(x, y);
    if rho > 0.0 { (rho, [x / rho, y / rho]) } else { (0.0, [1.0, 0.0]) }
}

fn placed(pose: &Pose, point: [f64; 3], normal: [f64; 3], arc: &Arc) -> ClosestPoint {
    ClosestPoint {
        point: pose.place(point),
        normal: pose.turn(normal),
        distance: arc.distance,
        beyond: arc.beyond,
    }
}

impl Cylinder {
    /// How far `p` (m) is away.
    #[must_use]
    pub fn separation(&self, p: [f64; 3]) -> Separation {
        let [_, y, z] = self.pose.local(p);
        arc(y, z, self.radius, self.face).separation()
    }

    /// What lies closest to `p` (m).
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        let [x, y, z] = self.pose.local(p);
        let arc = arc(y, z, self.radius, self.face);
        let ([h, v], [nh, nv]) = (arc.point, arc.normal);
        placed(&self.pose, [x, h, v], [0.0, nh, nv], &arc)
    }

    /// Principal curvatures at a point of the mold (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        let around = cross(self.closest_point(p).normal, self.pose.axes[0]);
        Curvatures::new([sign(self.face) / self.radius, 0.0], [around, self.pose.axes[0]])
    }
}

impl Sphere {
    /// How far `p` (m) is away.
    #[must_use]
    pub fn separation(&self, p: [f64; 3]) -> Separation {
        let [x, y, z] = self.pose.local(p);
        arc(length(x, y), z, self.radius, self.face).separation()
    }

    /// What lies closest to `p` (m).
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        let [x, y, z] = self.pose.local(p);
        let (rho, [cos, sin]) = radial(x, y);
        let arc = arc(rho, z, self.radius, self.face);
        let ([h, v], [nh, nv]) = (arc.point, arc.normal);
        placed(&self.pose, [h * cos, h * sin, v], [nh * cos, nh * sin, nv], &arc)
    }

    /// Principal curvatures at a point of the mold (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        let curvature = sign(self.face) / self.radius;
        let normal = self.closest_point(p).normal;
        // any tangent is principal: the one closest to the local x axis
        let axis = self.pose.axes[usize::from(dot(normal, self.pose.axes[0]).abs() > 0.9)];
        let across = unit(cross(normal, axis)).unwrap_or(axis);
        Curvatures::new([curvature; 2], [cross(across, normal), across])
    }
}

impl Torus {
    /// How far `p` (m) is away.
    #[must_use]
    pub fn separation(&self, p: [f64; 3]) -> Separation {
        let [x, y, z] = self.pose.local(p);
        arc(length(x, y) - self.ring_radius, z, self.tube_radius, self.face).separation()
    }

    /// What lies closest to `p` (m).
    #[must_use]
    pub fn closest_point(&self, p: [f64; 3]) -> ClosestPoint {
        let [x, y, z] = self.pose.local(p);
        let (rho, [cos, sin]) = radial(x, y);
        let arc = arc(rho - self.ring_radius, z, self.tube_radius, self.face);
        let ([h, v], [nh, nv]) = (arc.point, arc.normal);
        let out = self.ring_radius + h;
        placed(&self.pose, [out * cos, out * sin, v], [nh * cos, nh * sin, nv], &arc)
    }

    /// Principal curvatures at a point of the mold (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        let ClosestPoint { point, normal, .. } = self.closest_point(p);
        let [x, y, _] = self.pose.local(point);
        let (rho, [cos, sin]) = radial(x, y);
        let around = self.pose.turn([-sin, cos, 0.0]);
        // along the ring: the normal's part that points away from the axis, over the distance to it
        let outward = dot(self.pose.turn([cos, sin, 0.0]), normal);
        Curvatures::new(
            [sign(self.face) / self.tube_radius, outward / rho],
            [cross(around, normal), around],
        )
    }
}
