//! Shear: the largest shear angle of a cell, (6) of `docs/theory`.

use super::{Description, Found, Measure, Most, Site, State, Unit, Worth};
use crate::mold::vector::between;
use crate::scene::Scene;

/// Shear; see the head of this file.
pub struct Shear;

impl Measure for Shear {
    fn description(&self) -> Description {
        Description {
            worth: Worth::Kept,
            ..Description::new("shear", "shear_deg", "shear", Unit::DEGREE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        (!scene.ply.lines().cells().is_empty()).then(|| scene.limits.shear.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let lines = state.scene.ply.lines();
        let mut most = Most::default();
        for (cell, shear) in state.snapshot.shear.iter().enumerate() {
            let [low, _, top, _] =
                lines.cells()[cell].corners.map(|gripper| state.snapshot.positions[gripper]);
            let angle = shear.map_or(0.0, |shear| shear.angle.to_degrees());
            most.meet(angle, Site::Cell(cell), between(low, top, 0.5));
        }
        most.found()
    }
}
