//! Normals of triangles and vertices.
//!
//! A vertex normal is the mean of the normals around it, weighted by the angle of each triangle there. It
//! does not depend on how a flat piece is cut into triangles, and its sign tells inside from
//! outside for points whose closest point is the vertex (Bærentzen and Aanæs 2005).

use crate::geometry::vector::{cross, dot, norm, sub, unit};

/// Unit normal of each triangle.
pub(super) fn of_triangles(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[f64; 3]> {
    let normal = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|n| vertices[n as usize]);
        let across = cross(sub(b, a), sub(c, a));
        let length = norm(across);
        across.map(|x| x / length)
    };
    triangles.iter().map(normal).collect()
}

/// Unit normal of each vertex.
pub(super) fn of_vertices(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    normals: &[[f64; 3]],
) -> Vec<[f64; 3]> {
    let mut sums = vec![[0.0; 3]; vertices.len()];
    for (corners, normal) in triangles.iter().zip(normals) {
        let points = corners.map(|n| vertices[n as usize]);
        for k in 0..3 {
            let to_next = sub(points[(k + 1) % 3], points[k]);
            let to_last = sub(points[(k + 2) % 3], points[k]);
            let angle = norm(cross(to_next, to_last)).atan2(dot(to_next, to_last));
            let sum = &mut sums[corners[k] as usize];
            *sum = [0, 1, 2].map(|n| sum[n] + angle * normal[n]);
        }
    }
    // opposite normals that cancel: any of them
    let mut any = vec![[0.0, 0.0, 1.0]; vertices.len()];
    for (corners, normal) in triangles.iter().zip(normals) {
        corners.iter().for_each(|n| any[*n as usize] = *normal);
    }
    sums.iter().zip(any).map(|(sum, any)| unit(*sum).unwrap_or(any)).collect()
}
