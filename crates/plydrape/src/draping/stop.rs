//! Where a drape ends because an edge is stretched more than any ply can bear, and what would help.

use super::record::Step;
use super::tuning::TUNING;
use crate::measure::{Name, State};
use crate::scene::Scene;

/// Whether an edge of a step is stretched beyond what any ply bears.
pub fn breaks(state: &State) -> bool {
    let worst = Name::Overstretch.measure().evaluate(state);
    worst.is_some_and(|worst| is_broken(worst.value))
}

/// NaN counts as broken, too.
fn is_broken(stretch: f64) -> bool {
    stretch.is_nan() || stretch > TUNING.breaking_stretch
}

/// Why a drape ends with its last step, and what would help; none if it need not end.
pub fn reason(scene: &Scene, steps: &[Step]) -> Option<String> {
    let last = steps.last()?;
    let worst = last.measures.get(Name::Overstretch).filter(|worst| is_broken(worst.value))?;
    if !worst.value.is_finite() {
        return Some(format!(
            "the stretch of {} is {} in step {}: the drape ends here; bring grippers closer together",
            worst.at, worst.value, last.step
        ));
    }
    let mut text = format!(
        "{} is stretched by {:.0} % in step {}: no ply survives that, and the drape ends here",
        worst.at,
        worst.value * 1e2,
        last.step
    );
    let landing = |step: &Step| step.measures.value(Name::LandingError);
    let [low, high] = scene.ply.held_bounds();
    let side = (high[0] - low[0]).max(high[1] - low[1]);
    match steps.iter().find_map(landing) {
        Some(far) if far * 1e-3 > TUNING.large_landing_error * side => {
            text +=
                &format!("; it first touched the mold {far:.0} mm from its place: come from above");
        }
        _ => text += "; bring grippers closer together, or let them follow the mold",
    }
    Some(text)
}
