//! Height of the sheet over the mold at the end. It is found on the sheet alone, [`crate::sheet`].

use super::{Description, Measure, Scope, Unit};
use crate::scene::Scene;

/// Height of the sheet over the mold at the end; see the head of this file.
pub struct Height;

impl Measure for Height {
    fn description(&self) -> Description {
        let own = Description::new("height", "height_mm", "height over the mold", Unit::MILLIMETRE);
        Description { scope: Scope::Whole, ..own }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.height * 1e3)
    }
}
