//! Once their buffers have grown, the solvers ask for no memory.

use plydrape::equilibrium::Solver;
use plydrape::scene::SlopeRule;
use plydrape::sheet::cholesky::{BlockMatrix, Cholesky};
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

/// The sheet's factorization has its storage from the analysis of the pattern.
#[test]
fn a_factorization_and_its_solution_allocate_nothing() {
    let nodes = 300;
    let chain = (0..nodes as u32 - 20).flat_map(|i| [[i, i + 1], [i, i + 20]]);
    let mut matrix = BlockMatrix::new(nodes, chain);
    for i in 0..nodes {
        matrix.add_scalar(matrix.slot(i, i), 1.0);
    }
    let mut cholesky = Cholesky::new(&matrix);
    let mut x = vec![1.0; 3 * nodes];
    let region = Region::new(ALLOCATOR);
    cholesky.factorize(&matrix).expect("the identity is positive definite");
    cholesky.solve(&mut x);
    let change = region.change();
    assert!(x.iter().all(|&x| x == 1.0));
    assert_eq!((change.allocations, change.reallocations), (0, 0));
}
