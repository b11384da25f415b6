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
        (scene.ply.grid.cells() > 0).then(|| scene.limits.shear.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let grid = state.scene.ply.grid;
        let mut most = Most::default();
        for (cell, shear) in state.snapshot.shear.iter().enumerate() {
            let [i, j] = [cell % (grid.nu - 1), cell / (grid.nu - 1)];
            let corner = |di, dj| state.snapshot.positions[grid.index([i + di, j + dj])];
            let angle = shear.map_or(0.0, |shear| shear.angle.to_degrees());
            most.meet(angle, Site::Cell(cell), between(corner(0, 0), corner(1, 1), 0.5));
        }
        most.found()
    }
}
