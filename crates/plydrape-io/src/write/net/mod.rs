//! What a net leaves behind: its nodes as a table, its shear as a picture and for VTK, and the mold.
//!
//! [`write_all`] puts these files into a folder:
//!
//! - `nodes.csv`, where every point of the fabric should end ([`nodes`]);
//! - `boundary.csv` and `boundary.dxf`, the ply's boundary on the mold ([`boundary`]);
//! - `shear.svg`, the shear on the flat fabric ([`figure::shear_map`]);
//! - `seeds.csv` and `seeds.svg`, what each seed costs, where it was searched for ([`seeds`], [`figure::seeds`]);
//! - `net.vtp` and `mold.vtp` for ParaView and other readers of VTK's files ([`polygons`]).
//!
//! [`Summary`] says in a few numbers how the net lies, and judges it.

pub mod boundary;
mod findings;
pub mod nodes;
pub mod polygons;
pub mod seeds;
mod summary;

pub use findings::Findings;
pub use summary::{ShearPlace, Summary};

use crate::Error;
use crate::store::folder;
use crate::store::json::finite;
use crate::write::figure;
use plydrape::mold::Mold;
use plydrape::net::Net;
use std::path::{Path, PathBuf};

/// Writes the files of this module into a folder, all or none; what is not there to be written has no file.
///
/// Returns the paths written. Same net, same bytes.
///
/// # Errors
/// [`Error`] if a number is not finite, a file in the way is not plydrape's, or the disk refuses; the folder is then as it was.
pub fn write_all(
    net: &Net,
    mold: &Mold,
    findings: &Findings,
    title: &str,
    dir: &Path,
    read: &[PathBuf],
) -> Result<Vec<PathBuf>, Error> {
    // First of all: it proves every number finite.
    finite::check(net)?;
    let nodes = nodes::table(net)?;
    let boundary = findings.boundary.as_ref().filter(|boundary| !boundary.lines.is_empty());
    let lines = boundary.map(boundary::table).transpose()?;
    let drawing = boundary.map(boundary::dxf);
    let map = figure::shear_map::svg(net, title);
    let costs = findings.seeds.as_ref().map(seeds::table).transpose()?;
    let picture = findings.seeds.as_ref().map(|seeds| figure::seeds::svg(seeds, net, title));
    let cells = polygons::net(net);
    let surface = polygons::mold(net, mold);
    let texts = [
        ("nodes.csv", Some(&nodes)),
        ("boundary.csv", lines.as_ref()),
        ("boundary.dxf", drawing.as_ref()),
        ("shear.svg", map.as_ref()),
        ("seeds.csv", costs.as_ref()),
        ("seeds.svg", picture.as_ref()),
    ];
    let mut files: Vec<(&str, &[u8])> =
        texts.iter().filter_map(|(name, text)| Some((*name, text.as_ref()?.as_bytes()))).collect();
    files.push(("net.vtp", cells.as_slice()));
    files.extend(surface.iter().map(|bytes| ("mold.vtp", bytes.as_slice())));
    folder::write(dir, "net", &files, read)
}

/// Shear at a node (rad): mean magnitude of the whole cells around it; `None` beside missing nodes only.
fn nodal_shear(net: &Net, [i, j]: [usize; 2]) -> Option<f64> {
    let around = [[1, 1], [0, 1], [1, 0], [0, 0]];
    let cells = around.iter().filter_map(|[a, b]| Some([i.checked_sub(*a)?, j.checked_sub(*b)?]));
    let found: Vec<f64> =
        cells.filter_map(|cell| net.cell_shear(cell)).map(|shear| shear.magnitude).collect();
    (!found.is_empty()).then(|| found.iter().sum::<f64>() / found.len() as f64)
}

#[cfg(test)]
mod tests;
