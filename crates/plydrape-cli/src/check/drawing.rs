//! What was read of the drawing of a ply.

use crate::numbers::short;
use plydrape::ply::Outline;
use plydrape_io::read::outline::{Drawn, Source};
use plydrape_io::store::shown::{millimeters, name};

/// Most holes that have a line of their own.
const MOST: usize = 4;

/// Where boundary and holes of a ply are from, how large the holes are, which gaps were closed and what was left out.
pub(super) fn drawing(drawn: &Drawn) -> Vec<String> {
    // where the boundary is from
    let Drawn { outline, boundary, holes, gaps, others, skipped } = drawn;
    let mut lines =
        vec![format!("boundary of {} from {}", size(outline.boundary()), from(boundary))];

    // holes from the largest down; those that are too many for lines of their own share one
    let whole = area(outline.boundary());
    let mut all: Vec<(&[[f64; 2]], &Source)> =
        outline.holes().iter().map(Vec::as_slice).zip(holes).collect();
    all.sort_by(|a, b| area(b.0).total_cmp(&area(a.0)));
    let share = |area: f64| format!("{} % of the ply", share(area / whole));
    let own = if all.len() > MOST { MOST - 1 } else { all.len() };
    for (ring, source) in &all[..own] {
        lines.push(format!(
            "a hole of {} from {}, {}",
            size(ring),
            from(source),
            share(area(ring))
        ));
    }
    if let [(largest, _), ..] = &all[own..] {
        let mut sources: Vec<String> = all[own..].iter().map(|(_, source)| from(source)).collect();
        sources.sort();
        sources.dedup();
        let together = all[own..].iter().map(|(ring, _)| area(ring)).sum();
        lines.push(format!(
            "{} more holes of up to {} from {}, together {}",
            all.len() - own,
            size(largest),
            sources.join(", "),
            share(together),
        ));
    }

    // what was closed, and what was left out
    if let Some(widest) = gaps.first() {
        let gaps = match gaps.len() {
            1 => "one gap between ends of lines was".into(),
            count => format!("{count} gaps between ends of lines were"),
        };
        lines.push(format!("{gaps} closed, the widest of {} mm", gap(*widest)));
    }
    if *others > 0 {
        let noun = if *others == 1 { "line" } else { "lines" };
        lines.push(format!("{others} closed {noun} of other blocks inside the boundary left out"));
    }
    if !skipped.is_empty() {
        let kinds = skipped.iter().map(|(kind, count)| format!("{count} {}", name(kind)));
        let kinds: Vec<String> = kinds.collect();
        lines.push(format!("left out, as no outline is made of it: {}", kinds.join(", ")));
    }
    lines
}

/// The layers and the block of a line.
fn from(source: &Source) -> String {
    let names: Vec<String> =
        source.layers.iter().map(|layer| format!("`{}`", name(layer))).collect();
    let layers = match names.len() {
        1 => format!("layer {}", names[0]),
        _ => format!("layers {}", names.join(", ")),
    };
    match &source.block {
        None => layers,
        Some(block) => format!("{layers} of block `{}`", name(block)),
    }
}

/// How large a ring is along x and y.
fn size(ring: &[[f64; 2]]) -> String {
    let along = |n: usize| {
        let values = || ring.iter().map(|point| point[n]);
        let least = values().fold(f64::INFINITY, f64::min);
        millimeters(values().fold(f64::NEG_INFINITY, f64::max) - least)
    };
    format!("{} × {} mm", along(0), along(1))
}

/// The area that a ring encloses (m²).
fn area(ring: &[[f64; 2]]) -> f64 {
    Outline::new(ring.to_vec(), Vec::new()).map_or(0.0, |outline| outline.area())
}

/// A share in percent: whole ones, and of what is less than one a digit that says something.
fn share(share: f64) -> String {
    let percent = 100.0 * share;
    if percent >= 0.995 { format!("{percent:.0}") } else { short((percent * 1e3).round() * 1e-3) }
}

/// The width of a gap (mm), however small.
fn gap(width: f64) -> String {
    if width >= 1e-6 { millimeters(width) } else { "less than 0.001".into() }
}
