//! What one drape of the sheet costs: time steps, linear systems, and the time. The table of benches/README.md.
//!
//! A ring that rolls over a dome, the first candidate of a search, lays the ply; the paper's example goes along its own straight
//! paths. `cargo bench -p plydrape-io --bench sheet -- "4 × 4"` drapes those whose name has this text.

mod scenes;

use plydrape::layup::Layup;
use plydrape::motion::Motion;
use plydrape::planner::path::{MoldHeights, Strategy, trajectory};
use plydrape::scene::Scene;
use plydrape::sheet::{self, SheetTuning};
use scenes::{array, dome, example, examples, is_asked};
use std::ops::ControlFlow;
use std::time::Instant;

/// Grippers along u and v, and the radius (m) of the dome below them.
const DOMES: [([usize; 2], f64); 3] = [([4, 4], 0.6), ([8, 8], 2.4), ([12, 10], 2.4)];
/// Materials: names, and lines of their scenes.
const MATERIALS: [(&str, &str); 3] = [
    ("the paper's ply", "material = \"krogh2018\""),
    (
        "stiff in shear, 40 N/m at 20°",
        "material = { name = \"stiff\", mass = \"0.3143 kg/m\", flexural_rigidity = \"9e-6 N m^2\", tension = \"1e6 N/m\", shear_curve = \"114.6 N/m\" }",
    ),
    ("cao2008_plain", "material = \"cao2008_plain\""),
];

fn main() {
    println!(
        "| drape | nodes | time steps | linear systems | each step | time | height | end |\n|---|---|---|---|---|---|---|---|"
    );
    if is_asked("the paper's example") {
        row("the paper's example", &example(&examples().join("01_flat_sheared_mold")).layup);
    }
    let plain = DOMES.iter().map(|dome| (*dome, MATERIALS[0]));
    let stiff = MATERIALS[1..].iter().map(|material| (DOMES[0], *material));
    for (([nu, nv], radius), (material, line)) in plain.chain(stiff) {
        let name = format!("{nu} × {nv} dome, {material}");
        if is_asked(&name) {
            row(&name, &rolled(array([nu, nv], line, &dome(radius), &examples())));
        }
    }
}

/// The layup of a scene, with a ring that rolls over its mold for a motion.
fn rolled(scene: Scene) -> Layup {
    let heights = MoldHeights::new(&scene).expect("a sphere is a height");
    let ring = Strategy { slope: 0.4, ..Strategy::families(&scene, |shape| shape.slope)[0] };
    let positions = trajectory(&scene, &heights, ring).expect("a mold and a target");
    let times = (0..positions.len()).map(|n| n as f64).collect();
    Layup { motion: Motion { times, positions }, ..scene.layup }
}

fn row(name: &str, layup: &Layup) {
    let mut height = 0.0_f64;
    let start = Instant::now();
    let done = sheet::drape(layup, SheetTuning::default(), &|| false, |_, state, last| {
        if last {
            height = state.heights.iter().copied().fold(0.0, f64::max);
        }
        ControlFlow::Continue(())
    });
    let seconds = start.elapsed().as_secs_f64();
    let done = done.expect("a sheet");
    let report = &done.report;
    println!(
        "| {name} | {} | {} | {} | {:.1} | {seconds:.2} s | {:.2} mm | {:?} |",
        report.nodes,
        report.time_steps,
        report.solves,
        report.solves as f64 / report.time_steps.max(1) as f64,
        height * 1e3,
        done.status,
    );
}
