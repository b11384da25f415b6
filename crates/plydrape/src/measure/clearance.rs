//! Clearance: the smallest distance of the bodies of grippers and robot from mold, obstacles and each other, on the way to a step.
//!
//! Between two steps grippers go straight, and turn along the shortest way; of a whole motion in time it is found along its paths. Depths
//! count as negative distances.

use super::{
    Bound, Course, Description, Found, Measure, Name, Observation, Sense, Unit, WholeMotion, Worth,
};
use crate::clearance::{self, Nearest};
use crate::layup::Layup;
use crate::state::Site;

/// Clearance; see the head of this file.
pub struct Clearance;

impl Measure for Clearance {
    fn description(&self) -> Description {
        let own = Description::new("clearance", "clearance_mm", "clearance", Unit::MILLIMETER);
        Description { sense: Sense::AtLeast, worth: Worth::Kept, ..own }
    }

    fn is_signed(&self) -> bool {
        true
    }

    fn bound(&self) -> Option<Bound> {
        let about = "Smallest distance of the `bodies` of grippers and robot from mold, obstacles and each other";
        Some(Bound::distance(about).usually(
            5e-3,
            "our assumption: a fixture that is placed by hand within 2 mm, hoses and heads of screws of 2 mm, and an error of the robot of less \
             than 1 mm",
        ))
    }

    fn applies(&self, layup: &Layup) -> bool {
        !layup.bodies.is_empty()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let Observation { layup, limits, state, past } = *seen;
        if layup.bodies.is_empty() {
            return None;
        }
        let (least, now) = (limits.least(Name::Clearance), seen.poses());
        let Some(past) = past else {
            return Some(found(&clearance::at_poses(layup, least, &now)?, state.time));
        };
        let nearest = clearance::between_steps(layup, least, &past.poses(layup), &now)?;
        Some(found(&nearest, past.time + nearest.time * (state.time - past.time)))
    }

    fn evaluate_motion(&self, whole: &WholeMotion) -> Option<(Found, Option<f64>)> {
        let WholeMotion { layup, limits, motion, rate, .. } = *whole;
        if layup.bodies.is_empty() {
            return None;
        }
        // the limit, of which the resolution of distances is a share; and the arm in the configuration in which it is judged
        let least = limits.least(Name::Clearance);
        let record = whole.tool.and_then(|peaks| peaks.arm_record);
        let layup = &layup.beginning_as(record.as_ref());
        let nearest = match (motion, whole.attitudes) {
            (Course::Smooth(motion), Some(attitudes)) => {
                Nearest::of_motion(layup, least, rate, motion, attitudes)?
            }
            // between the steps of a motion that was given, every step has looked, but not at the arm
            (Course::Steps(motion), _) => Nearest::of_arm(layup, least, motion)?,
            (Course::Smooth(_), None) => return None,
        };
        Some((found(&nearest, nearest.time), Some(nearest.time)))
    }
}

/// What a nearest pair is as a value (mm), at a time (s).
pub(crate) fn found(nearest: &Nearest, time: f64) -> Found {
    let site = Site::Bodies { part: nearest.part, near: nearest.near, time };
    Found { value: nearest.distance * 1e3, site, place: Some(nearest.place) }
}
