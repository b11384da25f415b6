//! The end of a drape, and its derivatives to the positions where its grippers end.

use super::tuning::TUNING;
use super::{Quantity, Row, Sensitivity};
use crate::draping::spans::Equilibrium;
use crate::draping::{Draping, lying_segments};
use crate::geometry::Point;
use crate::layup::Layup;
use crate::ply::ContactSegment;

/// The last step of a drape with its derivatives to where the grippers are in it.
///
/// Contacts are fixed. So the derivatives are those of the drape's outcome to the grippers' targets as
/// long as a slightly different last step makes no new contact, and exact wherever the state is smooth: not where a
/// diagonal just begins to shear or a slope just reaches its limit.
#[derive(Debug, Clone)]
pub struct LastStep {
    /// Taut path of each catenary's tightest segment minus its fabric length (m), negative where it is slack: straight
    /// where it hangs, along the mold where it lies. The derivative of a lying path is a central difference of its length.
    pub overstretch: Vec<Quantity>,
    /// Horizontal force (N) of each catenary's span that pulls or pushes most; `None` where there is none.
    pub force: Vec<Option<Quantity>>,
    /// Shear angle of each cell (rad); `None` where it does not shear.
    pub shear: Vec<Option<Quantity>>,
    /// Angle between the ply's normal at each gripper and the vertical (rad).
    pub tilt: Vec<Quantity>,
}

impl LastStep {
    /// Differentiates the step to which catenaries of a layup have come: `shape` are its spans ([`Draping::follow`]).
    #[must_use]
    pub fn new(layup: &Layup, draping: &mut Draping, shape: &Equilibrium) -> Self {
        let lines = layup.ply.lines();
        let Draping { solver, positions, contacts, .. } = draping;
        let sensitivity = Sensitivity::new(layup, solver, shape, positions, contacts, 0.0);

        // the tightest segment of each catenary among those that lie
        let nothing = Quantity { value: f64::NEG_INFINITY, gradient: Row::default() };
        let mut overstretch = vec![nothing; lines.catenaries()];
        let mut force: Vec<Option<Quantity>> = vec![None; lines.catenaries()];
        for catenary in 0..lines.catenaries() {
            for found in lying(layup, sensitivity.contacts, sensitivity.positions, catenary) {
                if found.value > overstretch[catenary].value {
                    overstretch[catenary] = found;
                }
            }
        }
        // free spans may be tighter; they also give the force
        for span in &shape.spans {
            let found = sensitivity.overstretch(span);
            if found.value > overstretch[span.catenary].value {
                overstretch[span.catenary] = found;
            }
            let slot = &mut force[span.catenary];
            if let Some(found) = sensitivity.force(span)
                && slot.as_ref().is_none_or(|old| found.value.abs() > old.value.abs())
            {
                *slot = Some(found);
            }
        }
        LastStep {
            overstretch,
            force,
            shear: (0..lines.cells().len()).map(|cell| sensitivity.shear(cell)).collect(),
            tilt: (0..lines.grippers()).map(|gripper| sensitivity.tilt(gripper)).collect(),
        }
    }
}

/// Path minus fabric length (m) of the segments of a catenary that lie on the mold.
fn lying(
    layup: &Layup,
    contacts: &[Option<ContactSegment>],
    positions: &[Point],
    catenary: usize,
) -> Vec<Quantity> {
    let (Some(mold), Some(contact)) = (&layup.mold, &contacts[catenary]) else {
        return Vec::new();
    };
    let grippers = layup.ply.lines().ends(catenary);
    let tolerance = layup.settings.contact.tolerance;
    // path minus fabric length of each segment, for given places of the two grippers
    let misfits = |ends: [Point; 2]| -> Vec<f64> {
        let segments = lying_segments(catenary, contact, ends, mold, tolerance);
        segments.iter().map(|segment| -segment.misfit.excess()).collect()
    };

    // the values, at the places where the grippers are
    let ends = grippers.map(|gripper| positions[gripper]);
    let step = TUNING.step * layup.ply.shorter_side();
    let mut out: Vec<Quantity> = (misfits(ends).into_iter())
        .map(|value| Quantity { value, gradient: Row::default() })
        .collect();
    if out.is_empty() {
        return out;
    }

    // the gradients, by central differences with the contact as it is
    for (end, gripper) in grippers.into_iter().enumerate() {
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut ends = ends;
                ends[end][axis] += by;
                misfits(ends)
            };
            let (low, high) = (moved(-step), moved(step));
            for (found, (low, high)) in out.iter_mut().zip(low.into_iter().zip(high)) {
                found.gradient.add_at(3 * gripper + axis, (high - low) / (2.0 * step));
            }
        }
    }
    out
}
