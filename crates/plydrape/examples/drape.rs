//! A scene made without a file: a ply between 4 × 2 grippers is lowered straight onto a flat mold, then a motion is
//! planned for it.
//!
//! `cargo run --release --example drape`

use plydrape::material::Section;
use plydrape::mold::Plane;
use plydrape::ply::Grid;
use plydrape::{Material, Mold, Motion, Ply, Scene, Settings, Target, plan, simulate};
use std::ops::ControlFlow;

/// Gripper positions (m), i running fastest.
fn grid(grid: Grid, spacing: f64, shear: f64, height: f64) -> Vec<[f64; 3]> {
    let (sin, cos) = shear.sin_cos();
    let at = |n: usize| {
        let [i, j] = grid.id(n).map(|k| k as f64 * spacing);
        [i + j * sin, j * cos, height]
    };
    (0..grid.grippers()).map(at).collect()
}

fn main() {
    let ply = Ply::of_array(
        Grid { nu: 4, nv: 2 },
        [0.1, 0.1],
        Material {
            name: "krogh2018".into(),
            source: "Krogh et al. 2018, Table 1".into(),
            section: Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 },
            shear_curve: None,
            tension: None,
            locking_angle: None,
            moment: Default::default(),
            scatter: Default::default(),
        },
    );
    // 2 mm closer than the fabric and 75 mm up at the start, sheared by 20 degrees on the mold at the end
    let start = grid(ply.grid, 0.098, 0.0, 0.075);
    let end = grid(ply.grid, 0.1, 20_f64.to_radians(), 0.0);
    let steps = 30;
    let between = |k: usize| -> Vec<[f64; 3]> {
        let t = k as f64 / (steps - 1) as f64;
        let way = start.iter().zip(&end);
        way.map(|(a, b)| [0, 1, 2].map(|c| a[c] + t * (b[c] - a[c]))).collect()
    };
    let settings = Settings::default();
    let motion = Motion {
        times: (0..steps).map(|k| k as f64).collect(),
        positions: (0..steps).map(between).collect(),
    };
    let scene = Scene {
        title: "Flat mold".into(),
        mold: Some(Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] })),
        target: Some(Target { grippers: end.clone(), drape: None }),
        ..Scene::new(ply, settings, motion)
    };

    let drape = simulate(&scene, |_| ControlFlow::Continue(()));
    println!("straight paths, accepted: {}", drape.summary.accepted);
    for verdict in drape.summary.limits.iter().filter(|verdict| !verdict.ok) {
        println!("  {} is {:.3} {}", verdict.name.title(), verdict.value, verdict.unit);
    }

    match plan(&scene, None, &mut |_| ControlFlow::Continue(())) {
        Ok(planned) => println!(
            "planned in {} drapes, {:.1} s long, accepted: {}",
            planned.record.evaluations,
            planned.motion.duration(),
            planned.drape.summary.accepted
        ),
        Err(refused) => eprintln!("{refused}"),
    }
}
