//! The mold under the drape, in triangles, with its smooth normals as point data.

use super::polydata::{Array, PolyData};
use crate::result::ResultFile;
use crate::write::mold_patch::mold_patch;

/// Triangles, at most.
const TRIANGLES: usize = 20_000;

/// The mold of a result, if it has one.
pub(super) fn mold(result: &ResultFile) -> Option<PolyData> {
    let mold = result.scene.mold.as_ref()?;
    let found = mold_patch(result, TRIANGLES)?;
    let normals: Vec<[f64; 3]> = found.vertices.iter().map(|p| mold.normal(*p)).collect();
    Some(PolyData::surface(found, vec![Array::vectors("Normals", &normals)]))
}
