//! What is measured of every gripper, beside its limit, and how much of the limits its loads use.
//!
//! A reading is a measure of which the worst gripper is judged, here of each of them: the words, the unit and the limit are those of the
//! measure. Values are packed in ten-thousandths of the unit.

use super::Form;
use super::block::Block;
use crate::result::sheet::normal;
use plydrape::geometry::vector::{along, dot, norm};
use plydrape::measure::{Name, Verdict};
use plydrape::outcome::Gripper;
use serde::Serialize;

/// What stands for a share of something without a limit.
const UNKNOWN: i32 = -1;
/// Packed numbers in one of the unit.
const FINE: f64 = 1e4;

/// The measures of a single gripper, in the order in which the page tells them, and which of both loads on a pad they bound.
const MEASURES: [(Name, Bounds); 7] = [
    (Name::Tilt, Bounds::Neither),
    (Name::GripperLoad, Bounds::Both),
    (Name::GripperPull, Bounds::Both),
    (Name::GripperForce, Bounds::Both),
    (Name::Slip, Bounds::Along),
    (Name::Holding, Bounds::Across),
    (Name::SlipLength, Bounds::Neither),
];

/// Which of the loads on a pad a measure bounds: the one along the ply, or the one across it. Load against gravity and horizontal pull of a
/// tilted pad are made of both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Bounds {
    Along,
    Across,
    Both,
    Neither,
}

/// A measure of every gripper in every step.
#[derive(Serialize)]
pub(super) struct Reading {
    label: &'static str,
    unit: &'static str,
    /// The most that is allowed, if the ply is judged by it.
    limit: Option<f64>,
    /// Values in one of the unit.
    fine: f64,
    values: Block,
}

/// The value of a measure at a gripper, in the unit of the measure.
fn value(name: Name, gripper: &Gripper) -> f64 {
    let normal = normal(&gripper.quaternion);
    let up = dot(gripper.force, normal);
    match name {
        Name::Tilt => gripper.tilt_deg,
        Name::GripperLoad => gripper.load(),
        Name::GripperPull => gripper.pull(),
        Name::GripperForce => norm(gripper.force),
        Name::Slip => norm(along(gripper.force, -up, normal)),
        // what presses the pad down holds the ply
        Name::Holding => (-up).max(0.0),
        Name::SlipLength => gripper.slide_mm,
        _ => 0.0,
    }
}

/// The limit of a measure among verdicts.
fn limit(name: Name, judged: &[Verdict]) -> Option<f64> {
    judged.iter().find(|verdict| verdict.name == name).map(|verdict| verdict.limit)
}

/// The readings of grippers over this many steps, those of a step side by side, but what is zero throughout and has no limit; `judged` are the
/// verdicts of a model that decides.
pub(super) fn readings(
    grippers: &[Gripper],
    steps: usize,
    judged: &[Verdict],
    form: Form,
) -> Vec<Reading> {
    let reading = |(name, _): (Name, Bounds)| {
        let limit = limit(name, judged);
        let values: Vec<i32> =
            grippers.iter().map(|g| (value(name, g) * FINE).round() as i32).collect();
        (limit.is_some() || values.iter().any(|value| *value != 0)).then(|| Reading {
            label: name.measure().label(),
            unit: name.measure().unit().shown,
            limit,
            fine: FINE,
            values: form.block(steps, 1, values),
        })
    };
    MEASURES.into_iter().filter_map(reading).collect()
}

/// Thousandths of the limits that the loads on a gripper use, along the ply and across it; -1 without a limit.
pub(super) fn used(gripper: &Gripper, judged: &[Verdict]) -> [i32; 2] {
    [Bounds::Along, Bounds::Across].map(|load| {
        let bounding = MEASURES.iter().filter(|(_, bounds)| [load, Bounds::Both].contains(bounds));
        let shares = bounding.filter_map(|(name, _)| {
            let limit = limit(*name, judged).filter(|limit| *limit > 0.0)?;
            Some(value(*name, gripper).max(0.0) / limit)
        });
        let most = shares.reduce(f64::max);
        most.map_or(UNKNOWN, |share| (share * 1e3).min(1e9).round() as i32)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use plydrape::measure::Worst;

    /// A pad tilted by 30° under a force.
    fn tilted(force: [f64; 3]) -> Gripper {
        let half = 15_f64.to_radians();
        let mut gripper = crate::sample::draped(2, 2, 2).steps[0].grippers[0].clone();
        (gripper.quaternion, gripper.force) = ([half.sin(), 0.0, 0.0, half.cos()], force);
        gripper
    }

    fn judged(limits: &[(Name, f64)]) -> Vec<Verdict> {
        let worst = || Worst { value: 0.0, at: String::new(), place: None };
        limits.iter().map(|(name, limit)| Verdict::new(*name, worst(), *limit, None)).collect()
    }

    /// A pad tilted by 30° under 6 N straight down has 3 N along the ply and 5.196 N off the pad; pressed, it has none of that.
    #[test]
    fn a_load_is_parted_by_the_tilt_of_its_pad() {
        let limits = judged(&[(Name::Slip, 4.0), (Name::Holding, 10.0)]);
        assert_eq!(used(&tilted([0.0, 0.0, -6.0]), &limits), [750, 520]);
        assert_eq!(used(&tilted([0.0, 0.0, 6.0]), &limits), [750, 0]);
        assert_eq!(used(&tilted([0.0, 0.0, -6.0]), &[]), [UNKNOWN, UNKNOWN]);
    }

    /// What the verdict judges shows: of 3 N level and 6 N down on a tilted pad it is the load of 6 N, which is beyond 5 N, for both loads on the
    /// pad; where the whole force of 6.708 N must not exceed 5 N, it is that.
    #[test]
    fn the_limit_that_is_used_most_counts() {
        let gripper = tilted([3.0, 0.0, -6.0]);
        let mut limits = judged(&[(Name::GripperLoad, 5.0), (Name::GripperPull, 4.0)]);
        assert_eq!(used(&gripper, &limits), [1200, 1200]);
        limits.extend(judged(&[(Name::GripperForce, 5.0)]));
        assert_eq!(used(&gripper, &limits), [1342, 1342]);
    }

    /// What is measured has the words of its measure; a slide is shown only where there is one, or a limit.
    #[test]
    fn readings_have_the_words_of_their_measures() {
        let grippers = [tilted([0.0, 0.0, -6.0])];
        let labels = |judged: &[Verdict]| -> Vec<&str> {
            readings(&grippers, 1, judged, Form::FILE).iter().map(|r| r.label).collect()
        };
        let slide = Name::SlipLength.measure().label();
        assert!(
            !labels(&[]).contains(&slide) && labels(&[]).contains(&Name::Slip.measure().label())
        );
        assert!(labels(&judged(&[(Name::SlipLength, 1.0)])).contains(&slide));
    }
}
