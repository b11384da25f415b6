//! A layup: one ply, the mold that it is laid on, the motion of the grippers, and how they hold it.
//!
//! Every model of the ply drapes a [`Layup`]. Limits, the search for a motion and the errors of a real cell are no part of it; they are in
//! `plydrape::scene`, which is made of a layup and these.
//!
//! 1. `settings`: rules of the models of the ply;
//! 2. `release`: when the pads let go;
//! 3. `pick_up`: how the ply is picked up from a table, and how grippers come and go;
//! 4. `carried`: the motion as the tool makes it.

mod carried;
mod pick_up;
mod release;
mod settings;

pub use pick_up::PickUp;
pub use release::{Release, ReleaseOrder};
pub use settings::{
    ContactEnd, ContactSettings, Friction, Lip, Model, PadSettings, Settings, SheetSettings,
    SheetTime, SlopeRule, Stepping,
};

use crate::bodies::Bodies;
use crate::mold::Mold;
use crate::motion::Motion;
use crate::net::Net;
use crate::ply::Ply;
use crate::tool::Tool;
use std::sync::Arc;

/// One ply and how it is laid.
#[derive(Debug, Clone)]
pub struct Layup {
    /// The ply between the grippers.
    pub ply: Ply,
    /// The mold; `None` for a ply that only hangs.
    pub mold: Option<Mold>,
    /// Where the grippers are in every step.
    pub motion: Motion,
    /// Where the ply should end, if it is to be draped.
    pub target: Option<Target>,
    /// Rules of the models of the ply.
    pub settings: Settings,
    /// What moves with grippers and robot, and what stands in the cell.
    pub bodies: Bodies,
    /// What carries the grippers; each moves by itself unless given.
    pub tool: Option<Tool>,
    /// When the pads let go of the ply; `None` if they hold it to the end.
    pub release: Option<Release>,
    /// How the ply is picked up from a table; `None` of a motion that begins with a ply in the air.
    pub pick_up: Option<PickUp>,
}

impl Layup {
    /// A ply along a motion by the rules of the models, and nothing else: no mold, no target, and grippers that each move by themselves.
    #[must_use]
    pub fn new(ply: Ply, settings: Settings, motion: Motion) -> Self {
        Layup {
            ply,
            mold: None,
            motion,
            target: None,
            settings,
            bodies: Bodies::default(),
            tool: None,
            release: None,
            pick_up: None,
        }
    }

    /// Where the grippers are as the ply hangs from them before it is carried to the mold (m): in the first step, or after the lift
    /// from a table. Empty without a motion.
    #[must_use]
    pub fn start(&self) -> &[[f64; 3]] {
        let lifted = self.pick_up.map_or(0, |pick_up| pick_up.lift_steps);
        let positions = &self.motion.positions;
        positions.get(lifted).or(positions.first()).map_or(&[], Vec::as_slice)
    }

    /// This layup with its ply held at the start, in the air.
    #[must_use]
    pub fn held_at_start(&self) -> Layup {
        let motion = Motion { times: vec![0.0], positions: vec![self.start().to_vec()] };
        Layup { motion, pick_up: None, ..self.clone() }
    }
}

/// Where the ideal drape puts the grippers and the fabric.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Target {
    /// Final gripper positions (m), in the order of [`crate::ply::Ply::index`].
    pub grippers: Vec<[f64; 3]>,
    /// The ideal drape, of which the grippers are nodes; `None` where their positions were given.
    pub drape: Option<Arc<Net>>,
}
