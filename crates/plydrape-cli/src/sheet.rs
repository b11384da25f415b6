//! The sheet of a scene: whether it can be draped, and its drape behind that of the catenaries.

use crate::failure::Failure;
use crate::watch::{Interrupt, bar};
use plydrape::scene::{Model, Scene};
use plydrape_io::ResultFile;
use plydrape_io::sheet::{SheetDrapeError, SheetSize};
use std::path::Path;
use std::time::Duration;

/// The size of the sheet, if a scene is draped as one.
///
/// # Errors
/// If it cannot be draped, before anything runs.
pub fn check(scene: &Scene) -> Result<Option<SheetSize>, SheetDrapeError> {
    match scene.settings.model {
        Model::Sheet => SheetSize::of(scene).map(Some),
        Model::Catenaries => Ok(None),
    }
}

/// Drapes the sheet of a scene too, if it has one of that `size`, under someone's eyes: its verdict is then that of the result.
/// Returns the time that it took.
///
/// # Errors
/// If its states cannot be kept.
pub fn drape_sheet(
    result: &mut ResultFile,
    scene: &Scene,
    size: Option<SheetSize>,
    dir: &Path,
    interrupt: &Interrupt,
    quiet: bool,
) -> Result<Option<Duration>, Failure> {
    let Some(size) = size else { return Ok(None) };
    let steps = scene.motion.positions.len();
    let template = format!(
        "draping the sheet of {} nodes {{bar:40}} step {{pos}} of {{len}}, {{eta}} left",
        size.nodes
    );
    let bar = bar(steps, &template, quiet);
    let stop = || interrupt.asked().is_break();
    let took = result.drape_sheet(scene, dir, &stop, |done| bar.set_position(done as u64));
    bar.finish_and_clear();
    Ok(took?)
}
