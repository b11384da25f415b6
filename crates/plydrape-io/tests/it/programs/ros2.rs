//! The bag of a program, played without ROS 2: every message is decoded by the definition in the bag.

use super::cell::{DURATION, IDS, cell, product, rejected, text};
use plydrape::geometry::vector::distance;
use plydrape::mold::Pose;
use plydrape::ply::gripper_name;
use plydrape_io::robot::program::Program;
use plydrape_io::robot::program::sampling::Deviation;
use plydrape_io::robot::ros2;
use std::collections::BTreeMap;

/// A decoded value.
#[derive(Debug, Clone, PartialEq)]
enum Value {
    Number(f64),
    Text(String),
    List(Vec<Value>),
    Message(BTreeMap<String, Value>),
}

impl Value {
    fn get(&self, name: &str) -> &Value {
        match self {
            Value::Message(fields) => &fields[name],
            other => panic!("{name} of {other:?}"),
        }
    }

    fn number(&self) -> f64 {
        match self {
            Value::Number(number) => *number,
            other => panic!("{other:?}"),
        }
    }

    fn text(&self) -> &str {
        match self {
            Value::Text(text) => text,
            other => panic!("{other:?}"),
        }
    }

    fn list(&self) -> &[Value] {
        match self {
            Value::List(list) => list,
            other => panic!("{other:?}"),
        }
    }

    fn xyz(&self) -> [f64; 3] {
        ["x", "y", "z"].map(|name| self.get(name).number())
    }

    /// A place and an orientation, under their names in a message.
    fn pose(&self, [place, turn]: [&str; 2]) -> Pose {
        let turn = self.get(turn);
        let ([x, y, z], w) = (turn.xyz(), turn.get("w").number());
        assert!((x * x + y * y + z * z + w * w - 1.0).abs() < 1e-12);
        Pose {
            position: self.get(place).xyz(),
            axes: [
                [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
                [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
                [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
            ],
        }
    }

    fn seconds(&self) -> f64 {
        self.get("sec").number() + 1e-9 * self.get("nanosec").number()
    }
}

/// A definition: the fields of each message, type and name.
struct Definition(BTreeMap<String, Vec<(String, String)>>);

impl Definition {
    fn new(name: &str, text: &str) -> Self {
        let mut messages = BTreeMap::new();
        let own = name.replace("/msg/", "/");
        for part in text.split(&format!("{}\n", "=".repeat(80))) {
            let (title, fields) = match part.strip_prefix("MSG: ") {
                Some(rest) => rest.split_once('\n').unwrap(),
                None => (own.as_str(), part),
            };
            let fields = fields.lines().map(|line| {
                let (kind, name) = line.split_once(' ').unwrap();
                (kind.to_owned(), name.to_owned())
            });
            messages.insert(title.to_owned(), fields.collect());
        }
        Definition(messages)
    }
}

/// Reads plain CDR, little endian.
struct Decoder<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl Decoder<'_> {
    fn raw<const N: usize>(&mut self) -> [u8; N] {
        self.at = self.at.next_multiple_of(N);
        self.at += N;
        self.bytes[self.at - N..self.at].try_into().unwrap()
    }

    fn count(&mut self) -> usize {
        u32::from_le_bytes(self.raw()) as usize
    }

    fn value(&mut self, kind: &str, definition: &Definition) -> Value {
        if let Some(item) = kind.strip_suffix("[]") {
            let count = self.count();
            return Value::List((0..count).map(|_| self.value(item, definition)).collect());
        }
        match kind {
            "float64" => Value::Number(f64::from_le_bytes(self.raw())),
            "int32" => Value::Number(i32::from_le_bytes(self.raw()).into()),
            "uint32" => Value::Number(u32::from_le_bytes(self.raw()).into()),
            "string" => {
                let length = self.count();
                let (text, zero) = self.bytes[self.at..self.at + length].split_at(length - 1);
                assert_eq!(zero, [0]);
                self.at += length;
                Value::Text(String::from_utf8(text.to_vec()).unwrap())
            }
            message => {
                let fields = definition.0[message].iter();
                let read = fields.map(|(kind, name)| (name.clone(), self.value(kind, definition)));
                Value::Message(read.collect())
            }
        }
    }
}

/// Topics with their times (s) and messages.
type Topics = BTreeMap<String, Vec<(f64, Value)>>;

fn play(bag: &[u8]) -> Topics {
    let mut topics = Topics::new();
    let mut last = 0;
    for message in mcap::MessageStream::new(bag).unwrap() {
        let message = message.unwrap();
        assert!(message.log_time >= last, "messages are in the order of time");
        last = message.log_time;
        let schema = message.channel.schema.as_ref().unwrap();
        assert_eq!((&*schema.encoding, &*message.channel.message_encoding), ("ros2msg", "cdr"));
        let definition = Definition::new(&schema.name, std::str::from_utf8(&schema.data).unwrap());
        let (head, bytes) = message.data.split_at(4);
        assert_eq!(head, [0, 1, 0, 0]);
        let mut decoder = Decoder { bytes, at: 0 };
        let value = decoder.value(&schema.name.replace("/msg/", "/"), &definition);
        assert_eq!(decoder.at, bytes.len(), "all of it is read");
        let own = topics.entry(message.channel.topic.clone()).or_default();
        own.push((message.log_time as f64 * 1e-9, value));
    }
    topics
}

fn files(program: &Program, tf: bool) -> BTreeMap<String, Vec<u8>> {
    ros2::program_files(program, tf).unwrap().into_iter().collect()
}

fn near(a: &Pose, b: &Pose, most: Deviation) -> bool {
    let turned = a.axes.iter().zip(&b.axes).all(|(p, q)| distance(*p, *q) <= most.angle + 1e-12);
    distance(a.position, b.position) <= most.position + 1e-12 && turned
}

const EXACT: Deviation = Deviation { position: 0.0, angle: 0.0 };

/// Axes to the last bit at every sample, with the slopes of their curves; flange and pads at every sample too; the vacuum at its times. Frames over
/// time are there on request alone.
#[test]
fn a_bag_played_without_ros_is_the_program() {
    let program = cell(6, 1001);
    let quiet = play(&files(&program, false)["trajectory.mcap"]);
    assert!(!quiet.contains_key("/tf"));
    assert_eq!(quiet["/tf_static"][0].1.get("transforms").list().len(), 1);
    let topics = play(&files(&program, true)["trajectory.mcap"]);
    let keys: Vec<&str> = topics.keys().map(String::as_str).collect();
    assert_eq!(
        keys,
        [
            "/plydrape/flange",
            "/plydrape/flange_pose",
            "/plydrape/trajectory",
            "/plydrape/vacuum",
            "/tf",
            "/tf_static"
        ]
    );

    let [(_, axes)] = &topics["/plydrape/trajectory"][..] else { panic!() };
    let names: Vec<&str> = axes.get("joint_names").list().iter().map(Value::text).collect();
    assert_eq!(names, program.axes.iter().map(|axis| &*axis.name).collect::<Vec<_>>());
    let points = axes.get("points").list();
    assert_eq!(points.len(), program.times.len());
    for (k, point) in points.iter().enumerate() {
        assert!((point.get("time_from_start").seconds() - program.times[k]).abs() < 1e-9);
        let [positions, velocities] =
            ["positions", "velocities"].map(|name| point.get(name).list());
        for (n, axis) in program.axes.iter().enumerate() {
            assert_eq!(positions[n].number(), axis.values[k]);
            let due = match k {
                0 | 1000 => 0.0,
                _ => {
                    (axis.values[k + 1] - axis.values[k - 1])
                        / (program.times[k + 1] - program.times[k - 1])
                }
            };
            assert!((velocities[n].number() - due).abs() < 1e-12);
        }
    }

    // frames: world, mold, flange, tool
    let [(_, fixed)] = &topics["/tf_static"][..] else { panic!() };
    let due = [
        ("world", "ply_mold", program.frames.mold),
        ("ply_flange", "ply_tool", program.frames.tool),
    ];
    for (transform, (parent, child, pose)) in fixed.get("transforms").list().iter().zip(due) {
        assert_eq!(transform.get("header").get("frame_id").text(), parent);
        assert_eq!(transform.get("child_frame_id").text(), child);
        let found = transform.get("transform").pose(["translation", "rotation"]);
        assert!(near(&found, &pose, EXACT));
    }

    let frames = &topics["/tf"];
    assert_eq!(frames.len(), program.times.len());
    let flange = program.flange.as_ref().unwrap();
    let pads = program.pads.iter().zip(IDS);
    let pads = pads.map(|(pad, id)| (format!("ply_{}", gripper_name(id)), &pad.poses));
    for (n, (name, poses)) in std::iter::once(("ply_flange".into(), flange)).chain(pads).enumerate()
    {
        for (k, (time, message)) in frames.iter().enumerate() {
            let transform = &message.get("transforms").list()[n];
            assert_eq!(transform.get("child_frame_id").text(), name);
            assert_eq!(transform.get("header").get("frame_id").text(), "ply_mold");
            assert!((transform.get("header").get("stamp").seconds() - time).abs() < 1e-9);
            assert!((time - program.times[k]).abs() < 1e-9);
            let found = transform.get("transform").pose(["translation", "rotation"]);
            assert!(near(&found, &poses[k], EXACT), "{name} at {time} s");
        }
    }
    assert_eq!(topics["/plydrape/flange_pose"].len(), frames.len());
    for ((time, pose), (at, frame)) in topics["/plydrape/flange_pose"].iter().zip(frames) {
        assert_eq!(time, at);
        let found = pose.get("pose").pose(["position", "orientation"]);
        let due =
            frame.get("transforms").list()[0].get("transform").pose(["translation", "rotation"]);
        // of a quaternion and its opposite
        assert!(near(&found, &due, EXACT));
    }

    let vacuum: Vec<(f64, usize, f64)> = topics["/plydrape/vacuum"]
        .iter()
        .map(|(time, message)| {
            let groups = message.get("interface_groups").list();
            let values = message.get("interface_values").list();
            assert_eq!(groups.len(), values.len());
            assert!(values.iter().all(|v| v.get("interface_names").list()[0].text() == "vacuum"));
            let milliseconds = (time * 1e3).round() / 1e3;
            (milliseconds, groups.len(), values[0].get("values").list()[0].number())
        })
        .collect();
    assert_eq!(vacuum, [(0.0, 4, 1.0), (4.8, 1, 0.0), (7.0, 1, 0.0), (DURATION, 2, 0.0)]);
}

/// The path in YAML has the poses of the bag; every head states the verdict.
#[test]
fn yaml_files_say_what_they_are_in_their_heads() {
    let program = rejected(cell(6, 1001));
    let accepted: Vec<(String, Vec<u8>)> = files(&cell(6, 1001), false).into_iter().collect();
    let files: Vec<(String, Vec<u8>)> = files(&program, false).into_iter().collect();
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["flange.yaml", "trajectory.mcap", "trajectory.yaml", "vacuum.yaml"]);
    for n in [0, 2, 3] {
        let text = text(&files, n);
        assert!(text.starts_with("# NOT ACCEPTED: tilt 57.1° against 40°\n"), "{}", names[n]);
    }
    assert!(text(&accepted, 0).starts_with("# Verdict: accepted: tilt 12° against 40°\n"));
    assert!(text(&files, 2).contains("never run them while it moves at reduced speed"));
    assert_eq!(text(&files, 3).matches("---\n").count(), 3);
    let bag = &files[1].1;
    let held = |text: &str| bag.windows(text.len()).any(|window| window == text.as_bytes());
    assert!(held("tilt 57.1° against 40°"));
    // the tool is not the flange
    let flange = program.flange.as_ref().unwrap()[0];
    assert_ne!(product(&flange, &program.frames.tool), flange);
}
