//! Once their buffers have grown, the solvers ask for no memory.

use plydrape::equilibrium::Solver;
use plydrape::layup::SlopeRule;
use plydrape::sheet::{SheetTuning, Status, drape};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::cell::Cell;
use std::ops::ControlFlow;
use std::path::Path;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Two steps of the example, several iterations each, both rules, warm and cold: not one allocation.
#[test]
fn a_second_solve_allocates_nothing() {
    let path =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/01_flat_sheared_mold/scene.toml");
    let scene = plydrape_io::scene::read(Path::new(path)).expect("a shipped scene").scene;
    let contacts = vec![None; scene.layup.ply.lines().catenaries()];
    for rule in [SlopeRule::MinForce, SlopeRule::MomentBalance] {
        let mut settings = scene.layup.settings;
        settings.slopes = rule;
        let mut solver = Solver::new(&scene.layup.ply, &settings);
        for positions in &scene.layup.motion.positions[..6] {
            solver.solve(positions, &contacts);
        }
        // the main thread of the test program allocates now and then: the least of some runs is the solver's
        let allocations = (0..5).map(|_| {
            let region = Region::new(ALLOCATOR);
            let mut iterations = 0;
            for positions in &scene.layup.motion.positions[..6] {
                iterations += solver.solve(positions, &contacts).iterations;
            }
            solver.forget();
            iterations += solver.solve(&scene.layup.motion.positions[0], &contacts).iterations;
            let change = region.change();
            assert!(iterations > 10, "{rule:?}: {iterations}");
            change.allocations + change.reallocations
        });
        assert_eq!(allocations.min(), Some(0), "{rule:?}");
    }
}

/// From one time step of a sheet to the next, with contact, halved steps and the relaxation at the end; what is kept
/// after a step of the motion is new.
#[test]
fn a_time_step_of_a_sheet_allocates_nothing() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/ideal_dome/scene.toml");
    let mut scene = plydrape_io::scene::read(Path::new(path)).expect("a shipped scene").scene;
    scene.layup.settings.sheet.mesh = Some(0.02);
    let allocator = &ALLOCATOR;
    // allocations when a time step began, unless a state was shown since
    let began = Cell::new(None);
    let (steps, most) = (Cell::new(0), Cell::new(0));
    let stop = || {
        let stats = allocator.stats();
        let now = stats.allocations + stats.reallocations;
        if let Some(before) = began.replace(Some(now)) {
            steps.set(steps.get() + 1);
            most.set(most.get().max(now - before));
        }
        false
    };
    let draped = drape(&scene.layup, SheetTuning::default(), &stop, |_, _, _| {
        began.set(None);
        ControlFlow::Continue(())
    });
    assert_eq!(draped.expect("the scene has a sheet").status, Status::Converged);
    assert!(steps.get() > 30, "{}", steps.get());
    assert_eq!(most.get(), 0);
}
