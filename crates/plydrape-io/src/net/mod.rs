//! What a net leaves behind: its nodes as a table, its shear as a picture and for VTK, and the mold.
//!
//! [`write_all`] puts four files into a folder:
//!
//! - `nodes.csv`, where every point of the fabric should end ([`nodes`]);
//! - `shear.svg`, the shear map ([`figure::shear_map`]);
//! - `net.vtp` and `mold.vtp` for ParaView and other readers of VTK's files ([`polygons`]).
//!
//! [`Summary`] says in a few numbers how the net lies, and judges it.

pub mod nodes;
pub mod polygons;
mod summary;

pub use summary::{ShearPlace, Summary};

use super::{OutputError, figure, finite, folder};
use plydrape::mold::Mold;
use plydrape::net::Net;
use std::path::{Path, PathBuf};

/// Writes `nodes.csv`, `shear.svg`, `net.vtp` and `mold.vtp` into a folder, all or none; a mold of which
/// nothing is near the net has no file.
///
/// Returns the paths written. Same net, same bytes.
///
/// # Errors
/// [`OutputError`] if the net has no node with a place, a number is not finite, a file in the way is not
/// plydrape's, or the disk refuses; the folder is then as it was.
pub fn write_all(
    net: &Net,
    mold: &Mold,
    title: &str,
    dir: &Path,
) -> Result<Vec<PathBuf>, OutputError> {
    // First of all: it proves every number finite.
    finite::check(net)?;
    let nodes = nodes::table(net)?;
    let map = figure::shear_map::svg(net, mold, title)?;
    let cells = polygons::net(net);
    let surface = polygons::mold(net, mold);
    let mut files = vec![
        ("nodes.csv", nodes.as_bytes()),
        ("shear.svg", map.as_bytes()),
        ("net.vtp", cells.as_slice()),
    ];
    files.extend(surface.iter().map(|bytes| ("mold.vtp", bytes.as_slice())));
    folder::write(dir, "net", &files)
}

/// Shear at a node (rad): mean magnitude of the whole cells around it; none beside missing nodes only.
fn nodal_shear(net: &Net, [i, j]: [usize; 2]) -> Option<f64> {
    let around = [[1, 1], [0, 1], [1, 0], [0, 0]];
    let cells = around.iter().filter_map(|[a, b]| Some([i.checked_sub(*a)?, j.checked_sub(*b)?]));
    let found: Vec<f64> =
        cells.filter_map(|cell| net.cell_shear(cell)).map(|shear| shear.magnitude).collect();
    (!found.is_empty()).then(|| found.iter().sum::<f64>() / found.len() as f64)
}

#[cfg(test)]
mod tests;
