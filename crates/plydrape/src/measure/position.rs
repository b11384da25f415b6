//! Distance of the sheet's landed points from their places in the ideal drape. It is found on the sheet alone, [`crate::sheet`].

use super::{Description, Measure, Scope, Unit};
use crate::scene::Scene;

/// Distance of the sheet's landed points from their places in the ideal drape; see the head of this file.
pub struct Position;

impl Measure for Position {
    fn description(&self) -> Description {
        let own = Description::new("position", "position_mm", "position of landed points", Unit::MILLIMETRE);
        Description { scope: Scope::Whole, ..own }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.position * 1e3)
    }
}
