//! The last move: what little the ply lies too loose beside the grippers is pulled out along the mold.
//!
//! What has landed stays, so the fabric between a gripper and the last point that touched keeps what errors
//! the landing has left, a few hundredths of a millimetre. A gripper may end as far from its target as
//! `limits.landing_gripper`; within a part of that it takes the slack out: least squares of the ways, rests
//! that would be slack pulled to a little beyond their length, none pulled beyond its limit.

use super::step::wanted_stretch;
use crate::draping::spans::{Point, Shape};
use crate::draping::{Draping, lying_segments, misfit};
use crate::mold::SurfaceCurve;
use crate::mold::vector::{along, norm, sub, unit};
use crate::planner::program::{MM, Program};
use crate::scene::Scene;

/// Share of the gripper's landing error that the last move may use.
const SHARE: f64 = 0.5;

/// Pull to which a slack rest is drawn, as a share of the whole edge.
const PULL: f64 = 2e-5;

/// Share of the overstretch that the last move may use.
const STRETCH: f64 = 0.8;

/// Weight of a rest's length over that of a gripper's way.
const FIRM: f64 = 1e3;

/// Rests shorter than this share of their edge have no slack worth a name.
const CRUMB: f64 = 1e-2;

/// Rounds in which rests that have become slack are added.
const ROUNDS: usize = 6;

/// A rest of an edge that lies, between the grippers that hold it.
struct Rest {
    /// Path beyond its fabric (m); negative is slack.
    pull: f64,
    /// What it should be (m).
    wanted: f64,
    /// Fabric length (m), and that of the whole edge.
    length: f64,
    whole: f64,
    /// Its grippers, each with the direction in which it pulls.
    grippers: Vec<(usize, [f64; 3])>,
}

impl Rest {
    /// Whether slack here counts.
    fn counts(&self) -> bool {
        self.length > CRUMB * self.whole
    }

    fn pull_after(&self, moves: &[f64]) -> f64 {
        let pull = |(gripper, way): &(usize, [f64; 3])| {
            (0..3).map(|n| way[n] * moves[3 * gripper + n] / MM).sum::<f64>()
        };
        self.pull + self.grippers.iter().map(pull).sum::<f64>()
    }
}

/// Direction out of a line at one of its ends.
fn outward(line: &SurfaceCurve, end: usize) -> Option<[f64; 3]> {
    let (points, last) = (&line.points, line.points.len() - 1);
    match end {
        0 => unit(sub(points[0], *points.get(1)?)),
        _ => unit(sub(points[last], points[last.checked_sub(1)?])),
    }
}

fn rests(scene: &Scene, draping: &Draping, shape: &Shape) -> Vec<Rest> {
    let (ply, grid) = (&scene.ply, scene.ply.grid);
    let mut out = Vec::new();
    let Some(mold) = &scene.mold else {
        return out;
    };
    for (n, contact) in draping.contacts.iter().enumerate().take(grid.edges()) {
        let Some(contact) = contact else { continue };
        let c = grid.catenary(n);
        let ids = [c.from, c.to].map(|g| grid.index(g));
        let ends = ids.map(|g| draping.positions[g]);
        for rest in lying_segments(n, contact, ends, mold, scene.settings.contact.tolerance) {
            let held: &[usize] = match rest.which {
                None => &[0, 1],
                Some(0) => &[0],
                Some(_) => &[1],
            };
            out.push(Rest {
                pull: rest.misfit.path - rest.misfit.length,
                wanted: PULL * ply.flat_length(c.kind),
                length: rest.misfit.length,
                whole: ply.flat_length(c.kind),
                grippers: held
                    .iter()
                    .filter_map(|&end| {
                        // behind the contact, the way grows back over it
                        let sense = if rest.misfit.path < 0.0 { -1.0 } else { 1.0 };
                        Some((ids[end], outward(&rest.line, end)?.map(|c| sense * c)))
                    })
                    .collect(),
            });
        }
    }
    // crumbs that hang beside a gripper, and what bridges a hollow
    for span in shape.spans.iter().filter(|span| span.catenary < grid.edges()) {
        let c = grid.catenary(span.catenary);
        let (Some(_), Some(way)) =
            (&draping.contacts[span.catenary], unit(sub(span.ends[1], span.ends[0])))
        else {
            continue;
        };
        let (gripper, way) = match span.segment {
            0 => (grid.index(c.from), way.map(|x| -x)),
            _ => (grid.index(c.to), way),
        };
        out.push(Rest {
            pull: -misfit(span, draping.contacts[span.catenary].as_ref()).excess(),
            wanted: wanted_stretch(scene, span),
            length: span.length,
            whole: ply.flat_length(c.kind),
            grippers: vec![(gripper, way)],
        });
    }
    out
}

/// Where the grippers (m) of a ply that lies take out its slack; none where it has none that matters.
pub fn settled(
    scene: &Scene,
    draping: &Draping,
    shape: &Shape,
    targets: &[Point],
) -> Option<Vec<Point>> {
    let (mold, limits) = (scene.mold.as_ref()?, &scene.limits);
    let rests = rests(scene, draping, shape);
    let slack =
        |rest: &Rest| rest.counts() && -rest.pull > SHARE * limits.slack_ratio * rest.length;
    if !rests.iter().any(slack) {
        return None;
    }
    let count = targets.len();
    let mut active: Vec<bool> = rests.iter().map(slack).collect();
    let mut moves = Vec::new();
    for _ in 0..ROUNDS {
        let mut program = Program::new(count);
        for (gripper, target) in targets.iter().enumerate() {
            let way = sub(*target, draping.positions[gripper]);
            for n in 0..3 {
                program.near(1.0, 3 * gripper + n, MM * way[n]);
            }
            let radius = MM * SHARE * limits.landing_gripper;
            program.cone(vec![(gripper, 1.0)], way.map(|c| -MM * c), radius + MM * norm(way));
        }
        for (rest, active) in rests.iter().zip(&active) {
            let mut gradient = vec![0.0; 3 * count];
            for (gripper, way) in &rest.grippers {
                for n in 0..3 {
                    gradient[3 * gripper + n] += way[n];
                }
            }
            if *active {
                program.square(FIRM, MM * (rest.pull - rest.wanted), &gradient);
            }
            let most = (STRETCH * limits.overstretch * rest.whole).max(rest.pull);
            program.at_most(&gradient, 1.0, MM * (most - rest.pull));
        }
        moves = program.solve()?;
        let mut changed = false;
        for (rest, active) in rests.iter().zip(&mut active) {
            let slack = rest.counts() && rest.pull_after(&moves) < 0.0;
            changed |= slack && !*active;
            *active |= slack;
        }
        if !changed {
            break;
        }
    }
    let place = |gripper: usize| {
        let way = [0, 1, 2].map(|n| moves[3 * gripper + n]);
        mold.closest_point(along(draping.positions[gripper], 1.0 / MM, way)).point
    };
    Some((0..count).map(place).collect())
}
