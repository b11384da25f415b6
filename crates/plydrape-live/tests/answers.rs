//! What the live page shows is what `plydrape` computes of the same scene, and no setting of it ends in a panic.

use plydrape::layup::Model;
use plydrape_live::{Answer, Mold, answer};
use serde_json::Value;
use std::ops::ControlFlow;
use std::path::Path;

/// The scene that the page writes when it opens; a test of the page compares it.
const START: &str = include_str!("start.toml");

fn json(answer: &Answer) -> Value {
    serde_json::from_str(answer.text()).unwrap()
}

/// Horizontal forces (N) of all spans of an answer.
fn forces(answer: &Value) -> Vec<f64> {
    let catenaries = answer["catenaries"].as_array().unwrap();
    let spans = catenaries.iter().flat_map(|catenary| catenary["forces"].as_array().unwrap());
    spans.filter_map(Value::as_f64).collect()
}

/// The page starts where the paper's example does, and its forces are those of the first step there. (There the
/// places of the grippers are computed from their distances, so that they differ in a last bit.)
#[test]
fn the_page_starts_with_the_first_step_of_the_papers_example() {
    let example = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples/01_flat_sheared_mold/scene.toml");
    let scene = plydrape_io::scene::read_for(&example, Some(Model::Catenaries), None).unwrap();
    let drape = plydrape::simulate(&scene, |_| ControlFlow::Break(())).unwrap().drape;
    let hanging = drape.steps[0].catenaries.as_ref().unwrap();
    let spans = hanging.catenaries.iter().flat_map(|catenary| &catenary.spans);
    let expected: Vec<f64> = spans.filter_map(|span| span.force).collect();

    let told = json(&answer(START, Mold::Known));
    assert_eq!(told["found"], true);
    let told_forces = forces(&told);
    assert_eq!(told_forces.len(), expected.len());
    for (force, expected) in told_forces.iter().zip(&expected) {
        assert!((force - expected).abs() <= 1e-12 * expected, "{force} N, {expected} N");
    }
    assert_eq!(told["page"]["limits"].as_array().unwrap().len(), 11);
}

/// The mold comes along only if it is asked for, because it takes longer than the ply.
#[test]
fn the_mold_is_drawn_only_if_asked_for() {
    let mold = |mold| json(&answer(START, mold))["page"]["mold"].clone();
    assert!(mold(Mold::Known).is_null());
    assert!(!mold(Mold::Drawn)["triangles"].as_array().unwrap().is_empty());
}

/// Grippers farther apart than the ply between them are refused with their names and both lengths.
#[test]
fn a_ply_that_would_be_overstretched_is_refused_in_words() {
    let told = json(&answer(&START.replacen("[0, 0, 0.075]", "[-0.01, 0, 0.075]", 1), Mold::Known));
    let refused = told["refused"].as_str().unwrap();
    assert!(refused.contains("g0_0") && refused.contains("108"), "{refused}");
    assert!(!told["help"].as_str().unwrap().is_empty());
}

/// Wherever a gripper is dragged, the answer is a ply whose numbers are all finite or a sentence.
#[test]
fn every_place_of_a_gripper_has_an_answer() {
    let mut told = [0, 0];
    for n in 0..300_u32 {
        // a sequence that fills the box around the start evenly (Roberts 2018)
        let fraction = |a: f64| (f64::from(n) * a).fract();
        let (x, y, z) = (fraction(0.819_172_5), fraction(0.671_043_6), fraction(0.549_700_5));
        let place = format!("[{}, {}, {}]", 0.08 * x - 0.02, 0.08 * y - 0.02, 0.01 + 0.15 * z);
        let scene = START.replacen("[0, 0, 0.075]", &place, 1).replace(
            "kind = \"plane\"\npoint = [0.147, 0.049, 0]",
            [
                "kind = \"plane\"",
                "kind = \"sphere\"\nradius = 0.3\nposition = [0.147, 0.049, -0.28]",
                "kind = \"saddle\"\nradii = [0.2, 0.2]\nposition = [0.147, 0.049, 0]",
            ][n as usize % 3],
        );
        let answer = answer(&scene, Mold::Known);
        let value = json(&answer);
        match answer {
            Answer::Ply(_) => {
                told[0] += 1;
                assert!(forces(&value).iter().all(|force| force.is_finite()), "{scene}");
            }
            Answer::Refused(_) => {
                told[1] += 1;
                assert!(value["refused"].as_str().unwrap().len() > 10, "{scene}");
            }
        }
    }
    assert!(told[0] > 50 && told[1] > 20, "{told:?}");
}
