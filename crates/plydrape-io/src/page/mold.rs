//! The mold as the page draws it: triangles around the ply.

use super::packing::short;
use crate::result::ResultFile;
use crate::write::mold_patch::mold_patch;
use serde::Serialize;

/// Triangles (m).
#[derive(Serialize)]
pub(super) struct Mold {
    vertices: Vec<f64>,
    triangles: Vec<u32>,
}

impl Mold {
    /// The mold around the ply in this many triangles at most, if there is one.
    pub fn new(result: &ResultFile, most: usize) -> Option<Mold> {
        let found = mold_patch(result, most)?;
        Some(Mold {
            vertices: found.vertices.iter().flatten().map(|c| short(*c)).collect(),
            triangles: found.triangles.into_iter().flatten().collect(),
        })
    }
}
