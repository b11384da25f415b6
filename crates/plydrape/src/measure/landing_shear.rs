//! Landing shear error |γ_end − γ_l|: how much the shear of a cell at the end differs from the one that it had when a diagonal of it
//! landed.
//!
//! A diagonal is no fibre: a cell that lands with a shear other than its last one is in the wrong shape, whichever of its diagonals
//! that leaves too long or too short. γ_end is that of the four grippers, along the mold where both ends of a diagonal stand on it.

use super::{Description, Found, Measure, Most, Scope, Site, State, Unit};
use crate::mold::vector::between;
use crate::ply::shear::signed_angle;
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
        let judged = scene.mold.is_some() && scene.target.is_some() && scene.ply.grid.cells() > 0;
        judged.then(|| scene.limits.landing_shear.to_degrees())
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let (scene, snapshot) = (state.scene, state.snapshot);
        let (mold, grid) = (scene.mold.as_ref()?, scene.ply.grid);
        let tolerance = scene.settings.contact.tolerance;
        let mut most = Most::default();
        for cell in 0..grid.cells() {
            let diagonals = grid.diagonals([cell % (grid.nu - 1), cell / (grid.nu - 1)]);
            let landed =
                diagonals.map(|n| snapshot.contacts[n].as_ref().and_then(|contact| contact.landed));
            if landed == [None, None] {
                continue;
            }
            let ends = diagonals.map(|n| {
                let c = grid.catenary(n);
                [c.from, c.to].map(|g| snapshot.positions[grid.index(g)])
            });
            let [rising, falling] = ends.map(|[a, b]| {
                let stand = [a, b].iter().all(|p| mold.signed_distance(*p) <= tolerance);
                if stand { mold.path_length(a, b) } else { crate::mold::distance(a, b) }
            });
            let end = signed_angle(scene.ply.sides(cell, &snapshot.contacts), rising, falling);
            let errors = landed.into_iter().flatten().map(|landed| (end - landed.shear).abs());
            for error in errors {
                let place = between(ends[0][0], ends[0][1], 0.5);
                most.meet(error.to_degrees(), Site::Cell(cell), place);
            }
        }
        Some(most.found().unwrap_or(Found::NONE))
    }
}
