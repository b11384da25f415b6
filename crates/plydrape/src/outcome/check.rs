//! Whether a layup has what a model needs.

use crate::Error;
use crate::layup::{Layup, Model};
use crate::sheet::Sheet;

/// Refuses a layup that lacks what a model needs.
///
/// # Errors
/// The errors of [`Sheet::new`], or [`Error::NoCatenaries`], [`Error::CatenariesPickUp`] or [`Error::CatenariesMounts`] for catenaries.
pub fn check_model(layup: &Layup, model: Model) -> Result<(), Error> {
    if model == Model::Sheet {
        Sheet::new(layup)?;
    }
    check_catenaries(layup, model)
}

/// Refuses catenaries where none hang, where the ply is lifted from a table, and where grippers are on mounts that give.
pub(crate) fn check_catenaries(layup: &Layup, model: Model) -> Result<(), Error> {
    let pad = &layup.settings.pad;
    match model {
        Model::Catenaries if !layup.ply.has_lines() => Err(Error::NoCatenaries),
        Model::Catenaries if layup.pick_up.is_some() => Err(Error::CatenariesPickUp),
        Model::Catenaries if pad.gives() => Err(Error::CatenariesMounts {
            lateral: pad.lateral_stiffness,
            axial: pad.axial_stiffness,
        }),
        _ => Ok(()),
    }
}
