//! Loads of the ply on the grippers over a motion, and the preload of their mounts, for grippers that control a force.
//!
//! Both are those of the model that decides: of the sheet in the steps whose states were kept, of the catenaries in every step,
//! where mounts yield. Between these they go on linearly. With the stiffness k of the mount along an axis, the preload p along
//! it, and the way s that the fabric has slid under the pad, the load of the ply on the gripper is
//!
//! ```text
//! F = −k (p + s) .
//! ```
//!
//! The axes are those of the scene: the lateral stiffness is that along x and y, the axial one that along z.

use super::OutputError;
use crate::result::ResultFile;
use plydrape::draping::record::Mount;
use plydrape::mold::vector::sub;
use plydrape::scene::PadSettings;

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
    /// Along x and y (N/mm); none if rigid.
    pub lateral: Option<f64>,
    /// Along z (N/mm); none if rigid.
    pub axial: Option<f64>,
}

impl Stiffness {
    /// That of mounts that yield along some axis.
    fn of(pad: &PadSettings) -> Option<Self> {
        let [lateral, axial] =
            [pad.lateral_stiffness, pad.axial_stiffness].map(|k| k.map(|k| k * PER_MM));
        (lateral.is_some() || axial.is_some()).then_some(Stiffness { lateral, axial })
    }
}

impl Loads {
    /// Those of a result; none where rigid grippers hold catenaries, whose loads are not recorded.
    ///
    /// # Errors
    /// [`OutputError`] if the states of the sheet cannot be read.
    pub fn of(result: &ResultFile) -> Result<Option<Self>, OutputError> {
        let mounts = Stiffness::of(&result.scene.settings.pad);
        let (times, steps) = match (&result.summary.sheet, &result.sheet_states) {
            (Some(_), Some(_)) => of_sheet(result, mounts.is_some())?,
            (None, _) if mounts.is_some() => of_catenaries(result),
            _ => return Ok(None),
        };
        Ok((!times.is_empty()).then_some(Loads { times, steps, mounts }))
    }

    /// Those at a time (s); none after the last step that was draped.
    pub fn at(&self, t: f64) -> Option<Vec<Load>> {
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
    /// That of a gripper that has let go.
    pub const NONE: Load = Load { force: [0.0; 3], preload: [0.0; 3] };

    /// A share of the way to another.
    fn towards(&self, other: &Load, share: f64) -> Load {
        let mix = |a: [f64; 3], b: [f64; 3]| [0, 1, 2].map(|c| (1.0 - share) * a[c] + share * b[c]);
        Load { force: mix(self.force, other.force), preload: mix(self.preload, other.preload) }
    }
}

/// Times and loads of the states of the sheet; of rigid grippers there is no preload.
fn of_sheet(result: &ResultFile, yields: bool) -> Result<(Vec<f64>, Vec<Vec<Load>>), OutputError> {
    let (mut times, mut steps) = (Vec::new(), Vec::new());
    let Some(kept) = &result.sheet_states else { return Ok((times, steps)) };
    let motion = result.motion()?;
    let mut file = kept.open()?;
    let mut before = None;
    for n in 0..file.states() {
        let Some(state) = file.state(n)? else { continue };
        let step = state.step as usize;
        // after the last step grippers bear the same until they let go
        if let (true, Some(last)) = (before.replace(step) == Some(step), steps.last().cloned()) {
            times.push(state.time);
            steps.push(last);
        }
        // where the robot holds the mounts
        let recorded = result.steps.get(step - 1).map(|step| {
            step.grippers.iter().map(|gripper| gripper.commanded()).collect::<Vec<_>>()
        });
        let held = recorded.or_else(|| motion.as_ref().map(|(motion, _)| motion.at(state.time)));
        let Some(held) = held else { break };
        let pads = state.pad_forces.iter().zip(state.grippers.iter()).zip(&held);
        let load = |((force, pad), held): ((&[f64; 3], &[f64; 3]), &[f64; 3])| Load {
            force: *force,
            preload: if yields { sub(*held, *pad) } else { [0.0; 3] },
        };
        times.push(state.time);
        steps.push(pads.map(load).collect());
    }
    Ok((times, steps))
}

/// Times and loads of the steps of the catenaries, as far as they have mounts.
fn of_catenaries(result: &ResultFile) -> (Vec<f64>, Vec<Vec<Load>>) {
    let one = |gripper: &plydrape::draping::record::Gripper| {
        let Mount { commanded, force, .. } = gripper.mount?;
        Some(Load { force, preload: sub(commanded, gripper.position) })
    };
    let known = result.steps.iter().map_while(|step| {
        Some((step.time, step.grippers.iter().map(one).collect::<Option<Vec<_>>>()?))
    });
    known.unzip()
}

#[cfg(test)]
#[path = "loads_tests.rs"]
mod tests;
