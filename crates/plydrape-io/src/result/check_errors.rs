//! What is impossible in what a result that was read says of drapes with errors.

use super::ResultFile;
use plydrape::errors::Errors;
use plydrape::outcome::{RateTolerance, SampleVerdict, Tolerance};
use plydrape::scene::World;

/// Confidences of one count by two machines differ by less.
const ROUNDING: f64 = 1e-9;

/// What is impossible in the world and the sample of a result and in what it tolerates.
pub(super) fn fault(result: &ResultFile) -> Option<String> {
    let summary = &result.summary;
    if summary.world != World::new(&result.scene.settings.pad, summary.sample.is_some()) {
        return Some(format!("its world is {:?}, and not that of its scene", summary.world));
    }
    let nodes = summary.sheet.as_ref().map_or(0, |sheet| sheet.nodes);
    let sample = summary.sample.as_ref().and_then(|sample| sample_fault(sample, nodes, result));
    sample
        .or_else(|| summary.tolerance.as_ref().and_then(tolerance_fault))
        .or_else(|| summary.rate_tolerance.as_ref().and_then(rate_tolerance_fault))
}

fn sample_fault(sample: &SampleVerdict, nodes: usize, result: &ResultFile) -> Option<String> {
    let SampleVerdict { errors, cells, needed, .. } = sample;
    if !(1..=errors.samples).contains(&cells.len()) || result.scene.errors != Some(*errors) {
        return Some(format!(
            "its sample of {} cells does not have the scene's errors",
            cells.len()
        ));
    }
    if !is_share(errors) || *needed != errors.needed(errors.samples) {
        return Some(format!("its sample needs {needed} of {} cells", errors.samples));
    }
    // each count of cells must leave the verdict open, and the last one decide it
    let mut kept = 0;
    let decided = (1..).zip(cells).find_map(|(count, cell)| {
        kept += usize::from(cell.accepted);
        Some((count, errors.decided(kept, count)?))
    });
    if decided != Some((cells.len(), sample.ok)) {
        let [kept, count] = [sample.accepted(), cells.len()];
        return Some(format!(
            "{kept} of {count} cells of its sample are accepted, {needed} needed"
        ));
    }
    let confidence = errors.confidence(kept, cells.len(), sample.ok);
    if (sample.confidence - confidence).abs() > ROUNDING {
        return Some(format!("its sample has a confidence of {}", sample.confidence));
    }
    if ![0, nodes].contains(&sample.spread_mm.len()) {
        return Some(format!(
            "the heights of its sample are {} of {nodes}",
            sample.spread_mm.len()
        ));
    }
    let mut named = sample.limits.iter().filter_map(|verdict| verdict.step);
    let steps = result.summary.steps_planned;
    let step = named.find(|step| !(1..=steps).contains(step))?;
    Some(format!("its sample names step {step} of {steps}"))
}

fn is_share(errors: &Errors) -> bool {
    errors.share > 0.0 && errors.share <= 1.0
}

fn rate_tolerance_fault(tolerance: &RateTolerance) -> Option<String> {
    let least = RateTolerance::MOST.recip();
    let speed = tolerance.speed.filter(|speed| !(least..=RateTolerance::MOST).contains(speed))?;
    Some(format!("it tolerates {speed} times its speed"))
}

fn tolerance_fault(tolerance: &Tolerance) -> Option<String> {
    let Tolerance { gripper_mm, shear, mass, .. } = tolerance;
    if *gripper_mm < 0.0 {
        return Some(format!("it tolerates errors of {gripper_mm} mm"));
    }
    let ranges = [("mass", Some(mass)), ("shear stiffness", shear.as_ref())];
    ranges.into_iter().find_map(|(name, range)| {
        let [least, most] = range?;
        let is_sound = *least > 0.0 && *least <= 1.0 && *most >= 1.0;
        (!is_sound).then(|| format!("it tolerates {least} to {most} times its {name}"))
    })
}
