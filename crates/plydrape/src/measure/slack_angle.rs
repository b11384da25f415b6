//! Slack angle: the slack ratio of an edge as an angle of its fibers.
//!
//! A line that is longer than its chord by the share ε and lies in waves `A sin kx` of small slope has ε = A²k²/4. Its
//! steepest angle is Ak = 2√ε, whatever the number of waves. So the slack of an edge, if it is spread over the edge, has this angle; gathered in one
//! ruck it is steeper ([`super::Name::WrinkleAngle`]).

use super::slack_ratio::loosest_edge;
use super::{Bound, DEGREE, Description, Found, Measure, Observation, Practice, Scope, Unit};
use crate::layup::Layup;

/// Slack angle; see the head of this file.
pub struct SlackAngle;

impl Measure for SlackAngle {
    fn description(&self) -> Description {
        let own = Description::of_catenaries(
            "slack_angle",
            "slack_angle_deg",
            "slack as fiber angle",
            Unit::DEGREE,
        );
        Description { scope: Scope::End, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        let about = "Slack as a fiber angle, 2√ε of the share ε; it sets `slack_ratio` where that is not given";
        Some(Bound::angle(about).found(Practice::LEAN).such_as(2.6 * DEGREE))
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.mold.is_some() && layup.target.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let found = loosest_edge(seen)?;
        Some(Found { value: angle_of_slack(found.value).to_degrees(), ..found })
    }
}

/// The fiber angle 2√ε (rad) of a slack ratio ε.
#[must_use]
pub fn angle_of_slack(ratio: f64) -> f64 {
    2.0 * ratio.sqrt()
}

/// The slack ratio ε of a fiber angle 2√ε (rad).
#[must_use]
pub fn slack_of_angle(angle: f64) -> f64 {
    0.25 * angle * angle
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The length of a sine wave and its steepest angle, by sums over its points: what differs is of the next order, ε.
    #[test]
    fn slack_spread_in_sine_waves_is_as_steep_as_its_slack_angle() {
        for (amplitude, waves) in [(1e-3, 1.0), (1e-3, 3.0), (4e-3, 2.0)] {
            let wave_number = 2.0 * std::f64::consts::PI * waves;
            let count = 60_000;
            let z = |n: usize| amplitude * (wave_number * n as f64 / count as f64).sin();
            let run = 1.0 / count as f64;
            let length: f64 = (0..count).map(|n| run.hypot(z(n + 1) - z(n))).sum();
            let steepest = (0..count).map(|n| ((z(n + 1) - z(n)) / run).atan()).fold(0.0, f64::max);
            let ratio = (length - 1.0) / length;
            let angle = angle_of_slack(ratio);
            assert!((angle / steepest - 1.0).abs() < 2.0 * ratio + 1e-5, "{angle} {steepest}");
            assert!((slack_of_angle(angle) / ratio - 1.0).abs() < 1e-14);
        }
    }

    /// 0.05 % of slack, the limit unless a scene sets another, are 2.6°.
    #[test]
    fn the_usual_slack_is_a_fiber_angle_of_two_point_six_degrees() {
        assert!((angle_of_slack(5e-4).to_degrees() - 2.562).abs() < 1e-3);
        assert_eq!(angle_of_slack(0.0), 0.0);
        assert!(angle_of_slack(f64::NAN).is_nan());
    }
}
