//! Shapes to look at: the ply's surface, catenaries where they were draped, what is in contact, the grippers, the mold. The surface is that of the
//! sheet in each step that was kept where the sheet decides, and drawn between the catenaries where these do.
//!
//! Every marker stays until its successor comes. They carry no time, so a viewer puts them where the frame is
//! now; the bag has the time. What a step does not have is deleted, so that a bag can be played again.

use super::FRAME;
use super::message::{ColorRgba, Header, Marker, MarkerArray, Pose, Vector3};
use crate::result::sheet::{SheetMesh, SheetState};
use crate::result::{ResultFile, catenaries};
use crate::write::figure;
use crate::write::mold_patch::mold_patch;
use crate::write::surface::Surface;
use plydrape::mold::Mold;
use plydrape::outcome::{Gripper, Step};

type Point = [f64; 3];

/// `Marker.type` and `Marker.action`.
const CYLINDER: i32 = 3;
const LINE_LIST: i32 = 5;
const SPHERE_LIST: i32 = 7;
const TRIANGLE_LIST: i32 = 11;
const DELETE: i32 = 2;

const RED: ColorRgba = ColorRgba { r: 0.84, g: 0.10, b: 0.13, a: 1.0 };
const PINK: ColorRgba = ColorRgba { r: 0.93, g: 0.55, b: 0.55, a: 1.0 };
const BLUE: ColorRgba = ColorRgba { r: 0.10, g: 0.30, b: 0.85, a: 1.0 };
const BLACK: ColorRgba = ColorRgba { r: 0.08, g: 0.09, b: 0.10, a: 1.0 };
const GREY: ColorRgba = ColorRgba { r: 0.78, g: 0.80, b: 0.83, a: 1.0 };

/// Radius of a gripper's disc as a share of the shorter side of a cell.
const GRIPPER: f64 = 0.12;
/// Width of a catenary, and thickness of a gripper's disc, as shares of the disc's radius.
const LINE: f64 = 0.1;
const DISC: f64 = 0.2;
/// Triangles of the surface of one step, about, and of the mold at most.
const TRIANGLES: usize = 6000;
const MOLD_TRIANGLES: usize = 8000;
/// Pieces of a cell's side, at most.
const DIVISIONS: usize = 8;

/// What all steps share: pieces of a cell's side, and the range of what colors the ply (m).
pub(super) struct Paint {
    divisions: usize,
    range: [f64; 2],
}

impl Paint {
    /// Fine enough to look round, coarse enough to play; one range of colors for the whole drape.
    pub fn new(result: &ResultFile) -> Self {
        let cells = result.scene.ply.lines().surface().cells().max(1);
        let divisions = (TRIANGLES / (2 * cells)).isqrt().clamp(1, DIVISIONS);
        let grippers = result.steps.iter().flat_map(|step| &step.grippers);
        let value = |gripper: &Gripper| color_value(result, gripper.position);
        let range = grippers
            .map(value)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(v), b.max(v)]);
        Paint { divisions, range }
    }

    fn color(&self, value: f64) -> ColorRgba {
        let [low, high] = self.range;
        let share = if high > low { (value - low) / (high - low) } else { 0.0 };
        let [r, g, b] = figure::viridis_rgb(share).map(|c| f32::from(c) / 255.0);
        ColorRgba { r, g, b, a: 1.0 }
    }
}

/// What the ply's color tells at a place (m): its gap to a curved mold, else its height.
fn color_value(result: &ResultFile, place: Point) -> f64 {
    match &result.scene.mold {
        Some(Mold::Plane(_)) | None => place[2],
        Some(curved) => curved.signed_distance(place).max(0.0),
    }
}

/// Radius of a gripper's disc (m).
fn gripper_radius(result: &ResultFile) -> f64 {
    let [a, b] = result.scene.ply.cell;
    GRIPPER * if result.scene.ply.grid.nv != 1 { a.min(b) } else { a }
}

/// The markers of a step: the grippers, of catenaries these with the surface between them, of a sheet its `state` if that was kept.
pub(super) fn ply(
    result: &ResultFile,
    step: &Step,
    state: Option<(&SheetMesh, &SheetState)>,
    paint: &Paint,
) -> MarkerArray {
    let radius = gripper_radius(result);
    let mut markers = Vec::with_capacity(4 + step.grippers.len());
    if step.catenaries.is_some() {
        markers.extend(drawn(result, step, paint, radius));
    }
    markers.extend(state.map(|(mesh, state)| cells(result, mesh, state, paint)));
    markers.extend(step.grippers.iter().zip(0..).map(|(gripper, id)| disc(gripper, id, radius)));
    MarkerArray { markers }
}

/// The catenaries of a step, what of them is in contact, and the surface between them.
fn drawn(result: &ResultFile, step: &Step, paint: &Paint, radius: f64) -> Vec<Marker> {
    let mut markers = Vec::new();
    if result.scene.ply.lines().surface().cells() > 0 {
        markers.push(surface(result, step, paint));
    }
    let curves = result.curves(step);
    let spans = |edges: bool| {
        let lines = catenaries(step).iter().zip(&curves);
        segments(
            lines.filter(|(line, _)| line.kind.is_edge() == edges).flat_map(|(_, curves)| curves),
        )
    };
    markers.push(lines("catenaries", 0, spans(true), RED, LINE * radius));
    markers.push(lines("catenaries", 1, spans(false), PINK, 0.6 * LINE * radius));
    let (lying, touching) = contact(step);
    markers.push(lines("contact", 0, segments(lying.into_iter()), BLUE, 1.6 * LINE * radius));
    markers.push(points(touching, radius));
    markers
}

/// The cells of a sheet.
fn cells(result: &ResultFile, mesh: &SheetMesh, state: &SheetState, paint: &Paint) -> Marker {
    let mut marker = Marker { color: GREY, ..marker("ply", 0, TRIANGLE_LIST) };
    for cell in mesh.cells.iter() {
        let [a, b, c, d] = cell.map(|n| state.positions[n as usize]);
        for place in [a, b, c, a, c, d] {
            marker.points.push(place.into());
            marker.colors.push(paint.color(color_value(result, place)));
        }
    }
    marker
}

/// The mold under the drape, if there is one.
pub(super) fn mold(result: &ResultFile) -> Option<MarkerArray> {
    let found = mold_patch(result, MOLD_TRIANGLES)?;
    let corners = found.triangles.iter().flatten();
    let points: Vec<Vector3> =
        corners.filter_map(|n| found.vertices.get(*n as usize)).map(|p| (*p).into()).collect();
    let marker = Marker { points, color: GREY, ..marker("mold", 0, TRIANGLE_LIST) };
    Some(MarkerArray { markers: vec![marker] })
}

fn surface(result: &ResultFile, step: &Step, paint: &Paint) -> Marker {
    let surface = Surface::new(result, step, paint.divisions);
    let [across, along] = surface.size.map(|n| n - 1);
    let colors: Vec<ColorRgba> =
        (surface.vertices.iter()).map(|p| paint.color(color_value(result, *p))).collect();
    let mut marker = Marker { color: GREY, ..marker("ply", 0, TRIANGLE_LIST) };
    for [k, m] in (0..along).flat_map(|m| (0..across).map(move |k| [k, m])) {
        let first = m * (across + 1) + k;
        let [a, b, c, d] = [first, first + 1, first + across + 2, first + across + 1];
        for corner in [a, b, c, a, c, d] {
            marker.points.push(surface.vertices[corner].into());
            marker.colors.push(colors[corner]);
        }
    }
    marker
}

/// The lines of fabric in contact with the mold, and contacts of a single point.
fn contact(step: &Step) -> (Vec<&Vec<Point>>, Vec<Vector3>) {
    let lines = catenaries(step).iter().filter_map(|line| line.contact.as_ref());
    let (lying, touching): (Vec<_>, Vec<_>) =
        lines.map(|contact| &contact.points).partition(|points| points.len() > 1);
    (lying, touching.into_iter().flatten().map(|p| (*p).into()).collect())
}

/// Both ends of every piece of polylines.
fn segments<'a>(lines: impl Iterator<Item = &'a Vec<Point>>) -> Vec<Vector3> {
    let pieces = lines.flat_map(|line| line.windows(2)).flatten();
    pieces.map(|p| (*p).into()).collect()
}

/// Polylines; nothing deletes what the step before had.
fn lines(ns: &str, id: i32, points: Vec<Vector3>, color: ColorRgba, width: f64) -> Marker {
    let action = if points.is_empty() { DELETE } else { 0 };
    let scale = [width, 0.0, 0.0].into();
    Marker { action, scale, color, points, ..marker(ns, id, LINE_LIST) }
}

/// Touches in a point, as balls.
fn points(places: Vec<Vector3>, radius: f64) -> Marker {
    let action = if places.is_empty() { DELETE } else { 0 };
    let scale = [3.0 * LINE * radius; 3].into();
    Marker { action, scale, color: BLUE, points: places, ..marker("contact", 1, SPHERE_LIST) }
}

/// A gripper: a flat disc about its position, its axis along the ply's normal.
fn disc(gripper: &Gripper, id: i32, radius: f64) -> Marker {
    let pose = Pose { position: gripper.position.into(), orientation: gripper.quaternion.into() };
    let scale = [2.0 * radius, 2.0 * radius, DISC * radius].into();
    Marker { pose, scale, color: BLACK, ..marker("grippers", id, CYLINDER) }
}

fn marker(ns: &str, id: i32, r#type: i32) -> Marker {
    Marker {
        header: Header { frame_id: FRAME.into(), ..Header::default() },
        ns: ns.into(),
        id,
        r#type,
        scale: [1.0; 3].into(),
        // follow the frame if it moves
        frame_locked: true,
        ..Marker::default()
    }
}
