//! Why a scene cannot be draped by a model.

use crate::layup::{Layup, Model};
use crate::sheet::{Sheet, SheetError};

/// Why a scene cannot be draped by a model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// The scene has no sheet.
    #[error(transparent)]
    Sheet(#[from] SheetError),
    /// No catenaries hang in the ply.
    #[error("no catenaries hang between the grippers of this ply; the sheet can drape it")]
    NoCatenaries,
}

impl ModelError {
    /// Refuses a layup that lacks what a model needs.
    ///
    /// # Errors
    /// What is missing.
    pub fn check(layup: &Layup, model: Model) -> Result<(), ModelError> {
        if model == Model::Sheet {
            Sheet::new(layup)?;
        }
        ModelError::check_lines(layup, model)
    }

    /// Refuses catenaries where none hang.
    pub(super) fn check_lines(layup: &Layup, model: Model) -> Result<(), ModelError> {
        match model {
            Model::Catenaries if !layup.ply.has_lines() => Err(ModelError::NoCatenaries),
            _ => Ok(()),
        }
    }
}
