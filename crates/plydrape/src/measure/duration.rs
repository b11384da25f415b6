//! Duration: how long the motion has taken. Where pads let go after its end, it ends when they do, because until then the cell is busy
//! and the ply is held.

use super::{Bound, Description, Found, Measure, Observation, Practice, Scope, Unit, Worth};
use crate::state::Site;

/// Duration; see the head of this file.
pub struct Duration;

impl Measure for Duration {
    fn description(&self) -> Description {
        let own = Description::new("duration", "duration_s", "duration", Unit::SECOND);
        Description { scope: Scope::Time, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::within("Longest time that the motion may take", [1e-6, 1e7], "a motion")
                .found(Practice::DURATION)
                .such_as(30.0),
        )
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        Some(Found { value: seen.state.time, site: Site::AllGrippers, place: None })
    }
}
