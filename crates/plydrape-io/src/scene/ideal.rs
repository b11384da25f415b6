//! The ideal drape alone: of a scene, what says how the ply is laid on the mold.

use super::check::{ply, title};
use super::file::SceneKeys;
use super::limits::limits;
use super::settings::contact;
use super::source::Document;
use super::{cut, mold, target};
use crate::Error;
use plydrape::layup::{Layup, Settings};
use plydrape::measure::Name;
use plydrape::mold::Mold;
use plydrape::motion::Motion;
use plydrape::net::{Net, Seeds, TargetBoundary};
use plydrape::ply::Ply;
use std::path::PathBuf;

/// The ideal drape of a scene, whether or not grippers could bring the ply there.
#[derive(Debug, Clone)]
pub struct IdealDrape {
    /// Name for reports.
    pub title: String,
    /// What is laid.
    pub ply: Ply,
    /// What it is laid on.
    pub mold: Mold,
    /// How it lies; some of it may not.
    pub net: Net,
    /// How its seed and heading were chosen, if they were searched for.
    pub seeds: Option<Seeds>,
    /// The target boundary, if the scene has one.
    pub wanted: Option<TargetBoundary>,
    /// Largest shear allowed (rad).
    pub shear_limit: f64,
    /// Keys that have a new name, and what of a mesh is hardly meant, each in a sentence.
    pub warnings: Vec<String>,
    /// The scene and the files that it names.
    pub files: Vec<PathBuf>,
}

/// Checks `[ply]`, `[mold]`, `[target]` and `[limits]` of a scene and lays the ply.
pub(super) fn ideal_drape(file: &SceneKeys, document: &Document) -> Result<IdealDrape, Error> {
    // the ply and the mold
    let grippers = file.grippers.as_ref().map(|table| &table.value);
    let (ply, _) = ply(&file.ply, grippers, document)?;
    let Some(table) = &file.mold else {
        return Err(document.error_anywhere(
            "the scene has no [mold] to lay the ply on",
            "add [mold] with kind = \"plane\", or another one",
        ));
    };
    let tolerance = contact(file, &ply, document)?.tolerance;
    let (mold, report) = mold::mold(&table.value, &ply, tolerance, document)?;

    // how the ply is laid: by seed, heading and shear, not by places of grippers
    let Some(table) = &file.target else {
        return Err(document.error_anywhere(
            "the scene has no [target], which says how the ply is laid on the mold",
            "add [target] with `origin`, `direction`, `shear` and `seed`, or empty",
        ));
    };
    if let Some(positions) = &table.value.positions {
        return Err(document.error(
            positions.span.clone(),
            "the target gives `positions` of the grippers, which say nothing about the ply between them",
            "give `origin`, `direction`, `shear` and `seed` to have the ply laid on the mold",
        ));
    }
    let turn = cut::from_warp(&file.ply.value, &ply, document)?;
    let target::Laid { net, seeds, wanted } = target::net(table, &ply, turn, &mold, document)?;

    // the limit of the shear; no gripper moves
    let motion = Motion { times: Vec::new(), positions: Vec::new() };
    let layup = Layup::new(ply, Settings::default(), motion);
    let shear_limit = limits(&file.limits, &layup, document)?.most(Name::Shear);

    // title, warnings, and the files that the scene names
    let title = title(file.title.as_ref(), document)?;
    let mesh = report.map_or_else(Vec::new, |report| report.warnings());
    let warnings = [file.limits.notices(), mesh].concat();
    let (ply, files) = (layup.ply, super::named(document));
    Ok(IdealDrape { title, ply, mold, net, seeds, wanted, shear_limit, warnings, files })
}
