//! `plydrape check` of a ply from a drawing: what it says of boundary and holes, and remedies that are then accepted.

use crate::common::{command, one_line, text};
use std::fmt::Write as _;
use std::path::Path;
use std::process::Output;

/// A drawing in millimeters.
fn drawing(entities: &str) -> String {
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    )
}

/// A rectangle between two corners.
fn rectangle(layer: &str, [a, b]: [f64; 2], [c, d]: [f64; 2]) -> String {
    let mut text = format!("0\nLWPOLYLINE\n8\n{layer}\n90\n4\n70\n1\n");
    for [x, y] in [[a, b], [c, b], [c, d], [a, d]] {
        let _ = write!(text, "10\n{x}\n20\n{y}\n");
    }
    text
}

/// Open lines from point to point.
fn lines(layer: &str, points: &[[f64; 2]]) -> String {
    let line = |pair: &[[f64; 2]]| {
        let ([a, b], [c, d]) = (pair[0], pair[1]);
        format!("0\nLINE\n8\n{layer}\n10\n{a}\n20\n{b}\n11\n{c}\n21\n{d}\n")
    };
    points.windows(2).map(line).collect()
}

/// Checks a ply whose table begins with these keys, beside a drawing `ply.dxf`.
fn check(keys: &str, dxf: &str) -> Output {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("ply.dxf"), dxf).unwrap();
    check_in(folder.path(), keys)
}

fn check_in(folder: &Path, keys: &str) -> Output {
    let scene = format!(
        "title = \"A ply\"\n[ply]\n{keys}\ngrippers = [5, 4]\ncell = [\"100 mm\", \"100 mm\"]\n\
         array = {{ partly = \"leave-off\" }}\nmaterial = \"krogh2018\"\n[mold]\nkind = \"plane\"\n\
         [grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"60 mm\"\norigin = \"centered\"\n\
         [target]\nseed = \"middle\"\n"
    );
    let file = folder.join("scene.toml");
    std::fs::write(&file, scene).unwrap();
    command().arg("check").arg(&file).output().unwrap()
}

/// What was refused, in one line.
fn refused(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    one_line(&output.stderr)
}

/// What was understood.
fn accepted(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

/// The table of a remedy, from its key to its closing brace.
fn remedy(said: &str, key: &str) -> String {
    let from = said.find(key).unwrap_or_else(|| panic!("no {key} in {said}"));
    let to = said[from..].find('}').unwrap();
    said[from..=from + to].to_owned()
}

/// The line to cut and the line to trim after the cure: which one is a hole nobody has said. 320 × 220 of 460 × 360 mm² are 43 %.
#[test]
fn a_drawing_with_lines_on_two_layers_asks_for_them_and_says_what_is_a_hole() {
    let dxf = drawing(
        &(rectangle("MEOP", [0.0, 0.0], [460.0, 360.0])
            + &rectangle("EOP", [70.0, 70.0], [390.0, 290.0])
            + "0\nHATCH\n8\nMEOP\n70\n1\n"),
    );
    let said = refused(&check("outline = \"ply.dxf\"", &dxf));
    assert!(
        said.contains("`MEOP` has one of 460 × 360 mm, `EOP` has one of 320 × 220 mm"),
        "{said}"
    );
    let one = accepted(&check(&remedy(&said, "outline = {"), &dxf));
    assert!(one.contains("cut to 460 × 360 mm, held by"), "{one}");
    assert!(one.contains("boundary of 460 × 360 mm from layer `MEOP`"), "{one}");
    assert!(one.contains("left out, as no outline is made of it: 1 HATCH"), "{one}");
    let both = "outline = { file = \"ply.dxf\", layers = [\"MEOP\", \"EOP\"] }";
    let ring = accepted(&check(both, &dxf));
    assert!(ring.contains("a hole of 320 × 220 mm from layer `EOP`, 43 % of the ply"), "{ring}");
}

/// An exploded drawing: three of its ends are 0.005 to 0.09 mm apart.
#[test]
fn gaps_that_were_closed_are_said() {
    let sides = lines("0", &[[0.0, 0.0], [300.0, 0.0]])
        + &lines("0", &[[300.0, 0.09], [300.0, 200.0], [0.0, 200.0], [0.0, 0.005]]);
    let said = accepted(&check("outline = \"ply.dxf\"", &drawing(&sides)));
    assert!(
        said.contains("2 gaps between ends of lines were closed, the widest of 0.09 mm"),
        "{said}"
    );
    let wide = drawing(&sides.replace("0.09", "0.19"));
    let said = refused(&check("outline = \"ply.dxf\"", &wide));
    let said = accepted(&check(&remedy(&said, "outline = {"), &wide));
    assert!(said.contains("the widest of 0.19 mm"), "{said}");
}

/// Each key that the refusal of a nest lists is accepted; the line of the grain on its own layer changes nothing.
#[test]
fn a_nest_lists_its_pieces_and_each_key_is_accepted() {
    let text = |words: &str, x: f64| format!("0\nTEXT\n8\n1\n10\n{x}\n20\n50\n1\n{words}\n");
    let nest = rectangle("1", [0.0, 0.0], [300.0, 200.0])
        + &rectangle("1", [400.0, 0.0], [650.0, 200.0])
        + &lines("7", &[[50.0, 100.0], [250.0, 100.0]]);
    let outline = "outline = { file = \"ply.dxf\", layers = [\"1\"] }";
    for (more, key) in [
        (String::new(), "piece = { point"),
        (text("L \"1\"", 10.0) + &text("R 1", 500.0), "piece = { label"),
    ] {
        let dxf = drawing(&(nest.clone() + &more));
        let said = refused(&check(outline, &dxf));
        let pieces: Vec<&str> = said.split("piece = {").skip(1).collect();
        assert_eq!(pieces.len(), 2, "{said}");
        for (piece, size) in pieces.iter().zip(["300 × 200", "250 × 200"]) {
            let piece = remedy(&format!("piece = {{{piece}"), "piece = {");
            assert!(piece.starts_with(key), "{piece}");
            let said = accepted(&check(&format!("{outline}\n{piece}"), &dxf));
            assert!(said.contains(&format!("cut to {size} mm, held by")), "{said}");
        }
        // no layer is named: the line of the grain is open, and the one layer that is not is proposed
        let said = refused(&check("outline = \"ply.dxf\"", &dxf));
        let layer = remedy(&said, "outline = {");
        assert_eq!(layer, outline);
    }
}

/// In a book of one nest each ply chooses its piece; the drawing is named once.
#[test]
fn the_plies_of_a_book_choose_their_pieces_of_one_drawing() {
    let folder = tempfile::tempdir().unwrap();
    let nest =
        rectangle("1", [0.0, 0.0], [300.0, 200.0]) + &rectangle("1", [400.0, 0.0], [680.0, 200.0]);
    std::fs::write(folder.path().join("nest.dxf"), drawing(&nest)).unwrap();
    let book = "title = \"A book\"\n[mold]\nkind = \"plane\"\n[ply]\noutline = \"nest.dxf\"\nthickness = \"0.3 mm\"\n\
        grippers = [3, 2]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n[grippers]\n\
        spacing = [\"98 mm\", \"98 mm\"]\nheight = \"60 mm\"\norigin = \"centered\"\n[target]\nseed = \"middle\"\n\
        [[plies]]\nname = \"a\"\nply = { piece = { point = [\"150 mm\", \"100 mm\"] } }\n\
        [[plies]]\nname = \"b\"\nply = { piece = { point = [\"500 mm\", \"100 mm\"] } }\n";
    let file = folder.path().join("book.toml");
    std::fs::write(&file, book).unwrap();
    let said = accepted(&command().arg("check").arg(&file).output().unwrap());
    assert!(said.contains("boundary of 300 × 200 mm from layer `1`"), "{said}");
    assert!(said.contains("boundary of 280 × 200 mm from layer `1`"), "{said}");
}

/// A piece of what has none, no way to choose, two ways, a name that is empty.
#[test]
fn a_piece_that_chooses_nothing_is_refused_at_its_place() {
    let dxf = drawing(&rectangle("1", [0.0, 0.0], [300.0, 200.0]));
    for (keys, says) in [
        ("size = [0.3, 0.2]\npiece = { block = \"A\" }", "the ply has none"),
        ("outline = \"ply.dxf\"\npiece = {}", "`piece` chooses no piece"),
        ("outline = \"ply.dxf\"\npiece = { block = \"A\", label = \"B\" }", "in more than one way"),
        ("outline = \"ply.dxf\"\npiece = { label = \" \" }", "is empty"),
        ("outline = \"ply.dxf\"\npiece = { block = \"A\" }", "places no block \"A\""),
        ("outline = \"ply.dxf\"\npiece = { label = \"A\" }", "no piece has the label \"A\""),
        ("outline = \"ply.dxf\"\npiece = \"A\"", "is a text"),
        ("piece = { block = \"A\" }", "the ply has none"),
    ] {
        let said = refused(&check(keys, &dxf));
        assert!(said.contains(says), "{keys}: {said}");
        // in the column in which the value of `piece` begins
        assert!(said.contains(":9]"), "{keys}: {said}");
    }
    // a drawing that is broken whatever is chosen is refused where it is named
    let said = refused(&check("outline = \"ply.dxf\"\npiece = { label = \"A\" }", "no drawing"));
    assert!(said.contains(":11]"), "{said}");
}
