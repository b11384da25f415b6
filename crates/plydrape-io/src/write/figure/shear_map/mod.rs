//! The shear map of a net: the flat fabric with lines of equal shear, u to the right and v upwards.
//!
//! A cell has the color of its shear magnitude. Of large nets, blocks of cells share a color, their
//! mean. Where the net has no nodes, and beside a ply that is cut, nothing is drawn.

mod blocks;
mod flat;
mod marks;

use super::axes;
use super::bar::bar;
use super::canvas::{Canvas, Px, heading, plain};
use super::color::{FRAME, RED};
use crate::store::shown;
use blocks::Blocks;
use flat::Flat;
use marks::{dot, marked};
use plydrape::net::Net;

/// Least width of the sheet (picture points); the lines of text have room in it.
const LEAST: f64 = 640.0;
/// Most width and height of the flat fabric (picture points).
const FABRIC: Px = [640.0, 440.0];
/// Room that ticks and labels need around the flat fabric: left, top, bottom; and that the color bar needs at its right.
const ROOM: [f64; 3] = [64.0, 26.0, 52.0];
const BAR: f64 = 120.0;
/// Height of the head and of a further line in it, and of the legend (picture points).
const HEAD: f64 = 66.0;
const LINE: f64 = 16.0;
const LEGEND: f64 = 42.0;

/// The shear map of a net as an SVG; `None` for a net without a cell that has all its nodes, such as a strip.
#[must_use]
pub fn svg(net: &Net, name: &str) -> Option<String> {
    let blocks = Blocks::new(net);
    blocks.shear.iter().flatten().next()?;
    let bounds = net.ply_outline()?.bounds();
    let fabric = [0, 1].map(|c| bounds[1][c] - bounds[0][c]);
    let scale = (FABRIC[0] / fabric[0]).min(FABRIC[1] / fabric[1]);
    let [wide, tall] = fabric.map(|side| side * scale);
    let absent = absent(net);
    let head = if absent.is_empty() { HEAD } else { HEAD + LINE };
    let width = (ROOM[0] + wide + BAR).max(LEAST).ceil();
    let size = [width, (head + ROOM[1] + tall + ROOM[2] + LEGEND).ceil()];

    let mut canvas = Canvas::new(size);
    canvas.text(&shown::excerpt(name, super::TITLE), [28.0, 26.0], heading(17.0));
    canvas.text(&figures(net), [28.0, 49.0], plain(12.5, -1));
    canvas.text(&absent, [28.0, 49.0 + LINE], plain(12.5, -1));
    let left = ROOM[0] + (width - ROOM[0] - wide - BAR) / 2.0;
    let top = head + ROOM[1];
    Flat { left, bottom: top + tall, scale, bounds }.draw(&mut canvas, &blocks);
    bar(&mut canvas, "shear (deg)", [0.0, blocks.top()], left + wide + 30.0, [top, top + tall]);
    legend(&mut canvas, net, size[1] - LEGEND / 2.0 - 4.0);
    Some(canvas.finish())
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
fn legend(canvas: &mut Canvas, net: &Net, y: f64) {
    let word = |canvas: &mut Canvas, text: &str, x: f64| canvas.text(text, [x, y], plain(12.5, -1));
    let mut x = 28.0;
    dot(canvas, [x + 5.0, y]);
    word(canvas, "seed; arrows lead along u and v", x + 17.0);
    x += 232.0;
    if marked(net).is_some() {
        canvas.circle([x + 5.0, y], 5.0, RED, 1.8);
        word(canvas, "largest shear", x + 17.0);
        x += 126.0;
    }
    if !net.missing.is_empty() {
        let ring = [[0.0, -5.0], [10.0, -5.0], [10.0, 5.0], [0.0, 5.0], [0.0, -5.0]];
        canvas.line(&ring.map(|[dx, dy]| [x + dx, y + dy]), FRAME, 1.0);
        word(canvas, "no place on the mold", x + 17.0);
    }
}
