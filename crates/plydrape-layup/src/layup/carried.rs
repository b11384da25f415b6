//! The motion of a layup as its tool makes it.

use super::Layup;
use crate::Error;
use crate::arm::ArmRecord;
use crate::geometry::rotation::quaternion;
use crate::motion::Motion;
use crate::tool::{Carried, ToolRecord};
use std::borrow::Cow;

impl Layup {
    /// The layup with the motion that its tool makes, and what that takes of the tool; as it is where grippers move by themselves.
    #[must_use]
    pub fn carried(&self) -> (Cow<'_, Layup>, Option<ToolRecord>) {
        let Some(tool) = &self.tool else { return (Cow::Borrowed(self), None) };
        let Carried { positions, record, .. } = tool.carry(&self.motion.positions);
        let motion = Motion { times: self.motion.times.clone(), positions };
        (Cow::Owned(Layup { motion, ..self.clone() }), Some(record))
    }

    /// The layup whose arm begins in the configuration of a record; as it is without one.
    #[must_use]
    pub fn beginning_as(&self, record: Option<&ArmRecord>) -> Cow<'_, Layup> {
        match (&self.tool, record) {
            (Some(tool), Some(record)) => {
                Cow::Owned(Layup { tool: Some(tool.beginning_as(record)), ..self.clone() })
            }
            _ => Cow::Borrowed(self),
        }
    }

    /// Refuses a motion in which the frame of the tool tips over.
    ///
    /// # Errors
    /// [`Error::ToolTips`] with the first step in which it does.
    pub fn check_carried(&self) -> Result<(), Error> {
        self.tool.as_ref().map_or(Ok(()), |tool| tool.carry(&self.motion.positions).check(tool))
    }

    /// Whether joints let the pads tilt.
    #[must_use]
    pub fn tilts(&self) -> bool {
        self.tool.as_ref().is_none_or(|tool| tool.fixed_pads.is_none())
    }

    /// How the pads of grippers at places (m) are turned (x, y, z, w) where no joints let them tilt.
    #[must_use]
    pub fn fixed_pads(&self, places: &[[f64; 3]]) -> Option<[f64; 4]> {
        self.tool.as_ref()?.pads(places).map(quaternion)
    }

    /// The direction that the pads of grippers at places (m) tilt from: upright unless a tool turns it.
    #[must_use]
    pub fn stems(&self, places: &[[f64; 3]]) -> [f64; 3] {
        self.tool.as_ref().map_or([0.0, 0.0, 1.0], |tool| tool.direction(places))
    }
}
