//! What a gripper may bear, and how much of that the loads on it use, along the ply and across it.
//!
//! Along the ply counts the whole load in the plane of the pad, across it what draws the ply off the pad; what presses the pad
//! down holds it. The slip force and the holding force of a pad count divided by the safety of the grip, as in the limits
//! `slip` and `holding`.

use crate::result::ResultFile;
use crate::sheet::normal;
use plydrape::geometry::vector::{along, dot, norm};
use plydrape::layup::PadSettings;
use plydrape::measure::{Limits, Name};
use serde::Serialize;

/// What stands for a share of something without a limit.
const UNKNOWN: i32 = -1;

/// What a gripper may bear: loads (N) and tilt.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub(super) struct Allowed {
    /// Along the ply: the least of slip and pull.
    along: Option<f64>,
    /// Off the pad: the least of holding and load.
    across: Option<f64>,
    /// Whole force.
    whole: Option<f64>,
    /// Tilt (°).
    tilt: Option<f64>,
}

impl Allowed {
    /// What the limits say by which a result is judged.
    pub fn new(result: &ResultFile) -> Self {
        let tilt = result.summary.limits.iter().find(|verdict| verdict.name == Name::Tilt);
        let loads = Allowed::loads(&result.scene.settings.pad, &result.scene.limits);
        Allowed { tilt: tilt.map(|verdict| verdict.limit), ..loads }
    }

    /// The loads that pads and limits allow.
    fn loads(pad: &PadSettings, limits: &Limits) -> Self {
        let least = |force: Option<f64>, limit: Option<f64>| {
            let force = force.map(|force| force / limits.grip_safety);
            let least = force.into_iter().chain(limit).reduce(f64::min);
            least.filter(|force| force.is_finite() && *force > 0.0)
        };
        Allowed {
            along: least(pad.slip_force, limits.get(Name::GripperPull)),
            across: least(pad.holding_force, limits.get(Name::GripperLoad)),
            whole: least(None, limits.get(Name::GripperForce)),
            tilt: None,
        }
    }

    /// Thousandths of the allowed load that a force uses along the ply and across it; `quaternion` is the pad's turn.
    pub fn used(&self, force: &[f64; 3], quaternion: &[f64; 4]) -> [i32; 2] {
        let normal = normal(quaternion);
        let up = dot(*force, normal);
        let lateral = norm(along(*force, -up, normal));
        let whole = self.whole.map(|whole| norm(*force) / whole);
        let share = |load: f64, allowed: Option<f64>| {
            let most = allowed.map(|allowed| load / allowed).into_iter().chain(whole);
            most.reduce(f64::max).map_or(UNKNOWN, |share| (share * 1e3).min(1e9).round() as i32)
        };
        [share(lateral, self.along), share((-up).max(0.0), self.across)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pad tilted by 30° under 6 N straight down has 3 N along the ply and 5.196 N off the pad; pressed, it has none of that.
    #[test]
    fn a_load_is_parted_by_the_tilt_of_its_pad() {
        let mut allowed = Allowed { along: Some(4.0), across: Some(10.0), ..Allowed::default() };
        let half = 15_f64.to_radians();
        let tilted = [half.sin(), 0.0, 0.0, half.cos()];
        assert_eq!(allowed.used(&[0.0, 0.0, -6.0], &tilted), [750, 520]);
        assert_eq!(allowed.used(&[0.0, 0.0, 6.0], &tilted), [750, 0]);
        allowed.whole = Some(5.0);
        assert_eq!(allowed.used(&[0.0, 0.0, 6.0], &tilted), [1200, 1200]);
        let free = Allowed::default();
        assert_eq!(free.used(&[0.0, 0.0, -6.0], &tilted), [UNKNOWN, UNKNOWN]);
    }

    /// The safety of the grip is in it, and the smaller of two limits counts.
    #[test]
    fn the_smallest_allowed_load_counts() {
        let scene = crate::sample::draped(2, 2, 2).scene;
        let (mut pad, mut limits) = (scene.settings.pad, scene.limits);
        limits.set(Name::GripperLoad, Some(10.0));
        assert_eq!(
            Allowed::loads(&pad, &limits),
            Allowed { across: Some(10.0), ..Allowed::default() }
        );
        pad.slip_force = Some(6.0);
        pad.holding_force = Some(9.0);
        limits.grip_safety = 1.5;
        limits.set(Name::GripperPull, Some(5.0));
        limits.set(Name::GripperForce, Some(8.0));
        let expected =
            Allowed { along: Some(4.0), across: Some(6.0), whole: Some(8.0), tilt: None };
        assert_eq!(Allowed::loads(&pad, &limits), expected);
    }
}
