//! Landing of contact points: how far the fibers that have landed are from where the ideal drape has the same fabric.
//!
//! A diagonal is no fiber. Where its points land follows from the shear that its cell lands with, which is judged by itself
//! (`landing_shear.rs`); their distances stand in the record of the diagonal.

use super::{Description, Found, Measure, Most, Scope, Site, State, Unit};
use crate::scene::Scene;

/// Landing of contact points; see the head of this file.
pub struct LandingContact;

impl Measure for LandingContact {
    fn description(&self) -> Description {
        Description {
            scope: Scope::End,
            ..Description::new(
                "landing_contact",
                "landing_contact_mm",
                "landing of contact points",
                Unit::MILLIMETRE,
            )
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.target.as_ref().map(|_| scene.limits.landing_contact * 1e3)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        let mut most = Most::default();
        for (n, landing) in state.landings().iter().enumerate().take(state.edges()) {
            let contact = state.snapshot.contacts[n].as_ref();
            let worst = contact
                .zip(landing.as_ref())
                .and_then(|(contact, found)| found.worst(&contact.line));
            if let Some((error, place)) = worst {
                most.meet(error, Site::Catenary(n), place);
            }
        }
        most.in_units_of(1e-3)
    }
}
