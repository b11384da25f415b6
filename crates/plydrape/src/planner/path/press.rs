//! How grippers on mounts press the ply on the mold as they land: they are commanded below their places.
//!
//! A line of grippers hangs higher than the middles of the cells beside it, which land first and catch the fabric that
//! crosses the line. A mount gives, so its gripper can be commanded to come down earlier and deeper than a rigid one: the
//! line lands with its surroundings, and an error of height does not leave the gripper above the mold.

use super::tuning::TUNING;
use crate::draping::spans::Point;
use crate::mold::distance;
use crate::mold::vector::along;
use crate::planner::tuning;
use crate::scene::Scene;

/// Whether the mounts of a scene give across the ply, so that its grippers can press.
#[must_use]
pub fn can_press(scene: &Scene) -> bool {
    scene.settings.pad.axial_stiffness.is_some()
}

/// From the place of each gripper on the mold to where it is commanded when it presses with a share of the load that it may
/// press with (m).
fn depths(scene: &Scene, share: f64) -> Vec<Point> {
    let Some(target) = scene.target.as_ref() else { return Vec::new() };
    let pad = &scene.settings.pad;
    let compliance = |stiffness: Option<f64>| stiffness.map_or(0.0, |k| 1.0 / k);
    let [lateral, axial] = [pad.lateral_stiffness, pad.axial_stiffness].map(compliance);
    let force = share * TUNING.front.press * scene.limits.gripper_load;
    let compliances = [lateral, lateral, axial];
    let depth = |place: &Point| {
        let normal = scene.mold.as_ref().map_or([0.0, 0.0, 1.0], |mold| mold.normal(*place));
        [0, 1, 2].map(|n| -force * compliances[n] * normal[n])
    };
    target.grippers.iter().map(depth).collect()
}

/// Where the grippers are commanded at the end (m): at their places, or as much below as presses with a share of that load.
#[must_use]
pub fn ends(scene: &Scene, share: f64) -> Vec<Point> {
    let Some(target) = scene.target.as_ref() else { return Vec::new() };
    if share <= 0.0 || !can_press(scene) {
        return target.grippers.clone();
    }
    let below = target.grippers.iter().zip(depths(scene, share));
    below.map(|(place, depth)| along(*place, 1.0, depth)).collect()
}

/// The same positions (m), commanded so that each gripper presses with a share of the load that it may press with, the more
/// the nearer it is to its place.
pub fn press(scene: &Scene, positions: &mut [Vec<Point>], share: f64) {
    let Some(target) = scene.target.as_ref().filter(|_| share > 0.0 && can_press(scene)) else {
        return;
    };
    let reach = TUNING.front.press_reach * tuning::cell(scene);
    let depths = depths(scene, share);
    for step in positions {
        for ((place, target), depth) in step.iter_mut().zip(&target.grippers).zip(&depths) {
            let near = 1.0 - (distance(*place, *target) / reach).min(1.0);
            // smooth where it begins and where it is full
            *place = along(*place, near * near * (3.0 - 2.0 * near), *depth);
        }
    }
}
