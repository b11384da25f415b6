//! The result of a search, from which another search continues, and what one that was cut off goes on from.

use super::journal::Journal;
use super::path::{Strategy, preload};
use crate::Error;
use crate::scene::{PlanSettings, Scene};

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
    /// The best strategy; `None` for a plan of the stepwise planner.
    pub strategy: Option<Strategy>,
    /// Positions (m) of all grippers in each step of the best plan, those of its strategy over the mold of that search.
    positions: Positions,
    /// What the search had judged, if it was cut off; `None` for one that came to its end.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    unfinished: Option<Box<Unfinished>>,
}

/// A search that was cut off.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
struct Unfinished {
    /// How it searched.
    plan: PlanSettings,
    /// Where the grippers started (m).
    start: Vec<[f64; 3]>,
    /// The checkpoint from which it went on itself.
    from: Option<Checkpoint>,
    /// What it had judged.
    journal: Journal,
}

/// Where the grippers of a scene start (m).
fn start(scene: &Scene) -> Vec<[f64; 3]> {
    scene.layup.start().to_vec()
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
        Checkpoint { grippers: grippers(scene), evaluations, strategy, positions, unfinished: None }
    }

    /// The checkpoint of a search that was cut off, with what it had judged, and the checkpoint `from` which it went on itself.
    pub(super) fn cut_off(
        mut self,
        scene: &Scene,
        from: Option<&Checkpoint>,
        journal: Journal,
    ) -> Self {
        let (plan, start, from) = (scene.plan, start(scene), from.cloned());
        self.unfinished = Some(Box::new(Unfinished { plan, start, from, journal }));
        self
    }

    /// From where a search goes on, and what it need not judge again: a search of the same scene that was cut off goes on from where it
    /// began.
    pub(super) fn origin(&self, scene: &Scene) -> (Option<&Checkpoint>, Journal) {
        match self.unfinished.as_deref() {
            Some(cut) if cut.plan == scene.plan && cut.start == start(scene) => {
                (cut.from.as_ref(), cut.journal.clone())
            }
            _ => (Some(self), Journal::default()),
        }
    }

    /// Whether the search was cut off, so that one of the same scene goes on to the same end.
    #[must_use]
    pub fn is_unfinished(&self) -> bool {
        self.unfinished.is_some()
    }

    /// This checkpoint without what the search had judged: for another scene only its best plan counts.
    #[must_use]
    pub fn finished(mut self) -> Self {
        self.unfinished = None;
        self
    }

    /// The strategy from which to continue, and its positions if they lead from the scene's start to its target.
    pub(super) fn path(&self, scene: &Scene) -> Option<(Strategy, Option<Positions>)> {
        let strategy = self.strategy?;
        let last = preload::ends(scene, &strategy);
        let ends = self.positions.first().map(Vec::as_slice) == Some(scene.layup.start())
            && self.positions.last() == Some(&last);
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
        let from = self.unfinished.as_ref().and_then(|cut| cut.from.as_ref());
        from.map_or(Ok(()), |from| from.check(scene))
    }
}
