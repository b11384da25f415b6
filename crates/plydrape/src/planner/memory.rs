//! What a search remembers, for another to go on from.

use super::PlanError;
use super::path::Strategy;
use crate::ply::Grid;
use crate::scene::Scene;
use serde::{Deserialize, Serialize};

/// Name of the format, the first key of every file of it.
const FORMAT: &str = "plydrape-plan";
/// Version of the format.
const VERSION: u32 = 1;

/// The best of a search and how long it has searched.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    format: String,
    version: u32,
    /// Grippers along u and v.
    grippers: [usize; 2],
    /// Fabric length of a cell along u and v (m).
    cell: [f64; 2],
    /// Complete drapes tried in all searches.
    pub evaluations: usize,
    /// The best strategy; none of a plan that was made step by step.
    pub strategy: Option<Strategy>,
}

impl Memory {
    /// What is remembered of a search for a scene.
    #[must_use]
    pub fn new(scene: &Scene, evaluations: usize, strategy: Option<Strategy>) -> Self {
        let Grid { nu, nv } = scene.ply.grid;
        Memory {
            format: FORMAT.into(),
            version: VERSION,
            grippers: [nu, nv],
            cell: scene.ply.cell,
            evaluations,
            strategy,
        }
    }

    /// Refuses what another version wrote, or what belongs to another ply.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), PlanError> {
        if self.format != FORMAT || self.version != VERSION {
            return Err(PlanError::Format { format: self.format.clone(), version: self.version });
        }
        let Grid { nu, nv } = scene.ply.grid;
        if self.grippers != [nu, nv] || self.cell != scene.ply.cell {
            let [earlier_u, earlier_v] = self.grippers;
            return Err(PlanError::OtherPly { earlier_u, earlier_v, nu, nv });
        }
        match self.strategy {
            Some(strategy) if !strategy.is_sound() => Err(PlanError::Strategy),
            _ => Ok(()),
        }
    }
}
