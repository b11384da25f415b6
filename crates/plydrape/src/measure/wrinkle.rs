//! Wrinkle height: height of the ruck that the slack of a segment makes on the mold (`ply/ruck.rs`).
//!
//! The limit bounds slack by a height. A ply without rigidity crumples and has no height, so scenes refuse such a limit there.

use super::{Bound, Description, Found, Measure, Most, Observation, Refusal, Scope, Unit};
use crate::layup::Layup;
use crate::ply::{Kind, Ruck};

/// Wrinkle height; see the head of this file.
pub struct Wrinkle;

impl Measure for Wrinkle {
    fn description(&self) -> Description {
        let own =
            Description::of_catenaries("wrinkle", "wrinkle_mm", "wrinkle height", Unit::MILLIMETER);
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::gap("The slack of a segment as the height of the ruck that it makes")
                .such_as(5e-4),
        )
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.mold.is_some() && layup.target.is_some()
    }

    fn refusal(&self, layup: &Layup) -> Option<Refusal> {
        let ply = &layup.ply;
        let edges: &[Kind] =
            if ply.grid.nv != 1 { &[Kind::EdgeU, Kind::EdgeV] } else { &[Kind::EdgeU] };
        let limp = edges.iter().any(|kind| ply.line(*kind).flexural_rigidity <= 0.0);
        limp.then_some(Refusal {
            why: "the slack of a ply without bending rigidity has no height: it crumples",
            remedy: "give a `slack_angle` or a `slack_ratio` instead, or the material its rigidity",
        })
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        largest_ruck(seen, Ruck::height).in_units_of(1e-3)
    }
}

/// The largest of a property of the rucks that the slack of the edges makes; zero without slack.
pub(super) fn largest_ruck(seen: &Observation, property: impl Fn(&Ruck) -> f64) -> Most {
    let (ply, gravity) = (&seen.layup.ply, seen.layup.settings.gravity);
    let lines = ply.lines();
    let mut most = Most::default();
    for (edge, segment) in seen.edges() {
        let line = ply.line(lines.catenary(edge).kind);
        let ruck = Ruck::from_slack(segment.slack(), line.flexural_rigidity, line.mass * gravity);
        most.meet(ruck.as_ref().map_or(0.0, &property), segment.site, segment.place);
    }
    most
}
