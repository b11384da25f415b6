//! A cell made by hand, and what a reader has played of its program.

use plydrape::geometry::vector::{between, distance, dot, turned};
use plydrape::mold::Pose;
use plydrape::ply::gripper_name;
use plydrape_io::Files;
use plydrape_io::robot::program::sampling::Deviation;
use plydrape_io::robot::program::{Axis, Event, EventKind, Frames, Pad, Program};

/// How long the motion takes (s).
pub const DURATION: f64 = 10.0;
/// The grippers.
pub const IDS: [[usize; 2]; 4] = [[0, 0], [1, 0], [0, 1], [12, 3]];

pub fn product(a: &Pose, b: &Pose) -> Pose {
    Pose { position: a.place(b.position), axes: b.axes.map(|axis| a.turn(axis)) }
}

pub fn inverse(a: &Pose) -> Pose {
    let axes = [0, 1, 2].map(|n| [a.axes[0][n], a.axes[1][n], a.axes[2][n]]);
    let back = Pose { position: [0.0; 3], axes };
    Pose { position: back.place(a.position.map(|x| -x)), axes }
}

/// From 0 to 1 with no speed and no acceleration at either end.
fn smooth(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    x * x * x * (10.0 + x * (6.0 * x - 15.0))
}

/// An arm that carries four grippers along an arc and turns them, with some axes of its own. It rests from 4.5 s to 5 s.
pub fn cell(axes: usize, samples: usize) -> Program {
    let times: Vec<f64> =
        (0..samples).map(|k| DURATION * k as f64 / (samples - 1) as f64).collect();
    let progress = |t: f64| 0.5 * smooth(t / 4.5) + 0.5 * smooth((t - 5.0) / 5.0);
    let flange = |t: f64| {
        let s = progress(t);
        let (sin, cos) = (1.7 * s).sin_cos();
        // beyond half a turn, and over a pole of the angles about z, y and x
        let turn = [2.2 * s, -1.9 * s, 2.9 * s];
        let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        Pose {
            position: [0.6 * cos - 1.0, 0.6 * sin, 0.9 - 0.4 * s],
            axes: unit.map(|e| turned(turn, e)),
        }
    };
    let height = |n: usize, t: f64| 0.05 * (3.0 * progress(t) + n as f64).sin();
    let place = |n: usize| [0.1 * (n % 2) as f64 - 0.05, 0.1 * (n / 2) as f64 - 0.05, 0.12];
    let lean = |t: f64| 0.1 * progress(t);
    let pad = |n: usize, t: f64| {
        let [x, y, z] = place(n);
        let own = if n < axes { height(n, t) } else { 0.0 };
        let tilt = Pose::new([x, y, z + own], [lean(t), 0.0, 0.0]);
        product(&flange(t), &tilt)
    };
    let event = |time, kind, ids: &[[usize; 2]]| Event { time, kind, grippers: ids.to_vec() };
    Program {
        name: "Cell of the tést".into(),
        book_ply: None,
        arm: None,
        accepted: true,
        verdict: "accepted: tilt 12° against 40°".into(),
        flange: Some(times.iter().map(|t| flange(*t)).collect()),
        axes: (0..axes)
            .map(|n| Axis {
                name: format!("{}_z", gripper_name(IDS.get(n).copied().unwrap_or([n, 9]))),
                gripper: IDS.get(n).copied().unwrap_or([n, 9]),
                values: times.iter().map(|t| height(n, *t)).collect(),
                stroke: Some([-0.05, 0.05]),
                speed: 0.2,
            })
            .collect(),
        pads: (0..IDS.len())
            .map(|n| Pad {
                name: gripper_name(IDS[n]),
                poses: times.iter().map(|t| pad(n, *t)).collect(),
                tilts: times.iter().map(|t| lean(*t)).collect(),
            })
            .collect(),
        events: vec![
            event(0.0, EventKind::Grip, &IDS),
            event(4.6, EventKind::Press, &IDS[..1]),
            event(4.8, EventKind::Release, &IDS[..1]),
            // while the arm moves
            event(7.0, EventKind::Release, &IDS[1..2]),
            event(DURATION, EventKind::Release, &IDS[2..]),
        ],
        vacuum_timeout: None,
        frames: Frames {
            mold: Pose::new([1.2, -0.3, 0.4], [0.1, -0.2, 2.5]),
            tool: Pose::new([0.01, -0.02, 0.15], [0.3, 0.2, -0.4]),
        },
        rate: Some((samples - 1) as f64 / DURATION),
        times,
    }
}

/// A program without a release while the arm moves.
pub fn still(program: Program) -> Program {
    let mut events = program.events;
    events[3].time = events[2].time;
    Program { events, ..program }
}

pub fn rejected(program: Program) -> Program {
    let verdict = "tilt 57.1° against 40°".into();
    Program { accepted: false, verdict, ..program }
}

/// A file as text.
pub fn text(files: &Files, n: usize) -> String {
    String::from_utf8(files[n].1.clone()).unwrap()
}

/// The errors in the head of the first file.
pub fn stated(files: &Files) -> Deviation {
    let text = text(files, 0);
    let line = text.lines().find(|line| line.contains("stays within")).unwrap();
    let number = |before: &str, after: &str| -> f64 {
        let (head, _) = line.split_once(after).unwrap();
        head.rsplit_once(before).unwrap().1.trim().parse().unwrap()
    };
    Deviation { position: number("within", "mm") * 1e-3, angle: number("and", "deg").to_radians() }
}

/// A point that a controller goes to, on a straight line.
#[derive(Debug, Clone)]
pub struct Point {
    pub time: f64,
    /// The center of the tool in the frame of the mold.
    pub pose: Pose,
    pub axes: Vec<f64>,
}

/// What a reader has played.
#[derive(Debug, Default)]
pub struct Played {
    pub points: Vec<Point>,
    /// Time, gripper, on or off.
    pub vacuum: Vec<(f64, String, bool)>,
    pub frames: Option<Frames>,
    pub starts_array: bool,
    /// Whether the signal that starts the array was set off at last.
    pub start_is_off: bool,
    /// The largest acceleration of the center (m/s²), where a program limits it.
    pub acceleration: Option<f64>,
}

/// The angle of the turn from one orientation to another (rad), by its trace and its axis.
fn angle(a: &Pose, b: &Pose) -> f64 {
    let turn = |n: usize, m: usize| (0..3).map(|k| a.axes[k][n] * b.axes[k][m]).sum::<f64>();
    let sine = [turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)];
    let cosine = turn(0, 0) + turn(1, 1) + turn(2, 2) - 1.0;
    dot(sine, sine).sqrt().atan2(cosine)
}

/// The turn from one orientation to another (rotation vector, rad).
pub fn turn_from(from: &Pose, to: &Pose) -> [f64; 3] {
    let turn = |n: usize, m: usize| (0..3).map(|k| to.axes[k][n] * from.axes[k][m]).sum::<f64>();
    let axis = [turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1)];
    let length = dot(axis, axis).sqrt();
    let angle = angle(from, to);
    axis.map(|c| if length > 0.0 { c / length * angle } else { 0.0 })
}

/// The pose at a share of the way: the place straight, the orientation about one axis (Rodrigues).
pub fn towards(from: &Pose, to: &Pose, share: f64) -> Pose {
    let vector = turn_from(from, to).map(|c| c * share);
    Pose {
        position: between(from.position, to.position, share),
        axes: from.axes.map(|own| turned(vector, own)),
    }
}

/// Digits of the files: half of the last one of a place (m), and as much of an orientation as nine digits leave (rad).
const ROUNDING: Deviation = Deviation { position: 2e-7, angle: 2e-7 };

impl Played {
    /// The signal that starts the array.
    pub fn start_signal(&mut self, on: bool) {
        self.starts_array |= on;
        self.start_is_off = !on;
    }

    /// Compares with a program at all of its samples.
    pub fn compare(&self, program: &Program, stated: Deviation) {
        let frames = self.frames.expect("frames");
        for (found, due) in [(frames.mold, program.frames.mold), (frames.tool, program.frames.tool)]
        {
            assert!(
                distance(found.position, due.position) < ROUNDING.position,
                "{found:?} {due:?}"
            );
            assert!(angle(&found, &due) < ROUNDING.angle, "{found:?} {due:?}");
        }
        let flange = program.flange.as_ref().unwrap();
        let back = inverse(&frames.tool);
        // half of the last digit of what is stated
        let most = Deviation {
            position: stated.position + 5e-8 + ROUNDING.position,
            angle: stated.angle + 1e-6 + ROUNDING.angle,
        };
        assert!(self.points[0].time == 0.0);
        let last = self.points.last().unwrap();
        // times are rounded to a microsecond a point
        assert!((last.time - DURATION).abs() < 1e-6 * self.points.len() as f64, "{}", last.time);
        for (k, time) in program.times.iter().enumerate() {
            let after =
                self.points.partition_point(|p| p.time < *time).clamp(1, self.points.len() - 1);
            let [from, to] = [&self.points[after - 1], &self.points[after]];
            let span = to.time - from.time;
            let share = if span > 0.0 { ((time - from.time) / span).clamp(0.0, 1.0) } else { 1.0 };
            let center = towards(&from.pose, &to.pose, share);
            let due = product(&flange[k], &program.frames.tool);
            // durations are rounded to half a microsecond, up to a microsecond in blocks, at less than 0.5 m/s
            let slip = 0.5 * 1e-6 * after as f64;
            let off = distance(center.position, due.position);
            assert!(off < most.position + slip, "{off} at {time} s, {most:?}");
            let turn = angle(&product(&center, &back), &flange[k]);
            assert!(turn < most.angle + 10.0 * slip, "{turn} at {time} s, {most:?}");
            if self.is_coupled(program) {
                continue;
            }
            for (n, value) in from.axes.iter().enumerate() {
                let found = value + share * (to.axes[n] - value);
                let off = (found - program.axes[n].values[k]).abs();
                assert!(off < most.position + slip, "{off} at {time} s");
            }
        }
        let count = if self.is_coupled(program) { 1 } else { program.axes.len() };
        for point in &self.points {
            assert!(point.axes.is_empty() || point.axes.len() == count);
        }
        self.compare_vacuum(program);
    }

    /// Whether its one axis is the progress, which another controller follows.
    fn is_coupled(&self, program: &Program) -> bool {
        program.axes.len() > 6 && !self.points[0].axes.is_empty()
    }

    fn compare_vacuum(&self, program: &Program) {
        let switched = program.events.iter().filter(|event| event.kind != EventKind::Press);
        let due: Vec<(f64, String, bool)> = switched
            .flat_map(|event| {
                let on = event.kind == EventKind::Grip;
                event.grippers.iter().map(move |id| (event.time, gripper_name(*id), on))
            })
            .collect();
        assert_eq!(self.vacuum.len(), due.len(), "{:?}", self.vacuum);
        for ((time, name, on), (at, due, switched)) in self.vacuum.iter().zip(&due) {
            // at the nearest sample, and as late as rounded times add up
            assert!(
                (time - at).abs() < 0.006 + 1e-6 * self.points.len() as f64,
                "{name} {time} {at}"
            );
            assert_eq!((name, on), (due, switched));
        }
    }
}

/// The wide table against the program, to the last bit.
pub fn compare_wide(text: &str, program: &Program) {
    let mut reader = csv::ReaderBuilder::new().flexible(false).from_reader(text.as_bytes());
    let header: Vec<String> = reader.headers().unwrap().iter().map(str::to_owned).collect();
    let column =
        |name: &str| header.iter().position(|h| h == name).unwrap_or_else(|| panic!("{name}"));
    let mut count = 0;
    for (k, row) in reader.records().enumerate() {
        let row = row.unwrap();
        let number = |name: &str| row[column(name)].parse::<f64>().unwrap();
        assert_eq!(number("t (s)"), program.times[k]);
        let flange = program.flange.as_ref().unwrap()[k];
        assert_eq!(["x", "y", "z"].map(|c| number(&format!("flange {c} (m)"))), flange.position);
        let [x, y, z, w] = ["qx", "qy", "qz", "qw"].map(|c| number(&format!("flange {c}")));
        let due = flange.axes[2];
        let found = [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)];
        assert!(distance(found, due) < 1e-12);
        for axis in &program.axes {
            assert_eq!(number(&format!("{} (m)", axis.name)), axis.values[k]);
        }
        let on = IDS.map(|id| number(&format!("{} vacuum", gripper_name(id))));
        let released = |id: [usize; 2]| {
            let past = program.events.iter().filter(|e| e.time <= program.times[k] + 1e-9);
            past.filter(|e| e.kind == EventKind::Release).any(|e| e.grippers.contains(&id))
        };
        let due = IDS.map(|id| if released(id) { 0.0 } else { 1.0 });
        assert_eq!(on, due, "{}", program.times[k]);
        for pad in &program.pads {
            let found = number(&format!("{} tilt (deg)", pad.name));
            assert_eq!(found, pad.tilts[k].to_degrees());
        }
        count += 1;
    }
    assert_eq!(count, program.times.len());
}
