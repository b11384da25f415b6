//! Meshes from STL, OBJ and Abaqus files.

use super::Keys;
use crate::mesh::{self, MeshFileError};
use crate::scene::error::{Document, SceneError};
use crate::scene::layup::round;
use crate::scene::located::Located;
use crate::scene::read;
use crate::scene::units::{self, Dimension};
use plydrape::mold::{Mesh, MeshReport, Mold, Pose};
use std::path::Path;
use std::sync::Arc;

/// Checks the keys of a mesh, and reads its file.
pub(super) fn mesh(keys: &Keys, base: &Path) -> Result<(Mold, MeshReport), SceneError> {
    let file =
        keys.required(&keys.table.file, "file", "\"mold.stl\", an .stl, .obj or .inp file")?;
    let unit = keys.table.unit.as_ref();
    let (mesh, report) = mesh_file(file, unit, "mold", &keys.pose()?, keys.document, base)?;
    Ok((Mold::Mesh(Arc::new(mesh)), report))
}

/// Reads a mesh file, whose coordinates are in a unit, and places it; `what` is what the mesh is of.
pub(in crate::scene) fn mesh_file(
    file: &Located<String>,
    unit: Option<&Located<String>>,
    what: &str,
    pose: &Pose,
    document: &Document,
    base: &Path,
) -> Result<(Mesh, MeshReport), SceneError> {
    let at_file =
        |error: MeshFileError| document.error(file.span.clone(), error.to_string(), error.remedy());
    let path = base.join(&file.value);
    let bytes = read::bytes(&path, &file.value, mesh::LARGEST).map_err(|error| {
        let help = format!("paths are relative to the scene's folder; {}", error.help);
        document.error(file.span.clone(), error.message, help)
    })?;
    let parse = |scale: f64, pose: &Pose| mesh::parse(&file.value, &bytes, scale, pose);
    let Some(unit) = unit else {
        // how big it would be, in the unit of the file
        let turned = Pose { position: [0.0; 3], ..*pose };
        let (mesh, _) = parse(1.0, &turned).map_err(at_file)?;
        let [low, high] = mesh.bounds();
        let [x, y, z] = [0, 1, 2].map(|n| round(high[n] - low[n]));
        return Err(document.error(
            file.span.clone(),
            format!("a mesh file does not say its unit, and `{}` needs one", file.value),
            format!(
                "add unit = \"mm\" if the {what} measures {x} × {y} × {z} mm, or unit = \"m\" if these are metres"
            ),
        ));
    };
    let scale = match units::unit(&unit.value) {
        Ok((size, Dimension::LENGTH)) => size,
        found => {
            let message = match found {
                Ok((_, other)) => format!("{} is the unit of {other}", document.quoted(&unit.span)),
                Err(_) => format!("{} is no unit known here", document.quoted(&unit.span)),
            };
            let help = "the unit of a length is wanted: \"mm\", \"cm\", \"m\" or \"in\"";
            return Err(document.error(unit.span.clone(), message, help));
        }
    };
    parse(scale, pose).map_err(at_file)
}
