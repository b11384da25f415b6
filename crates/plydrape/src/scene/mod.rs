//! A scene: a layup, the limits that it must keep, how its motion is planned, and the errors of the cell, as numbers in SI units.
//!
//! What reads a scene from a file, and refuses it with the place of a fault, is the crate `plydrape-io`.

mod above;
mod cell;
mod plan;
mod world;

pub use above::start_above;
pub use cell::{Cell, CellFigure, CellPreset};
pub use plan::{PlanMethod, PlanSettings};
pub use world::World;

use crate::errors::Errors;
use crate::layup::{Layup, Settings};
use crate::measure::Limits;
use crate::motion::Motion;
use crate::ply::Ply;

/// A scene: everything that a drape and its verdict need.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Name for reports.
    pub title: String,
    /// What is draped.
    pub layup: Layup,
    /// Limits of an accepted drape.
    pub limits: Limits,
    /// How a motion is planned, where none is followed.
    pub plan: PlanSettings,
    /// How far a real cell may be from this scene, if that is known.
    pub errors: Option<Errors>,
    /// Whether the model that does not decide drapes too, to be shown beside.
    pub also: bool,
    /// Which ply of a plybook it is; `None` of a scene by itself.
    pub book_ply: Option<BookPly>,
}

/// A ply among those of one part.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct BookPly {
    /// Place in the order of laying, from 1.
    pub number: usize,
    /// Name, which no other ply of the part has.
    pub name: String,
}

impl Scene {
    /// A ply along a motion by the rules of the models, with the usual limits and nothing else: no mold, no target, and grippers that
    /// each move by themselves.
    #[must_use]
    pub fn new(ply: Ply, settings: Settings, motion: Motion) -> Self {
        let layup = Layup::new(ply, settings, motion);
        Scene {
            title: String::new(),
            limits: Limits::usual(&layup),
            layup,
            plan: PlanSettings::default(),
            errors: None,
            also: false,
            book_ply: None,
        }
    }
}
