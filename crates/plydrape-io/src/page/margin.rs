//! How much of what a gripper holds the loads on it use, along the ply and across it.
//!
//! Along the ply counts the whole load in the plane of the pad, across it what draws the ply off the pad; what presses the pad
//! down holds it. The slip force and the holding force of a pad count divided by the safety of the grip, as in the limits
//! `slip` and `holding`.

use crate::sheet::normal;
use plydrape::scene::{Limits, Settings};
use serde::Serialize;

/// What stands for a share of something without a limit.
const UNKNOWN: i32 = -1;

/// The largest loads that a gripper may have (N).
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Allowed {
    /// Along the ply: the least of slip and pull.
    along: Option<f64>,
    /// Off the pad: the least of holding and load.
    across: Option<f64>,
    /// Whole force.
    whole: Option<f64>,
}

impl Allowed {
    /// What the limits of a scene say.
    pub fn of(settings: &Settings, limits: &Limits) -> Self {
        let least = |force: Option<f64>, limit: Option<f64>| {
            let force = force.map(|force| force / limits.grip_safety);
            let least = force.into_iter().chain(limit).reduce(f64::min);
            least.filter(|force| force.is_finite() && *force > 0.0)
        };
        Allowed {
            along: least(settings.pad.slip_force, limits.gripper_pull),
            across: least(settings.pad.holding_force, Some(limits.gripper_load)),
            whole: least(None, limits.gripper_force),
        }
    }

    /// Thousandths of the allowed load that one uses along the ply and across it; `quaternion` is the pad's turn.
    pub fn used(&self, force: &[f64; 3], quaternion: &[f64; 4]) -> [i32; 2] {
        let normal = normal(quaternion);
        let up: f64 = (0..3).map(|c| force[c] * normal[c]).sum();
        let size = |vector: [f64; 3]| vector.iter().map(|c| c * c).sum::<f64>().sqrt();
        let along = size([0, 1, 2].map(|c| force[c] - up * normal[c]));
        let whole = self.whole.map(|whole| size(*force) / whole);
        let share = |load: f64, allowed: Option<f64>| {
            let most = allowed.map(|allowed| load / allowed).into_iter().chain(whole);
            most.reduce(f64::max).map_or(UNKNOWN, |share| (share * 1e3).min(1e9).round() as i32)
        };
        [share(along, self.along), share((-up).max(0.0), self.across)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pad tilted by 30° under 6 N straight down has 3 N along the ply and 5.196 N off the pad; pressed, it has none of that.
    #[test]
    fn a_load_is_parted_by_the_tilt_of_its_pad() {
        let mut allowed = Allowed { along: Some(4.0), across: Some(10.0), whole: None };
        let half = 15_f64.to_radians();
        let tilted = [half.sin(), 0.0, 0.0, half.cos()];
        assert_eq!(allowed.used(&[0.0, 0.0, -6.0], &tilted), [750, 520]);
        assert_eq!(allowed.used(&[0.0, 0.0, 6.0], &tilted), [750, 0]);
        allowed.whole = Some(5.0);
        assert_eq!(allowed.used(&[0.0, 0.0, 6.0], &tilted), [1200, 1200]);
        let free = Allowed { along: None, across: None, whole: None };
        assert_eq!(free.used(&[0.0, 0.0, -6.0], &tilted), [UNKNOWN, UNKNOWN]);
    }

    /// The safety of the grip is in it, and the smaller of two limits counts.
    #[test]
    fn the_smallest_allowed_load_counts() {
        let scene = crate::sample::draped(2, 2, 2).scene;
        let (mut settings, mut limits) = (scene.settings, scene.limits);
        let of = |settings: &Settings, limits: &Limits| Allowed::of(settings, limits);
        assert_eq!(
            of(&settings, &limits),
            Allowed { along: None, across: Some(10.0), whole: None }
        );
        settings.pad.slip_force = Some(6.0);
        settings.pad.holding_force = Some(9.0);
        limits.gripper_pull = Some(5.0);
        limits.gripper_force = Some(8.0);
        let expected = Allowed { along: Some(4.0), across: Some(6.0), whole: Some(8.0) };
        assert_eq!(of(&settings, &limits), expected);
    }
}
