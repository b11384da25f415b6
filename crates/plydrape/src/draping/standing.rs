//! Pads on mounts that yield, and the mold: where they come to stand on it, and when they are lifted off.
//!
//! A pad is not pushed into the mold: the mold carries what presses it down, and infinite friction holds it where it
//! touched, along the axes that yield; rigid axes follow the robot. A pad whose mount yields across the ply touches where
//! its balance would be below the mold. One whose mount does not touches where the robot brings it to the mold, within
//! the contact tolerance. And a pad touches where an edge beside it has come to lie up to it. It is lifted off where the mold would
//! have to pull it, or where the robot lifts a rigid axis off the mold, unless an edge lies beside it: what is in contact
//! stays.

use super::spans::Point;
use super::tuning::TUNING;
use crate::equilibrium::{MountLaw, MountedSolver, Standing};
use crate::geometry::vector::dot;
use crate::mold::Mold;
use crate::ply::{ContactSegment, Lines};
use std::sync::Arc;

/// What the pads of a step depend on.
pub struct Ground<'a> {
    /// The mold.
    pub mold: &'a Mold,
    /// Contact tolerance (m).
    pub tolerance: f64,
    /// The lines of the ply.
    pub lines: Arc<Lines>,
    /// Contact segment of each catenary.
    pub contacts: &'a [Option<ContactSegment>],
}

impl Ground<'_> {
    /// Whether an edge beside each gripper lies up to it.
    fn lying(&self) -> Vec<bool> {
        let mut out = vec![false; self.lines.grippers()];
        for (n, contact) in self.contacts.iter().enumerate().take(self.lines.edges()) {
            let Some(contact) = contact else { continue };
            for (end, gripper) in self.lines.ends(n).into_iter().enumerate() {
                out[gripper] |= contact.lying[end];
            }
        }
        out
    }

    /// Depth of a pad below the mold (m), negative above it; none beside its open boundary.
    fn depth(&self, pad: Point) -> Option<f64> {
        let closest = self.mold.closest_point(pad);
        (!closest.beyond).then_some(-closest.distance)
    }

    /// Where a pad stands: at the closest point of the mold, or straight above or below where its mount does not yield along
    /// the ply.
    fn place(&self, law: &MountLaw, pad: Point) -> Standing {
        let mut place = pad;
        for _ in 0..TUNING.pad_rounds {
            let closest = self.mold.closest_point(place);
            let resolved = TUNING.penetration * TUNING.penetration * self.tolerance;
            if !law.yields(2) || closest.distance.abs() <= resolved {
                break;
            }
            if law.yields(0) {
                place = closest.point;
                break;
            }
            place[2] -= closest.distance / closest.normal[2].max(TUNING.upright_pad);
        }
        Standing { place, normal: self.mold.normal(place) }
    }

    /// Leads pads that stand and cannot yield along the ply over the mold, with the robot at `commanded` (m).
    pub fn lead(&self, mounts: &mut MountedSolver, commanded: &[Point]) {
        if mounts.law().yields(0) {
            return;
        }
        let law = *mounts.law();
        for (n, place) in commanded.iter().enumerate() {
            if let Some(standing) = mounts.standing()[n] {
                let pad = [place[0], place[1], standing.place[2]];
                mounts.stand(n, Some(self.place(&law, pad)));
            }
        }
    }

    /// Whether a pad in the air is deeper below the mold than the tolerance, so that a step is to be cut.
    pub fn is_deep(&self, mounts: &MountedSolver) -> bool {
        mounts.law().yields(2)
            && (mounts.pads().iter().zip(mounts.standing())).any(|(pad, standing)| {
                standing.is_none() && self.depth(*pad) > Some(self.tolerance)
            })
    }

    /// Lifts off the pads that the mold would have to pull; whether there are any.
    pub fn lift(&self, mounts: &mut MountedSolver) -> bool {
        let lying = self.lying();
        let mut changed = false;
        for n in 0..lying.len() {
            let Some(Standing { normal, .. }) = mounts.standing()[n] else { continue };
            let lifted = if mounts.law().yields(2) {
                let pull = -dot(mounts.mold_force(n), normal);
                pull > TUNING.lifting_force * mounts.largest_force()
            } else {
                self.depth(mounts.pads()[n]).is_none_or(|depth| -depth > self.tolerance)
            };
            if lifted && !lying[n] {
                mounts.stand(n, None);
                changed = true;
            }
        }
        changed
    }

    /// Puts on the mold the pads that have come to it; whether there are any.
    pub fn land(&self, mounts: &mut MountedSolver) -> bool {
        let (lying, law) = (self.lying(), *mounts.law());
        let mut changed = false;
        for n in 0..lying.len() {
            let pad = mounts.pads()[n];
            let least =
                if law.yields(2) { TUNING.penetration * self.tolerance } else { -self.tolerance };
            let touches = self.depth(pad).is_some_and(|depth| depth > least);
            if mounts.standing()[n].is_none() && (touches || lying[n]) {
                mounts.stand(n, Some(self.place(&law, pad)));
                changed = true;
            }
        }
        changed
    }
}
