//! What a search has judged so far, so that one that was cut off goes on without draping that again.
//!
//! The same scene and seed give the same candidates in the same order. So a search that begins anew and takes its judgments from here comes to
//! where the one before was cut off, and ends as that would have. A judgment belongs to the places of the grippers, to the mesh, and to the cells
//! with errors that were draped: where one of them differs, there is none, and it is draped.

use super::evaluation::{Drapes, Mesh};
use crate::geometry::Point;
use crate::outcome::Judged;
use std::collections::BTreeMap;
use std::hash::{DefaultHasher, Hash, Hasher};

/// The judgments of a search.
#[derive(Debug, Clone, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Journal {
    /// The drapes that ranked candidates.
    ranked: BTreeMap<u64, Drapes>,
    /// Scores of candidates of which nothing else was used.
    scores: BTreeMap<u64, f64>,
    /// How plans were decided on.
    decided: BTreeMap<u64, Known>,
}

/// How a plan was decided on.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub(super) struct Known {
    /// Limits and failures, with all that belongs to them.
    pub judged: Judged,
    /// The score of that.
    pub score: f64,
    /// The cell with errors that breaks a limit, if one of those does that prove a plan.
    pub refused_by: Option<usize>,
    /// Whether it was given its least time, and judged with that.
    pub finished: bool,
    /// Drapes that decided, which the search counts.
    pub drapes: usize,
}

/// The key of a judgment: of what was draped, how, and with which cells.
pub(super) fn key(positions: &[Vec<Point>], mesh: Option<Mesh>, cells: &[usize]) -> u64 {
    let mut hasher = DefaultHasher::new();
    mesh.map(|mesh| mesh == Mesh::Own).hash(&mut hasher);
    cells.hash(&mut hasher);
    for step in positions {
        step.len().hash(&mut hasher);
        step.as_flattened().iter().for_each(|c| c.to_bits().hash(&mut hasher));
    }
    hasher.finish()
}

/// Whether a judgment can be written: all of its numbers are finite.
fn is_finite(judged: &Judged) -> bool {
    let finite = |place: &Point| place.iter().all(|c| c.is_finite());
    judged.missing.is_finite()
        && judged.limits.iter().all(|v| {
            v.value.is_finite() && v.limit.is_finite() && v.place.as_ref().is_none_or(finite)
        })
}

impl Journal {
    /// Whether nothing was judged yet.
    pub(super) fn is_empty(&self) -> bool {
        self.ranked.is_empty() && self.scores.is_empty() && self.decided.is_empty()
    }

    /// The drapes that ranked a candidate.
    pub(super) fn ranked(&self, key: u64) -> Option<Drapes> {
        self.ranked.get(&key).cloned()
    }

    /// The score of a candidate of which nothing else was used.
    pub(super) fn score(&self, key: u64) -> Option<f64> {
        self.scores.get(&key).copied()
    }

    /// Keeps of a candidate its score alone, if that can be written: most candidates come after the best from the first.
    pub(super) fn keep_score(&mut self, key: u64, score: f64) {
        if self.ranked.remove(&key).is_some() && score.is_finite() {
            self.scores.insert(key, score);
        }
    }

    /// How a plan was decided on.
    pub(super) fn decided(&self, key: u64) -> Option<Known> {
        self.decided.get(&key).cloned()
    }

    /// Keeps the drapes that ranked a candidate.
    pub(super) fn rank(&mut self, key: u64, drapes: &Drapes) {
        if drapes.each.iter().chain([&drapes.worst]).all(is_finite) {
            self.ranked.insert(key, drapes.clone());
        }
    }

    /// Keeps how a plan was decided on.
    pub(super) fn decide(&mut self, key: u64, known: &Known) {
        if is_finite(&known.judged) && known.score.is_finite() {
            self.decided.insert(key, known.clone());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn judged(missing: f64) -> Judged {
        Judged { missing, ..Judged::nothing() }
    }

    /// What is found under a key is what was kept there, or the score alone where that is all that is kept; what cannot be written is not kept.
    #[test]
    fn judgments_are_found_by_what_was_draped() {
        let places = vec![vec![[0.0, 0.1, 0.2]], vec![[0.0, 0.1, 0.3]]];
        let mut moved = places.clone();
        moved[1][0][2] = 0.300_000_000_000_000_04;
        let keys = [
            key(&places, Some(Mesh::Own), &[0]),
            key(&places, Some(Mesh::Coarse), &[0]),
            key(&places, None, &[0]),
            key(&places, Some(Mesh::Own), &[0, 1]),
            key(&moved, Some(Mesh::Own), &[0]),
        ];
        let different: std::collections::BTreeSet<u64> = keys.into_iter().collect();
        assert_eq!(different.len(), keys.len());

        let mut journal = Journal::default();
        let drapes =
            |missing| Drapes { worst: judged(missing), each: vec![judged(0.5)], refused_by: None };
        journal.rank(keys[0], &drapes(0.25));
        journal.rank(keys[1], &drapes(0.75));
        journal.rank(keys[3], &drapes(f64::NAN));
        journal.keep_score(keys[1], 7.5);
        journal.keep_score(keys[4], 9.0);
        journal.rank(keys[2], &drapes(0.5));
        journal.keep_score(keys[2], f64::INFINITY);
        assert_eq!(journal.ranked(keys[0]).unwrap().worst, judged(0.25));
        assert!(journal.ranked(keys[1]).is_none() && journal.ranked(keys[3]).is_none());
        assert_eq!(keys.map(|key| journal.score(key)), [None, Some(7.5), None, None, None]);
    }
}
