//! The least time of a planned motion: its time-optimal law under the limits of grippers, joints and tool.

use super::record::LimitedBy;
use super::tuning::TUNING;
use crate::geometry::vector::sub;
use crate::measure::Name;
use crate::measure::tilt_rate::turn;
use crate::motion::{Limiting, Moving, Quickening, TimedMotion};
use crate::outcome::{Drape, Step, Turns};
use crate::scene::Scene;
use crate::tool::Tool;

/// A motion with the least time that was found, and what limits it.
pub(super) struct Quickest {
    /// The motion.
    pub motion: TimedMotion,
    /// What limits the time of the motion; what does for the longest comes first.
    pub limited_by: Vec<LimitedBy>,
}

/// Something that moves, with the measures of its derivatives, and which gripper it is of.
struct Limited {
    moving: Moving,
    names: [Name; 3],
    gripper: Option<usize>,
}

/// The quickest motion along the path of a motion, with the drape along that. `cells` are how far grippers turn in cells with errors, and how many
/// times slower the motion must be for these as a whole.
pub(super) fn quickest(
    scene: &Scene,
    motion: &TimedMotion,
    drape: &Drape,
    cells: Option<(&Turns, f64)>,
) -> Quickest {
    // first so slow as a whole that all limits are kept
    let fastest = drape.summary.worst.value(Name::TiltRate).unwrap_or(0.0);
    let turned = TUNING.sampled_margin * fastest / scene.limits.most(Name::TiltRate).to_degrees();
    let carried = tool_stretch(scene, motion);
    let (turns, in_cells) = cells.unzip();
    let slowed = turned.max(carried).max(in_cells.unwrap_or(1.0)).max(1.0);
    let motion = if slowed > 1.0 { motion.slowed(slowed) } else { motion.clone() };
    let Some(mut course) = Quickening::new(&motion) else {
        return Quickest { motion, limited_by: Vec::new() };
    };

    let bounds = scene.limits.motion_bounds();
    let transport = scene.limits.transport_bounds();
    let until = motion.times()[drape.summary.last_free(motion.times().len())];
    if let (Some(transport), true) = (transport, until > 0.0) {
        course = course.with_early(until, transport);
    }
    let mut limited: Vec<Limited> = Vec::new();
    for (gripper, moving) in course.grippers(&bounds).into_iter().enumerate() {
        let names = [Name::Speed, Name::Acceleration, Name::Jerk];
        limited.push(Limited { moving, names, gripper: Some(gripper) });
    }
    limited.extend(tilting(scene, &course, &drape.steps, turns, slowed));
    if let Some(tool) = &scene.layup.tool {
        limited.extend(carrying(tool, &motion, &course));
    }
    let moving: Vec<Moving> = limited.iter().map(|limited| limited.moving.clone()).collect();
    let (mut quickest, limiting) = course.quickest(&bounds, &moving);
    // a tool is looked at between the samples of the written motion: what the course did not see there takes longer
    let longer = tool_stretch(scene, &quickest);
    if longer > 1.0 {
        quickest = quickest.slowed(longer);
    }
    Quickest { limited_by: by_name(scene, &limited, &limiting, longer.max(1.0)), motion: quickest }
}

/// How many times longer a motion must take for its tool to keep its limits; at most 1 if it does.
pub(super) fn tool_stretch(scene: &Scene, motion: &TimedMotion) -> f64 {
    let peaks = scene.layup.tool.as_ref().and_then(|tool| {
        Some((tool, tool.peaks(motion, motion.fitting_rate(scene.plan.rate)).ok()?))
    });
    peaks.map_or(0.0, |(tool, peaks)| {
        let stretch = peaks.stretch(tool);
        if stretch > 1.0 { TUNING.sampled_margin * stretch } else { stretch }
    })
}

/// How far the normal of a gripper turns from one step to the next (rad), in the drape or in cells with errors.
fn turn_of([from, to]: [&Step; 2], gripper: usize, cells: Option<&Turns>) -> f64 {
    let [a, b] = [from, to].map(|step| step.grippers[gripper].quaternion);
    turn(a, b).max(cells.map_or(0.0, |turns| turns.of(from.step, gripper)))
}

/// The tilts of the grippers, which turn evenly from step to step of a motion that is this much slower than these steps say, and as fast as the
/// fastest of some cells with errors.
fn tilting(
    scene: &Scene,
    course: &Quickening,
    steps: &[Step],
    cells: Option<&Turns>,
    slowed: f64,
) -> Vec<Limited> {
    let bound = scene.limits.most(Name::TiltRate) / TUNING.sampled_margin;
    let tilts_of = |gripper: usize| {
        let rates = course.times().iter().map(|t| {
            let after = steps.partition_point(|step| step.time * slowed <= *t);
            let pair = after.checked_sub(1).and_then(|before| steps.get(before..=after));
            let rate = pair.map_or(0.0, |pair| {
                let turn = turn_of([&pair[0], &pair[1]], gripper, cells);
                turn / (slowed * (pair[1].time - pair[0].time))
            });
            [[rate, 0.0, 0.0], [0.0; 3], [0.0; 3]]
        });
        Limited {
            moving: Moving {
                rates: rates.collect(),
                bounds: [bound, f64::INFINITY, f64::INFINITY],
                early: None,
            },
            names: [Name::TiltRate; 3],
            gripper: Some(gripper),
        }
    };
    (0..steps.first().map_or(0, |step| step.grippers.len())).map(tilts_of).collect()
}

/// The frame of a tool, and its axes.
fn carrying(tool: &Tool, motion: &TimedMotion, course: &Quickening) -> Vec<Limited> {
    // differences over half of the smallest distance of times, such that no two overlap
    let times = course.times();
    let apart = times.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let step = 0.5 * apart;
    let postures: Vec<_> = times
        .iter()
        .map(|t| [t - step, *t, t + step].map(|t| tool.posture(&motion.at(t))))
        .collect();
    // angular speed and acceleration of the frame, by differences of its turns
    let frame = postures.iter().map(|[before, here, after]| {
        let [first, last] = [
            crate::tool::turn_between(&before.frame.axes, &here.frame.axes),
            crate::tool::turn_between(&here.frame.axes, &after.frame.axes),
        ];
        let rate = [0, 1, 2].map(|c| (first[c] + last[c]) / (2.0 * step));
        let gain = sub(last, first).map(|c| c / (step * step));
        [rate, gain, [0.0; 3]]
    });
    let mut limited = vec![Limited {
        moving: Moving {
            rates: frame.collect(),
            bounds: [tool.turn_rate, tool.turn_acceleration, f64::INFINITY],
            early: None,
        },
        names: [Name::ToolTurnRate, Name::ToolTurnAcceleration, Name::ToolTurnAcceleration],
        gripper: None,
    }];
    // the speed of every axis at every gripper; its acceleration has no limit of its own
    for (n, axis) in tool.axes.iter().enumerate() {
        for gripper in 0..tool.mounts.len() {
            let rates = postures.iter().map(|[before, _, after]| {
                let moved = after.strokes[gripper][n] - before.strokes[gripper][n];
                [[moved / (2.0 * step), 0.0, 0.0], [0.0; 3], [0.0; 3]]
            });
            limited.push(Limited {
                moving: Moving {
                    rates: rates.collect(),
                    bounds: [axis.speed, f64::INFINITY, f64::INFINITY],
                    early: None,
                },
                names: [Name::AxisSpeed; 3],
                gripper: Some(gripper),
            });
        }
    }
    limited
}

/// For how long each measure limits a motion that is this much longer.
fn by_name(
    scene: &Scene,
    limited: &[Limited],
    limiting: &[Limiting],
    longer: f64,
) -> Vec<LimitedBy> {
    let mut parts: Vec<((Name, Option<usize>), f64)> = Vec::new();
    for Limiting { time, moving, order, share, early } in limiting {
        if *share <= 0.0 {
            continue;
        }
        let Limited { names, gripper, .. } = &limited[*moving];
        // the transport has a limit of its own where the scene gives one
        let own = match names[*order] {
            Name::Speed => Name::TransportSpeed,
            Name::Acceleration => Name::TransportAcceleration,
            Name::Jerk => Name::TransportJerk,
            other => other,
        };
        let is_own = *early && scene.limits.get(own).is_some();
        let key = (if is_own { own } else { names[*order] }, *gripper);
        match parts.iter_mut().find(|(other, _)| *other == key) {
            Some((_, sum)) => *sum += longer * time,
            None => parts.push((key, longer * time)),
        }
    }
    // the first of a name is the gripper with the longest time
    parts.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    let mut found: Vec<LimitedBy> = Vec::new();
    for ((name, gripper), time_s) in parts {
        match found.iter_mut().find(|limited| limited.name == name) {
            Some(limited) => limited.time_s += time_s,
            None => {
                let gripper = gripper.map(|n| scene.layup.ply.id(n));
                found.push(LimitedBy { name, time_s, gripper });
            }
        }
    }
    found.sort_by(|a, b| b.time_s.total_cmp(&a.time_s).then(a.name.cmp(&b.name)));
    found
}
