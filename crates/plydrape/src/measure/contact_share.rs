//! Contact share: the length of the edges that lies on the mold, of the length of all edges.

use super::{Bound, Description, Found, Measure, Observation, Scope, Sense, Unit};
use crate::layup::Layup;
use crate::state::Site;

/// Contact share; see the head of this file.
pub struct ContactShare;

impl Measure for ContactShare {
    fn description(&self) -> Description {
        let own = Description::of_catenaries(
            "contact_share",
            "contact_share",
            "contact share",
            Unit::SHARE,
        );
        Description { sense: Sense::AtLeast, scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::share("Share of the ply's edges on the mold at the end")
                .usually(0.95, "our choice: the rest may hang beside the grippers"),
        )
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.mold.is_some() && layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.mold.as_ref()?;
        seen.edges().next()?;
        let (mut lying, mut total) = (0.0, 0.0);
        for (_, line) in seen.edges() {
            total += line.length;
            if line.lies {
                lying += line.length;
            }
        }
        Some(Found { value: lying / total, site: Site::AllEdges, place: None })
    }
}
