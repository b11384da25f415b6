//! The plies of a book in plan, as SVG: their outlines on the mold, and their yarns.

use super::PlyRecord;
use crate::scene::{Book, BookPly};
use plydrape::geometry::vector::{cross, sub, unit};
use plydrape::mold::patch::patch;
use plydrape::net::Net;
use plydrape::ply::Direction;
use std::fmt::Write;

/// Width of a drawing (px).
const WIDTH: f64 = 640.0;
/// How far the mold is drawn beyond the plies, as a share of their longer side.
const BEYOND: f64 = 0.08;
/// Most triangles of the mold in a drawing.
const TRIANGLES: usize = 900;
/// Lines of warp across a ply, and points along each.
const YARNS: [usize; 2] = [12, 48];

/// The plan of a drawing: what is where.
struct PlanView {
    low: [f64; 2],
    high: [f64; 2],
    /// Pixels for a meter.
    scale: f64,
}

impl PlanView {
    fn new(book: &Book) -> Self {
        let points = || book.plies.iter().flat_map(|ply| ply.region.iter().flatten());
        let low = [0, 1].map(|n| points().map(|p| p[n]).fold(f64::INFINITY, f64::min));
        let high = [0, 1].map(|n| points().map(|p| p[n]).fold(f64::NEG_INFINITY, f64::max));
        let more = BEYOND * (high[0] - low[0]).max(high[1] - low[1]);
        let (low, high) = (low.map(|c| c - more), high.map(|c| c + more));
        PlanView { low, high, scale: WIDTH / (high[0] - low[0]).max(high[1] - low[1]) }
    }

    /// Pixels of a place in plan (m), y upwards.
    fn pixels(&self, [x, y]: [f64; 2]) -> String {
        format!("{:.1},{:.1}", (x - self.low[0]) * self.scale, (self.high[1] - y) * self.scale)
    }

    fn path(&self, points: impl Iterator<Item = [f64; 2]>, closed: bool) -> String {
        let mut text = String::new();
        for (n, point) in points.enumerate() {
            let _ = write!(text, "{}{}", if n == 0 { "M" } else { "L" }, self.pixels(point));
        }
        text + if closed { "Z" } else { "" }
    }

    fn rings(&self, rings: &[Vec<[f64; 2]>]) -> String {
        rings.iter().map(|ring| self.path(ring.iter().copied(), true)).collect()
    }

    fn svg(&self, label: &str, class: &str, body: &str) -> String {
        let size = [0, 1].map(|n| (self.high[n] - self.low[n]) * self.scale);
        format!(
            "<svg class=\"{class}\" viewBox=\"0 0 {:.0} {:.0}\" role=\"img\" aria-label=\"{label}\">{body}</svg>\n",
            size[0], size[1]
        )
    }
}

/// All outlines on the mold, numbered, each with the direction of its warp.
pub(super) fn all(book: &Book, plies: &[PlyRecord]) -> String {
    let plan = PlanView::new(book);
    let mut body = mold(book, &plan);
    for (n, ply) in plies.iter().enumerate() {
        let class = format!("ply c{}", n % COLORS);
        let _ = write!(body, "<path class=\"{class}\" d=\"{}\"/>", plan.rings(&ply.region));
    }
    for (n, ply) in plies.iter().enumerate() {
        let Some(middle) = middle(&ply.region) else { continue };
        // labels of plies with the same middle are side by side
        let twins = plies[..n].iter().filter_map(|other| self::middle(&other.region));
        let reach = 0.05 * (plan.high[0] - plan.low[0]);
        let before = twins
            .filter(|other| (other[0] - middle[0]).hypot(other[1] - middle[1]) < reach)
            .count();
        let at = [middle[0] + reach * (before as f64), middle[1]];
        if let Some(heading) = ply.warp_heading {
            let (sin, cos) = heading.sin_cos();
            let ends = [-1.0, 1.0].map(|s| [at[0] + s * reach * cos, at[1] + s * reach * sin]);
            let line = plan.path(ends.into_iter(), false);
            let _ = write!(body, "<path class=\"warp c{}\" d=\"{line}\"/>", n % COLORS);
        }
        let pixels = plan.pixels(at);
        let (x, y) = pixels.split_once(',').unwrap_or(("0", "0"));
        let _ = write!(
            body,
            "<circle class=\"mark c{}\" cx=\"{x}\" cy=\"{y}\" r=\"11\"/><text class=\"number\" x=\"{x}\" y=\"{y}\">{}</text>",
            n % COLORS,
            n + 1
        );
    }
    plan.svg("all plies on the mold, seen from above", "all", &body)
}

/// Number of colors of plies in the page.
pub(super) const COLORS: usize = 6;

/// One ply with its yarns, over those that it lies on.
pub(super) fn ply(book: &Book, index: usize) -> String {
    let (plan, ply) = (PlanView::new(book), &book.plies[index]);
    let mut body = String::new();
    for lower in &ply.lies_on {
        let rings = plan.rings(&book.plies[*lower].region);
        let _ = write!(body, "<path class=\"below\" d=\"{rings}\"/>");
    }
    let class = format!("ply c{}", index % COLORS);
    let _ = write!(body, "<path class=\"{class}\" d=\"{}\"/>", plan.rings(&ply.region));
    for yarn in yarns(ply) {
        let line = plan.path(yarn.into_iter(), false);
        let _ = write!(body, "<path class=\"yarn c{}\" d=\"{line}\"/>", index % COLORS);
    }
    plan.svg(&format!("ply {} with its warp, seen from above", index + 1), "one", &body)
}

/// The mold in triangles, darker the steeper it is.
fn mold(book: &Book, plan: &PlanView) -> String {
    let found = patch(&book.mold, plan.low, plan.high, TRIANGLES);
    let mut body = String::new();
    for corners in &found.triangles {
        let [a, b, c] = corners.map(|n| found.vertices[n as usize]);
        let Some(normal) = unit(cross(sub(b, a), sub(c, a))) else { continue };
        // light from the left and above, in steps of 2 %
        let light = (0.5 * (-normal[0] + normal[1]) + normal[2].abs()) / 1.5_f64.sqrt();
        let shade = (50.0 * (0.55 - 0.5 * light.clamp(0.0, 1.0))).round() / 50.0;
        let line = plan.path([a, b, c].into_iter().map(|[x, y, _]| [x, y]), true);
        let _ = write!(body, "<path class=\"mold\" fill-opacity=\"{shade:.2}\" d=\"{line}\"/>");
    }
    body
}

/// The middle of the box around a region (m).
fn middle(rings: &[Vec<[f64; 2]>]) -> Option<[f64; 2]> {
    let points = || rings.iter().flatten();
    points().next()?;
    Some([0, 1].map(|n| {
        let low = points().map(|p| p[n]).fold(f64::INFINITY, f64::min);
        let high = points().map(|p| p[n]).fold(f64::NEG_INFINITY, f64::max);
        0.5 * (low + high)
    }))
}

fn net(ply: &BookPly) -> Option<&Net> {
    ply.scene.layup.target.as_ref()?.drape.as_deref()
}

/// Which of u and v runs along the warp.
fn warp_axis(ply: &BookPly) -> usize {
    match ply.scene.layup.ply.warp {
        Direction::U => 0,
        Direction::V => 1,
    }
}

/// Direction of the warp in the middle of a ply, in plan (rad).
pub(super) fn warp_heading(ply: &BookPly) -> Option<f64> {
    let (net, mold) = (net(ply)?, ply.scene.layup.mold.as_ref()?);
    let [low, high] = net.ply_outline()?.bounds();
    let tangents = net.fibers(mold, [0, 1].map(|n| 0.5 * (low[n] + high[n])))?;
    let [x, y, _] = tangents[warp_axis(ply)];
    Some(y.atan2(x))
}

/// Lines of warp in plan (m), as far as they are on the ply.
fn yarns(ply: &BookPly) -> Vec<Vec<[f64; 2]>> {
    let found = || {
        let (net, mold) = (net(ply)?, ply.scene.layup.mold.as_ref()?);
        Some((net, mold, net.ply_outline()?))
    };
    let Some((net, mold, outline)) = found() else { return Vec::new() };
    let ([low, high], axis) = (outline.bounds(), warp_axis(ply));
    let mut lines: Vec<Vec<[f64; 2]>> = Vec::new();
    for n in 0..YARNS[0] {
        let mut line = Vec::new();
        for k in 0..=YARNS[1] {
            let share = [k as f64 / YARNS[1] as f64, (n as f64 + 0.5) / YARNS[0] as f64];
            let mut uv = [0.0; 2];
            for (along, share) in [(axis, share[0]), (1 - axis, share[1])] {
                uv[along] = low[along] + share * (high[along] - low[along]);
            }
            match net.place(mold, uv).filter(|_| outline.depth(uv) >= -1e-9 * (high[0] - low[0])) {
                Some([x, y, _]) => line.push([x, y]),
                None => lines.push(std::mem::take(&mut line)),
            }
        }
        lines.push(line);
    }
    lines.retain(|line| line.len() > 1);
    lines
}
