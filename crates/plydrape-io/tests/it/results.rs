//! Result files: complete, read back to the same numbers, and the page made from them.

use crate::common;
use plydrape::errors::{Errors, GripperErrors, MoldErrors, Term};
use plydrape::measure::Name;
use plydrape::motion::Motion;
use plydrape::planner;
use plydrape::scene::Scene;
use plydrape_io::page;
use plydrape_io::result::Turned;
use plydrape_io::result::read;
use plydrape_io::scene::{self, SceneFile};
use plydrape_io::write::csv;
use plydrape_io::{Content, ResultFile};
use std::ops::ControlFlow;
use std::path::Path;

fn examples() -> impl Iterator<Item = SceneFile> {
    let mut folders: Vec<_> =
        std::fs::read_dir(common::examples()).unwrap().map(|entry| entry.unwrap().path()).collect();
    folders.sort();
    folders.into_iter().filter_map(|folder| {
        let file = folder.join("scene.toml");
        let scene = file.exists().then(|| scene::read(&file))?;
        if let Err(refused) = &scene {
            eprintln!("SKIPPED {}: {refused}", file.display());
        }
        scene.ok()
    })
}

/// The last three steps of a scene with rigid grippers, as catenaries have them: all there is to see, in little time.
fn short(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    let pad = &mut scene.layup.settings.pad;
    (pad.lateral_stiffness, pad.axial_stiffness) = (None, None);
    let from = scene.layup.motion.times.len().saturating_sub(3);
    let Motion { times, positions } = &mut scene.layup.motion;
    times.drain(..from);
    positions.drain(..from);
    scene
}

/// The result of a drape of these steps.
fn drape(scene: &SceneFile) -> ResultFile {
    let mut result = common::drape(&short(scene));
    result.scene.input = scene.input.clone();
    result
}

fn again(result: &ResultFile) -> ResultFile {
    read::parse(result.text().unwrap().as_bytes(), Path::new("result.json")).unwrap()
}

/// Every example's result reads back to what writes the same bytes: the file, its tables and page.
#[test]
fn all_outputs_can_be_made_from_the_file_alone() {
    for scene in examples() {
        let result = drape(&scene);
        let back = again(&result);
        let what = &scene.title;
        assert_eq!(back.text().unwrap(), result.text().unwrap(), "{what}");
        assert_eq!(csv::steps(&back).unwrap(), csv::steps(&result).unwrap(), "{what}");
        assert_eq!(csv::trajectory(&back).unwrap(), csv::trajectory(&result).unwrap(), "{what}");
        let pages = [&back, &result].map(|r| page::html(r).unwrap());
        assert_eq!(pages[0], pages[1], "{what}");
        assert_eq!(back.scene.input, scene.input, "{what}");
    }
}

/// A result says the errors of its scene and nothing of them where there are none; a mold with the waves of one draw is refused
/// in words and not written as a plain one.
#[test]
fn a_result_says_the_errors_of_its_scene_and_holds_no_waves() {
    let mut scene = common::example("01_flat_sheared_mold");
    let plain = common::drape(&short(&scene));
    let text = plain.text().unwrap();
    assert!(!text.contains("\"errors\"") && !text.contains("length_factor"));

    let term = Term::Deviation(1e-4);
    let mold = MoldErrors { waviness: term, wavelength: 0.15, ..MoldErrors::default() };
    let gripper = GripperErrors { position: term, ..GripperErrors::default() };
    let errors = Errors { seed: 7, gripper, mold, ..Errors::default() };
    scene.errors = Some(errors);
    let result = common::drape(&short(&scene));
    assert_eq!(again(&result).scene.errors, Some(errors));

    let real = errors.draw(0, scene.layup.ply.grid.grippers()).apply(&scene.layup);
    let result = common::drape(&short(&Scene { layup: real, ..scene }));
    let refused = result.text().unwrap_err().to_string();
    assert!(refused.contains("waves of one draw") && refused.contains("waviness"), "{refused}");
}

/// A mold from a result file is the mold that was draped on: the same closest points.
#[test]
fn molds_survive_the_file() {
    for scene in examples() {
        let Some(mold) = &scene.layup.mold else { continue };
        let back = again(&drape(&scene)).scene.mold.unwrap();
        for p in scene.layup.motion.positions.iter().flatten() {
            assert_eq!(back.closest_point(*p), mold.closest_point(*p), "{} at {p:?}", scene.title);
        }
    }
}

/// The sheet that decided on a plan is not draped again: its result is that of a drape along the planned motion, to the last
/// byte.
#[test]
fn the_sheet_of_a_plan_is_kept_as_if_draped_along_it() {
    let path = common::examples().join("01_flat_sheared_mold");
    let text = std::fs::read_to_string(path.join("scene.toml")).unwrap();
    let text = text + "\n[sheet]\nmesh = \"25 mm\"\nkeep = 7\n[limits]\ntilt_rate = \"1 deg/s\"\n";
    let mut scene = scene::parse(&text, &path, "flat").unwrap().scene;
    (scene.plan.steps, scene.plan.evaluations) = (20, 1);
    let planned = planner::plan(&scene, None, &mut |_| ControlFlow::Continue(())).unwrap();
    assert_eq!(planned.record.limited_by[0].name, Name::TiltRate);
    let dir = tempfile::tempdir().unwrap();
    let along = planner::along(&scene, &planned.motion);
    let kept = ResultFile::planned(&scene, None, planned, dir.path()).unwrap();
    let draped = common::decided(&along, dir.path());

    assert!(kept.steps == draped.steps, "the steps differ");
    let ended = |result: &ResultFile| (result.summary.status, result.summary.worst.clone());
    assert_eq!(ended(&kept), ended(&draped));
    let bytes = |result: &ResultFile| {
        let mut bytes = Vec::new();
        result.sheet_states.as_ref().unwrap().write(&mut bytes).unwrap();
        bytes
    };
    assert!(bytes(&kept) == bytes(&draped), "the states differ");
}

/// The motion of a plan is made from the file again, at any time to the last bit.
#[test]
fn a_planned_motion_survives_the_file() {
    let mut scene =
        scene::read(&common::examples().join("01_flat_sheared_mold/scene.toml")).unwrap();
    (scene.plan.steps, scene.plan.evaluations) = (20, 1);
    let planned = planner::plan(&scene, None, &mut |_| ControlFlow::Continue(())).unwrap();
    let (motion, attitudes) = (planned.motion.clone(), planned.attitudes.clone());
    let dir = tempfile::tempdir().unwrap();
    let result = ResultFile::planned(&scene, None, planned, dir.path()).unwrap();
    let turned = Turned { motion, attitudes };
    assert_eq!(result.motion().unwrap(), Some(&turned));
    assert_eq!(again(&result).motion().unwrap(), Some(&turned));
    assert!(again(&drape(&scene)).motion().unwrap().is_none());
}
