//! How a mesh curves: the shape operator of each triangle from the normals of its vertices.
//!
//! Over an edge e the normal turns by Δn ≈ S e. The three edges of a triangle fix its symmetric S by least
//! squares (Rusinkiewicz 2004). Turned into the tangent plane of each vertex, the operators of its
//! triangles are averaged by area, and blended between vertices.

use super::Mesh;
use crate::geometry::vector::{cross, dot, norm, sub, tangents};
use crate::mold::Curvatures;

/// A symmetric matrix: its components xx, xy, xz, yy, yz, zz.
pub(super) type Symmetric = [f64; 6];

impl Mesh {
    /// Principal curvatures of the smooth surface at the point closest to `p` (m).
    #[must_use]
    pub fn curvatures(&self, p: [f64; 3]) -> Curvatures {
        let place = self.surface_point(p);
        let shapes = self.shapes.get_or_init(|| self.vertex_shapes());
        let mut shape = [0.0; 6];
        for (corner, weight) in self.triangles[place.triangle].iter().zip(place.weights) {
            let own = &shapes[*corner as usize];
            (0..6).for_each(|n| shape[n] += weight * own[n]);
        }
        let frame = tangents(self.normal_at(&place));
        Curvatures::of_form(form(&shape, frame), frame)
    }

    /// Shape operator of each vertex (1/m).
    fn vertex_shapes(&self) -> Vec<Symmetric> {
        let mut shapes = vec![[0.0; 6]; self.vertices.len()];
        let mut areas = vec![0.0; self.vertices.len()];
        for (t, corners) in self.triangles.iter().enumerate() {
            let points = self.corners(t);
            let area = norm(cross(sub(points[1], points[0]), sub(points[2], points[0])));
            let frame = tangents(self.triangle_normals[t]);
            let Some(own) = self.triangle_form(t, frame) else { continue };
            for corner in corners.map(|n| n as usize) {
                let turned = frame
                    .map(|s| transport(s, self.triangle_normals[t], self.vertex_normals[corner]));
                let shape = outer(own, turned);
                (0..6).for_each(|n| shapes[corner][n] += area * shape[n]);
                areas[corner] += area;
            }
        }
        for (shape, area) in shapes.iter_mut().zip(areas) {
            if area > 0.0 {
                shape.iter_mut().for_each(|x| *x /= area);
            }
        }
        shapes
    }

    /// Components (1,1), (1,2) and (2,2) of the shape operator of a triangle in a frame of its plane, by
    /// least squares over its edges.
    fn triangle_form(&self, t: usize, [s, r]: [[f64; 3]; 2]) -> Option<[f64; 3]> {
        let points = self.corners(t);
        let normals = self.triangles[t].map(|n| self.vertex_normals[n as usize]);
        // normal equations of (a b; b c) (u, v) = (m, n) over three edges; uu is the sum of u², …
        let [mut uu, mut uv, mut vv] = [0.0; 3];
        let mut right = [0.0; 3];
        for k in 0..3 {
            let edge = sub(points[(k + 1) % 3], points[k]);
            let change = sub(normals[(k + 1) % 3], normals[k]);
            let (u, v) = (dot(edge, s), dot(edge, r));
            let (m, n) = (dot(change, s), dot(change, r));
            uu += u * u;
            uv += u * v;
            vv += v * v;
            right = [right[0] + m * u, right[1] + m * v + n * u, right[2] + n * v];
        }
        // eliminates b: uu a + uv b = r0; uv a + (uu + vv) b + uv c = r1; uv b + vv c = r2
        let pivot = uu + vv - uv * uv / uu - uv * uv / vv;
        let b = (right[1] - uv * right[0] / uu - uv * right[2] / vv) / pivot;
        let form = [(right[0] - uv * b) / uu, b, (right[2] - uv * b) / vv];
        form.iter().all(|x| x.is_finite()).then_some(form)
    }
}

/// A tangent turned by the shortest rotation from one unit normal to another.
fn transport(tangent: [f64; 3], from: [f64; 3], to: [f64; 3]) -> [f64; 3] {
    let axis = cross(from, to);
    let cos = dot(from, to);
    let across = cross(axis, tangent);
    let lengthwise = dot(axis, tangent) / (1.0 + cos).max(1e-9);
    [0, 1, 2].map(|n| cos * tangent[n] + across[n] + lengthwise * axis[n])
}

/// Σ form_ij t_i t_j as a matrix in space.
fn outer([a, b, c]: [f64; 3], [s, r]: [[f64; 3]; 2]) -> Symmetric {
    let part =
        |i: usize, j: usize| a * s[i] * s[j] + b * (s[i] * r[j] + r[i] * s[j]) + c * r[i] * r[j];
    [part(0, 0), part(0, 1), part(0, 2), part(1, 1), part(1, 2), part(2, 2)]
}

/// Components (1,1), (1,2) and (2,2) of a matrix in a frame.
fn form([xx, xy, xz, yy, yz, zz]: &Symmetric, [s, r]: [[f64; 3]; 2]) -> [f64; 3] {
    let times = |v: [f64; 3]| {
        [
            xx * v[0] + xy * v[1] + xz * v[2],
            xy * v[0] + yy * v[1] + yz * v[2],
            xz * v[0] + yz * v[1] + zz * v[2],
        ]
    };
    [dot(s, times(s)), dot(s, times(r)), dot(r, times(r))]
}
