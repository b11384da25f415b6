//! Gripper positions that have no solution are refused, and nothing runs without end on numbers that are out of all range.

use plydrape::LayupError;
use plydrape::layup::{Layup, Model, Settings};
use plydrape::material::{Material, Section};
use plydrape::measure::{Name, Sense};
use plydrape::mold::{Cylinder, Face, Graph, Mold, Plane, Pose, Saddle, Sphere, Surface, Torus};
use plydrape::ply::{Grid, Ply};
use plydrape::{Limits, Motion, Scene, simulate};
use std::ops::ControlFlow;

fn ply() -> Ply {
    let material = Material {
        section: Section::Line { mass: 0.3, flexural_rigidity: 1e-4 },
        shear_curve: None,
        tension: None,
        ..Material::woven("any", 0.3, 1e-4, 1e6, 5.0)
    };
    Ply::of_array(Grid { nu: 3, nv: 2 }, [0.1, 0.1], material)
}

fn level() -> Vec<[f64; 3]> {
    (0..6).map(|n| [0.098 * f64::from(n % 3), 0.098 * f64::from(n / 3), 0.2]).collect()
}

/// The doors share one check; each of its answers names the gripper, its value and what to do.
#[test]
fn positions_without_a_solution_are_refused_with_place_and_remedy() {
    let ply = ply();
    assert_eq!(ply.check_places(&level()), Ok(()));
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e159, -1e200, 1.000001e6] {
        for n in 0..3 {
            let mut positions = level();
            positions[4][n] = value;
            let fault = ply.check_places(&positions).unwrap_err();
            assert!(matches!(fault, LayupError::GripperFar { gripper: [1, 1], .. }), "{fault}");
            let text = fault.to_string();
            assert!(text.contains(&format!("{value:?}")) && text.contains("up to 1e6 m"), "{text}");
        }
    }
    let one_place = ply.check_places(&[[0.1, 0.2, 0.3]; 6]).unwrap_err();
    assert!(matches!(one_place, LayupError::GripperSteep { a: [0, 0], b: [1, 0], run: 0.0, .. }));
    assert!(one_place.to_string().contains("move them apart"), "{one_place}");
    // 1 % of the fabric is far enough, a hair less is not
    for (run, fits) in [(1.001e-3, true), (0.999e-3, false)] {
        let mut positions = level();
        positions[2][0] = positions[1][0] + run;
        positions[5][0] = positions[4][0] + 0.09;
        assert_eq!(ply.check_places(&positions).is_ok(), fits, "{run}");
    }
    let few = ply.check_places(&level()[..5]).unwrap_err();
    assert!(matches!(few, LayupError::GripperCount { found: 5, expected: 6, .. }));
}

/// A motion has finite times that ascend, and every step is checked.
#[test]
fn times_that_do_not_ascend_are_refused_with_their_step() {
    let ply = ply();
    let motion =
        |times: &[f64]| Motion { times: times.to_vec(), positions: vec![level(); times.len()] };
    assert_eq!(ply.check_motion(&motion(&[0.0, 1.0, 2.0])), Ok(()));
    for times in [[0.0, 1.0, 1.0], [0.0, 2.0, 1.0], [0.0, 1.0, f64::NAN], [0.0, 1.0, f64::INFINITY]]
    {
        let fault = ply.check_motion(&motion(&times)).unwrap_err();
        assert!(matches!(fault, LayupError::StepTime { step: 3, .. }), "{fault}");
    }
    let mut far = motion(&[0.0, 1.0]);
    far.positions[1][5][2] = 1e200;
    let fault = ply.check_motion(&far).unwrap_err().to_string();
    assert!(fault.contains("gripper g2_1") && fault.contains("in step 2"), "{fault}");
    let none = Motion { times: vec![], positions: vec![] };
    assert!(matches!(ply.check_motion(&none), Err(LayupError::StepCount { .. })));
}

fn molds() -> Vec<Mold> {
    let pose = Pose::new([0.0, 0.0, -0.5], [0.0; 3]);
    let face = Face::Outside;
    let saddle = Surface::Saddle(Saddle { radii: [0.6, 0.9] });
    vec![
        Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] }),
        Mold::Cylinder(Cylinder { pose, radius: 0.5, face }),
        Mold::Sphere(Sphere { pose, radius: 0.5, face }),
        Mold::Torus(Torus { pose, ring_radius: 0.85, tube_radius: 0.5, face }),
        Mold::Graph(Graph { pose, surface: saddle, domain: None }),
    ]
}

/// The library itself does not check: even there every search ends, and nothing that overflowed is accepted.
#[test]
fn a_drape_out_of_all_range_ends_and_is_not_accepted() {
    for mold in molds() {
        for value in [1e159, 1e200, f64::MAX, f64::NAN, f64::INFINITY] {
            for who in [0..1, 0..6] {
                let mut last = level();
                for place in &mut last[who.clone()] {
                    place[0] = value;
                }
                let motion = Motion { times: vec![0.0, 1.0], positions: vec![level(), last] };
                let mut scene = Scene::new(ply(), settings(), motion);
                scene.layup.mold = Some(mold.clone());
                scene.limits = limits(&scene.layup);
                let outcome = simulate(&scene, |_| ControlFlow::Continue(())).unwrap();
                assert!(!outcome.accepted(), "{mold:?} {value} {who:?}");
            }
        }
    }
}

fn settings() -> Settings {
    Settings { model: Model::Catenaries, max_tilt: 0.7, ..Settings::default() }
}

/// Limits so wide that only a torn ply, grippers at one place and what is out of all range exceed them.
fn limits(layup: &Layup) -> Limits {
    let mut limits = Limits::usual(layup);
    for (name, _) in Limits::usual(layup).iter() {
        let bound = match name.measure().sense() {
            _ if name == Name::Overstretch => 1e-3,
            Sense::AtMost => 1e9,
            Sense::AtLeast => 1e-3,
        };
        limits.set(name, Some(bound));
    }
    limits
}
