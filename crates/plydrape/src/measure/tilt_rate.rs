//! Tilt rate: how fast the ply's normal at a gripper turns.
//!
//! Orientations turn evenly between two steps, so over a step the rate is that of the written motion. A landing takes place at once in the
//! model, and a gripper turns with it: over ever shorter steps that would be ever faster. So the rate is taken over a hundredth of the motion at
//! least, which is about a step of a plan. Pads without joints turn with the frame alone, whose rate has a limit of its own.

use super::observation::rate_window;
use super::{
    Bound, DEGREE, Description, Found, Measure, Most, Observation, Practice, Scope, TUNING, Unit,
    Worth,
};
use crate::geometry::rotation::normal;
use crate::geometry::vector::{cross, dot, norm};
use crate::layup::Layup;
use crate::state::{GripperState, Site};

/// Tilt rate; see the head of this file.
pub struct TiltRate;

impl Measure for TiltRate {
    fn description(&self) -> Description {
        let own =
            Description::new("tilt_rate", "tilt_rate_deg_s", "tilt rate", Unit::DEGREE_PER_SECOND);
        Description { scope: Scope::Time, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::within(
                "Angular rate of a gripper's ball joint",
                [1e-6, 1e4],
                "a gripper's joint",
            )
            .found(Practice::TURN)
            .usually(90.0 * DEGREE, "our assumption of a passive joint, from no data sheet"),
        )
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.tilts()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        if !seen.layup.tilts() {
            return None;
        }
        let earlier = seen.past.into_iter().flat_map(|past| past.turned());
        let orientation = |turned: &&[[f64; 4]], n: usize| turned[n];
        fastest(&seen.state.grippers, seen.state.time, earlier, orientation, seen.duration())
    }
}

/// The gripper whose ply turns fastest (°/s) at a time (s), of those that hold it. `earlier` are the times (s) of the steps before, the last
/// one at the end, with what has the `orientation` of each gripper in them; `duration` (s) is that of the whole motion.
pub(crate) fn fastest<T>(
    grippers: &[GripperState],
    time: f64,
    earlier: impl DoubleEndedIterator<Item = (f64, T)> + Clone,
    orientation: impl Fn(&T, usize) -> [f64; 4],
    duration: f64,
) -> Option<Found> {
    // the last step that is a window before this one, else the first
    let window = rate_window(duration);
    let steps = earlier.map(|(then, turned)| (time - then, turned));
    let first = steps.clone().next();
    let long = window * (1.0 - TUNING.limit_rounding);
    let since = steps.rev().find(|(ago, _)| *ago >= long).or(first);

    let mut most = Most::default();
    for (n, gripper) in grippers.iter().enumerate().filter(|(_, gripper)| gripper.holds) {
        let rate = since.as_ref().map_or(0.0, |(ago, before)| {
            turn(orientation(before, n), gripper.quaternion) / ago.max(window)
        });
        most.meet(rate.to_degrees(), Site::Gripper(n), gripper.position);
    }
    most.found()
}

/// The angle (rad) by which the normal turns from one orientation to another.
pub(crate) fn turn(from: [f64; 4], to: [f64; 4]) -> f64 {
    let [a, b] = [from, to].map(normal);
    // exact for small angles, where the cosine alone is not
    norm(cross(a, b)).atan2(dot(a, b))
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::super::{Limits, Name, Past};
    use super::*;
    use crate::geometry::rotation::oriented;

    /// A gripper that turns by 2° in each of ten steps of 0.1 s turns at 20 °/s; a landing that turns it by 5° in a thousandth of the motion
    /// is taken over a hundredth of it, and so are all steps of that time together.
    #[test]
    fn a_rate_is_taken_over_a_hundredth_of_the_motion_at_least() {
        let mut layup = sample::layup();
        layup.motion.times = vec![0.0, 1.0];
        let limits = Limits::usual(&layup);
        let rate = |angles: &[(f64, f64)]| {
            let mut past = None;
            let mut found = None;
            for (time, angle) in angles {
                let mut state = sample::state(&layup);
                state.time = *time;
                let (s, c) = angle.to_radians().sin_cos();
                state.grippers[2].quaternion = oriented([s, 0.0, c], [c, 0.0, -s]);
                let (layup, limits) = (&layup, &limits);
                let seen = Observation { layup, limits, state: &state, past: past.as_ref() };
                found = Name::TiltRate.measure().evaluate(&seen);
                past = Some(Past::after(&state, past, 1.0));
            }
            found.unwrap().value
        };
        let even: Vec<_> = (0..10).map(|n| (0.1 * f64::from(n), 2.0 * f64::from(n))).collect();
        assert!((rate(&even) - 20.0).abs() < 1e-9);
        assert!((rate(&[(0.0, 0.0), (0.001, 5.0)]) - 500.0).abs() < 1e-9);
        assert!((rate(&[(0.0, 0.0), (0.009, 1.0), (0.01, 5.0)]) - 500.0).abs() < 1e-9);
        assert_eq!(rate(&[(0.0, 0.0)]), 0.0);
    }
}
