//! A strict reader of RAPID modules, as far as they move one arm.

use super::cell::{Played, Point};
use super::tokens::{Reader, Token, lines};
use plydrape::mold::Pose;
use plydrape_io::Files;
use plydrape_io::robot::program::Frames;
use std::collections::BTreeMap;

/// Predefined zones.
const ZONES: [&str; 15] = [
    "fine", "z0", "z1", "z5", "z10", "z15", "z20", "z30", "z40", "z50", "z60", "z80", "z100",
    "z150", "z200",
];

#[derive(Debug)]
enum Statement {
    Move {
        linear: bool,
        pose: Pose,
        axes: Vec<f64>,
        duration: Option<f64>,
        fine: bool,
        triggers: bool,
    },
    Output(String, bool),
    Wait(f64),
    WaitInput(String),
    Call(String),
    /// Whether configurations of the arm are watched.
    Monitor(bool),
    /// A limit of the acceleration (m/s²), or none.
    Accelerate(Option<f64>),
    /// An output that is set at the start of the next movement that has it.
    Trigger(String),
}

/// The names of the tool and of the work object in a module with this name, or in one of its parts.
fn of_program(module: &str) -> [String; 2] {
    // the name ends with its check sum, and a part's number may follow
    let parts: Vec<&str> = module.trim_end_matches("_cell").split('_').collect();
    let end = parts.iter().rposition(|part| part.len() == 4).unwrap();
    ["tool", "mold"].map(|kind| format!("{kind}_{}", parts[..=end].join("_")))
}

/// The name of the trigger of a program, by the names of its data.
fn trigger([tool, _]: &[String; 2]) -> String {
    tool.replacen("tool", "start", 1)
}

/// Reads all modules and plays the procedure that calls the others, or the only one.
pub fn play(files: &Files) -> Played {
    let mut frames = None;
    let mut procedures: BTreeMap<String, Vec<Statement>> = BTreeMap::new();
    let mut first = None;
    for (name, bytes) in files.iter().filter(|(name, _)| name.ends_with(".mod")) {
        let text = std::str::from_utf8(bytes).unwrap();
        let mut reader = Reader::new(lines(text, "!", 400));
        reader.expect(&["MODULE"]);
        let module = identifier(&mut reader);
        assert_eq!(format!("{module}.mod"), *name);
        if module.ends_with("_cell") {
            assert!(frames.is_none());
            frames = Some(data(&mut reader, &of_program(&module)));
            reader.expect(&["ENDMODULE"]);
            reader.end();
            continue;
        }
        if reader.takes("VAR") {
            reader.expect(&["triggdata", &trigger(&of_program(&module)), ";"]);
        }
        reader.expect(&["PROC"]);
        let procedure = identifier(&mut reader);
        assert_ne!(procedure, module, "a module and a procedure of one name are ambiguous");
        reader.expect(&["(", ")"]);
        let mut statements = Vec::new();
        while !reader.takes("ENDPROC") {
            statements.extend(statement(&mut reader, &of_program(&module)));
        }
        reader.expect(&["ENDMODULE"]);
        reader.end();
        first.get_or_insert(procedure.clone());
        assert!(procedures.insert(procedure, statements).is_none());
    }

    let mut played = Played { frames, ..Played::default() };
    let mut time = 0.0;
    run(&first.unwrap(), &procedures, &mut played, &mut time);
    played
}

fn run(name: &str, all: &BTreeMap<String, Vec<Statement>>, played: &mut Played, time: &mut f64) {
    // outputs are switched where the arm stands
    let (mut stands, mut monitored) = (true, true);
    let mut armed = None;
    for statement in &all[name] {
        match statement {
            Statement::Accelerate(limit) => played.acceleration = *limit,
            Statement::Trigger(signal) => armed = Some(signal.clone()),
            Statement::Move { linear, pose, axes, duration, fine, triggers } => {
                assert!(!linear || played.acceleration.is_some());
                if *triggers {
                    assert_eq!(armed.take().unwrap(), "array_start");
                    played.start_signal(true);
                }
                assert_eq!(*linear, duration.is_some(), "the way to the start alone has no time");
                *time += duration.unwrap_or_default();
                played.points.push(Point { time: *time, pose: *pose, axes: axes.clone() });
                stands = *fine;
            }
            Statement::Output(signal, on) => {
                assert!(stands, "{signal} is switched on the way");
                match signal.strip_prefix("vac_") {
                    Some(gripper) => played.vacuum.push((*time, gripper.into(), *on)),
                    None => {
                        assert_eq!(signal, "array_start");
                        played.start_signal(*on);
                    }
                }
            }
            Statement::Wait(seconds) => {
                assert!(stands && *seconds > 0.0);
                *time += seconds;
                let last = played.points.last().unwrap().clone();
                played.points.push(Point { time: *time, ..last });
            }
            Statement::WaitInput(signal) => {
                assert_eq!(signal, "array_ready");
                assert!(
                    played.start_is_off,
                    "an array that is still told to start is not waited for"
                );
            }
            Statement::Monitor(on) => monitored = *on,
            Statement::Call(other) => run(other, all, played, time),
        }
    }
    assert!(stands, "it ends at rest");
    assert!(monitored, "what runs next has its arm configurations watched again");
}

fn identifier(reader: &mut Reader) -> String {
    let word = reader.word();
    assert!(word.len() <= 32, "{word}");
    word
}

/// `[[x,y,z],[w,x,y,z]]` in millimeters.
fn pose(reader: &mut Reader) -> Pose {
    reader.expect(&["["]);
    let pose = parts(reader);
    reader.expect(&["]"]);
    pose
}

fn parts(reader: &mut Reader) -> Pose {
    let position = reader.list::<3>().map(|x| x * 1e-3);
    reader.expect(&[","]);
    let [w, x, y, z] = reader.list::<4>();
    let square = w * w + x * x + y * y + z * z;
    assert!((square - 1.0).abs() < 1e-8, "a quaternion of the square {square}");
    Pose {
        position,
        axes: [
            [w * w + x * x - y * y - z * z, 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)],
            [2.0 * (x * y - w * z), w * w - x * x + y * y - z * z, 2.0 * (y * z + w * x)],
            [2.0 * (x * z + w * y), 2.0 * (y * z - w * x), w * w - x * x - y * y + z * z],
        ],
    }
}

/// The tool, which the robot holds, and the work object, which stands still.
fn data(reader: &mut Reader, [tool_name, mold_name]: &[String; 2]) -> Frames {
    reader.expect(&["PERS", "tooldata", tool_name, ":=", "[", "TRUE", ","]);
    let tool = pose(reader);
    reader.expect(&[",", "["]);
    let mass = reader.number();
    reader.expect(&[","]);
    let _center = reader.list::<3>();
    reader.expect(&[","]);
    let _axes = reader.list::<4>();
    reader.expect(&[","]);
    let _inertia = reader.numbers::<3>();
    reader.expect(&["]", "]", ";"]);
    assert!(mass > 0.0);
    reader.expect(&["PERS", "wobjdata", mold_name, ":=", "[", "FALSE", ",", "TRUE", ","]);
    assert_eq!(reader.next(), Token::Text(String::new()));
    reader.expect(&[","]);
    let mold = pose(reader);
    reader.expect(&[","]);
    let object = pose(reader);
    assert_eq!(object, Pose::new([0.0; 3], [0.0; 3]));
    reader.expect(&["]", ";"]);
    Frames { mold, tool }
}

fn statement(reader: &mut Reader, names: &[String; 2]) -> Option<Statement> {
    let word = identifier(reader);
    let statement = match word.as_str() {
        "ConfJ" | "ConfL" => {
            reader.expect(&["\\"]);
            Statement::Monitor(reader.switch("On", "Off"))
        }
        "MoveJ" | "MoveL" | "TriggL" => return Some(movement(reader, &word, names)),
        "PathAccLim" => {
            let limit = reader.takes("TRUE").then(|| {
                reader.expect(&["\\", "AccMax", ":="]);
                let most = reader.number();
                reader.expect(&[",", "TRUE", "\\", "DecelMax", ":="]);
                assert_eq!(reader.number(), most);
                most
            });
            if limit.is_none() {
                reader.expect(&["FALSE", ",", "FALSE"]);
            }
            Statement::Accelerate(limit)
        }
        "TriggIO" => {
            reader.expect(&[&trigger(names), ","]);
            assert_eq!(reader.number(), 0.0);
            reader.expect(&["\\", "Start", "\\", "DOp", ":="]);
            let signal = identifier(reader);
            reader.expect(&[","]);
            assert_eq!(reader.number(), 1.0);
            Statement::Trigger(signal)
        }
        "SetDO" => {
            let signal = identifier(reader);
            reader.expect(&[","]);
            let value = reader.number();
            assert!(value == 0.0 || value == 1.0);
            Statement::Output(signal, value == 1.0)
        }
        "WaitTime" => Statement::Wait(reader.number()),
        "WaitDI" => {
            let signal = identifier(reader);
            reader.expect(&[","]);
            assert_eq!(reader.number(), 1.0);
            Statement::WaitInput(signal)
        }
        _ => Statement::Call(word),
    };
    reader.expect(&[";"]);
    Some(statement)
}

fn movement(reader: &mut Reader, kind: &str, names: &[String; 2]) -> Statement {
    let (linear, triggers) = (kind != "MoveJ", kind == "TriggL");
    let [tool, mold] = names;
    // robtarget: place, orientation, configuration, external axes
    reader.expect(&["["]);
    let pose = parts(reader);
    reader.expect(&[","]);
    assert_eq!(reader.list::<4>(), [0.0; 4]);
    reader.expect(&[","]);
    let external = reader.list::<6>();
    reader.expect(&["]", ","]);
    let axes: Vec<f64> = external.iter().take_while(|x| **x != 9e9).map(|x| x * 1e-3).collect();
    assert!(external[axes.len()..].iter().all(|x| *x == 9e9));

    // speeddata, with the time that goes before it
    let mut duration = None;
    if linear {
        let speeds = reader.list::<4>();
        assert!(speeds.iter().all(|speed| *speed > 0.0), "{speeds:?}");
        reader.expect(&["\\", "T", ":="]);
        let seconds = reader.number();
        assert!(seconds > 0.0);
        duration = Some(seconds);
    } else {
        // the axes come to the start as slowly as the arm
        assert_eq!(reader.list::<4>(), [50.0, 30.0, 50.0, 30.0]);
    }
    reader.expect(&[","]);
    if triggers {
        reader.expect(&[&trigger(names), ","]);
    }
    let zone = identifier(reader);
    assert!(ZONES.contains(&zone.as_str()), "{zone}");
    reader.expect(&[",", tool, "\\", "WObj", ":=", mold, ";"]);
    Statement::Move { linear, pose, axes, duration, fine: zone == "fine", triggers }
}
