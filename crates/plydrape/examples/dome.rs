//! From a mold to a planned motion: 2 × 2 grippers lay a prepreg on a dome.
//!
//! `cargo run --release --example dome`; the same in Python is `examples/first_plan.py`.

use plydrape::measure::Name;
use plydrape::mold::{Face, Pose, Sphere};
use plydrape::ply::Grid;
use plydrape::{Material, Mold, Ply, Scene, plan};
use std::error::Error;
use std::ops::ControlFlow;

fn main() -> Result<(), Box<dyn Error>> {
    // 314 g/m², held at the corners of 100 mm, on a dome of 1 m radius
    let prepreg = Material::woven("prepreg", 0.3143, 9e-5, 1e6, 5.0);
    let ply = Ply::of_array(Grid { nu: 2, nv: 2 }, [0.1, 0.1], prepreg);
    let pose = Pose::upright([0.0, 0.0, -1.0]);
    let dome = Mold::Sphere(Sphere { pose, radius: 1.0, face: Face::Outside });
    let mut scene = Scene::above(ply, dome, [0.0, 0.0])?;
    scene.limits.set(Name::Height, Some(0.5e-3));

    // the motion, judged by the whole ply as a sheet
    let planned = plan(&scene, None, &mut |_| ControlFlow::Continue(()))?;
    let summary = &planned.outcome.drape.summary;
    println!("{:.1} s, accepted: {}", planned.motion.duration(), planned.accepted());
    for verdict in &summary.limits {
        let label = verdict.name.measure().label();
        println!("  {label}: {:.2} {}", verdict.value, verdict.unit);
    }
    Ok(())
}
