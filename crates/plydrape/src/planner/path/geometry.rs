//! What the positions of the grippers alone tell of a plan, before any drape.

use crate::geometry::Point;
use crate::geometry::vector::{angle_between, cross, unit};
use crate::measure::Name;
use crate::measure::{closest_grippers, outside_workspace};
use crate::ply::{Neighbors, Ply, tangents};
use crate::scene::Scene;

/// The largest ratio of a measure to its limit: tilt, workspace, and distance of the grippers. Above 1 no drape keeps
/// them all, but for the tilt, which is that of the lines between neighbors and not of the ply itself.
#[must_use]
pub fn excess(scene: &Scene, positions: &[Vec<Point>]) -> f64 {
    let limits = &scene.limits;
    let neighbors = scene.layup.ply.neighbors();
    let worst_ratio = |step: &Vec<Point>| {
        let tilt = tilt(&scene.layup.ply, &neighbors, step, scene.layup.stems(step))
            / limits.most(Name::Tilt);
        let workspace =
            limits.workspace.and_then(|sides| outside_workspace(step, sides, scene.layup.ply.cell));
        let workspace = if workspace.is_some_and(|w| w.value > 0.0) { f64::INFINITY } else { 0.0 };
        let near = closest_grippers(step)
            .map_or(0.0, |c| limits.least(Name::GripperDistance) * 1e3 / c.value);
        tilt.max(workspace).max(near)
    };
    positions.iter().map(worst_ratio).fold(0.0, f64::max)
}

/// Largest angle (rad) between the stems (unit vector) and the normal of the lines to neighboring grippers.
fn tilt(ply: &Ply, neighbors: &[Neighbors], positions: &[Point], stem: Point) -> f64 {
    let tilt_of = |n: usize| {
        let [u, v] = tangents(ply, neighbors, positions, n);
        unit(cross(u, v)).map_or(0.0, |normal| angle_between(normal, stem))
    };
    (0..ply.grippers()).map(tilt_of).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planner::sample::cloth;
    use crate::ply::Grid;

    /// All grippers of a level array that is inclined by an angle tilt by this angle, whatever its heading; so does a line of
    /// grippers that climbs by it.
    #[test]
    fn an_inclined_array_tilts_its_grippers_as_it_is_inclined() {
        for (nu, nv) in [(4, 3), (2, 2), (5, 1)] {
            let grid = Grid { nu, nv };
            for inclination in [0.0_f64, 0.2, 0.6] {
                let heading = 0.7 * inclination;
                let place = |n: usize| {
                    let [u, v] = grid.id(n).map(|k| 0.1 * k as f64);
                    let (x, z) = (u * inclination.cos(), u * inclination.sin());
                    let (sin, cos) = heading.sin_cos();
                    [x * cos - v * sin, x * sin + v * cos, z]
                };
                let places: Vec<Point> = (0..grid.grippers()).map(place).collect();
                let ply = cloth(grid);
                let found = tilt(&ply, &ply.neighbors(), &places, [0.0, 0.0, 1.0]);
                assert!((found - inclination).abs() < 1e-7, "{nu} × {nv}: {found} {inclination}");
            }
        }
    }
}
