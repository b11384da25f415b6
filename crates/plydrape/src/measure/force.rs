//! Force: the largest horizontal force of an edge that hangs from gripper to gripper, as the model has it for its line.
//!
//! Segments that the mold holds are left out: their force is that of the axial stiffness, and so are diagonals, which
//! are no fibers.

use super::{Description, Found, Measure, Most, Site, State, Unit, Worth};
use crate::scene::Scene;

/// Force; see the head of this file.
pub struct Force;

impl Measure for Force {
    fn description(&self) -> Description {
        Description {
            worth: Worth::Kept,
            ..Description::new("force", "force_n", "horizontal force", Unit::NEWTON)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.limits.force
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for span in &state.snapshot.shape.spans {
            let hangs =
                span.catenary < state.edges() && state.snapshot.contacts[span.catenary].is_none();
            if let Some(force) = span.force.filter(|_| hangs) {
                most.meet(force.abs(), Site::Catenary(span.catenary), span.point(0.5));
            }
        }
        most.found()
    }
}
