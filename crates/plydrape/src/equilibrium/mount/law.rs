//! What a gripper's mount does to the fabric that its pad holds, eqs. (11a) and (11b) of `docs/theory/equilibrium.md`.
//!
//! Springs along x, y and z pull the pad back to where the robot holds the mount; an axis without stiffness is rigid. Along
//! the ply the pad holds no more than its slip force: beyond it the fabric slides under the pad, and what it has slid
//! stays. That is the law of a spring and a slider in series, taken step by step (elastic and perfectly plastic, with the
//! return of Simo and Hughes 1998, section 1.4).

use crate::equilibrium::Tuning;
use crate::layup::PadSettings;
use crate::ply::Ply;

/// The mounts of all grippers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MountLaw {
    /// Stiffness along x, y and z (N/m); none of a rigid axis.
    stiffness: [Option<f64>; 3],
    /// Largest horizontal force that a pad passes on (N).
    slip_force: Option<f64>,
}

/// A pad that stands on the mold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// Where it stays (m), along the axes that yield.
    pub place: [f64; 3],
    /// Unit normal of the mold there.
    pub normal: [f64; 3],
}

/// What a mount does at one place of its pad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MountReaction {
    /// Force on the fabric (N); 0 along rigid axes.
    pub force: [f64; 3],
    /// How much this force falls as the pad moves (N/m), rows and columns along x, y, z.
    pub stiffness: [[f64; 3]; 3],
    /// How far the fabric has slid under the pad, along x and y (m).
    pub slip: [f64; 2],
}

impl MountLaw {
    /// The mounts of a scene; none if they are rigid and the fabric never slides.
    ///
    /// A slider needs a spring: a rigid mount whose fabric can slide yields by a millionth of a cell before it does.
    #[must_use]
    pub fn new(ply: &Ply, pad: &PadSettings, tuning: &Tuning) -> Option<MountLaw> {
        let PadSettings { lateral_stiffness, axial_stiffness, slip_force, .. } = *pad;
        let cell = ply.cell[0].min(ply.cell[1]);
        let nearly_rigid = slip_force.map(|force| force / (tuning.rigid_yield * cell));
        let lateral = lateral_stiffness.or(nearly_rigid);
        (lateral.is_some() || axial_stiffness.is_some())
            .then_some(MountLaw { stiffness: [lateral, lateral, axial_stiffness], slip_force })
    }

    /// The same mounts with so many times their stiffness.
    pub(super) fn scaled(self, factor: f64) -> MountLaw {
        let stiffness = self.stiffness.map(|stiffness| stiffness.map(|k| factor * k));
        MountLaw { stiffness, ..self }
    }

    /// Whether an axis yields.
    #[must_use]
    pub fn yields(&self, axis: usize) -> bool {
        self.stiffness[axis].is_some()
    }

    /// Velocity of a pad that stands on the mold, while the robot has a velocity (m): rigid axes follow the robot, and a pad
    /// that is led along the mold but yields across it follows the mold.
    #[must_use]
    pub fn way(&self, standing: &Standing, robot: [f64; 3]) -> [f64; 3] {
        let mut out = [0, 1, 2].map(|n| if self.yields(n) { 0.0 } else { robot[n] });
        if self.yields(2) && standing.normal[2] > 0.0 {
            let [x, y, z] = standing.normal;
            out[2] = -(x * out[0] + y * out[1]) / z;
        }
        out
    }

    /// The mount of a pad that is displaced by `offset` (m) from where the robot holds it, and under which the fabric has
    /// slid by `slip` (m) before.
    #[must_use]
    pub fn reaction(&self, offset: [f64; 3], slip: [f64; 2]) -> MountReaction {
        let [lateral, _, axial] = self.stiffness.map(|stiffness| stiffness.unwrap_or(0.0));
        let mut out = MountReaction {
            force: [0.0, 0.0, -axial * offset[2]],
            stiffness: [[lateral, 0.0, 0.0], [0.0, lateral, 0.0], [0.0, 0.0, axial]],
            slip,
        };
        let stretch = [0, 1].map(|n| offset[n] - slip[n]);
        let length = stretch[0].hypot(stretch[1]);
        let most = self.slip_force.unwrap_or(f64::INFINITY);
        if lateral == 0.0 || lateral * length <= most {
            (out.force[0], out.force[1]) = (-lateral * stretch[0], -lateral * stretch[1]);
            return out;
        }
        // it slides until the spring holds the slip force; along the slide the force does not change
        let [x, y] = stretch.map(|c| c / length);
        (out.force[0], out.force[1]) = (-most * x, -most * y);
        let across = most / length;
        out.stiffness[0] = [across * y * y, -across * x * y, 0.0];
        out.stiffness[1] = [-across * x * y, across * x * x, 0.0];
        let slid = length - most / lateral;
        out.slip = [slip[0] + slid * x, slip[1] + slid * y];
        out
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn law(lateral: Option<f64>, axial: Option<f64>, slip_force: Option<f64>) -> MountLaw {
        MountLaw { stiffness: [lateral, lateral, axial], slip_force }
    }

    /// A spring below the slip force, the slip force above it, and a slide that stays: on the way back the spring pulls
    /// from the new place.
    #[test]
    fn a_pad_slides_at_the_slip_force_and_the_slide_stays() {
        let law = law(Some(2e3), Some(5e3), Some(6.0));
        let before = law.reaction([1.2e-3, 1.6e-3, -1e-3], [0.0; 2]);
        assert_eq!((before.force[2], before.slip), (5.0, [0.0; 2]));
        assert!((before.force[0] + 2.4).abs() < 1e-15 && (before.force[1] + 3.2).abs() < 1e-15);
        let slid = law.reaction([3e-3, 4e-3, 0.0], [0.0; 2]);
        assert!((slid.force[0] + 3.6).abs() < 1e-14 && (slid.force[1] + 4.8).abs() < 1e-14);
        assert!((slid.slip[0] - 1.2e-3).abs() < 1e-17 && (slid.slip[1] - 1.6e-3).abs() < 1e-17);
        let back = law.reaction([0.0; 3], slid.slip);
        assert!((back.force[0] - 2.4).abs() < 1e-14 && (back.force[1] - 3.2).abs() < 1e-14);
        assert_eq!(back.slip, slid.slip);
    }

    /// The stiffness is the derivative of the force, sliding or not: central differences.
    #[test]
    fn the_stiffness_is_the_derivative_of_the_force() {
        let law = law(Some(2e3), Some(5e3), Some(6.0));
        for offset in [[1e-3, -5e-4, 2e-3], [4e-3, -3e-3, 2e-3]] {
            let slip = [2e-4, 3e-4];
            let at = law.reaction(offset, slip);
            let h = 1e-7;
            for axis in 0..3 {
                let moved = |by: f64| {
                    let mut offset = offset;
                    offset[axis] += by;
                    law.reaction(offset, slip).force
                };
                let (low, high) = (moved(-h), moved(h));
                for n in 0..3 {
                    let difference = (low[n] - high[n]) / (2.0 * h);
                    assert!(
                        (at.stiffness[n][axis] - difference).abs() < 1e-3,
                        "{offset:?} {n} {axis}"
                    );
                }
            }
        }
    }
}
