//! `plydrape simulate`, `plan` and `check` where the model is the sheet. Its mesh is coarse here: these tests are about the
//! command, not about the cloth.

use crate::common::{command, example, files, one_line, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The paper's example, whose model is a sheet of 65 nodes; `more` is written behind, in `[contact]` first.
fn scene(folder: &Path, more: &str) -> PathBuf {
    let text = std::fs::read_to_string(example("01_flat_sheared_mold")).unwrap();
    let file = folder.join("scene.toml");
    std::fs::write(&file, format!("{text}\n{more}\n[sheet]\nmesh = \"25 mm\"\n")).unwrap();
    file
}

fn run(what: &str, scene: &Path, folder: &Path, flags: &[&str]) -> Output {
    let mut command = command();
    command.arg(what).arg(scene).arg("-o").arg(folder).args(flags).output().unwrap()
}

fn result(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("result.json")).unwrap()).unwrap()
}

const FILES: [&str; 5] = ["report.html", "result.json", "sheet.npz", "steps.csv", "trajectory.csv"];

/// The summary of the sheet has all documented keys; result.json has the same, and names the file of the states.
#[test]
fn json_has_the_outcome_of_the_sheet() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let output = run("simulate", &scene(home.path(), ""), &out, &["--json"]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert_eq!(files(&out), FILES);
    let mut printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    for key in ["height_rms_mm", "height_share", "position_rms_mm", "steps", "time_s"] {
        assert!(!printed[key].is_null(), "{key} in {printed}");
    }
    for key in [
        "height_mm",
        "out_of_plane_deg",
        "fiber_angle_deg",
        "position_mm",
        "strain",
        "shear_deg",
        "gripper_load_n",
        "gripper_pull_n",
        "penetration_mm",
        "tilt_deg",
        "tilt_rate_deg_s",
    ] {
        assert!(!printed["final"][key].is_null(), "{key} in {printed}");
    }
    let keys = ["ridge_max_mm", "bridge_max_mm", "first_contact_step", "first_contact_uv_mm"];
    for key in keys {
        assert!(!printed["sheet"][key].is_null(), "{key} in {printed}");
    }
    assert_eq!(printed["sheet"]["nodes"], 65);
    assert_eq!((&printed["model"], &printed["status"]), (&"sheet".into(), &"converged".into()));
    assert!(printed["final"]["height_mm"].as_f64().unwrap() > 0.5 && printed["accepted"] == false);
    assert!(printed.get("catenaries").is_none() && printed.get("also").is_none());
    // but for the time it took, that is what the result says
    printed.as_object_mut().unwrap().remove("time_s");
    let written = result(&out);
    assert_eq!(written["summary"], printed);
    let states = &written["sheet_states"];
    let length = std::fs::metadata(out.join("sheet.npz")).unwrap().len();
    assert_eq!((&states["file"], &states["length"]), (&"sheet.npz".into(), &length.into()));
}

/// The option chooses the model that decides; the other one is neither draped nor named.
#[test]
fn the_option_chooses_the_model_that_decides() {
    let home = tempfile::tempdir().unwrap();
    let (scene, out) = (scene(home.path(), "friction = 0.3"), home.path().join("out"));
    let by_sheet = run("simulate", &scene, &out, &[]);
    let shown = text(&by_sheet.stdout);
    assert_eq!(by_sheet.status.code(), Some(0), "{shown}");
    assert!(
        shown.contains("\naccepted by the sheet in an ideal cell, without errors\n"),
        "{shown}"
    );
    assert!(!shown.contains("catenaries") && !shown.contains("FAIL"), "{shown}");
    assert_eq!(result(&out)["summary"]["accepted"], true);

    // what the sheet has left goes with it
    let by_catenaries = run("simulate", &scene, &out, &["--model", "catenaries"]);
    let shown = text(&by_catenaries.stdout);
    assert_eq!(by_catenaries.status.code(), Some(1), "{shown}");
    assert!(shown.contains("\nnot accepted by the catenaries: "), "{shown}");
    assert!(!shown.contains("sheet"), "{shown}");
    assert!(!files(&out).contains(&"sheet.npz".to_owned()) && files(&out).len() == FILES.len() - 1);
    let written = result(&out);
    assert!(written["summary"].get("sheet").is_none() && written["sheet_states"].is_null());

    // and the other way round
    let again = run("simulate", &example("01_flat_sheared_mold"), &out, &["--model", "sheet"]);
    assert_eq!(again.status.code(), Some(1));
    assert!(text(&again.stdout).contains("\nnot accepted by the sheet: height "));
    assert_eq!(files(&out), FILES);
}

#[test]
fn the_same_sheet_gives_the_same_bytes() {
    let home = tempfile::tempdir().unwrap();
    let scene = scene(home.path(), "");
    let [one, other] = ["one", "other"].map(|name| home.path().join(name));
    for out in [&one, &other] {
        run("simulate", &scene, out, &["--quiet"]);
    }
    for name in FILES {
        let read = |out: &Path| std::fs::read(out.join(name)).unwrap();
        assert!(read(&one) == read(&other), "{name} differs");
    }
}

/// What reads a result.json reads it with a sheet too, wherever the states are.
#[test]
fn a_result_with_a_sheet_is_reported_and_exported() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    run("simulate", &scene(home.path(), ""), &out, &["--quiet"]);
    let file = out.join("result.json");
    for (arguments, made) in [
        (vec!["report"], "report.html"),
        (vec!["export", "--to", "csv", "--even-if-rejected"], "steps.csv"),
    ] {
        let place = home.path().join(arguments[0]);
        let output = command().args(&arguments).arg(&file).arg("-o").arg(&place).output().unwrap();
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        assert!(files(&place).contains(&made.to_owned()));
    }
}

/// A limit of the motion counts whichever model drapes: the sheet lies flat, but the grippers leave their box.
#[test]
fn the_sheet_does_not_excuse_the_motion() {
    let home = tempfile::tempdir().unwrap();
    let workspace = "friction = 0.3\n[limits]\nworkspace = [[-1, 1], [-1, 1], [-0.01, 0.05]]";
    let output = run("simulate", &scene(home.path(), workspace), &home.path().join("out"), &[]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}{}", text(&output.stderr));
    let verdict = "\nnot accepted by the sheet: workspace 25 mm against 0 mm";
    assert!(shown.contains(verdict), "{shown}");
}

/// A material without the stiffnesses that a sheet needs is refused by every command, with what is missing and the same words, before
/// anything runs.
#[test]
fn a_scene_whose_sheet_cannot_be_made_is_refused_by_every_command_alike() {
    let home = tempfile::tempdir().unwrap();
    let good = std::fs::read_to_string(example("01_flat_sheared_mold")).unwrap();
    let file = home.path().join("bare.toml");
    let section = "mass = \"0.3143 kg/m\", flexural_rigidity = \"9e-6 N m^2\"";
    for (material, missing) in [
        (format!("{{ {section} }}"), "no stiffness in tension and shear"),
        (format!("{{ {section}, tension = \"15 kN/m\" }}"), "no stiffness in shear"),
    ] {
        std::fs::write(&file, good.replace("\"krogh2018\"", &material)).unwrap();
        let said = |arguments: &[&str]| {
            let output = command().args(arguments).arg(&file).output().unwrap();
            let message = text(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
            assert!(output.stdout.is_empty(), "{arguments:?}");
            message
        };
        let checked = said(&["check"]);
        let words = one_line(checked.as_bytes());
        assert!(words.contains(missing) && words.contains("help:"), "{words}");
        assert!(words.contains("bare.toml:9:12"), "{words}");
        for arguments in [
            &["simulate"][..],
            &["simulate", "--also", "catenaries"],
            &["plan"],
            &["plan", "--compare"],
            &["plan", "--also", "catenaries"],
        ] {
            assert_eq!(said(arguments), checked, "{arguments:?}");
        }
        assert_eq!(files(home.path()), ["bare.toml"]);
        // the catenaries need none of that
        let out = home.path().join("out");
        let output = run("simulate", &file, &out, &["--model", "catenaries"]);
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        std::fs::remove_dir_all(&out).unwrap();
    }
}

#[test]
fn check_says_how_large_the_sheet_is() {
    let home = tempfile::tempdir().unwrap();
    let output = command().arg("check").arg(scene(home.path(), "")).output().unwrap();
    let shown = one_line(&output.stdout);
    assert!(shown.contains("65 nodes, at most 25 mm apart; about 2.7 MB of memory"), "{shown}");
}

/// A stepwise plan is found by catenaries and judged by the sheet, which refuses it; nothing is said of what the catenaries think.
#[test]
fn a_stepwise_plan_has_the_verdict_of_the_sheet_alone() {
    let home = tempfile::tempdir().unwrap();
    let plan = "[plan]\nmethod = \"stepwise\"\nsteps = 30";
    let out = home.path().join("out");
    let output = run("plan", &scene(home.path(), plan), &out, &[]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}{}", text(&output.stderr));
    assert!(shown.contains("\nnot accepted by the sheet: "), "{shown}");
    assert!(!shown.contains("catenaries"), "{shown}");
    assert!(files(&out).contains(&"sheet.npz".to_owned()));
    let written = result(&out);
    assert_eq!(written["summary"]["accepted"], false);
    assert_eq!(written["summary"]["model"], "sheet");
}

/// A sheet of some 3 600 nodes takes long: an interrupt ends it soon, with whole files and the states so far.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_the_states_so_far() {
    let home = tempfile::tempdir().unwrap();
    let file = scene(home.path(), "");
    let fine = std::fs::read_to_string(&file).unwrap().replace("\"25 mm\"", "\"3 mm\"");
    std::fs::write(&file, fine).unwrap();
    let out = home.path().join("out");
    let mut command = command();
    command.arg("simulate").arg(&file).arg("-o").arg(&out).arg("--json");
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(1500));
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130), "{}", text(&output.stderr));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!((&printed["status"], &printed["accepted"]), (&"interrupted".into(), &false.into()));
    assert!((1..30).contains(&printed["steps"].as_u64().unwrap()), "{printed}");
    assert_eq!(files(&out), FILES);
}
