//! Plies as they are cut: outlines, holes, overhang, cups that hold or not, and arrays at any angle to the yarns.

use crate::common::{self, distance, drape_sheet};
use plydrape::measure::Name;
use plydrape::ply::Grid;
use plydrape::scene::Scene;
use plydrape::sheet::{self, Sheet, Status};
use plydrape_io::export::{self, Format};
use plydrape_io::read::outline::{self, Options};
use plydrape_io::scene;
use std::path::Path;

/// A scene whose table [ply] has these keys, held still in the air or, with a mold, moved straight down on it.
fn parse(ply: &str, rest: &str) -> Scene {
    let text = format!(
        "[ply]\n{ply}\nmaterial = \"krogh2018\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n{rest}"
    );
    common::parse(&text)
}

const CYLINDER: &str = "origin = \"centered\"\n[mold]\nkind = \"cylinder\"\nradius = 0.5\nposition = [0, 0, -0.5]\n\
    [motion]\nkind = \"straight\"\nsteps = 2\n[target]\nseed = \"middle\"\n";

fn drape(scene: &Scene) -> sheet::SheetDrape {
    drape_sheet(scene).sheet.unwrap().drape
}

/// A rectangle that ends at its cups, whatever it is called: cut to a size, or given by its array alone.
#[test]
fn a_ply_that_is_cut_at_its_cups_is_the_ply_of_its_array() {
    let array = "grippers = [4, 2]\ncell = [0.1, 0.1]";
    let told = drape(&parse(array, ""));
    let cut = drape(&parse(&format!("{array}\nsize = [0.3, 0.1]"), ""));
    assert_eq!(cut.sheet.fabric.places, told.sheet.fabric.places);
    for (a, b) in cut.last.positions.iter().zip(&told.last.positions) {
        assert!(distance(*a, *b) < 1e-8, "{a:?} {b:?}");
    }
}

/// At rest in the air, the cups bear what is left of the ply and nothing else: holes, cut corners and overhang count.
#[test]
fn the_cups_bear_the_weight_of_what_is_cut_out() {
    let turned = "size = [0.34, 0.14]\nholes = [{ middle = [0.17, 0.07], diameter = 0.05 }]\nwarp = \"25 deg\"\n\
        grippers = [4, 2]\ncell = [0.1, 0.1]";
    let notched = "outline = [[0, 0], [0.24, 0], [0.24, 0.1], [0.16, 0.14], [0, 0.14]]\n\
        grippers = [3, 2]\ncell = [0.1, 0.1]\narray = { holds = [\"###\", \"##.\"], middle = [0.12, 0.07] }";
    for (ply, pad, cups) in [(turned, "pad_radius = 0.015\n", 8), (notched, "", 5)] {
        let scene = parse(ply, pad);
        assert_eq!(scene.layup.ply.grippers(), cups);
        let outline = &scene.layup.ply.cut.as_ref().unwrap().outline;
        let drape = drape(&scene);
        assert_eq!(drape.status, Status::Converged);
        let carried: f64 = -drape.last.forces.iter().map(|force| force[2]).sum::<f64>();
        let weight = drape.sheet.areal_mass * drape.sheet.gravity * outline.area();
        assert!((carried / weight - 1.0).abs() < 1e-4, "{carried} N of {weight} N");
    }
}

/// Nodes beyond the boundary, as in a hole, hang where the ply around them leads: none is lower than the ply. They would touch a mold
/// first, and shear the cells that they share with the ply.
#[test]
fn no_node_hangs_down_in_a_hole() {
    for middle in [[0.085, 0.07], [0.082, 0.071], [0.088, 0.066]] {
        let ply = format!(
            "grippers = [3, 3]\ncell = [0.1, 0.1]\nsize = [0.24, 0.24]\nholes = [{{ middle = {middle:?}, diameter = 0.032 }}]"
        );
        let drape = drape(&parse(&ply, "pad_radius = 0.015\n"));
        let fabric = &drape.sheet.fabric;
        let lowest = |inside: bool| {
            let nodes = drape.last.positions.iter().zip(&fabric.inside);
            let heights = nodes.filter(|(_, on)| **on == inside).map(|(place, _)| place[2]);
            heights.fold(f64::INFINITY, f64::min)
        };
        // within a fifth of a mesh, which a slope leads down
        assert!(lowest(false) > lowest(true) - 2e-3, "{} and {}", lowest(false), lowest(true));
    }
}

/// A ply whose edge hangs down beside the border of its mold is drawn over the border, and lies flat where it should.
#[test]
fn a_ply_is_drawn_over_the_border_of_its_mold() {
    let scene = common::parse(
        "[ply]\ngrippers = [3, 2]\ncell = [0.1, 0.1]\nsize = [0.25, 0.1]\narray = { middle = [0.15, 0.05] }\n\
         material = \"krogh2018\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.02\norigin = [-0.09, 0]\n\
         [mold]\nkind = \"formula\"\nz = \"0*x\"\nx = [-0.06, 0.3]\ny = [-0.06, 0.2]\n[contact]\nfriction = 0.3\n\
         [target]\nseed = [0.05, 0]\norigin = [0, 0]\n[motion]\nkind = \"straight\"\nsteps = 10\n",
    );
    let drape = drape(&scene);
    assert_eq!(drape.status, Status::Converged);
    for (place, at) in drape.sheet.fabric.places.iter().zip(&drape.last.positions) {
        let off = distance([place[0], place[1], 0.0], *at);
        assert!(off < 1e-3, "{place:?} lies at {at:?}, {off} m off");
    }
}

/// 43 mm of a ply hang over the border of a level mold in the end and bend steeply there. Heights, angles out of plane and depths in the mold
/// are those of what lies on it, and what hangs beside it has no height in the states that are kept.
#[test]
fn what_bends_over_the_border_of_its_mold_is_not_judged() {
    let scene = common::parse(
        "[ply]\ngrippers = [3, 2]\ncell = [0.1, 0.1]\nsize = [0.25, 0.1]\narray = { middle = [0.15, 0.05] }\n\
         material = \"krogh2018\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.04\norigin = \"centered\"\n\
         [mold]\nkind = \"formula\"\nz = \"0*x\"\nx = [-0.007, 0.3]\ny = [-0.06, 0.2]\n[contact]\nfriction = 0.3\n\
         [target]\nseed = [0.05, 0]\norigin = [0, 0]\n[motion]\nkind = \"straight\"\nsteps = 10\n",
    );
    let folder = tempfile::tempdir().unwrap();
    let result = common::decided(&scene, folder.path());
    let limits = &result.summary.limits;
    for name in [Name::Height, Name::OutOfPlane, Name::Penetration] {
        let found = limits.iter().find(|limit| limit.name == name).expect("it is judged");
        assert!(found.ok, "{name:?}: {} at {}", found.value, found.at);
    }
    let mut states = result.sheet_states.as_ref().expect("a sheet").open().unwrap();
    let end = states.state(states.states() - 1).unwrap().expect("a last state");
    assert!(end.positions.iter().any(|x| x[2] < -0.015), "it hangs beside the mold");
    for (place, height) in end.positions.iter().zip(end.height.iter()) {
        assert_eq!(place[0] < -0.007, height.is_nan(), "{place:?}: {height}");
    }
}

/// A formula is looked at as far as the ply reaches, also of one without a whole array: a level formula is a plane.
#[test]
fn a_ply_with_a_cup_off_lies_on_a_formula_as_on_a_plane() {
    let ply = "size = [0.24, 0.14]\ngrippers = [3, 2]\ncell = [0.1, 0.1]\narray = { holds = [\"###\", \"##.\"] }";
    let on = |mold: &str| {
        let rest = format!(
            "[mold]\n{mold}\n[motion]\nkind = \"straight\"\nsteps = 2\n[target]\nseed = \"middle\"\n"
        );
        parse(ply, &rest).layup.target.unwrap().grippers
    };
    let (plane, formula) = (on("kind = \"plane\""), on("kind = \"formula\"\nz = \"0*x\""));
    assert_eq!(plane.len(), 5);
    for (a, b) in plane.iter().zip(&formula) {
        assert!(distance(*a, *b) < 1e-9, "{a:?} {b:?}");
    }
}

/// The drawing may lie anywhere: turned and moved with its array and its warp, the ply and its cups are the same.
#[test]
fn a_drawing_may_lie_anywhere() {
    let drawn = |turn: f64, warp: &str| {
        let (sin, cos) = turn.to_radians().sin_cos();
        let place =
            |x: f64, y: f64| format!("[{}, {}]", 0.7 + cos * x - sin * y, cos * y + sin * x - 0.2);
        let corners = [(0.0, 0.0), (0.4, 0.0), (0.4, 0.2), (0.3, 0.3), (0.0, 0.3)];
        let outline: Vec<String> = corners.iter().map(|(x, y)| place(*x, *y)).collect();
        let ply = format!(
            "outline = [{}]\ngrippers = [3, 2]\ncell = [0.12, 0.11]\nwarp = \"{warp}\"\n\
             array = {{ middle = {}, direction = \"{turn} deg\" }}",
            outline.join(", "),
            place(0.19, 0.13)
        );
        parse(&ply, "").layup.ply
    };
    // along the yarns, and at 40 degrees to them
    for (here, there) in [
        (drawn(0.0, "0 deg"), drawn(37.0, "37 deg")),
        (drawn(0.0, "40 deg"), drawn(37.0, "77 deg")),
    ] {
        assert_eq!(here.grid, there.grid);
        assert_eq!(here.grippers(), there.grippers());
        let [a, b] = [&here, &there].map(|ply| ply.cut.as_ref().unwrap());
        for (p, q) in a.outline.boundary().iter().zip(b.outline.boundary()) {
            assert!((p[0] - q[0]).hypot(p[1] - q[1]) < 1e-12, "{p:?} {q:?}");
        }
        for n in 0..here.grippers() {
            let ([u, v], [p, q]) = (here.place(n), there.place(n));
            assert!((u - p).hypot(v - q) < 1e-12);
        }
        for uv in [[0.0, 0.0], [0.1, -0.2]] {
            let back = b.fabric(b.drawn(uv));
            assert!((back[0] - uv[0]).hypot(back[1] - uv[1]) < 1e-12);
        }
    }
}

/// A cylinder can be unrolled: a ply at 45 degrees to its array, and to the cylinder's axis, has its cups where the unrolled
/// array has them, and its ideal drape has no shear.
#[test]
fn a_ply_at_45_degrees_is_laid_on_a_cylinder_without_shear() {
    let ply = "size = [0.36, 0.26]\nwarp = \"45 deg\"\ngrippers = [4, 3]\ncell = [0.1, 0.1]";
    let scene = parse(ply, &format!("{CYLINDER}direction = \"45 deg\"\n"));
    let target = scene.layup.target.as_ref().unwrap();
    let net = target.drape.as_ref().unwrap();
    assert!(net.report.largest_shear.is_some_and(|(shear, _)| shear < 1e-6));
    for n in 0..12 {
        let [i, j] = scene.layup.ply.id(n).map(|k| k as f64);
        let (x, arc) = (0.1 * (i - 1.5), 0.1 * (j - 1.0));
        let (sin, cos) = (arc / 0.5).sin_cos();
        let expected = [x, 0.5 * sin, 0.5 * cos - 0.5];
        let found = target.grippers[n];
        assert!(distance(found, expected) < 1e-6, "{found:?} {expected:?}");
    }
    assert_eq!(scene.layup.ply.grid, Grid::NONE);
    // the start lies in rows along the array too
    let start = &scene.layup.motion.positions[0];
    assert!((distance(start[0], start[1]) - 0.098).abs() < 1e-12);
    assert!((start[0][1] - start[3][1]).abs() < 1e-9, "{start:?}");
}

/// A heading is that of the warp at every angle that the scene gives it, right angles too: where it is the warp's angle in the
/// drawing, the drawing's axes lie along those of the scene, on the table and on the mold.
#[test]
fn a_direction_is_the_heading_of_the_warp_at_every_angle() {
    for warp in [0, 30, 45, 89, 90, 91, 135, 180, 225, 270] {
        let ply = format!(
            "size = [0.36, 0.26]\nwarp = \"{warp} deg\"\ngrippers = [4, 3]\ncell = [0.1, 0.1]"
        );
        let rest = format!(
            "pad_radius = 0.015\ndirection = \"{warp} deg\"\nmiddle = [-0.7, 0.2]\n[mold]\nkind = \"plane\"\n\
             [target]\nseed = \"middle\"\norigin = [0.5, 0.1]\ndirection = \"{warp} deg\"\n"
        );
        let Scene { layup, .. } = parse(&ply, &rest);
        let start = &layup.motion.positions[0];
        for n in 0..12 {
            let [i, j] = layup.ply.id(n).map(|k| k as f64);
            let (x, y) = (i - 1.5, j - 1.0);
            let (taken, laid) = (start[n], layup.target.as_ref().unwrap().grippers[n]);
            let taken_at = [0.098 * x - 0.7, 0.098 * y + 0.2, 0.05];
            assert!(distance(taken, taken_at) < 1e-9, "{warp}: {taken:?} {taken_at:?}");
            let laid_at = [0.1 * x + 0.5, 0.1 * y + 0.1, 0.0];
            assert!(distance(laid, laid_at) < 1e-9, "{warp}: {laid:?} {laid_at:?}");
        }
    }
}

/// The middle of a ply is that of its drawing's box: corners that are cut off, cups that do not hold and yarns at an angle move
/// neither the array on the ply, nor the ply on the mold, nor the ply on the table.
#[test]
fn the_middle_of_a_ply_is_that_of_its_drawing() {
    let whole = "outline = [[0, 0], [0.4, 0], [0.4, 0.3], [0, 0.3]]";
    let corners = "outline = [[0, 0], [0.4, 0], [0.4, 0.18], [0.28, 0.3], [0, 0.3], [0, 0.02]]";
    for warp in [0, 45, 90] {
        let rest = format!(
            "direction = \"{warp} deg\"\nmiddle = [1.0, 2.0]\n[mold]\nkind = \"plane\"\n\
             [target]\norigin = [0.5, 0.1]\ndirection = \"{warp} deg\"\n"
        );
        let read = |outline: &str| {
            let keys = format!(
                "{outline}\nwarp = \"{warp} deg\"\ngrippers = [4, 3]\ncell = [0.1, 0.1]\n\
                 array = {{ margin = 0.02 }}"
            );
            parse(&keys, &rest).layup
        };
        let (whole, cut) = (read(whole), read(corners));
        assert!((whole.ply.grippers(), cut.ply.grippers()) == (12, 11));
        for n in 0..11 {
            let same = whole.ply.index(cut.ply.id(n)).unwrap();
            let drawn = [&whole, &cut].map(|layup| layup.ply.cut.as_ref().unwrap());
            let a = drawn[0].drawn(whole.ply.place(same));
            let b = drawn[1].drawn(cut.ply.place(n));
            assert!((a[0] - b[0]).hypot(a[1] - b[1]) < 1e-12, "{a:?} {b:?}");
            let starts = [&whole, &cut].map(|layup| &layup.motion.positions[0]);
            assert!(distance(starts[0][same], starts[1][n]) < 1e-9);
            let targets = [&whole, &cut].map(|layup| &layup.target.as_ref().unwrap().grippers);
            assert!(distance(targets[0][same], targets[1][n]) < 1e-9);
        }
    }
}

/// A list of cups at the places of an array is that array, and a mask that lets all hold is none.
#[test]
fn a_list_of_cups_is_the_array_at_their_places() {
    let sized = "size = [0.25, 0.15]\nwarp = \"10 deg\"";
    let array =
        parse(&format!("{sized}\ngrippers = [3, 2]\ncell = [0.1, 0.1]"), "pad_radius = 0.015\n");
    let list = "points = [[0.025, 0.025], [0.125, 0.025], [0.225, 0.025], [0.025, 0.125], [0.125, 0.125], [0.225, 0.125]]";
    let list = parse(&format!("{sized}\n{list}"), "pad_radius = 0.015\n");
    assert_eq!(array.layup.ply.grippers(), list.layup.ply.grippers());
    let [a, b] = [&array, &list].map(|scene| Sheet::new(&scene.layup).unwrap());
    assert_eq!(a.fabric.places.len(), b.fabric.places.len());
    for (a, b) in a.grippers.iter().zip(&b.grippers) {
        assert!((a.place[0] - b.place[0]).hypot(a.place[1] - b.place[1]) < 1e-12);
    }
    let masked = "grippers = [3, 2]\ncell = [0.1, 0.1]\narray = { holds = [\"###\", \"###\"] }";
    let masked = parse(&format!("{sized}\n{masked}"), "pad_radius = 0.015\n");
    assert_eq!(masked.layup.ply, array.layup.ply);
}

/// Cups beside the ply hold nothing; one that is partly on it holds nothing only if the scene says so.
#[test]
fn cups_hold_where_there_is_ply_around_them() {
    let ply = |partly: &str| {
        format!(
            "outline = [[0, 0], [0.35, 0], [0, 0.35]]\ngrippers = [4, 4]\ncell = [0.1, 0.1]\n\
             array = {{ middle = [0.17, 0.17], margin = 0.01{partly} }}"
        )
    };
    let scene = parse(&ply(", partly = \"leave-off\""), "");
    let ids: Vec<_> = (0..scene.layup.ply.grippers()).map(|n| scene.layup.ply.id(n)).collect();
    assert_eq!(ids, [[0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [0, 2]]);
    let text = format!("[ply]\n{}\nmaterial = \"krogh2018\"\n", ply(""));
    let refused = scene::parse(&text, Path::new(""), "scene").unwrap_err();
    assert!(refused.help().contains("leave-off"), "{refused}");
}

/// A drape of a ply with a hole, with rows of cups across its yarns, is written to every file and read back; the
/// pattern has the outline of the drawing, and the boundary ends where the net puts it.
#[test]
fn a_cut_ply_is_written_to_every_file() {
    let ply = "size = [0.22, 0.22]\nwarp = \"45 deg\"\ngrippers = [2, 2]\ncell = [0.1, 0.1]\n\
        holes = [{ middle = [0.11, 0.11], diameter = 0.04 }]";
    let rest = format!(
        "{CYLINDER}direction = \"45 deg\"\n[contact]\nfriction = 0.3\n[sheet]\nmesh = 0.02\n"
    );
    let scene = parse(ply, &rest);
    let folder = tempfile::tempdir().unwrap();
    let result = crate::common::decided(&scene, folder.path());
    let results = folder.path().join("results");
    plydrape_io::write_all(&result, &results).unwrap_or_else(|error| panic!("{error}"));
    let read = plydrape_io::result::read::read(&results.join("result.json")).unwrap();
    assert_eq!(read.scene.ply, scene.layup.ply);
    let any = export::Options { even_if_rejected: true, ..export::Options::default() };
    for format in
        [Format::Csv, Format::Ros2, Format::Vtk, Format::Pattern, Format::Boundary, Format::Inp]
    {
        let files = export::files(&read, format, &any)
            .unwrap_or_else(|error| panic!("{format:?}: {error}"));
        assert!(
            !files.is_empty() && files.iter().all(|(_, bytes)| !bytes.is_empty()),
            "{format:?}"
        );
    }

    let pattern = export::files(&read, Format::Pattern, &any).unwrap();
    let options = Options::new(1e-4);
    let layers = Some(vec!["CUT".into(), "HOLES".into()]);
    let options = Options { layers, ..options };
    let again = outline::read_dxf("pattern.dxf", &pattern[0].1, &options).unwrap().outline;
    let cut = scene.layup.ply.cut.as_ref().unwrap();
    assert!((again.area() - cut.outline.area()).abs() < 1e-9);
    assert!((again.bounds()[1][0] - 0.22).abs() < 1e-9 && again.holes().len() == 1);

    let (mold, net) = (scene.layup.mold.as_ref().unwrap(), scene.layup.target.as_ref().unwrap());
    let net = net.drape.as_ref().unwrap();
    let boundary = export::files(&read, Format::Boundary, &any).unwrap();
    let text = String::from_utf8(boundary[0].1.clone()).unwrap();
    let mut places = cut.outline.rings().flat_map(|ring| ring.iter().copied());
    let near = |place: [f64; 3]| {
        let off = text.lines().skip(1).map(|line| {
            let numbers: Vec<f64> = line.split(',').skip(2).map(|n| n.parse().unwrap()).collect();
            distance(place, [numbers[0], numbers[1], numbers[2]])
        });
        off.fold(f64::INFINITY, f64::min)
    };
    assert!(places.all(|uv| near(net.place(mold, uv).unwrap()) < 6e-3));
}

/// An outline is the same whether its points are in the scene or in a drawing.
#[test]
fn an_outline_may_be_a_drawing() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/it/broken/tables");
    let text = |outline: &str| {
        format!(
            "[ply]\noutline = {outline}\ngrippers = [3, 2]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
             [grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n"
        )
    };
    let read = |outline: &str| scene::parse(&text(outline), &folder, "scene");
    let drawn = read("{ file = \"square.dxf\", unit = \"mm\" }").unwrap().scene.layup.ply;
    let points = read("[[0, 0], [0.4, 0], [0.4, 0.3], [0, 0.3]]").unwrap().scene.layup.ply;
    let [a, b] = [&drawn, &points].map(|ply| &ply.cut.as_ref().unwrap().outline);
    assert!((a.area() - b.area()).abs() < 1e-15);
    assert_eq!(drawn.grippers(), points.grippers());
    let refused = read("\"square.dxf\"").unwrap_err();
    assert!(refused.to_string().contains("no unit"), "{refused}");
}
