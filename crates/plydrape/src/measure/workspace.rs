//! Workspace: how far the gripper farthest outside its box is from the box.

use super::{Description, Found, Limits, Measure, Most, Observation, TUNING, Unit, Worth};
use crate::geometry::Point;
use crate::layup::Layup;
use crate::state::Site;

/// Workspace; see the head of this file.
pub struct Workspace;

impl Measure for Workspace {
    fn description(&self) -> Description {
        let own =
            Description::new("workspace", "workspace_mm", "outside workspace", Unit::MILLIMETER);
        Description { worth: Worth::Kept, ..own }
    }

    fn derived_limit(&self, _layup: &Layup, limits: &Limits) -> Option<f64> {
        limits.workspace.map(|_| 0.0)
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        outside_workspace(&seen.commanded(), seen.limits.workspace?, seen.layup.ply.cell)
    }
}

/// The gripper farthest outside a box ([from, to] in x, y and z, m): its distance from the box (mm), zero
/// where none is outside by more than rounding, a share of the shorter side of a cell (m).
pub(crate) fn outside_workspace(
    positions: &[Point],
    workspace: [[f64; 2]; 3],
    [a, b]: [f64; 2],
) -> Option<Found> {
    let beyond = |point: &Point| {
        let excess = |n: usize| {
            let [from, to] = workspace[n];
            // NaN is within no bounds, and stays
            if (from..=to).contains(&point[n]) { 0.0 } else { (from - point[n]).max(point[n] - to) }
        };
        let far = excess(0).hypot(excess(1)).hypot(excess(2));
        if far <= TUNING.workspace_rounding * a.min(b) { 0.0 } else { far }
    };
    let mut most = Most::default();
    for (n, point) in positions.iter().enumerate() {
        most.meet(beyond(point), Site::Gripper(n), *point);
    }
    let found = most.in_units_of(1e-3)?;
    Some(if found.value == 0.0 { Found::NONE } else { found })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A box of 1 m; 3 and 4 mm outside it make 5 mm from its edge.
    #[test]
    fn the_distance_from_the_workspace_is_that_of_its_nearest_point() {
        let workspace = [[0.0, 1.0]; 3];
        let mut positions = vec![[0.5; 3]; 6];
        let worst = outside_workspace(&positions, workspace, [0.1; 2]).unwrap();
        assert_eq!(worst, Found::NONE);
        positions[1] = [0.5, 0.5, 1.0 + 1e-12];
        assert_eq!(outside_workspace(&positions, workspace, [0.1; 2]).unwrap().value, 0.0);
        positions[4] = [1.003, 0.5, -0.004];
        let worst = outside_workspace(&positions, workspace, [0.1; 2]).unwrap();
        assert!((worst.value - 5.0).abs() < 1e-9, "{}", worst.value);
        assert_eq!(worst.site, Site::Gripper(4));
    }
}
