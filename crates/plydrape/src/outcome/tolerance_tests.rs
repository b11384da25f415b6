//! What a motion tolerates, held against margins that are known.

use super::sample_tests::{NEVER, cell, lines, plain, sheet};
use super::{RateTolerance, Tolerance, Watch};
use crate::errors::{Errors, Term};
use crate::layup::SheetTime;
use crate::material::{Relaxation, ShearRate};
use crate::measure::Name;
use crate::motion::Motion;
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
        let found = Tolerance::new(&scene, &NEVER).unwrap();
        let unit = 1e3 * 1e-3 * crate::sheet::pitch(&scene.layup.ply);
        let holds = |millimeters: f64| {
            let factor = 1e-3 * millimeters / 1e-4;
            (0..16).all(|n| plain(&cell(&scene, errors.draw(n, 4).scaled(factor))).accepted())
        };
        let step = 2_f64.powf(0.125) * (1.0 + 1e-9);
        assert!(!found.gripper_at_least && found.tried == 16, "{found:?}");
        assert!(unit / 64.0 <= found.gripper_mm && found.gripper_mm < 16.0 * unit, "{found:?}");
        assert!(holds(found.gripper_mm) && !holds(found.gripper_mm * step), "{found:?}");
        // nothing that hangs in the air asks for a mass, and catenaries know no shear stiffness
        assert_eq!((found.shear, found.mass), (None, [1.0 / Tolerance::MOST, Tolerance::MOST]));
    }
    let most = Tolerance::new(&boxed(0.9), &NEVER).unwrap();
    assert!(most.gripper_at_least, "{most:?}");
    assert_eq!(Tolerance::new(&boxed(1e-9), &NEVER).unwrap().gripper_mm, 0.0);
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
    let found = Tolerance::new(&scene, &NEVER).unwrap();
    assert_eq!(found.mass, [1.0 / Tolerance::MOST, 2.0], "{found:?}");
}

/// A ply with resin that is sheared by 6° in 0.2 s, with no limit but the pull (N) of its grippers.
fn sheared(most: f64) -> Scene {
    let mut scene = sheet();
    for (name, _) in scene.limits.clone().iter() {
        scene.limits.set(name, None);
    }
    scene.limits.set(Name::GripperPull, Some(most));
    let layup = &mut scene.layup;
    layup.settings.sheet.time = SheetTime::Real;
    layup.ply.material.shear_rate = Some(ShearRate {
        stiffness: 300.0,
        relaxation: Relaxation { temperature: vec![290.0, 340.0], time: vec![1.0, 0.01] },
        temperature: 310.0,
    });
    let start = layup.motion.positions[0].clone();
    let first = start[0];
    let turned = |p: &[f64; 3]| [p[0] + 0.1 * (p[1] - first[1]), p[1], p[2]];
    // after the last step the ply comes to rest, so that the step before it has the pull
    let end: Vec<[f64; 3]> = start.iter().map(turned).collect();
    layup.motion = Motion { times: vec![0.0, 0.2, 0.21], positions: vec![start, end.clone(), end] };
    scene
}

/// The pull that a ply whose resin relaxes this many times as slowly needs is known from its own drape: a limit between those of two powers of
/// 2 is met by the lower one, whether the ply at its own speed keeps it or not, and at the temperature at which the resin relaxes so.
#[test]
fn a_motion_may_be_as_fast_as_the_resin_of_its_ply_follows() {
    let pull = |factor: f64| {
        let mut scene = sheared(1e6);
        let rate = scene.layup.ply.material.shear_rate.as_mut().expect("resin");
        *rate = rate.slower(factor);
        let limits = plain(&scene).limits;
        limits.iter().find(|verdict| verdict.name == Name::GripperPull).expect("a pull").value
    };
    let pulls = [0.125, 0.25, 0.5, 1.0, 2.0, 4.0].map(pull);
    assert!(pulls.is_sorted() && pulls[5] > 1.2 * pulls[0], "{pulls:?}");
    for (low, speed) in [(1, 0.25), (4, 2.0)] {
        let scene = sheared(0.5 * (pulls[low] + pulls[low + 1]));
        let is_accepted = plain(&scene).accepted();
        assert_eq!(is_accepted, speed > 1.0);
        let found = RateTolerance::new(&scene, is_accepted, &NEVER).expect("an answer");
        assert_eq!(found.speed, Some(speed), "{pulls:?}");
        let rate = scene.layup.ply.material.shear_rate.expect("resin");
        let kelvin = found.temperature.expect("a temperature") + 273.15;
        let time = rate.relaxation.time_at(kelvin);
        assert!((time / (speed * rate.time()) - 1.0).abs() < 1e-9, "{time}");
    }
    // nothing is known of a ply in a time that is nobody's
    let mut timeless = sheared(1.0);
    timeless.layup.settings.sheet.time = SheetTime::QuasiStatic;
    assert_eq!(RateTolerance::new(&timeless, false, &NEVER), None);
}

/// Who breaks the search off has no answer.
#[test]
fn a_tolerance_that_was_broken_off_is_none() {
    let stop = Watch { stop: &|| true, done: &|_, _| {} };
    assert_eq!(Tolerance::new(&boxed(1e-3), &stop), None);
}
