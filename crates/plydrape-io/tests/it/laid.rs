//! Plies that are cut, laid on their molds from scenes: what counts, the target boundary, and which seed is taken.

use plydrape::net::Net;
use plydrape_io::scene::{self, IdealDrape};
use plydrape_io::write::net::{Findings, Summary};
use std::path::Path;

/// An L on a dome, as a scene; keys of `[target]`.
fn scene(target: &str) -> String {
    format!(
        r#####"
[ply]
outline = [["0 mm", "0 mm"], ["400 mm", "0 mm"], ["400 mm", "160 mm"], ["160 mm", "160 mm"], ["160 mm", "400 mm"], ["0 mm", "400 mm"]]
grippers = [4, 4]
cell = ["100 mm", "100 mm"]
array = {{ holds = ["####", "####", "##..", "##.."] }}
material = "krogh2018"
[mold]
kind = "sphere"
radius = "0.6 m"
position = [0, 0, "-0.6 m"]
[grippers]
spacing = ["98 mm", "98 mm"]
height = "90 mm"
origin = "centered"
[target]
{target}
[motion]
kind = "straight"
steps = 3
"#####
    )
}

fn write(folder: &Path, text: &str) -> std::path::PathBuf {
    let path = folder.join("scene.toml");
    std::fs::write(&path, text).expect("a file");
    path
}

fn laid(folder: &Path, text: &str) -> IdealDrape {
    scene::read_ideal_drape(&write(folder, text)).unwrap_or_else(|e| panic!("{e}"))
}

/// What is drawn, planned and simulated is one net: the search is part of reading a scene.
#[test]
fn a_searched_seed_is_the_same_for_the_net_and_for_the_drape() {
    let home = tempfile::tempdir().unwrap();
    let text = scene("seed = \"best\"\norigin = [\"30 mm\", \"20 mm\"]\ndirection = \"20 deg\"");
    let ideal = laid(home.path(), &text);
    let scene =
        scene::read(&home.path().join("scene.toml")).unwrap_or_else(|e| panic!("{e}")).scene;
    let net: &Net = scene.layup.target.as_ref().unwrap().drape.as_ref().unwrap();
    assert_eq!(net, &ideal.net);

    // the middle lies at the origin, turned as asked
    let outline = ideal.ply.cut.as_ref().unwrap().outline.bounds();
    let uv = [0, 1].map(|n| 0.5 * (outline[0][n] + outline[1][n]));
    let place = net.place(&ideal.mold, uv).expect("on the dome");
    assert!((place[0] - 0.03).hypot(place[1] - 0.02) < 1e-7, "{place:?}");
    let [u, _] = net.fibers(&ideal.mold, uv).expect("on the dome");
    assert!((u[1].atan2(u[0]).to_degrees() - 20.0).abs() < 1e-3, "{u:?}");

    // and it shears less than from the middle
    let largest = |net: &Net| net.report.largest_shear.unwrap().0;
    let home = tempfile::tempdir().unwrap();
    let plain = laid(home.path(), &text.replace("\"best\"", "\"middle\""));
    assert!(largest(net) < 0.95 * largest(&plain.net), "{} {}", largest(net), largest(&plain.net));
    let summary =
        Summary::new(net, &Findings::new(net, &ideal.mold, None, ideal.seeds.clone()), None);
    let search = summary.search.expect("a search");
    assert!((search.held_max_shear_deg.unwrap().to_radians() - largest(&plain.net)).abs() < 1e-12);
    assert_eq!(search.max_shear_deg, summary.max_shear_deg);
}

/// The whole array of a rectangle that is cut, on its mold with a key of `[target]`.
fn sheet(target: &str) -> String {
    format!(
        r#"
[ply]
size = ["320 mm", "220 mm"]
grippers = [3, 2]
cell = ["100 mm", "100 mm"]
material = "krogh2018"
[mold]
kind = "cylinder"
radius = "0.25 m"
position = [0, 0, "-0.25 m"]
[target]
{target}
"#
    )
}

/// A rectangle of 320 mm × 220 mm on a cylinder whose axis is along x, against a boundary 5 mm outside along the axis and 3 mm
/// inside around it: lengths unrolled, in a file in millimeters.
#[test]
fn trim_of_a_scene_is_measured_from_its_file() {
    let home = tempfile::tempdir().unwrap();
    let mut rows = String::from("x (mm),y (mm),z (mm)\n");
    let mut row = |x: f64, arc: f64| {
        let (sin, cos) = (arc / 250.0).sin_cos();
        rows += &format!("{x},{},{}\n", 250.0 * sin, 250.0 * cos - 250.0);
    };
    let arcs: Vec<f64> = (0..=40).map(|n| -107.0 + 214.0 * f64::from(n) / 40.0).collect();
    arcs.iter().for_each(|arc| row(165.0, *arc));
    arcs.iter().rev().for_each(|arc| row(-165.0, *arc));
    std::fs::write(home.path().join("edge.csv"), rows).unwrap();
    let ideal = laid(home.path(), &sheet("trim = \"edge.csv\""));
    let findings = Findings::new(&ideal.net, &ideal.mold, ideal.wanted.as_ref(), None);
    let trim = findings.trim.expect("a trim");
    let (beyond, short) = (trim.beyond.unwrap().error, trim.short.unwrap().error);
    // chords of the file's points are 0.007 mm off the mold
    assert!((beyond - 0.003).abs() < 1e-6, "{beyond}");
    assert!((short + 0.005).abs() < 1e-6, "{short}");
    assert!((trim.compared - 1.08).abs() < 1e-6 && trim.not_compared == 0.0, "{trim:?}");

    let refused =
        |text: &str| scene::read_ideal_drape(&write(home.path(), text)).unwrap_err().to_string();
    let high = "x (mm),y (mm),z (mm)\n0,0,0\n100,0,0\n100,0,90\n";
    std::fs::write(home.path().join("high.csv"), high).unwrap();
    let message = refused(&sheet("trim = \"high.csv\""));
    assert!(message.contains("point 3 of the target boundary lies 90.000 mm off"), "{message}");
    assert!(message.contains("high.csv"), "{message}");
    let message = refused(&sheet("trim = \"nothing.csv\""));
    assert!(message.contains("nothing.csv"), "{message}");
    // a simulation reads the file too
    let scene = scene::read(&write(home.path(), &sheet("trim = \"high.csv\"")));
    assert!(scene.unwrap_err().to_string().contains("high.csv"));
}

/// A rectangle that hangs over its mold between two nodes is not accepted: no node is missing, but 4 mm of fabric are.
#[test]
fn what_hangs_over_between_nodes_is_not_accepted() {
    let home = tempfile::tempdir().unwrap();
    let formula = "kind = \"formula\"\nz = \"0\"\nx = [\"-300 mm\", \"156 mm\"]\ny = [\"-300 mm\", \"300 mm\"]\n";
    let text = sheet("mesh = \"50 mm\"");
    let (head, tail) = text.split_once("kind = \"cylinder\"").unwrap();
    let (_, tail) = tail.split_once("[target]").unwrap();
    let ideal = laid(home.path(), &format!("{head}{formula}[target]{tail}"));
    assert!(ideal.net.missing.is_empty());
    let findings = Findings::new(&ideal.net, &ideal.mold, None, None);
    let summary = Summary::new(&ideal.net, &findings, None);
    assert!(!summary.accepted);
    assert!(summary.verdict().contains("4 mm beyond the mold's boundary"), "{}", summary.verdict());
    let boundary = summary.boundary.unwrap();
    assert!((boundary.off_mold_length - 0.228).abs() < 1e-6, "{boundary:?}");
    assert!((boundary.off_mold_area - 0.22 * 0.004).abs() < 0.22 * 1e-5, "{boundary:?}");
}

/// Tables of a hole on a dome: rings, points that close, headers with units; a search has a table and a picture.
#[test]
fn boundary_and_seeds_are_written() {
    let home = tempfile::tempdir().unwrap();
    let ideal = laid(home.path(), &scene("seed = \"best\"\ndirection = \"best\""));
    let findings = Findings::new(&ideal.net, &ideal.mold, None, ideal.seeds.clone());
    let out = home.path().join("out");
    let files =
        plydrape_io::write::net::write_all(&ideal.net, &ideal.mold, &findings, "L", &out, &[])
            .unwrap();
    assert_eq!(files.len(), 8, "{files:?}");
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let boundary = read("boundary.csv");
    let mut lines = boundary.lines();
    assert_eq!(lines.next(), Some("ring,part,point,u (m),v (m),x (m),y (m),z (m)"));
    let rows: Vec<&str> = lines.collect();
    let fields = |row: &str| row.split(',').skip(3).map(str::to_owned).collect::<Vec<_>>();
    assert_eq!(fields(rows[0]), fields(rows[rows.len() - 1]));
    assert_eq!(rows.len(), findings.boundary.unwrap().lines[0].points.len() + 1);
    let seeds = read("seeds.csv");
    assert_eq!(seeds.lines().count(), ideal.seeds.unwrap().choices.len() + 1);
    assert_eq!(seeds.lines().filter(|row| row.ends_with(",1")).count(), 1);
    let picture = read("seeds.svg");
    assert!(picture.contains("largest shear (deg)") && !picture.contains("NaN"));
    let map = read("shear.svg");
    assert!(map.contains("shear (deg)") && !map.contains("NaN"));
    // nodes.csv: those of the ply are where the outline has them
    let on_ply = read("nodes.csv").lines().skip(1).filter(|row| row.ends_with(",1")).count();
    assert_eq!(on_ply, ideal.net.report.placed);
    assert!(on_ply < ideal.net.nodes.len() * 3 / 4);
}
