//! Slide: how far the fabric has slid under a pad since the start, where the load along the ply has passed the slip force. The sheet alone
//! follows it: grippers of catenaries hold the fabric where they are. A scene that allows a slip length is not judged by the load.

use super::{Bound, Description, Found, Measure, Observation, Refusal, Unit};
use crate::layup::{Layup, Model};

/// Slide; see the head of this file.
pub struct SlipLength;

impl Measure for SlipLength {
    fn description(&self) -> Description {
        Description::of_sheet("slip_length", "slip_mm", "slide under a pad", Unit::MILLIMETER)
    }

    fn bound(&self) -> Option<Bound> {
        let about = "How far the fabric may slide under a pad; unless given it may not, and `slip` judges the load";
        Some(Bound::depth(about).such_as(2e-3))
    }

    fn refusal(&self, layup: &Layup) -> Option<Refusal> {
        let settings = &layup.settings;
        let never = settings.pad.slip_force.is_none() || settings.model != Model::Sheet;
        never.then_some(Refusal {
            why: "no fabric slides under the pads of this scene",
            remedy: "give `slip_force` in [grippers], the load at which a pad lets fabric slide, and drape by the sheet; or leave this limit out",
        })
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        seen.layup.settings.pad.slip_force.filter(|_| seen.state.model == Model::Sheet)?;
        let found = seen.most_of_grippers(|gripper| gripper.slide).in_units_of(1e-3)?;
        Some(if found.value <= 0.0 { Found::NONE } else { found })
    }
}
