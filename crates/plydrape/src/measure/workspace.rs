//! Workspace: how far the gripper farthest outside its box is from the box.

use super::{Description, Found, Measure, State, Subject, Unit, Worth};
use crate::draping::reach::outside;
use crate::scene::Scene;

/// Workspace; see the head of this file.
pub struct Workspace;

impl Measure for Workspace {
    fn description(&self) -> Description {
        Description {
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("workspace", "workspace_mm", "outside workspace", Unit::MILLIMETRE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.limits.workspace.map(|_| 0.0)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        outside(state.snapshot.commanded(), state.scene.limits.workspace?, state.scene.ply.cell)
    }
}
