//! A ply's outline from a drawing: ASCII DXF, of any version, to a boundary and its holes.
//!
//! 1. `pairs`: what is no part of an outline is left out of the text, then the library reads it;
//! 2. `entity`: lines, arcs, circles, ellipses, polylines with bulges, splines and blocks of the layers that are wanted become
//!    polygons that stay within a tolerance of them (`flatten`);
//! 3. `chain`: polygons are joined end to end into closed lines;
//! 4. the largest of these is the boundary, and those inside it are holes.

mod chain;
mod entity;
mod flatten;
mod pairs;
mod place;
#[cfg(test)]
mod tests;
mod transform;

use crate::Error;
use crate::error::{self, Fault};
use crate::store::{encoding, input, size};
use ::dxf::{Drawing, DxfError, enums::Units};
use chain::Closed;
use place::listed;
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
pub(crate) const LARGEST: u64 = 1 << 26;

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
/// As [`read_dxf`], or if the file cannot be read.
pub fn read(path: &Path, options: &Options) -> Result<Outline, Error> {
    let bytes = input::bytes(path, LARGEST).map_err(|source| Error::read(path, source))?;
    read_dxf(&path.display().to_string(), &bytes, options)
}

/// The outline in the bytes of a DXF file, in the coordinates of the drawing (m).
///
/// # Errors
/// [`Error::File`] for what is no DXF text or no outline: it says where, and has a remedy.
pub fn read_dxf(file: &str, bytes: &[u8], options: &Options) -> Result<Outline, Error> {
    let size = bytes.len() as f64;
    size::check(MEMORY * size, || format!("a drawing of {}", error::bytes(size)))
        .map_err(|error| error.of_file(file))?;
    outline(&encoding::unicode(bytes), options)
        .map_err(|Fault { message, help }| Error::file(file, format!("{file}: {message}"), help))
}

/// What to do about a file that is no DXF text to its end.
const INCOMPLETE: &str = "is the file complete? copy it or save it as ASCII DXF once more";

fn outline(bytes: &[u8], options: &Options) -> Result<Outline, Fault> {
    let above_zero = |what, value: f64| match value.is_finite() && value > 0.0 {
        true => Ok(value),
        false => Err(Fault::new(
            format!("{what} is {value}, expected a number above 0"),
            "give a number above 0",
        )),
    };
    let tolerance = above_zero("the tolerance (m)", options.tolerance)?;
    let join = above_zero("the share of the size within which ends join", options.join)?;
    let drawing = drawing(bytes)?;
    let unit = match options.unit {
        Some(unit) => above_zero("the unit of the drawing (m)", unit)?,
        None => metres(drawing.header.default_drawing_units).ok_or_else(|| {
            Fault::new(
                "its header gives no unit of length ($INSUNITS)",
                "state the unit of the drawing, as in unit = \"mm\"",
            )
        })?,
    };
    check_layers(&drawing, options)?;

    let found = entity::curves(&drawing, unit, options)?;
    if found.curves.is_empty() {
        return Err(empty(options, &found.others.into_iter().collect::<Vec<_>>()));
    }
    let size = extent(found.curves.iter().flat_map(|curve| &curve.points));
    let mut all = chain::closed(found.curves, join * size[0].hypot(size[1]))?;

    // the largest first; of two that are as large, the first of the file
    all.sort_by(|a, b| area(&b.ring).total_cmp(&area(&a.ring)));
    let Some(outer) = all.first() else {
        return Err(empty(options, &[]));
    };
    let size = extent(&outer.ring);
    if size[0].max(size[1]) < SMALLEST * tolerance {
        let ([width, height], tolerance) = (size.map(|side| side * 1e3), tolerance * 1e3);
        return Err(Fault::new(
            format!(
                "its largest closed line, {}, is {width:.4} mm by {height:.4} mm, which is too small for a tolerance of {tolerance:.4} mm",
                outer.place
            ),
            "is the unit of the drawing right?",
        ));
    }
    if let Some(inner) = all[1..].iter().find(|inner| !inside(&outer.ring, inner.ring[0])) {
        let layers = layers(&all);
        return Err(Fault::new(
            format!(
                "it has two outlines: {} is not inside the largest closed line, {}",
                inner.place, outer.place
            ),
            match layers.len() {
                0 | 1 => "leave one ply in the drawing, or put each on a layer of its own".into(),
                _ => format!("choose a layer; those with closed lines are {}", listed(&layers)),
            },
        ));
    }
    let mut rings = all.into_iter().map(|closed| closed.ring);
    let boundary = rings.next().unwrap_or_default();
    Outline::new(boundary, rings.collect())
        .map_err(|fault| Fault::new(fault.to_string(), "correct the drawing"))
}

/// A drawing with nothing that could be an outline; `others` are the layers that have curves.
fn empty(options: &Options, others: &[String]) -> Fault {
    let wanted = match options.layers.as_deref() {
        None => "its visible layers".into(),
        Some([layer]) => format!("layer `{}`", layer.escape_debug()),
        Some(layers) => format!("layers {}", listed(layers)),
    };
    let help = match others {
        [] => "draw the outline with lines, arcs, circles, ellipses, polylines or splines".into(),
        others => format!("layers with lines or curves are {}", listed(others)),
    };
    Fault::new(format!("it has no lines or curves on {wanted}"), help)
}

/// What the library reads of a file.
fn drawing(bytes: &[u8]) -> Result<Drawing, Fault> {
    let unread =
        |what: String| Fault::new(format!("it is no complete DXF text: {what}"), INCOMPLETE);
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
            Some((line, code, found)) => pairs::not_a_value(line, &code, &found),
            None => unread(error.to_string()),
        }
    })?;
    let (found, expected) = (entity::count(&drawing), kept.entities);
    if found == expected {
        return Ok(drawing);
    }
    Err(unread(format!("{found} of its {expected} entities can be read")))
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
fn check_layers(drawing: &Drawing, options: &Options) -> Result<(), Fault> {
    let of_blocks = drawing.blocks().flat_map(|block| &block.entities);
    let used = drawing.entities().chain(of_blocks).map(|entity| entity.common.layer.as_str());
    let names = drawing.layers().map(|layer| layer.name.as_str()).chain(used);
    let known: BTreeSet<&str> = names.filter(|name| !name.is_empty()).collect();
    let keys: BTreeSet<String> = known.iter().map(|name| entity::key(name)).collect();
    let absent = |layer: &&String| !keys.contains(&entity::key(layer));
    match options.layers.iter().flatten().find(absent) {
        None => Ok(()),
        Some(layer) => Err(Fault::new(
            format!("there is no layer `{}`", layer.escape_debug()),
            format!("layers are {}", listed(&known.into_iter().collect::<Vec<_>>())),
        )),
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
