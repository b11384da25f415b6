//! Duration: how long the motion has taken. Where pads let go after its end, it ends when they do: until then the cell is busy and the
//! ply is held. The catenaries know no releases; [`crate::draping::record::Summary::decide_by`] takes that time from the sheet.

use super::{Description, Found, Measure, Scope, Site, State, Subject, Unit, Worth};
use crate::scene::Scene;

/// Duration; see the head of this file.
pub struct Duration;

impl Measure for Duration {
    fn description(&self) -> Description {
        Description {
            scope: Scope::Time,
            worth: Worth::Kept,
            subject: Subject::Motion,
            ..Description::new("duration", "duration_s", "duration", Unit::SECOND)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        scene.limits.duration
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        Some(Found { value: state.snapshot.time, site: Site::AllGrippers, place: None })
    }
}
