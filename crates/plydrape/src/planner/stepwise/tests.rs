//! How large a step is.

use super::front::Front;
use super::step::Step;
use crate::draping::Draping;
use crate::layup::{Model, Settings, Target};
use crate::material::{Material, Section};
use crate::measure::Name;
use crate::mold::{Face, Mold, Pose, Sphere};
use crate::motion::Motion;
use crate::planner::sensitivity::Sensitivity;
use crate::ply::{Grid, Ply};
use crate::scene::Scene;

/// The paper's ply with `count` × `count` grippers, 2 % slack, above a flat dome.
pub fn scene(count: usize) -> Scene {
    let grid = Grid { nu: count, nv: count };
    let material = Material {
        name: "krogh2018".into(),
        source: "Krogh et al. 2018, Table 1".into(),
        section: Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 },
        shear_curve: None,
        tension: None,
        locking_angle: None,
        moment: Default::default(),
        scatter: Default::default(),
    };
    let ply = Ply::of_array(grid, [0.1; 2], material);
    let settings = Settings { model: Model::Catenaries, ..Settings::default() };
    let pose = Pose::new([0.0, 0.0, -10.0], [0.0; 3]);
    let mold = Mold::Sphere(Sphere { pose, radius: 10.0, face: Face::Outside });
    let middle = 0.5 * (count - 1) as f64;
    let place = |n: usize, spacing: f64| grid.id(n).map(|k| spacing * (k as f64 - middle));
    let start = |n: usize| {
        let [x, y] = place(n, 0.098);
        // no two cells are alike
        [x, y, 0.05 + 1e-3 * (1.7 * n as f64).sin()]
    };
    let end = |n: usize| {
        let [x, y] = place(n, 0.0999);
        mold.closest_point([x, y, 0.0]).point
    };
    let positions = vec![(0..grid.grippers()).map(start).collect()];
    let target = Target { grippers: (0..grid.grippers()).map(end).collect(), drape: None };
    let motion = Motion { times: vec![0.0], positions };
    let mut scene = Scene::new(ply, settings, motion);
    (scene.layup.mold, scene.layup.target) = (Some(mold), Some(target));
    scene.limits.set(Name::Force, Some(1e3));
    scene
}

/// Numbers that the program of the first step holds.
fn size(count: usize) -> usize {
    let scene = scene(count);
    let positions = &scene.layup.motion.positions[0];
    let targets = &scene.layup.target.as_ref().expect("a target").grippers;
    let mut draping = Draping::new(&scene.layup);
    let shape = draping.move_to(positions);
    let contacts = draping.contacts.clone();
    let sensitivity = Sensitivity::new(&scene, &mut draping.solver, &shape, positions, &contacts);
    let step = Step {
        scene: &scene,
        targets,
        front: &Front::new(&scene, targets),
        positions,
        arrived: &vec![false; targets.len()],
        before: &vec![[0.0; 3]; targets.len()],
        landing: false,
        reach: 0.01,
        firm: true,
    };
    step.program(&sensitivity).count()
}

/// With nine times the grippers there are nine times the numbers in a step's program, but for the boundary, where grippers
/// have fewer neighbors.
#[test]
fn a_step_grows_linearly_with_the_grippers() {
    let per_gripper = [10, 20, 30].map(|count| size(count) as f64 / (count * count) as f64);
    let [small, middle, large] = per_gripper;
    assert!(large < 1.2 * small && large < 1.05 * middle, "{per_gripper:?}");
}
