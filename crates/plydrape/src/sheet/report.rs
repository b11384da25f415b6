//! What a drape of the sheet says beside its measures: what it took, how it began to touch, and what holds it off the mold.

use super::drape::Status;
use super::event::Event;
use super::model::Sheet;
use super::raised::{Raised, raised};
use super::state::ClothState;
use crate::geometry::vector::{cross, dot, norm, sub};

/// What a drape of the sheet says beside its measures. What needs a mold is `None` without one.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Report {
    /// Nodes.
    pub nodes: usize,
    /// Largest height of a ridge at the end, formed by excess length (mm).
    pub ridge_max_mm: Option<f64>,
    /// Largest height of a bridge at the end, where the fabric is taut over a hollow (mm).
    pub bridge_max_mm: Option<f64>,
    /// Sharpest turn between neighboring segments in the air in any step (°).
    pub fold_max_deg: f64,
    /// First step in which the ply touches the mold.
    pub first_contact_step: Option<usize>,
    /// Fabric coordinates of what touches first (mm).
    pub first_contact_uv_mm: Option<[f64; 2]>,
    /// Energy at the end (J): weight, stretch, shear, bending, contact and mounts.
    pub energy_j: f64,
    /// Kinetic energy at the end (J).
    pub kinetic_energy_j: f64,
    /// Time steps.
    pub time_steps: usize,
    /// Linear systems that were solved.
    pub solves: usize,
    /// Shortest time step as a share of a step of the motion.
    pub smallest_step: f64,
}

impl Report {
    /// Looks at the state of a step. `gripped` says which nodes grippers hold; nodes up to `touching` (m) over the mold touch it.
    pub(super) fn see(
        &mut self,
        sheet: &Sheet,
        gripped: &[bool],
        state: &ClothState,
        touching: f64,
    ) {
        let (fabric, x) = (&sheet.fabric, &state.positions);
        for bend in &fabric.bends {
            let [a, b, c] = bend.nodes.map(|n| n as usize);
            if !state.contact[b] {
                let [first, second] = [sub(x[b], x[a]), sub(x[c], x[b])];
                let turn = norm(cross(first, second)).atan2(dot(first, second)).to_degrees();
                // NaN is the largest of all
                if turn > self.fold_max_deg || turn.is_nan() {
                    self.fold_max_deg = turn;
                }
            }
        }
        if self.first_contact_step.is_none() {
            let free = |node: usize| fabric.inside[node] && !gripped[node];
            let heights = state.heights.iter().enumerate().filter(|(node, _)| free(*node));
            let lowest = heights.min_by(|a, b| a.1.total_cmp(b.1));
            if let Some((node, _)) = lowest.filter(|(_, height)| **height <= touching) {
                self.first_contact_step = Some(state.step);
                self.first_contact_uv_mm = Some(fabric.places[node].map(|c| c * 1e3));
            }
        }
    }

    /// Adds what the last state says; points up to `clear` (m) over the mold lie on it.
    pub(super) fn end(&mut self, sheet: &Sheet, clear: f64, last: &ClothState) {
        let fabric = &sheet.fabric;
        self.nodes = fabric.places.len();
        (self.energy_j, self.kinetic_energy_j) = (last.energy, last.kinetic_energy);
        let Some(mold) = &sheet.mold else { return };
        let kinds = raised(fabric, mold, &last.positions, clear);
        let highest = |kind: Raised| {
            let nodes = kinds.iter().zip(&last.heights).zip(&fabric.inside);
            let nodes = nodes.filter(|((k, _), inside)| **inside && **k == Some(kind));
            Some(nodes.map(|((_, height), _)| *height * 1e3).fold(0.0, f64::max))
        };
        self.ridge_max_mm = highest(Raised::Ridge);
        self.bridge_max_mm = highest(Raised::Bridge);
    }
}

/// A finished drape of the sheet.
#[derive(Debug, Clone)]
pub struct SheetDrape {
    /// The sheet that was draped.
    pub sheet: Sheet,
    /// How it ended.
    pub status: Status,
    /// Steps of the motion that were done.
    pub steps: usize,
    /// What it says beside its measures.
    pub report: Report,
    /// When pads grip, press and let go, in the order of time; nothing where they hold to the end.
    pub events: Vec<Event>,
    /// The step of the motion in which each node came to the mold and stayed; `None` of one that did not.
    pub landing_step: Vec<Option<usize>>,
    /// Shear angle of each cell (rad) in the step in which the last of its nodes came to the mold; `None` of others.
    pub landing_shear: Vec<Option<f64>>,
    /// The last state.
    pub last: ClothState,
    /// Time that it took.
    pub duration: std::time::Duration,
}
