//! The shear map of a net: on the mold in 3D, and on the flat fabric with lines of equal shear.
//!
//! A cell has the color of its shear magnitude. Of large nets, blocks of cells share a color, their
//! mean. Where the net has no nodes, and beside a ply that is cut, nothing is drawn.

mod blocks;
mod draped;
mod flat;
mod marks;

use super::FigureError;
use super::axes::{self, ROOM, plain};
use super::bar::bar;
use super::canvas::{self, Canvas, Px};
use super::colour::{FRAME, RED};
use super::layout::{heading, title};
use super::panel::MoldPicture;
use super::projection::{Point, View};
use super::scale::Scale;
use blocks::Blocks;
use draped::Draped;
use flat::Flat;
use marks::{dot, marked};
use plydrape::mold::Mold;
use plydrape::net::Net;

/// Width of the sheet, and where the panels end and the color bar begins (picture points).
const WIDTH: f64 = 900.0;
const PANELS: f64 = 800.0;
/// Most height of the box in 3D and of the flat fabric, most width of the latter (picture points).
const BOX: f64 = 400.0;
const FLAT: Px = [600.0, 320.0];
/// Height of the head and of a further line in it, of a panel's title and of the legend (picture points).
const HEAD: f64 = 72.0;
const LINE: f64 = 16.0;
const TITLE: f64 = 20.0;
const LEGEND: f64 = 42.0;

/// The shear map of a net on its mold, as an SVG 900 points wide.
///
/// # Errors
/// [`FigureError`] if the net has no node with a place, or the writer fails.
pub fn svg(net: &Net, mold: &Mold, name: &str) -> Result<String, FigureError> {
    let nodes = nodes(net);
    if nodes.is_empty() {
        return Err(FigureError::NoNode);
    }
    let frame = Draped::of(&nodes, mold, net.boundary(mold));
    let unit = View::of(frame.low, frame.high, 1.0);
    let [from, to] = unit.extent(frame.low, frame.high);
    let room = [PANELS - ROOM[0] - ROOM[2], BOX];
    let scale = (room[0] / (to[0] - from[0])).min(room[1] / (to[1] - from[1]));
    let first = TITLE + ROOM[1] + (to[1] - from[1]) * scale + ROOM[3];

    let blocks = Blocks::of(net);
    let whole = blocks.shear.iter().any(Option::is_some);
    let bounds = net.ply_outline().map_or_else(
        || [net.placement.origin, net.placement.fabric(net.placement.nodes.map(|n| n - 1))],
        |outline| outline.bounds(),
    );
    let fabric = [0, 1].map(|c| bounds[1][c] - bounds[0][c]);
    let flat = if whole { (FLAT[0] / fabric[0]).min(FLAT[1] / fabric[1]) } else { 0.0 };
    let second = if whole { TITLE + ROOM[1] + fabric[1] * flat + ROOM[3] } else { 0.0 };
    let absent = absent(net);
    let head = if absent.is_empty() { HEAD } else { HEAD + LINE };
    let size = [WIDTH, (head + first + second + LEGEND).ceil()];

    let mut text = String::new();
    let mut canvas = Canvas::new(&mut text, size)?;
    canvas.text(&title(name), [28.0, 26.0], heading(17.0))?;
    canvas.text(&figures(net), [28.0, 49.0], plain(12.5, -1))?;
    canvas.text(&absent, [28.0, 49.0 + LINE], plain(12.5, -1))?;
    let top = blocks.top();

    // On the mold.
    canvas.text("on the mold", [28.0, head + 12.0], heading(14.0))?;
    let free = room[0] - (to[0] - from[0]) * scale;
    let corner = [ROOM[0] + free / 2.0, head + TITLE + ROOM[1]];
    let origin = [corner[0] - scale * from[0], corner[1] - scale * from[1]];
    frame.draw(&mut canvas, &unit.placed(scale, origin), &blocks)?;

    // On the flat fabric.
    if whole {
        let y = head + first;
        canvas.text("on the flat fabric", [28.0, y + 12.0], heading(14.0))?;
        let left = (PANELS - fabric[0] * flat) / 2.0;
        let map =
            Flat { left, bottom: y + TITLE + ROOM[1] + fabric[1] * flat, scale: flat, bounds };
        map.draw(&mut canvas, &blocks)?;
        let between = [head + 40.0, size[1] - LEGEND - 24.0];
        bar(&mut canvas, "shear (deg)", Scale::Even([0.0, top]), PANELS + 24.0, between)?;
    }
    legend(&mut canvas, net, size[1] - LEGEND / 2.0 - 4.0)?;
    canvas.finish()?;
    Ok(canvas::at_size(&text, size))
}

/// Places of the ply's nodes (m); of all nodes if none of them is on the ply.
fn nodes(net: &Net) -> Vec<Point> {
    let (coverage, nu) = (net.coverage(), net.placement.nodes[0]);
    let all = || net.nodes.iter().enumerate().filter_map(|(n, place)| Some((n, (*place)?)));
    let of_ply: Vec<Point> =
        all().filter(|(n, _)| coverage.node([n % nu, n / nu])).map(|(_, place)| place).collect();
    if of_ply.is_empty() { all().map(|(_, place)| place).collect() } else { of_ply }
}

/// The part of the mold around a net that its map shows, in polygons (m).
pub(crate) fn patch(net: &Net, mold: &Mold) -> Vec<Vec<Point>> {
    let nodes = nodes(net);
    if nodes.is_empty() {
        return Vec::new();
    }
    match Draped::of(&nodes, mold, None).mold_picture {
        Some(MoldPicture::Flat(corners)) => vec![corners.to_vec()],
        Some(MoldPicture::Relief(relief)) => relief.outlines(),
        None => Vec::new(),
    }
}

/// The key figures in one line.
fn figures(net: &Net) -> String {
    let ([nu, nv], [du, dv]) = (net.placement.nodes, net.placement.mesh.map(|d| d * 1e3));
    let width = |d: f64| axes::label((d * 1e3).round() / 1e3);
    let mesh = if (du - dv).abs() < 1e-9 * du {
        width(du)
    } else {
        format!("{} × {}", width(du), width(dv))
    };
    let mut parts = vec![format!("{nu} × {nv} nodes, mesh {mesh} mm")];
    if let Some((largest, cell)) = net.report.largest_shear {
        let low = net.placement.fabric(cell);
        let [u, v] = [0, 1].map(|c| (low[c] + 0.5 * net.placement.mesh[c]) * 1e3);
        let [largest, mean] = [largest, net.report.mean_shear].map(f64::to_degrees);
        if marked(net).is_some() {
            parts.push(format!("largest shear {largest:.1}° at u = {u:.0} mm, v = {v:.0} mm"));
            parts.push(format!("mean {mean:.1}°"));
        } else {
            parts.push(format!("shear {mean:.1}° everywhere"));
        }
    }
    parts.join("  ·  ")
}

/// How many nodes have no place on the mold, and why.
fn absent(net: &Net) -> String {
    let report = &net.report;
    let missing = [
        (report.off_mold, "off the mold"),
        (report.folded, "folded"),
        (report.unreached, "behind a fold"),
    ];
    let some = missing.iter().filter(|m| m.0 > 0);
    let parts: Vec<String> = some.map(|(count, what)| format!("{count} nodes {what}")).collect();
    parts.join("  ·  ")
}

/// What the marks mean, in one line.
fn legend(canvas: &mut Canvas, net: &Net, y: f64) -> Result<(), FigureError> {
    let word = |canvas: &mut Canvas, text: &str, x: f64| canvas.text(text, [x, y], plain(12.5, -1));
    let mut x = 28.0;
    dot(canvas, [x + 5.0, y])?;
    word(canvas, "seed; arrows lead along u and v", x + 17.0)?;
    x += 232.0;
    if marked(net).is_some() {
        canvas.circle([x + 5.0, y], 5.0, RED, 1.8)?;
        word(canvas, "largest shear", x + 17.0)?;
        x += 126.0;
    }
    if !net.missing.is_empty() {
        let ring = [[0.0, -5.0], [10.0, -5.0], [10.0, 5.0], [0.0, 5.0], [0.0, -5.0]];
        canvas.line(&ring.map(|[dx, dy]| [x + dx, y + dy]), FRAME, 1.0)?;
        word(canvas, "no place on the mold", x + 17.0)?;
    }
    Ok(())
}
