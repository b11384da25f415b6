//! The ply as a sheet: its nodes and cells in the states that were kept, and what colors tell of them.
//!
//! Lengths are packed in micrometers, shear in hundredths of a degree, strain in millionths and tension in mN/m. States are read one at a
//! time.

use super::block::Block;
use super::drape::Source;
use super::field::{Field, ends};
use super::packing::{MICRO, hundredths, micrometers};
use crate::Error;
use crate::result::ResultFile;
use crate::result::sheet::{CutCell, SheetMesh, SheetSides, SheetState, SheetStates};
use crate::text::table::share;
use plydrape::measure::{Name, Verdict};
use plydrape::outcome::SampleVerdict;
use serde::Serialize;

/// Nodes of all steps that the page holds at most.
const MOST_NODES: usize = 400_000;
/// What stands for a height that is not known.
const UNKNOWN: i32 = i32::MIN;
/// Ends of the colors of heights (mm), of every sheet: what touches, and what lies clear of the mold.
const HEIGHTS: [f64; 2] = [0.1, 10.0];
/// Ends of the colors of strains (%), of every sheet.
const STRAINS: [f64; 2] = [1e-3, 1.0];

/// The sheet in the steps that are drawn.
#[derive(Serialize)]
pub(super) struct Sheet {
    /// Corners of the cells, four each.
    cells: Vec<u32>,
    /// Cells that the boundary cuts: drawn in place of those with the same nodes.
    cut: Vec<CutCell>,
    /// Step in which each node landed for good, 0 for never.
    landing: Vec<u32>,
    /// Fabric coordinates of the nodes.
    places: Block,
    positions: Block,
    height: Option<Block>,
    contact: Block,
    shear: Block,
    strain: Block,
    tension: Block,
    /// Height at each node at the end that the needed share of the sample's cells keeps; one step.
    spread: Option<Block>,
}

/// The file of the states, and which of them the page draws, each behind its step.
pub(super) struct KeptStates {
    file: SheetStates,
    states: Vec<(usize, usize)>,
}

impl KeptStates {
    /// The last state of each step that was kept, fewer of them if the sheet is large; `None` without a sheet.
    ///
    /// # Errors
    /// [`Error`] if their file cannot be read.
    pub fn open(result: &ResultFile) -> Result<Option<Self>, Error> {
        let Some(kept) = &result.sheet_states else { return Ok(None) };
        let mut file = kept.open()?;
        let states = file.steps()?;
        let most = (MOST_NODES / file.mesh().places.len().max(1)).max(2);
        let every = states.len().div_ceil(most).max(1);
        // the last one is always drawn
        let mut states: Vec<_> = states.into_iter().rev().step_by(every).collect();
        states.reverse();
        Ok(Some(KeptStates { file, states }))
    }

    /// What is the same in all states.
    pub fn mesh(&self) -> &SheetMesh<'static> {
        self.file.mesh()
    }

    /// Steps of the states that are drawn.
    pub fn steps(&self) -> Vec<usize> {
        self.states.iter().map(|(step, _)| *step).collect()
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
    /// Which pads have let go in the last state; empty where none ever does.
    released: Vec<bool>,
}

impl Packed {
    fn push(&mut self, state: &SheetState, sides: &SheetSides) {
        self.positions.extend(state.positions.iter().flat_map(micrometers));
        self.height.extend(state.height.iter().map(|h| match h.is_finite() {
            true => (h * MICRO).round() as i32,
            false => UNKNOWN,
        }));
        self.contact.extend(state.contact.iter().map(|touches| i32::from(*touches)));
        self.shear.extend(state.shear.iter().map(|shear| hundredths(shear.to_degrees())));
        for (strain, tension) in sides.strains(state) {
            self.strain.push((strain * 1e6).round() as i32);
            self.tension.push((tension * 1e3).round() as i32);
        }
        let holds = state.pad_holds.as_deref().unwrap_or_default();
        self.released = holds.iter().map(|holds| !holds).collect();
    }
}

impl Sheet {
    /// The sheet of a drape in the kept states, what colors tell of it, and which pads have let go in the last state.
    ///
    /// # Errors
    /// [`Error`] if a state cannot be read.
    pub fn new(
        drape: &Source,
        KeptStates { mut file, states }: KeptStates,
    ) -> Result<(Self, Vec<Field>, Vec<bool>), Error> {
        // the numbers of all states that are drawn
        let result = drape.result;
        let sides = SheetSides::new(file.mesh());
        let mut packed = Packed::default();
        for (_, n) in &states {
            if let Some(state) = file.state(*n)? {
                packed.push(&state, &sides);
            }
        }

        // what colors can show; spread and limits belong to the model that decides
        let mesh = file.mesh();
        let known = packed.height.iter().any(|h| *h != UNKNOWN);
        let sample = if drape.decides { spread(result, mesh) } else { None };
        let judged = if drape.decides { result.summary.limits.as_slice() } else { &[] };
        let fields = fields(&packed, file.landing_step(), known, sample, judged);

        // blocks of whole numbers: one entry for what stays the same, else one for each state
        let block = |components, values: &[i32]| Block::new(states.len(), components, values);
        let spread = sample.map(|verdict| {
            let heights = verdict.spread_mm.iter().map(|height| (height * 1e3).round() as i32);
            Block::new(1, 1, &heights.collect::<Vec<_>>())
        });
        let places: Vec<i32> =
            mesh.places.iter().flatten().map(|c| (c * MICRO).round() as i32).collect();
        let sheet = Sheet {
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
            spread,
        };
        Ok((sheet, fields, packed.released))
    }
}

/// The sample of a result whose heights are at the nodes of the sheet.
fn spread<'a>(result: &'a ResultFile, mesh: &SheetMesh) -> Option<&'a SampleVerdict> {
    let sample = result.summary.sample.as_ref();
    sample.filter(|sample| sample.spread_mm.len() == mesh.places.len())
}

/// What colors can tell of the sheet.
fn fields(
    packed: &Packed,
    landing: &[u32],
    known: bool,
    sample: Option<&SampleVerdict>,
    judged: &[Verdict],
) -> Vec<Field> {
    let mut out = Vec::new();
    if known {
        let field = |key, name| Field::of_measure(key, name, Name::Height, judged, HEIGHTS);
        out.push(field("over_mold", "Height over mold").in_orders());
        if let Some(sample) = sample {
            let label = format!("height that {} of the cells keep at the end", share(sample));
            out.push(field("spread", "Spread").in_orders().with_label(label));
        }
    } else {
        let heights = packed.positions.iter().skip(2).step_by(3).map(|z| f64::from(*z) / 1e3);
        out.push(Field::new("height", "Height", "height", "mm", ends(heights)));
    }
    let range = ends(packed.shear.iter().map(|shear| f64::from(*shear) / 1e2));
    out.push(Field::of_measure("shear", "Shear", Name::Shear, judged, range).on_cells());
    let strain = Field::of_measure("strain", "Strain", Name::Strain, judged, STRAINS);
    out.push(strain.on_cells().in_orders());
    if landing.iter().any(|step| *step > 0) {
        let landed = landing.iter().filter(|step| **step > 0).map(|step| f64::from(*step));
        out.push(Field::new("landing", "Landing", "lands in step", "1", ends(landed)));
    }
    out
}
