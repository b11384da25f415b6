//! One verdict: what is printed, the exit code, `--json` and result.json say the same, that of the model that decides, on one screen.

use crate::common::{command, example, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;

fn run(what: &str, scene: &Path, out: &Path, flags: &[&str]) -> Output {
    command().arg(what).arg(scene).arg("-o").arg(out).args(flags).output().unwrap()
}

fn result(out: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(out.join("result.json")).unwrap()).unwrap()
}

/// The paper's example with a sheet of 65 nodes and a plan of few drapes; `more` is written into `[contact]`.
fn coarse(folder: &Path, more: &str) -> PathBuf {
    let text = std::fs::read_to_string(example("01_flat_sheared_mold")).unwrap();
    let file = folder.join("coarse.toml");
    let tables = "[sheet]\nmesh = \"25 mm\"\n[plan]\nsteps = 30\nevaluations = 2\n";
    std::fs::write(&file, format!("{text}\n{more}\n{tables}")).unwrap();
    file
}

/// Whether a printed screen accepts, and by which model: of its one line that begins so.
fn said(shown: &str) -> (bool, &str) {
    let lines: Vec<&str> = shown.lines().filter(|line| line.contains("accepted by ")).collect();
    assert_eq!(lines.len(), 1, "{shown}");
    let (word, rest) = lines[0].split_once("accepted by the ").unwrap();
    assert!(word.is_empty() || word == "not ", "{shown}");
    (word.is_empty(), rest.split([':', ' ']).next().unwrap())
}

/// In every command and by every model.
#[test]
fn screen_exit_code_json_and_file_say_the_same_verdict() {
    let home = tempfile::tempdir().unwrap();
    let strip = example("02_hanging_strip");
    let (sticks, slides) = (home.path().join("a"), home.path().join("b"));
    [&sticks, &slides].iter().for_each(|folder| std::fs::create_dir(folder).unwrap());
    let (sticks, slides) = (coarse(&sticks, ""), coarse(&slides, "friction = 0.3"));
    let mut verdicts = Vec::new();
    for (what, scene, flags) in [
        ("simulate", &strip, &[][..]),
        ("simulate", &sticks, &[]),
        ("simulate", &sticks, &["--model", "catenaries"]),
        ("simulate", &slides, &[]),
        ("plan", &slides, &["--without-errors"]),
        ("plan", &sticks, &["--without-errors", "--method", "stepwise"]),
    ] {
        let out = home.path().join("out");
        let output = run(what, scene, &out, flags);
        let shown = text(&output.stdout);
        let (accepted, model) = said(&shown);
        assert_eq!(output.status.code(), Some(i32::from(!accepted)), "{flags:?} {shown}");
        assert_eq!(shown.contains("FAIL"), !accepted, "{shown}");
        let summary = &result(&out)["summary"];
        assert_eq!((&summary["accepted"], &summary["model"]), (&accepted.into(), &model.into()));

        let json = run(what, scene, &out, &[flags, &["--json"]].concat());
        let printed: Value = serde_json::from_slice(&json.stdout).unwrap();
        assert_eq!((&printed["accepted"], &printed["model"]), (&accepted.into(), &model.into()));
        assert_eq!(json.status.code(), output.status.code());
        assert_eq!(&printed["limits"], &summary["limits"]);
        verdicts.push((accepted, model.to_owned()));
    }
    // both verdicts by both models
    for model in ["sheet", "catenaries"] {
        for accepted in [true, false] {
            assert!(verdicts.contains(&(accepted, model.to_owned())), "{verdicts:?}");
        }
    }
}

/// The other model is shown beside, in one line, in `also` and in the result, and all else stays as it is without it, to the last digit.
#[test]
fn the_other_model_changes_neither_verdict_nor_exit_code() {
    let home = tempfile::tempdir().unwrap();
    // the sheet accepts what the catenaries do not
    let scene = coarse(home.path(), "friction = 0.3");
    for (what, also, flags) in [
        ("simulate", "catenaries", &[][..]),
        ("simulate", "sheet", &["--model", "catenaries"]),
        ("plan", "catenaries", &["--without-errors"]),
    ] {
        let [alone, both] = ["alone", "both"].map(|name| home.path().join(name));
        let without = run(what, &scene, &alone, flags);
        let with = run(what, &scene, &both, &[flags, &["--also", also]].concat());
        assert_eq!(with.status.code(), without.status.code(), "{}", text(&with.stderr));
        let [plain, shown] = [&without, &with].map(|output| text(&output.stdout));
        assert_eq!(said(&plain), said(&shown));
        let beside = format!("\nthe {also} beside, judging nothing: ");
        assert!(shown.contains(&beside) && !plain.contains(&beside), "{shown}");

        let [alone, both] = [&alone, &both].map(|out| result(out));
        for key in ["summary", "steps", "plan"] {
            assert_eq!(alone[key], both[key], "{key}");
        }
        assert!(alone["also"].is_null());
        assert_eq!(both["also"]["summary"]["model"], also);
        let json = run(
            what,
            &scene,
            &home.path().join("j"),
            &[flags, &["--also", also, "--json"]].concat(),
        );
        let printed: Value = serde_json::from_slice(&json.stdout).unwrap();
        assert_eq!(printed["also"], both["also"]["summary"]);
        assert_eq!(printed["accepted"], alone["summary"]["accepted"]);
    }
    // the same model twice is a slip
    let refused = run("simulate", &scene, &home.path().join("none"), &["--also", "sheet"]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(!home.path().join("none").exists());
}

/// The dome, simulated in a usual cell and planned in an ideal one: at most forty lines of a hundred letters, and no limit that fails where
/// the verdict accepts. All the rest is there on request.
#[test]
fn the_dome_fits_a_screen() {
    let home = tempfile::tempdir().unwrap();
    let [usual, ideal] = ["04_dome", "ideal_dome"].map(example);
    for (what, scene, flags, title) in [
        ("simulate", &usual, &[][..], "Dome: 4 × 4 grippers, "),
        ("plan", &ideal, &["--without-errors"], "Dome in an ideal cell: 4 × 4 grippers, "),
    ] {
        let accepted = what == "plan";
        let output = run(what, scene, &home.path().join(what), flags);
        let shown = text(&output.stdout);
        assert_eq!(said(&shown), (accepted, "sheet"), "{shown}");
        assert_eq!(shown.contains("FAIL"), !accepted, "{shown}");
        assert!(shown.lines().count() <= 40, "{shown}");
        // a folder may have a long name
        let widest = shown.lines().filter(|line| !line.starts_with("wrote "));
        assert!(widest.map(|line| line.chars().count()).max() <= Some(100), "{shown}");
        assert!(!shown.contains('\x1b'), "colors without a terminal: {shown}");
        assert!(shown.starts_with(title), "{shown}");
    }
    let output = run("simulate", &ideal, &home.path().join("all"), &["--verbose"]);
    let shown = text(&output.stdout);
    assert!(shown.lines().count() > 60 && said(&shown) == (false, "sheet"), "{shown}");
    for step in 1..=30 {
        let begins = |line: &str| line.trim_start().starts_with(&format!("{step} "));
        assert!(shown.lines().any(begins), "step {step} in {shown}");
    }
}
