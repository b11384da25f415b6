//! Angle of the sheet's fibers out of the mold's plane at the end. It is found on the sheet alone, [`crate::sheet`].

use super::{Description, Measure, Scope, Unit};
use crate::scene::Scene;

/// Angle of the sheet's fibers out of the mold's plane at the end; see the head of this file.
pub struct OutOfPlane;

impl Measure for OutOfPlane {
    fn description(&self) -> Description {
        let own = Description::new("out_of_plane", "out_of_plane_deg", "fiber angle out of plane", Unit::DEGREE);
        Description { scope: Scope::Whole, ..own }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        Some(scene.limits.out_of_plane.to_degrees())
    }
}
