//! What grippers do before a drape and after it: they come to the ply on its table, grip it, press it on the mold, let go, and leave.
//!
//! A cycle is the motion of the drape between two others, with rests between them. All of it has one clock, which begins above the table.

use crate::Error;
use crate::LayupError;
use crate::motion::TimedMotion;
use crate::outcome::Drape;
use crate::planner::quickest::tool_stretch;
use crate::scene::Scene;
use crate::sheet::Event;
use crate::sheet::EventKind;

/// What a motion is made from again, see [`TimedMotion::recorded`].
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RecordedMotion {
    /// Planned positions of all grippers (m): control points of the smooth path, one list a step.
    pub path: Vec<Vec<[f64; 3]>>,
    /// Distances of the knots of the path (m).
    pub spacing: Vec<f64>,
    /// The time law: a row for each phase, see [`TimedMotion::law`].
    pub law: Vec<[f64; 5]>,
}

/// What grippers do before the motion of a drape and after it.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Cycle {
    /// From above the ply down to it.
    pub approach: RecordedMotion,
    /// How long the pads stand on the ply before they lift it (s).
    pub grip: f64,
    /// How long they press it on the mold before they let go (s).
    pub press: f64,
    /// Back from the mold, and up.
    pub departure: RecordedMotion,
}

impl RecordedMotion {
    fn new(path: Vec<Vec<[f64; 3]>>, motion: &TimedMotion) -> Self {
        RecordedMotion { path, spacing: motion.spacing(), law: motion.law() }
    }

    /// The motion at any time.
    ///
    /// # Errors
    /// The errors of [`TimedMotion::recorded`].
    pub fn motion(&self) -> Result<TimedMotion, LayupError> {
        TimedMotion::recorded(&self.path, &self.spacing, &self.law)
    }
}

impl Cycle {
    /// The cycle around the motion of a drape of a scene; `None` of a scene whose ply is not picked up.
    ///
    /// # Errors
    /// [`Error::Layup`] if the ways to the ply and from it cannot become motions.
    pub fn around(scene: &Scene, drape: &TimedMotion) -> Result<Option<Self>, Error> {
        let Some((pick_up, mold)) = scene.layup.pick_up.zip(scene.layup.mold.as_ref()) else {
            return Ok(None);
        };
        let [.., landed] = drape.positions() else { return Ok(None) };
        let flat = &drape.positions()[0];
        let [away, up] = pick_up.departure(mold, landed);
        let approach = recorded(scene, vec![pick_up.above(flat), flat.clone()], 1)?;
        let departure = recorded(scene, vec![landed.clone(), away, up], 0)?;
        let press = scene.layup.release.as_ref().map_or(0.0, |release| release.dwell);
        Ok(Some(Cycle { approach, grip: pick_up.grip, press, departure }))
    }

    /// The whole motion, of which the steps are those of the drape.
    ///
    /// # Errors
    /// The errors of [`TimedMotion::recorded`] and [`TimedMotion::then`].
    pub fn whole(&self, drape: &TimedMotion) -> Result<TimedMotion, LayupError> {
        let (approach, departure) = (self.approach.motion()?, self.departure.motion()?);
        drape.then(self.press, &departure)?.after(&approach, self.grip)
    }

    /// When the motion of the drape begins (s).
    #[must_use]
    pub fn begins(&self) -> f64 {
        self.approach.law.last().map_or(0.0, |end| end[0]) + self.grip
    }

    /// Takes a drape along the motion of the drape alone into the time of the cycle; `whole` is that motion.
    pub(super) fn delay(&self, scene: &Scene, drape: &mut Drape, whole: &TimedMotion) {
        let layup = super::evaluation::along_motion(&scene.layup, whole.steps());
        let begins = self.begins();
        let event = |time: f64| if time > 0.0 { begins + time } else { begins - self.grip };
        drape.retime(&layup, &scene.limits, |_, time| begins + time, event);
    }

    /// Takes a drape from there back into the time of the motion of the drape alone.
    pub(super) fn undelay(&self, scene: &Scene, drape: &mut Drape, motion: &TimedMotion) {
        let layup = super::evaluation::along_motion(&scene.layup, motion.steps());
        let begins = self.begins();
        let event = |time: f64| (time - begins).max(0.0);
        drape.retime(&layup, &scene.limits, |_, time| time - begins, event);
    }

    /// The time of an event of the cycle in the motion of the drape alone (s).
    pub(super) fn before_delay(&self, event: &Event) -> f64 {
        match event.kind {
            EventKind::Grip => 0.0,
            EventKind::Press | EventKind::Release => event.time - self.begins(),
        }
    }
}

/// A motion through positions (m) that keeps the limits of the grippers and of their tool, which brings them as near as it can; the position
/// of number `kept` stays as it is.
fn recorded(
    scene: &Scene,
    positions: Vec<Vec<[f64; 3]>>,
    kept: usize,
) -> Result<RecordedMotion, Error> {
    let mut path = match &scene.layup.tool {
        Some(tool) => tool.carry(&positions).positions,
        None => positions.clone(),
    };
    path[kept].clone_from(&positions[kept]);
    let motion = TimedMotion::new(&path, &scene.limits.motion_bounds())?;
    let stretch = tool_stretch(scene, &motion);
    let motion = if stretch > 1.0 { motion.slowed(stretch) } else { motion };
    let path = TimedMotion::moving(&path);
    Ok(RecordedMotion::new(path, &motion))
}
