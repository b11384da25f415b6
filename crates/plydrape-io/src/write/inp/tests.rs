use super::*;
use crate::sample;

/// The data lines below the first line that begins with a keyword.
fn block<'a>(deck: &'a str, keyword: &str) -> Vec<&'a str> {
    let lines = deck.lines().skip_while(|line| !line.starts_with(keyword)).skip(1);
    lines.take_while(|line| !line.starts_with('*')).collect()
}

fn numbers(line: &str) -> Vec<f64> {
    line.split(',').map(|field| field.trim().parse().unwrap()).collect()
}

/// Same result, same bytes; a hanging ply has one step and no mold, a draped one two and a mold.
#[test]
fn the_deck_repeats_itself_and_holds_what_the_result_has() {
    let (hanging, draped) = (sample::hanging(4, 2), sample::draped(4, 2, 5));
    let deck = text(&hanging, 2e4).unwrap();
    assert_eq!(deck, text(&hanging, 2e4).unwrap());
    assert_eq!(deck.matches("*STEP").count(), 1);
    assert!(!deck.contains("MOLD") && !deck.contains("CONTACT"));
    let deck = text(&draped, 2e4).unwrap();
    assert_eq!(deck.matches("*STEP").count(), 2);
    assert!(deck.contains("MOLD_NODES, 1, 3") && deck.contains("*CONTACT PAIR"));
    assert_eq!(deck.matches("*DLOAD").count(), 1, "gravity goes on in the second step");
}

/// No line is longer than either program reads, 256 characters in Abaqus and 132 in CalculiX; a name has no spaces.
#[test]
fn every_line_can_be_read() {
    let mut result = sample::draped(4, 2, 5);
    result.scene.title = "A title of many words, ".repeat(20);
    let deck = text(&result, 2e4).unwrap();
    let longest = deck.lines().map(str::len).max();
    assert!(longest < Some(132), "{longest:?}");
    assert!(deck.is_ascii() || deck.lines().filter(|l| !l.is_ascii()).all(|l| l.starts_with("**")));
}

/// The material's first axis is the warp's direction in space.
#[test]
fn fibers_follow_the_warp() {
    let mut result = sample::tilted(3, 2);
    for (warp, gripper) in [(plydrape::ply::Direction::U, 1), (plydrape::ply::Direction::V, 3)] {
        result.scene.ply.warp = warp;
        let deck = text(&result, 2e4).unwrap();
        let axes = numbers(block(&deck, "*ORIENTATION")[0]);
        let position = |k: usize| result.steps[0].grippers[k].position;
        let way: Vec<f64> = (0..3).map(|c| position(gripper)[c] - position(0)[c]).collect();
        let length = way.iter().map(|c| c * c).sum::<f64>().sqrt();
        let cos = (0..3).map(|c| axes[c] * way[c] / length).sum::<f64>();
        assert!(cos > 0.995, "{warp:?}: {cos}; the grid of the tilted sample is sheared by 2 deg");
    }
}

/// Mass in the deck: density × thickness × the area of the mesh is the areal mass times the ply's area.
#[test]
fn the_deck_weighs_what_the_ply_weighs() {
    let deck = text(&sample::hanging(4, 2), 2e4).unwrap();
    let density = numbers(block(&deck, "*DENSITY")[0])[0];
    let thickness = numbers(block(&deck, "*SHELL SECTION")[0])[0];
    assert!((density * thickness * 0.03 / (3.143 * 0.03) - 1.0).abs() < 1e-8);
}

/// A result without steps, or with its grippers on one line, is refused with a remedy.
#[test]
fn what_cannot_be_a_deck_is_refused() {
    let mut result = sample::hanging(4, 2);
    for gripper in &mut result.steps[0].grippers {
        gripper.position[1] = 0.0;
    }
    let error = text(&result, 2e4).unwrap_err();
    assert!(error.to_string().contains("the flat ply has no place among them"), "{error}");
    result.steps.clear();
    let error = text(&result, 2e4).unwrap_err();
    assert!(error.help().contains("simulate the scene again"), "{error}");
}
