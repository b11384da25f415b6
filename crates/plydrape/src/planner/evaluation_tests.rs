//! A plan is made with other cells than those that judge it.

use super::evaluation::{Bias, Draped, Mesh, planned_cell, score_with, with_errors};
use super::search_state::{Progress, SearchState};
use super::tuning::TUNING;
use crate::errors::tests::{budget, layup};
use crate::errors::{Errors, Term};
use crate::layup::{Layup, Model, PickUp};
use crate::material::Section;
use crate::measure::{Name, Verdict, Worst};
use crate::motion::Motion;
use crate::outcome::Judged;
use crate::scene::Scene;
use proptest::prelude::*;
use std::ops::ControlFlow;
use std::sync::Mutex;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    /// Whatever the seed of the sample, none of its cells is one of those that the search looks at.
    #[test]
    fn no_cell_of_the_search_is_one_of_the_sample(seed in any::<u64>()) {
        let (layup, errors) = (layup(2, 2), Errors { seed, ..budget() });
        let planned = planned(errors, &layup);
        for sample in 0..errors.samples {
            prop_assert!(!planned.contains(&errors.draw(sample, 4).apply(&layup).motion));
        }
    }
}

/// The motions of the cells that prove a plan.
fn planned(errors: Errors, layup: &Layup) -> Vec<Motion> {
    (0..TUNING.proving[1]).map(|n| planned_cell(errors, n, layup).motion).collect()
}

/// A drape that keeps every limit, and one that does not.
fn judged(ok: bool) -> Judged {
    let worst = Worst { value: if ok { 0.1 } else { 0.9 }, at: String::new(), place: None };
    Judged {
        limits: vec![Verdict::new(Name::Height, worst, 0.5, Some(1))],
        complete: true,
        missing: 0.0,
        unsolved: 0,
        interrupted: false,
        effort: None,
    }
}

/// The cells that are draped for a candidate are those that are asked for, and none of the sample that judges the plan. The first that
/// breaks a limit is reported, its height is that of the whole, and none is draped that is in no batch with it.
#[test]
fn a_candidate_is_ranked_by_the_cells_of_the_search() {
    let (layup, errors) = (layup(2, 2), budget());
    let motions = planned(errors, &layup);
    let seen: Mutex<Vec<Motion>> = Mutex::new(Vec::new());
    let cells: Vec<usize> = (0..TUNING.proving[1]).collect();
    let drape = |bad: Option<usize>, spare: usize| {
        seen.lock().unwrap().clear();
        let found =
            with_errors(&layup, Some(errors), judged(true), &cells, spare, |cell: Layup| {
                let ok = bad.is_none_or(|bad| cell.motion != motions[bad]);
                seen.lock().unwrap().push(cell.motion);
                Some(judged(ok))
            });
        (found, seen.lock().unwrap().clone())
    };
    let (all, draped) = drape(None, 0);
    assert!(all.worst.accepted() && all.refused_by.is_none());
    assert_eq!((all.each.len(), draped.len()), (1 + cells.len(), cells.len()));
    assert!(motions.iter().all(|motion| draped.contains(motion)));
    let (some, draped) = drape(Some(TUNING.batch), 0);
    assert!(!some.worst.accepted() && some.worst.limits[0].value == 0.9);
    assert_eq!((some.refused_by, draped.len()), (Some(TUNING.batch), 2 * TUNING.batch));
    // where one is to spare, all are draped and it does not count
    let (spared, draped) = drape(Some(TUNING.batch), 1);
    assert!(spared.worst.accepted() && spared.refused_by.is_none());
    assert_eq!(draped.len(), cells.len());
    // one of nine drapes is higher than the others
    let bias = Bias::default();
    let [low, high] = [true, false].map(|ok| score_with(&judged(ok), &bias));
    assert!((some.score(&bias) - (8.0 * low + high) / 9.0).abs() < 1e-12);
}

/// A candidate begins where the ply hangs from its grippers, so none of its steps is judged as the end of the lift.
#[test]
fn a_candidate_is_not_judged_by_the_end_of_a_lift() {
    let Layup { ply, settings, motion, .. } = layup(2, 2);
    let planned = motion.positions.clone();
    let mut scene = Scene::new(ply, settings, motion);
    scene.layup.settings.model = Model::Sheet;
    scene.layup.settings.sheet.mesh = Some(0.04);
    scene.layup.pick_up = Some(PickUp {
        height: 0.1,
        clearance: 0.05,
        grip: 0.5,
        vacuum_timeout: None,
        retreat: 0.02,
        table: None,
        lift_steps: 1,
    });
    let mut go_on = |_: &Progress| ControlFlow::Continue(());
    let state = SearchState::new(1, &mut go_on);
    let found = Draped::new(&scene, &planned, Mesh::Own, &state).expect("a sheet");
    let found = found.in_cells(&state.cells(), 0, &state);
    let judged = |name: Name| found.worst.limits.iter().any(|verdict| verdict.name == name);
    assert!(judged(Name::Strain) && !judged(Name::TableGap), "{:?}", found.worst);
}

/// The first two cells are the plies that hardly one of twenty passes: stiff in shear and light, limp and heavy.
#[test]
fn the_first_cells_of_a_search_are_the_plies_at_the_ends() {
    let mut errors = Errors::default();
    errors.material.areal_mass = Term::Deviation(0.05);
    let layup = layup(2, 2);
    let weight = |n: usize| planned_cell(errors, n, &layup).ply.material.section;
    let nominal = |share: f64| match layup.ply.material.section {
        Section::Line { mass, flexural_rigidity } => {
            Section::Line { mass: share * mass, flexural_rigidity }
        }
        Section::Areal { mass, warp_rigidity, weft_rigidity } => {
            Section::Areal { mass: share * mass, warp_rigidity, weft_rigidity }
        }
    };
    assert_eq!([weight(0), weight(1)], [nominal(0.9), nominal(1.1)]);
}
