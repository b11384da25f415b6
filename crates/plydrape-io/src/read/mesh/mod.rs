//! Meshes from STL, OBJ and Abaqus files.

mod element;
mod inp;
mod instance;
mod obj;
mod stl;
mod text;

use crate::Error;
use crate::store::{encoding, input, size};
use plydrape::LayupError;
use plydrape::mold::Pose;
use plydrape::mold::mesh::{Mesh, MeshReport};
use std::path::Path;

/// Largest mesh file that is read (bytes).
pub(crate) const LARGEST: u64 = 1 << 30;

/// Reads a mesh from an STL, OBJ or Abaqus file, recognized by the end of its name.
///
/// Coordinates are multiplied by `scale` (m per unit of the file), then placed by `pose`. Boundaries of faces that are no
/// farther apart than `tolerance` (m) are stitched; none are at 0.
///
/// # Errors
/// If the file cannot be read, its contents are no mesh, or the mesh is no mold: see [`Error`].
pub fn read(
    path: &Path,
    scale: f64,
    pose: &Pose,
    tolerance: f64,
) -> Result<(Mesh, MeshReport), Error> {
    let file = path.display().to_string();
    let bytes = input::bytes(path, LARGEST).map_err(|source| Error::read(path, source))?;
    parse(&file, &bytes, scale, pose, tolerance)
}

/// A file's name as a word of a command line.
fn quoted(name: &str) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "./\\_-+:".contains(c);
    if name.chars().all(is_plain) { name.to_owned() } else { format!("\"{name}\"") }
}

/// Reads a mesh from the contents of a file; its name gives the format and appears in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(
    file: &str,
    bytes: &[u8],
    scale: f64,
    pose: &Pose,
    tolerance: f64,
) -> Result<(Mesh, MeshReport), Error> {
    let no_mold = |fault: LayupError| Error::file(file, format!("{file}: {fault}"), fault.remedy());

    // an empty file is no mesh, whatever its format
    let bytes = &*encoding::unicode(bytes);
    let extension = Path::new(file).extension().unwrap_or_default().to_string_lossy();
    if bytes.trim_ascii().is_empty() && !extension.is_empty() {
        let others = ": the file is empty".to_owned();
        return Err(no_mold(LayupError::MeshEmpty { noun: "triangle", others }));
    }

    // the ending of the name gives the format
    let soup = match extension.to_ascii_lowercase().as_str() {
        "stl" => stl::read(file, bytes)?,
        "obj" => obj::read(file, bytes)?,
        "inp" => inp::read(file, bytes)?,
        _ => {
            let message = match &*extension {
                "" => format!("{file}: the file name has no ending"),
                _ => format!("{file}: the file name ends in .{extension}"),
            };
            let help = match &*extension.to_ascii_lowercase() {
                "step" | "stp" | "iges" | "igs" => {
                    let made = Path::new(file).with_extension("stl").display().to_string();
                    let [cad, made] = [file, &made].map(quoted);
                    format!(
                        "a part from CAD becomes a mesh by `python -m plydrape.cad {cad} -o {made}`; then give the .stl file, with unit = \"mm\""
                    )
                }
                _ => "the name of a mesh ends in .stl, .obj or .inp".to_owned(),
            };
            return Err(Error::file(file, message, help));
        }
    };

    // refuse too many triangles before a mesh is made of them
    size::mesh(soup.triangles.len() as f64).map_err(|error| error.of_file(file))?;
    Mesh::of_soup(soup, scale, pose, tolerance).map_err(no_mold)
}
