//! The curves of a drawing: its entities, blocks placed, as polygons in meters.

use super::Options;
use super::flatten::{self, Arc, Limit, Nurbs, TooMany};
use super::place::EntityPlace;
use super::transform::Transform;
use crate::error::Fault;
use ::dxf::Drawing;
use ::dxf::entities::{Entity, EntityType, Insert, Polyline, Spline};
use ::dxf::{Point, Vector};
use std::collections::{BTreeSet, HashMap};
use std::rc::Rc;

/// Most points of all curves: crossings of all lines are sought.
pub const MOST_POINTS: usize = 50_000;
/// Most blocks within one another.
const MOST_DEPTH: usize = 16;
/// Most entities that are looked at, those of blocks each time they are placed.
const MOST_ENTITIES: usize = 2_000_000;
/// A curve is flat if its z varies by no more than this share of its coordinates; an arc closed if it lacks no larger share.
const ROUNDING: f64 = 1e-6;

/// A curve as a polygon.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Points (m); of a closed one the first is not repeated.
    pub points: Vec<[f64; 2]>,
    /// Whether its end is its beginning.
    pub closed: bool,
    /// Type, as DXF names it.
    pub entity: &'static str,
    /// Layer.
    pub layer: String,
    /// The block that it is of.
    pub placed: Placed,
}

/// A block that a drawing places, and which of its places that is.
#[derive(Debug, Clone, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Placed {
    /// Counts the places of blocks in the drawing from 1; 0 is what is in no block.
    pub number: usize,
    /// The block, and those within it, from the outermost.
    pub blocks: Vec<Rc<str>>,
}

impl Placed {
    /// Whether it is of a block, or of a block in that.
    pub fn is_of(&self, block: &str) -> bool {
        self.blocks.iter().any(|name| key(name) == key(block))
    }
}

/// A text.
#[derive(Debug, Clone)]
pub struct Text {
    /// What it says, line by line.
    pub lines: Vec<String>,
    /// Where it is (m).
    pub at: [f64; 2],
    /// The block that it is of.
    pub placed: Placed,
}

impl Curve {
    /// A point of it, for messages.
    pub fn place(&self, at: [f64; 2]) -> EntityPlace {
        EntityPlace { entity: self.entity, layer: self.layer.clone(), at }
    }
}

/// The curves of the layers that are read, and of the other layers their names alone.
pub struct Curves {
    /// The curves of the layers that are read.
    pub curves: Vec<Curve>,
    /// Layers of the others.
    pub others: BTreeSet<String>,
    /// The texts of all layers.
    pub texts: Vec<Text>,
    /// Meshes that are written as polylines, on the layers that are read.
    pub meshes: usize,
}

/// All curves of a drawing; a unit of the drawing in meters.
pub fn curves(drawing: &Drawing, unit: f64, options: &Options) -> Result<Curves, Fault> {
    let hidden = drawing.layers().filter(|layer| !layer.is_layer_on);
    let mut reader = Reader {
        blocks: drawing.blocks().map(|block| (key(&block.name), block)).collect(),
        layers: options.layers.as_ref().map(|names| names.iter().map(|n| key(n)).collect()),
        hidden: hidden.map(|layer| key(&layer.name)).collect(),
        tolerance: options.tolerance,
        points: 0,
        visited: 0,
        places: 0,
        placed: Placed::default(),
        last_placed: Placed::default(),
        found: Curves { curves: Vec::new(), others: BTreeSet::new(), texts: Vec::new(), meshes: 0 },
    };
    for entity in drawing.entities().filter(|entity| !entity.common.is_in_paper_space) {
        reader.read(entity, None, &Transform::scale(unit), 0)?;
    }
    Ok(reader.found)
}

/// How many entities and vertices of polylines the library has read.
pub fn count(drawing: &Drawing) -> usize {
    let of_blocks = drawing.blocks().flat_map(|block| &block.entities);
    let count = |entity: &Entity| match &entity.specific {
        EntityType::Polyline(line) => 1 + line.vertices().count(),
        EntityType::Seqend(_) => 0,
        _ => 1,
    };
    drawing.entities().chain(of_blocks).map(count).sum()
}

/// Names of layers and blocks differ in more than small and capital letters.
pub fn key(name: &str) -> String {
    name.to_uppercase()
}

struct Reader<'a> {
    blocks: HashMap<String, &'a ::dxf::Block>,
    layers: Option<BTreeSet<String>>,
    hidden: BTreeSet<String>,
    tolerance: f64,
    points: usize,
    visited: usize,
    /// How many blocks the drawing has placed so far.
    places: usize,
    /// The block that is read.
    placed: Placed,
    /// The block that was placed last, which the attributes behind it are of.
    last_placed: Placed,
    found: Curves,
}

/// A polygon before it is placed, in units of the drawing.
struct Flat {
    points: Vec<[f64; 2]>,
    closed: bool,
}

impl Reader<'_> {
    /// Adds the curves of an entity; on layer 0 of a block it is on the layer that the block is placed on.
    fn read(
        &mut self,
        entity: &Entity,
        placed_on: Option<&str>,
        outer: &Transform,
        depth: usize,
    ) -> Result<(), Fault> {
        // what is drawn on layer 0 of a block belongs to the layer of the block
        let layer = match (placed_on, entity.common.layer.as_str()) {
            (Some(layer), "0") => layer,
            (_, layer) => layer,
        };

        // text is no curve; it is kept with its block, an attribute with the block placed last
        self.visited += 1;
        if let EntityType::Text(text) = &entity.specific {
            let mirror = mirrored(&text.normal) == Some(true);
            let own = if mirror { Transform::mirror() } else { Transform::scale(1.0) };
            let at = outer.after(&own).apply(plane(&text.location));
            let lines = plain(&text.value);
            if !lines.is_empty() && at.iter().all(|c| c.is_finite()) {
                let is_beside = depth == 0 && text.text_style_name == "ATTRIB";
                let placed = if is_beside { &self.last_placed } else { &self.placed };
                self.found.texts.push(Text { lines, at, placed: placed.clone() });
            }
            return Ok(());
        }

        // other entities that are no curves are left out; meshes are reported
        let Some((kind, origin, normal)) = classify(&entity.specific) else {
            let mesh = matches!(&entity.specific, EntityType::Polyline(_));
            self.found.meshes += usize::from(mesh && self.is_read(layer, entity));
            return Ok(());
        };

        // messages name the entity by its layer and its coordinates in the drawing
        let z_unit = flatten::stretch(outer.x, outer.y);
        let place = EntityPlace {
            entity: kind,
            layer: layer.to_owned(),
            at: outer.apply([origin.x, origin.y]),
        };

        // nested blocks could multiply entities without end
        if self.visited > MOST_ENTITIES {
            return Err(too_many_in_blocks(&place, MOST_ENTITIES, "entities in blocks"));
        }

        // a placed block is read entity by entity
        if let EntityType::Insert(insert) = &entity.specific {
            return self.place(insert, layer, &place, outer, depth);
        }

        // curves on other layers than those to be read are left out, and messages name these layers
        if !self.is_read(layer, entity) {
            self.found.others.insert(layer.to_owned());
            return Ok(());
        }

        // a curve may be seen from behind, but not lie in a plane that is inclined to the drawing
        let mirrored = mirrored(normal).ok_or_else(|| tilted(&place))?;

        let not_finite = || {
            let layer = layer.escape_debug();
            let message =
                format!("{kind} on layer `{layer}` has a coordinate that is no finite number");
            Fault::new(message, "correct the drawing")
        };

        // some entities have coordinates of their own plane, which is mirrored if seen from behind
        let transform = if mirrored && in_own_plane(&entity.specific) {
            outer.after(&Transform::mirror())
        } else {
            *outer
        };

        // the tolerance in units of the entity, and how many points the drawing may still have
        let room = MOST_POINTS - self.points;
        let limit = Limit {
            tolerance: self.tolerance / flatten::stretch(transform.x, transform.y),
            points: room,
        };
        let tolerance = self.tolerance;

        let too_many = |TooMany| {
            let message = format!(
                "followed to {:.3} mm, its curves have more than {MOST_POINTS} points; the last is {place}",
                tolerance * 1e3
            );
            Fault::new(message, "give a larger tolerance")
        };

        // what has no finite place or is not flat has no outline
        if !place.at.iter().all(|c| c.is_finite()) {
            return Err(not_finite());
        }
        if let Some(z) = heights(&entity.specific) {
            let [low, high] = z.map(|z| z * z_unit * 1e3);
            let message = format!("{place} is not flat: its z goes from {low:.3} to {high:.3} mm");
            return Err(Fault::new(message, FLAT));
        }

        // the curve as a polygon, in units of the entity
        let flat = match &entity.specific {
            EntityType::Line(line) => {
                Flat { points: vec![plane(&line.p1), plane(&line.p2)], closed: false }
            }
            EntityType::Circle(circle) => {
                arc(&circle.center, circle.radius, 0.0, 360.0, limit).map_err(too_many)?
            }
            EntityType::Arc(a) => {
                let sweep = (a.end_angle - a.start_angle).rem_euclid(360.0);
                arc(&a.center, a.radius, a.start_angle, sweep, limit).map_err(too_many)?
            }
            EntityType::Ellipse(ellipse) => {
                let p = [ellipse.major_axis.x, ellipse.major_axis.y];
                let ratio =
                    if mirrored { -ellipse.minor_axis_ratio } else { ellipse.minor_axis_ratio };
                let start = ellipse.start_parameter;
                let arc = Arc {
                    center: plane(&ellipse.center),
                    p,
                    q: [-ratio * p[1], ratio * p[0]],
                    start,
                    sweep: (ellipse.end_parameter - start).rem_euclid(std::f64::consts::TAU),
                };
                closed_if_whole(arc, limit).map_err(too_many)?
            }
            EntityType::LwPolyline(line) => {
                let vertices = line.vertices.iter().map(|v| ([v.x, v.y], v.bulge));
                polyline(vertices.collect(), line.is_closed(), limit).map_err(too_many)?
            }
            EntityType::Polyline(line) => {
                let on_it = line.vertices().filter(|v| !v.is_spline_frame_control_point());
                let bulge = |bulge: f64| if line.is_3d_polyline() { 0.0 } else { bulge };
                let vertices = on_it.map(|v| (plane(&v.location), bulge(v.bulge)));
                polyline(vertices.collect(), line.is_closed(), limit).map_err(too_many)?
            }
            EntityType::Spline(spline) => {
                let points = nurbs(spline, &place)?.flatten(limit).map_err(too_many)?;
                Flat { points, closed: false }
            }
            _ => return Ok(()),
        };

        // the polygon in units of the drawing; a large scale may make its numbers infinite
        if flat.points.len() > room {
            return Err(too_many(TooMany));
        }
        let points: Vec<[f64; 2]> = flat.points.iter().map(|p| transform.apply(*p)).collect();
        if !points.iter().flatten().all(|c| c.is_finite()) {
            return Err(not_finite());
        }
        if points.is_empty() {
            return Ok(());
        }
        self.points += points.len();
        self.found.curves.push(Curve {
            points,
            closed: flat.closed,
            entity: kind,
            layer: layer.to_owned(),
            placed: self.placed.clone(),
        });
        Ok(())
    }

    /// Whether an entity is to be read: its layer is named, or none is and it is visible.
    fn is_read(&self, layer: &str, entity: &Entity) -> bool {
        let name = key(layer);
        match &self.layers {
            Some(layers) => layers.contains(&name),
            None => !self.hidden.contains(&name) && entity.common.is_visible,
        }
    }

    /// Adds the curves of a block where it is placed, in rows and columns.
    fn place(
        &mut self,
        insert: &Insert,
        layer: &str,
        place: &EntityPlace,
        outer: &Transform,
        depth: usize,
    ) -> Result<(), Fault> {
        let Some(block) = self.blocks.get(&key(&insert.name)).copied() else {
            let name = insert.name.escape_debug();
            let message = format!("{place} places the block `{name}`, which is not in the file");
            return Err(Fault::new(message, EXPLODE));
        };
        if depth == MOST_DEPTH {
            return Err(too_many_in_blocks(place, MOST_DEPTH, "blocks within one another"));
        }
        let mirrored = mirrored(&insert.extrusion_direction).ok_or_else(|| tilted(place))?;
        let outer = if mirrored { outer.after(&Transform::mirror()) } else { *outer };
        let outer = outer
            .after(&Transform::shift(plane(&insert.location)))
            .after(&Transform::turn(insert.rotation.to_radians()));
        let base = [-block.base_point.x, -block.base_point.y];
        let scale = Transform {
            x: [insert.x_scale_factor, 0.0],
            y: [0.0, insert.y_scale_factor],
            origin: [0.0; 2],
        };
        self.placed.blocks.push(block.name.as_str().into());
        for row in 0..insert.row_count.max(1) {
            for column in 0..insert.column_count.max(1) {
                let shift = [
                    f64::from(column) * insert.column_spacing,
                    f64::from(row) * insert.row_spacing,
                ];
                let inner = outer
                    .after(&Transform::shift(shift))
                    .after(&scale)
                    .after(&Transform::shift(base));
                // a block of nothing, or of texts alone, in many rows takes time and memory too
                self.visited += 1;
                if self.visited > MOST_ENTITIES {
                    return Err(too_many_in_blocks(place, MOST_ENTITIES, "entities in blocks"));
                }
                if depth == 0 {
                    self.places += 1;
                    self.placed.number = self.places;
                }
                for entity in &block.entities {
                    self.read(entity, Some(layer), &inner, depth + 1)?;
                }
            }
        }
        if depth == 0 {
            self.last_placed = self.placed.clone();
            self.placed.number = 0;
        }
        self.placed.blocks.pop();
        Ok(())
    }
}

/// The lines of a text, without the marks that say how it looks: `\\P` ends a line, `\\f…;` and the like change the font, `%%u` underlines.
fn plain(value: &str) -> Vec<String> {
    let mut text = String::with_capacity(value.len());
    let mut letters = value.chars();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => match letters.next() {
                Some('P' | 'X' | 'N') => text.push('\n'),
                Some('~') => text.push(' '),
                Some(mark) if mark.is_ascii_alphabetic() && !"LlOoKk".contains(mark) => {
                    letters.by_ref().find(|letter| *letter == ';');
                }
                Some(mark) if mark.is_ascii_alphabetic() => {}
                Some(letter) => text.push(letter),
                None => {}
            },
            '{' | '}' => {}
            letter => text.push(letter),
        }
    }
    for mark in ["%%u", "%%U", "%%o", "%%O", "%%k", "%%K"] {
        text = text.replace(mark, "");
    }
    let joined = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
    text.split('\n').map(joined).filter(|line| !line.is_empty()).collect()
}

/// What an entity is called, a point of it, and the normal of its plane; `None` for what is no curve.
fn classify(entity: &EntityType) -> Option<(&'static str, Point, &Vector)> {
    Some(match entity {
        EntityType::Line(line) => ("LINE", line.p1.clone(), &line.extrusion_direction),
        EntityType::Circle(circle) => ("CIRCLE", circle.center.clone(), &circle.normal),
        EntityType::Arc(arc) => ("ARC", arc.center.clone(), &arc.normal),
        EntityType::Ellipse(ellipse) => ("ELLIPSE", ellipse.center.clone(), &ellipse.normal),
        EntityType::LwPolyline(line) => {
            let at = line.vertices.first().map(|v| Point::new(v.x, v.y, 0.0))?;
            ("LWPOLYLINE", at, &line.extrusion_direction)
        }
        // polygon meshes and polyface meshes are no curves
        EntityType::Polyline(line) if line.flags & (16 | 64) == 0 => {
            ("POLYLINE", line.vertices().next()?.location.clone(), &line.normal)
        }
        EntityType::Spline(spline) => {
            let first = spline.control_points.first().or(spline.fit_points.first())?;
            ("SPLINE", first.clone(), &spline.normal)
        }
        EntityType::Insert(insert) => {
            ("INSERT", insert.location.clone(), &insert.extrusion_direction)
        }
        _ => return None,
    })
}

/// Whether the coordinates of an entity are those of its own plane, and not of the drawing.
fn in_own_plane(entity: &EntityType) -> bool {
    match entity {
        EntityType::Circle(_) | EntityType::Arc(_) | EntityType::LwPolyline(_) => true,
        EntityType::Polyline(Polyline { flags, .. }) => flags & 8 == 0,
        _ => false,
    }
}

/// Whether a plane is seen from behind; `None` for one that is inclined to the drawing.
fn mirrored(normal: &Vector) -> Option<bool> {
    let across = normal.x.hypot(normal.y);
    (normal.z != 0.0 && across <= ROUNDING * normal.z.abs()).then_some(normal.z < 0.0)
}

/// Lowest and highest z of a curve that is not flat.
fn heights(entity: &EntityType) -> Option<[f64; 2]> {
    let points: Vec<Point> = match entity {
        EntityType::Line(line) => vec![line.p1.clone(), line.p2.clone()],
        EntityType::Polyline(line) => line.vertices().map(|v| v.location.clone()).collect(),
        EntityType::Spline(spline) => spline.control_points.clone(),
        EntityType::Ellipse(ellipse) => {
            let (center, axis) = (&ellipse.center, &ellipse.major_axis);
            vec![
                center.clone(),
                Point::new(center.x + axis.x, center.y + axis.y, center.z + axis.z),
            ]
        }
        _ => return None,
    };
    let mut z = [f64::INFINITY, f64::NEG_INFINITY];
    let mut size = 0.0_f64;
    for point in &points {
        z = [z[0].min(point.z), z[1].max(point.z)];
        size = size.max(point.x.abs()).max(point.y.abs()).max(point.z.abs());
    }
    (z[1] - z[0] > ROUNDING * size).then_some(z)
}

fn plane(point: &Point) -> [f64; 2] {
    [point.x, point.y]
}

/// An arc of a circle, its angles in degrees.
fn arc(center: &Point, radius: f64, start: f64, sweep: f64, limit: Limit) -> Result<Flat, TooMany> {
    let (p, q) = ([radius, 0.0], [0.0, radius]);
    let [start, sweep] = [start, sweep].map(f64::to_radians);
    closed_if_whole(Arc { center: plane(center), p, q, start, sweep }, limit)
}

/// An arc that ends where it begins is whole, and an arc of no angle is that too.
fn closed_if_whole(arc: Arc, limit: Limit) -> Result<Flat, TooMany> {
    let whole = std::f64::consts::TAU;
    let missing = arc.sweep.rem_euclid(whole);
    if missing.min(whole - missing) > ROUNDING * whole {
        return Ok(Flat { points: arc.flatten(limit)?, closed: false });
    }
    let mut points = Arc { sweep: whole, ..arc }.flatten(limit)?;
    points.pop();
    Ok(Flat { points, closed: true })
}

/// Points, each with the bulge of the line that follows it.
fn polyline(vertices: Vec<([f64; 2], f64)>, closed: bool, limit: Limit) -> Result<Flat, TooMany> {
    let mut points = Vec::new();
    for (n, (at, bulge)) in vertices.iter().enumerate() {
        points.push(*at);
        let next = if n + 1 < vertices.len() { n + 1 } else { 0 };
        if next != 0 || closed {
            let room = limit.points.checked_sub(points.len()).ok_or(TooMany)?;
            let limit = Limit { points: room, ..limit };
            points.extend(flatten::bulge(*at, vertices[next].0, *bulge, limit)?);
        }
    }
    Ok(Flat { points, closed })
}

fn nurbs(spline: &Spline, place: &EntityPlace) -> Result<Nurbs, Fault> {
    if spline.control_points.is_empty() {
        return Err(Fault::new(
            format!("{place} has fit points and no control points"),
            "save it with control points, or convert it to a polyline",
        ));
    }
    let points: Vec<[f64; 2]> = spline.control_points.iter().map(plane).collect();
    let degree = usize::try_from(spline.degree_of_curve).unwrap_or(0);
    Nurbs::new(degree, spline.knot_values.clone(), &points, &spline.weight_values)
        .map_err(|why| Fault::new(format!("{place} is no spline: {why}"), "correct the drawing"))
}

/// What to do about a curve that is not in the plane of the drawing.
const FLAT: &str = "draw the outline flat, in the x-y plane";
/// What to do about blocks.
const EXPLODE: &str = "explode the block in the drawing";

/// A curve in a plane that is not that of the drawing.
fn tilted(place: &EntityPlace) -> Fault {
    Fault::new(format!("{place} lies in a plane that is inclined to the drawing"), FLAT)
}

/// Blocks within blocks without end, or too many of them.
fn too_many_in_blocks(place: &EntityPlace, most: usize, what: &str) -> Fault {
    Fault::new(format!("{place} places more than {most} {what}"), EXPLODE)
}
