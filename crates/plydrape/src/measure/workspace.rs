//! Workspace: how far the gripper farthest outside its box is from the box.

use super::{Found, Measure, State, Unit, Worth};
use crate::draping::reach::outside;
use crate::scene::Scene;

/// Workspace; see the head of this file.
pub struct Workspace;

impl Measure for Workspace {
    fn name(&self) -> &'static str {
        "workspace"
    }

    fn key(&self) -> &'static str {
        "workspace_mm"
    }

    fn label(&self) -> &'static str {
        "outside workspace"
    }

    fn unit(&self) -> Unit {
        Unit::MILLIMETRE
    }

    fn worth(&self) -> Worth {
        Worth::Kept
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.limits.workspace.map(|_| 0.0)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        outside(&state.snapshot.positions, state.scene.limits.workspace?, state.scene.ply.cell)
    }
}
