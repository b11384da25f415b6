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
    /// Grippers on mounts that give, which catenaries do not follow.
    #[error(
        "catenaries hold their grippers rigidly, and the mounts of these grippers give: {}",
        stiffness(*.lateral, *.axial)
    )]
    Mounts {
        /// Stiffness of the mounts along the ply (N/m); none if rigid.
        lateral: Option<f64>,
        /// Stiffness of the mounts across the ply (N/m); none if rigid.
        axial: Option<f64>,
    },
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
        ModelError::check_catenaries(layup, model)
    }

    /// Refuses catenaries where none hang, and where grippers are on mounts that give.
    pub(crate) fn check_catenaries(layup: &Layup, model: Model) -> Result<(), ModelError> {
        let pad = &layup.settings.pad;
        match model {
            Model::Catenaries if !layup.ply.has_lines() => Err(ModelError::NoCatenaries),
            Model::Catenaries if pad.gives() => Err(ModelError::Mounts {
                lateral: pad.lateral_stiffness,
                axial: pad.axial_stiffness,
            }),
            _ => Ok(()),
        }
    }
}

/// How stiff mounts are, in N/mm: `2 N/mm along the ply, 5 N/mm across it`.
fn stiffness(lateral: Option<f64>, axial: Option<f64>) -> String {
    let along = |(k, axis): (Option<f64>, &str)| Some(format!("{} N/mm {axis}", k? / 1e3));
    let axes = [(lateral, "along the ply"), (axial, "across it")];
    axes.into_iter().filter_map(along).collect::<Vec<_>>().join(", ")
}
