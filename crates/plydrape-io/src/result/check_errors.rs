//! What is impossible in what a result that was read says of drapes with errors.

use super::ResultFile;
use plydrape::errors::Errors;
use plydrape::outcome::{SampleVerdict, Stands};

/// What is impossible in the sample and in the errors that a result stands.
pub(super) fn fault(result: &ResultFile) -> Option<String> {
    let summary = &result.summary;
    let nodes = summary.sheet.as_ref().map_or(0, |sheet| sheet.nodes);
    let sample = summary.sample.as_ref().and_then(|sample| of_sample(sample, nodes, result));
    sample.or_else(|| summary.stands.as_ref().and_then(of_stands))
}

fn of_sample(sample: &SampleVerdict, nodes: usize, result: &ResultFile) -> Option<String> {
    let (cells, needed) = (sample.cells.len(), sample.needed);
    if cells == 0 || cells != sample.errors.samples || result.scene.errors != Some(sample.errors) {
        return Some(format!("its sample of {cells} cells is none of the scene's errors"));
    }
    if !is_share(&sample.errors) || needed != sample.errors.needed(cells) {
        return Some(format!("its sample needs {needed} of {cells} cells"));
    }
    if sample.ok != (sample.accepted() >= needed) {
        return Some(format!("{} of {needed} cells of its sample are accepted", sample.accepted()));
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

fn of_stands(stands: &Stands) -> Option<String> {
    (stands.factor < 0.0).then(|| format!("it tolerates {} times its errors", stands.factor))
}
