//! The models of the ply: their names as options, and a drape by one of them under someone's eyes.

use crate::watch::{Interrupt, bar};
use clap::ValueEnum;
use plydrape::layup::Model;
use plydrape::scene::Scene;
use plydrape_io::result::sheet::{self, KeptDrape};
use plydrape_io::text::table;
use plydrape_io::{Error, ResultFile};
use std::path::Path;

/// A model of the ply.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum ModelName {
    /// The whole ply as cloth, between and beyond the grippers.
    Sheet,
    /// Lines of ply between the grippers, as in Krogh et al. 2018.
    Catenaries,
}

impl From<ModelName> for Model {
    fn from(name: ModelName) -> Self {
        match name {
            ModelName::Sheet => Model::Sheet,
            ModelName::Catenaries => Model::Catenaries,
        }
    }
}

/// Drapes a scene by a model, with a bar for someone at a terminal; states of the sheet go into a hidden folder within `dir`.
///
/// # Errors
/// If the scene lacks what the model needs, or the states cannot be kept.
pub fn drape(
    scene: &Scene,
    model: Model,
    dir: &Path,
    interrupt: &Interrupt,
    quiet: bool,
) -> Result<KeptDrape, Error> {
    let template = format!(
        "draping {} {{bar:40}} step {{pos}} of {{len}}, {{eta}} left",
        table::model_name(model)
    );
    let bar = bar(scene.layup.motion.positions.len(), &template, quiet);
    let stop = || interrupt.asked().is_break();
    let drape = sheet::drape(scene, model, dir, &stop, |done| bar.set_position(done as u64));
    bar.finish_and_clear();
    drape
}

/// Shows the model that does not decide beside a result, if the scene asks for it and the drape that decides was not broken off. Returns
/// whether somebody broke that off.
///
/// # Errors
/// As [`drape`].
pub fn show_also(
    result: &mut ResultFile,
    scene: &Scene,
    dir: &Path,
    interrupt: &Interrupt,
    quiet: bool,
) -> Result<bool, Error> {
    if !scene.also || result.summary.interrupted() {
        return Ok(false);
    }
    let also = drape(scene, result.model().other(), dir, interrupt, quiet)?;
    let broken_off = also.summary.interrupted();
    result.show_also(also);
    Ok(broken_off)
}
