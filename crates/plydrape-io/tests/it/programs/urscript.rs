//! A strict reader of URScript, as far as it moves one arm by the functions that the file defines.

use super::cell::{Played, Point};
use super::tokens::{Line, Reader, Token, lines};
use plydrape::geometry::vector::{norm, turned};
use plydrape::mold::Pose;
use plydrape_io::Files;
use plydrape_io::robot::program::Frames;
use std::collections::{BTreeMap, BTreeSet};

/// The functions of the language that may be called.
const FUNCTIONS: [&str; 15] = [
    "set_tcp",
    "get_steptime",
    "floor",
    "servoj",
    "get_inverse_kin",
    "pose_trans",
    "interpolate_pose",
    "stopj",
    "movel",
    "sync",
    "get_standard_digital_in",
    "set_standard_digital_out",
    "set_configurable_digital_out",
    "set_tool_digital_out",
    "sleep",
];

/// Plays the scripts one after the other.
pub fn play(files: &Files) -> Played {
    let mut played = Played::default();
    for (name, bytes) in files.iter().filter(|(name, _)| name.ends_with(".script")) {
        let text = std::str::from_utf8(bytes).unwrap();
        script(name.trim_end_matches(".script"), text, &mut played);
    }
    played
}

/// `p[x, y, z, rx, ry, rz]`
fn pose(reader: &mut Reader) -> Pose {
    reader.expect(&["p"]);
    let [x, y, z, a, b, c] = reader.list::<6>();
    let vector = [a, b, c];
    assert!(norm(vector) < std::f64::consts::PI + 1e-6, "{vector:?}");
    let unit = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Pose { position: [x, y, z], axes: unit.map(|e| turned(vector, e)) }
}

/// The outputs of the vacuum, by the comments that name them: the kind, the number among its kind, the gripper.
fn outputs(text: &str) -> BTreeMap<(String, usize), String> {
    let named = text.lines().filter_map(|line| {
        let (output, gripper) = line.trim().strip_prefix("# ")?.split_once(": vacuum of ")?;
        let (kind, number) = output.split_once(" output ")?;
        Some(((kind.to_owned(), number.parse().unwrap()), gripper.to_owned()))
    });
    named.collect()
}

fn script(name: &str, text: &str, played: &mut Played) {
    let outputs = outputs(text);
    let [mold_name, at_name, go, stop] =
        ["mold", "at", "go", "stop"].map(|kind| format!("{kind}_{name}"));
    let mut own: BTreeSet<String> = BTreeSet::new();
    let mut tool = None;
    let mut mold = None;
    // blocks that are open: the program, a function, a loop
    let mut open: Vec<&str> = Vec::new();
    let mut time = played.points.last().map_or(0.0, |point| point.time);
    let mut start = None;
    for line in lines(text, "#", 255) {
        let Line { number, tokens } = line;
        // only functions that exist are called
        if tokens[0] != Token::Word("def".into()) {
            for pair in tokens.windows(2) {
                let [Token::Word(name), Token::Sign("(")] = pair else { continue };
                let known = FUNCTIONS.contains(&name.as_str()) || own.contains(name);
                assert!(known, "line {number}: {name}");
            }
        }
        let mut reader = Reader::of_line(Line { number, tokens });
        let first = reader.word();
        match first.as_str() {
            "def" => {
                let called = reader.word();
                if open.is_empty() {
                    assert_eq!(called, name);
                }
                reader.expect(&["("]);
                while !reader.takes(")") {
                    reader.word();
                    reader.takes(",");
                }
                reader.expect(&[":"]);
                reader.end();
                own.insert(called);
                open.push("def");
                continue;
            }
            "while" => {
                open.push("while");
                continue;
            }
            "end" => {
                open.pop().unwrap();
                reader.end();
                continue;
            }
            _ => {}
        }
        // what functions do inside is tried in the cell; their calls are played
        let in_function = open.iter().filter(|kind| **kind == "def").count() > 1;
        if in_function || open.last() == Some(&"while") {
            continue;
        }
        match first.as_str() {
            "set_tcp" => {
                reader.expect(&["("]);
                tool = Some(pose(&mut reader));
                reader.expect(&[")"]);
            }
            "global" if reader.takes(&mold_name) => {
                reader.expect(&["="]);
                mold = Some(pose(&mut reader));
            }
            "global" => {
                reader.expect(&[&at_name, "="]);
                start = Some(pose(&mut reader));
            }
            "movel" => {
                reader.expect(&["(", "pose_trans", "(", &mold_name, ",", &at_name, ")", ","]);
                reader.expect(&["a", "="]);
                assert!(reader.number() <= 0.5);
                reader.expect(&[",", "v", "="]);
                assert!(reader.number() <= 0.25, "the way to the start is slow");
                reader.expect(&[")"]);
                assert!(tool.is_some() && mold.is_some());
                let pose = start.expect("a start");
                match played.points.last() {
                    None => played.points.push(Point { time, pose, axes: Vec::new() }),
                    Some(last) => {
                        assert_eq!(last.pose, pose, "a part begins where the last one ended")
                    }
                }
            }
            called if called == go => {
                reader.expect(&["("]);
                let pose = pose(&mut reader);
                reader.expect(&[","]);
                let [begins, ends] = reader.numbers::<2>();
                reader.expect(&[")"]);
                assert!((begins - time).abs() < 2e-6 && ends > begins, "{begins} {time}");
                time = ends;
                played.points.push(Point { time, pose, axes: Vec::new() });
            }
            called if called == stop => reader.expect(&["(", ")"]),
            "sleep" => {
                reader.expect(&["("]);
                time += reader.number();
                reader.expect(&[")"]);
                let last = played.points.last().unwrap().clone();
                played.points.push(Point { time, ..last });
            }
            "set_standard_digital_out"
            | "set_configurable_digital_out"
            | "set_tool_digital_out" => {
                let kind = first.trim_start_matches("set_").trim_end_matches("_digital_out");
                reader.expect(&["("]);
                let output = reader.number();
                let most = if kind == "tool" { 2.0 } else { 8.0 };
                assert!((0.0..most).contains(&output) && output.fract() == 0.0, "{kind} {output}");
                reader.expect(&[","]);
                let on = reader.takes("True");
                if !on {
                    reader.expect(&["False"]);
                }
                reader.expect(&[")"]);
                match outputs.get(&(kind.to_owned(), output as usize)) {
                    Some(gripper) => played.vacuum.push((time, gripper.clone(), on)),
                    None => played.start_signal(on),
                }
            }
            other => panic!("line {number}: {other}"),
        }
        reader.end();
    }
    assert!(open.is_empty());
    played.frames = Some(Frames { mold: mold.unwrap(), tool: tool.unwrap() });
}
