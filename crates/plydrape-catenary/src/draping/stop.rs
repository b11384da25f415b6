//! Where a drape ends because an edge is stretched more than any ply can bear, and what would help.

use super::solved_step::SolvedStep;
use super::tuning::TUNING;
use crate::geometry::distance;
use crate::layup::Layup;
use crate::state::{LineState, PlyState};

/// Stretch of a line as a share of the whole one that it belongs to.
fn stretch(line: &LineState) -> f64 {
    line.overstretch() / line.whole
}

/// NaN tears a ply, too.
fn is_torn(stretch: f64) -> bool {
    stretch.is_nan() || stretch > TUNING.breaking_stretch
}

/// Why a drape ends with a step, and what would help; `None` if it need not end. `first_landing` is the landing error (m) of the first
/// contact.
pub fn reason(layup: &Layup, state: &PlyState, first_landing: Option<f64>) -> Option<String> {
    let torn = state.lines.iter().filter(|line| line.is_fiber && is_torn(stretch(line)));
    // the first of those that are equal; what is no number is the worst
    let worst = torn.reduce(|worst, line| {
        let (most, next) = (stretch(worst), stretch(line));
        if !most.is_nan() && (next.is_nan() || next > most) { line } else { worst }
    })?;
    let (edge, stretch, step) = (worst.site.label(layup), stretch(worst), state.step);
    if !stretch.is_finite() {
        return Some(format!(
            "the stretch of {edge} is {stretch} in step {step}: the drape ends here; bring grippers closer together"
        ));
    }
    let [low, high] = layup.ply.held_bounds();
    let side = (high[0] - low[0]).max(high[1] - low[1]);
    let help = match first_landing {
        Some(far) if far > TUNING.large_landing_error * side => {
            let far = far * 1e3;
            format!("it first touched the mold {far:.0} mm from its place: come from above")
        }
        _ => "bring grippers closer together, or let them follow the mold".into(),
    };
    Some(format!(
        "{edge} is stretched by {:.0} % in step {step}: no ply survives that, and the drape ends here; {help}",
        stretch * 1e2
    ))
}

/// How far fibers that have landed and grippers that stand on the mold are from their places in the ideal drape (m), the farthest of them;
/// `None` if nothing has landed, or its place is not known.
pub fn landing_error(step: &SolvedStep) -> Option<f64> {
    let (layup, snapshot) = (step.layup, step.snapshot);
    let (mold, target) = (layup.mold.as_ref()?, layup.target.as_ref()?);
    let edges = layup.ply.lines().edges();
    let landings = step.landings().iter().take(edges).flatten();
    let fibers = landings.flat_map(|landing| landing.errors.iter().flatten().copied());
    let pads = snapshot.positions.iter().zip(&target.grippers);
    let standing = pads
        .filter(|(pad, _)| mold.signed_distance(**pad) <= layup.settings.contact.tolerance)
        .map(|(pad, place)| distance(*pad, *place));
    fibers.chain(standing).max_by(f64::total_cmp)
}
