//! A mold given by triangles.
//!
//! Triangles are taken as they come ([`Soup`]), vertices are merged, faces that all but meet are stitched, triangles turned to
//! face one way and boundaries found; what was repaired is listed in the [`MeshReport`]. The mesh then answers
//! what any mold is asked: the closest point and which side it is on, a smooth normal, curvatures, lines along
//! it in a vertical plane, and its highest point at a place.

mod boundary;
mod build;
mod closest_point;
mod curvature;
mod detail;
mod gap;
mod highest_point;
mod join;
mod normals;
mod one_ring;
mod orient;
mod report;
mod section;
mod sharp;
mod side;
mod soup;
mod stitch;
mod tree;
mod triangle;

pub use boundary::Boundary;
pub use detail::{Detail, DetailKind};
pub use gap::Gaps;
pub use report::{Finding, MeshReport, Stitches};
pub use sharp::SharpEdge;
pub use soup::{Role, Skipped, Soup};
pub(crate) use triangle::{Closest, closest};

use std::fmt;
use std::sync::OnceLock;

/// A triangle mesh in its place. It never changes; share it behind an `Arc`.
#[derive(Clone)]
pub struct Mesh {
    /// Places of the vertices (m).
    vertices: Vec<[f64; 3]>,
    /// Corners of each triangle, anticlockwise seen from outside.
    triangles: Vec<[u32; 3]>,
    /// Triangles across the edges from corner k to corner k + 1, or none.
    neighbors: Vec<[u32; 3]>,
    /// First corner of the triangles around each vertex.
    first_corners: Vec<one_ring::Corner>,
    /// Unit normal of each triangle, outwards.
    triangle_normals: Vec<[f64; 3]>,
    /// Smooth unit normal of each vertex, outwards.
    vertex_normals: Vec<[f64; 3]>,
    boundaries: Vec<Boundary>,
    bounds: [[f64; 3]; 2],
    /// Diagonal of the box around the mesh (m).
    size: f64,
    tree: tree::Tree,
    /// Shape operator of each vertex, once asked for.
    shapes: OnceLock<Vec<curvature::Symmetric>>,
}

impl Mesh {
    /// Places of the vertices (m).
    #[must_use]
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Corners of each triangle, as indices of vertices, anticlockwise seen from outside.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// The boundaries of its open surfaces, holes included.
    #[must_use]
    pub fn boundaries(&self) -> &[Boundary] {
        &self.boundaries
    }

    /// Corners of the box around it (m): lowest and highest coordinates.
    #[must_use]
    pub fn bounds(&self) -> [[f64; 3]; 2] {
        self.bounds
    }

    /// Places of a triangle's corners (m).
    fn corners(&self, triangle: usize) -> [[f64; 3]; 3] {
        // `map` is not inlined, which the search for closest points would feel
        let [a, b, c] = self.triangles[triangle];
        [self.vertices[a as usize], self.vertices[b as usize], self.vertices[c as usize]]
    }
}

/// Equal vertices and triangles.
impl PartialEq for Mesh {
    fn eq(&self, other: &Self) -> bool {
        self.vertices == other.vertices && self.triangles == other.triangles
    }
}

/// Size only.
impl fmt::Debug for Mesh {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Mesh")
            .field("vertices", &self.vertices.len())
            .field("triangles", &self.triangles.len())
            .field("bounds", &self.bounds)
            .finish_non_exhaustive()
    }
}

/// Lowest and highest coordinates of some points; points that are no numbers do not count.
fn bounds(points: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    points.fold([[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]], |[low, high], p| {
        [[0, 1, 2].map(|n| low[n].min(p[n])), [0, 1, 2].map(|n| high[n].max(p[n]))]
    })
}
