//! Scenes with curved molds: what the keys of `[mold]`, `[target]` and `[grippers]` come to.

use plydrape::mold::{Face, Graph, Mold, Surface};
use plydrape::net::{EdgeRule, Generators};
use plydrape::scene::Scene;
use plydrape_io::Error;
use plydrape_io::scene::{self};
use std::path::Path;

fn read(mold: &str, target: &str, grippers: &str) -> Result<Scene, Error> {
    let text = format!(
        "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [4, 4]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n\
         [mold]\n{mold}\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.8\n{grippers}\n{target}\n"
    );
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/broken");
    scene::parse(&text, &folder, "scene.toml").map(|file| file.scene)
}

fn scene(mold: &str, target: &str, grippers: &str) -> Scene {
    read(mold, target, grippers).unwrap_or_else(|e| panic!("{mold}: {e}"))
}

fn mold(keys: &str) -> Mold {
    scene(keys, "", "").layup.mold.expect("a mold")
}

const DOME: &str = "kind = \"sphere\"\nradius = 0.5";

/// Heights by hand: tops of the shapes, and formulas at a place.
#[test]
fn every_kind_of_mold_stands_where_its_keys_say() {
    let shift = "position = [0.1, 0, \"20 mm\"]";
    let turn = "rotation = [0, 0, \"90 deg\"]";
    let range = "x = [-0.2, 0.2]\ny = [-0.2, 0.2]";
    for (keys, place, height) in [
        (format!("kind = \"cylinder\"\nradius = 0.5\n{shift}"), [3.0, 0.3], 0.42),
        (format!("kind = \"cylinder\"\nradius = 0.5\n{turn}"), [0.3, 3.0], 0.4),
        ("kind = \"cylinder\"\nradius = 0.5\nside = \"inside\"".into(), [0.0, 0.3], -0.4),
        (format!("kind = \"sphere\"\nradius = 0.5\n{shift}"), [0.4, 0.0], 0.42),
        ("kind = \"torus\"\nring_radius = 0.8\ntube_radius = 0.5".into(), [0.0, 0.5], 0.4),
        (format!("kind = \"saddle\"\nradii = [0.5, 0.25]\n{range}"), [0.1, 0.1], -0.01),
        (format!("kind = \"saddle\"\nradii = [0.5, 0.25]\n{turn}"), [0.1, 0.0], -0.02),
        (format!("kind = \"formula\"\nz = \"-x^2 + 2*y\"\n{shift}"), [0.3, 0.1], 0.18),
        ("kind = \"height-grid\"\nfile = \"molds/bowl.csv\"".into(), [0.1, 0.25], 0.00625),
        ("kind = \"mesh\"\nfile = \"molds/flat.obj\"\nunit = \"cm\"".into(), [1.0, 2.0], 0.0),
    ] {
        let found = mold(&keys).highest_point(place).unwrap_or_else(|| panic!("{keys}"));
        assert!((found[2] - height).abs() < 1e-12, "{keys}: {found:?}");
    }
}

#[test]
fn a_range_is_the_border_of_the_mold_and_a_grid_has_its_own() {
    let domain = |keys: &str| match mold(keys) {
        Mold::Graph(Graph { domain, .. }) => domain,
        other => panic!("{other:?}"),
    };
    let range = "x = [-0.2, 0.3]\ny = [\"-10 mm\", 1]";
    let found = domain(&format!("kind = \"formula\"\nz = \"x*y\"\n{range}"));
    assert_eq!(found, Some([[-0.2, 0.3], [-0.01, 1.0]]));
    assert_eq!(domain("kind = \"formula\"\nz = \"x*y\""), None);
    let grid = domain("kind = \"height-grid\"\nfile = \"molds/bowl.csv\"");
    assert_eq!(grid, Some([[0.0, 0.4], [0.0, 0.4]]));
}

/// Beside a bowl and lower than its boundary the closest point may be on the lower side of its wall. The mold is below that wall
/// alone, so such a place is outside of it; a place below the wall is inside, and one above it is not.
#[test]
fn beside_a_bowl_and_below_its_boundary_there_is_no_mold() {
    let bowl =
        mold("kind = \"formula\"\nz = \"0.7*(x^2 + y^2)\"\nx = [-0.5, 0.5]\ny = [-0.5, 0.5]");
    for [x, y, z] in [[0.6, 0.0, 0.1], [0.0, -0.55, 0.15], [0.51, 0.2, 0.05], [-0.7, 0.6, 0.0]] {
        let closest = bowl.closest_point([x, y, z]);
        assert!(z < 0.7 * (x * x + y * y) && closest.beyond, "{closest:?}");
        // nothing of the mold is nearer than the side of its range
        let to_side = [x, y].map(|c| (c.abs() - 0.5).max(0.0));
        assert!(closest.distance >= to_side[0].hypot(to_side[1]), "{closest:?}");
    }
    assert!(bowl.closest_point([0.45, 0.0, 0.1]).distance < 0.0);
    assert!(bowl.closest_point([0.45, 0.0, 0.2]).distance > 0.0);
}

#[test]
fn rows_of_a_height_grid_come_in_any_order() {
    let folder = tempfile::tempdir().unwrap();
    let original = include_str!("broken/molds/bowl.csv");
    let mut lines: Vec<&str> = original.lines().collect();
    lines[1..].reverse();
    std::fs::write(folder.path().join("reversed.csv"), lines.join("\n")).unwrap();
    let text = |file: &str| {
        format!(
            "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
             [mold]\nkind = \"height-grid\"\nfile = \"{file}\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 1\n"
        )
    };
    let there = scene::parse(&text("reversed.csv"), folder.path(), "scene.toml").unwrap();
    let here = mold("kind = \"height-grid\"\nfile = \"molds/bowl.csv\"");
    assert_eq!(there.layup.mold, Some(here));
}

#[test]
fn sides_and_kinds_become_faces() {
    let inside = mold("kind = \"torus\"\nring_radius = 2\ntube_radius = 1\nside = \"inside\"");
    assert!(matches!(inside, Mold::Torus(torus) if torus.face == Face::Inside));
    let z = mold("kind = \"formula\"\nz = '0.1*x^2'");
    let Mold::Graph(Graph { surface: Surface::Formula { z }, .. }) = z else { panic!("{z:?}") };
    assert_eq!(z.text(), "0.1*x^2");
}

/// 100 mm in meshes of 10 mm or less, on a plane undivided; an odd number of cells has its middle in a cell.
#[test]
fn cells_are_divided_so_that_the_seed_is_a_node() {
    let layup = |mold: &str, target: &str| {
        let target =
            scene(mold, &format!("[target]\n{target}"), "").layup.target.expect("a target");
        let layup = target.drape.expect("a net").placement;
        (layup.nodes, layup.seed)
    };
    assert_eq!(layup(DOME, ""), ([31, 31], [0, 0]));
    assert_eq!(layup(DOME, "seed = \"middle\""), ([31, 31], [15, 15]));
    assert_eq!(layup(DOME, "seed = [\"25 mm\", 0]"), ([37, 31], [3, 0]));
    assert_eq!(layup(DOME, "mesh = \"25 mm\"\nseed = [0, \"75 mm\"]"), ([13, 13], [0, 3]));
    let plane = "kind = \"plane\"";
    assert_eq!(layup(plane, ""), ([4, 4], [0, 0]));
    assert_eq!(layup(plane, "seed = \"middle\""), ([7, 7], [3, 3]));
}

#[test]
fn the_target_says_how_the_net_is_laid() {
    let target = "[target]\norigin = [0.05, 0]\ndirection = \"30 deg\"\nshear = \"-5 deg\"\ngenerators = \"least-shear\"\nedges = \"chord\"\nmesh = \"50 mm\"\nseed = \"middle\"";
    let target = scene(DOME, target, "").layup.target.expect("a target");
    let layup = target.drape.expect("a net").placement;
    assert_eq!((layup.generators, layup.edges), (Generators::LeastShear, EdgeRule::Chord));
    assert_eq!((layup.heading, layup.shear), (30f64.to_radians(), -5f64.to_radians()));
    assert!((layup.place[2] - (0.25_f64 - 0.0025).sqrt()).abs() < 1e-12);
    assert_eq!(layup.mesh, [0.05, 0.05]);
}

/// By symmetry: the four corners of a ply laid from its middle on top of a dome are equally high.
#[test]
fn grippers_end_at_nodes_of_the_net() {
    let target = scene(DOME, "[target]\nseed = \"middle\"", "").layup.target.expect("a target");
    let net = target.drape.expect("a net");
    for (index, place) in target.grippers.iter().enumerate() {
        assert_eq!(net.node([10 * (index % 4), 10 * (index / 4)]), Some(*place));
        assert!((place.iter().map(|c| c * c).sum::<f64>().sqrt() - 0.5).abs() < 1e-12);
    }
    let corners = [0, 3, 12, 15].map(|n| target.grippers[n][2]);
    assert!(corners.iter().all(|z| (z - corners[0]).abs() < 1e-9), "{corners:?}");
}

/// A ply on a plane from its middle is the ply from its corner, moved by half its size.
#[test]
fn a_seed_in_the_middle_of_a_flat_ply_moves_it_by_half() {
    let plane = "kind = \"plane\"\ntilt = \"10 deg\"";
    let grippers = |target: &str| {
        scene(plane, &format!("[target]\nshear = \"20 deg\"\n{target}"), "")
            .layup
            .target
            .unwrap()
            .grippers
    };
    let (corner, middle) = (grippers(""), grippers("seed = \"middle\""));
    let half = [0, 1, 2].map(|k| 0.5 * (corner[0][k] + corner[15][k]));
    for (a, b) in corner.iter().zip(&middle) {
        for k in 0..3 {
            assert!((a[k] - half[k] - b[k]).abs() < 1e-12);
        }
    }
}

#[test]
fn a_centered_start_has_its_middle_and_heading_above_the_target() {
    let target = "[target]\nseed = \"middle\"\norigin = [0.05, -0.02]\ndirection = \"30 deg\"";
    let scene = scene(DOME, target, "origin = \"centered\"");
    let start = &scene.layup.motion.positions[0];
    let target = scene.layup.target.expect("a target").grippers;
    let middle = |points: &[[f64; 3]], k: usize| points.iter().map(|p| p[k]).sum::<f64>() / 16.0;
    for k in 0..2 {
        assert!((middle(start, k) - middle(&target, k)).abs() < 1e-12);
    }
    let heading = |points: &[[f64; 3]]| -> f64 {
        let along = |k: usize| (0..4).map(|j| points[4 * j + 3][k] - points[4 * j][k]).sum::<f64>();
        along(1).atan2(along(0))
    };
    assert!((heading(start) - heading(&target)).abs() < 1e-12);
    assert!(start.iter().all(|p| (p[2] - 0.8).abs() < 1e-12));
}

/// A pick-up is given by the middle of its array and the heading of u there; neither depends on the target.
#[test]
fn a_pick_up_has_its_middle_and_heading_where_the_scene_says() {
    let target = "[target]\nseed = \"middle\"\ndirection = \"30 deg\"";
    let start = |keys: &str| scene(DOME, target, keys).layup.motion.positions[0].clone();
    for (keys, heading) in
        [("middle = [1, -0.2]\ndirection = \"75 deg\"", 75.0_f64), ("middle = [1, -0.2]", 0.0)]
    {
        let points = start(keys);
        let middle = |k: usize| points.iter().map(|p| p[k]).sum::<f64>() / 16.0;
        assert!((middle(0) - 1.0).abs() < 1e-12 && (middle(1) + 0.2).abs() < 1e-12, "{keys}");
        let [x, y] = [0, 1].map(|k| points[3][k] - points[0][k]);
        assert!((y.atan2(x) - heading.to_radians()).abs() < 1e-12, "{keys}");
        // an origin puts gripper g0_0 there, with the same heading
        let turned = keys.replace("middle = [1, -0.2]", "origin = [1, -0.2]");
        let corner = start(&turned)[0];
        assert!((corner[0] - 1.0).abs() < 1e-12 && (corner[1] + 0.2).abs() < 1e-12, "{turned}");
    }
}

#[test]
fn a_start_in_the_hollow_of_a_trough_is_above_it() {
    let trough = "kind = \"cylinder\"\nradius = 1\nside = \"inside\"\nposition = [0, 0.147, 1.5]";
    assert!(read(trough, "", "").is_ok());
    let outside = read("kind = \"cylinder\"\nradius = 1\nposition = [0, 0.147, 0]", "", "");
    assert!(outside.unwrap_err().message().contains("inside the mold"));
}
