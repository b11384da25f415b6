//! Meshes from STL, OBJ and Abaqus files.

use super::Keys;
use crate::mesh::{self, MeshFileError};
use crate::scene::error::SceneError;
use crate::scene::layup::round;
use crate::scene::read;
use crate::scene::units::{self, Dimension};
use plydrape::mold::{MeshReport, Mold, Pose};
use std::path::Path;
use std::sync::Arc;

/// Checks the keys of a mesh, and reads its file.
pub(super) fn mesh(keys: &Keys, base: &Path) -> Result<(Mold, MeshReport), SceneError> {
    let document = keys.document;
    let file =
        keys.required(&keys.table.file, "file", "\"mold.stl\", an .stl, .obj or .inp file")?;
    let at_file =
        |error: MeshFileError| document.error(file.span.clone(), error.to_string(), error.remedy());
    let path = base.join(&file.value);
    let bytes = read::bytes(&path, &file.value, mesh::LARGEST).map_err(|error| {
        let help = format!("paths are relative to the scene's folder; {}", error.help);
        document.error(file.span.clone(), error.message, help)
    })?;
    let parse = |scale: f64, pose: &Pose| mesh::parse(&file.value, &bytes, scale, pose);
    let Some(unit) = &keys.table.unit else {
        // how big the mold would be, in the unit of the file
        let turned = Pose { position: [0.0; 3], ..keys.pose()? };
        let (mesh, _) = parse(1.0, &turned).map_err(at_file)?;
        let [low, high] = mesh.bounds();
        let [x, y, z] = [0, 1, 2].map(|n| round(high[n] - low[n]));
        return Err(document.error(
            file.span.clone(),
            format!("a mesh file does not say its unit, and `{}` needs one", file.value),
            format!(
                "add unit = \"mm\" if the mold measures {x} × {y} × {z} mm, or unit = \"m\" if these are metres"
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
    let (mesh, report) = parse(scale, &keys.pose()?).map_err(at_file)?;
    Ok((Mold::Mesh(Arc::new(mesh)), report))
}
