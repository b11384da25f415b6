//! What the page shows of the sheet: its cells over the steps, what colors tell of them, forces, its limits.
//!
//! Lengths are packed in micrometers, shear in hundredths of a degree, strain in millionths, tension in mN/m, forces in
//! a unit of their own, because a yarn that cannot stretch pulls with thousands of newtons. States are read one at a time.

use super::block::Block;
use super::geometry::{hundredths, micrometres};
use super::margin::Allowed;
use super::{Field, Limit, limit};
use crate::OutputError;
use crate::result::ResultFile;
use crate::sheet::{CutCell, SheetMesh, SheetSides, SheetState, SheetStates, ended, normal};
use crate::table::share;
use plydrape::errors::SampleVerdict;
use plydrape::sheet::measure::Summary;
use serde::Serialize;

/// Nodes of all steps that the page holds at most.
const MOST_NODES: usize = 400_000;
/// What stands for a height that is not known.
const UNKNOWN: i32 = i32::MIN;
/// Ends of the colors of heights (mm), of every sheet: what touches, and what lies clear of the mold.
const HEIGHTS: [f64; 2] = [0.1, 10.0];
/// Ends of the colors of strains (%), of every sheet.
const STRAINS: [f64; 2] = [1e-3, 1.0];

/// The sheet of a result.
#[derive(Serialize)]
pub(super) struct Sheet<'a> {
    /// All of the sheet's own limits hold, and it is at rest.
    accepted: bool,
    /// Why it has no end that counts.
    ended: Option<String>,
    nodes: usize,
    /// For each step of the page the state that is shown in it.
    states: Vec<Option<usize>>,
    limits: Vec<Limit<'a>>,
    fields: Vec<Field>,
    /// Corners of the cells, four each.
    cells: Vec<u32>,
    /// Cells that the boundary cuts: drawn in place of those with the same nodes.
    cut: Vec<CutCell>,
    /// Step in which each node landed for good, 0 for never.
    landing: Vec<u32>,
    places: Block,
    positions: Block,
    height: Option<Block>,
    contact: Block,
    shear: Block,
    strain: Block,
    tension: Block,
    grippers: Block,
    normals: Block,
    /// What the numbers of `forces` count (N).
    force_unit: f64,
    forces: Block,
    /// Whether each pad holds the ply, 1 or 0; none where all of them always do.
    holds: Option<Block>,
    /// The largest loads that a gripper may have.
    allowed: Allowed,
    /// Thousandths of them that the loads use, along the ply and across it; -1 without a limit.
    used: Block,
    /// Height at each node at the end that the needed share of the sample's cells keeps; one step.
    spread: Option<Block>,
}

/// The file of the states, and which of them the page shows, each behind its step.
pub(super) struct Shown {
    file: SheetStates,
    states: Vec<(usize, usize)>,
}

impl Shown {
    /// The last state of each step that was kept, fewer of them if the sheet is large; none without a sheet.
    ///
    /// # Errors
    /// [`OutputError`] if its file cannot be read.
    pub fn of(result: &ResultFile) -> Result<Option<Self>, OutputError> {
        let Some(kept) = &result.sheet_states else { return Ok(None) };
        let mut file = kept.open()?;
        let states = file.steps()?;
        let most = (MOST_NODES / file.mesh().places.len().max(1)).max(2);
        let every = states.len().div_ceil(most).max(1);
        // the last one is always shown
        let mut states: Vec<_> = states.into_iter().rev().step_by(every).collect();
        states.reverse();
        Ok(Some(Shown { file, states }))
    }

    /// What is the same in all states.
    pub fn mesh(&self) -> &SheetMesh<'static> {
        self.file.mesh()
    }

    /// Whether a step has a state, or the sheet ended before it.
    pub fn has(&self, step: usize) -> bool {
        let last = self.states.last().map_or(0, |(step, _)| *step);
        step > last || self.states.iter().any(|(shown, _)| *shown == step)
    }
}

/// Numbers of all states, side by side.
#[derive(Default)]
struct Packed {
    positions: Vec<i32>,
    height: Vec<i32>,
    contact: Vec<i32>,
    shear: Vec<i32>,
    strain: Vec<i32>,
    tension: Vec<i32>,
    grippers: Vec<i32>,
    normals: Vec<i32>,
    /// In newtons.
    forces: Vec<f64>,
    holds: Vec<i32>,
    used: Vec<i32>,
}

impl Packed {
    fn push(&mut self, state: &SheetState, sides: &SheetSides, allowed: &Allowed) {
        self.positions.extend(state.positions.iter().flat_map(micrometres));
        self.height.extend(state.height.iter().map(|h| match h.is_finite() {
            true => (h * 1e6).round() as i32,
            false => UNKNOWN,
        }));
        self.contact.extend(state.contact.iter().map(|touches| i32::from(*touches)));
        self.shear.extend(state.shear.iter().map(|shear| hundredths(shear.to_degrees())));
        for (strain, tension) in sides.strains(state) {
            self.strain.push((strain * 1e6).round() as i32);
            self.tension.push((tension * 1e3).round() as i32);
        }
        self.grippers.extend(state.grippers.iter().flat_map(micrometres));
        let normals = state.pad_rotation.iter().flat_map(normal);
        self.normals.extend(normals.map(|c| (c * 1e4).round() as i32));
        self.forces.extend(state.pad_forces.as_flattened());
        if let Some(holds) = &state.pad_holds {
            self.holds.extend(holds.iter().map(|holds| i32::from(*holds)));
        }
        let loads = state.pad_forces.iter().zip(state.pad_rotation.iter());
        self.used.extend(loads.flat_map(|(force, turn)| allowed.used(force, turn)));
    }

    /// A micronewton, or more where the largest force would not fit (N).
    fn force_unit(&self) -> f64 {
        let most = self.forces.iter().fold(0.0, |most: f64, f| most.max(f.abs()));
        (most / f64::from(i32::MAX)).max(1e-6)
    }
}

/// The sheet of a result over the steps of the page.
///
/// # Errors
/// [`OutputError`] if its file cannot be read.
pub(super) fn sheet<'a>(
    result: &'a ResultFile,
    summary: &'a Summary,
    Shown { mut file, states }: Shown,
    steps: &[usize],
) -> Result<Sheet<'a>, OutputError> {
    let sides = SheetSides::new(file.mesh());
    let allowed = Allowed::of(&result.scene.settings, &result.scene.limits);
    let mut packed = Packed::default();
    for (_, n) in &states {
        if let Some(state) = file.state(*n)? {
            packed.push(&state, &sides, &allowed);
        }
    }
    let count = states.len();
    let block = |components, values: &[i32]| Block::new(count, components, values);
    let known = packed.height.iter().any(|h| *h != UNKNOWN);
    let mesh = file.mesh();
    let force_unit = packed.force_unit();
    let forces: Vec<i32> = packed.forces.iter().map(|f| (f / force_unit).round() as i32).collect();
    let sample = spread(result, mesh);
    let heights = sample.map(|verdict| {
        let heights = verdict.spread_mm.iter().map(|height| (height * 1e3).round() as i32);
        Block::new(1, 1, &heights.collect::<Vec<_>>())
    });
    let places: Vec<i32> = mesh.places.iter().flatten().map(|c| (c * 1e6).round() as i32).collect();
    Ok(Sheet {
        accepted: summary.accepted,
        ended: ended(summary, result.summary.steps_planned),
        nodes: summary.nodes,
        states: steps.iter().map(|step| states.iter().position(|(with, _)| with == step)).collect(),
        limits: summary.limits.iter().map(|verdict| limit(verdict, None)).collect(),
        fields: fields(result, &packed, file.landing_step(), known, sample),
        cells: mesh.cells.as_flattened().to_vec(),
        cut: CutCell::all(&result.scene.ply, &result.scene.settings, mesh),
        landing: file.landing_step().to_vec(),
        places: Block::new(1, 2, &places),
        positions: block(3, &packed.positions),
        height: known.then(|| block(1, &packed.height)),
        contact: block(1, &packed.contact),
        shear: block(1, &packed.shear),
        strain: block(1, &packed.strain),
        tension: block(1, &packed.tension),
        grippers: block(3, &packed.grippers),
        normals: block(3, &packed.normals),
        force_unit,
        forces: block(3, &forces),
        holds: (!packed.holds.is_empty()).then(|| block(1, &packed.holds)),
        allowed,
        used: block(2, &packed.used),
        spread: heights,
    })
}

/// The sample of a result whose heights are at the nodes of the sheet.
fn spread<'a>(result: &'a ResultFile, mesh: &SheetMesh) -> Option<&'a SampleVerdict> {
    let sample = result.summary.sample.as_ref();
    sample.filter(|sample| sample.spread_mm.len() == mesh.places.len())
}

/// What colors can tell of the sheet.
fn fields(
    result: &ResultFile,
    packed: &Packed,
    landing: &[u32],
    known: bool,
    sample: Option<&SampleVerdict>,
) -> Vec<Field> {
    let limits = &result.scene.limits;
    let mut out = Vec::new();
    if known {
        let limit = result.scene.target.is_some().then_some(limits.height * 1e3);
        let label = "height over the mold";
        out.push(Field::orders("over_mold", label, "mm", "vertex", HEIGHTS, limit));
        if let Some(sample) = sample {
            let label = format!("height that {} of the cells keep at the end", share(sample));
            let limit = result.scene.target.is_some().then_some(limits.height * 1e3);
            out.push(Field::orders("spread", label, "mm", "vertex", HEIGHTS, limit));
        }
    } else {
        let heights = packed.positions.iter().skip(2).step_by(3).map(|z| f64::from(*z) / 1e3);
        out.push(Field::even("height", "height", "mm", "vertex", ends(heights), None));
    }
    let shear = packed.shear.iter().map(|shear| f64::from(*shear) / 1e2);
    let limit = Some(limits.shear.to_degrees());
    out.push(Field::even("shear", "shear angle", "°", "cell", ends(shear), limit));
    let limit = Some(limits.strain * 1e2);
    out.push(Field::orders("strain", "yarn strain", "%", "cell", STRAINS, limit));
    if landing.iter().any(|step| *step > 0) {
        let landed = landing.iter().filter(|step| **step > 0).map(|step| f64::from(*step));
        out.push(Field::even("landing", "lands in step", "1", "vertex", ends(landed), None));
    }
    out
}

/// Lowest and highest of some numbers.
fn ends(values: impl Iterator<Item = f64> + Clone) -> [f64; 2] {
    let low = values.clone().fold(f64::INFINITY, f64::min);
    if low.is_finite() { [low, values.fold(low, f64::max)] } else { [0.0; 2] }
}
