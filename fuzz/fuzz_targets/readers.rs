//! Every reader of files, one input after the other in one process: no panic, no abort, no number that is not finite.
//!
//! The environment variable `READER` names the reader, and so the format of the inputs; each has its corpus in `corpus/READER`.

#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use plydrape::mold::Pose;
use plydrape_io::export::{self, Format, Options};
use plydrape_io::read::{formula, mesh, outline, urdf};
use plydrape_io::robot::program::{Program, Robot, Template, Tolerance, template};
use plydrape_io::scene::{self, Reading, SceneFile, read_fit};
use plydrape_io::result::SceneEcho;
use plydrape_io::{Error, ResultFile, plan, result};
use std::path::Path;
use std::sync::LazyLock;
use tempfile::TempDir;

/// A folder that scenes are read in, and that tables are written into.
static FOLDER: LazyLock<TempDir> = LazyLock::new(|| tempfile::tempdir().expect("a folder"));
/// A result with a tool, for templates.
static PROGRAM: LazyLock<Program> = LazyLock::new(|| {
    let result = result_of(include_bytes!("../corpus/result/tool.json"));
    Program::new(&result.expect("a result")).expect("a program")
});
/// The scene of `corpus/plan/search.json`.
static SEARCHED: LazyLock<SceneEcho> = LazyLock::new(|| {
    let text = include_str!("../corpus/scene/flat.toml");
    let scene = scene::parse(text, FOLDER.path(), "scene.toml").expect("a scene");
    let scene = SceneEcho::new(&scene, None);
    let state = include_str!("../corpus/plan/search.json");
    assert!(plan::read(state, &scene).is_ok_and(|search| search.is_unfinished()));
    scene
});
static READER: LazyLock<fn(&[u8]) -> Corpus> = LazyLock::new(|| {
    let name = std::env::var("READER").expect("READER names a reader");
    match name.as_str() {
        "scene" => of_scene,
        "book" => of_book,
        "material" => of_material,
        "table" => of_table,
        "formula" => of_formula,
        "drawing" => of_drawing,
        "stl" => |bytes| of_mesh("a.stl", bytes),
        "obj" => |bytes| of_mesh("a.obj", bytes),
        "inp" => |bytes| of_mesh("a.inp", bytes),
        "urdf" => of_robot,
        "result" => of_result,
        "plan" => of_plan,
        "picks" => of_picks,
        "template" => of_template,
        other => panic!("there is no reader {other}"),
    }
});

fuzz_target!(|bytes: &[u8]| -> Corpus { READER(bytes) });

/// A robot whose joints are numbers.
fn of_robot(bytes: &[u8]) -> Corpus {
    let Some(text) = text(bytes) else { return Corpus::Reject };
    if let Ok(robot) = urdf::parse("a.urdf", text, None, None) {
        for joint in &robot.joints {
            let numbers = joint.range.iter().chain(&joint.axis).chain(&joint.pose.position);
            assert!(numbers.chain([&joint.speed]).all(|number| number.is_finite()));
        }
    }
    Corpus::Keep
}

/// Text alone; what is none is refused before it is read.
fn text(bytes: &[u8]) -> Option<&str> {
    std::str::from_utf8(bytes).ok()
}

/// What is read goes into the corpus as what is refused does. A refusal has a short text, and is no fault of plydrape.
fn judge<T>(read: Result<T, Error>, sound: impl FnOnce(T)) -> Corpus {
    match read {
        Ok(read) => sound(read),
        Err(error) => {
            let text = format!("{error} {}", error.help());
            assert!(!matches!(error, Error::Internal(_) | Error::NotFinite { .. }), "{text}");
            assert!(text.len() < 20_000, "{text}");
        }
    }
    Corpus::Keep
}

fn finite<'a>(numbers: impl IntoIterator<Item = &'a f64>) {
    numbers.into_iter().for_each(|number| assert!(number.is_finite(), "{number}"));
}

fn sound_scene(scene: SceneFile) {
    let layup = &scene.layup;
    finite(&layup.ply.cell);
    finite(&layup.motion.times);
    layup.motion.positions.iter().for_each(|step| finite(step.as_flattened()));
    layup.target.iter().for_each(|target| finite(target.grippers.as_flattened()));
    assert!(layup.ply.grippers() > 0);
}

fn of_scene(bytes: &[u8]) -> Corpus {
    let Some(text) = text(bytes) else { return Corpus::Reject };
    judge(scene::parse(text, FOLDER.path(), "scene.toml"), sound_scene)
}

fn of_book(bytes: &[u8]) -> Corpus {
    let Some(text) = text(bytes) else { return Corpus::Reject };
    let sound = |book: scene::Book| book.plies.into_iter().for_each(|ply| sound_scene(ply.scene));
    judge(scene::parse_book(text, FOLDER.path(), "book.toml"), sound)
}

/// Writes an input under a name into the folder.
fn written(name: &str, bytes: &[u8]) -> std::path::PathBuf {
    let path = FOLDER.path().join(name);
    std::fs::write(&path, bytes).expect("room");
    path
}

fn of_material(bytes: &[u8]) -> Corpus {
    let path = written("mine.toml", bytes);
    judge(scene::read_material(&path.to_string_lossy()), |_| {})
}

/// Tables of machines, and of motions.
fn of_table(bytes: &[u8]) -> Corpus {
    let path = written("table.csv", bytes);
    for reading in [Reading::Pull, Reading::Overhang, Reading::Points, Reading::Moment] {
        judge(read_fit(&path, reading, &[None, None]), |table| finite(table.rows.as_flattened()));
    }
    let motion = "[ply]\ngrippers = [2, 1]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n\
        [motion]\nkind = \"file\"\nfile = \"table.csv\"\n[model]\nkind = \"catenaries\"\n";
    judge(scene::parse(motion, FOLDER.path(), "scene.toml"), sound_scene)
}

fn of_formula(bytes: &[u8]) -> Corpus {
    let Some(text) = text(bytes) else { return Corpus::Reject };
    judge(formula::read(text), |_| {})
}

fn of_drawing(bytes: &[u8]) -> Corpus {
    let options = outline::Options { unit: Some(1e-3), ..outline::Options::new(1e-4) };
    judge(outline::read_dxf("a.dxf", bytes, &options), |drawn| {
        finite(drawn.outline.boundary().as_flattened());
    })
}

fn of_mesh(name: &str, bytes: &[u8]) -> Corpus {
    judge(mesh::parse(name, bytes, 1e-3, &Pose::ORIGIN, 0.0), |(mesh, _)| {
        finite(mesh.vertices().as_flattened());
    })
}

/// A result with the check sum that it should have: otherwise nothing but that would be tried.
fn result_of(bytes: &[u8]) -> Result<ResultFile, Error> {
    let mark = b"\"crc32:";
    let mut bytes = bytes.to_vec();
    if let Some(at) = bytes.windows(mark.len()).rposition(|window| window == mark) {
        let sum = crc32fast::hash(&bytes[..at]);
        bytes.truncate(at);
        bytes.extend_from_slice(format!("\"crc32:{sum:08x}\"}}\n").as_bytes());
    }
    result::read::parse(&bytes, Path::new("result.json"))
}

/// What can be made of a result; the page is what is left.
const FORMATS: [Format; 9] = [
    Format::Csv,
    Format::Inp,
    Format::Pattern,
    Format::Boundary,
    Format::Ros2,
    Format::Robot(Robot::Rapid),
    Format::Robot(Robot::Krl),
    Format::Robot(Robot::Urscript),
    Format::Vtk,
];

/// What is read can be written again and is the same, and an export or the page writes finite numbers or refuses. To make them all of each
/// input would take most of the time, so the sum of the input says which.
fn of_result(bytes: &[u8]) -> Corpus {
    let which = crc32fast::hash(bytes) as usize % (FORMATS.len() + 2);
    judge(result_of(bytes), |result| {
        if let Some(format) = FORMATS.get(which) {
            let options = Options { even_if_rejected: true, ..Options::default() };
            judge(export::files(&result, *format, &options), |files| {
                for (name, content) in files.iter().filter(|(name, _)| name.ends_with(".csv")) {
                    let text = String::from_utf8_lossy(content);
                    assert!(!text.contains(",NaN") && !text.contains(",inf"), "{name}");
                }
            });
        } else if which == FORMATS.len() {
            judge(plydrape_io::page::html(&result), |_| {});
        } else {
            let written = result.text().expect("what is read can be written");
            let again = result::read::parse(written.as_bytes(), Path::new("result.json"));
            let again = again.expect("what is written can be read").text().expect("as before");
            assert_eq!(again, written);
        }
    })
}

/// A plan, and the state of a search of [`SEARCHED`].
fn of_plan(bytes: &[u8]) -> Corpus {
    let Some(text) = text(bytes) else { return Corpus::Reject };
    judge(plan::read(text, &SEARCHED), |_| {})
}

/// What a camera sees, as a file and as a line of standard input.
fn of_picks(bytes: &[u8]) -> Corpus {
    let Some(text) = text(bytes) else { return Corpus::Reject };
    judge(scene::json_offset(text, 2e-3).seen, |_| {});
    judge(scene::parse_offset(text, "picked.toml", 2e-3), |_| {})
}

fn of_template(bytes: &[u8]) -> Corpus {
    let Some(text) = text(bytes) else { return Corpus::Reject };
    let own = Template { name: "cell.txt.j2".into(), text: text.into() };
    judge(template::files(&PROGRAM, Robot::Rapid, &[own], &Tolerance::default()), |_| {})
}
