//! The variables that a template sees. All lengths are in meters, times in seconds and angles in radians; filters change units.

use super::blocks::{Block, Blocks, Passed};
use super::names;
use super::pose::{angle, euler_zyx, quaternion, rotation_vector};
use super::sampling::Track;
use super::template::Robot;
use super::{EventKind, Program, cam};
use plydrape::arm::Angles;
use plydrape::geometry::Pose;
use plydrape::geometry::vector::{distance, norm, sub};
use plydrape::ply::gripper_name;
use plydrape::tool::turn_between;
use serde::Serialize;
use std::f64::consts::FRAC_PI_2;

/// Everything.
#[derive(Debug, Serialize)]
pub(super) struct Context {
    /// This program and its version.
    pub program: &'static str,
    /// The scene's title, in ASCII.
    pub title: String,
    /// The title as a name that every controller takes.
    pub name: String,
    /// The name of this file's program: `name`, or of several parts `name_1` and so on.
    pub part: String,
    /// The names of all parts.
    pub parts: Vec<String>,
    /// Whether this is the first part, which begins, and the last one, which ends.
    pub first: bool,
    pub last: bool,
    pub accepted: bool,
    /// The verdict, in ASCII.
    pub verdict: String,
    /// What the head of the file shall say, line by line, in ASCII.
    pub head: Vec<String>,
    pub duration: f64,
    pub mold: PoseOf,
    pub tool: PoseOf,
    /// The external axes that this program moves: those of the array, or the progress of the motion.
    pub axes: Vec<AxisOf>,
    /// Whether another controller moves the axes of the array, as a cam of the progress.
    pub separate_axes: bool,
    /// The signal that starts them.
    pub start_output: usize,
    /// The vacuum of each gripper.
    pub grippers: Vec<Signal>,
    /// How long the program waits for each vacuum at the grip (s); 0 if it does not.
    pub vacuum_timeout: f64,
    /// Largest speed of the tool's center (m/s).
    pub speed: f64,
    /// Largest rate of turning (rad/s).
    pub turn_rate: f64,
    /// Largest acceleration of the tool's center (m/s²).
    pub acceleration: f64,
    /// Largest angular acceleration (rad/s²).
    pub turn_acceleration: f64,
    pub start: BlockOf,
    pub blocks: Vec<BlockOf>,
}

/// A pose in every form.
#[derive(Debug, Serialize)]
pub(super) struct PoseOf {
    pub position: [f64; 3],
    /// x, y, z, w.
    pub quaternion: [f64; 4],
    /// About z, the new y, the new x.
    pub euler_zyx: [f64; 3],
    pub rotation_vector: [f64; 3],
}

impl PoseOf {
    fn new(pose: &Pose) -> Self {
        PoseOf {
            position: pose.position,
            quaternion: quaternion(pose),
            euler_zyx: euler_zyx(pose),
            rotation_vector: rotation_vector(pose),
        }
    }
}

#[derive(Debug, Serialize)]
pub(super) struct AxisOf {
    pub name: String,
    pub gripper: String,
    pub stroke: Option<[f64; 2]>,
    pub speed: f64,
}

/// The vacuum of a gripper.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Signal {
    /// The gripper, `g2_0`.
    pub gripper: String,
    /// Number of its output.
    pub output: usize,
    /// Number of the input that says that its vacuum is there.
    pub input: usize,
}

#[derive(Debug, Serialize)]
pub(super) struct EventOf {
    pub kind: EventKind,
    pub time: f64,
    pub grippers: Vec<Signal>,
}

#[derive(Debug, Serialize)]
pub(super) struct BlockOf {
    pub points: Vec<PointOf>,
    pub duration: f64,
    pub events: Vec<EventOf>,
    pub wait: f64,
}

#[derive(Debug, Serialize)]
pub(super) struct PointOf {
    /// Counts through the file from 1.
    pub number: usize,
    pub time: f64,
    pub duration: f64,
    /// The share of its block's duration.
    pub share: f64,
    #[serde(flatten)]
    pub pose: PoseOf,
    /// Angles of the joints of the arm; empty where it is not known.
    pub joints: Vec<f64>,
    /// The configuration for RAPID: the quarter turns of axes 1, 4 and 6, and cfx. Zeros where the arm is not known.
    pub conf: [i32; 4],
    /// The configuration for KRL: S and T.
    pub status: [u32; 2],
    /// Values of the external axes; of the progress where another controller follows it, which ends at 1 m.
    pub axes: Vec<f64>,
    /// The share of the motion that is behind it, from 0 to 1, without the time in which everything rests.
    pub progress: f64,
    /// Mean speeds on the way here: of the center, of turning, of the fastest axis.
    pub speed: f64,
    pub turn_rate: f64,
    pub axis_speed: f64,
    /// Radius of the zone.
    pub radius: f64,
    /// Whether the cell stops here.
    pub stop: bool,
}

/// The contexts of all parts of a program.
pub(super) fn contexts(track: &Track, blocks: &Blocks, robot: Robot) -> Vec<Context> {
    let program = track.program;
    let limits = robot.limits();
    let name = names::name(&program.name, program.book_ply.as_ref());
    let split = blocks.parts(limits.points);
    let parts: Vec<String> = match split.len() {
        1 => vec![name.clone()],
        many => (1..=many).map(|n| format!("{name}_{n}")).collect(),
    };
    let separate = !track.moves_axes;
    let grippers: Vec<Signal> = program
        .grippers()
        .into_iter()
        .enumerate()
        .map(|(n, gripper)| Signal {
            gripper,
            output: n + limits.first_output,
            // the first one is array_ready
            input: n + limits.first_output + 1,
        })
        .collect();
    let maker = Maker { track, grippers: &grippers, interpolates: limits.axes > 0 };
    let [acceleration, turn_acceleration] = accelerations(track);

    let mut from = 0;
    let mut contexts: Vec<Context> = Vec::with_capacity(split.len());
    for (n, part) in split.iter().enumerate() {
        let mut number = 1;
        // each part begins where the one before ends
        let start = match n {
            0 => blocks.start.clone(),
            _ => Block::default(),
        };
        let beginning = Passed { sample: from, duration: 0.0, radius: 0.0 };
        let mut start = maker.block(&start, &mut from, &mut number);
        let mut first = from;
        start.points.push(maker.point(&beginning, &mut first, 1, 0.0));
        let of_part: Vec<BlockOf> =
            part.iter().map(|block| maker.block(block, &mut from, &mut number)).collect();
        contexts.push(Context {
            program: crate::PROGRAM,
            title: ascii(&program.name),
            name: name.clone(),
            part: parts[n].clone(),
            first: n == 0,
            last: n + 1 == split.len(),
            parts: parts.clone(),
            accepted: program.accepted,
            verdict: ascii(&program.verdict),
            head: head(track, blocks, robot, [n, split.len()], [&name, &parts[n]]),
            duration: program.times.last().copied().unwrap_or_default(),
            mold: PoseOf::new(&program.frames.mold),
            tool: PoseOf::new(&program.frames.tool),
            axes: match separate {
                false => program.axes.iter().map(axis).collect(),
                true if limits.axes > 0 => vec![progress()],
                true => Vec::new(),
            },
            separate_axes: separate,
            start_output: limits.first_output + grippers.len(),
            grippers: grippers.clone(),
            vacuum_timeout: program.vacuum_timeout.unwrap_or(0.0),
            speed: 0.0,
            turn_rate: 0.0,
            acceleration,
            turn_acceleration,
            start,
            blocks: of_part,
        });
    }
    let points = || contexts.iter().flat_map(|c| &c.blocks).flat_map(|b| &b.points);
    let speed = points().map(|point| point.speed).fold(0.0, f64::max);
    let turn_rate = points().map(|point| point.turn_rate).fold(0.0, f64::max);
    // the progress is as fast as it is on the fastest way
    let fastest = points().map(|point| point.axis_speed).fold(0.0, f64::max);
    for context in &mut contexts {
        (context.speed, context.turn_rate) = (speed, turn_rate);
        let virtual_axes = context.axes.iter_mut().filter(|_| separate);
        virtual_axes.for_each(|axis| axis.speed = fastest);
    }
    contexts
}

/// The progress of the motion as an axis, whose speed is not known yet.
fn progress() -> AxisOf {
    let stroke = Some([0.0, cam::LENGTH]);
    AxisOf { name: "progress".into(), gripper: String::new(), stroke, speed: 0.0 }
}

/// The largest acceleration of the center (m/s²) and the largest angular one (rad/s²), by differences between the samples.
fn accelerations(track: &Track) -> [f64; 2] {
    let (Some(center), times) = (&track.center, &track.program.times) else { return [0.0; 2] };
    // velocities from sample to sample, each in the middle
    let moves: Vec<(f64, [f64; 3], [f64; 3])> = (1..times.len())
        .map(|k| {
            let takes = times[k] - times[k - 1];
            let shift = sub(center[k].position, center[k - 1].position);
            let turn = turn_between(&center[k - 1].axes, &center[k].axes);
            (0.5 * (times[k] + times[k - 1]), shift.map(|c| c / takes), turn.map(|c| c / takes))
        })
        .collect();
    let most = |velocity: &dyn Fn(usize) -> [f64; 3]| {
        let gains = (1..moves.len())
            .map(|n| norm(sub(velocity(n), velocity(n - 1))) / (moves[n].0 - moves[n - 1].0));
        gains.fold(0.0, f64::max)
    };
    [most(&|n| moves[n].1), most(&|n| moves[n].2)]
}

fn axis(axis: &super::Axis) -> AxisOf {
    AxisOf {
        name: axis.name.clone(),
        gripper: gripper_name(axis.gripper),
        stroke: axis.stroke,
        speed: axis.speed,
    }
}

/// Makes blocks and points.
struct Maker<'a> {
    track: &'a Track<'a>,
    grippers: &'a [Signal],
    /// Whether the controller moves external axes.
    interpolates: bool,
}

impl Maker<'_> {
    /// A block that begins at the sample `from`, its points numbered behind `number`.
    fn block(&self, block: &Block, from: &mut usize, number: &mut usize) -> BlockOf {
        let duration: f64 = block.points.iter().map(|point| point.duration).sum();
        let points = block.points.iter().map(|point| {
            *number += 1;
            self.point(point, from, *number, point.duration / duration)
        });
        let points = points.collect();
        let event = |n: &usize| {
            let event = &self.track.program.events[*n];
            let names: Vec<String> = event.grippers.iter().map(|id| gripper_name(*id)).collect();
            let known = self.grippers.iter().filter(|signal| names.contains(&signal.gripper));
            EventOf { kind: event.kind, time: event.time, grippers: known.cloned().collect() }
        };
        let events = block.events.iter().map(event).collect();
        BlockOf { points, duration, events, wait: block.wait }
    }

    fn point(&self, passed: &Passed, from: &mut usize, number: usize, share: f64) -> PointOf {
        // the center of the tool at the point before and at this one, and how fast it moves between them
        let Track { program, center, .. } = self.track;
        let (sample, duration) = (passed.sample, passed.duration);
        let pose = |k: usize| center.as_ref().map_or(Pose::ORIGIN, |center| center[k]);
        let [before, now] = [*from, sample].map(pose);
        let rate = |way: f64| if duration > 0.0 { way / duration } else { 0.0 };

        // external axes: those of the array, or the progress that another controller follows
        let axes = |k: usize| -> Vec<f64> {
            match self.track.moves_axes {
                true => program.axes.iter().map(|axis| axis.values[k]).collect(),
                false if self.interpolates => vec![cam::LENGTH * self.track.progress[k]],
                false => Vec::new(),
            }
        };
        let ways = axes(sample).into_iter().zip(axes(*from)).map(|(now, then)| (now - then).abs());
        let farthest = ways.fold(0.0, f64::max);
        *from = sample;

        // the joints of the arm, and the side on which shoulder, elbow and wrist are
        let arm = program.arm.as_ref();
        let angles = arm.map(|joints| joints.angles[sample]);
        let sides = arm.zip(angles).map(|(joints, angles)| joints.arm.sides(&angles));
        PointOf {
            joints: angles.map_or_else(Vec::new, |angles| angles.to_vec()),
            conf: angles.zip(sides).map_or([0; 4], |(angles, sides)| conf(&angles, sides)),
            status: angles.zip(sides).map_or([0; 2], |(angles, sides)| status(&angles, sides)),
            number,
            time: program.times[sample],
            duration,
            share,
            speed: rate(distance(before.position, now.position)),
            turn_rate: rate(angle(&before, &now)),
            axis_speed: rate(farthest),
            pose: PoseOf::new(&now),
            axes: axes(sample),
            progress: self.track.progress[sample],
            radius: passed.radius,
            stop: passed.radius == 0.0,
        }
    }
}

/// The quarter turns in which axes 1, 4 and 6 are, and cfx, whose bits are the shoulder, the elbow and the wrist (ABB, RAPID Instructions, Functions
/// and Data types, `confdata`).
fn conf(angles: &Angles, [behind, bent_back, negative]: [bool; 3]) -> [i32; 4] {
    // rounding at a zero is no quarter turn
    let quarter = |n: usize| ((angles[n] + 1e-9) / FRAC_PI_2).floor() as i32;
    let cfx = 4 * i32::from(behind) + 2 * i32::from(bent_back) + i32::from(negative);
    [quarter(0), quarter(3), quarter(5), cfx]
}

/// S, whose bits are the shoulder, the elbow and the wrist, and T, whose bits are the signs of all axes (KUKA System Software, Operating and
/// Programming Instructions for System Integrators, "Status and Turn").
fn status(angles: &Angles, [behind, bent_back, negative]: [bool; 3]) -> [u32; 2] {
    let status = u32::from(behind) + 2 * u32::from(!bent_back) + 4 * u32::from(negative);
    let turn = angles.iter().enumerate().map(|(n, angle)| u32::from(*angle < -1e-9) << n).sum();
    [status, turn]
}

/// What every file says at its beginning; `names` are those of the program and of this part.
fn head(
    track: &Track,
    blocks: &Blocks,
    robot: Robot,
    [part, parts]: [usize; 2],
    names: [&str; 2],
) -> Vec<String> {
    // name and verdict; the program of a rejected plan says first that it is rejected
    let program = track.program;
    let limits = robot.limits();
    let mut lines = vec![format!("{}, made by {}", program.name, crate::PROGRAM)];
    if !program.accepted {
        lines.push(rejected(program));
    }
    lines.push(format!("Verdict: {}", program.verdict));

    // how long it takes, and how many points are left of the samples
    let parted = match parts {
        1 => String::new(),
        _ => format!(", part {} of {parts}; the robot stops between parts", part + 1),
    };
    lines.push(format!(
        "{:.3} s, {} points of {} samples{parted}",
        program.times.last().copied().unwrap_or_default(),
        blocks.points() + 1,
        program.times.len(),
    ));

    // how far the program may be from the planned motion, in place and in time
    let [passing, timely] = [blocks.passing, blocks.error]
        .map(|off| (off.position * 1e3, off.angle.to_degrees()))
        .map(|(position, angle)| format!("{position:.4} mm and {angle:.4} deg"));
    let path = if limits.splines {
        "A spline through the points, cubic or quintic, passes"
    } else {
        "Straight lines between the points pass"
    };
    lines.push(format!("{path} within {passing} of the motion"));
    lines.push(format!("At its own times it stays within {timely} on straight lines"));
    if let Some(least) = blocks.shortest() {
        lines.push(format!(
            "Points are {least:.4} s apart or more: see whether your controller keeps up"
        ));
    }

    // why the program may be farther from the motion than the tolerance allows
    if blocks.passing.position > blocks.tolerance.position {
        lines.push(format!(
            "That is more than the {:.4} mm asked for, because points are {} mm and {} s apart at least (--least-way, --least-time)",
            1e3 * blocks.tolerance.position,
            1e3 * blocks.tolerance.least_way,
            blocks.tolerance.least_time,
        ));
    }

    // how the robot passes points
    if limits.zones {
        lines.push(format!(
            "Zones pass points at {:.4} mm or less; the robot stops where the vacuum switches",
            blocks.corner * 1e3
        ));
    } else {
        lines.push("The robot stops where the vacuum switches".into());
    }

    // frames and units, in the words of the controller
    let [name, own] = names;
    let named = |pattern: &str| pattern.replace("NAME", name).replace("PART", own);
    lines.push(format!("Frames: world > mold ({}) > tool", named(limits.mold)));
    lines.push(format!("        flange > tool ({})", named(limits.tool)));
    lines.push(limits.units.into());

    // axes of the array: moved with the arm, or by a controller of their own that follows
    match program.axes.len() {
        0 => {}
        _ if track.moves_axes => {
            let names: Vec<_> = program.axes.iter().zip(limits.axis_names).collect();
            let pairs = names.iter().map(|(axis, letter)| format!("{letter} = {}", axis.name));
            lines.push(format!("External axes: {}", pairs.collect::<Vec<_>>().join(", ")));
        }
        count => {
            let most = limits.axes;
            lines.push(format!("The {count} axes of the array are more than the {most} that this controller moves with the arm. Their own controller follows the progress of the motion:"));
            lines.push(format!(
                "{}, from 0 to 1000, by the table {}.",
                limits.progress,
                cam::beside(name)
            ));
            lines.push("So override, stop, resume and emergency stop hold both. array_ready says that the array follows it, at 0.".into());
            lines.push("An array that keeps time by itself: only at full speed, and nothing else; NEVER with a speed below 100 %".into());
        }
    }

    lines.iter().flat_map(|line| wrapped(&ascii(line))).collect()
}

/// Longest line of a head: that of KRL has 471 letters, and a head is there to be read.
const WIDTH: usize = 100;

/// A line in pieces of whole words, those behind the first indented; a word that is longer than a line is cut.
fn wrapped(line: &str) -> Vec<String> {
    let indent = &line[..line.len() - line.trim_start().len()];
    let longest = WIDTH - indent.len().min(WIDTH / 2) - 2;
    let mut lines = vec![String::new()];
    // a head is ASCII, so that every byte is a letter
    let words = line.split_whitespace().flat_map(|word| word.as_bytes().chunks(longest));
    for word in words.map(String::from_utf8_lossy) {
        let last = lines.len() - 1;
        let room = WIDTH.saturating_sub(lines[last].len() + 1);
        match lines[last].is_empty() {
            true => lines[last] = format!("{indent}{word}"),
            false if word.len() <= room => lines[last] += &format!(" {word}"),
            false => lines.push(format!("{indent}  {word}")),
        }
    }
    lines
}

/// What a file of a motion that is not accepted says first.
pub(crate) fn rejected(program: &Program) -> String {
    let verdict = &program.verdict;
    format!("NOT ACCEPTED: {}", verdict.strip_prefix("not accepted ").unwrap_or(verdict))
}

/// A text of printable ASCII, with what comes near to other letters.
pub(super) fn ascii(text: &str) -> String {
    let mut plain = String::with_capacity(text.len());
    for letter in text.chars() {
        match letter {
            ' '..='~' => plain.push(letter),
            '°' => plain.push_str(" deg"),
            'µ' | 'μ' => plain.push('u'),
            '²' => plain.push_str("^2"),
            '³' => plain.push_str("^3"),
            '–' | '—' | '−' => plain.push('-'),
            '×' => plain.push('x'),
            'ä' | 'á' | 'à' | 'â' | 'å' => plain.push('a'),
            'ö' | 'ó' | 'ô' | 'ø' => plain.push('o'),
            'ü' | 'ú' => plain.push('u'),
            'é' | 'è' | 'ê' => plain.push('e'),
            'Ä' | 'Å' => plain.push('A'),
            'Ö' | 'Ø' => plain.push('O'),
            'Ü' => plain.push('U'),
            'É' | 'È' => plain.push('E'),
            'ß' => plain.push_str("ss"),
            '…' => plain.push_str("..."),
            _ if letter.is_whitespace() => plain.push(' '),
            _ => plain.push('?'),
        }
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_is_plain_ascii() {
        assert_eq!(ascii("57.1° – 3 µm² × 2\tü"), "57.1 deg - 3 um^2 x 2 u");
    }
}
