//! How long a user waits: one span, one equilibrium cold and warm, large arrays, the whole example, and whole drapes of a sheet.
//!
//! `benches/run` prints these beside a SciPy solver of the same problem; `benches/README.md` is its
//! table.

use divan::{Bencher, black_box};
use plydrape::catenary::{EndCondition, Profile, Span};
use plydrape::equilibrium::Solver;
use plydrape::geometry::vector;
use plydrape::layup::{Model, SlopeRule};
use plydrape::mold::{Face, Mold, Pose, Sphere};
use plydrape::motion::Motion;
use plydrape::outcome::{Drape, DrapeWatch, Status, drape};
use plydrape::ply::Grid;
use plydrape::scene::Scene;
use std::ops::ControlFlow;
use std::path::Path;

fn main() {
    divan::main();
}

/// A scene of the shipped examples.
fn shipped(name: &str) -> Scene {
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let path = Path::new(examples).join(name).join("scene.toml");
    plydrape_io::scene::read(&path).expect("the example is shipped with the project").scene
}

/// The paper's example.
fn example() -> Scene {
    shipped("01_flat_sheared_mold")
}

/// A whole drape with all measures by a model.
fn followed(scene: &Scene, model: Model) -> Drape {
    let see = &mut |_: usize, _: Option<&_>| ControlFlow::Continue(());
    drape(scene, model, &mut DrapeWatch { stop: &|| false, see }).expect("the model can drape it")
}

/// The example's ply over a larger array, level, 98 mm apart.
fn array(side: usize, rule: SlopeRule) -> (Solver, Vec<[f64; 3]>, usize) {
    let mut scene = example();
    scene.layup.ply.grid.nu = side;
    scene.layup.ply.grid.nv = side;
    scene.layup.settings.slopes = rule;
    let grid = scene.layup.ply.grid;
    let places = (0..grid.grippers()).map(|n| grid.id(n).map(|k| 0.098 * k as f64));
    let positions = places.map(|[x, y]| [x, y, 0.0]).collect();
    (
        Solver::new(&scene.layup.ply, &scene.layup.settings),
        positions,
        scene.layup.ply.lines().catenaries(),
    )
}

/// An edge of the example, free at the boundary.
const SPAN: Span = Span {
    run: 0.098,
    rise: 0.0,
    length: 0.1,
    ends: [EndCondition::Free, EndCondition::Slope(-0.02)],
    weight: 0.3143 * 9.8,
    flexural_rigidity: 9e-6,
    axial_stiffness: 1e5,
};

/// One span's length with all first and second derivatives to H and both slopes.
#[divan::bench]
fn span_length_with_derivatives(bencher: Bencher) {
    bencher.bench(|| Profile::new(black_box(&SPAN), black_box(0.4)).length_and_excess::<3>());
}

/// One span's length with its derivative to H.
#[divan::bench]
fn span_length_with_slope(bencher: Bencher) {
    bencher.bench(|| Profile::new(black_box(&SPAN), black_box(0.4)).excess());
}

/// 4 × 2 grippers from nothing, all four shared slopes unknown.
#[divan::bench]
fn equilibrium_4x2_cold(bencher: Bencher) {
    let scene = example();
    let contacts = vec![None; scene.layup.ply.lines().catenaries()];
    let mut solver = Solver::new(&scene.layup.ply, &scene.layup.settings);
    bencher.bench_local(|| {
        solver.forget();
        solver.solve(black_box(&scene.layup.motion.positions[0]), &contacts)
    });
}

/// A place once more: what `benches/python.py` asks of Python, without Python.
#[divan::bench]
fn equilibrium_4x2_again(bencher: Bencher) {
    let scene = example();
    let contacts = vec![None; scene.layup.ply.lines().catenaries()];
    let mut solver = Solver::new(&scene.layup.ply, &scene.layup.settings);
    bencher.bench_local(|| solver.solve(black_box(&scene.layup.motion.positions[0]), &contacts));
}

/// 24 equilibria, each from the step before: the example from step 2 to step 25, the last before contact.
#[divan::bench]
fn equilibria_4x2_warm_24_steps(bencher: Bencher) {
    let scene = example();
    let contacts = vec![None; scene.layup.ply.lines().catenaries()];
    bencher
        .with_inputs(|| {
            let mut solver = Solver::new(&scene.layup.ply, &scene.layup.settings);
            solver.solve(&scene.layup.motion.positions[0], &contacts);
            solver
        })
        .bench_local_values(|mut solver| {
            for positions in &scene.layup.motion.positions[1..25] {
                solver.solve(black_box(positions), &contacts);
            }
            solver
        });
}

/// The hardest of them: between steps 1 and 2 the four shared slopes are unknown and move by 0.15.
#[divan::bench]
fn equilibrium_4x2_warm_steps_1_2(bencher: Bencher) {
    let scene = example();
    let contacts = vec![None; scene.layup.ply.lines().catenaries()];
    let mut solver = Solver::new(&scene.layup.ply, &scene.layup.settings);
    solver.solve(&scene.layup.motion.positions[0], &contacts);
    let mut step = 0;
    bencher.bench_local(|| {
        step = 1 - step;
        solver.solve(black_box(&scene.layup.motion.positions[step]), &contacts)
    });
}

/// Square arrays from nothing: time against the number of cells.
#[divan::bench(args = [25, 50, 100, 200], sample_count = 5, sample_size = 1)]
fn array_min_force_cold(bencher: Bencher, side: usize) {
    let (mut solver, positions, catenaries) = array(side, SlopeRule::MinForce);
    let contacts = vec![None; catenaries];
    bencher.bench_local(|| {
        solver.forget();
        solver.solve(black_box(&positions), &contacts)
    });
}

/// A square array from scratch, with the moments balanced.
#[divan::bench(args = [25, 50, 100, 200], sample_count = 5, sample_size = 1)]
fn array_moment_balance_cold(bencher: Bencher, side: usize) {
    let (mut solver, positions, catenaries) = array(side, SlopeRule::MomentBalance);
    let contacts = vec![None; catenaries];
    bencher.bench_local(|| {
        solver.forget();
        solver.solve(black_box(&positions), &contacts)
    });
}

/// The paper's example, 30 steps with contact and all measures, without writing files.
#[divan::bench]
fn example_30_steps(bencher: Bencher) {
    let scene = example();
    bencher.bench(|| followed(black_box(&scene), Model::Catenaries));
}

/// 4 × 4 grippers over curved molds, 30 steps cut where they penetrate, without writing files: a sphere in closed
/// form, a formula, and a mesh of 3 872 triangles.
#[divan::bench(args = ["ideal_dome", "07_cubic", "08_stl_mold"], sample_count = 5, sample_size = 1)]
fn curved_example(bencher: Bencher, name: &str) {
    let mut scene = shipped(name);
    // catenaries hold their grippers rigidly
    let pad = &mut scene.layup.settings.pad;
    (pad.lateral_stiffness, pad.axial_stiffness) = (None, None);
    bencher.bench_local(|| followed(black_box(&scene), Model::Catenaries));
}

/// A scene with lines of its sheet every `mesh` millimeters.
fn meshed(mut scene: Scene, mesh_mm: f64) -> Scene {
    scene.layup.settings.sheet.mesh = Some(mesh_mm * 1e-3);
    scene
}

/// Straight paths onto a sphere as wide for `grid` grippers as the dome of the examples is for its 4 × 4.
fn wide_dome(grid: [usize; 2]) -> Scene {
    let mut scene = shipped("ideal_dome");
    let scale = (grid[0].max(grid[1]) - 1) as f64 / 3.0;
    let radius = 0.6 * scale;
    let pose = Pose::new([0.0, 0.0, -radius], [0.0; 3]);
    let mold = Mold::Sphere(Sphere { pose, radius, face: Face::Outside });
    scene.layup.ply.grid = Grid { nu: grid[0], nv: grid[1] };
    let [u, v] = [0, 1].map(|n| 0.05 * (grid[n] - 1) as f64);
    let place = |n: usize| {
        let [i, j] = scene.layup.ply.grid.id(n);
        [0.1 * i as f64 - u, 0.1 * j as f64 - v]
    };
    // to the places on the sphere straight above which the fabric would lie: along its great circles
    let start = |n: usize| [0.98 * place(n)[0], 0.98 * place(n)[1], 0.05];
    let end = |n: usize| {
        let [x, y] = place(n);
        let arc = x.hypot(y);
        let share = if arc > 0.0 { radius * (arc / radius).sin() / arc } else { 1.0 };
        [share * x, share * y, radius * ((arc / radius).cos() - 1.0)]
    };
    let grippers = 0..scene.layup.ply.grid.grippers();
    let step = |k: usize| {
        let between = |n| vector::between(start(n), end(n), k as f64 / 29.0);
        grippers.clone().map(between).collect()
    };
    scene.layup.motion = Motion {
        times: (0..30).map(|k| k as f64).collect(),
        positions: (0..30).map(step).collect(),
    };
    scene.layup.mold = Some(mold);
    scene.layup.target = None;
    scene
}

/// A whole drape of a sheet to rest; panics where it does not come there, because its time would say nothing.
fn sheet_to_rest(bencher: Bencher, scene: &Scene) {
    bencher.bench_local(|| {
        let drape = followed(scene, Model::Sheet);
        assert_eq!(drape.summary.status, Status::Converged);
        drape
    });
}

/// The paper's example, 341 nodes.
#[divan::bench(sample_count = 5, sample_size = 1)]
fn sheet_example_10_mm(bencher: Bencher) {
    sheet_to_rest(bencher, &meshed(example(), 10.0));
}

/// The dome, straight paths: 256 nodes and 961.
#[divan::bench(args = [20.0, 10.0], sample_count = 5, sample_size = 1)]
fn sheet_dome(bencher: Bencher, mesh_mm: f64) {
    sheet_to_rest(bencher, &meshed(shipped("ideal_dome"), mesh_mm));
}

/// Straight paths onto spheres that grow with the array: 256, 676 and 1 296 nodes of square arrays, lines every 20 mm.
#[divan::bench(args = [4, 6, 8], sample_count = 3, sample_size = 1)]
fn sheet_wide_dome(bencher: Bencher, side: usize) {
    sheet_to_rest(bencher, &meshed(wide_dome([side; 2]), 20.0));
}

/// The sheet on the wide dome with 12 × 10 grippers: 2 576 nodes.
#[divan::bench(sample_count = 3, sample_size = 1)]
fn sheet_wide_dome_12x10(bencher: Bencher) {
    sheet_to_rest(bencher, &meshed(wide_dome([12, 10]), 20.0));
}
