//! A ply as it is cut: its outline, the cups that hold it, and fabric coordinates along its yarns.
//!
//! A file has all of it in the coordinates of a drawing. Fabric coordinates run along the yarns, from the first cup that
//! holds: along the rows of the array where these lie along the yarns, else along the warp.

use super::check::{grid, missing};
use super::choice::{HoleChoice, OutlineChoice, Polygon, WarpChoice};
use super::file::{ArrayTable, CircleTable, PartlyKey, PlyTable};
use super::located::Located;
use super::quantity::{Read, read_or};
use super::source::Document;
use crate::Error;
use crate::read::outline::Drawn;
use crate::store::shown::millimeters;
use plydrape::LayupError;
use plydrape::ply::{Cut, Direction, Grid, GripperId, Held, Outline, Ply, Ring, gripper_name};
use std::f64::consts::{FRAC_PI_2, TAU};
use std::ops::Range;

/// Sides of the polygon that stands for a circle: it is a thousandth of the radius off at most.
const SIDES: usize = 72;
/// Directions that differ by less (rad) are the same: a millionth of a meter over a ply of a kilometer.
const SAME: f64 = 1e-9;
/// Most cups of a list.
const MOST_POINTS: usize = 10_000;

/// A ply that is cut, as far as its outline and its grippers say what it is.
pub(super) struct Shape {
    pub grid: Grid,
    pub cell: [f64; 2],
    pub warp: Direction,
    pub cut: Cut,
    pub array: Option<CupArray>,
    /// What was read of its drawing, if it has one.
    pub drawn: Option<Drawn>,
}

/// An array of cups over a ply that is cut.
#[derive(Debug, Clone, PartialEq)]
pub struct CupArray {
    /// How many cups it has.
    pub cups: usize,
    /// The cups that do not hold the ply, in the order of the array.
    pub left_off: Vec<IdleCup>,
    /// From the middle of the ply to that of the array, along the drawing's axes (m).
    pub off: [f64; 2],
}

/// A cup of an array that does not hold the ply.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IdleCup {
    /// Column and row in the array.
    pub id: GripperId,
    /// Middle in the drawing (m).
    pub drawn: [f64; 2],
    /// Why.
    pub why: LeftOff,
}

/// Why a cup of an array does not hold the ply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LeftOff {
    /// It is beside the boundary.
    Beside,
    /// It is over a hole.
    Hole,
    /// Pad, or the margin that it needs, is only partly on the ply.
    Partly,
    /// The key `holds` switches it off.
    Off,
}

/// A cup in the drawing.
#[derive(Clone, Copy)]
struct Cup {
    id: [usize; 2],
    place: [f64; 2],
}

impl Cup {
    fn idle(self, why: LeftOff) -> IdleCup {
        IdleCup { id: self.id, drawn: self.place, why }
    }

    /// Distance from a point of the drawing (m).
    fn distance(self, point: [f64; 2]) -> f64 {
        (self.place[0] - point[0]).hypot(self.place[1] - point[1])
    }
}

/// Whether the table says how the ply is cut.
pub(super) fn is_cut(table: &PlyTable) -> bool {
    table.outline.is_some()
        || table.size.is_some()
        || table.holes.is_some()
        || table.array.is_some()
        || table.points.is_some()
        || table.piece.is_some()
}

/// Angle from the warp to u (rad) where the scene gives the warp as an angle in the drawing, so that headings are those of the
/// warp; 0 where they are those of u.
pub(super) fn from_warp(table: &PlyTable, ply: &Ply, document: &Document) -> Result<f64, Error> {
    match (&ply.cut, &table.warp) {
        (Some(cut), Some(Located { value: WarpChoice::Angle(angle), span })) => {
            let warp = Located { value: angle.clone(), span: span.clone() };
            Ok(cut.angle - warp.read(document)?)
        }
        _ => Ok(0.0),
    }
}

/// Reads how a ply is cut and held; `radius` is that of the pads (m).
pub(super) fn shape(
    ply: &Located<PlyTable>,
    radius: f64,
    document: &Document,
) -> Result<Shape, Error> {
    let table = &ply.value;
    if let Some(overhang) = &table.overhang {
        return Err(document.error(
            overhang.span.clone(),
            "the ply has an outline and an `overhang`",
            "remove `overhang`: the outline says where the ply ends",
        ));
    }
    let (outline, drawn) = outline(ply, document)?;
    let warp = match &table.warp {
        None | Some(Located { value: WarpChoice::U, .. }) => 0.0,
        Some(Located { value: WarpChoice::V, .. }) => FRAC_PI_2,
        Some(Located { value: WarpChoice::Angle(angle), span }) => {
            Located { value: angle.clone(), span: span.clone() }.read(document)?
        }
    };
    let shape = match &table.points {
        Some(points) => listed(points, ply, &outline, warp, radius, document)?,
        None => array(ply, &outline, warp, radius, document)?,
    };
    Ok(Shape { drawn, ..shape })
}

/// The outline in the drawing, and what was read of that if it is a file.
fn outline(
    ply: &Located<PlyTable>,
    document: &Document,
) -> Result<(Outline, Option<Drawn>), Error> {
    let table = &ply.value;
    let drawn = super::dxf::drawn(table, document)?;

    // the boundary is of a file, of points or a rectangle; a file may bring holes
    let (boundary, mut holes, span) = match (&table.outline, &table.size) {
        (Some(outline), None) => {
            let span = outline.span.clone();
            match (&outline.value, &drawn) {
                (_, Some(Drawn { outline, .. })) => {
                    (outline.boundary().to_vec(), outline.holes().to_vec(), span)
                }
                (OutlineChoice::Points(points), None) => {
                    (polygon(points, document)?, Vec::new(), span)
                }
                (_, None) => (Vec::new(), Vec::new(), span),
            }
        }
        (None, Some(size)) => {
            let [a, b] = size.read(document)?;
            (vec![[0.0, 0.0], [a, 0.0], [a, b], [0.0, b]], Vec::new(), size.span.clone())
        }
        (Some(_), Some(size)) => {
            return Err(document.error(
                size.span.clone(),
                "the ply has an `outline` and a `size`",
                "keep one of them: `size` is a rectangle from the drawing's origin",
            ));
        }
        (None, None) => {
            let span = [
                table.holes.as_ref().map(|key| &key.span),
                table.array.as_ref().map(|key| &key.span),
                table.points.as_ref().map(|key| &key.span),
            ];
            let span = span.into_iter().flatten().next().unwrap_or(&ply.span);
            return Err(document.error(
                span.clone(),
                "the ply has no outline that this could belong to",
                "give its `outline`, as points or as a DXF file, or its `size`, as in size = [\"900 mm\", \"500 mm\"]",
            ));
        }
    };

    // holes of the scene come after those of the file, each with its place for messages
    let of_file = holes.len();
    let mut spans = vec![span.clone(); 1 + of_file];
    for hole in table.holes.iter().flat_map(|holes| &holes.value) {
        spans.push(hole.span.clone());
        holes.push(match &hole.value {
            HoleChoice::Points(points) => polygon(points, document)?,
            HoleChoice::Circle(circle) => disc(circle, document)?,
        });
    }

    // a fault of the outline is shown at the ring that has it
    let outline = Outline::new(boundary, holes).map_err(|error| {
        let ring = match error {
            LayupError::OutlineCrosses { a, b, .. } => a.max(b),
            LayupError::OutlineHoleOutside { ring, .. }
            | LayupError::OutlineTooFew { ring, .. }
            | LayupError::OutlineNotFinite { ring, .. }
            | LayupError::OutlineFlat { ring } => ring,
            _ => 0,
        };
        let help = match &error {
            LayupError::OutlineCrosses { .. } => {
                "give the points in order around the ply, each once; holes lie inside and apart"
            }
            LayupError::OutlineHoleOutside { .. } => {
                "holes lie inside the boundary, apart from each other"
            }
            _ => "give three or more points in order around the ply",
        };
        let span = spans.get(ring).unwrap_or(&span).clone();
        document.error(span, error.to_string(), help)
    })?;
    Ok((outline, drawn))
}

fn polygon(points: &Polygon, document: &Document) -> Result<Ring, Error> {
    points.iter().map(|point| point.read(document)).collect()
}

fn disc(circle: &CircleTable, document: &Document) -> Result<Ring, Error> {
    let [x, y] = circle.middle.read(document)?;
    let radius = 0.5 * circle.diameter.read(document)?;
    let point = |n: usize| {
        let (sin, cos) = (TAU * n as f64 / SIDES as f64).sin_cos();
        [x + radius * cos, y + radius * sin]
    };
    Ok((0..SIDES).map(point).collect())
}

/// The cups of an array that hold.
fn array(
    ply: &Located<PlyTable>,
    outline: &Outline,
    warp: f64,
    radius: f64,
    document: &Document,
) -> Result<Shape, Error> {
    let table = &ply.value;
    let Grid { nu, nv } = grid(ply, document)?;
    let Some(cell) = &table.cell else { return Err(missing("cell", ply, document)) };
    let cell = cell.read(document)?;
    let none = ArrayTable::default();
    let (keys, span) = match &table.array {
        Some(array) => (&array.value, &array.span),
        None => (&none, &ply.span),
    };
    let direction = read_or(&keys.direction, 0.0, document)?;
    let [low, high] = outline.bounds();
    let middle = read_or(&keys.middle, [0, 1].map(|n| 0.5 * (low[n] + high[n])), document)?;
    let margin = read_or(&keys.margin, 0.0, document)?;
    let (sin, cos) = direction.sin_cos();
    let cup = |index: usize| {
        let id = [index % nu, index / nu];
        let off = [(0, nu), (1, nv)]
            .map(|(n, count)| cell[n] * (id[n] as f64 - 0.5 * (count - 1) as f64));
        let place =
            [middle[0] + cos * off[0] - sin * off[1], middle[1] + sin * off[0] + cos * off[1]];
        Cup { id, place }
    };
    let rows = keys.holds.as_ref().map(|rows| mask(rows, [nu, nv], document)).transpose()?;
    let (mut cups, mut left_off) = (Vec::new(), Vec::new());
    let bare = Outline::new(outline.boundary().to_vec(), Vec::new());
    let is_over_hole = |place: [f64; 2]| bare.as_ref().is_ok_and(|whole| whole.contains(place));
    for cup in (0..nu * nv).map(cup) {
        let depth = outline.depth(cup.place);
        let holds = rows.as_ref().map(|rows| rows[cup.id[1]][cup.id[0]]);
        let rounding = 1e-9 * (high[0] - low[0]).max(high[1] - low[1]);
        if holds == Some(false) {
            left_off.push(cup.idle(LeftOff::Off));
            continue;
        }
        if depth >= radius + margin - rounding {
            cups.push(cup);
            continue;
        }
        let leave = keys.partly == Some(PartlyKey::LeaveOff);
        // a cup beside the ply holds nothing; one that the scene names shall hold
        if holds.is_none() && (leave || depth <= -radius) {
            let why = match () {
                () if depth > -radius => LeftOff::Partly,
                () if is_over_hole(cup.place) => LeftOff::Hole,
                () => LeftOff::Beside,
            };
            left_off.push(cup.idle(why));
            continue;
        }
        let [x, y] = cup.place.map(millimeters);
        let off = if depth < 0.0 { "beyond" } else { "inside" };
        let place = keys.holds.as_ref().map_or(span, |rows| &rows.span);
        return Err(document.error(
            place.clone(),
            format!(
                "the cup {} at ({x}, {y}) mm of the drawing is {} mm {off} the boundary, and needs {} mm of ply around its middle",
                gripper_name(cup.id),
                millimeters(depth.abs()), millimeters(radius + margin)
            ),
            "move the array, give it another pitch or a smaller `margin`, or write partly = \"leave-off\" in `array`: such cups then do not hold",
        ));
    }
    if cups.len() < 2 {
        return Err(document.error(
            span.clone(),
            format!("{} of the {} cups of the array hold the ply", cups.len(), nu * nv),
            format!(
                "two or more must: move the array over the ply, or give it a closer pitch; the ply is {} × {} mm large: is its unit right?",
                millimeters(high[0] - low[0]), millimeters(high[1] - low[1])
            ),
        ));
    }
    // rows along the warp or across it
    let turn = (direction - warp).rem_euclid(FRAC_PI_2);
    let is_along = turn.min(FRAC_PI_2 - turn) <= SAME;
    let (angle, turn, warp_of) = if is_along {
        let quarter = ((direction - warp) / FRAC_PI_2).round() as i64;
        let warp = if quarter % 2 == 0 { Direction::U } else { Direction::V };
        (direction, 0.0, warp)
    } else {
        (warp, direction - warp, Direction::U)
    };
    let whole = cups.len() == nu * nv && is_along;
    let grid = if whole { Grid { nu, nv } } else { Grid::NONE };
    let off = [0, 1].map(|n| middle[n] - 0.5 * (low[n] + high[n]));
    let array = CupArray { cups: nu * nv, left_off, off };
    let shape = shaped(outline, &cups, [angle, turn], grid, cell, warp_of);
    Ok(Shape { array: Some(array), ..shape })
}

/// Which cups of an array hold, row by row.
fn mask(
    rows: &Located<Vec<Located<String>>>,
    [nu, nv]: [usize; 2],
    document: &Document,
) -> Result<Vec<Vec<bool>>, Error> {
    let help = format!(
        "give a text for each of the {nv} rows along v, the first first, each with {nu} signs: \"#\" holds, \".\" does not"
    );
    if rows.value.len() != nv {
        let message = format!("`holds` has {} rows, and the array {nv}", rows.value.len());
        return Err(document.error(rows.span.clone(), message, help));
    }
    let row = |row: &Located<String>| {
        let signs = row.value.chars().map(|sign| match sign {
            '#' => Some(true),
            '.' => Some(false),
            _ => None,
        });
        let signs: Option<Vec<bool>> = signs.collect();
        signs.filter(|signs| signs.len() == nu).ok_or_else(|| {
            let message = format!("{} is no row of {nu} cups", document.quoted(&row.span));
            document.error(row.span.clone(), message, help.clone())
        })
    };
    rows.value.iter().map(row).collect()
}

/// Cups at points of the drawing.
fn listed(
    points: &Located<Polygon>,
    ply: &Located<PlyTable>,
    outline: &Outline,
    warp: f64,
    radius: f64,
    document: &Document,
) -> Result<Shape, Error> {
    let table = &ply.value;
    let other: [(&str, Option<&Range<usize>>); 3] = [
        ("grippers", table.grippers.as_ref().map(|key| &key.span)),
        ("cell", table.cell.as_ref().map(|cell| &cell.0[0].span)),
        ("array", table.array.as_ref().map(|key| &key.span)),
    ];
    if let Some((key, span)) = other.into_iter().find_map(|(key, span)| Some((key, span?))) {
        return Err(document.error(
            span.clone(),
            format!("the cups are given twice: by `points` and by `{key}`"),
            format!("remove `{key}`: points say all, or remove `points`"),
        ));
    }
    let count = points.value.len();
    if !(2..=MOST_POINTS).contains(&count) {
        return Err(document.error(
            points.span.clone(),
            format!("there cannot be {count} cups"),
            format!("give 2 to {MOST_POINTS} points"),
        ));
    }
    let mut cups: Vec<Cup> = Vec::with_capacity(count);
    for (n, point) in points.value.iter().enumerate() {
        let place = point.read(document)?;
        let depth = outline.depth(place);
        if depth < radius * (1.0 - 1e-9) {
            let off = if depth < 0.0 { "beyond" } else { "inside" };
            return Err(document.error(
                point.span.clone(),
                format!(
                    "cup {n} is {} mm {off} the boundary of the ply, and its pad has a radius of {} mm",
                    millimeters(depth.abs()), millimeters(radius)
                ),
                "move it onto the ply",
            ));
        }
        let least = (2.0 * radius).max(f64::MIN_POSITIVE);
        if let Some(cup) = cups.iter().find(|cup| cup.distance(place) < least) {
            return Err(document.error(
                point.span.clone(),
                format!(
                    "cups {} and {n} are {} mm apart",
                    cup.id[0],
                    millimeters(cup.distance(place))
                ),
                "give every cup a place of its own, farther apart than a pad is wide",
            ));
        }
        cups.push(Cup { id: [n, 0], place });
    }
    // the distance of neighbors, for what is measured in cells
    let nearest = |cup: &Cup| {
        let others = cups.iter().filter(|other| other.id != cup.id);
        others.map(|other| cup.distance(other.place)).fold(f64::INFINITY, f64::min)
    };
    let mut distances: Vec<f64> = cups.iter().map(nearest).collect();
    distances.sort_by(f64::total_cmp);
    let cell = [distances[distances.len() / 2]; 2];
    Ok(shaped(outline, &cups, [warp, 0.0], Grid::NONE, cell, Direction::U))
}

/// The shape whose u runs at `angle` (rad) in the drawing, from the first cup.
fn shaped(
    outline: &Outline,
    cups: &[Cup],
    [angle, turn]: [f64; 2],
    grid: Grid,
    cell: [f64; 2],
    warp: Direction,
) -> Shape {
    let origin = cups[0].place;
    let mut cut = Cut { outline: outline.clone(), held: Vec::new(), angle, turn, origin };
    cut.outline = outline.moved(|point| cut.fabric(point));
    if grid == Grid::NONE {
        let held = |cup: &Cup| Held { id: cup.id, place: cut.fabric(cup.place) };
        cut.held = cups.iter().map(held).collect();
    }
    Shape { grid, cell, warp, cut, array: None, drawn: None }
}
