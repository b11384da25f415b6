//! What a search remembers, for another to go on from.

use super::PlanError;
use super::path::Strategy;
use crate::ply::Grid;
use crate::scene::Scene;

/// Positions (m) of all grippers, step by step.
type Positions = Vec<Vec<[f64; 3]>>;

/// The best of a search and how long it has searched.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Memory {
    /// Grippers along u and v.
    grippers: [usize; 2],
    /// Fabric length of a cell along u and v (m).
    cell: [f64; 2],
    /// Complete drapes tried in all searches.
    pub evaluations: usize,
    /// The best strategy; none of a plan that was made step by step.
    pub strategy: Option<Strategy>,
    /// What the best plan has, positions (m) of all grippers step by step: its strategy's, single grippers
    /// refined.
    positions: Positions,
}

impl Memory {
    /// What is remembered of a search for a scene.
    #[must_use]
    pub fn new(
        scene: &Scene,
        evaluations: usize,
        strategy: Option<Strategy>,
        positions: Positions,
    ) -> Self {
        let Grid { nu, nv } = scene.ply.grid;
        Memory { grippers: [nu, nv], cell: scene.ply.cell, evaluations, strategy, positions }
    }

    /// The strategy to go on from, and its positions if they lead from the scene's start to its target.
    pub(super) fn path(&self, scene: &Scene) -> Option<(Strategy, Option<Positions>)> {
        let (start, target) = (scene.motion.positions.first()?, &scene.target.as_ref()?.grippers);
        let ends = [self.positions.first(), self.positions.last()] == [Some(start), Some(target)];
        let steps = self.positions.len() == scene.plan.steps;
        Some((self.strategy?, (ends && steps).then(|| self.positions.clone())))
    }

    /// Refuses what belongs to another ply.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), PlanError> {
        let Grid { nu, nv } = scene.ply.grid;
        if self.grippers != [nu, nv] || self.cell != scene.ply.cell {
            let [earlier_u, earlier_v] = self.grippers;
            return Err(PlanError::OtherPly { earlier_u, earlier_v, nu, nv });
        }
        let sound = |place: &[f64; 3]| place.iter().all(|c| c.is_finite());
        let whole = |step: &Vec<[f64; 3]>| step.len() == nu * nv && step.iter().all(sound);
        if self.strategy.is_some_and(|s| !s.is_sound()) || !self.positions.iter().all(whole) {
            return Err(PlanError::Numbers);
        }
        Ok(())
    }
}
