use super::*;
use crate::sample;
use plydrape::material::{Section, ShearCurve, TensionLaw};
use plydrape::ply::{Cut, Held, Outline};
use serde_json::Value;
use std::collections::BTreeSet;

/// A made-up result whose ply has what a sheet needs, per width.
fn shells(mut result: ResultFile) -> ResultFile {
    let material = &mut result.scene.ply.material;
    material.section = Section::Areal { mass: 0.4, warp_rigidity: 3e-5, weft_rigidity: 2e-5 };
    material.shear_curve = Some(ShearCurve::Polynomial { coefficients: vec![7.0, 0.0, 30.0] });
    material.tension = Some(TensionLaw::Linear { stiffness: 1e6 });
    result
}

fn data(result: &ResultFile, mesh: Option<f64>, tension: Option<f64>) -> Value {
    let files = files(result, mesh, tension).unwrap();
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["drape.py", "ply.json"]);
    serde_json::from_slice(&files[1].1).unwrap()
}

fn reals(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

/// Quads are rectangles along the fibers that cover the ply once, no side longer than asked for, and every cup has a node of its own.
#[test]
fn quads_cover_the_ply_once() {
    let found = data(&shells(sample::hanging(4, 2)), Some(0.02), None);
    let nodes: Vec<Vec<f64>> = found["nodes"].as_array().unwrap().iter().map(reals).collect();
    let mut area = 0.0;
    for quad in found["quads"].as_array().unwrap() {
        let [a, b, c, d] = [0, 1, 2, 3].map(|n| &nodes[quad[n].as_u64().unwrap() as usize]);
        assert!(a[1] == b[1] && b[0] == c[0] && c[1] == d[1] && d[0] == a[0]);
        let sides = [b[0] - a[0], d[1] - a[1]];
        assert!(sides.iter().all(|side| *side > 0.0 && *side < 0.02 + 1e-12), "{sides:?}");
        area += sides[0] * sides[1];
    }
    assert!((area - 0.3 * 0.1).abs() < 1e-12, "{area}");
    for cup in found["grippers"].as_array().unwrap() {
        let place = reals(&cup["place"]);
        let near = |node: &Vec<f64>| (node[0] - place[0]).hypot(node[1] - place[1]) < 1e-12;
        assert!(nodes.iter().any(near), "{cup}");
    }
}

/// Of a ply with a cut corner and a hole the quads leave both out, use every corner that is written, and cover the ply to half a quad at its
/// boundary.
#[test]
fn a_cut_ply_has_quads_where_it_is() {
    let mut result = shells(sample::hanging(3, 3));
    let outer = vec![[0.0, 0.0], [0.2, 0.0], [0.2, 0.2], [0.05, 0.2], [0.0, 0.15]];
    let hole = vec![[0.02, 0.02], [0.02, 0.06], [0.06, 0.06], [0.06, 0.02]];
    let outline = Outline::new(outer, vec![hole]).unwrap();
    // the corner that is cut has no cup
    let kept = |id: &[usize; 2]| *id != [0, 2];
    let ids: Vec<_> = result.steps[0].grippers.iter().map(|g| g.id).filter(kept).collect();
    let held = ids.iter().map(|id| Held { id: *id, place: id.map(|n| 0.1 * n as f64) }).collect();
    result.scene.ply.cut = Some(Cut { outline, held, angle: 0.0, turn: 0.0, origin: [0.0; 2] });
    result.steps[0].grippers.retain(|gripper| kept(&gripper.id));
    let found = data(&result, Some(0.01), None);
    let quads = found["quads"].as_array().unwrap();
    let corners: BTreeSet<u64> = quads
        .iter()
        .flat_map(|quad| quad.as_array().unwrap())
        .map(|n| n.as_u64().unwrap())
        .collect();
    let nodes: Vec<Vec<f64>> = found["nodes"].as_array().unwrap().iter().map(reals).collect();
    assert!(corners.into_iter().eq(0..nodes.len() as u64));
    let middle = |quad: &Value| {
        let [a, c] = [0, 2].map(|n| &nodes[quad[n].as_u64().unwrap() as usize]);
        [0, 1].map(|n| 0.5 * (a[n] + c[n]))
    };
    let in_hole = |[u, v]: [f64; 2]| (0.02..0.06).contains(&u) && (0.02..0.06).contains(&v);
    assert!(quads.iter().all(|quad| !in_hole(middle(quad))));
    assert!(quads.iter().all(|quad| middle(quad)[1] < 0.15 + middle(quad)[0] + 1e-9));
    assert!(
        (quads.len() as f64 * 1e-4 - (0.04 - 0.0016 - 0.00125)).abs() < 5e-4,
        "{}",
        quads.len()
    );
}

/// Mass, rigidities and the shear curve are those of the material per width; the tension stiffness is not, and is the one asked for.
#[test]
fn the_section_is_that_of_the_material_per_width() {
    let result = shells(sample::hanging(3, 2));
    let found = data(&result, None, Some(3e5));
    assert_eq!([&found["mass"], &found["gravity"], &found["tension"]], [0.4, 9.8, 3e5]);
    assert_eq!(reals(&found["rigidity"]), [3e-5, 2e-5]);
    let [angles, forces] = [0, 1].map(|n| reals(&found["shear"][n]));
    assert_eq!(angles.len(), 91);
    for (angle, force) in angles.iter().zip(forces) {
        assert!((force - (7.0 * angle + 30.0 * angle.powi(3))).abs() < 1e-12, "{angle}: {force}");
    }
    assert_eq!(data(&result, None, None)["tension"], TENSION);
}

/// Cups go where the steps have their mounts, at the times of the steps; a pad that lets go says when.
#[test]
fn cups_follow_the_steps_until_they_let_go() {
    let mut result = shells(sample::draped(3, 2, 5));
    for step in &mut result.steps[3..] {
        step.grippers[4].holds = false;
    }
    result.scene.settings.pad.lateral_stiffness = Some(2e3);
    result.scene.settings.pad.axial_stiffness = Some(3e3);
    let found = data(&result, None, None);
    let times: Vec<f64> = result.steps.iter().map(|step| step.time).collect();
    assert_eq!(reals(&found["time"]), times);
    for (n, cup) in found["grippers"].as_array().unwrap().iter().enumerate() {
        let places = cup["positions"].as_array().unwrap();
        for (step, place) in result.steps.iter().zip(places) {
            assert_eq!(reals(place), step.grippers[n].commanded);
        }
        assert_eq!(reals(&cup["stiffness"]), [2e3, 2e3, 3e3]);
        assert_eq!(cup["name"], plydrape::ply::gripper_name(result.steps[0].grippers[n].id));
        let release = if n == 4 { Value::from(times[2]) } else { Value::Null };
        assert_eq!(cup["release"], release);
    }
}

/// Every option that the script reads has a value and a meaning, and the script reads every one of them.
#[test]
fn every_option_of_the_script_has_a_value() {
    let settings = &data(&shells(sample::hanging(3, 2)), None, None)["settings"];
    let written: BTreeSet<&str> =
        settings.as_object().unwrap().keys().map(String::as_str).collect();
    let name = |text: &'static str| text.split(|c: char| !c.is_alphanumeric()).next().unwrap();
    let read: BTreeSet<&str> = SCRIPT.split("args.").skip(1).map(name).collect();
    assert_eq!(written, read);
    for setting in settings.as_object().unwrap().values() {
        assert!(setting[0].is_f64() && !setting[1].as_str().unwrap().is_empty(), "{setting}");
    }
}

/// The grid holds the signed distance of every one of its points, and reaches beyond the grippers; without a mold there is none.
#[test]
fn the_grid_has_the_distance_of_the_mold() {
    assert!(data(&shells(sample::hanging(3, 2)), None, None)["mold"].is_null());
    let result = shells(sample::draped(3, 2, 4));
    let mold = &data(&result, None, None)["mold"];
    let (low, pitch) = (reals(&mold["low"]), mold["pitch"].as_f64().unwrap());
    let shape: Vec<usize> = reals(&mold["shape"]).iter().map(|n| *n as usize).collect();
    let distance = reals(&mold["distance"]);
    assert_eq!(distance.len(), shape.iter().product::<usize>());
    for (n, distance) in distance.iter().enumerate() {
        // the mold is the plane z = 0
        let z = low[2] + pitch * (n % shape[2]) as f64;
        assert!((distance - z).abs() < 1e-8, "{n}: {distance} at {z}");
    }
    for gripper in result.steps.iter().flat_map(|step| &step.grippers) {
        for axis in 0..2 {
            let high = low[axis] + pitch * (shape[axis] - 1) as f64;
            assert!(gripper.position[axis] > low[axis] && gripper.position[axis] < high);
        }
    }
}

/// What is no surface, has no motion, or has no sheet is refused with a remedy.
#[test]
fn what_ngsolve_cannot_drape_is_refused() {
    let refused = |result: &ResultFile| files(result, None, None).unwrap_err();
    let strip = refused(&shells(sample::hanging(4, 1)));
    assert!(strip.to_string().contains("single line") && strip.help().contains("`inp`"), "{strip}");
    let bare = refused(&sample::hanging(4, 2));
    assert!(bare.to_string().contains("shear"), "{bare}");
    let mut empty = shells(sample::hanging(4, 2));
    empty.steps.clear();
    assert!(refused(&empty).help().contains("simulate the scene again"));
}
