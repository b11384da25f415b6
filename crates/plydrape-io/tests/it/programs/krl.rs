//! A strict reader of KRL programs with their lists of data, as far as they move one arm.

use super::cell::{Played, Point};
use super::tokens::{Reader, lines};
use plydrape::mold::Pose;
use plydrape_io::Files;
use plydrape_io::robot::program::Frames;
use std::collections::{BTreeMap, BTreeSet};

/// What a list of data declares. Names are in capitals.
#[derive(Debug, Default)]
struct Data {
    frames: BTreeMap<String, Pose>,
    loads: BTreeSet<String>,
    signals: BTreeMap<String, String>,
    external: BTreeSet<String>,
}

/// A spline block: its points with their shares of its time, and its time (s) once that is known.
type Spline = (Vec<((Pose, Vec<f64>), f64)>, Option<f64>);

/// Reads all programs, and plays the first, which calls the others.
pub fn play(files: &Files) -> Played {
    let texts_ending = |ending: &str| -> Vec<(String, String)> {
        let own = files.iter().filter(|(name, _)| name.ends_with(ending));
        own.map(|(name, bytes)| {
            (
                name.trim_end_matches(ending).to_uppercase(),
                String::from_utf8(bytes.clone()).unwrap(),
            )
        })
        .collect()
    };
    let (sources, lists) = (texts_ending(".src"), texts_ending(".dat"));
    assert_eq!(sources.len(), lists.len());
    let all: BTreeMap<String, (String, Data)> = sources
        .iter()
        .zip(&lists)
        .map(|((name, source), (list, text))| {
            assert_eq!(name, list);
            (name.clone(), (source.clone(), data(name, text)))
        })
        .collect();
    let mut played = Played::default();
    let mut time = 0.0;
    run(&sources[0].0, &all, &mut played, &mut time);
    played
}

fn word(reader: &mut Reader) -> String {
    let word = reader.word().to_uppercase();
    assert!(word.len() <= 24, "{word}");
    word
}

/// Code lines behind the two lines for the editor.
fn code(text: &str) -> impl Iterator<Item = Reader> {
    let (head, rest) = text.split_once("&REL 1\n").unwrap();
    assert_eq!(head, "&ACCESS RVP\n");
    lines(rest, ";", 255).into_iter().map(Reader::of_line)
}

fn data(name: &str, text: &str) -> Data {
    let mut data = Data::default();
    let mut lines = code(text);
    let mut first = lines.next().unwrap();
    first.expect(&["DEFDAT"]);
    assert_eq!(word(&mut first), name);
    first.expect(&["PUBLIC"]);
    first.end();
    let mut ended = false;
    for mut line in lines {
        assert!(!ended);
        match word(&mut line).as_str() {
            "ENDDAT" => ended = true,
            "EXT" => {
                let name = word(&mut line);
                line.expect(&["("]);
                if name == "BAS" {
                    line.expect(&["BAS_COMMAND", ":", "IN", ",", "REAL", ":", "IN"]);
                }
                line.expect(&[")"]);
                data.external.insert(name);
            }
            "SIGNAL" => {
                let name = word(&mut line);
                line.expect(&["$"]);
                let port = word(&mut line);
                line.expect(&["["]);
                let number = line.number();
                line.expect(&["]"]);
                assert!((1.0..=4096.0).contains(&number) && number.fract() == 0.0);
                let port = format!("{port}{number}");
                assert!(data.signals.values().all(|other| *other != port), "{port} twice");
                assert!(data.signals.insert(name, port).is_none());
            }
            "DECL" => {
                let kind = word(&mut line);
                let name = word(&mut line);
                line.expect(&["=", "{"]);
                match kind.as_str() {
                    "FRAME" => {
                        let (pose, axes) = aggregate(&mut line);
                        line.expect(&["}"]);
                        assert!(axes.is_empty() && data.frames.insert(name, pose).is_none());
                    }
                    "LOAD" => {
                        line.expect(&["M"]);
                        assert!(line.number() > 0.0);
                        line.expect(&[",", "CM", "{"]);
                        aggregate(&mut line);
                        line.expect(&["}", ",", "J", "{"]);
                        for (n, axis) in ["X", "Y", "Z"].into_iter().enumerate() {
                            assert_eq!(line.takes(","), n > 0);
                            line.expect(&[axis]);
                            assert!(line.number() >= 0.0);
                        }
                        line.expect(&["}", "}"]);
                        assert!(data.loads.insert(name));
                    }
                    other => panic!("{other}"),
                }
            }
            other => panic!("{other}"),
        }
        line.end();
    }
    assert!(ended);
    data
}

/// `{E6POS: X 1.0,Y 2.0, …}`
fn point(line: &mut Reader) -> (Pose, Vec<f64>) {
    line.expect(&["{", "E6POS", ":"]);
    let found = aggregate(line);
    line.expect(&["}"]);
    found
}

/// `X 1.0,Y 2.0, …` in millimeters and degrees.
fn aggregate(line: &mut Reader) -> (Pose, Vec<f64>) {
    let mut values = [0.0; 6];
    for (n, name) in ["X", "Y", "Z", "A", "B", "C"].iter().enumerate() {
        if n > 0 {
            line.expect(&[","]);
        }
        line.expect(&[name]);
        values[n] = line.number();
    }
    let mut axes = Vec::new();
    while line.takes(",") {
        let name = format!("E{}", axes.len() + 1);
        line.expect(&[&name]);
        axes.push(line.number() * 1e-3);
    }
    assert!(axes.len() <= 6);
    let [x, y, z, a, b, c] = values;
    assert!([a, b, c].iter().all(|angle| angle.abs() <= 180.0));
    // A about Z, then B about the new Y, then C about the new X
    let [a, b, c] = [a, b, c].map(f64::to_radians);
    (Pose::new([x, y, z].map(|q| q * 1e-3), [c, b, a]), axes)
}

fn run(name: &str, all: &BTreeMap<String, (String, Data)>, played: &mut Played, time: &mut f64) {
    let (source, data) = &all[name];
    let [mold, tool] = ["MOLD_", "TOOL_"].map(|kind| {
        let mut names = data.frames.keys().filter(|name| name.starts_with(kind));
        let found = names.next().unwrap();
        assert!(names.next().is_none() && name.starts_with(&found[kind.len()..]), "{found}");
        found.as_str()
    });
    let frames = Frames { mold: data.frames[mold], tool: data.frames[tool] };
    assert!(played.frames.is_none_or(|other| other == frames));
    played.frames = Some(frames);
    let mut lines = code(source);
    let mut first = lines.next().unwrap();
    first.expect(&["DEF"]);
    assert_eq!(word(&mut first), name);
    first.expect(&["(", ")"]);
    first.end();

    let mut triggered = false;
    let mut set: BTreeSet<String> = BTreeSet::new();
    let mut percents: BTreeMap<String, f64> = BTreeMap::new();
    let (mut loops, mut ended) = (0, false);
    let mut block: Option<Spline> = None;
    for mut line in lines {
        assert!(!ended);
        if line.takes("$") {
            // a system variable, with what it is set to
            let mut name = word(&mut line);
            if line.takes(".") {
                name = format!("{name}.{}", word(&mut line));
            } else if line.takes("[") {
                line.expect(&["I", "]"]);
            }
            assert!(block.is_none());
            line.expect(&["="]);
            match name.as_str() {
                "IPO_MODE" => line.expect(&["#", "BASE"]),
                "BASE" => line.expect(&[mold]),
                "TOOL" => line.expect(&[tool]),
                "LOAD" => assert!(data.loads.contains(&word(&mut line))),
                "ACC.CP" | "ACC.ORI1" | "ACC.ORI2" => assert!(line.number() > 0.0),
                // slow up to the start, and as fast as they go behind it
                "VEL_AXIS" | "ACC_AXIS" | "VEL_EXTAX" | "ACC_EXTAX" => {
                    let percent = line.number();
                    let most = if played.points.is_empty() { 20.0 } else { 100.0 };
                    assert!(loops == 1 && percent > 0.0 && percent <= most);
                    percents.insert(name.clone(), percent);
                }
                "VEL.CP" | "VEL.ORI1" | "VEL.ORI2" => assert!(line.number() > 0.0),
                other => panic!("{other}"),
            }
            set.insert(name);
            line.end();
            continue;
        }
        let first = word(&mut line);
        match first.as_str() {
            "END" => ended = true,
            "INT" => line.expect(&["I"]),
            "GLOBAL" => {
                line.expect(&["INTERRUPT", "DECL"]);
                assert_eq!(line.number(), 3.0);
                line.expect(&["WHEN", "$", "STOPMESS", "==", "TRUE", "DO", "IR_STOPM", "(", ")"]);
            }
            "INTERRUPT" => {
                line.expect(&["ON"]);
                assert_eq!(line.number(), 3.0);
            }
            "BAS" => {
                assert!(data.external.contains("BAS"));
                line.expect(&["(", "#", "INITMOV", ","]);
                assert_eq!(line.number(), 0.0);
                line.expect(&[")"]);
            }
            "FOR" => {
                line.expect(&["I", "="]);
                assert_eq!((line.number(), line.takes("TO")), (1.0, true));
                assert!((1.0..=6.0).contains(&line.number()));
                loops += 1;
            }
            "ENDFOR" => loops -= 1,
            "PTP" => {
                assert!(
                    ["BASE", "TOOL", "IPO_MODE", "VEL_AXIS"].iter().all(|name| set.contains(*name)),
                    "{set:?}"
                );
                let (pose, axes) = point(&mut line);
                assert!(played.points.is_empty());
                assert_eq!(
                    axes.is_empty(),
                    !set.contains("VEL_EXTAX"),
                    "external axes start slowly too"
                );
                played.points.push(Point { time: *time, pose, axes });
            }
            "SPLINE" => {
                assert!(block.is_none() && set.contains("VEL.CP"));
                // a time cannot be kept by axes that are held back
                assert!(percents.values().all(|percent| *percent == 100.0), "{percents:?}");
                block = Some((Vec::new(), None));
            }
            "TIME_BLOCK" => {
                let (points, total) = block.as_mut().unwrap();
                assert!(total.is_none());
                if line.takes("START") {
                    assert!(points.is_empty());
                } else if line.takes("PART") {
                    line.expect(&["="]);
                    let share = line.number();
                    let last = points.last_mut().unwrap();
                    assert!(last.1 == 0.0 && share > 0.0);
                    last.1 = share;
                } else {
                    line.expect(&["END", "="]);
                    *total = Some(line.number());
                }
            }
            "TRIGGER" => {
                line.expect(&["WHEN", "PATH", "="]);
                assert_eq!(line.number(), 0.0);
                line.expect(&["ONSTART", "DELAY", "="]);
                assert_eq!(line.number(), 0.0);
                line.expect(&["DO"]);
                let signal = word(&mut line);
                line.expect(&["=", "TRUE"]);
                assert!(data.signals[&signal].starts_with("OUT") && signal == "ARRAY_START");
                assert!(block.is_some());
                triggered = true;
                played.start_signal(true);
            }
            "SPL" => {
                triggered = false;
                let (points, total) = block.as_mut().unwrap();
                assert!(total.is_none());
                points.push((point(&mut line), 0.0));
            }
            "ENDSPLINE" => {
                assert!(!triggered, "a trigger is before a segment");
                let (points, total) = block.take().unwrap();
                let total = total.unwrap();
                let whole: f64 = points.iter().map(|(_, share)| share).sum();
                assert!((whole - 100.0).abs() < 1e-6 * points.len() as f64, "{whole}");
                for ((pose, axes), share) in points {
                    *time += total * share / whole;
                    played.points.push(Point { time: *time, pose, axes });
                }
            }
            "WAIT" if line.takes("SEC") => {
                assert!(block.is_none());
                *time += line.number();
                let last = played.points.last().unwrap().clone();
                played.points.push(Point { time: *time, ..last });
            }
            "WAIT" => {
                line.expect(&["FOR"]);
                assert!(data.signals[&word(&mut line)].starts_with("IN"));
                assert!(
                    played.start_is_off,
                    "an array that is still told to start is not waited for"
                );
            }
            other if line.takes("=") => {
                assert!(block.is_none() && data.signals[other].starts_with("OUT"), "{other}");
                let on = line.switch("TRUE", "FALSE");
                match other.strip_prefix("VAC_") {
                    Some(gripper) => played.vacuum.push((*time, gripper.to_lowercase(), on)),
                    None => played.start_signal(on),
                }
            }
            other => {
                assert!(data.external.contains(other), "{other}");
                line.expect(&["(", ")"]);
                run(other, all, played, time);
            }
        }
        line.end();
    }
    assert!(ended && loops == 0 && block.is_none());
}
