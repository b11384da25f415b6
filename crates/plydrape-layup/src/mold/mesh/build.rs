//! From loose triangles to a mold: placing, joining, turning, boundaries.

use super::orient::{self, orient};
use super::report::{MeshReport, Stitches};
use super::soup::Soup;
use super::tree::Tree;
use super::{Mesh, boundary, bounds, join, normals, one_ring, stitch};
use crate::Error;
use crate::geometry::vector::distance;
use crate::mold::Pose;
use crate::mold::tuning::TUNING;
use std::sync::OnceLock;

/// Sizes of a mold that are no mistake of units (m).
const SIZES: std::ops::RangeInclusive<f64> = 1e-4..=1e5;

impl Mesh {
    /// A mold of triangles: corners (m), and the three of each triangle. Its faces are not stitched.
    ///
    /// # Errors
    /// If the triangles are no mold: [`Error::MeshVertex`], [`Error::MeshEmpty`], [`Error::MeshNoArea`], [`Error::MeshSize`],
    /// [`Error::MeshBranching`], [`Error::MeshOneSided`] or [`Error::MeshSideways`].
    pub fn of_triangles(
        vertices: Vec<[f64; 3]>,
        triangles: &[[u32; 3]],
    ) -> Result<(Self, MeshReport), Error> {
        Self::of_faces(vertices, triangles, 0.0)
    }

    /// As [`Mesh::of_triangles`], with boundaries of faces stitched that are no farther apart than `tolerance` (m).
    ///
    /// # Errors
    /// The errors of [`Mesh::of_triangles`].
    pub fn of_faces(
        vertices: Vec<[f64; 3]>,
        triangles: &[[u32; 3]],
        tolerance: f64,
    ) -> Result<(Self, MeshReport), Error> {
        let mut soup = Soup::new("triangle");
        for (n, corners) in triangles.iter().enumerate() {
            if let Some(vertex) = corners.iter().find(|vertex| **vertex as usize >= vertices.len())
            {
                let (triangle, vertex, vertices) = (n + 1, *vertex, vertices.len());
                return Err(Error::MeshVertex { triangle, vertex, vertices });
            }
            soup.push(corners, n as u64 + 1);
        }
        soup.points = vertices;
        Self::of_soup(soup, 1.0, &Pose::new([0.0; 3], [0.0; 3]), tolerance)
    }

    /// A mold of triangles that are not joined yet: coordinates are multiplied by `scale` (m per unit), then placed
    /// by `pose`. Boundaries of faces that are no farther apart than `tolerance` (m) are stitched; none are at 0.
    ///
    /// # Errors
    /// The errors of [`Mesh::of_triangles`], and [`Error::MeshScale`] if the scale is no positive number.
    pub fn of_soup(
        mut soup: Soup,
        scale: f64,
        pose: &Pose,
        tolerance: f64,
    ) -> Result<(Self, MeshReport), Error> {
        let noun = soup.noun;
        if !(scale > 0.0 && scale.is_finite()) {
            return Err(Error::MeshScale { scale });
        }
        if soup.triangles.is_empty() {
            let kinds: Vec<&str> =
                soup.skipped.iter().map(|skipped| skipped.kind.as_str()).collect();
            let others = match kinds.len() {
                0 => String::new(),
                _ => format!(" of a surface, only of type {}", kinds.join(", ")),
            };
            return Err(Error::MeshEmpty { noun, others });
        }
        let mut used = vec![false; soup.points.len()];
        soup.triangles.as_flattened().iter().for_each(|n| used[*n as usize] = true);
        for (point, used) in soup.points.iter_mut().zip(&used) {
            // what no triangle uses shall not count for the size
            *point = if *used { pose.place(point.map(|x| scale * x)) } else { [f64::NAN; 3] };
        }
        let [low, high] = bounds(soup.points.iter().copied());
        let size = distance(low, high);
        let mut report =
            MeshReport { skipped: std::mem::take(&mut soup.skipped), ..MeshReport::default() };
        for place in report.skipped.iter_mut().filter_map(|skipped| skipped.place.as_mut()) {
            *place = pose.place(place.map(|x| scale * x));
        }
        if !SIZES.contains(&size) {
            return Err(Error::MeshSize { size, scale });
        }

        let mut joined = join::join(&soup, size, &mut report);
        if joined.triangles.is_empty() {
            let triangles = soup.triangles.len();
            return Err(Error::MeshNoArea { triangles, size });
        }
        drop(soup);
        let apart = joined.clone();
        if tolerance > 0.0 {
            joined.leave_out_caps(TUNING.merge * size, &mut report);
        }
        report.stitched = stitch::stitch(&mut joined, tolerance);
        let mut neighbors = orient::neighbors(&joined, noun)?;
        let (component, components) = match orient(&mut joined, &mut neighbors, noun, &mut report) {
            // faces that make a surface without two sides once they are stitched stay apart
            Err(_) if report.stitched.count > 0 => {
                report.stitched = Stitches::default();
                joined = apart;
                neighbors = orient::neighbors(&joined, noun)?;
                orient(&mut joined, &mut neighbors, noun, &mut report)?
            }
            found => found?,
        };
        joined.renumber();
        let first_corners = one_ring::split(&mut joined, &neighbors);

        let join::Joined { vertices, triangles, .. } = joined;
        let triangle_normals = normals::of_triangles(&vertices, &triangles);
        let vertex_normals = normals::of_vertices(&vertices, &triangles, &triangle_normals);
        let boundaries =
            boundary::boundaries(&vertices, &triangles, &neighbors, &component, &components);
        let tree = Tree::new(
            triangles.iter().map(|corners| bounds(corners.iter().map(|n| vertices[*n as usize]))),
        );
        report.vertices = vertices.len();
        report.triangles = triangles.len();
        report.surfaces = components.len();
        report.closed = components.iter().filter(|component| component.closed).count();
        report.bounds = [low, high];
        report.holes = boundaries.iter().filter(|boundary| boundary.hole).cloned().collect();
        let mesh = Mesh {
            vertices,
            triangles,
            neighbors,
            first_corners,
            triangle_normals,
            vertex_normals,
            boundaries,
            bounds: [low, high],
            size,
            tree,
            shapes: OnceLock::new(),
        };
        Ok((mesh, report))
    }

    /// The mold with boundaries of faces stitched that are no farther apart than `tolerance` (m); `None` where there are none.
    ///
    /// # Errors
    /// The errors of [`Mesh::of_triangles`].
    pub fn stitched(&self, tolerance: f64) -> Result<Option<(Self, MeshReport)>, Error> {
        if self.boundaries.is_empty() {
            return Ok(None);
        }
        let mut soup = Soup::new("triangle");
        soup.points.clone_from(&self.vertices);
        soup.triangles.clone_from(&self.triangles);
        soup.numbers = (1..=self.triangles.len() as u64).collect();
        let (mesh, report) = Self::of_soup(soup, 1.0, &Pose::new([0.0; 3], [0.0; 3]), tolerance)?;
        Ok((report.stitched.count > 0).then_some((mesh, report)))
    }
}
