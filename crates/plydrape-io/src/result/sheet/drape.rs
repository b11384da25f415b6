//! A drape by any model, with the states of its sheet in a file.

use super::kept::SheetKept;
use super::{SheetFile, SheetMesh, SheetState};
use crate::Error;
use crate::store::size;
use plydrape::layup::Model;
use plydrape::mold::Mold;
use plydrape::outcome::{self, Drape, DrapeWatch, DrapedSheet, Step, Summary};
use plydrape::scene::Scene;
use plydrape::sheet::fabric::Cell;
use plydrape::sheet::{ClothState, Fabric, Sheet, is_kept};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

/// A finished drape by one model, the states of its sheet in a file.
#[derive(Debug)]
pub struct KeptDrape {
    /// How it came out.
    pub summary: Summary,
    /// The ply in every step.
    pub steps: Vec<Step>,
    /// The states of the sheet that were kept; `None` of catenaries.
    pub states: Option<SheetKept>,
    /// Time that the model took; no part of the result, which is the same on every machine.
    pub solving: Duration,
}

/// How large the sheet of a scene is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetSize {
    /// Nodes.
    pub nodes: usize,
    /// Largest distance between neighboring lines of nodes (m).
    pub mesh: f64,
    /// Memory that its drape takes (bytes), estimated.
    pub memory: f64,
}

impl SheetSize {
    /// The size of the sheet of a scene.
    ///
    /// # Errors
    /// [`Error`] if the scene has no sheet, or one that is too large.
    pub fn new(scene: &Scene) -> Result<Self, Error> {
        let sheet = Sheet::new(&scene.layup)?;
        let (nodes, states) = (sheet.fabric.places.len(), most_states(scene));
        size::sheet(nodes as f64, states)?;
        Ok(SheetSize { nodes, mesh: sheet.mesh, memory: size::sheet_bytes(nodes as f64, states) })
    }
}

/// Most states that the drape of a scene keeps.
fn most_states(scene: &Scene) -> usize {
    let layup = &scene.layup;
    // and the one after a release
    let released = usize::from(layup.release.is_some());
    layup.settings.sheet.keep.min(layup.motion.positions.len()) + released
}

/// Drapes a scene along its motion by a model, that which decides or the other one. The file of the sheet's states goes into a hidden
/// folder within `dir`; `progress` is called with each step that is done, and `stop` is asked often whether to end there, with what was
/// done so far.
///
/// # Errors
/// [`Error`] if the scene lacks what the model needs, has a sheet that is too large, or the disk refuses.
pub fn drape(
    scene: &Scene,
    model: Model,
    dir: &Path,
    stop: &(dyn Fn() -> bool + Sync),
    mut progress: impl FnMut(usize),
) -> Result<KeptDrape, Error> {
    let layup = &scene.layup;
    let (steps, keep) = (layup.motion.positions.len(), layup.settings.sheet.keep);
    if model == Model::Sheet {
        SheetSize::new(scene)?;
    }
    let mut states = Vec::new();
    let mut see = |step: usize, state: Option<&ClothState>| {
        progress(step);
        states.extend(state.filter(|state| is_kept(state.step, steps, keep)).cloned());
        ControlFlow::Continue(())
    };
    let mut drape = outcome::drape(scene, model, &mut DrapeWatch { stop, see: &mut see })?;
    if let Some(sheet) = &mut drape.sheet {
        sheet.states = states;
    }
    kept(drape, layup.release.is_some(), dir)
}

/// A drape with the states of its sheet in a file, which goes into a hidden folder within `dir`, as that of [`drape`()], and is the same.
///
/// # Errors
/// [`Error::Io`] if the disk refuses.
pub fn keep(drape: Drape, dir: &Path) -> Result<KeptDrape, Error> {
    let releases = drape.sheet.as_ref().is_some_and(|sheet| !sheet.drape.events.is_empty());
    kept(drape, releases, dir)
}

/// A drape with its states in a file, which say which pads hold if they let go (`releases`).
fn kept(drape: Drape, releases: bool, dir: &Path) -> Result<KeptDrape, Error> {
    let Drape { summary, steps, sheet, solving } = drape;
    let file = |DrapedSheet { drape, states, .. }: DrapedSheet| {
        // where the drape ended early, its end is kept too
        let end = states.last().is_none_or(|last| last.step != drape.last.step);
        let states = states.iter().chain(end.then_some(&drape.last));
        let mut states: Vec<_> =
            states.map(|state| kept_state(state, &drape.sheet.fabric, releases)).collect();
        if let (Some(mold), Some(end)) = (&drape.sheet.mold, states.last_mut()) {
            leave_out_beside(mold, end);
        }
        let landed = drape.landing_step.iter().map(|step| step.map_or(0, |n| n as u32));
        let landed: Vec<u32> = landed.collect();
        SheetFile::new(dir, &mesh(&drape.sheet, releases), &landed, &states).map(SheetKept::made)
    };
    let states = sheet.map(file).transpose()?;
    Ok(KeptDrape { summary, steps, states, solving })
}

/// Takes the heights of nodes beside the mold out of the state at the end: they are not judged.
fn leave_out_beside(mold: &Mold, end: &mut SheetState) {
    let beside = |place: &[f64; 3]| mold.closest_point(*place).beyond;
    for (height, place) in end.height.to_mut().iter_mut().zip(end.positions.iter()) {
        if beside(place) {
            *height = f64::NAN;
        }
    }
}

/// What is the same in all states of a sheet; with `releases` these say which pads hold.
fn mesh(sheet: &Sheet, releases: bool) -> SheetMesh<'static> {
    let fabric = &sheet.fabric;
    SheetMesh {
        places: fabric.places.clone().into(),
        areas: fabric.areas.clone().into(),
        segments: fabric.segments.iter().map(|segment| segment.nodes).collect(),
        cells: fabric.cells.iter().filter(|cell| cell.is_ply()).map(|cell| cell.nodes).collect(),
        grippers: sheet.grippers.len(),
        releases,
    }
}

/// A state as it is kept: with the cells that are ply by half or more, and where pads let go with those that hold.
fn kept_state<'a>(state: &'a ClothState, fabric: &Fabric, releases: bool) -> SheetState<'a> {
    let all = fabric.cells.iter().all(Cell::is_ply);
    let of_ply = || fabric.cells.iter().zip(&state.shear).filter(|(cell, _)| cell.is_ply());
    let unknown = || vec![f64::NAN; state.positions.len()].into();
    SheetState {
        step: state.step as u32,
        time: state.time,
        positions: (&state.positions).into(),
        height: match state.heights.is_empty() {
            true => unknown(),
            false => (&state.heights).into(),
        },
        contact: (&state.contact).into(),
        shear: match all {
            true => (&state.shear).into(),
            false => of_ply().map(|(_, shear)| *shear).collect(),
        },
        tension: (&state.tension).into(),
        grippers: state.pads.iter().map(|pad| pad.position).collect(),
        pad_forces: (&state.forces).into(),
        pad_rotation: state.pads.iter().map(|pad| pad.quaternion()).collect(),
        pad_holds: releases.then(|| (&state.holds).into()),
    }
}
