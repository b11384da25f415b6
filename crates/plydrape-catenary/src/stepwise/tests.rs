//! How large a step is.

use super::front::Front;
use super::step::Step;
use super::{Limits, Task};
use crate::draping::Draping;
use crate::layup::{Layup, Model, Settings, Target};
use crate::material::{Material, Section};
use crate::mold::{Face, Mold, Pose, Sphere};
use crate::motion::Motion;
use crate::ply::{Grid, Ply};
use crate::sensitivity::{Sensitivity, tuning};

/// The paper's ply with `count` × `count` grippers, 2 % slack, above a flat dome.
pub fn layup(count: usize) -> Layup {
    let grid = Grid { nu: count, nv: count };
    let section = Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 };
    let material = Material { section, ..Material::woven("krogh2018", 0.3143, 9e-6, 1e6, 5.0) };
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
    Layup { mold: Some(mold), target: Some(target), ..Layup::new(ply, settings, motion) }
}

const LIMITS: Limits = Limits {
    shear: 0.8,
    tilt: 0.5,
    force: 1e3,
    gripper_distance: 0.05,
    overstretch: 1e-3,
    slack_ratio: 1e-3,
    landing_gripper: 5e-4,
    workspace: None,
};

/// Numbers that the program of the first step holds.
fn size(count: usize) -> usize {
    let layup = layup(count);
    let task = Task { layup: &layup, steps: 90, move_limit: None, limits: LIMITS };
    let positions = &layup.motion.positions[0];
    let targets = &layup.target.as_ref().expect("a target").grippers;
    let mut draping = Draping::new(&layup);
    let shape = draping.move_to(positions);
    let contacts = draping.contacts.clone();
    let sensitivity = Sensitivity::new(
        &layup,
        &mut draping.solver,
        &shape,
        positions,
        &contacts,
        tuning::TUNING.negligible,
    );
    let step = Step {
        task: &task,
        targets,
        front: &Front::new(&task, targets),
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
