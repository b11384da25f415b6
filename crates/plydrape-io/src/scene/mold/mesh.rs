//! Meshes from STL, OBJ and Abaqus files.

use super::Keys;
use crate::Error;
use crate::read::mesh;
use crate::scene::located::Located;
use crate::scene::placement::{MESH, round};
use crate::scene::quantity::Read;
use crate::scene::read;
use crate::scene::source::Document;
use crate::scene::units::{self, Dimension};
use plydrape::mold::{Mesh, MeshReport, Mold, Pose};
use plydrape::ply::Ply;
use std::path::Path;
use std::sync::Arc;

/// Checks the keys of a mesh, and reads its file.
pub(super) fn mesh(keys: &Keys, ply: &Ply, tolerance: f64) -> Result<(Mold, MeshReport), Error> {
    let file =
        keys.required(&keys.table.file, "file", "\"mold.stl\", an .stl, .obj or .inp file")?;
    let unit = keys.table.unit.as_ref();
    let width = spanned(keys, ply)?;
    let (mesh, report) = mesh_file(
        file,
        unit,
        &Purpose { what: "mold", tolerance },
        &keys.pose()?,
        keys.document,
        &keys.document.folder,
    )?;
    if let Some(unit) = unit {
        check_size(&mesh, unit, ply, keys.document)?;
    }
    let (mesh, report) = mesh.spanned(report, width, usual_width(ply), tolerance);
    Ok((Mold::Mesh(Arc::new(mesh)), report))
}

/// Width up to which the ply spans pits and holes (m).
fn spanned(keys: &Keys, ply: &Ply) -> Result<f64, Error> {
    let Some(width) = &keys.table.spanned else { return Ok(usual_width(ply)) };
    let value = width.read(keys.document)?;
    let cell = ply.cell[0].min(ply.cell[1]);
    if value > cell {
        return Err(keys.document.error(
            width.span.clone(),
            format!("{} is more than a cell of the ply", keys.document.quoted(&width.span)),
            format!(
                "give a width up to that of a cell, {} mm; what is wider is part of the shape of the mold",
                round(1e3 * cell)
            ),
        ));
    }
    Ok(value)
}

/// Width up to which a ply spans pits and holes unless given (m): as wide as the meshes of its ideal drape.
pub(in crate::scene) fn usual_width(ply: &Ply) -> f64 {
    MESH * ply.cell[0].min(ply.cell[1])
}

/// Smallest and largest mold, in diagonals of its ply: on a smaller one no ply can lie. A larger one does not exist: a thousand
/// times a ply of 200 mm are twice the longest blade of a wind turbine.
const SIZES_IN_PLIES: [f64; 2] = [0.1, 1000.0];
/// Units that meshes are written in.
const MESH_UNITS: [&str; 4] = ["mm", "cm", "in", "m"];

/// Refuses a mold that its ply cannot be meant for, with the sizes of both.
fn check_size(
    mesh: &Mesh,
    unit: &Located<String>,
    ply: &Ply,
    document: &Document,
) -> Result<(), Error> {
    let ([low, high], [from, to]) = (mesh.bounds(), ply.bounds(0.0));
    let sides = [0, 1, 2].map(|n| high[n] - low[n]);
    let of_ply = [0, 1].map(|n| to[n] - from[n]);
    let ratio = sides[0].hypot(sides[1]).hypot(sides[2]) / of_ply[0].hypot(of_ply[1]);
    let [least, most] = SIZES_IN_PLIES;
    if (least..=most).contains(&ratio) {
        return Ok(());
    }
    let length = |unit: &str| units::unit(unit).map_or(1.0, |(length, _)| length);
    let own = length(&unit.value);
    // nearest to the size of the ply, on which molds are larger
    let fits = |unit: &&str| (1.0..0.1 * most).contains(&(ratio * length(unit) / own));
    let other = MESH_UNITS.into_iter().find(fits);
    let side = if ratio < least { "small" } else { "large" };
    let millimeters = |side: f64| round(1e3 * side);
    let [x, y, z] = sides.map(millimeters);
    let [u, v] = of_ply.map(millimeters);
    Err(document.error(
        unit.span.clone(),
        format!(
            "in {} the mold measures {x} × {y} × {z} mm, too {side} for a ply of {u} × {v} mm",
            document.quoted(&unit.span)
        ),
        match other {
            Some(other) => {
                let [x, y, z] = sides.map(|side| millimeters(side * length(other) / own));
                format!("did you mean unit = \"{other}\"? the mold then measures {x} × {y} × {z} mm")
            }
            None => "give the unit that the file is written in, and see whether the sizes in [ply] have theirs".into(),
        },
    ))
}

/// What a mesh file is read for.
pub(in crate::scene) struct Purpose {
    /// What the mesh is of, for messages.
    pub what: &'static str,
    /// How far apart boundaries of its faces may be and still be stitched (m).
    pub tolerance: f64,
}

/// Reads a mesh file in a folder, whose coordinates are in a unit, and places it.
pub(in crate::scene) fn mesh_file(
    file: &Located<String>,
    unit: Option<&Located<String>>,
    purpose: &Purpose,
    pose: &Pose,
    document: &Document,
    folder: &Path,
) -> Result<(Mesh, MeshReport), Error> {
    let at_file = |error: Error| document.error(file.span.clone(), error.to_string(), error.help());
    let bytes = read::bytes(&folder.join(&file.value), &file.value, mesh::LARGEST)
        .map_err(|error| document.error_of_named(&file.span, error, "scene"))?;
    let parse =
        |scale: f64, pose: &Pose| mesh::parse(&file.value, &bytes, scale, pose, purpose.tolerance);
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
                "add unit = \"mm\" if the {} measures {x} × {y} × {z} mm, or unit = \"m\" if these are meters",
                purpose.what
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
            let help = "expected the unit of a length: \"mm\", \"cm\", \"m\" or \"in\"";
            return Err(document.error(unit.span.clone(), message, help));
        }
    };
    parse(scale, pose).map_err(at_file)
}
