//! What drapes that share a flight must agree with: the drape of the same cell from its start.

use super::sample_tests::{cell, sheet};
use super::{Flight, Judged};
use crate::errors::{Errors, Term};
use crate::layup::SheetTime;
use crate::measure::Name;
use crate::scene::Scene;

const NEVER: &dyn Fn() -> bool = &|| false;

/// The flight of a scene, and the judgments of one of its cells from the start and from the flight on.
fn both(scene: &Scene, cell: &Scene) -> (Flight, [Judged; 2]) {
    let flight = Flight::new(&scene.layup, &scene.limits, NEVER).expect("a ply in the air");
    let judged = [None, Some(&flight)]
        .map(|flight| Flight::judge(flight, &cell.layup, &cell.limits, NEVER).expect("a sheet"));
    (flight, judged)
}

fn solves(judged: &Judged) -> usize {
    judged.effort.expect("a sheet").solves
}

/// What hangs in the air is where its grippers are, however they came there: grippers that are a fifth of a millimeter off and a ply that is
/// stiffer in shear, lighter and stiffer in bending end as if the cell had hung its ply up by itself, to a thousandth of the height, for half of
/// the linear systems.
#[test]
fn a_cell_ends_the_same_from_the_flight_on_as_from_its_start() {
    let scene = sheet();
    let mut errors = Errors { seed: 5, ..Errors::default() };
    errors.gripper.position = Term::Deviation(2e-4);
    errors.material.shear = Term::Factor(2.0);
    errors.material.bending = Term::Deviation(0.3);
    errors.material.areal_mass = Term::Deviation(0.05);
    for sample in 0..4 {
        let cell = cell(&scene, errors.draw(sample, scene.layup.ply.grippers()));
        let (_, [whole, shared]) = both(&scene, &cell);
        assert!(solves(&shared) < solves(&whole), "{} {}", solves(&shared), solves(&whole));
        for name in [Name::Height, Name::OutOfPlane, Name::Position] {
            let [a, b] = [&whole, &shared].map(|judged| {
                judged.limits.iter().find(|verdict| verdict.name == name).map(|v| v.value)
            });
            let (Some(a), Some(b)) = (a, b) else { continue };
            assert!((a - b).abs() < 1e-3 * a.abs(), "{name:?}: {a} {b}");
        }
        assert_eq!(whole.complete, shared.complete);
    }
}

/// Fabric is the same everywhere: a ply that is held aside drapes as it would have, to the last bit.
#[test]
fn a_ply_that_is_held_aside_is_as_flat() {
    let scene = sheet();
    let mut draw = Errors::default().draw(0, scene.layup.ply.grippers());
    draw.pick_up.offset = [3e-4, -4e-4];
    let [as_planned, aside] = [scene.clone(), cell(&scene, draw)]
        .map(|scene| Flight::judge(None, &scene.layup, &scene.limits, NEVER).expect("a sheet"));
    assert_eq!(as_planned.limits, aside.limits);
}

/// A cell whose ply would touch the mold where the flight ends is draped from its start, with the very same numbers.
#[test]
fn a_cell_that_touches_too_early_is_draped_from_its_start() {
    let scene = sheet();
    let mut errors = Errors::default();
    errors.frame.position = Term::Bound(1e-3);
    let mut draw = errors.draw(0, scene.layup.ply.grippers());
    let (flight, _) = both(&scene, &scene);
    let lowest = flight.air.heights.iter().copied().fold(f64::INFINITY, f64::min);
    draw.frame.shift = [0.0, 0.0, -1.001 * lowest];
    let (_, [whole, shared]) = both(&scene, &cell(&scene, draw));
    assert_eq!(whole.limits, shared.limits);
    assert_eq!(solves(&whole), solves(&shared));
}

/// A ply that moves in its own time remembers how it came, so nothing is shared; neither is a ply that is not in the air before the last step.
#[test]
fn what_remembers_its_way_or_lies_from_the_start_shares_no_flight() {
    let mut scene = sheet();
    scene.layup.settings.sheet.time = SheetTime::Real;
    assert!(Flight::new(&scene.layup, &scene.limits, NEVER).is_none());

    let mut scene = sheet();
    scene.layup.mold = None;
    assert!(Flight::new(&scene.layup, &scene.limits, NEVER).is_none());
    let stopped = Flight::new(&sheet().layup, &scene.limits, &|| true);
    assert!(stopped.is_none());
}
