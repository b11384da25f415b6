//! `plydrape plan --compare`: all named strategies of a scene side by side.

use crate::common::{command, example, files, one_line, text};
use serde_json::Value;
use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::process::Output;

const STRATEGIES: [&str; 5] = ["straight", "all at once", "rolled", "from a point", "stepwise"];

/// One cell over a dome with a mesh of 25 mm; `more` is written behind.
fn cell(folder: &Path, more: &str) -> PathBuf {
    let file = folder.join("cell.toml");
    let scene = "[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
                 [mold]\nkind = \"sphere\"\nradius = 1\nposition = [0, 0, -1]\n\
                 [grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\norigin = \"centered\"\n\
                 [target]\nseed = \"middle\"\n[plan]\nsteps = 10\n[sheet]\nmesh = \"25 mm\"\n";
    std::fs::write(&file, format!("{scene}{more}")).unwrap();
    file
}

fn run(what: &str, scene: &Path, flags: &[&str]) -> Output {
    command().arg(what).arg(scene).args(flags).output().unwrap()
}

/// The object of a strategy in what `--json` prints.
fn strategy<'a>(printed: &'a Value, name: &str) -> &'a Value {
    let all = printed["strategies"].as_array().unwrap();
    all.iter().find(|row| row["strategy"] == name).unwrap()
}

/// Straight paths leave ridges of millimeters, as `simulate` measures them on another way through the program; a front that
/// spreads from a point leaves none. All limits of straight are the same to the last digit.
#[test]
#[ignore = "long; a table over one cell stands for it; scripts/soak runs it"]
fn on_the_papers_example_straight_is_refused_for_its_height_and_a_front_accepted() {
    let home = tempfile::tempdir().unwrap();
    let folder = home.path().join("compared");
    let (scene, to) = (example("01_flat_sheared_mold"), folder.to_str().unwrap());
    let output = run("plan", &scene, &["--compare", "--json", "-o", to]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(strategy(&printed, "from-a-point")["accepted"], true);
    assert_eq!(printed["best"], "from-a-point");
    let straight = strategy(&printed, "straight");
    assert_eq!(straight["accepted"], false);
    let limits = straight["limits"].as_array().unwrap();
    let height = limits.iter().find(|limit| limit["name"] == "height").unwrap();
    assert!(height["ok"] == false && height["value"].as_f64().unwrap() > 2.0, "{height}");

    let simulated = home.path().join("simulated");
    let output = run("simulate", &scene, &["--json", "-o", simulated.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let simulated: Value = serde_json::from_slice(&output.stdout).unwrap();
    let simulated = simulated["limits"].as_array().unwrap();
    assert!(simulated.len() > 10, "{simulated:?}");
    assert_eq!(&limits[..simulated.len()], &simulated[..]);
}

/// The table has a row a strategy, as many cells in each as its header has, and a unit for each measure.
#[test]
fn the_table_has_every_strategy() {
    let home = tempfile::tempdir().unwrap();
    let scene = cell(home.path(), "");
    let output = run("plan", &scene, &["--compare"]);
    let (printed, folder) = (text(&output.stdout), home.path().join("cell.compare"));
    assert_eq!(files(&folder), ["comparison.csv"]);
    let csv = std::fs::read_to_string(folder.join("comparison.csv")).unwrap();
    let rows: Vec<Vec<String>> = csv.lines().map(cells).collect();
    assert_eq!(rows.len(), 1 + STRATEGIES.len(), "{csv}");
    let header: HashSet<&str> = rows[0].iter().map(String::as_str).collect();
    assert_eq!(header.len(), rows[0].len(), "a column twice in {header:?}");
    for title in ["t (s)", "height over the mold (mm)", "height over the mold limit (mm)"] {
        assert!(header.contains(title), "{title} in {header:?}");
    }
    for (row, name) in rows[1..].iter().zip(STRATEGIES) {
        assert_eq!((row[0].as_str(), row.len()), (name, rows[0].len()));
        let verdict = if row[1] == "true" { "accepted" } else { "not accepted" };
        let line = printed.lines().find(|line| line.starts_with(name)).unwrap();
        assert!(line.ends_with(verdict), "{line}");
    }
    assert!(printed.lines().all(|line| line.chars().count() <= 100), "{printed}");
    // a second run replaces its own files, and they are the same to the last byte
    let again = run("plan", &scene, &["--compare", "--threads", "1"]);
    assert_eq!(again.stdout, output.stdout);
    assert_eq!(std::fs::read_to_string(folder.join("comparison.csv")).unwrap(), csv);
}

/// Grippers on neighboring corners of a cell are never 10 m apart: each strategy fails by that, and so would any plan.
#[test]
fn without_an_accepted_strategy_the_exit_code_is_one() {
    let home = tempfile::tempdir().unwrap();
    let scene = cell(home.path(), "[limits]\ngripper_distance = \"10 m\"\n");
    let output = run("plan", &scene, &["--compare"]);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
    let printed = text(&output.stdout);
    assert!(printed.contains("no plan can keep these limits"), "{printed}");
    let (_, table) = printed.split_once("\nstrategy ").unwrap();
    assert_eq!(table.matches("\n  gripper distance ").count(), STRATEGIES.len(), "{printed}");
    assert!(printed.contains("but none is accepted"), "{printed}");
}

/// A comparison searches nothing, so that options of a search are refused beside it, by their names.
#[test]
fn options_of_a_search_are_refused_beside_compare() {
    let home = tempfile::tempdir().unwrap();
    let scene = cell(home.path(), "");
    for flags in [
        &["--improve"][..],
        &["--time", "5min"],
        &["--continue", "earlier"],
        &["--method", "stepwise"],
        &["--seed", "1"],
    ] {
        let output = run("plan", &scene, &[&["--compare"], flags].concat());
        let said = one_line(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{flags:?}");
        assert!(said.contains("--compare") && said.contains(flags[0]), "{said}");
    }
    assert!(!home.path().join("cell.compare").exists());
}

/// The cells of a line of a table whose texts may be quoted.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            c => cells.last_mut().unwrap().push(c),
        }
    }
    cells
}
