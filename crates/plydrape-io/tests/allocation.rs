//! Once its buffers have grown, the solver asks for no memory.

use plydrape::equilibrium::Solver;
use plydrape::scene::SlopeRule;
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::path::Path;

#[global_allocator]
static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

/// Two steps of the example, several iterations each, both rules, warm and cold: not one allocation.
#[test]
fn a_second_solve_allocates_nothing() {
    let path =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/01_flat_sheared_mold/scene.toml");
    let scene = plydrape_io::scene::read(Path::new(path)).expect("a shipped scene").scene;
    let contacts = vec![None; scene.ply.grid.catenaries()];
    for rule in [SlopeRule::MinForce, SlopeRule::MomentBalance] {
        let mut settings = scene.settings;
        settings.slopes = rule;
        let mut solver = Solver::new(&scene.ply, &settings);
        for positions in &scene.motion.positions[..6] {
            solver.solve(positions, &contacts);
        }
        let region = Region::new(ALLOCATOR);
        let mut iterations = 0;
        for positions in &scene.motion.positions[..6] {
            iterations += solver.solve(positions, &contacts).iterations;
        }
        solver.forget();
        iterations += solver.solve(&scene.motion.positions[0], &contacts).iterations;
        let change = region.change();
        assert!(iterations > 10, "{rule:?}: {iterations}");
        assert_eq!((change.allocations, change.reallocations), (0, 0), "{rule:?}");
    }
}
