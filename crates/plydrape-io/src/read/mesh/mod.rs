//! Meshes from STL, OBJ and Abaqus files.

mod element;
mod error;
mod inp;
mod instance;
mod obj;
mod stl;
mod text;

pub use error::MeshFileError;

use crate::store::size;
use plydrape::mold::mesh::{Mesh, MeshReport};
use plydrape::mold::{MeshError, Pose};
use std::path::Path;

/// Largest mesh file that is read (bytes).
pub(crate) const LARGEST: u64 = 1 << 30;

/// Reads a mesh from an STL, OBJ or Abaqus file, recognized by the end of its name.
///
/// Coordinates are multiplied by `scale` (m per unit of the file), then placed by `pose`.
///
/// # Errors
/// If the file cannot be read, its contents are no mesh, or the mesh is no mold: see [`MeshFileError`].
pub fn read(path: &Path, scale: f64, pose: &Pose) -> Result<(Mesh, MeshReport), MeshFileError> {
    let file = path.display().to_string();
    let unreadable = |source| MeshFileError::Unreadable { file: file.clone(), source };
    let bytes = crate::store::input::bytes(path, LARGEST).map_err(unreadable)?;
    parse(&file, &bytes, scale, pose)
}

/// The same from the contents of a file; its name states the format and stands in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(
    file: &str,
    bytes: &[u8],
    scale: f64,
    pose: &Pose,
) -> Result<(Mesh, MeshReport), MeshFileError> {
    let too_large = |source| MeshFileError::Size { file: file.to_owned(), source };
    let no_mold = |source| MeshFileError::Mesh { file: file.to_owned(), source };
    let extension = Path::new(file).extension().unwrap_or_default().to_string_lossy();
    if bytes.trim_ascii().is_empty() && !extension.is_empty() {
        let others = ": the file is empty".to_owned();
        return Err(no_mold(MeshError::Empty { noun: "triangle", others }));
    }
    let soup = match extension.to_ascii_lowercase().as_str() {
        "stl" => stl::read(file, bytes)?,
        "obj" => obj::read(file, bytes)?,
        "inp" => inp::read(file, bytes)?,
        _ => {
            let (file, extension) = (file.to_owned(), extension.into_owned());
            return Err(MeshFileError::Format { file, extension });
        }
    };
    size::mesh(soup.triangles.len() as f64).map_err(too_large)?;
    Mesh::of_soup(soup, scale, pose).map_err(no_mold)
}
