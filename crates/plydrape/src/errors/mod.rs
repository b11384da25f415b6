//! Errors: how far a real cell may be from its scene, and the scene of one such cell.
//!
//! A planned motion is right for the cell of the scene. A real one differs: the tool frame is measured, the grippers are
//! mounted and driven, the ply is picked up, cut from a roll and laid on a mold, each with an error of its own. A budget
//! [`Errors`] has a term for each of them, a standard deviation, a bound or a factor ([`Term`]). A [`Draw`] is one cell out of all
//! that are possible: one value for every error. [`Draw::apply`] makes the scene in which that cell runs the same commands.
//!
//! 1. `term`: a standard deviation, a bound or a factor;
//! 2. `draw`: the values of one sample, each from its own place in a stream of random numbers;
//! 3. `apply`: the layup with these values.
//!
//! The verdict over complete drapes of many cells is in [`crate::outcome`].
//!
//! Errors are constant over one drape. All values of a sample are linear in the terms, or their logarithms are, so that
//! [`Draw::scaled`] is the same cell with all errors larger by a factor.

mod apply;
mod draw;
mod term;
#[cfg(test)]
pub(crate) mod tests;

pub use crate::ply::PickUpError;
pub use draw::{Draw, GripperError, MaterialError, MoldError, RelativeError, RigidError};
pub use term::Term;

/// How far a real cell may be from its scene.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Errors {
    /// Seed of the draws.
    pub seed: u64,
    /// Cells that are drawn at most.
    pub samples: usize,
    /// Share of the drawn cells that must keep the limits.
    pub share: f64,
    /// Errors of the tool frame, common to all grippers.
    pub frame: FrameErrors,
    /// Errors of each gripper by itself.
    pub gripper: GripperErrors,
    /// Errors of where the grippers hold the ply.
    pub pick_up: PickUpErrors,
    /// Errors of the ply.
    pub material: MaterialErrors,
    /// Errors of the mold.
    pub mold: MoldErrors,
}

/// Errors of the tool frame, which all grippers share.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct FrameErrors {
    /// Shift along each axis (m).
    pub position: Term,
    /// Turn about each axis (rad).
    pub angle: Term,
}

/// Errors of each gripper, independent of those of the others.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct GripperErrors {
    /// Constant shift along each axis (m).
    pub position: Term,
    /// Shift along each axis as a share of the way gone along it since the start.
    pub stroke: Term,
}

/// Errors of where the grippers hold the ply.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PickUpErrors {
    /// Shift of the array over the fabric along u and v (m).
    pub offset: Term,
    /// Turn of the array on the fabric about its middle (rad).
    pub yaw: Term,
}

/// Errors of the ply, each a share of the nominal value; but for the length, also a factor.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct MaterialErrors {
    /// Error of the mass per area, or per length.
    pub areal_mass: Term,
    /// Error of the bending rigidities, warp and weft alike.
    pub bending: Term,
    /// Error of the shear force at every shear angle.
    pub shear: Term,
    /// Error of the length of fabric between two grippers, positive if there is more of it.
    pub length: Term,
}

/// Errors of the mold.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct MoldErrors {
    /// Shift along each axis (m).
    pub offset: Term,
    /// Turn about x and about y (rad).
    pub tilt: Term,
    /// Height of a smooth random wave on its surface, [`crate::mold::Waves`] (m): of a deviation the root of the mean
    /// square, of a bound what no point exceeds.
    pub waviness: Term,
    /// Length of these waves (m); without it there are none.
    pub wavelength: f64,
}

/// At most 64 cells of seed 0, of which 95 % must keep the limits, and no error.
impl Default for Errors {
    fn default() -> Self {
        Errors {
            seed: 0,
            samples: 64,
            share: 0.95,
            frame: FrameErrors::default(),
            gripper: GripperErrors::default(),
            pick_up: PickUpErrors::default(),
            material: MaterialErrors::default(),
            mold: MoldErrors::default(),
        }
    }
}

impl Errors {
    /// Whether cells are drawn that differ from the scene.
    #[must_use]
    pub fn is_drawn(&self) -> bool {
        self.samples > 0 && !self.is_zero()
    }

    /// Whether no term has an error.
    #[must_use]
    pub fn is_zero(&self) -> bool {
        let Errors { frame, gripper, pick_up, material, mold, .. } = self;
        let terms = [
            frame.position,
            frame.angle,
            gripper.position,
            gripper.stroke,
            pick_up.offset,
            pick_up.yaw,
            material.areal_mass,
            material.bending,
            material.shear,
            material.length,
            mold.offset,
            mold.tilt,
            mold.waviness,
        ];
        terms.into_iter().all(Term::is_zero)
    }
}
