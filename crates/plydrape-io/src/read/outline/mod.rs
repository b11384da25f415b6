//! A ply's outline from a drawing: ASCII DXF, of any version, to a boundary and its holes.
//!
//! 1. `pairs`: what is no part of an outline is left out of the text, then the library reads it;
//! 2. `entity`: lines, arcs, circles, ellipses, polylines with bulges, splines and blocks of the layers that are wanted become
//!    polygons that stay within a tolerance of them (`flatten`);
//! 3. `chain`: polygons are joined end to end into closed lines;
//! 4. the largest of these is the boundary, and those inside it are holes.

mod chain;
mod entity;
mod error;
mod flatten;
mod pairs;
#[cfg(test)]
mod tests;
mod transform;

pub use error::{OutlineFault, OutlineFileError, Place};

use crate::store::{input, size};
use ::dxf::{Drawing, DxfError, enums::Units};
use chain::Closed;
use plydrape::ply::{Outline, Ring};
use std::collections::BTreeSet;
use std::path::Path;

/// Ends of curves that are this close join, as a share of the size of all curves: 10 µm of a meter.
pub const JOIN: f64 = 1e-5;
/// A boundary that is smaller than this many tolerances is refused: it would be no more than a rough picture.
const SMALLEST: f64 = 10.0;
/// Memory that a byte of a drawing takes while it is read (bytes): 400 000 lines in 16 MB took 0.7 GB, and a copy of what is kept.
const MEMORY: f64 = 60.0;
/// Largest file that is opened (bytes).
const LARGEST_FILE: u64 = 1 << 26;

/// How a drawing is read.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The layers with the outline, in small or capital letters; all that are visible if none are given.
    pub layers: Option<Vec<String>>,
    /// Length of the drawing's unit (m); that of its header if none is given.
    pub unit: Option<f64>,
    /// Largest distance of the outline from curves of the drawing (m).
    pub tolerance: f64,
    /// Distance of ends that join, as a share of the size of all curves; see [`JOIN`].
    pub join: f64,
}

impl Options {
    /// All visible layers, with the unit of the header, followed to a tolerance (m).
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Options { layers: None, unit: None, tolerance, join: JOIN }
    }
}

/// The outline in a DXF file, in the coordinates of the drawing (m).
///
/// # Errors
/// [`OutlineFileError`] as [`read_dxf`], or if the file cannot be read.
pub fn read(path: &Path, options: &Options) -> Result<Outline, OutlineFileError> {
    let file = path.display().to_string();
    match input::bytes(path, LARGEST_FILE) {
        Ok(bytes) => read_dxf(&file, &bytes, options),
        Err(source) => Err(OutlineFileError { file, fault: OutlineFault::Unreadable(source) }),
    }
}

/// The outline in the bytes of a DXF file, in the coordinates of the drawing (m).
///
/// # Errors
/// [`OutlineFileError`] for what is no DXF text or no outline: each says where, and has a remedy.
pub fn read_dxf(file: &str, bytes: &[u8], options: &Options) -> Result<Outline, OutlineFileError> {
    outline(bytes, options).map_err(|fault| OutlineFileError { file: file.to_owned(), fault })
}

fn outline(bytes: &[u8], options: &Options) -> Result<Outline, OutlineFault> {
    let above_zero = |what, value: f64| match value.is_finite() && value > 0.0 {
        true => Ok(value),
        false => Err(OutlineFault::Option { what, value }),
    };
    let tolerance = above_zero("the tolerance (m)", options.tolerance)?;
    let join = above_zero("the share of the size within which ends join", options.join)?;
    let drawing = drawing(bytes)?;
    let unit = match options.unit {
        Some(unit) => above_zero("the unit of the drawing (m)", unit)?,
        None => metres(drawing.header.default_drawing_units).ok_or(OutlineFault::Unitless)?,
    };
    check_layers(&drawing, options)?;

    let found = entity::curves(&drawing, unit, options)?;
    if found.curves.is_empty() {
        let (layers, others) = (options.layers.clone(), found.others.into_iter().collect());
        return Err(OutlineFault::Empty { layers, others });
    }
    let size = extent(found.curves.iter().flat_map(|curve| &curve.points));
    let mut all = chain::closed(found.curves, join * size[0].hypot(size[1]))?;

    // the largest first; of two that are as large, the first of the file
    all.sort_by(|a, b| area(&b.ring).total_cmp(&area(&a.ring)));
    let Some(outer) = all.first() else {
        let (layers, others) = (options.layers.clone(), Vec::new());
        return Err(OutlineFault::Empty { layers, others });
    };
    let size = extent(&outer.ring);
    if size[0].max(size[1]) < SMALLEST * tolerance {
        return Err(OutlineFault::Tiny { place: outer.place.clone(), size, tolerance });
    }
    if let Some(inner) = all[1..].iter().find(|inner| !inside(&outer.ring, inner.ring[0])) {
        return Err(OutlineFault::Several {
            outer: outer.place.clone(),
            inner: Box::new(inner.place.clone()),
            layers: layers(&all),
        });
    }
    let mut rings = all.into_iter().map(|closed| closed.ring);
    let boundary = rings.next().unwrap_or_default();
    Outline::new(boundary, rings.collect()).map_err(OutlineFault::Outline)
}

/// What the library reads of a file.
fn drawing(bytes: &[u8]) -> Result<Drawing, OutlineFault> {
    let memory = MEMORY * bytes.len() as f64;
    size::check(memory, || format!("a drawing of {}", size::shown(bytes.len() as f64)))
        .map_err(OutlineFault::Size)?;
    let kept = pairs::keep(bytes)?;
    let drawing = Drawing::load(&mut kept.text.as_slice()).map_err(|error| {
        let line = match &error {
            DxfError::ParseFloatError(_, line)
            | DxfError::ParseIntError(_, line)
            | DxfError::ParseError(line)
            | DxfError::UnexpectedEnumValue(line)
            | DxfError::WrongValueType(line)
            | DxfError::UnexpectedCode(_, line)
            | DxfError::ExpectedTableType(line) => Some(*line),
            DxfError::UnexpectedCodePair(pair, _) => Some(pair.offset),
            _ => None,
        };
        match line.and_then(|line| kept.origin(line)) {
            Some((line, code, found)) => OutlineFault::Value { line, code, found },
            None => OutlineFault::Unread(error.to_string()),
        }
    })?;
    let (found, expected) = (entity::count(&drawing), kept.entities);
    if found == expected {
        return Ok(drawing);
    }
    Err(OutlineFault::Unread(format!("{found} of its {expected} entities can be read")))
}

/// A unit of a drawing (m); none if it has none.
fn metres(units: Units) -> Option<f64> {
    Some(match units {
        Units::Microinches => 25.4e-9,
        Units::Mils => 25.4e-6,
        Units::Inches => 0.0254,
        Units::Feet => 0.3048,
        Units::Yards => 0.9144,
        Units::Nanometers => 1e-9,
        Units::Microns => 1e-6,
        Units::Millimeters => 1e-3,
        Units::Centimeters => 1e-2,
        Units::Decimeters => 0.1,
        Units::Meters => 1.0,
        Units::Decameters => 10.0,
        _ => return None,
    })
}

/// Refuses layers that the drawing does not have.
fn check_layers(drawing: &Drawing, options: &Options) -> Result<(), OutlineFault> {
    let of_blocks = drawing.blocks().flat_map(|block| &block.entities);
    let used = drawing.entities().chain(of_blocks).map(|entity| entity.common.layer.as_str());
    let names = drawing.layers().map(|layer| layer.name.as_str()).chain(used);
    let known: BTreeSet<&str> = names.filter(|name| !name.is_empty()).collect();
    let keys: BTreeSet<String> = known.iter().map(|name| entity::key(name)).collect();
    let absent = |layer: &&String| !keys.contains(&entity::key(layer));
    match options.layers.iter().flatten().find(absent) {
        None => Ok(()),
        Some(layer) => Err(OutlineFault::Layer {
            layer: layer.clone(),
            known: known.into_iter().map(str::to_owned).collect(),
        }),
    }
}

/// The layers of closed lines.
fn layers(all: &[Closed]) -> Vec<String> {
    let names: BTreeSet<&str> = all.iter().map(|closed| closed.place.layer.as_str()).collect();
    names.into_iter().map(str::to_owned).collect()
}

/// Size of points along x and y (m).
fn extent<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>) -> [f64; 2] {
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for point in points {
        for n in 0..2 {
            bounds[0][n] = bounds[0][n].min(point[n]);
            bounds[1][n] = bounds[1][n].max(point[n]);
        }
    }
    [0, 1].map(|n| bounds[1][n] - bounds[0][n])
}

/// The lines of a ring.
fn lines(ring: &Ring) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    ring.iter().enumerate().map(|(n, point)| [*point, ring[(n + 1) % ring.len()]])
}

/// Area of a closed line (m²), whatever its sense.
fn area(ring: &Ring) -> f64 {
    let origin = ring[0];
    let to = |p: [f64; 2]| [p[0] - origin[0], p[1] - origin[1]];
    let twice = lines(ring).map(|[a, b]| {
        let (a, b) = (to(a), to(b));
        a[0] * b[1] - a[1] * b[0]
    });
    0.5 * twice.sum::<f64>().abs()
}

/// Whether a point is inside a closed line.
fn inside(ring: &Ring, [x, y]: [f64; 2]) -> bool {
    let right = |[a, b]: &[[f64; 2]; 2]| {
        (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) * (b[0] - a[0]) / (b[1] - a[1])
    };
    lines(ring).filter(right).count() % 2 == 1
}
