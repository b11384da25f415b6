//! Whether a verdict on a sheet depends on nothing that is too small to know: a few more drapes of the same motion with minute changes.

use super::{Flight, Judged, Status, Summary};
use crate::errors::{Errors, Term};
use crate::layup::{Layup, Model};
use crate::measure::{Limits, Name, Scope, Verdict, Worst, Worth};
use crate::sheet;
use rayon::prelude::*;

/// Drapes with minute changes: if one of two ridges stays by accident, all of them agree with the drape itself once in 16 times.
const DRAPES: usize = 4;
/// Deviation of each gripper along each axis, of the pitch of the grippers: a micrometer of 100 mm.
const POSITION: f64 = 1e-5;
/// Deviation of the shear force, of itself.
const SHEAR: f64 = 0.01;

/// The minute changes by which the verdict on a sheet is tried: each gripper is off by a hundred-thousandth of the pitch, and the ply by
/// one percent of its shear force.
#[must_use]
pub fn minute_changes(layup: &Layup) -> Errors {
    let mut changes = Errors { samples: DRAPES, share: 1.0, ..Errors::default() };
    changes.gripper.position = Term::Deviation(POSITION * sheet::pitch(&layup.ply));
    changes.material.shear = Term::Deviation(SHEAR);
    changes
}

/// Judges a drape of the sheet that is accepted by more drapes along its motion, with minute changes: by the range of their heights, and by
/// limits of the ply that one of them does not keep. What is measured stays as it is. A drape that is stopped on the way is not accepted.
pub(super) fn judge_sensitivity(
    summary: &mut Summary,
    layup: &Layup,
    limits: &Limits,
    flight: Option<&Flight>,
    stop: &(dyn Fn() -> bool + Sync),
) {
    let limit = |name: Name| name.limit(layup, limits);
    let [Some(least), Some(highest)] = [Name::Sensitivity, Name::Height].map(limit) else { return };
    let Some(own) = height(&summary.limits) else { return };
    // a motion gets its least time after it was decided on
    let timeless = |verdict: &&Verdict| verdict.name.measure().scope() != Scope::Time;
    let accepted = summary.limits.iter().filter(timeless).all(|verdict| verdict.ok);
    if summary.model != Model::Sheet || summary.status != Status::Converged || !accepted {
        return;
    }
    let changes = minute_changes(layup);
    let changed_drape = |n: usize| {
        let changed = changes.draw(n, layup.ply.grippers()).apply(layup);
        Flight::judge(flight, &changed, limits, stop).unwrap_or_else(|_| Judged::nothing())
    };
    let drapes: Vec<Judged> = (0..changes.samples).into_par_iter().map(changed_drape).collect();
    if drapes.iter().any(|drape| drape.interrupted) {
        summary.status = Status::Interrupted;
        return;
    }

    let heights = drapes.iter().filter_map(|drape| height(&drape.limits));
    let [low, high] = heights.fold([own, own], |[low, high], h| [h.min(low), h.max(high)]);
    for drape in &drapes {
        summary.judge_beside(
            drape,
            "with minute changes",
            |step| step,
            |verdict| verdict.name.measure().worth() == Worth::Less,
        );
    }
    let at = format!("{low:.2} to {high:.2} mm high without and with minute changes");
    let worst = Worst { value: high - low, at, place: None };
    // once more as far up would still be below the limit of the height
    let most = least.max(highest - high);
    summary.judge_also([Verdict::new(Name::Sensitivity, worst, most, None)]);
}

/// The height at the end (mm) among verdicts.
fn height(limits: &[Verdict]) -> Option<f64> {
    limits.iter().find(|verdict| verdict.name == Name::Height).map(|verdict| verdict.value)
}
