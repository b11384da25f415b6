//! From a file to a mold: reading, placing, joining, turning, borders.

use super::orient::{neighbours, orient};
use super::query::Tree;
use super::report::MeshReport;
use super::soup::Soup;
use super::{Mesh, MeshError, border, bounds, fan, inp, join, normals, obj, stl};
use crate::mold::Pose;
use crate::mold::vector::distance;
use serde::Deserialize;
use std::path::Path;
use std::sync::OnceLock;

/// Sizes of a mold that are no mistake of units (m).
const SIZES: std::ops::RangeInclusive<f64> = 1e-4..=1e5;

impl Mesh {
    /// Reads a mesh from an STL, OBJ or Abaqus file, told by the end of its name.
    ///
    /// Coordinates are multiplied by `scale` (m per unit of the file), then placed by `pose`.
    ///
    /// # Errors
    /// If the file cannot be read, its contents are no mesh, or the mesh is no mold: see [`MeshError`].
    pub fn read(path: &Path, scale: f64, pose: &Pose) -> Result<(Self, MeshReport), MeshError> {
        let file = path.display().to_string();
        let unreadable = |source| MeshError::Unreadable { file: file.clone(), source };
        let bytes = std::fs::read(path).map_err(unreadable)?;
        Self::parse(&file, &bytes, scale, pose)
    }

    /// A mold of triangles that a program has made: corners (m), and the three of each triangle.
    ///
    /// # Errors
    /// If the triangles are no mold: see [`MeshError`].
    pub fn of_triangles(
        vertices: Vec<[f64; 3]>,
        triangles: &[[u32; 3]],
    ) -> Result<(Self, MeshReport), MeshError> {
        let (file, mut soup) = ("the mold", Soup::new("triangle"));
        let most = vertices.len();
        if triangles.as_flattened().iter().any(|n| *n as usize >= most) {
            let others = " of the vertices it has".to_owned();
            return Err(MeshError::Empty { file: file.into(), noun: "triangle", others });
        }
        soup.points = vertices;
        for (n, corners) in triangles.iter().enumerate() {
            soup.push(corners, n as u64 + 1);
        }
        build(soup, file, 1.0, &Pose::new([0.0; 3], [0.0; 3]))
    }

    /// The same from the contents of a file; its name tells the format and stands in messages.
    ///
    /// # Errors
    /// As [`Mesh::read`].
    pub fn parse(
        file: &str,
        bytes: &[u8],
        scale: f64,
        pose: &Pose,
    ) -> Result<(Self, MeshReport), MeshError> {
        let extension = Path::new(file).extension().unwrap_or_default().to_string_lossy();
        if bytes.trim_ascii().is_empty() && !extension.is_empty() {
            let others = ": the file is empty".to_owned();
            return Err(MeshError::Empty { file: file.to_owned(), noun: "triangle", others });
        }
        let soup = match extension.to_ascii_lowercase().as_str() {
            "stl" => stl::read(file, bytes)?,
            "obj" => obj::read(file, bytes)?,
            "inp" => inp::read(file, bytes)?,
            _ => {
                let (file, extension) = (file.to_owned(), extension.into_owned());
                return Err(MeshError::Format { file, extension });
            }
        };
        build(soup, file, scale, pose)
    }
}

/// A [`Mesh`] as it is written.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Triangles {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl TryFrom<Triangles> for Mesh {
    type Error = MeshError;

    fn try_from(written: Triangles) -> Result<Self, MeshError> {
        Mesh::of_triangles(written.vertices, &written.triangles).map(|(mesh, _)| mesh)
    }
}

/// Builds the mold from loose triangles.
fn build(
    mut soup: Soup,
    file: &str,
    scale: f64,
    pose: &Pose,
) -> Result<(Mesh, MeshReport), MeshError> {
    let name = || file.to_owned();
    let noun = soup.noun;
    if !(scale > 0.0 && scale.is_finite()) {
        return Err(MeshError::Scale { file: name(), scale });
    }
    if soup.triangles.is_empty() {
        let kinds: Vec<&str> = soup.skipped.iter().map(|(kind, _)| kind.as_str()).collect();
        let others = match kinds.len() {
            0 => String::new(),
            _ => format!(" of a surface, only of type {}", kinds.join(", ")),
        };
        return Err(MeshError::Empty { file: name(), noun, others });
    }
    let mut used = vec![false; soup.points.len()];
    soup.triangles.as_flattened().iter().for_each(|n| used[*n as usize] = true);
    for (point, used) in soup.points.iter_mut().zip(&used) {
        // what no triangle uses shall not count for the size
        *point = if *used { pose.place(point.map(|x| scale * x)) } else { [f64::NAN; 3] };
    }
    let [low, high] = bounds(soup.points.iter());
    let size = distance(low, high);
    let mut report =
        MeshReport { skipped: std::mem::take(&mut soup.skipped), ..MeshReport::default() };
    if !SIZES.contains(&size) {
        return Err(MeshError::Size { file: name(), size, scale });
    }

    let mut joined = join::join(&soup, size, &mut report);
    if joined.triangles.is_empty() {
        let triangles = soup.triangles.len();
        return Err(MeshError::NoArea { file: name(), triangles, size });
    }
    drop(soup);
    let mut neighbours = neighbours(&joined, file, noun)?;
    let (component, components) = orient(&mut joined, &mut neighbours, file, noun, &mut report)?;
    joined.renumber();
    let fans = fan::split(&mut joined, &neighbours);

    let join::Joined { vertices, triangles, .. } = joined;
    let triangle_normals = normals::of_triangles(&vertices, &triangles);
    let vertex_normals = normals::of_vertices(&vertices, &triangles, &triangle_normals);
    let borders = border::borders(&vertices, &triangles, &neighbours, &component, &components);
    let tree = Tree::new(
        triangles.iter().map(|corners| bounds(corners.iter().map(|n| &vertices[*n as usize]))),
    );
    report.vertices = vertices.len();
    report.triangles = triangles.len();
    report.surfaces = components.len();
    report.closed = components.iter().filter(|component| component.closed).count();
    report.bounds = [low, high];
    report.holes = borders.iter().filter(|border| border.hole).cloned().collect();
    let mesh = Mesh {
        vertices,
        triangles,
        neighbours,
        fans,
        triangle_normals,
        vertex_normals,
        borders,
        bounds: [low, high],
        size,
        tree,
        shapes: OnceLock::new(),
    };
    Ok((mesh, report))
}
