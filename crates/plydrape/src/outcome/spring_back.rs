//! Whether a ply stays where it is laid: what is sheared springs back once its cups have let go, where neither weight nor friction holds it.
//!
//! The ply is laid on its ideal drape, without any motion, and let go of. What rises then rises behind every motion, because a motion can do no
//! better than to lay each point of the fabric at its place.

use crate::layup::{Layup, Model, SheetTime};
use crate::measure::{Judge, Limits, Name, Verdict};
use crate::motion::Motion;
use crate::sheet::{Beginning, HandOver, Sheet, SheetTuning, Status, drape_from};
use std::ops::ControlFlow;

/// The verdict on the height of the ply of a layup that was laid on its ideal drape, after its cups have let go of it; `None` where that is
/// not known: without a sheet, a mold or an ideal drape of all of the ply, where the cups hold on, or if it was stopped.
#[must_use]
pub fn spring_back(layup: &Layup, limits: &Limits, stop: &dyn Fn() -> bool) -> Option<Verdict> {
    let (mold, target) = (layup.mold.as_ref()?, layup.target.as_ref()?);
    if layup.settings.model != Model::Sheet || layup.release.is_none() {
        return None;
    }
    let motion = Motion { times: vec![0.0], positions: vec![target.grippers.clone()] };
    let mut laid = Layup { motion, tool: None, pick_up: None, ..layup.clone() };
    laid.settings.sheet.time = SheetTime::QuasiStatic;

    let drape = target.drape.as_ref()?;
    let fabric = Sheet::new(&laid).ok()?.fabric;
    let places: Option<Vec<[f64; 3]>> =
        fabric.places.iter().map(|uv| drape.place(mold, *uv)).collect();

    let (mut judge, mut hand_over) = (Judge::new(&laid, limits, false), HandOver::default());
    let beginning = Beginning::Laid(&places?);
    let ended = drape_from(&laid, SheetTuning::default(), beginning, stop, |sheet, state, last| {
        judge.see(&hand_over.state(&laid, sheet, state, last), last);
        ControlFlow::Continue(())
    });
    let ended = ended.ok().filter(|drape| drape.status == Status::Converged);
    ended.and_then(|_| judge.verdicts().into_iter().find(|verdict| verdict.name == Name::Height))
}
