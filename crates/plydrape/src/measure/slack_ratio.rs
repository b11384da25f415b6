//! Slack ratio: the slack of all segments of an edge as a share of its length.
//!
//! The place is that of the largest slack in the edge.

use super::{Bound, Description, Found, Measure, Most, Observation, Practice, Scope, Unit};
use crate::layup::Layup;
use crate::state::Site;
use std::collections::BTreeMap;

/// Slack ratio; see the head of this file.
pub struct SlackRatio;

impl Measure for SlackRatio {
    fn description(&self) -> Description {
        let own =
            Description::of_catenaries("slack_ratio", "slack_ratio", "slack ratio", Unit::SHARE);
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::share("Slack of a catenary, all its segments, as a share of its length")
                .found(Practice::SLACK)
                .usually(0.0005, "our choice: spread over an edge, a fiber angle of 2.6°"),
        )
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.mold.is_some() && layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        loosest_edge(seen)
    }
}

/// The edge with the largest slack ratio, and that ratio; `None` where no edges hang.
pub(super) fn loosest_edge(seen: &Observation) -> Option<Found> {
    // of each edge the ratio, and the largest slack with its place
    let mut edges = BTreeMap::new();
    for (edge, line) in seen.edges() {
        let (ratio, largest, place) = edges.entry(edge).or_insert((0.0, 0.0, line.place));
        let slack = line.slack();
        *ratio += slack / line.whole;
        if slack > *largest {
            (*largest, *place) = (slack, line.place);
        }
    }
    let mut most = Most::default();
    for (edge, (ratio, _, place)) in edges {
        most.meet(ratio, Site::Catenary(edge), place);
    }
    most.found()
}
