//! The flight of a motion: the ply in the air, which cells with errors share.
//!
//! What hangs in the air and moves slowly is where its grippers are, however they came there. So a cell need not hang its ply up and carry it to
//! the mold by itself: it begins with the ply of the drape without errors, in the last step in which all of it is clear of the mold. There its own
//! errors come up, of the grippers, the pick-up and the ply, and it comes to rest before it goes on. Limits are judged in the air as without errors
//! before this step, and with them from then on. A ply that touches the mold with its errors, or does not come to rest, is draped from its
//! start on; so is every cell of a motion in its own time, whose ply remembers how it came.

use super::Judged;
use super::drape::{Seen, judge_seen, judge_sheet};
use crate::Error;
use crate::layup::{Layup, Model, SheetTime};
use crate::measure::{Judge, Limits, WorstSoFar};
use crate::sheet::{self, ClothState, HandOver};
use std::ops::ControlFlow;

/// Distance from the mold down to which the ply of a drape without errors is shared, as a share of the pitch of the grippers: what is as limp
/// and heavy as a ply may be hangs some hundredths of the pitch lower.
const CLEAR: f64 = 0.05;

/// A ply in the air without errors, and what was seen of it until then.
#[derive(Debug, Clone)]
pub struct Flight {
    /// The ply in the last step of the flight.
    pub(super) air: ClothState,
    /// The worst values up to this step.
    worst: WorstSoFar,
    hand_over: HandOver,
}

/// Looks out for the end of a flight.
pub(super) struct Lookout<'a> {
    layup: &'a Layup,
    /// Whether the ply has come near the mold.
    is_over: bool,
    /// The flight as far as it has come.
    pub flight: Option<Flight>,
}

impl Flight {
    /// Whether drapes along the motion of a layup share their flight, if it has one: a sheet over a mold, so slow that time is of no matter.
    #[must_use]
    pub fn is_shared(layup: &Layup) -> bool {
        let settings = &layup.settings;
        let is_slow = settings.sheet.time == SheetTime::QuasiStatic;
        settings.model == Model::Sheet && is_slow && layup.mold.is_some()
    }

    /// That of the motion of a layup, along which nothing else is draped; `None` if there is none to share, or it was stopped.
    #[must_use]
    pub fn new(layup: &Layup, limits: &Limits, stop: &dyn Fn() -> bool) -> Option<Self> {
        let mut lookout = Lookout::new(layup)?;
        let see = &mut |seen: Seen| {
            lookout.see(&seen);
            if lookout.is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        judge_sheet(layup, limits, None, stop, see).ok()?;
        lookout.flight.filter(|_| !stop())
    }

    /// Judges the sheet of a layup along its motion as [`super::judge`], and gives its flight, if there is one to share.
    ///
    /// # Errors
    /// As [`super::judge`].
    pub fn judged(
        layup: &Layup,
        limits: &Limits,
        stop: &dyn Fn() -> bool,
    ) -> Result<(Judged, Option<Self>), Error> {
        let mut lookout = Lookout::new(layup);
        let see = &mut |seen: Seen| {
            if let Some(lookout) = &mut lookout {
                lookout.see(&seen);
            }
            ControlFlow::Continue(())
        };
        let (judged, _) = judge_sheet(layup, limits, None, stop, see)?;
        Ok((judged, lookout.and_then(|lookout| lookout.flight)))
    }

    /// Judges a cell along the same motion as [`super::judge`], from the flight on if there is one.
    ///
    /// # Errors
    /// As [`super::judge`].
    pub fn judge(
        flight: Option<&Self>,
        cell: &Layup,
        limits: &Limits,
        stop: &dyn Fn() -> bool,
    ) -> Result<Judged, Error> {
        judge_seen(cell, limits, usize::MAX, flight, stop, &mut |_| ()).map(|(judged, _)| judged)
    }

    /// The judge of a cell that goes on from here, and what hands over its ply.
    pub(super) fn go_on<'a>(&self, layup: &'a Layup, limits: &'a Limits) -> (Judge<'a>, HandOver) {
        (Judge::after(self.worst.clone(), layup, limits, false), self.hand_over.clone())
    }
}

impl<'a> Lookout<'a> {
    /// For a drape of a layup; `None` if its flight is not shared.
    pub fn new(layup: &'a Layup) -> Option<Self> {
        Flight::is_shared(layup).then_some(Lookout { layup, is_over: false, flight: None })
    }

    /// Looks at a step.
    pub fn see(&mut self, seen: &Seen) {
        let Seen { sheet, state, judge, hand_over, .. } = *seen;
        let margin = CLEAR * sheet::pitch(&self.layup.ply);
        self.is_over |= !state.heights.iter().all(|height| *height > margin);
        // errors have come up wholly, and the table is left, where a lift is over; the first step saves nothing
        let lifted = self.layup.pick_up.map_or(0, |pick_up| pick_up.lift_steps);
        let on_table =
            sheet.table.is_some_and(|table| state.positions.iter().any(|x| x[2] <= table + margin));
        let is_last = state.step == self.layup.motion.positions.len();
        if !self.is_over && !on_table && !is_last && state.step > lifted.max(1) {
            let (air, worst) = (state.clone(), judge.worst().clone());
            self.flight = Some(Flight { air, worst, hand_over: hand_over.clone() });
        }
    }
}
