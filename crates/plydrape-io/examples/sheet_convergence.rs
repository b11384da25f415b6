//! The table of `docs/theory/exactness.md`: how the sheet's answers depend on mesh, time step, contact stiffness and
//! tolerance.
//!
//! `cargo run --release -p plydrape-io --example sheet_convergence` prints it. The time step is the way that grippers go
//! in a step in which the ply touches; stiffer contact is a smaller depth of penetration.

use plydrape::measure::{Name, Observation};
use plydrape::motion::Motion;
use plydrape::planner::path::{MoldHeights, Strategy, trajectory};
use plydrape::scene::Scene;
use plydrape::sheet::{HandOver, SheetDrape, SheetTuning, Status, drape};
use std::ops::ControlFlow;
use std::path::Path;

fn main() {
    let cases = [
        ("dome, shallow front", front(12.0, 0.25)),
        ("dome, steep front", front(30.0, 0.6)),
        ("flat mold, straight path", shipped("01_flat_sheared_mold")),
    ];
    println!(
        "| drape | varied | height max, mm | ridge max, mm | position max, mm | first contact |"
    );
    println!("|---|---|---|---|---|---|");
    for (name, scene) in &cases {
        for (varied, mesh, tuning) in variants() {
            let mut scene = scene.clone();
            scene.layup.settings.sheet.mesh = Some(mesh * 1e-3);
            row(name, &varied, &scene, tuning);
        }
    }
}

/// What is varied, the mesh (mm), and the solver's constants.
fn variants() -> Vec<(String, f64, SheetTuning)> {
    let usual = SheetTuning::default();
    let mut variants: Vec<_> =
        [20.0, 10.0, 5.0].map(|mesh| (format!("mesh {mesh} mm"), mesh, usual)).into();
    for share in [0.5, 0.25] {
        let tuning = SheetTuning { contact_way: share * usual.contact_way, ..usual };
        variants.push((format!("time step × {share}"), 10.0, tuning));
    }
    for share in [0.1, 10.0] {
        let tuning = SheetTuning { contact_depth: usual.contact_depth / share, ..usual };
        variants.push((format!("contact stiffness × {share}"), 10.0, tuning));
    }
    let tuning = SheetTuning { step_tolerance: 0.1 * usual.step_tolerance, ..usual };
    variants.push(("tolerance × 0.1".to_owned(), 10.0, tuning));
    variants
}

/// Prints one row.
fn row(name: &str, varied: &str, scene: &Scene, tuning: SheetTuning) {
    let layup = &scene.layup;
    let draped = drape(layup, tuning, &|| false, |_, _, _| ControlFlow::Continue(()));
    let SheetDrape { sheet, status, report, last, .. } = match draped {
        Ok(draped) => draped,
        Err(error) => return println!("| {name} | {varied} | {error} | | | |"),
    };
    let state = HandOver::default().state(layup, &sheet, &last, true);
    let seen = Observation { layup, limits: &scene.limits, state: &state, past: None };
    let measured = |name: Name| name.measure().evaluate(&seen).map(|found| found.value);
    let mm = |value: Option<f64>| value.map_or("none".to_owned(), |mm| format!("{mm:.2}"));
    let [height, position] = [Name::Height, Name::Position].map(|name| mm(measured(name)));
    let ridge = mm(report.ridge_max_mm);
    let ended = if status == Status::Converged { "" } else { " (not converged)" };
    let contact = match (report.first_contact_step, report.first_contact_uv_mm) {
        (Some(step), Some([u, v])) => format!("step {step} at ({u:.0}, {v:.0}) mm"),
        _ => "none".to_owned(),
    };
    println!("| {name} | {varied} | {height}{ended} | {ridge} | {position} | {contact} |");
}

/// A scene of the shipped examples.
fn shipped(name: &str) -> Scene {
    let examples = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples");
    let path = Path::new(examples).join(name).join("scene.toml");
    plydrape_io::scene::read(&path).expect("the example is shipped with the project").scene
}

/// The dome of the examples, rolled on from its middle by a front of curvature `a` (1/m) and a steepest slope, its
/// lines not made taut.
fn front(a: f64, slope: f64) -> Scene {
    let mut scene = shipped("ideal_dome");
    let curvature = a * scene.layup.ply.cell[0].min(scene.layup.ply.cell[1]);
    let strategy = Strategy {
        start: [0.5; 2],
        ratio: 1.0,
        angle: 0.0,
        squareness: 0.0,
        curvature,
        slope,
        pretension: 0.0,
        press: 0.0,
        pull: 0.0,
    };
    let heights = MoldHeights::new(&scene).expect("the dome is a height").untightened();
    let positions = trajectory(&scene, &heights, strategy).expect("the front rolls over the dome");
    scene.layup.motion =
        Motion { times: (0..positions.len()).map(|n| n as f64).collect(), positions };
    scene
}
