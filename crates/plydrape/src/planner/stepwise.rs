//! The stepwise planner of the catenaries, [`plydrape_catenary::stepwise`], within the limits of a scene.

pub use plydrape_catenary::stepwise::{PositionError, Stepwise, StepwiseEnd, tuning};

use crate::measure::Name;
use crate::scene::Scene;
use plydrape_catenary::stepwise::{self, Limits, Task};
use std::ops::ControlFlow;

/// Plans the gripper positions of a scene, step by step, from its start to its target in at most as many steps as its plan has. `progress`
/// receives the number of steps after each step; when it breaks, the plan ends there.
pub fn stepwise(scene: &Scene, progress: &mut dyn FnMut(usize) -> ControlFlow<()>) -> Stepwise {
    let most = |name: Name| scene.limits.most(name);
    let limits = Limits {
        shear: most(Name::Shear),
        tilt: most(Name::Tilt),
        force: most(Name::Force),
        gripper_distance: most(Name::GripperDistance),
        overstretch: most(Name::Overstretch),
        slack_ratio: most(Name::SlackRatio),
        landing_gripper: most(Name::LandingGripper),
        workspace: scene.limits.workspace,
    };
    let (steps, move_limit) = (scene.plan.steps, scene.plan.move_limit);
    stepwise::stepwise(&Task { layup: &scene.layup, steps, move_limit, limits }, progress)
}
