//! What each seed costs, on the flat ply, and what each heading does, as one small picture.

use super::axes::{self, LABEL, TICK};
use super::bar::bar;
use super::canvas::{Canvas, Ink, Px, heading, plain};
use super::color::{BLACK, DARK, FRAME, GRID, viridis};
use crate::store::shown;
use plydrape::net::{Choice, Net, Seeds};

/// Width of the sheet, height of its head, room around a panel (picture points).
const WIDTH: f64 = 640.0;
const HEAD: f64 = 62.0;
const ROOM: Px = [64.0, 46.0];
/// Most width of a panel, most height of the flat ply, height of the headings (picture points).
const PANEL: f64 = 440.0;
const PLY: f64 = 300.0;
const HEADINGS: f64 = 150.0;
/// Half the side of a seed's square (picture points).
const HALF: f64 = 7.0;
/// The color scale spans at least this much (°), so that rounding errors have no color.
const LEAST: f64 = 0.05;

/// The picture of a search, as an SVG 640 points wide.
#[must_use]
pub fn svg(seeds: &Seeds, net: &Net, name: &str) -> String {
    let taken = &seeds.choices[seeds.chosen];
    let cost = |choice: &Choice| choice.largest_shear.map(f64::to_degrees);
    let at_heading: Vec<&Choice> = seeds
        .choices
        .iter()
        .filter(|choice| choice.held_heading == taken.held_heading && cost(choice).is_some())
        .collect();
    let mut by_heading: Vec<(f64, f64)> = seeds
        .choices
        .iter()
        .filter(|choice| choice.off == Some((0.0, 0.0)))
        .filter_map(|choice| Some((choice.held_heading.to_degrees(), cost(choice)?)))
        .collect();
    by_heading.sort_by(|a, b| a.0.total_cmp(&b.0));

    let bounds = net.ply_outline().map_or_else(
        || [net.placement.origin, net.placement.fabric(net.placement.nodes.map(|n| n - 1))],
        |outline| outline.bounds(),
    );
    let size = [0, 1].map(|c| (bounds[1][c] - bounds[0][c]).max(1e-9));
    let scale = (PANEL / size[0]).min(PLY / size[1]);
    let height = size[1] * scale;
    let headings = if by_heading.len() > 1 { HEADINGS + ROOM[1] + 18.0 } else { 0.0 };
    let sheet = [WIDTH, (HEAD + height + ROOM[1] + headings + 8.0).ceil()];

    let mut canvas = Canvas::new(sheet);
    canvas.text(&shown::excerpt(name, super::TITLE), [24.0, 24.0], heading(15.0));
    canvas.text(&words(taken), [24.0, 44.0], plain(12.5, -1));

    // Seeds on the flat ply.
    let pixel = |[u, v]: [f64; 2]| -> Px {
        [ROOM[0] + (u - bounds[0][0]) * scale, HEAD + height - (v - bounds[0][1]) * scale]
    };
    if let Some(outline) = net.ply_outline() {
        for ring in outline.rings() {
            let closed: Vec<Px> = ring.iter().chain(ring.first()).map(|p| pixel(*p)).collect();
            canvas.line(&closed, FRAME, 1.0);
        }
    }
    let shears = || at_heading.iter().filter_map(|choice| cost(choice));
    let low = shears().fold(f64::INFINITY, f64::min);
    let low = if low.is_finite() { low } else { 0.0 };
    let high = shears().fold(low, f64::max).max(low + LEAST);
    for choice in &at_heading {
        let [x, y] = pixel(choice.at.fabric);
        let share = (cost(choice).unwrap_or(low) - low) / (high - low);
        let square = [[-HALF, -HALF], [HALF, -HALF], [HALF, HALF], [-HALF, HALF]];
        canvas.polygon(&square.map(|[a, b]| [x + a, y + b]), viridis(share));
    }
    let place = pixel(taken.at.fabric);
    canvas.circle(place, HALF + 3.0, Ink([255; 3], 1.0), 4.0);
    canvas.circle(place, HALF + 3.0, BLACK, 1.8);
    let steps = |length: f64, room: f64| (length * scale / room).clamp(2.0, 8.0);
    for tick in axes::ticks(bounds[0][0], bounds[1][0], steps(size[0], 56.0)) {
        let [x, y] = pixel([tick * 1e-3, bounds[0][1]]);
        canvas.text(&axes::label(tick), [x, y + 13.0], plain(TICK, 0));
    }
    for tick in axes::ticks(bounds[0][1], bounds[1][1], steps(size[1], 34.0)) {
        let [x, y] = pixel([bounds[0][0], tick * 1e-3]);
        canvas.text(&axes::label(tick), [x - 8.0, y], plain(TICK, 1));
    }
    canvas.text(
        "seed u, v (mm)",
        [ROOM[0] + size[0] * scale / 2.0, HEAD + height + 31.0],
        plain(LABEL, 0),
    );
    let between = [HEAD + 24.0, HEAD + height.max(120.0)];
    bar(&mut canvas, "largest shear (deg)", [low, high], PANEL + 60.0, between);

    if by_heading.len() > 1 {
        let top = HEAD + height + ROOM[1] + 18.0;
        draw_headings(&mut canvas, &by_heading, taken.held_heading.to_degrees(), top);
    }
    canvas.finish()
}

/// The largest shear over the heading: both in degrees.
fn draw_headings(canvas: &mut Canvas, costs: &[(f64, f64)], taken: f64, top: f64) {
    let high = costs.iter().map(|(_, cost)| *cost).fold(LEAST, f64::max);
    let (first, last) = (costs[0].0, costs[costs.len() - 1].0);
    let pixel = |degrees: f64, cost: f64| -> Px {
        let share = (degrees - first) / (last - first).max(1e-9);
        [ROOM[0] + PANEL * share, top + HEADINGS * (1.0 - cost / high)]
    };
    for tick in axes::round_numbers(0.0, high, 5.0) {
        let [x, y] = pixel(first, tick);
        canvas.line(&[[x, y], [x + PANEL, y]], GRID, 1.0);
        canvas.text(&axes::label(tick), [x - 8.0, y], plain(TICK, 1));
    }
    for tick in axes::round_numbers(first, last, 8.0) {
        let [x, y] = pixel(tick, 0.0);
        canvas.text(&axes::label(tick), [x, y + 13.0], plain(TICK, 0));
    }
    let line: Vec<Px> = costs.iter().map(|(degrees, cost)| pixel(*degrees, *cost)).collect();
    canvas.line(&line, DARK, 1.4);
    if let Some((degrees, cost)) = costs.iter().find(|(degrees, _)| *degrees == taken) {
        canvas.circle(pixel(*degrees, *cost), 5.0, BLACK, 1.8);
    }
    let [x, y] = pixel(0.5 * (first + last), 0.0);
    canvas.text("heading (deg); largest shear (deg)", [x, y + 31.0], plain(LABEL, 0));
}

/// What was taken, in one line.
fn words(taken: &Choice) -> String {
    let [u, v] = taken.at.fabric.map(|c| axes::label((c * 1e4).round() / 10.0));
    let shear = taken
        .largest_shear_fine
        .map_or(String::new(), |shear| format!(": largest shear {:.2}°", shear.to_degrees()));
    let heading = axes::label((taken.held_heading.to_degrees() * 100.0).round() / 100.0);
    format!("taken: seed u = {u} mm, v = {v} mm, heading {heading}°{shear}")
}
