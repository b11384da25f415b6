//! Slack ratio: the slack of all segments of an edge as a share of its length.
//!
//! Its place is that of the largest slack in the edge.

use super::{Description, Found, Measure, Most, Scope, Site, State, Unit};
use crate::scene::Scene;

/// Slack ratio; see the head of this file.
pub struct SlackRatio;

impl Measure for SlackRatio {
    fn description(&self) -> Description {
        Description {
            scope: Scope::End,
            ..Description::new("slack_ratio", "slack_ratio", "slack ratio", Unit::SHARE)
        }
    }

    fn limit(&self, scene: &Scene) -> Option<f64> {
        (scene.mold.is_some() && scene.target.is_some()).then_some(scene.limits.slack_ratio)
    }

    fn evaluate(&self, state: &State) -> Option<Found> {
        loosest_edge(state)
    }
}

/// The edge with the largest slack ratio, and that ratio.
pub fn loosest_edge(state: &State) -> Option<Found> {
        let mut sums = vec![(0.0, 0.0, [0.0; 3]); state.edges()];
        for m in state.edge_misfits() {
            let (sum, largest, place) = &mut sums[m.catenary];
            *sum += m.slack() / m.whole;
            if m.slack() >= *largest {
                (*largest, *place) = (m.slack(), m.place);
            }
        }
        let mut most = Most::default();
        for (n, (sum, _, place)) in sums.into_iter().enumerate() {
            most.meet(sum, Site::Catenary(n), place);
        }
        most.found()
}
