//! The result of a search, from which another search continues.

use super::path::{Strategy, preload};
use crate::Error;
use crate::scene::Scene;

/// Positions (m) of all grippers, step by step.
type Positions = Vec<Vec<[f64; 3]>>;

/// The best of a search and how long it has searched.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Checkpoint {
    /// Fabric coordinates of the grippers (m).
    grippers: Vec<[f64; 2]>,
    /// Complete drapes tried in all searches.
    pub evaluations: usize,
    /// The best strategy; none for a plan of the stepwise planner.
    pub strategy: Option<Strategy>,
    /// Positions (m) of all grippers in each step of the best plan, those of its strategy over the mold of that search.
    positions: Positions,
}

/// Fabric coordinates of a scene's grippers (m).
fn grippers(scene: &Scene) -> Vec<[f64; 2]> {
    (0..scene.layup.ply.grippers()).map(|n| scene.layup.ply.place(n)).collect()
}

impl Checkpoint {
    /// The checkpoint of a search for a scene.
    #[must_use]
    pub fn new(
        scene: &Scene,
        evaluations: usize,
        strategy: Option<Strategy>,
        positions: Positions,
    ) -> Self {
        Checkpoint { grippers: grippers(scene), evaluations, strategy, positions }
    }

    /// The strategy from which to continue, and its positions if they lead from the scene's start to its target.
    pub(super) fn path(&self, scene: &Scene) -> Option<(Strategy, Option<Positions>)> {
        let (strategy, start) = (self.strategy?, scene.layup.motion.positions.first()?);
        let last = preload::ends(scene, &strategy);
        let ends = [self.positions.first(), self.positions.last()] == [Some(start), Some(&last)];
        let steps = self.positions.len() == scene.plan.steps;
        Some((strategy, (ends && steps).then(|| self.positions.clone())))
    }

    /// Refuses a checkpoint of another ply.
    pub(super) fn check(&self, scene: &Scene) -> Result<(), Error> {
        let own = grippers(scene);
        if self.grippers != own {
            let (earlier, now) = (self.grippers.len(), own.len());
            return Err(Error::CheckpointOtherPly { earlier, now });
        }
        let sound = |place: &[f64; 3]| place.iter().all(|c| c.is_finite());
        let whole = |step: &Vec<[f64; 3]>| step.len() == own.len() && step.iter().all(sound);
        if self.strategy.is_some_and(|s| !s.is_sound()) || !self.positions.iter().all(whole) {
            return Err(Error::CheckpointNumbers);
        }
        Ok(())
    }
}
