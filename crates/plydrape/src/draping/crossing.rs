//! Where the two diagonals of a cell miss each other, the lower one is drawn through the higher.
//!
//! Post-processing as in the paper (section 2.2): the lower diagonal is split in two half spans that
//! meet on the higher one. It changes the surface shown, not the solve.

use super::spans::{FreeSpan, Point};
use super::tuning::TUNING;
use crate::catenary::{EndCondition, Profile, Span};
use crate::ply::ContactSegment;
use crate::scene::Scene;
use std::sync::OnceLock;

/// Points of a span in a record.
pub const STATIONS: usize = 11;

/// The points of a span as it hangs (m).
pub fn hanging(span: &FreeSpan) -> Vec<Point> {
    (0..STATIONS).map(|n| span.point(n as f64 / (STATIONS - 1) as f64)).collect()
}

/// For each cell whose diagonals hang whole and miss each other: the lower one's index among `spans`
/// (which are in the order of catenaries) and its points (m), drawn through the higher one.
pub fn lowered(
    scene: &Scene,
    spans: &[FreeSpan],
    contacts: &[Option<ContactSegment>],
) -> Vec<(usize, Vec<Point>)> {
    let grid = scene.ply.grid;
    let mut out = Vec::new();
    for rising in (grid.edges()..grid.catenaries()).step_by(2) {
        if contacts[rising].is_some() || contacts[rising + 1].is_some() {
            continue;
        }
        let n = spans.partition_point(|span| span.catenary < rising);
        let [a, b] = [&spans[n], &spans[n + 1]];
        let Some([t, s]) = crossing(a, b) else {
            continue;
        };
        let (high, low) = (a.point(t), b.point(s));
        if high[2] < low[2] {
            out.push((n, through(scene, a, t, low)));
        } else {
            out.push((n + 1, through(scene, b, s, high)));
        }
    }
    out
}

/// Where two spans cross in plan, as fractions of their runs; none if they do not.
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

/// The points of a span split at a fraction `at` of its run and hung up there at `meet`.
fn through(scene: &Scene, span: &FreeSpan, at: f64, meet: Point) -> Vec<Point> {
    let lengths = [span.arc(at), span.length - span.arc(at)];
    let section = scene.ply.line(scene.ply.grid.catenary(span.catenary).kind);
    let halves = [0, 1].map(|n| {
        let ends = if n == 0 { [span.ends[0], meet] } else { [meet, span.ends[1]] };
        let mut half = FreeSpan {
            ends,
            length: lengths[n],
            profile: None,
            curve: OnceLock::new(),
            ..span.clone()
        };
        let mut hold = [EndCondition::Free; 2];
        if span.prescribed[n] {
            hold[n] = EndCondition::Slope(span.slopes[n]);
        }
        let problem = Span {
            run: half.run(),
            rise: ends[1][2] - ends[0][2],
            length: lengths[n],
            ends: hold,
            weight: section.mass * scene.settings.gravity,
            flexural_rigidity: section.flexural_rigidity,
            axial_stiffness: scene.settings.axial_stiffness,
        };
        if span.profile.is_some() {
            half.profile = problem.solve(None).force.map(|force| Profile::new(&problem, force));
        }
        half
    });
    (0..STATIONS)
        .map(|n| {
            let t = n as f64 / (STATIONS - 1) as f64;
            if t <= at { halves[0].point(t / at) } else { halves[1].point((t - at) / (1.0 - at)) }
        })
        .collect()
}
