//! The grippers in every step: where they are, how their pads are turned, and what the ply does to them.
//!
//! Places are packed in micrometers, normals in ten-thousandths, tilts in hundredths of a degree, and forces in a unit of their own,
//! because a yarn that cannot stretch pulls with thousands of newtons.

use super::Form;
use super::block::Block;
use super::margin::Allowed;
use super::packing::{hundredths, micrometers};
use plydrape::outcome::Step;
use serde::Serialize;

/// The grippers over the steps of one model.
#[derive(Serialize)]
pub(super) struct Grippers {
    positions: Block,
    normals: Block,
    tilts: Block,
    /// What the numbers of `forces` count (N).
    force_unit: f64,
    /// Forces of the ply on the grippers.
    forces: Block,
    /// Whether each pad holds the ply, 1 or 0; `None` where all of them always do.
    holds: Option<Block>,
    /// Thousandths of the allowed loads that are used along the ply and across it; -1 without a limit.
    used: Block,
}

impl Grippers {
    /// The grippers of some steps; `released` says which pads have let go after the last of them, and is empty where none has.
    pub fn new(steps: &[&Step], released: &[bool], allowed: Allowed, form: Form) -> Self {
        let last = steps.len().saturating_sub(1);
        let all = steps.iter().enumerate().flat_map(|(k, step)| {
            let gone = move |n: usize| k == last && released.get(n) == Some(&true);
            step.grippers.iter().enumerate().map(move |(n, g)| (g, g.holds && !gone(n)))
        });
        let force = |(gripper, holds): (&plydrape::outcome::Gripper, bool)| match holds {
            true => gripper.force,
            false => [0.0; 3],
        };

        // a micronewton, or more where the largest force would not fit
        let most = all.clone().flat_map(force).fold(0.0, |most: f64, f| most.max(f.abs()));
        let force_unit = (most / f64::from(i32::MAX)).max(1e-6);

        let block =
            |components: usize, values: Vec<i32>| form.block(steps.len(), components, values);
        let always = all.clone().all(|(_, holds)| holds);
        Grippers {
            positions: block(3, all.clone().flat_map(|(g, _)| micrometers(&g.position)).collect()),
            normals: block(
                3,
                all.clone()
                    .flat_map(|(g, _)| g.normal().map(|c| (c * 1e4).round() as i32))
                    .collect(),
            ),
            tilts: block(1, all.clone().map(|(g, _)| hundredths(g.tilt_deg)).collect()),
            force_unit,
            forces: block(
                3,
                all.clone()
                    .flat_map(force)
                    .map(|component| (component / force_unit).round() as i32)
                    .collect(),
            ),
            holds: (!always)
                .then(|| block(1, all.clone().map(|(_, holds)| i32::from(holds)).collect())),
            used: block(
                2,
                all.flat_map(|(g, holds)| allowed.used(&force((g, holds)), &g.quaternion))
                    .collect(),
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// A pad that has let go after the end holds nothing in the last step, whatever it held when the motion ended; before it does.
    #[test]
    fn what_has_let_go_carries_nothing() {
        let mut result = sample::draped(2, 2, 3);
        let pull = [3.0, 4.0, -12.0];
        result.steps.iter_mut().flat_map(|step| &mut step.grippers).for_each(|g| g.force = pull);
        let steps: Vec<&Step> = result.steps.iter().collect();
        let form = Form { packed: false, ..Form::FILE };
        let json = |released: &[bool]| {
            serde_json::to_value(Grippers::new(&steps, released, Allowed::default(), form)).unwrap()
        };
        assert!(json(&[])["holds"].is_null());
        let grippers = json(&[false, true, false, false]);
        let holds: Vec<i64> =
            grippers["holds"]["data"].as_array().unwrap().iter().flat_map(|v| v.as_i64()).collect();
        assert_eq!(holds, [1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1]);
        let unit = grippers["force_unit"].as_f64().unwrap();
        let force = |n: usize| {
            [0, 1, 2].map(|c| grippers["forces"]["data"][3 * n + c].as_f64().unwrap() * unit)
        };
        assert_eq!(force(9), [0.0; 3]);
        assert!((0..3).all(|c| (force(8)[c] - pull[c]).abs() <= unit));
    }
}
