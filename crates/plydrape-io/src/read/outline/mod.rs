//! A ply's outline from a drawing: ASCII DXF, of any version, to a boundary and its holes.
//!
//! 1. `pairs`: what is no part of an outline is left out of the text, then the library reads it;
//! 2. `entity`: lines, arcs, circles, ellipses, polylines with bulges, splines and blocks of the layers that are read become
//!    polygons that stay within a tolerance of them (`flatten`);
//! 3. `chain`: polygons are joined end to end into closed lines, over small gaps too;
//! 4. `piece`: the largest of these is the boundary, and those inside it are holes; of several pieces one is chosen.

mod chain;
mod entity;
mod flatten;
mod pairs;
mod piece;
mod place;
#[cfg(test)]
mod tests;
mod transform;

use crate::Error;
use crate::error::{self, Fault};
use crate::store::{encoding, input, size};
use ::dxf::{Drawing, DxfError, enums::Units};
use chain::{Chained, Closed, Reach};
use entity::{Curve, Curves, Placed};
use piece::Nest;
pub use piece::Piece;
use place::{listed, toml};
use plydrape::ply::{Outline, Ring};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Ends of curves that are this close are the same, as a share of the size of all curves: 10 µm of a meter.
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
    /// Largest distance of the outline from curves of the drawing, and widest gap between ends that join (m).
    pub tolerance: f64,
    /// Distance of ends that are the same, as a share of the size of all curves; see [`JOIN`].
    pub join: f64,
    /// Which piece is the ply, where the drawing has several.
    pub piece: Option<Piece>,
}

impl Options {
    /// All visible layers, with the unit of the header, followed to a tolerance (m).
    #[must_use]
    pub fn new(tolerance: f64) -> Self {
        Options { layers: None, unit: None, tolerance, join: JOIN, piece: None }
    }
}

/// What was read of a drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Drawn {
    /// The outline in the coordinates of the drawing (m).
    pub outline: Outline,
    /// Where the boundary is from.
    pub boundary: Source,
    /// Where the holes of the outline are from, one for each.
    pub holes: Vec<Source>,
    /// Widths of the gaps between ends that were joined (m), the widest first.
    pub gaps: Vec<f64>,
    /// Closed lines of other blocks within the boundary, which are no holes of the block that is chosen.
    pub others: usize,
    /// How many entities of each type are no curves, on the layers that were read.
    pub skipped: BTreeMap<String, usize>,
}

/// Where a closed line of a drawing is from.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// Layers, one unless its curves are on several.
    pub layers: Vec<String>,
    /// The outermost block that it is of, if any.
    pub block: Option<String>,
}

impl Source {
    fn new(line: &Closed) -> Self {
        Source {
            layers: line.layers.iter().cloned().collect(),
            block: line.placed.blocks.first().map(ToString::to_string),
        }
    }
}

/// The outline in a DXF file.
///
/// # Errors
/// As [`read_dxf`], or if the file cannot be read.
pub fn read(path: &Path, options: &Options) -> Result<Drawn, Error> {
    let bytes = input::bytes(path, LARGEST).map_err(|source| Error::read(path, source))?;
    read_dxf(&path.display().to_string(), &bytes, options)
}

/// The outline in the bytes of a DXF file.
///
/// # Errors
/// [`Error::File`] for what is no DXF text or no outline, or has several of them: it says where, and has a remedy.
pub fn read_dxf(file: &str, bytes: &[u8], options: &Options) -> Result<Drawn, Error> {
    let size = bytes.len() as f64;
    size::check(MEMORY * size, || format!("a drawing of {}", error::bytes(size)))
        .map_err(|error| error.of_file(file))?;
    drawn(file, &encoding::unicode(bytes), options)
        .map_err(|Fault { message, help }| Error::file(file, format!("{file}: {message}"), help))
}

/// What to do about a file that is no DXF text to its end.
const INCOMPLETE: &str = "is the file complete? copy it or save it as ASCII DXF once more";

fn drawn(file: &str, bytes: &[u8], options: &Options) -> Result<Drawn, Fault> {
    // the text becomes a drawing with a unit
    let above_zero = |what, value: f64| match value.is_finite() && value > 0.0 {
        true => Ok(value),
        false => Err(Fault::new(
            format!("{what} is {value}, expected a number above 0"),
            "give a number above 0",
        )),
    };
    let tolerance = above_zero("the tolerance (m)", options.tolerance)?;
    let join = above_zero("the share of the size within which ends join", options.join)?;
    let (drawing, skipped) = drawing(bytes)?;
    let unit = match options.unit {
        Some(unit) => above_zero("the unit of the drawing (m)", unit)?,
        None => meters(drawing.header.default_drawing_units).ok_or_else(|| {
            Fault::new(
                "its header gives no unit of length ($INSUNITS)",
                "state the unit of the drawing, as in unit = \"mm\"",
            )
        })?,
    };
    check_layers(&drawing, options)?;

    // the curves of the layers that are read, and of the block that is chosen
    let Curves { mut curves, others, texts, meshes } = entity::curves(&drawing, unit, options)?;
    let mut skipped = skipped_on(&drawing, skipped, options);
    if meshes > 0 {
        skipped.insert("POLYLINE that is a mesh".into(), meshes);
    }
    if curves.is_empty() {
        return Err(empty(options, &others.into_iter().collect::<Vec<_>>(), &skipped));
    }
    if let Some(Piece::Block(block)) = &options.piece {
        let blocks: BTreeSet<String> =
            curves.iter().flat_map(|c| &c.placed.blocks).map(ToString::to_string).collect();
        curves.retain(|curve| curve.placed.is_of(block));
        if curves.is_empty() {
            return Err(no_block(block, &blocks));
        }
    }
    // curves become closed lines; what stays open is a fault unless another piece is chosen
    let size = extent(curves.iter().flat_map(|curve| &curve.points));
    let size = size[0].hypot(size[1]);
    let reach = Reach { join: join * size, gap: tolerance };
    let by_layer = layers_that_close(&curves, reach, options);
    let chained = chained(curves, reach);
    let fault_of = |open: &chain::Open| {
        let mut fault = chained.fault(open, reach, file, size);
        if let Some(layer) = &by_layer {
            let (file, layer) = (toml(file), toml(layer));
            fault.help += &format!(
                "; the lines of one layer all close: outline = {{ file = {file}, layers = [{layer}] }}"
            );
        }
        fault
    };
    if let (None, Some(first)) = (&options.piece, chained.open.first()) {
        return Err(fault_of(first));
    }

    // closed lines become pieces with holes, of which one is the ply
    let nest = Nest::new(chained.closed.clone());
    let Some(outer) = nest.lines().first() else {
        return Err(match chained.open.first() {
            Some(first) => fault_of(first),
            None => empty(options, &[], &skipped),
        });
    };
    check_size(outer, tolerance)?;
    let check_layers = |lines: &[&Closed]| match &options.layers {
        None => piece::check_layers(lines, file),
        Some(_) => Ok(()),
    };
    if options.piece.is_none() {
        let lines: Vec<&Closed> = nest.lines().iter().collect();
        check_layers(&lines)?;
        check_twice(&lines)?;
    }
    let chosen = nest.chosen(options.piece.as_ref(), &texts)?;
    let boundary = &nest.lines()[chosen.boundary];
    let holes: Vec<&Closed> = chosen.holes.iter().map(|n| &nest.lines()[*n]).collect();
    let all: Vec<&Closed> = std::iter::once(boundary).chain(holes.iter().copied()).collect();
    check_layers(&all)?;
    check_twice(&all)?;
    // what is open elsewhere belongs to other pieces
    let is_within = |open: &&chain::Open| {
        matches!(options.piece, Some(Piece::Block(_))) || inside(&boundary.ring, open.place.at)
    };
    if let Some(first) = chained.open.iter().find(is_within) {
        return Err(fault_of(first));
    }

    // the outline, and what was found on the way to it
    let mut gaps: Vec<f64> = all.iter().flat_map(|line| line.gaps.iter().copied()).collect();
    gaps.sort_by(|a, b| b.total_cmp(a));
    let rings = holes.iter().map(|hole| hole.ring.clone()).collect();
    let outline = Outline::new(boundary.ring.clone(), rings)
        .map_err(|fault| Fault::new(fault.to_string(), "correct the drawing"))?;
    Ok(Drawn {
        outline,
        boundary: Source::new(boundary),
        holes: holes.into_iter().map(Source::new).collect(),
        gaps,
        others: chosen.others,
        skipped,
    })
}

/// Curves that are joined: all together, or if some of them do not close, those of each place of a block by themselves.
fn chained(curves: Vec<Curve>, reach: Reach) -> Chained {
    let mut places: Vec<&Placed> = curves.iter().map(|curve| &curve.placed).collect();
    places.sort();
    places.dedup_by_key(|placed| placed.number);
    let numbers: Vec<usize> = places.into_iter().map(|placed| placed.number).collect();
    let together = chain::closed(curves.clone(), reach);
    if together.open.is_empty() || numbers.len() == 1 {
        return together;
    }
    let mut parted: Vec<Vec<Curve>> = vec![Vec::new(); numbers.len()];
    for curve in curves {
        if let Ok(n) = numbers.binary_search(&curve.placed.number) {
            parted[n].push(curve);
        }
    }
    let mut each = Chained::default();
    for curves in parted {
        let Chained { closed, open } = chain::closed(curves, reach);
        each.closed.extend(closed);
        each.open.extend(open);
    }
    if each.open.len() < together.open.len() { each } else { together }
}

/// The layer whose lines all close, where no layer is named and there is one alone.
fn layers_that_close(curves: &[Curve], reach: Reach, options: &Options) -> Option<String> {
    if options.layers.is_some() {
        return None;
    }
    let layers: BTreeSet<&str> = curves.iter().map(|curve| curve.layer.as_str()).collect();
    if layers.len() == 1 {
        return None;
    }
    let closes = |layer: &&&str| {
        let of_it = curves.iter().filter(|curve| curve.layer == ***layer).cloned().collect();
        let Chained { closed, open } = chained(of_it, reach);
        open.is_empty() && !closed.is_empty()
    };
    let mut found = layers.iter().filter(closes);
    let first = found.next()?;
    found.next().is_none().then(|| (*first).to_owned())
}

/// Refuses a drawing whose largest closed line is no larger than a few tolerances (m).
fn check_size(outer: &Closed, tolerance: f64) -> Result<(), Fault> {
    let size = extent(&outer.ring);
    if size[0].max(size[1]) >= SMALLEST * tolerance {
        return Ok(());
    }
    let ([width, height], tolerance) = (size.map(|side| side * 1e3), tolerance * 1e3);
    Err(Fault::new(
        format!(
            "its largest closed line, {}, is {width:.4} mm by {height:.4} mm, which is too small for a tolerance of {tolerance:.4} mm",
            outer.place
        ),
        "is the unit of the drawing right?",
    ))
}

/// Refuses closed lines that are drawn twice: the one would be a hole as large as the other. The largest are first.
fn check_twice(all: &[&Closed]) -> Result<(), Fault> {
    let drawn_together = |pair: &&[&Closed]| pair[0].placed.number == pair[1].placed.number;
    for pair in all.windows(2).filter(drawn_together) {
        let [a, b] = [&pair[0].ring, &pair[1].ring].map(bounds);
        let size = (a[1][0] - a[0][0]).hypot(a[1][1] - a[0][1]);
        let same = a
            .as_flattened()
            .iter()
            .zip(b.as_flattened())
            .all(|(p, q)| (p - q).abs() <= JOIN * size);
        if same && area(&pair[0].ring) - area(&pair[1].ring) <= JOIN * size * size {
            return Err(Fault::new(
                format!("a closed line is drawn twice: {} and {}", pair[0].place, pair[1].place),
                "remove one of the two in the drawing, or choose the layer that has the outline alone",
            ));
        }
    }
    Ok(())
}

/// No curve is of a block that is chosen.
fn no_block(block: &str, blocks: &BTreeSet<String>) -> Fault {
    let help = match blocks.is_empty() {
        true => {
            "choose the piece by a point in it, as in piece = { point = [\"120 mm\", \"80 mm\"] }"
                .into()
        }
        false => format!(
            "blocks with lines or curves are {}",
            listed(&blocks.iter().collect::<Vec<_>>())
        ),
    };
    Fault::new(format!("it places no block {} with lines or curves", toml(block)), help)
}

/// How many entities of each type are no curves, on the layers that are read.
fn skipped_on(
    drawing: &Drawing,
    all: BTreeMap<[String; 2], usize>,
    options: &Options,
) -> BTreeMap<String, usize> {
    let is_read = |layer: &str| match &options.layers {
        // on layer 0 of a block they may be on any layer
        _ if layer == "0" => true,
        Some(layers) => layers.iter().any(|name| entity::key(name) == entity::key(layer)),
        None => !drawing
            .layers()
            .any(|known| !known.is_layer_on && entity::key(&known.name) == entity::key(layer)),
    };
    let mut skipped = BTreeMap::new();
    for ([kind, layer], count) in all {
        if is_read(&layer) {
            *skipped.entry(kind).or_default() += count;
        }
    }
    skipped
}

/// A drawing with nothing that could be an outline; `others` are the layers that have curves.
fn empty(options: &Options, others: &[String], skipped: &BTreeMap<String, usize>) -> Fault {
    let read = match options.layers.as_deref() {
        None => "its visible layers".into(),
        Some([layer]) => format!("layer `{}`", layer.escape_debug()),
        Some(layers) => format!("layers {}", listed(layers)),
    };
    let help = match others {
        [] => "draw the outline with lines, arcs, circles, ellipses, polylines or splines".into(),
        others => format!("layers with lines or curves are {}", listed(others)),
    };
    let skipped: Vec<String> =
        skipped.iter().map(|(kind, count)| format!("{count} {kind}")).collect();
    let instead = match skipped.is_empty() {
        true => String::new(),
        false => format!(", and {} that no outline is made of", skipped.join(", ")),
    };
    Fault::new(format!("it has no lines or curves on {read}{instead}"), help)
}

/// What the library reads of a file, and how many entities of each type and layer are no curves.
fn drawing(bytes: &[u8]) -> Result<(Drawing, BTreeMap<[String; 2], usize>), Fault> {
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
        return Ok((drawing, kept.skipped));
    }
    Err(unread(format!("{found} of its {expected} entities can be read")))
}

/// A unit of a drawing (m); `None` if it has none.
fn meters(units: Units) -> Option<f64> {
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

/// Lowest and highest x and y of points (m).
fn bounds<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>) -> [[f64; 2]; 2] {
    let mut bounds = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    for point in points {
        for n in 0..2 {
            bounds[0][n] = bounds[0][n].min(point[n]);
            bounds[1][n] = bounds[1][n].max(point[n]);
        }
    }
    bounds
}

/// Size of points along x and y (m).
fn extent<'a>(points: impl IntoIterator<Item = &'a [f64; 2]>) -> [f64; 2] {
    let [low, high] = bounds(points);
    [0, 1].map(|n| high[n] - low[n])
}

/// The lines of a ring.
fn lines(ring: &Ring) -> impl Iterator<Item = [[f64; 2]; 2]> + '_ {
    ring.iter().enumerate().map(|(n, point)| [*point, ring[(n + 1) % ring.len()]])
}

/// Area of a closed line (m²), whatever its sense.
fn area(ring: &Ring) -> f64 {
    let origin = ring[0];
    let from_origin = |p: [f64; 2]| [p[0] - origin[0], p[1] - origin[1]];
    let twice = lines(ring).map(|[a, b]| {
        let (a, b) = (from_origin(a), from_origin(b));
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
