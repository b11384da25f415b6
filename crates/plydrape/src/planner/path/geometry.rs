//! What the positions of the grippers alone tell of a plan, before any drape.

use crate::draping::reach::{closest, outside};
use crate::draping::spans::Point;
use crate::mold::vector::{cross, sub, unit};
use crate::scene::Scene;

/// The largest ratio of a measure to its limit: tilt, workspace, and distance of the grippers. Above 1 no drape keeps
/// them all, but for the tilt, which is that of the lines between neighbours and not of the ply itself.
#[must_use]
pub fn excess(scene: &Scene, positions: &[Vec<Point>]) -> f64 {
    let limits = &scene.limits;
    let one = |step: &Vec<Point>| {
        let tilt = tilt(scene, step) / limits.tilt;
        let workspace = limits.workspace.and_then(|box_| outside(step, box_, scene.ply.cell));
        let workspace = if workspace.is_some_and(|w| w.value > 0.0) { f64::INFINITY } else { 0.0 };
        let near = closest(step).map_or(0.0, |c| limits.gripper_distance * 1e3 / c.value);
        tilt.max(workspace).max(near)
    };
    positions.iter().map(one).fold(0.0, f64::max)
}

/// Largest angle (rad) between the vertical and the normal of the lines to neighbouring grippers.
fn tilt(scene: &Scene, positions: &[Point]) -> f64 {
    let grid = scene.ply.grid;
    let one = |n: usize| {
        let [i, j] = grid.id(n);
        let across = |at: usize, count: usize, place: &dyn Fn(usize) -> usize| {
            let [low, high] = [at.saturating_sub(1), (at + 1).min(count - 1)].map(place);
            sub(positions[high], positions[low])
        };
        let u = across(i, grid.nu, &|i| grid.index([i, j]));
        let v = across(j, grid.nv, &|j| grid.index([i, j]));
        let v = if grid.nv > 1 { v } else { cross([0.0, 0.0, 1.0], u) };
        unit(cross(u, v)).map_or(0.0, |normal| normal[2].clamp(-1.0, 1.0).acos())
    };
    (0..grid.grippers()).map(one).fold(0.0, f64::max)
}
