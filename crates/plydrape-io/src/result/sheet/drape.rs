//! A drape by any model, with the states of its sheet in a file: they go there as they come, or from memory.

use super::kept::SheetKept;
use super::{SheetMesh, SheetSpool, SheetState};
use crate::Error;
use crate::store::size;
use plydrape::layup::Model;
use plydrape::outcome::{self, Drape, DrapeWatch, DrapedSheet, ModelError, Step, Summary};
use plydrape::scene::Scene;
use plydrape::sheet::fabric::Cell;
use plydrape::sheet::{Fabric, Sheet, State, is_kept};
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
    /// That of the sheet of a scene.
    ///
    /// # Errors
    /// [`Error`] if the scene has no sheet, or one that is too large.
    pub fn of(scene: &Scene) -> Result<Self, Error> {
        let sheet = Sheet::new(&scene.layup).map_err(ModelError::from)?;
        SheetSize::of_sheet(&sheet, scene)
    }

    fn of_sheet(sheet: &Sheet, scene: &Scene) -> Result<Self, Error> {
        let (nodes, states) = (sheet.fabric.places.len(), most_states(scene));
        size::sheet(nodes as f64, states)?;
        Ok(SheetSize { nodes, mesh: sheet.mesh, memory: size::of_sheet(nodes as f64, states) })
    }
}

/// Most states that the drape of a scene keeps.
fn most_states(scene: &Scene) -> usize {
    let layup = &scene.layup;
    // and the one after a release
    let released = usize::from(layup.release.is_some());
    layup.settings.sheet.keep.min(layup.motion.positions.len()) + released
}

/// Drapes a scene along its motion by a model, that which decides or the other one. States of the sheet go into a hidden folder within
/// `dir` as they come; `progress` is called with each step that is done, and `stop` is asked often whether to end there, with what was
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
    let mut spool = match model {
        Model::Sheet => Some(Spool::new(scene, dir)?),
        Model::Catenaries => None,
    };

    // the states that are kept, until the disk refuses one
    let mut fault = None;
    let mut see = |step: usize, state: Option<&State>| {
        progress(step);
        if let (Some(spool), Some(state)) = (&mut spool, state)
            && is_kept(state.step, steps, keep)
            && let Err(refused) = spool.push(state)
        {
            fault = Some(refused);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    };
    let drape = outcome::drape(scene, model, &mut DrapeWatch { stop, see: &mut see })?;
    if let Some(fault) = fault {
        return Err(fault);
    }
    finished(drape, spool)
}

/// A drape whose states are in memory, with these in a file: they go into a hidden folder within `dir`, as those of [`drape`], and the file
/// is the same.
///
/// # Errors
/// [`Error`] if the disk refuses.
pub fn keep(drape: Drape, dir: &Path) -> Result<KeptDrape, Error> {
    let Some(DrapedSheet { drape: draped, states }) = &drape.sheet else {
        return finished(drape, None);
    };
    let releases = !draped.events.is_empty();
    let mut spool = Spool::of_sheet(draped.sheet.clone(), releases, dir)?;
    states.iter().try_for_each(|state| spool.push(state))?;
    finished(drape, Some(spool))
}

/// The states of a drape of a sheet on their way into their file.
struct Spool {
    sheet: Sheet,
    /// Whether pads let go, so that states say which of them hold.
    releases: bool,
    states: SheetSpool,
    /// Step of the last state.
    last: usize,
}

impl Spool {
    fn new(scene: &Scene, dir: &Path) -> Result<Self, Error> {
        let sheet = Sheet::new(&scene.layup).map_err(ModelError::from)?;
        SheetSize::of_sheet(&sheet, scene)?;
        Ok(Spool::of_sheet(sheet, scene.layup.release.is_some(), dir)?)
    }

    fn of_sheet(sheet: Sheet, releases: bool, dir: &Path) -> Result<Self, Error> {
        let states = SheetSpool::new(dir, mesh(&sheet, releases))?;
        Ok(Spool { sheet, releases, states, last: 0 })
    }

    fn push(&mut self, kept: &State) -> Result<(), Error> {
        self.last = kept.step;
        self.states.push(&state(kept, &self.sheet.fabric, self.releases))
    }
}

/// The drape whose states are in the spool, those of a sheet.
fn finished(drape: Drape, spool: Option<Spool>) -> Result<KeptDrape, Error> {
    let Drape { summary, steps, sheet, solving } = drape;
    let states = match (spool, sheet) {
        (Some(mut spool), Some(DrapedSheet { drape, .. })) => {
            if drape.last.step != spool.last {
                // where the drape ended early, its end is kept too
                spool.push(&drape.last)?;
            }
            let landed = drape.landing_step.iter().map(|step| step.map_or(0, |n| n as u32));
            let landed: Vec<u32> = landed.collect();
            Some(SheetKept::made(spool.states.finish(&landed)?))
        }
        _ => None,
    };
    Ok(KeptDrape { summary, steps, states, solving })
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
fn state<'a>(state: &'a State, fabric: &Fabric, releases: bool) -> SheetState<'a> {
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
