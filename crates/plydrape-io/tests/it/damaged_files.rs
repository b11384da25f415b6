//! What comes in through files: results with a forged check sum, files without end, and texts that would grow beyond all memory.

use crate::common::{all_cases, drape, examples};
use plydrape::mold::Pose;
use plydrape::scene::PlanSettings;
use plydrape_io::Error;
use plydrape_io::export::{self, Format};
use plydrape_io::read::formula;
use plydrape_io::read::mesh;
use plydrape_io::result::read;
use plydrape_io::scene::{self};
use plydrape_io::store::size::PlanSheets;
use plydrape_io::store::{input, size};
use plydrape_io::{ResultFile, page};
use serde_json::Value;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::{Duration, Instant};

const SCENE: &str = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n\
     [mold]\nkind = \"plane\"\n[grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"20 mm\"\n\
     [target]\norigin = [0, 0]\nshear = \"20 deg\"\n[motion]\nkind = \"straight\"\nsteps = 3\n";

fn parse(text: &str) -> Result<scene::SceneFile, Error> {
    scene::parse(text, Path::new(""), "scene.toml")
}

fn draped() -> ResultFile {
    let scene = parse(SCENE).unwrap();
    let mut result = drape(&scene);
    result.scene.input = scene.input.clone();
    result
}

/// Every place of a value that holds a number or a list, as a JSON pointer.
fn places(value: &Value, at: &str, out: &mut Vec<String>) {
    match value {
        Value::Number(_) => out.push(at.into()),
        Value::Array(items) => {
            out.push(at.into());
            // the first two and the last of a long list stand for the others
            let count = items.len();
            for (n, item) in items.iter().enumerate() {
                if n < 2 || n + 1 == count {
                    places(item, &format!("{at}/{n}"), out);
                }
            }
        }
        Value::Object(items) => {
            for (key, item) in items {
                places(item, &format!("{at}/{key}"), out);
            }
        }
        _ => {}
    }
}

/// A result is read back as signed text, as someone who forges it would leave it.
fn reread(value: &Value) -> Option<ResultFile> {
    let mut value = value.clone();
    value.as_object_mut()?.remove("checksum");
    let text = format!("{},\"checksum\":", value.to_string().strip_suffix('}')?);
    let text = format!("{text}\"crc32:{:08x}\"}}", crc32fast::hash(text.as_bytes()));
    read::parse(text.as_bytes(), Path::new("result.json")).ok()
}

/// Whatever number or list of a result is replaced and signed anew: it is refused, or everything can be made of it, without a
/// panic and without a number that is none.
#[test]
fn a_forged_result_is_refused_or_harmless() {
    let value = serde_json::to_value(draped()).unwrap();
    let text = draped().text().unwrap();
    read::parse(text.as_bytes(), Path::new("result.json")).unwrap();
    assert!(reread(&value).is_some());
    let mut all = Vec::new();
    places(&value, "", &mut all);
    assert!(all.len() > 300);
    let folder = tempfile::tempdir().unwrap();
    let mut faults = Vec::new();
    // prime steps, so that every kind of value comes up
    for place in all.iter().step_by(if all_cases() { 61 } else { 307 }) {
        let old = value.pointer(place).unwrap();
        let others: Vec<Value> = match old {
            Value::Array(items) => vec![Value::Array(Vec::new()), items[..items.len() / 2].into()],
            _ => [0.0, -1.0, 1e300, 1e9]
                .iter()
                .map(|x| Value::from(*x))
                .chain([0.into(), 1_000_000.into()])
                .collect(),
        };
        for other in others {
            let mut forged = value.clone();
            *forged.pointer_mut(place).unwrap() = other.clone();
            let made = catch_unwind(AssertUnwindSafe(|| {
                let Some(result) = reread(&forged) else { return String::new() };
                let mut all =
                    page::html(&result).map(drop).err().map_or(String::new(), |e| e.to_string());
                let options =
                    export::Options { even_if_rejected: true, ..export::Options::default() };
                for format in [Format::Csv, Format::Inp, Format::Ros2, Format::Vtk] {
                    match export::write(&result, format, &options, folder.path()) {
                        Err(error) => all += &format!("{format:?}: {error}"),
                        Ok(files) => {
                            for file in files {
                                let text = std::fs::read(&file).unwrap();
                                let text = String::from_utf8_lossy(&text);
                                let number = |w: &str| matches!(w, "NaN" | "inf" | "-inf" | "nan");
                                let inp = file
                                    .extension()
                                    .is_some_and(|e| e == "inp" || e == "csv" || e == "yaml");
                                if inp && text.split([',', ' ', '\n']).any(number) {
                                    all += &format!("NaN in {}", file.display());
                                }
                            }
                        }
                    }
                }
                if all.contains("NaN in") { all } else { String::new() }
            }));
            match made {
                Err(_) => faults.push(format!("{place} = {other}: panic")),
                Ok(text) if !text.is_empty() => faults.push(format!("{place} = {other}: {text}")),
                Ok(_) => {}
            }
        }
    }
    assert!(faults.is_empty(), "{} faults:\n{}", faults.len(), faults.join("\n"));
}

/// The case that was found: a cell of 0 under a check sum made anew.
#[test]
fn a_result_with_a_cell_of_zero_is_refused() {
    for spoil in [
        (|r| r.scene.ply.cell[0] = 0.0) as fn(&mut ResultFile),
        |r| r.scene.ply.cell[1] = f64::MAX,
        |r| r.scene.ply.grid.nu = usize::MAX,
        |r| r.steps[1].grippers[0].position[0] = 1e200,
        |r| r.steps[1].grippers[0].quaternion = [0.0; 4],
        |r| r.steps.clear(),
        |r| r.steps[2].time = 0.0,
        |r| r.summary.limits[0].step = Some(99),
        |r| r.scene.title = "\u{1b}[31m".into(),
    ] {
        let mut result = draped();
        spoil(&mut result);
        let text = result.text().unwrap();
        let refused = read::parse(text.as_bytes(), Path::new("result.json")).unwrap_err();
        assert!(matches!(refused, Error::File { .. }), "{refused}");
    }
}

/// A device has no end and a pipe may have no writer: neither is opened, whoever asks.
#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_refused_before_it_is_opened() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = |name: &str| {
        let path = folder.path().join(name);
        assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
        path
    };
    let no_file = |text: String| assert!(text.contains("not a regular file"), "{text}");
    for path in [pipe("pipe.json"), "/dev/zero".into()] {
        no_file(input::bytes(&path, 1 << 20).unwrap_err().to_string());
        no_file(read::read(&path).unwrap_err().to_string());
    }
    let scene = scene::read(&pipe("scene.toml")).unwrap_err();
    assert!(scene.help().contains("as a file"), "{}", scene.help());
    no_file(scene.to_string());
    no_file(mesh::read(&pipe("mold.stl"), 1.0, &Pose::ORIGIN, 0.0).unwrap_err().to_string());
    for (old, new) in [
        ("material = \"krogh2018\"", "material = \"pipe.toml\""),
        ("kind = \"plane\"", "kind = \"mesh\"\nfile = \"mold.stl\"\nunit = \"mm\""),
        ("spacing = [\"98 mm\", \"98 mm\"]\nheight = \"20 mm\"", "positions = \"pipe.csv\""),
    ] {
        let _ = std::fs::remove_file(folder.path().join("pipe.toml"));
        let _ = std::fs::remove_file(folder.path().join("pipe.csv"));
        pipe("pipe.toml");
        pipe("pipe.csv");
        let text = SCENE.replace(old, new);
        assert_ne!(text, SCENE);
        no_file(scene::parse(&text, folder.path(), "scene.toml").unwrap_err().to_string());
    }
}

/// A grid of elements in one part, and many lines that each place it once more.
fn deck(side: usize, instances: usize) -> String {
    let mut text = "*Part, name=p\n*Node\n".to_owned();
    for n in 0..=side {
        for m in 0..=side {
            text += &format!("{}, {n}, {m}, 0\n", n * (side + 1) + m + 1);
        }
    }
    text += "*Element, type=S4\n";
    for n in 0..side {
        for m in 0..side {
            let a = n * (side + 1) + m + 1;
            text += &format!(
                "{}, {a}, {}, {}, {}\n",
                n * side + m + 1,
                a + side + 1,
                a + side + 2,
                a + 1
            );
        }
    }
    text += "*End Part\n";
    for n in 0..instances {
        text += &format!("*Instance, name=i{n}, part=p\n{}, 0, 0\n*End Instance\n", n * (side + 1));
    }
    text
}

/// 10 000 elements in 10 000 places are 200 million triangles: the deck has 1 MB and says so before any is made.
#[test]
fn a_deck_that_grows_beyond_memory_is_refused_by_its_count() {
    let parse = |text: &str| mesh::parse("deck.inp", text.as_bytes(), 1e-3, &Pose::ORIGIN, 0.0);
    let refused = parse(&deck(100, 10_000)).unwrap_err();
    assert!(matches!(refused, Error::TooLarge { .. }), "{refused}");
    let text = refused.to_string();
    assert!(text.contains("200000000 triangles") && text.contains("4.0 GB are allowed"), "{text}");
    assert!(refused.help().contains("PLYDRAPE_MEMORY"));
    assert!(!matches!(parse(&deck(3, 2)), Err(Error::TooLarge { .. })));
}

/// Cutting a polygon takes the cube of its corners.
#[test]
fn a_polygon_of_ten_thousand_corners_is_refused_with_its_line() {
    let ring = |corners: usize| {
        let vertices: String = (0..corners)
            .map(|n| {
                let (y, x) = (n as f64 / corners as f64 * std::f64::consts::TAU).sin_cos();
                format!("v {x} {y} 0\n")
            })
            .collect();
        let face: String = (1..=corners).map(|n| format!(" {n}")).collect();
        format!("{vertices}f{face}\n")
    };
    let parse = |text: &str| mesh::parse("mold.obj", text.as_bytes(), 1.0, &Pose::ORIGIN, 0.0);
    let refused = parse(&ring(10_000)).unwrap_err();
    let text = refused.to_string();
    assert!(text.contains("line 10001: face 1 has 10000 corners"), "{text}");
    assert!(refused.help().contains("triangles"));
    let (mesh, _) = parse(&ring(100)).unwrap();
    assert_eq!(mesh.triangles().len(), 98);
    // many of them, each within the bound
    let (vertices, face) =
        ring(1000).split_once('f').map(|(v, f)| (v.to_owned(), format!("f{f}"))).unwrap();
    let many = vertices + &face.repeat(30);
    let text = parse(&many).unwrap_err().to_string();
    assert!(text.contains("faces of up to 1000 corners would take too long"), "{text}");
}

#[test]
fn a_formula_of_400_kilobytes_is_refused() {
    let long = "x + ".repeat(100_000) + "y";
    let refused = formula::read(&long).unwrap_err();
    let says = format!("the formula is {} characters long; 10000 are the most", long.len());
    assert_eq!(refused.message(), says);
    assert!(formula::read(&("x + ".repeat(2_000) + "y")).is_ok());
}

/// A million steps of four grippers are tens of gigabytes, and a thousand are not.
#[test]
fn a_million_steps_are_refused_with_their_estimate() {
    let steps = |count: usize| parse(&SCENE.replace("steps = 3", &format!("steps = {count}")));
    let refused = steps(1_000_000).unwrap_err();
    assert_eq!(refused.diagnostic().unwrap().line_column().map(|(line, _)| line), Some(17));
    assert!(
        refused.message().contains("1000000 steps") && refused.help().contains("PLYDRAPE_MEMORY"),
        "{refused}"
    );
    assert!(steps(1000).is_ok());
}

/// The search of a plan holds two such results. A drape of the same scene has three steps only, and is not refused.
#[test]
fn a_plan_of_more_steps_than_fit_the_memory_is_refused_with_its_estimate() {
    let scene = |grippers: usize| {
        let text = SCENE.replace("[2, 2]", &format!("[{grippers}, {grippers}]"));
        parse(&format!("{text}\n[plan]\nsteps = 90\n")).unwrap()
    };
    assert!(scene(4).plan_refusal.is_none());
    let refused = scene(50).plan_refusal.unwrap();
    assert!(
        refused.message.contains("a plan of 90 steps with 2500 grippers")
            && refused.help.contains("PLYDRAPE_MEMORY"),
        "{refused}"
    );
}

/// A sheet that fits the memory alone does not beside the drapes of a plan.
#[test]
fn a_plan_is_refused_for_its_sheet_too() {
    let scene = parse(SCENE).unwrap();
    let sheets = PlanSheets { nodes: 9e4, coarse_nodes: 1e3, keep: 40 };
    assert!(size::sheet(sheets.nodes, sheets.keep).is_ok());
    let plan = PlanSettings { steps: 10_000, ..scene.plan };
    assert!(size::plan(&scene.layup.ply, &plan, None).is_ok());
    let refused = size::plan(&scene.layup.ply, &plan, Some(sheets)).unwrap_err().to_string();
    assert!(
        refused.contains("with 4 grippers") && refused.contains("a sheet of 90000 nodes"),
        "{refused}"
    );
}

/// A million grippers are within the bounds of each direction. Their ideal drape alone would take minutes.
#[test]
fn a_million_grippers_are_refused_before_their_ideal_drape_is_sought() {
    let dome = std::fs::read_to_string(examples().join("04_dome/scene.toml")).unwrap();
    let began = Instant::now();
    let refused = parse(&dome.replace("[4, 4]", "[1000, 1000]")).unwrap_err();
    assert!(refused.message().contains("a single step with 1000000 grippers"), "{refused}");
    // that drape has 10⁸ nodes and takes minutes; a busy machine may take seconds for the refusal
    assert!(began.elapsed() < Duration::from_secs(30), "{:?}", began.elapsed());
}

/// Texts for people are plain; names of files, which a user may not choose, are shown escaped.
#[test]
fn control_characters_in_titles_are_refused_and_those_of_names_are_escaped() {
    for text in [
        format!("title = \"a\\u001b[31mred\"\n{SCENE}"),
        SCENE.replace(
            "\"krogh2018\"",
            "{ name = \"\\u0007\", mass = \"1 kg/m\", flexural_rigidity = \"1 N m^2\" }",
        ),
    ] {
        let refused = parse(&text).unwrap_err();
        assert!(refused.message().contains("control character \\u{"), "{refused}");
        assert!(refused.diagnostic().unwrap().line_column().is_some());
    }
    assert!(parse(&format!("title = \"Größe µ → 2\"\n{SCENE}")).is_ok());
    let scene = scene::parse(SCENE, Path::new(""), "a\u{1b}[31mred.toml").unwrap();
    assert_eq!(scene.title, "a\\u{1b}[31mred");
}
