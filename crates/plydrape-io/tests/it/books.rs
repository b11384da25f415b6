//! Plybooks: what is shared and what is a ply's own, what lies on what, and what is refused.

use crate::common::drape_sheet;
use plydrape::measure::Name;
use plydrape::mold::Mold;
use plydrape_io::Error;
use plydrape_io::scene::{self, Book};
use std::path::Path;

/// What the plies of these books share: a plane, an array of 3 × 2 cups, straight paths.
const SHARED: &str = "title = \"Part\"\n[mold]\nkind = \"plane\"\n[ply]\nmaterial = \"krogh2018\"\nthickness = \"0.3 mm\"\n\
    grippers = [3, 2]\ncell = [0.1, 0.1]\narray = { margin = \"10 mm\" }\n[grippers]\nspacing = [0.1, 0.1]\nheight = \"20 mm\"\n\
    origin = \"centered\"\n[target]\nseed = \"middle\"\n[contact]\nfriction = 0.3\n[sheet]\nmesh = \"25 mm\"\n";

fn read(text: &str) -> Result<Book, Error> {
    scene::parse_book(text, Path::new(""), "plies.toml")
}

fn book(plies: &str) -> Book {
    read(&format!("{SHARED}{plies}")).unwrap_or_else(|error| panic!("{error}"))
}

/// One ply of a book: its name, its size (m) and where its middle lies (m).
fn ply(name: &str, [a, b]: [f64; 2], [x, y]: [f64; 2]) -> String {
    format!(
        "[[plies]]\nname = \"{name}\"\nply = {{ size = [{a}, {b}] }}\ntarget = {{ origin = [{x}, {y}] }}\n"
    )
}

const SIZE: [f64; 2] = [0.24, 0.14];

/// What a book refuses: the line and column, and all of the message.
fn refused(text: &str) -> (Option<(usize, usize)>, String) {
    let error = read(text).expect_err("refused");
    (error.diagnostic().unwrap().line_column(), format!("{}; {}", error.message(), error.help()))
}

fn line_of(text: &str, part: &str) -> usize {
    text[..text.find(part).expect("it is there")].matches('\n').count() + 1
}

#[test]
fn a_ply_has_the_shared_keys_and_its_own_in_their_place() {
    let own = "[[plies]]\nname = \"a\"\nply = { size = [0.3, 0.2], thickness = \"0.5 mm\" }\n[[plies]]\nname = \"b\"\n\
        ply = { size = [0.24, 0.14], warp = \"90 deg\" }\ntarget = { direction = \"30 deg\" }\nlimits = { height = \"1 mm\" }\n";
    let book = book(own);
    assert_eq!(book.title, "Part");
    let [a, b] = &book.plies[..] else { panic!("two plies") };
    assert_eq!([a.scene.title.as_str(), b.scene.title.as_str()], ["Part: a", "Part: b"]);
    assert_eq!([a.scene.thickness, b.scene.thickness], [Some(0.5e-3), Some(0.3e-3)]);
    assert_eq!([a, b].map(|ply| ply.scene.limits.most(Name::Height)), [0.5e-3, 1e-3]);
    let heading = |ply: &scene::BookPly| {
        ply.scene.layup.target.as_ref().unwrap().drape.as_ref().unwrap().placement.heading
    };
    // of the warp, a right angle from u in the second ply
    assert!(heading(a) == 0.0 && (heading(b) + 60_f64.to_radians()).abs() < 1e-12);
    assert_eq!([a.folder(0), b.folder(1)], ["01_a", "02_b"]);
}

/// Edges that meet are no overlap; a ply that lies apart is planned on the bare mold.
#[test]
fn a_ply_lies_on_the_earlier_ones_that_it_overlaps() {
    let book = book(
        &[
            ply("left", SIZE, [-0.12, 0.0]),
            ply("right", SIZE, [0.12, 0.0]),
            ply("over both", SIZE, [0.0, 0.0]),
            ply("far", SIZE, [0.0, 0.5]),
            ply("on the right", SIZE, [0.2, 0.0]),
        ]
        .concat(),
    );
    let lies_on: Vec<&[usize]> = book.plies.iter().map(|ply| &ply.lies_on[..]).collect();
    let expected: [&[usize]; 5] = [&[], &[], &[0, 1], &[], &[1, 2]];
    assert_eq!(lies_on, expected);
    for ply in &book.plies {
        let layers = match ply.scene.layup.mold.as_ref() {
            Some(Mold::Layered(layered)) => layered.relief.0.len(),
            Some(Mold::Plane(_)) => 0,
            other => panic!("{other:?}"),
        };
        assert_eq!(layers, ply.lies_on.len());
    }
}

/// Draped as cloth, not computed from the layers: where both lie, the sheet of the second ply is one thickness above the sheet of the
/// first. Each sheet lies within what contact gives way by (0.02 mm) on what is beneath.
#[test]
fn the_second_ply_lands_one_thickness_above_the_first() {
    let book =
        book(&[ply("first", [0.34, 0.24], [0.0; 2]), ply("second", SIZE, [0.0; 2])].concat());
    let drape = |n: usize| drape_sheet(&book.plies[n].scene).sheet.unwrap().drape;
    let [first, second] = [drape(0), drape(1)];
    let mean = |positions: &[[f64; 3]]| {
        let common = positions.iter().filter(|p| p[0].abs() < 0.1 && p[1].abs() < 0.05);
        let heights: Vec<f64> = common.map(|p| p[2]).collect();
        assert!(heights.len() >= 15, "{}", heights.len());
        heights.iter().sum::<f64>() / heights.len() as f64
    };
    let step = mean(&second.last.positions) - mean(&first.last.positions);
    assert!((step - 3e-4).abs() < 2e-5, "{step}");
}

/// Half of the second ply is beside the first: there its sheet comes down to the mold, beyond what its stiffness bridges. By the
/// deflection of a beam under its weight q that is (72 D t / q)^¼, 28 mm for this ply and step.
#[test]
fn a_ply_comes_down_to_the_mold_beside_the_one_beneath() {
    let book = book(&[ply("first", SIZE, [-0.12, 0.0]), ply("second", SIZE, [0.0; 2])].concat());
    let drape = drape_sheet(&book.plies[1].scene).sheet.unwrap().drape;
    let mut seen = [0, 0];
    for [x, _, z] in &drape.last.positions {
        if *x < -0.05 {
            assert!((z - 3e-4).abs() < 5e-5, "on the first ply at {x}: {z}");
            seen[0] += 1;
        } else if *x > 0.05 {
            assert!(z.abs() < 5e-5, "beside it at {x}: {z}");
            seen[1] += 1;
        }
    }
    assert!(seen.iter().all(|count| *count >= 12), "{seen:?}");
}

/// A ply as a scene file of its own lies on the book's mold; one with a mold is refused in its file.
#[test]
fn a_ply_may_be_a_scene_file_without_a_mold() {
    let dir = tempfile::tempdir().unwrap();
    let text = SHARED.replace("title = \"Part\"\n[mold]\nkind = \"plane\"\n", "");
    let scene = text.replace("[ply]\n", "[ply]\nsize = [0.24, 0.14]\n");
    std::fs::write(dir.path().join("one.toml"), &scene).unwrap();
    let head = "[mold]\nkind = \"plane\"\n[[plies]]\nscene = \"one.toml\"\n[[plies]]\nname = \"again\"\nscene = \"one.toml\"\n";
    let book = scene::parse_book(head, dir.path(), "plies.toml").unwrap();
    assert_eq!(
        book.plies.iter().map(|ply| ply.name.as_str()).collect::<Vec<_>>(),
        ["one", "again"]
    );
    assert_eq!(book.plies[1].lies_on, [0]);
    std::fs::write(dir.path().join("one.toml"), scene + "[mold]\nkind = \"plane\"\n").unwrap();
    let error = scene::parse_book(head, dir.path(), "plies.toml").unwrap_err();
    assert!(
        error.diagnostic().unwrap().file.ends_with("one.toml")
            && error.diagnostic().unwrap().line_column().is_some(),
        "{error}"
    );
    assert!(error.message().contains("no mold of its own"), "{error}");
    let unused = head.replace("[[plies]]\nscene", "[limits]\nheight = 0.001\n[[plies]]\nscene");
    let error = scene::parse_book(&unused, dir.path(), "plies.toml").unwrap_err();
    assert!(error.message().contains("a scene file"), "{error}");
}

#[test]
fn a_thickness_is_wanted_only_where_another_ply_lies() {
    let text = format!("{SHARED}{}{}", ply("a", SIZE, [0.0; 2]), ply("b", SIZE, [0.0, 0.5]));
    let without = text.replace("thickness = \"0.3 mm\"\n", "");
    assert!(read(&without).is_ok());
    let on_it = without + &ply("c", SIZE, [0.05, 0.0]);
    let (place, message) = refused(&on_it);
    let lacking = line_of(&on_it, "[[plies]]\nname = \"a\"");
    assert_eq!(place, Some((lacking, 1)), "where the thickness is missing");
    assert!(message.starts_with("ply c: it lies on ply a, whose thickness"), "{message}");
    assert!(message.contains("add thickness = "), "{message}");
}

/// Every fault has its place in the book, the ply it is of, and a remedy.
#[test]
fn what_is_wrong_in_a_book_is_refused_with_its_place_and_its_ply() {
    let good = format!("{SHARED}{}", ply("a", SIZE, [0.0; 2]));
    let cases = [
        // a value of the ply's own
        (good.replace("[0.24, 0.14]", "[0.24, \"14\"]"), "\"14\"", "ply a: \"14\" has no unit"),
        // a shared value, found in the first ply
        (good.replace("\"20 mm\"", "\"20 s\""), "height", "ply a: \"20 s\""),
        (
            good.replace("target = {", "target = { seeed = 1,"),
            "seeed",
            "ply a: `seeed` is no key here",
        ),
        (
            good.replace("name = \"a\"\n", "name = \"a\"\ncolor = 1\n"),
            "color",
            "`color` is no key here",
        ),
        (good.replace("name = \"a\"\n", ""), "[[plies]]", "ply 1: the ply has no name"),
        (good.replace("name = \"a\"", "name = \"\""), "name = ", "the name is empty"),
        (good.clone() + &ply("a", SIZE, [0.0, 0.5]), "", "plies 1 and 2 have the same name"),
        (
            good.replace("target = {", "mold = { kind = \"plane\" }\ntarget = {"),
            "mold = {",
            "no `mold` of its own",
        ),
        (good.replace("origin = [0, 0]", "positions = []"), "target = {", "ply a: "),
        (good.replace("[mold]\nkind = \"plane\"\n", ""), "", "the book has no [mold]"),
        (SHARED.into(), "", "the book has no [[plies]]"),
        (SHARED.replace("title", "plies = []\ntitle"), "plies", "there cannot be 0 plies"),
        (SHARED.replace("title", "plies = 3\ntitle"), "plies", "no list of tables"),
    ];
    for (text, place, message) in cases {
        let (found, all) = refused(&text);
        assert!(all.contains(message), "{all}");
        if !place.is_empty() {
            assert_eq!(found.map(|(line, _)| line), Some(line_of(&text, place)), "{all}");
        }
    }
}

/// A book in place of a scene is refused as a book, with what to do.
#[test]
fn a_book_is_no_scene() {
    let text = format!("{SHARED}{}", ply("a", SIZE, [0.0; 2]));
    let error = scene::parse(&text, Path::new(""), "plies.toml").unwrap_err();
    assert_eq!(error.diagnostic().unwrap().line_column(), Some((line_of(&text, "[[plies]]"), 1)));
    assert!(
        error.message().contains("plybook") && error.help().contains("plydrape plan"),
        "{error}"
    );
}

/// Every place where the trellis would be used reads the material: scenes, books, ideal drapes and plies alone.
#[test]
fn a_unidirectional_ply_is_refused_with_its_reason() {
    let material = "material = { mass = \"0.2 kg/m^2\", bending_rigidity_warp = 1e-3, bending_rigidity_weft = 1e-5, tension = 1e5, shear_curve = 5.0, fabric = \"unidirectional\" }";
    let text = format!("{SHARED}{}", ply("a", SIZE, [0.0; 2]));
    let text = text.replace("material = \"krogh2018\"", material);
    let (place, message) = refused(&text);
    assert_eq!(place.map(|(line, _)| line), Some(line_of(&text, "material = ")));
    assert!(message.starts_with("ply a: a unidirectional ply"), "{message}");
    let scene_text = text.split("[[plies]]").next().unwrap();
    for error in [
        scene::parse(scene_text, Path::new(""), "scene").unwrap_err(),
        scene::parse_ply(scene_text, Path::new(""), "scene").unwrap_err(),
    ] {
        assert!(error.message().contains("does not shear as a trellis"), "{error}");
    }
    let woven = text.replace("unidirectional", "woven");
    assert!(read(&woven).is_ok(), "{:?}", read(&woven).err());
}
