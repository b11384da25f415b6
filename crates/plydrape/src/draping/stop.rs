//! Where a drape ends because an edge is stretched more than any ply can bear, and what would help.

use super::record::Step;
use crate::measure::{Name, State};
use crate::scene::Scene;

/// Stretch of an edge, as a share of its length, beyond which a drape ends: carbon fibre breaks at 1.5 to
/// 2 %, and the crimp of a woven ply adds some per cent.
const BREAKING_STRETCH: f64 = 0.1;

/// Landing error of the first contact, as a share of the ply's longer side, that explains such a stretch.
const LARGE_LANDING_ERROR: f64 = 0.1;

/// Whether an edge of a step is stretched beyond what any ply bears.
pub fn breaks(state: &State) -> bool {
    let worst = Name::Overstretch.measure().evaluate(state);
    worst.is_some_and(|worst| is_broken(worst.value))
}

/// NaN counts as broken, too.
fn is_broken(stretch: f64) -> bool {
    stretch.is_nan() || stretch > BREAKING_STRETCH
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
    let grid = scene.ply.grid;
    let [a, b] = scene.ply.cell;
    let side = (a * (grid.nu - 1) as f64).max(b * grid.nv.saturating_sub(1) as f64);
    match steps.iter().find_map(landing) {
        Some(far) if far * 1e-3 > LARGE_LANDING_ERROR * side => {
            text +=
                &format!("; it first touched the mold {far:.0} mm from its place: come from above");
        }
        _ => text += "; bring grippers closer together, or let them follow the mold",
    }
    Some(text)
}
