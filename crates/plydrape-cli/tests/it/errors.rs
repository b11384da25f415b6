//! Drapes with errors behind `plydrape plan` and `plydrape simulate`: what they print, write and leave out.

use crate::common::{command, text};
use serde_json::Value;
use std::path::Path;
use std::process::Output;

/// Four grippers over a flat mold that come down from high above, which the catenaries accept.
const SCENE: &str = "\
[model]
kind = \"catenaries\"

[ply]
grippers = [2, 2]
cell = [\"100 mm\", \"100 mm\"]
material = \"krogh2018\"

[mold]
kind = \"plane\"

[grippers]
spacing = [\"98 mm\", \"98 mm\"]
height = \"75 mm\"

[target]
origin = [\"0 mm\", \"0 mm\"]

[motion]
kind = \"straight\"
steps = 12

[plan]
steps = 12
evaluations = 30
";

/// Eight cells whose grippers are off by up to `bound`.
fn errors(samples: usize, bound: &str) -> String {
    format!(
        "\n[errors]\nsamples = {samples}\n\n[errors.gripper]\nposition = {{ bound = \"{bound}\" }}\n"
    )
}

fn run(name: &str, folder: &Path, more: &str, flags: &[&str]) -> Output {
    let scene = folder.join("flat.toml");
    std::fs::write(&scene, format!("{SCENE}{more}")).unwrap();
    command().arg(name).arg(scene).args(flags).output().unwrap()
}

fn printed(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap()
}

/// Every accepted plan says what it tolerates; in a hurry it does not.
#[test]
fn a_plan_without_errors_says_what_it_tolerates() {
    let home = tempfile::tempdir().unwrap();
    let output = run("plan", home.path(), "", &[]);
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(0), "{shown}{}", text(&output.stderr));
    let law = " mm (standard deviation of each gripper's position along each axis)\n";
    assert!(
        shown.contains("\naccepted by the catenaries in an ideal cell, without errors\n"),
        "{shown}"
    );
    assert!(shown.contains("\ntolerates errors of ") && shown.contains(law), "{shown}");

    let printed_of = |flags: &[&str]| printed(&run("plan", home.path(), "", flags));
    let plain = printed_of(&["--json"]);
    assert!(plain["tolerance"]["gripper_mm"].as_f64().unwrap() > 0.0, "{plain}");
    assert!(plain.get("sample").is_none());
    let hurried = printed_of(&["--json", "--without-errors"]);
    assert!(hurried.get("tolerance").is_none() && hurried["accepted"] == true, "{hurried}");
    let drawn = errors(0, "0.01 mm");
    let none = printed(&run("plan", home.path(), &drawn, &["--json"]));
    assert!(none.get("tolerance").is_none() && none.get("sample").is_none(), "{none}");
}

/// A plan that is not accepted tolerates nothing, and no cell is draped to find that.
#[test]
fn a_plan_that_is_not_accepted_tolerates_no_errors() {
    let home = tempfile::tempdir().unwrap();
    let output = run(
        "plan",
        home.path(),
        "\n[limits]\ncontact_share = 1\ngripper_distance = \"0.5 m\"\n",
        &["--anyway"],
    );
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}{}", text(&output.stderr));
    assert!(shown.contains("\ntolerates no errors: it is not accepted without any\n"), "{shown}");
}

/// Errors of a micrometer are kept by a plan, those of 20 mm by none, so that the first of eight cells refuses it; the verdict, the exit
/// code and the files agree.
#[test]
fn a_sample_decides_with_the_errors_of_the_scene() {
    let home = tempfile::tempdir().unwrap();
    for (bound, code) in [("0.001 mm", 0), ("20 mm", 1)] {
        let more = errors(8, bound);
        let output = run("plan", home.path(), &more, &["--json"]);
        let found = printed(&output);
        assert_eq!(output.status.code(), Some(code), "{found}{}", text(&output.stderr));
        let sample = &found["sample"];
        let cells = sample["cells"].as_array().unwrap();
        let accepted = cells.iter().filter(|cell| cell["accepted"] == true).count();
        let drawn = if code == 0 { 8 } else { 1 };
        assert_eq!((cells.len(), sample["needed"].as_u64()), (drawn, Some(8)));
        assert_eq!((accepted == 8, &found["accepted"]), (code == 0, &sample["ok"]), "{found}");
        let file = std::fs::read(home.path().join("flat.plan/result.json")).unwrap();
        let written: Value = serde_json::from_slice(&file).unwrap();
        assert_eq!(&written["summary"]["sample"], sample);
        assert_eq!(written["summary"]["tolerance"], found["tolerance"]);

        let shown = text(&run("plan", home.path(), &more, &[]).stdout);
        let said = match code {
            0 => {
                "\n8 of 8 cells with errors keep every limit: 95 % of all cells do, with 33.7 % confidence\n"
            }
            _ => {
                "\n1 of 1 cells with errors fails, so fewer than 95 % keep the limits, with 95 % confidence\n"
            }
        };
        assert!(shown.contains(said) && shown.contains("  95 %  "), "{shown}");
        let left_out = run("plan", home.path(), &more, &["--without-errors"]);
        let shown = text(&left_out.stdout);
        assert!(shown.contains("the errors of the scene were left out\n") || code == 1, "{shown}");
    }
}

/// A plan without errors is looked for without them, too: a frame that may be 40 mm off changes nothing of it, where each cell with that error
/// breaks a limit.
#[test]
fn a_plan_without_errors_is_looked_for_without_them() {
    let home = tempfile::tempdir().unwrap();
    let scene = home.path().join("dome.toml");
    let found = |bound: &str| {
        let text = format!(
            "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", \"100 mm\"]\n\
            material = \"prepreg_warm\"\n[mold]\nkind = \"sphere\"\nradius = \"1 m\"\n\
            position = [0, 0, \"-1 m\"]\n[grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"40 mm\"\n\
            origin = \"centered\"\n[target]\nseed = \"middle\"\n[sheet]\nmesh = \"20 mm\"\n\
            [plan]\nsteps = 40\nevaluations = 8\n\
            [errors]\nframe = {{ position = {{ bound = \"{bound}\" }} }}\n"
        );
        std::fs::write(&scene, text).unwrap();
        let plan = command().arg("plan").arg(&scene).args(["--without-errors", "--json"]).output();
        let found = printed(&plan.unwrap());
        ["accepted", "evaluations", "motion", "limits"].map(|key| found[key].clone())
    };
    let [small, large] = ["0.5 mm", "40 mm"].map(found);
    assert_eq!((&small[0], &small), (&true.into(), &large));
}

/// A simulated motion is judged by the errors of its scene, and by none where the scene has none.
#[test]
fn a_simulation_takes_the_errors_of_its_scene_alone() {
    let home = tempfile::tempdir().unwrap();
    let plain = printed(&run("simulate", home.path(), "", &["--json"]));
    assert!(plain.get("sample").is_none() && plain.get("tolerance").is_none(), "{plain}");
    let more = errors(4, "0.01 mm");
    let judged = printed(&run("simulate", home.path(), &more, &["--json"]));
    assert_eq!(judged["sample"]["cells"].as_array().map(Vec::len), Some(4), "{judged}");
    assert!(judged["tolerance"]["gripper_mm"].is_number());
    let left_out = printed(&run("simulate", home.path(), &more, &["--json", "--without-errors"]));
    assert!(left_out.get("sample").is_none());
}

/// Ctrl-C ends the drapes with errors: the drape itself is written, says so, and is not accepted.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_the_drapes_with_errors() {
    let home = tempfile::tempdir().unwrap();
    let scene = home.path().join("flat.toml");
    let long = SCENE.replace("[2, 2]", "[12, 12]").replace("steps = 12", "steps = 60");
    // no cell is accepted, and one of a thousand would be enough: that is decided by the last
    let drawn = errors(1000, "0.01 mm").replace("samples", "share = \"0.1 %\"\nsamples");
    std::fs::write(&scene, long + &drawn).unwrap();
    let mut command = command();
    command.arg("simulate").arg(&scene).stdout(std::process::Stdio::piped());
    let child = command.stderr(std::process::Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_secs(5));
    let kill = std::process::Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let shown = text(&output.stdout);
    assert_eq!(output.status.code(), Some(130), "{shown}{}", text(&output.stderr));
    assert!(
        shown.contains("\ninterrupted before all cells with the errors of the scene were draped\n"),
        "{shown}"
    );
    let file = std::fs::read(home.path().join("flat.results/result.json")).unwrap();
    let written: Value = serde_json::from_slice(&file).unwrap();
    assert!(written["summary"].get("sample").is_none());
    assert_eq!(written["summary"]["accepted"], false);
}
