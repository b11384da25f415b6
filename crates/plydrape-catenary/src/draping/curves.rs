//! The curves of a recorded step, made from its forces, slopes and contact.
//!
//! Where the two diagonals of a cell miss each other, the lower one is drawn through the higher: post-processing as in the
//! paper (section 2.2). The lower diagonal is split in two half spans that meet on the higher one. It changes the surface
//! shown, not the solve.

use super::misfit::taut;
use super::record::{CatenaryState, Hold, SpanState};
use super::spans::{FreeSpan, Point};
use super::tuning::TUNING;
use crate::catenary::{EndCondition, Profile, Span, SpanState as Tension};
use crate::geometry::vector::along;
use crate::layup::Settings;
use crate::mold::Mold;
use crate::ply::{Fibers, Lines, Ply};
use std::sync::{Arc, OnceLock};

/// Points of a span in a record.
const STATIONS: usize = 11;

/// The points of a span as it hangs (m).
pub fn hanging(span: &FreeSpan) -> Vec<Point> {
    (0..STATIONS).map(|n| span.point(n as f64 / (STATIONS - 1) as f64)).collect()
}

/// The curves of a recorded step (m): for each of its `catenaries`, one for each of its
/// [`spans`](crate::draping::record::CatenaryState::spans) from its first end to its second. `positions` are those of its grippers (m).
/// Slack of a lying segment is drawn as a ruck; a catenary that lies whole has its curve in its contact and none here.
#[must_use]
pub fn curves(
    ply: &Ply,
    settings: &Settings,
    mold: Option<&Mold>,
    positions: &[Point],
    catenaries: &[CatenaryState],
) -> Vec<Vec<Vec<Point>>> {
    let recorded = Recorded { ply, lines: ply.lines(), settings, positions, catenaries };
    let mut out: Vec<Vec<Vec<Point>>> = Vec::with_capacity(catenaries.len());
    for (n, catenary) in catenaries.iter().enumerate() {
        let curve = |span: &SpanState| match (span.hold, mold) {
            (Hold::Lying, Some(mold)) => recorded.lying(n, span, mold),
            _ => hanging(&recorded.span(n, span)),
        };
        out.push(catenary.spans.iter().map(curve).collect());
    }
    for (n, lower) in recorded.lowered() {
        out[n] = vec![lower];
    }
    out
}

/// The free spans of a recorded step as they hang (m), each with its catenary; none is drawn through another one.
pub fn free_curves(
    ply: &Ply,
    settings: &Settings,
    positions: &[Point],
    catenaries: &[CatenaryState],
) -> Vec<(usize, Vec<Point>)> {
    let recorded = Recorded { ply, lines: ply.lines(), settings, positions, catenaries };
    let mut out = Vec::with_capacity(catenaries.len());
    for (n, catenary) in catenaries.iter().enumerate() {
        let free = catenary.spans.iter().filter(|span| span.hold != Hold::Lying);
        out.extend(free.map(|span| (n, hanging(&recorded.span(n, span)))));
    }
    out
}

/// A step and what its record leaves to the layup.
struct Recorded<'a> {
    ply: &'a Ply,
    lines: Arc<Lines>,
    settings: &'a Settings,
    positions: &'a [Point],
    catenaries: &'a [CatenaryState],
}

impl Recorded<'_> {
    fn grippers(&self, catenary: usize) -> [Point; 2] {
        self.lines.ends(catenary).map(|gripper| self.positions[gripper])
    }

    /// A span that hangs or is straight, as it was solved.
    fn span(&self, n: usize, span: &SpanState) -> FreeSpan {
        let catenary = &self.catenaries[n];
        let [first, second] = self.grippers(n);
        let contact = catenary.contact.as_ref().map(|contact| &contact.points);
        let ends = match (contact, span.segment) {
            (Some(points), 0) => [first, points[0]],
            (Some(points), _) => [points[points.len() - 1], second],
            (None, _) => [first, second],
        };
        let mut free = FreeSpan {
            catenary: n,
            segment: span.segment,
            element: None,
            ends,
            length: span.length,
            start: catenary.arc(span)[0],
            profile: None,
            curve: OnceLock::new(),
            state: Tension::Straight,
            shearing: catenary.shearing,
            force: span.force,
            slopes: span.slopes,
            prescribed: span.prescribed,
        };
        free.profile = span.force.map(|force| Profile::new(&self.problem(&free), force));
        free
    }

    /// The closed form's data of a span between its ends.
    fn problem(&self, span: &FreeSpan) -> Span {
        let line = self.ply.line(self.lines.catenary(span.catenary).kind);
        let end = |n: usize| match span.prescribed[n] {
            true => EndCondition::Slope(span.slopes[n]),
            false => EndCondition::Free,
        };
        Span {
            run: span.run(),
            rise: span.ends[1][2] - span.ends[0][2],
            length: span.length,
            ends: [end(0), end(1)],
            weight: line.mass * self.settings.gravity,
            flexural_rigidity: line.flexural_rigidity,
            axial_stiffness: self.settings.axial_stiffness,
        }
    }

    /// A segment that lies: its slack stands up as a ruck in its middle.
    fn lying(&self, n: usize, span: &SpanState, mold: &Mold) -> Vec<Point> {
        let catenary = &self.catenaries[n];
        let Some(contact) =
            catenary.contact.as_ref().filter(|contact| contact.length() < catenary.length)
        else {
            return Vec::new();
        };
        if span.length <= 0.0 {
            return Vec::new();
        }
        let end = contact.points[if span.segment == 0 { 0 } else { contact.points.len() - 1 }];
        let gripper = self.grippers(n)[span.segment];
        let (line, _) = taut(span.segment, end, gripper, mold, self.settings.contact.tolerance);
        let ruck = span.ruck(self.ply, self.settings.gravity, catenary);
        let station = |n: usize| {
            let s = line.length() * n as f64 / (STATIONS - 1) as f64;
            let place = line.point_at(s);
            let height = ruck.map_or(0.0, |ruck| ruck.height_at(s - 0.5 * line.length()));
            along(place, height, mold.normal(place))
        };
        (0..STATIONS).map(station).collect()
    }

    /// For each cell whose diagonals hang whole and miss each other: the lower one's catenary and its points (m), drawn through
    /// the higher one.
    fn lowered(&self) -> Vec<(usize, Vec<Point>)> {
        let catenaries = self.catenaries;
        let mut out = Vec::new();
        for cell in self.lines.cells().iter().filter(|cell| cell.fibers == Fibers::Sides) {
            let pair = cell.bias.map(|bias| bias.list()[0]);
            let whole = |n: usize| match (&catenaries[n].contact, catenaries[n].spans.as_slice()) {
                (None, [span]) => Some(self.span(n, span)),
                _ => None,
            };
            let [Some(a), Some(b)] = pair.map(whole) else { continue };
            let Some([t, s]) = crossing(&a, &b) else { continue };
            let (high, low) = (a.point(t), b.point(s));
            out.push(match high[2] < low[2] {
                true => (pair[0], self.through(&a, t, low)),
                false => (pair[1], self.through(&b, s, high)),
            });
        }
        out
    }

    /// The points of a span split at a fraction `cut` of its run and hung up there at `meet` (m).
    fn through(&self, span: &FreeSpan, cut: f64, meet: Point) -> Vec<Point> {
        let lengths = [span.arc(cut), span.length - span.arc(cut)];
        let halves = [0, 1].map(|n| {
            let ends = if n == 0 { [span.ends[0], meet] } else { [meet, span.ends[1]] };
            let mut half = FreeSpan {
                ends,
                length: lengths[n],
                profile: None,
                curve: OnceLock::new(),
                ..span.clone()
            };
            // free where they meet
            half.prescribed[1 - n] = false;
            if span.profile.is_some() {
                let problem = self.problem(&half);
                half.profile = problem.solve(None).force.map(|force| Profile::new(&problem, force));
            }
            half
        });
        (0..STATIONS)
            .map(|n| {
                let t = n as f64 / (STATIONS - 1) as f64;
                if t <= cut {
                    halves[0].point(t / cut)
                } else {
                    halves[1].point((t - cut) / (1.0 - cut))
                }
            })
            .collect()
    }
}

/// Where two spans cross in plan, as fractions of their runs; `None` if they do not.
fn crossing(a: &FreeSpan, b: &FreeSpan) -> Option<[f64; 2]> {
    let [p, q] = [a, b].map(|s| s.ends);
    let (u, v) = ([p[1][0] - p[0][0], p[1][1] - p[0][1]], [q[1][0] - q[0][0], q[1][1] - q[0][1]]);
    let w = [q[0][0] - p[0][0], q[0][1] - p[0][1]];
    let determinant = u[1] * v[0] - u[0] * v[1];
    if determinant.abs() <= TUNING.parallel_diagonals * u[0].hypot(u[1]) * v[0].hypot(v[1]) {
        return None;
    }
    let t = (w[1] * v[0] - w[0] * v[1]) / determinant;
    let s = (u[0] * w[1] - u[1] * w[0]) / determinant;
    let inside = |x: f64| x > TUNING.crossing_margin && x < 1.0 - TUNING.crossing_margin;
    (inside(t) && inside(s)).then_some([t, s])
}
