//! Contact share: the length of the edges that lies on the mold, of the length of all edges.

use super::{Description, Found, Measure, Scope, Sense, Site, State, Unit};
use crate::scene::Scene;

/// Contact share; see the head of this file.
pub struct ContactShare;

impl Measure for ContactShare {
    fn description(&self) -> Description {
        Description {
            sense: Sense::AtLeast,
            scope: Scope::End,
            ..Description::new("contact_share", "contact_share", "contact share", Unit::SHARE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        (scene.mold.is_some() && scene.target.is_some()).then_some(scene.limits.contact_share)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        state.scene.mold.as_ref()?;
        let (ply, lines) = (&state.scene.ply, state.scene.ply.lines());
        let (mut lying, mut total) = (0.0, 0.0);
        for (n, contact) in state.snapshot.contacts.iter().enumerate().take(lines.edges()) {
            total += lines.flat_length(n, ply.length_factor);
            let Some(contact) = contact else { continue };
            let beside = (0..2)
                .filter(|&which| contact.lying[which])
                .map(|which| contact.free_length(which));
            lying += contact.line.length() + beside.sum::<f64>();
        }
        Some(Found { value: lying / total, site: Site::AllEdges, place: None })
    }
}
