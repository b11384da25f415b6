//! What is marked on the picture of a net: its seed, the directions of u and v, the largest shear.

use crate::write::figure::canvas::{Canvas, Ink, Px, Type};
use crate::write::figure::color::{BLACK, DARK, RED};
use plydrape::net::Net;

/// Cells whose shear differs by no more than this (°) shear alike.
const ALIKE: f64 = 0.05;
const WHITE: Ink = Ink([255; 3], 1.0);

/// The fabric from the seed on, a sixth of the net along u and along v, or against it where u or v ends.
pub(super) fn seed_arrows(net: &Net) -> Vec<(&'static str, Vec<[usize; 2]>)> {
    let (nodes, seed) = (net.placement.nodes, net.placement.seed);
    let arrow = |(c, name): (usize, &'static str)| {
        let length = (nodes[c] / 6).max(1);
        // beside the far edge the arrow leads to the seed
        let from = seed[c].min((nodes[c] - 1).saturating_sub(length));
        let to = (from + length).min(nodes[c] - 1);
        let node = |n: usize| if c == 0 { [n, seed[1]] } else { [seed[0], n] };
        (name, (from..=to).map(node).collect())
    };
    [(0, "u"), (1, "v")].into_iter().map(arrow).collect()
}

/// The largest shear (°) and its cell, unless all cells shear alike.
pub(super) fn marked(net: &Net) -> Option<(f64, [usize; 2])> {
    let alike = net.report.mean_shear.to_degrees() + ALIKE;
    net.report.largest_shear.map(|(s, cell)| (s.to_degrees(), cell)).filter(|(s, _)| *s > alike)
}

/// A line with a head at its end and its name beyond it, readable on every color.
pub(super) fn arrow(canvas: &mut Canvas, path: &[Px], name: &str) {
    let [.., before, tip] = path else { return };
    let size = (tip[0] - before[0]).hypot(tip[1] - before[1]).max(1e-9);
    let along = [0, 1].map(|c| (tip[c] - before[c]) / size);
    let place = |ahead: f64, aside: f64| {
        [tip[0] + ahead * along[0] - aside * along[1], tip[1] + ahead * along[1] + aside * along[0]]
    };
    let head = |grow: f64| {
        [place(1.0 + grow, 0.0), place(-8.0 - grow, 4.0 + grow), place(-8.0 - grow, -4.0 - grow)]
    };
    canvas.line(path, WHITE, 3.4);
    canvas.polygon(&head(1.4), WHITE);
    canvas.line(path, BLACK, 1.6);
    canvas.polygon(&head(0.0), BLACK);
    badge(canvas, place(13.0, 0.0), name);
}

/// The seed.
pub(super) fn dot(canvas: &mut Canvas, at: Px) {
    canvas.disc(at, 5.2, WHITE);
    canvas.disc(at, 4.0, BLACK);
}

/// The place of the largest shear, and how large it is; the text ends before `right`.
pub(super) fn mark(canvas: &mut Canvas, at: Px, value: &str, right: f64) {
    canvas.circle(at, 5.0, WHITE, 3.6);
    canvas.circle(at, 5.0, RED, 1.8);
    let half = 3.4 * value.chars().count() as f64;
    // beside the mark, on the side with room
    let side = if at[0] + 2.0 * half + 20.0 < right { 1.0 } else { -1.0 };
    badge(canvas, [at[0] + side * (10.0 + half), at[1]], value);
}

/// A short text on a light background.
fn badge(canvas: &mut Canvas, at: Px, text: &str) {
    let half = [3.4 * text.chars().count() as f64 + 2.5, 7.5];
    let corner = |x: f64, y: f64| [at[0] + x * half[0], at[1] + y * half[1]];
    let ring = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    canvas.polygon(&ring, Ink([255; 3], 0.82));
    canvas.text(text, at, Type { size: 12.0, bold: true, ink: DARK, side: 0 });
}
