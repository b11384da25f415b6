//! Meshes as other programs write them, as molds of scenes: seams, gaps, pits and parts from CAD.

use plydrape::mold::mesh::Mesh;
use plydrape::mold::{Mold, Pose};
use plydrape_io::scene::{self, IdealDrape, SceneFile};
use std::f64::consts::PI;
use std::fmt::Write;
use std::sync::Arc;

type Point = [f64; 3];

/// The scene of 3 × 3 grippers over 200 mm, with keys of `[mold]`; its target is turned by an angle (deg).
fn scene_text(mold: &str, turn: f64) -> String {
    format!(
        r#"
[ply]
grippers = [3, 3]
cell = ["100 mm", "100 mm"]
material = "krogh2018"
{mold}
[grippers]
spacing = ["98 mm", "98 mm"]
height = "200 mm"
origin = "centered"
[target]
seed = "middle"
origin = [0, 0]
direction = "{turn} deg"
"#
    )
}

/// The keys of a mesh of millimeters.
fn keys(more: &str) -> String {
    format!("[mold]\nkind = \"mesh\"\nfile = \"mold.stl\"\nunit = \"mm\"\n{more}")
}

/// Triangles (mm) as a text STL of six digits.
fn stl(triangles: &[[Point; 3]]) -> String {
    let mut text = "solid part\n".to_owned();
    for corners in triangles {
        text += "facet normal 0 0 1\nouter loop\n";
        for [x, y, z] in corners {
            writeln!(text, "vertex {x:.6} {y:.6} {z:.6}").unwrap();
        }
        text += "endloop\nendfacet\n";
    }
    text + "endsolid part\n"
}

/// A patch of nx by ny cells over the unit square, in its place (mm).
fn patch(nx: usize, ny: usize, place: impl Fn(f64, f64) -> Point) -> Vec<[Point; 3]> {
    let vertex = |[i, j]: [usize; 2]| place(i as f64 / nx as f64, j as f64 / ny as f64);
    let cells = (0..nx).flat_map(|i| (0..ny).map(move |j| (i, j)));
    cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(vertex);
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// Two halves of a shallow dome that meet along x = 0, the right one moved by `off` (mm).
fn halves(off: Point) -> Vec<[Point; 3]> {
    let z = |x: f64, y: f64| 20.0 - (x * x + y * y) / 1200.0;
    let left = patch(4, 8, |s, t| {
        let [x, y] = [220.0 * (s - 1.0), 440.0 * (t - 0.5)];
        [x, y, z(x, y)]
    });
    let right = patch(4, 8, |s, t| {
        let [x, y] = [220.0 * s, 440.0 * (t - 0.5)];
        [x + off[0], y + off[1], z(x, y) + off[2]]
    });
    [left, right].concat()
}

/// A plate of 400 mm with a blind hole, or an open one, of a radius (mm) at (−20, −20) mm.
fn plate(radius: f64, depth: f64, has_floor: bool) -> Vec<[Point; 3]> {
    let cells = patch(20, 20, |s, t| [400.0 * s - 200.0, 400.0 * t - 200.0, 0.0]);
    let middle = |corners: &[Point; 3]| {
        [0, 1].map(|n| corners.iter().map(|p| p[n]).sum::<f64>() / 3.0 + 20.0)
    };
    let outside = |corners: &[Point; 3]| middle(corners).iter().any(|x| x.abs() > 20.0);
    let mut out: Vec<[Point; 3]> = cells.into_iter().filter(outside).collect();
    let ring = |n: usize, z: f64| {
        let (sin, cos) = (PI * n as f64 / 8.0).sin_cos();
        [radius * cos - 20.0, radius * sin - 20.0, z]
    };
    let square = |n: usize| {
        let (sin, cos) = (PI * n as f64 / 4.0).sin_cos();
        let most = sin.abs().max(cos.abs());
        [20.0 * cos / most - 20.0, 20.0 * sin / most - 20.0, 0.0]
    };
    for q in 0..8 {
        let [p0, p1, p2] = [0, 1, 2].map(|n| ring(2 * q + n, 0.0));
        let [s0, s1] = [square(q), square(q + 1)];
        out.extend([[s0, p1, p0], [s0, s1, p1], [s1, p2, p1]]);
    }
    for n in (0..16).filter(|_| has_floor) {
        let [a, b, c, d] = [ring(n, 0.0), ring(n + 1, 0.0), ring(n, -depth), ring(n + 1, -depth)];
        out.extend([[a, b, d], [a, d, c], [[-20.0, -20.0, -depth], c, d]]);
    }
    out
}

/// A scene on a mesh, as `check` and as `net` read it, or its refusal.
fn read(triangles: &[[Point; 3]], text: &str) -> Result<(SceneFile, IdealDrape), String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mold.stl"), stl(triangles)).unwrap();
    let path = folder.path().join("scene.toml");
    std::fs::write(&path, text).unwrap();
    let told = |error: plydrape_io::Error| format!("{error}; {}", error.help());
    Ok((scene::read(&path).map_err(told)?, scene::read_ideal_drape(&path).map_err(told)?))
}

/// Gaps, steps and overlaps below the tolerance of contact are no boundary: grippers have their places, and the ideal drape
/// goes across, whatever its direction, as it does over faces that meet.
#[test]
fn the_ideal_drape_goes_across_seams_below_the_tolerance() {
    let shear = |off: Point, turn: f64| {
        let (_, ideal) = read(&halves(off), &scene_text(&keys(""), turn)).unwrap();
        assert!(ideal.net.missing.is_empty() && ideal.warnings.is_empty(), "{off:?} {turn}");
        ideal.net.report.largest_shear.unwrap().0
    };
    for turn in [0.0, 20.0] {
        let meeting = shear([0.0; 3], turn);
        for off in [[0.002, 0.0, 0.0], [-0.01, 0.0, 0.0], [0.0, 0.0, 0.05], [0.15, 0.1, 0.0]] {
            // a seam of 0.15 mm bends cells of 10 mm by a hundredth of a radian at most
            let miss = shear(off, turn) - meeting;
            assert!(miss.abs() < 0.01, "{off:?} {turn} {miss}");
        }
    }
}

/// A gap above the tolerance ends the mold; the refusal says so, with its width, its place and what to do. A tolerance that is
/// larger takes it.
#[test]
fn a_ply_that_ends_at_a_gap_is_told_of_the_gap() {
    let apart = halves([0.5, 0.0, 0.0]);
    let text = scene_text(&keys(""), 0.0);
    let refusal = read(&apart, &text).unwrap_err();
    assert!(refusal.contains("a gap or step of 0.5 mm, 450 mm long"), "{refusal}");
    assert!(refusal.contains("stitch the faces or merge their vertices"), "{refusal}");
    assert!(read(&apart, &(text + "[contact]\ntolerance = \"0.6 mm\"\n")).is_ok());
}

/// On a flat plate the shear is 0 everywhere, because fabric spans a hole of 6 mm, blind or open; `spanned` says up to which
/// width, and a pit that is not spanned is named.
#[test]
fn fabric_spans_a_pit_or_a_hole_that_is_narrower_than_its_net() {
    let text = |more: &str| scene_text(&keys(more), 0.0);
    for (has_floor, what) in [
        (true, "a pit of 6 mm, 10 mm deep, at (-20, -20, 0) mm"),
        (false, "a hole of 6 mm at (-20, -20, 0) mm"),
    ] {
        let (scene, ideal) = read(&plate(3.0, 10.0, has_floor), &text("")).unwrap();
        assert!(ideal.net.missing.is_empty());
        assert!(ideal.net.report.largest_shear.unwrap().0 < 1e-9);
        let [warning] = &ideal.warnings[..] else { panic!("{:?}", ideal.warnings) };
        assert!(warning.contains(what) && warning.contains("taken as filled"), "{warning}");
        assert_eq!(scene.mesh.unwrap().warnings(), ideal.warnings);
    }
    for spanned in ["0", "\"4 mm\""] {
        let text = text(&format!("spanned = {spanned}\n"));
        let (_, ideal) = read(&plate(3.0, 10.0, true), &text).unwrap();
        assert!(ideal.net.report.largest_shear.unwrap().0 > 0.1);
        let warning = &ideal.warnings[0];
        assert!(warning.contains("a pit of 6 mm, 10 mm deep") && warning.contains("fill it"));
    }
    let refusal = read(&plate(3.0, 10.0, true), &text("spanned = \"150 mm\"\n")).unwrap_err();
    assert!(refusal.contains("more than a cell"), "{refusal}");
    // a pit that is wider folds the ply; the remedy is in the refusal
    let refusal = read(&plate(8.0, 10.0, true), &text("")).unwrap_err();
    assert!(refusal.contains("a pit of 16 mm, 10 mm deep, at (-20, -20, 0) mm"), "{refusal}");
    assert!(refusal.contains("spanned = \"17 mm\" in [mold]"), "{refusal}");
    let (_, ideal) = read(&plate(8.0, 10.0, true), &text("spanned = \"17 mm\"\n")).unwrap();
    assert!(ideal.net.report.largest_shear.unwrap().0 < 1e-9);
}

/// Molds that a program has made are read as those of files are.
#[test]
fn a_mold_from_a_program_is_stitched_and_spanned() {
    for triangles in [halves([0.002, 0.0, 0.0]), plate(3.0, 10.0, true)] {
        let vertices = triangles.as_flattened().iter().map(|p| p.map(|x| 1e-3 * x)).collect();
        let corners: Vec<[u32; 3]> =
            (0..triangles.len() as u32).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
        let (mesh, _) = Mesh::of_triangles(vertices, &corners).unwrap();
        let made = Some(Mold::Mesh(Arc::new(mesh)));
        let text = scene_text("", 0.0);
        let scene = scene::parse_for(&text, ".".as_ref(), "made", made, None, None);
        let scene = scene.unwrap_or_else(|e| panic!("{e}"));
        let net = scene.layup.target.as_ref().unwrap().drape.clone().unwrap();
        assert!(net.missing.is_empty() && net.report.largest_shear.unwrap().0 < 0.05);
    }
}

/// A part from CAD is refused with the command that makes a mesh of it.
#[test]
fn a_part_from_cad_is_answered_with_its_converter() {
    for (file, command) in [
        ("part.step", "python -m plydrape.cad part.step -o part.stl"),
        ("cad/Part 1.STP", "python -m plydrape.cad \"cad/Part 1.STP\" -o \"cad/Part 1.stl\""),
        ("part.igs", "python -m plydrape.cad part.igs -o part.stl"),
        ("part.iges", "python -m plydrape.cad part.iges -o part.stl"),
    ] {
        let error = plydrape_io::read::mesh::parse(file, b"ISO-10303-21;", 1.0, &Pose::ORIGIN, 0.0);
        let error = error.unwrap_err();
        assert!(error.help().contains(command), "{}", error.help());
    }
}
