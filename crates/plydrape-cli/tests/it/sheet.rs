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

const FILES: [&str; 6] =
    ["figure.svg", "report.html", "result.json", "sheet.npz", "steps.csv", "trajectory.csv"];

/// The object `sheet` has all documented keys; result.json has the same but for the time, and names the file of the states.
#[test]
fn json_has_the_outcome_of_the_sheet() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let output = run("simulate", &scene(home.path(), ""), &out, &["--json"]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    assert_eq!(files(&out), FILES);
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut sheet = printed["sheet"].clone();
    for key in [
        "height_max_mm",
        "height_rms_mm",
        "height_share_above_half_mm",
        "ridge_max_mm",
        "bridge_max_mm",
        "out_of_plane_deg",
        "fibre_angle_deg",
        "position_max_mm",
        "position_rms_mm",
        "strain_max",
        "shear_max_deg",
        "gripper_force_max_n",
        "penetration_mm",
        "first_contact_step",
        "first_contact_uv_mm",
        "nodes",
        "time_s",
        "converged",
    ] {
        assert!(!sheet[key].is_null(), "{key} in {sheet}");
    }
    assert_eq!((&sheet["nodes"], &sheet["converged"]), (&65.into(), &true.into()));
    assert!(sheet["height_max_mm"].as_f64().unwrap() > 0.5 && printed["accepted"] == false);
    sheet.as_object_mut().unwrap().remove("time_s");
    let written = result(&out);
    assert_eq!(written["summary"]["sheet"], sheet);
    let states = &written["sheet_states"];
    let length = std::fs::metadata(out.join("sheet.npz")).unwrap().len();
    assert_eq!((&states["file"], &states["length"]), (&"sheet.npz".into(), &length.into()));
}

/// Both models are draped; the catenaries come out as they do alone, and the option chooses which one decides.
#[test]
fn the_option_chooses_the_model_that_decides() {
    let home = tempfile::tempdir().unwrap();
    let (scene, out) = (scene(home.path(), "friction = 0.3"), home.path().join("out"));
    let both = run("simulate", &scene, &out, &[]);
    let shown = text(&both.stdout);
    assert_eq!(both.status.code(), Some(0), "{shown}");
    assert!(shown.contains("\nnot accepted by the catenaries: "), "{shown}");
    assert!(shown.contains("\naccepted by the sheet, which decides\n"), "{shown}");
    let with = result(&out);
    assert_eq!(with["summary"]["accepted"], true);

    // what the sheet has left goes with it
    let alone = run("simulate", &scene, &out, &["--model", "catenaries"]);
    let shown = text(&alone.stdout);
    assert_eq!(alone.status.code(), Some(1), "{shown}");
    assert!(shown.contains("\nnot accepted: ") && !shown.contains("sheet"), "{shown}");
    assert!(!files(&out).contains(&"sheet.npz".to_owned()) && files(&out).len() == FILES.len() - 1);
    let without = result(&out);
    assert_eq!(without["steps"], with["steps"]);
    assert!(without["summary"].get("sheet").is_none() && without.get("sheet_states").is_none());

    // and the other way round
    let again = run("simulate", &example("01_flat_sheared_mold"), &out, &["--model", "sheet"]);
    assert_eq!(again.status.code(), Some(1));
    assert!(text(&again.stdout).contains("\nnot accepted by the sheet, which decides\n  height "));
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
    let verdict = "not accepted by the sheet, which decides\n  workspace 25 mm against 0 mm";
    assert!(shown.contains(verdict), "{shown}");
}

/// A material without the stiffnesses that a sheet needs is refused with what is missing, before anything runs.
#[test]
fn a_material_without_stiffness_is_refused_at_once() {
    let home = tempfile::tempdir().unwrap();
    let bare = "{ mass = \"0.3143 kg/m\", flexural_rigidity = \"9e-6 N m^2\" }";
    let good = std::fs::read_to_string(example("01_flat_sheared_mold")).unwrap();
    let file = home.path().join("bare.toml");
    std::fs::write(&file, good.replace("\"krogh2018\"", bare)).unwrap();
    let out = home.path().join("out");
    let output = run("simulate", &file, &out, &["--model", "sheet"]);
    assert_eq!(output.status.code(), Some(2));
    let message = one_line(&output.stderr);
    assert!(message.contains("no stiffness in tension and shear"), "{message}");
    assert!(message.contains("bare.toml:9:12"), "{message}");
    assert!(!out.exists());
}

#[test]
fn check_says_how_large_the_sheet_is() {
    let home = tempfile::tempdir().unwrap();
    let output = command().arg("check").arg(scene(home.path(), "")).output().unwrap();
    let shown = one_line(&output.stdout);
    assert!(shown.contains("65 nodes, at most 25 mm apart; about 2.7 MB of memory"), "{shown}");
}

/// The search is by catenaries; its best motion is draped by the sheet, which refuses it.
#[test]
fn a_plan_says_both_verdicts() {
    let home = tempfile::tempdir().unwrap();
    let plan = "[plan]\nmethod = \"stepwise\"\nsteps = 30";
    let out = home.path().join("out");
    let output = run("plan", &scene(home.path(), plan), &out, &[]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}{}", text(&output.stderr));
    assert!(shown.contains("accepted by the catenaries"), "{shown}");
    assert!(shown.contains("\nnot accepted by the sheet, which decides\n"), "{shown}");
    assert!(!shown.contains("closest to its limit"), "{shown}");
    assert!(files(&out).contains(&"sheet.npz".to_owned()));
    let written = result(&out);
    assert_eq!(written["summary"]["accepted"], false);
    assert_eq!(written["summary"]["sheet"]["steps"], written["summary"]["steps"]);
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
    assert_eq!((&printed["steps"], &printed["accepted"]), (&30.into(), &false.into()));
    assert_eq!(printed["sheet"]["status"], "interrupted");
    assert!(printed["sheet"]["steps"].as_u64().unwrap() < 30);
    assert_eq!(files(&out), FILES);
}
