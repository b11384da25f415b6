//! `plydrape net` as a user calls it: exit codes, what is printed, what is written.

use crate::common::{command, text};
use serde_json::Value;
use std::path::Path;
use std::process::Output;

/// A dome.
const CAP: &str = "z = \"-(x^2 + y^2) / 0.3\"";

/// A ply of 200 mm, its seed in the middle, on a mold given by a formula; more of the scene.
fn scene(mold: &str, more: &str) -> String {
    format!(
        r#"
title = "A ply on a cap"
[ply]
grippers = [2, 2]
cell = ["200 mm", "200 mm"]
material = "krogh2018"
[mold]
kind = "formula"
{mold}
[target]
seed = "middle"
mesh = "5 mm"
{more}
"#
    )
}

/// `plydrape net` on the scene, in its folder.
fn net(folder: &Path, scene: &str, flags: &[&str]) -> Output {
    std::fs::write(folder.join("cap.toml"), scene).unwrap();
    command().current_dir(folder).args(["net", "cap.toml"]).args(flags).output().unwrap()
}

/// Exit 0, four files beside the scene, and the numbers of the table are those of the JSON.
#[test]
fn a_ply_that_lies_is_accepted_and_written() {
    let home = tempfile::tempdir().unwrap();
    let done = net(home.path(), &scene(CAP, ""), &[]);
    let table = text(&done.stdout);
    assert_eq!(done.status.code(), Some(0), "{table}{}", text(&done.stderr));
    let (_, wrote) = table.split_once("wrote cap.net:\n").unwrap_or_else(|| panic!("{table}"));
    for name in ["nodes.csv", "shear.svg", "net.vtp", "mold.vtp"] {
        assert!(home.path().join("cap.net").join(name).is_file(), "{name}");
        assert!(wrote.contains(name), "{table}");
    }
    let done = net(home.path(), &scene(CAP, ""), &["--json", "-o", "other"]);
    assert_eq!(done.status.code(), Some(0));
    let json: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(json["nodes"], serde_json::json!([41, 41]));
    for key in ["off_mold", "folded", "unreached"] {
        assert_eq!(json[key], 0, "{key}");
    }
    assert!(json["max_edge_error"].as_f64().unwrap() < 1e-12);
    assert!(json["time_ms"].as_f64().unwrap() > 0.0);
    let [largest, mean] = ["max_shear_deg", "mean_shear_deg"].map(|k| json[k].as_f64().unwrap());
    assert!(0.0 < mean && mean < largest);
    assert!(table.contains(&format!("largest shear  {largest:.2}° at u = ")), "{table}");
    assert!(table.contains(&format!("mean shear     {mean:.2}°")), "{table}");
}

/// Exit 1 beyond the scene's limit, and where the fabric runs off the mold; the
/// files are there all the same.
#[test]
fn a_ply_that_shears_too_much_or_runs_off_is_not_accepted() {
    let home = tempfile::tempdir().unwrap();
    let done = net(home.path(), &scene(CAP, "[limits]\nshear = \"5 deg\""), &[]);
    let table = text(&done.stdout);
    assert_eq!(done.status.code(), Some(1), "{table}{}", text(&done.stderr));
    assert!(table.contains("not accepted: shear") && table.contains("against 5.00°"), "{table}");
    assert!(home.path().join("cap.net/shear.svg").is_file());

    let small = format!("{CAP}\nx = [\"-90 mm\", \"90 mm\"]\ny = [\"-90 mm\", \"90 mm\"]");
    let done = net(home.path(), &scene(&small, ""), &["--json"]);
    assert_eq!(done.status.code(), Some(1), "{}", text(&done.stderr));
    let json: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert!(json["off_mold"].as_u64().unwrap() > 0 && json["accepted"] == false);
    assert_eq!(json["first_missing"][0]["reason"], "off-mold");
}

/// Exit 2 and the remedy if the scene does not say how to lay the ply.
#[test]
fn a_scene_without_a_target_has_no_net() {
    let home = tempfile::tempdir().unwrap();
    let scene = scene(CAP, "");
    let (without, _) = scene.split_once("[target]").unwrap();
    let done = net(home.path(), without, &[]);
    assert_eq!(done.status.code(), Some(2));
    assert!(text(&done.stderr).contains("no [target]"), "{}", text(&done.stderr));
    assert!(!home.path().join("cap.net").exists());
}

/// With --quiet nothing is printed, and a file of the user's stays.
#[test]
fn a_quiet_net_prints_nothing_and_overwrites_nothing_foreign() {
    let home = tempfile::tempdir().unwrap();
    let done = net(home.path(), &scene(CAP, ""), &["--quiet"]);
    assert!(done.status.success() && done.stdout.is_empty() && done.stderr.is_empty());
    let nodes = home.path().join("cap.net/nodes.csv");
    std::fs::write(&nodes, "mine").unwrap();
    let done = net(home.path(), &scene(CAP, ""), &["--quiet"]);
    assert_eq!(done.status.code(), Some(2));
    assert_eq!(std::fs::read_to_string(&nodes).unwrap(), "mine");
}

/// The hemisphere of Krogh et al. 2021 needs no grippers, and shears by 38.005° at most and 10.533° on the
/// mean, the numbers of the peer in `benches/peers/net.py`.
#[test]
fn the_hemisphere_needs_no_grippers_and_shears_as_its_peer_says() {
    let home = tempfile::tempdir().unwrap();
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/hemisphere_net/scene.toml");
    let scene = std::fs::read_to_string(example).unwrap();
    let done = net(home.path(), &scene, &["--json"]);
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    let json: Value = serde_json::from_slice(&done.stdout).unwrap();
    let shear = ["max_shear_deg", "mean_shear_deg"].map(|key| json[key].as_f64().unwrap());
    assert!((shear[0] - 38.005).abs() < 5e-4 && (shear[1] - 10.533).abs() < 5e-4, "{shear:?}");
}

/// The JSON has the boundary, the trim against a file and the seed that was taken, and the table says the same; a ply whose seed
/// is searched for stays where it is asked.
#[test]
fn boundary_trim_and_the_chosen_seed_are_printed_and_written() {
    let home = tempfile::tempdir().unwrap();
    // a square of 240 mm seen from above, on the cap
    let mut rows = String::from("x (mm),y (mm),z (mm)\n");
    for n in 0..160 {
        let (side, share) = (n / 40, f64::from(n % 40) / 20.0 - 1.0);
        let (x, y) = [(share, -1.0), (1.0, share), (-share, 1.0), (-1.0, -share)][side as usize];
        let (x, y) = (120.0 * x, 120.0 * y);
        rows += &format!("{x},{y},{}\n", -(x * x + y * y) / 300.0);
    }
    std::fs::write(home.path().join("edge.csv"), rows).unwrap();
    let scene = scene(CAP, "trim = \"edge.csv\"\norigin = [\"10 mm\", \"0 mm\"]");
    let scene = scene.replace("\"middle\"", "\"best\"");
    let done = net(home.path(), &scene, &["--json"]);
    assert_eq!(done.status.code(), Some(0), "{}", text(&done.stderr));
    let json: Value = serde_json::from_slice(&done.stdout).unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    let boundary = &json["boundary"];
    assert!((number(&boundary["length"]) - 0.8).abs() < 0.05, "{boundary}");
    assert_eq!(boundary["off_mold_length"], 0.0);
    assert_eq!(json["sharp_edges"], Value::Null);
    let trim = &json["trim"];
    // the flanks are steep, so 100 mm of ply along them reach less than 120 mm in plan
    assert!(number(&trim["short"]["error"]) < -0.02 && number(&trim["mean"]) < 0.0, "{trim}");
    assert!(trim["short"]["place"].is_array() && trim["short"]["fabric"].is_array());
    let search = &json["search"];
    assert!(number(&search["choices"]) > 30.0, "{search}");
    let [best, middle] = ["max_shear_deg", "held_max_shear_deg"].map(|key| number(&search[key]));
    assert!(best <= middle + 0.01 && best == number(&json["max_shear_deg"]), "{search}");
    for name in ["boundary.csv", "boundary.dxf", "seeds.csv", "seeds.svg"] {
        assert!(home.path().join("cap.net").join(name).is_file(), "{name}");
    }
    let table = text(&net(home.path(), &scene, &[]).stdout);
    for label in ["boundary ", "trim ", "search "] {
        assert!(table.lines().any(|line| line.starts_with(label)), "{label}: {table}");
    }
}
