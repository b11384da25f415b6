//! A strict reader of URScript, as far as it moves one arm by the functions that the file defines.

use super::cell::{Played, Point};
use super::tokens::{Line, Reader, Token, lines};
use plydrape::geometry::vector::{norm, turned};
use plydrape::mold::Pose;
use plydrape_io::Files;
use plydrape_io::robot::program::Frames;
use std::collections::{BTreeMap, BTreeSet};

/// The functions of the language that may be called.
const FUNCTIONS: [&str; 25] = [
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
    "set_target_payload",
    "sqrt",
    "pow",
    "norm",
    "pose_inv",
    "get_actual_tcp_pose",
    "get_actual_tcp_speed",
    "write_output_float_register",
    "popup",
    "and",
];

/// Plays the scripts one after the other, by what the script of the cell says.
pub fn play(files: &Files) -> Played {
    let mut played = Played::default();
    let texts: Vec<(&str, &str)> = files
        .iter()
        .filter_map(|(name, bytes)| {
            Some((name.strip_suffix(".script")?, std::str::from_utf8(bytes).unwrap()))
        })
        .collect();
    let (name, text) = texts.iter().find(|(name, _)| name.ends_with("_cell")).unwrap();
    let cell = Cell::read(name.trim_end_matches("_cell"), text);
    played.frames = Some(cell.frames);
    for (name, text) in texts.iter().filter(|(name, _)| !name.ends_with("_cell")) {
        script(name, text, &cell, &mut played);
    }
    played
}

/// What a script says that is measured in a cell.
struct Cell {
    /// Name of the program.
    name: String,
    frames: Frames,
    /// Functions that switch the vacuum of a gripper.
    vacuum: BTreeMap<String, String>,
}

impl Cell {
    fn read(name: &str, text: &str) -> Self {
        let (mut tool, mut mold, mut outputs) = (None, None, BTreeSet::new());
        let mut vacuum = BTreeMap::new();
        for line in lines(text, "#", 255) {
            let mut reader = Reader::of_line(line);
            match reader.word().as_str() {
                "def" => {
                    let called = reader.word();
                    if called == format!("cell_{name}") {
                        reader.expect(&["(", ")", ":"]);
                    } else {
                        let gripper = called.strip_prefix("vac_").unwrap();
                        let gripper = gripper.strip_suffix(&format!("_{name}")).unwrap();
                        vacuum.insert(called.clone(), gripper.to_owned());
                        reader.expect(&["(", "on", ")", ":"]);
                    }
                }
                "set_tcp" => {
                    reader.expect(&["("]);
                    tool = Some(pose(&mut reader));
                    reader.expect(&[")"]);
                }
                "set_target_payload" => {
                    reader.expect(&["("]);
                    assert!(reader.number() > 0.0);
                    reader.expect(&[","]);
                    reader.list::<3>();
                    reader.expect(&[")"]);
                }
                "global" => {
                    reader.expect(&[&format!("mold_{name}"), "="]);
                    mold = Some(pose(&mut reader));
                }
                "end" => {}
                call => {
                    let kind = call.strip_prefix("set_").unwrap();
                    let kind = kind.strip_suffix("_digital_out").unwrap();
                    reader.expect(&["("]);
                    let output = reader.number();
                    let most = match kind {
                        "standard" | "configurable" => 8.0,
                        "tool" => 2.0,
                        other => panic!("{other}"),
                    };
                    assert!((0.0..most).contains(&output) && output.fract() == 0.0);
                    assert!(outputs.insert((kind.to_owned(), output as usize)), "{call} twice");
                    reader.expect(&[",", "on", ")"]);
                }
            }
            reader.end();
        }
        let frames = Frames { mold: mold.unwrap(), tool: tool.unwrap() };
        Cell { name: name.to_owned(), frames, vacuum }
    }
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

fn script(name: &str, text: &str, cell: &Cell, played: &mut Played) {
    let mold_name = format!("mold_{}", cell.name);
    let [at_name, go, stop, time_name, done_name] =
        ["at", "go", "stop", "time", "done"].map(|kind| format!("{kind}_{name}"));
    let mut own: BTreeSet<String> = cell.vacuum.keys().cloned().collect();
    own.insert(format!("cell_{}", cell.name));
    let mut done = 0.0;
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
            "while" | "if" => {
                open.push("while");
                continue;
            }
            "else" => continue,
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
            called if called == format!("cell_{}", cell.name) => reader.expect(&["(", ")"]),
            "global" if reader.takes(&time_name) => {
                reader.expect(&["="]);
                assert_eq!(reader.number(), 0.0);
            }
            "global" if reader.takes(&done_name) => {
                reader.expect(&["="]);
                done = reader.number();
            }
            set if set == time_name => {
                reader.expect(&["="]);
                assert!((reader.number() - time).abs() < 2e-6);
            }
            "write_output_float_register" => {
                reader.expect(&["("]);
                assert_eq!(reader.number(), 0.0);
                reader.expect(&[","]);
                assert_eq!(reader.number(), 1000.0);
                reader.expect(&["*", &done_name, ")"]);
            }
            called if cell.vacuum.contains_key(called) => {
                reader.expect(&["("]);
                let on = reader.switch("True", "False");
                reader.expect(&[")"]);
                played.vacuum.push((time, cell.vacuum[called].clone(), on));
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
                let [begins, ends, progress] = reader.numbers::<3>();
                reader.expect(&[")"]);
                assert!(progress > done && progress <= 1.0);
                done = progress;
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
                let on = reader.switch("True", "False");
                reader.expect(&[")"]);
                played.start_signal(on);
            }
            other => panic!("line {number}: {other}"),
        }
        reader.end();
    }
    assert!(open.is_empty());
    assert!((done - 1.0).abs() < 1e-9 || name != cell.name, "{done}");
}
