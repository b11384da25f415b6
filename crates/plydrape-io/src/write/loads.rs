//! Loads of the ply on the grippers over a motion, and the preload of their mounts, for grippers that control a force.
//!
//! Both are those of the model that decides, in every step; between these they go on linearly. With the stiffness k of the mount along an
//! axis, the preload p along it, and the way s that the fabric has slid under the pad, the load of the ply on the gripper is
//!
//! ```text
//! F = −k (p + s) .
//! ```
//!
//! The axes are those of the scene: the lateral stiffness is that along x and y, the axial one that along z.

use crate::result::ResultFile;
use plydrape::geometry::vector::sub;
use plydrape::layup::PadSettings;
use plydrape::outcome::{Gripper, Step};
use plydrape::sheet::event::last_release;

/// Newtons a millimeter in a newton a meter.
const PER_MM: f64 = 1e-3;
/// By how much a time may lie beyond the last step and still be at it, as a share of its own.
const ROUNDING: f64 = 1e-9;

/// The loads on all grippers over a motion.
#[derive(Debug, Clone)]
pub(crate) struct Loads {
    /// Times (s) at which they are known, ascending.
    times: Vec<f64>,
    /// The loads at each of them, i running fastest.
    steps: Vec<Vec<Load>>,
    /// The mounts that yield.
    pub mounts: Option<Stiffness>,
}

/// What the ply does to a gripper.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Load {
    /// Force of the ply on it along x, y and z (N).
    pub force: [f64; 3],
    /// How far beyond the expected place of its pad its mount is held (m); zero where mounts are rigid.
    pub preload: [f64; 3],
}

/// How stiff the mounts are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stiffness {
    /// Along x and y (N/mm); `None` if rigid.
    pub lateral: Option<f64>,
    /// Along z (N/mm); `None` if rigid.
    pub axial: Option<f64>,
}

impl Stiffness {
    /// The stiffness of mounts that yield along an axis; `None` if they are rigid.
    fn new(pad: &PadSettings) -> Option<Self> {
        let [lateral, axial] =
            [pad.lateral_stiffness, pad.axial_stiffness].map(|k| k.map(|k| k * PER_MM));
        (lateral.is_some() || axial.is_some()).then_some(Stiffness { lateral, axial })
    }
}

impl Loads {
    /// The loads of a result; `None` without steps.
    pub fn new(result: &ResultFile) -> Option<Self> {
        let mounts = Stiffness::new(&result.scene.settings.pad);
        let mut times: Vec<f64> = result.steps.iter().map(|step| step.time).collect();
        let mut steps: Vec<Vec<Load>> = result.steps.iter().map(step_loads).collect();
        let (end, loads) = times.last().copied().zip(steps.last().cloned())?;
        // after the last step grippers bear the same until they let go
        if let Some(released) = last_release(result.events()).filter(|time| *time > end) {
            times.push(released);
            steps.push(loads);
        }
        Some(Loads { times, steps, mounts })
    }

    /// The loads at a time (s); `None` after the last step that was draped.
    pub fn interpolate(&self, t: f64) -> Option<Vec<Load>> {
        let (after, last) = (self.times.partition_point(|time| *time <= t), self.times.len() - 1);
        if after == 0 {
            return Some(self.steps[0].clone());
        }
        if after > last {
            let end = self.times[last];
            return (t <= end + ROUNDING * end.abs()).then(|| self.steps[last].clone());
        }
        let share = (t - self.times[after - 1]) / (self.times[after] - self.times[after - 1]);
        let pairs = self.steps[after - 1].iter().zip(&self.steps[after]);
        Some(pairs.map(|(a, b)| a.towards(b, share)).collect())
    }
}

impl Load {
    /// The load on a gripper that has let go.
    pub const NONE: Load = Load { force: [0.0; 3], preload: [0.0; 3] };

    /// The load at a share of the way from this one to another.
    fn towards(&self, other: &Load, share: f64) -> Load {
        let mix = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|c| (1.0 - share) * a[c] + share * b[c]);
        Load { force: mix(self.force, other.force), preload: mix(self.preload, other.preload) }
    }
}

/// The loads of a step; of rigid grippers there is no preload.
fn step_loads(step: &Step) -> Vec<Load> {
    let load = |gripper: &Gripper| Load {
        force: gripper.force,
        preload: sub(gripper.commanded, gripper.position),
    };
    step.grippers.iter().map(load).collect()
}

#[cfg(test)]
#[path = "loads_tests.rs"]
mod tests;
