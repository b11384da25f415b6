//! A drape of the sheet whose kept states go into their file as they come.

use super::kept::SheetKept;
use super::{SheetError, SheetMesh, SheetSpool, SheetState};
use crate::size::{self, SizeError};
use plydrape::planner::PlannedSheet;
use plydrape::scene::Scene;
use plydrape::sheet::fabric::Cell;
use plydrape::sheet::measure::Summary;
use plydrape::sheet::{self, Drape, Fabric, Sheet, State, Tuning, is_kept};
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Duration;

/// Why the sheet of a scene was not draped.
#[derive(Debug, thiserror::Error)]
pub enum SheetDrapeError {
    /// The scene has no sheet.
    #[error(transparent)]
    Sheet(#[from] sheet::SheetError),
    /// It would take too much memory.
    #[error(transparent)]
    Size(#[from] SizeError),
    /// Its states could not be kept.
    #[error(transparent)]
    States(#[from] SheetError),
}

impl SheetDrapeError {
    /// What would help.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            SheetDrapeError::Sheet(_) => {
                "change the scene, or drape it by catenaries: kind = \"catenaries\" in [model]"
            }
            SheetDrapeError::Size(fault) => fault.remedy(),
            SheetDrapeError::States(SheetError::Io(_)) => {
                "make room on the disk, or choose a folder on another one with -o"
            }
            SheetDrapeError::States(_) => {
                "this is a fault of plydrape, please report it with the scene"
            }
        }
    }
}

/// A finished drape of the sheet.
#[derive(Debug)]
pub struct SheetDrape {
    /// What was measured, and the verdict.
    pub summary: Summary,
    /// The states that were kept.
    pub states: SheetKept,
    /// Time that it took; no part of the result, which is the same on every machine.
    pub duration: Duration,
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
    /// [`SheetDrapeError`] if the scene has no sheet, or one that is too large.
    pub fn of(scene: &Scene) -> Result<Self, SheetDrapeError> {
        let sheet = Sheet::new(scene)?;
        let (nodes, states) = (sheet.fabric.places.len(), kept(scene));
        size::sheet(nodes as f64, states)?;
        Ok(SheetSize { nodes, mesh: sheet.mesh, memory: size::of_sheet(nodes as f64, states) })
    }
}

/// Most states that the drape of a scene keeps.
fn kept(scene: &Scene) -> usize {
    // and the one after a release
    let released = usize::from(scene.release.is_some());
    scene.settings.sheet.keep.min(scene.motion.positions.len()) + released
}

/// Drapes the sheet of a scene along its motion. Its states are kept in a hidden folder within `dir`; `progress` is called
/// with each step that is done, and `stop` is asked often whether to end there, with the states so far.
///
/// # Errors
/// [`SheetDrapeError`] if the scene has no sheet, one that is too large, or the disk refuses.
pub fn drape(
    scene: &Scene,
    dir: &Path,
    stop: &dyn Fn() -> bool,
    mut progress: impl FnMut(usize),
) -> Result<SheetDrape, SheetDrapeError> {
    SheetSize::of(scene)?;
    let sheet = Sheet::new(scene)?;
    let releases = scene.release.is_some();
    let mut spool = SheetSpool::new(dir, mesh(&sheet, releases))?;
    let (steps, keep) = (scene.motion.positions.len(), scene.settings.sheet.keep);
    let (mut last, mut fault) = (0, None);
    let draped = sheet::drape(scene, Tuning::default(), stop, |seen| {
        progress(seen.step);
        if is_kept(seen.step, steps, keep) {
            if let Err(refused) = spool.push(&state(seen, &sheet.fabric, releases)) {
                fault = Some(refused);
                return ControlFlow::Break(());
            }
            last = seen.step;
        }
        ControlFlow::Continue(())
    })?;
    if let Some(fault) = fault {
        return Err(fault.into());
    }
    finished(draped, last, spool, releases)
}

/// The drape that decided on a plan, with the states that it keeps. They go into a hidden folder within `dir`, as those of
/// [`drape`], and the file is the same.
///
/// # Errors
/// [`SheetDrapeError`] if the disk refuses.
pub fn keep(planned: PlannedSheet, dir: &Path) -> Result<SheetDrape, SheetDrapeError> {
    let PlannedSheet { drape, states } = planned;
    let releases = !drape.summary.events.is_empty();
    let mut spool = SheetSpool::new(dir, mesh(&drape.sheet, releases))?;
    let last = states.last().map_or(0, |kept| kept.step);
    for kept in states {
        spool.push(&state(&kept, &drape.sheet.fabric, releases))?;
    }
    finished(drape, last, spool, releases)
}

/// The drape whose states are in the spool, up to the one of step `last`; with `releases` they say which pads hold.
fn finished(
    draped: Drape,
    last: usize,
    mut spool: SheetSpool,
    releases: bool,
) -> Result<SheetDrape, SheetDrapeError> {
    let Drape { sheet, summary, landing_step, last: end, duration, .. } = draped;
    if end.step != last {
        // where the drape ended early, its end is kept too
        spool.push(&state(&end, &sheet.fabric, releases))?;
    }
    let landed: Vec<u32> = landing_step.iter().map(|step| step.map_or(0, |n| n as u32)).collect();
    let states = SheetKept::made(spool.finish(&landed)?);
    Ok(SheetDrape { summary, states, duration })
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
