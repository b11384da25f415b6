//! What a motion tolerates, held against margins that are known.

use super::sample_tests::{NEVER, cell, lines, plain, sheet};
use super::{Tolerance, Watch};
use crate::errors::{Errors, Term};
use crate::measure::Name;
use crate::scene::Scene;

/// Catenaries without limits but a box that ends a margin (m) to the right of where the grippers go.
fn boxed(margin: f64) -> Scene {
    let mut scene = lines();
    for (name, _) in scene.limits.clone().iter() {
        scene.limits.set(name, None);
    }
    let places = scene.layup.motion.positions.iter().flatten();
    let right = places.map(|place| place[0]).fold(f64::MIN, f64::max);
    scene.limits.workspace = Some([[-9.0, right + margin], [-9.0, 9.0], [-9.0, 9.0]]);
    assert!(plain(&scene).accepted(), "{:?}", plain(&scene).limits);
    scene
}

/// A box leaves the grippers a margin along x. All of 16 cells whose grippers are off by the error that is found keep it, and at
/// 2^(1/8) times that error one of them does not.
#[test]
fn the_error_that_is_tolerated_is_the_largest_that_all_cells_keep() {
    let mut errors = Errors::default();
    errors.gripper.position = Term::Deviation(1e-4);
    for margin in [0.02e-3, 0.1e-3, 0.7e-3] {
        let scene = boxed(margin);
        let found = Tolerance::of(&scene, &NEVER).unwrap();
        let unit = 1e3 * 1e-3 * crate::sheet::pitch(&scene.layup.ply);
        let holds = |millimetres: f64| {
            let factor = 1e-3 * millimetres / 1e-4;
            (0..16).all(|n| plain(&cell(&scene, errors.draw(n, 4).scaled(factor))).accepted())
        };
        let step = 2_f64.powf(0.125) * (1.0 + 1e-9);
        assert!(!found.gripper_at_least && found.tried == 16, "{found:?}");
        assert!(unit / 64.0 <= found.gripper_mm && found.gripper_mm < 16.0 * unit, "{found:?}");
        assert!(holds(found.gripper_mm) && !holds(found.gripper_mm * step), "{found:?}");
        // nothing that hangs in the air asks for a mass, and catenaries know no shear stiffness
        assert_eq!((found.shear, found.mass), (None, [1.0 / Tolerance::MOST, Tolerance::MOST]));
    }
    let most = Tolerance::of(&boxed(0.9), &NEVER).unwrap();
    assert!(most.gripper_at_least, "{most:?}");
    assert_eq!(Tolerance::of(&boxed(1e-9), &NEVER).unwrap().gripper_mm, 0.0);
}

/// The load of the grippers is in proportion to the mass: with 2.4 times the load that they bear, 2 times the mass is tolerated and
/// 3 times is not.
#[test]
fn the_mass_that_is_tolerated_follows_the_load() {
    let mut scene = sheet();
    for (name, _) in scene.limits.clone().iter() {
        scene.limits.set(name, None);
    }
    scene.limits.set(Name::GripperLoad, Some(1e3));
    let verdicts = plain(&scene).limits;
    let load = verdicts.iter().find(|verdict| verdict.name == Name::GripperLoad).unwrap().value;
    scene.limits.set(Name::GripperLoad, Some(2.4 * load));
    let found = Tolerance::of(&scene, &NEVER).unwrap();
    assert_eq!(found.mass, [1.0 / Tolerance::MOST, 2.0], "{found:?}");
}

/// Who breaks the search off has no answer.
#[test]
fn a_tolerance_that_was_broken_off_is_none() {
    let stop = Watch { stop: &|| true, done: &|_, _| {} };
    assert_eq!(Tolerance::of(&boxed(1e-3), &stop), None);
}
