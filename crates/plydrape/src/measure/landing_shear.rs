//! Landing shear error |γ_end − γ_l|: how much the shear of a cell at the end differs from the one that it had when a diagonal of it
//! landed.
//!
//! A diagonal is no fiber: a cell that lands with a shear other than its last one is in the wrong shape, whichever of its diagonals
//! that leaves too long or too short. γ_end is that of the four grippers, along the mold where both ends of a diagonal stand on it.

use super::{Description, Found, Measure, Most, Scope, Site, State, Unit};
use crate::mold::vector::between;
use crate::ply::BiasLines;
use crate::ply::shear::{mean_path, signed_angle};
use crate::scene::Scene;

/// Landing shear error |γ_end − γ_l|; see the head of this file.
pub struct LandingShear;

impl Measure for LandingShear {
    fn description(&self) -> Description {
        Description {
            scope: Scope::End,
            ..Description::new(
                "landing_shear",
                "landing_shear_deg",
                "landing shear error",
                Unit::DEGREE,
            )
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        let judged = scene.mold.is_some() && scene.target.is_some() && !scene.ply.lines().cells().is_empty();
        judged.then(|| scene.limits.landing_shear.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let (scene, snapshot) = (state.scene, state.snapshot);
        let (mold, lines) = (scene.mold.as_ref()?, scene.ply.lines());
        let tolerance = scene.settings.contact.tolerance;
        let mut most = Most::default();
        let path = |n: usize| {
            let [a, b] = lines.ends(n).map(|gripper| snapshot.positions[gripper]);
            let stand = [a, b].iter().all(|p| mold.signed_distance(*p) <= tolerance);
            if stand { mold.path_length(a, b) } else { crate::mold::distance(a, b) }
        };
        for (number, cell) in lines.cells().iter().enumerate() {
            let bias = cell.bias.iter().flat_map(BiasLines::list);
            let landed = bias.filter_map(|n| snapshot.contacts[*n].as_ref()?.landed);
            if landed.clone().next().is_none() {
                continue;
            }
            let [rising, falling] = cell.bias.map(|bias| mean_path(bias.list(), path));
            let end = signed_angle(scene.ply.trellis(cell, &snapshot.contacts), rising, falling);
            let errors = landed.map(|landed| (end - landed.shear).abs());
            let [low, _, top, _] = cell.corners.map(|gripper| snapshot.positions[gripper]);
            for error in errors {
                most.meet(error.to_degrees(), Site::Cell(number), between(low, top, 0.5));
            }
        }
        Some(most.found().unwrap_or(Found::NONE))
    }
}
