//! The last moves: the grippers remove the slack of free segments beside them.
//!
//! Contacts stay, so the fabric between a gripper and the contact next to it keeps the position errors of the
//! landing, a few hundredths of a millimeter. A gripper may end as far from its target as
//! [`super::Limits::landing_gripper`]; within a share of that it removes the slack: least squares of the moves, with segments
//! that would be slack stretched a little beyond their length, and none stretched beyond its limit.

use super::Task;
use super::program::Program;
use super::step::target_stretch;
use super::tuning::TUNING;
use crate::draping::spans::{Equilibrium, Point};
use crate::draping::{Draping, lying_segments, misfit};
use crate::geometry::vector::{along, direction, norm, sub};
use crate::mold::SurfaceCurve;
use crate::sensitivity::Row;

/// A free segment of an edge in contact, or a whole edge that lies, with the grippers that hold it.
struct FreeSegment {
    /// Path minus fabric length (m); negative is slack.
    stretch: f64,
    /// The stretch that it should have (m).
    target: f64,
    /// Fabric length (m), and that of the whole edge.
    length: f64,
    whole: f64,
    /// Grippers, each with the direction in which it stretches the segment.
    grippers: Vec<(usize, [f64; 3])>,
}

impl FreeSegment {
    /// Whether its slack counts.
    fn counts(&self) -> bool {
        self.length > TUNING.slack.short * self.whole
    }

    /// Stretch (m) after moves (m) of all grippers.
    fn stretch_after(&self, moves: &[f64]) -> f64 {
        let stretch = |(gripper, way): &(usize, [f64; 3])| {
            (0..3).map(|n| way[n] * moves[3 * gripper + n]).sum::<f64>()
        };
        self.stretch + self.grippers.iter().map(stretch).sum::<f64>()
    }
}

/// Direction out of a line at one of its ends; `None` where its points there are nearer than `least` (m), which is rounding.
fn outward(line: &SurfaceCurve, end: usize, least: f64) -> Option<[f64; 3]> {
    let (points, last) = (&line.points, line.points.len() - 1);
    let way = match end {
        0 => sub(points[0], *points.get(1)?),
        _ => sub(points[last], points[last.checked_sub(1)?]),
    };
    direction(way).filter(|_| norm(way) > least)
}

fn free_segments(task: &Task, draping: &Draping, shape: &Equilibrium) -> Vec<FreeSegment> {
    let (ply, lines) = (&task.layup.ply, task.layup.ply.lines());
    let flat_length = |n: usize| lines.flat_length(n, ply.length_factor);
    let mut out = Vec::new();
    let Some(mold) = &task.layup.mold else {
        return out;
    };
    for (n, contact) in draping.contacts.iter().enumerate().take(lines.edges()) {
        let Some(contact) = contact else { continue };
        let ids = lines.ends(n);
        let ends = ids.map(|g| draping.positions[g]);
        for segment in lying_segments(n, contact, ends, mold, task.layup.settings.contact.tolerance)
        {
            let held: &[usize] = match segment.which {
                None => &[0, 1],
                Some(0) => &[0],
                Some(_) => &[1],
            };
            let least = TUNING.slack.shortest * flat_length(n);
            out.push(FreeSegment {
                stretch: segment.misfit.path - segment.misfit.length,
                target: TUNING.slack.target_stretch * flat_length(n),
                length: segment.misfit.length,
                whole: flat_length(n),
                grippers: held
                    .iter()
                    .filter_map(|&end| {
                        // behind the contact, the path grows back over it
                        let sense = if segment.misfit.path < 0.0 { -1.0 } else { 1.0 };
                        Some((ids[end], outward(&segment.line, end, least)?.map(|c| sense * c)))
                    })
                    .collect(),
            });
        }
    }
    // segments that hang beside a gripper, and spans that bridge a hollow
    for span in shape.spans.iter().filter(|span| span.catenary < lines.edges()) {
        let (Some(_), Some(way)) =
            (&draping.contacts[span.catenary], direction(sub(span.ends[1], span.ends[0])))
        else {
            continue;
        };
        let (gripper, way) = match span.segment {
            0 => (lines.ends(span.catenary)[0], way.map(|x| -x)),
            _ => (lines.ends(span.catenary)[1], way),
        };
        out.push(FreeSegment {
            stretch: -misfit(span, draping.contacts[span.catenary].as_ref()).excess(),
            target: target_stretch(task, span),
            length: span.length,
            whole: flat_length(span.catenary),
            grippers: vec![(gripper, way)],
        });
    }
    out
}

/// Positions of the grippers (m) at which the ply has no slack; `None` where it has no slack that counts already.
pub fn removal(
    task: &Task,
    draping: &Draping,
    shape: &Equilibrium,
    targets: &[Point],
) -> Option<Vec<Point>> {
    // nothing is to be done unless some free segment has slack that counts
    let (mold, limits) = (task.layup.mold.as_ref()?, &task.limits);
    let segments = free_segments(task, draping, shape);
    let slack = |segment: &FreeSegment| {
        segment.counts()
            && -segment.stretch > TUNING.slack.share * limits.slack_ratio * segment.length
    };
    if !segments.iter().any(slack) {
        return None;
    }

    // segments whose stretch is driven to its target; more join them while moves give them slack
    let count = targets.len();
    let mut active: Vec<bool> = segments.iter().map(slack).collect();
    let mut moves = Vec::new();

    for _ in 0..TUNING.slack.rounds {
        let mut program = Program::new(&task.layup.ply, count);
        let scale = program.scale;

        // grippers go toward their targets, or away from them by a share of the limit at most
        for (gripper, target) in targets.iter().enumerate() {
            let way = sub(*target, draping.positions[gripper]);
            for n in 0..3 {
                program.near(1.0, 3 * gripper + n, scale * way[n]);
            }
            let radius = scale * TUNING.slack.share * limits.landing_gripper;
            program.cone(vec![(gripper, 1.0)], way.map(|c| -scale * c), radius + scale * norm(way));
        }

        // slack segments become taut, and no segment is overstretched
        for (segment, active) in segments.iter().zip(&active) {
            let mut gradient = Row::default();
            for (gripper, way) in &segment.grippers {
                gradient.add_from(3 * gripper, 1.0, *way);
            }
            if *active {
                program.square(
                    TUNING.slack.weight,
                    scale * (segment.stretch - segment.target),
                    &gradient,
                );
            }
            let most = (TUNING.slack.stretch_share * limits.overstretch * segment.whole)
                .max(segment.stretch);
            program.at_most(&gradient, 1.0, scale * (most - segment.stretch));
        }

        moves = program.solve()?;
        moves.iter_mut().for_each(|x| *x /= scale);

        // segments that become slack by the moves take part in the next round
        let mut changed = false;
        for (segment, active) in segments.iter().zip(&mut active) {
            let slack = segment.counts() && segment.stretch_after(&moves) < 0.0;
            changed |= slack && !*active;
            *active |= slack;
        }
        if !changed {
            break;
        }
    }

    // the new positions, on the mold
    let place = |gripper: usize| {
        let way = [0, 1, 2].map(|n| moves[3 * gripper + n]);
        mold.closest_point(along(draping.positions[gripper], 1.0, way)).point
    };
    Some((0..count).map(place).collect())
}
