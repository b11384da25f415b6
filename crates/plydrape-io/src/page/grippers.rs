//! The grippers in every step: where they are, how their pads are turned, and what the ply does to them.
//!
//! Places are packed in micrometers, normals in ten-thousandths, and forces in a unit of their own, because a yarn that cannot stretch
//! pulls with thousands of newtons.

use super::Form;
use super::block::Block;
use super::packing::micrometers;
use super::reading::{Reading, readings, used};
use plydrape::measure::Verdict;
use plydrape::outcome::{Gripper, Step};
use serde::Serialize;

/// The grippers over the steps of one model.
#[derive(Serialize)]
pub(super) struct Grippers {
    positions: Block,
    normals: Block,
    /// What the numbers of `forces` count (N).
    force_unit: f64,
    /// Forces of the ply on the grippers.
    forces: Block,
    /// Whether each pad holds the ply, 1 or 0; `None` where all of them always do.
    holds: Option<Block>,
    /// What is measured of each of them.
    readings: Vec<Reading>,
    /// Thousandths of the limits that the loads use along the ply and across it, -1 without a limit; `None` of a model that judges nothing.
    used: Option<Block>,
}

impl Grippers {
    /// The grippers of some steps. `released` says which pads have let go after the last of them, and is empty where none has; `judged` are
    /// the verdicts of a model that decides.
    pub fn new(steps: &[&Step], released: &[bool], judged: Option<&[Verdict]>, form: Form) -> Self {
        let grippers = held(steps, released);

        // a micronewton, or more where the largest force would not fit
        let forces = || grippers.iter().flat_map(|gripper| gripper.force);
        let most = forces().fold(0.0, |most: f64, f| most.max(f.abs()));
        let force_unit = (most / f64::from(i32::MAX)).max(1e-6);

        let block = |components, values| form.block(steps.len(), components, values);
        let normals = grippers.iter().flat_map(Gripper::normal);
        let always = grippers.iter().all(|gripper| gripper.holds);
        Grippers {
            positions: block(3, grippers.iter().flat_map(|g| micrometers(&g.position)).collect()),
            normals: block(3, normals.map(|c| (c * 1e4).round() as i32).collect()),
            force_unit,
            forces: block(3, forces().map(|f| (f / force_unit).round() as i32).collect()),
            holds: (!always)
                .then(|| block(1, grippers.iter().map(|g| i32::from(g.holds)).collect())),
            readings: readings(&grippers, steps.len(), judged.unwrap_or_default(), form),
            used: judged
                .map(|judged| block(2, grippers.iter().flat_map(|g| used(g, judged)).collect())),
        }
    }
}

/// The grippers of all steps, side by side; what has let go carries nothing.
fn held(steps: &[&Step], released: &[bool]) -> Vec<Gripper> {
    let last = steps.len().saturating_sub(1);
    let all = steps.iter().enumerate().flat_map(|(k, step)| {
        step.grippers.iter().enumerate().map(move |(n, gripper)| {
            let gone = k == last && released.get(n) == Some(&true);
            match gripper.holds && !gone {
                true => gripper.clone(),
                false => Gripper { holds: false, force: [0.0; 3], ..gripper.clone() },
            }
        })
    });
    all.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// A pad that has let go after the end carries nothing in the last step, whatever it carried when the motion ended; before it does.
    #[test]
    fn what_has_let_go_carries_nothing() {
        let mut result = sample::draped(2, 2, 3);
        let pull = [3.0, 4.0, -12.0];
        result.steps.iter_mut().flat_map(|step| &mut step.grippers).for_each(|g| g.force = pull);
        let steps: Vec<&Step> = result.steps.iter().collect();
        assert!(held(&steps, &[]).iter().all(|gripper| gripper.holds && gripper.force == pull));
        let grippers = held(&steps, &[false, true, false, false]);
        let gone: Vec<usize> = (0..12).filter(|n| !grippers[*n].holds).collect();
        assert_eq!(gone, [9]);
        assert_eq!((grippers[9].force, grippers[8].force), ([0.0; 3], pull));
        assert!(Grippers::new(&steps, &[], None, Form::FILE).holds.is_none());
        assert!(Grippers::new(&steps, &[true], None, Form::FILE).holds.is_some());
    }
}
