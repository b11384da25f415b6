//! The search for a strategy: a few families first, then evolution of the best (CMA-ES, Hansen 2016), or for grippers on mounts a
//! race of the best and a walk from the one that wins (`on_mounts`).
//!
//! A candidate whose grippers alone would exceed a limit is not draped (`geometry`). The others are ranked by complete
//! drapes, of a coarse sheet where the sheet decides, and the best are decided on with the mesh of the scene. Where this
//! leads to no plan, the others are ranked with the mesh of the scene, too. The search ends with a plan that is accepted
//! with a margin. Candidates are independent and run on all cores; which one is the best does not depend on the number of
//! cores.

mod on_mounts;
mod walk;

use super::fronts::Fronts;
use super::strategy::Strategy;
use super::tuning::TUNING;
use crate::Error;
use crate::geometry::Point;
use crate::layup::Model;
use crate::outcome::SampleVerdict;
use crate::planner::checkpoint::Checkpoint;
use crate::planner::decision::Decision;
use crate::planner::evaluation::{self, Bias, Drapes, Mesh};
use crate::planner::infeasible_limits::infeasible_limits;
use crate::planner::journal::{self, Known};
use crate::planner::search_state::{Proof, SearchState, lock};
use crate::scene::Scene;
use cmaes::{CMAESOptions, DVector};
use on_mounts::Racer;
use rayon::prelude::*;
use std::cmp::Ordering;
use std::sync::Mutex;

/// A strategy and the score of the drape that it leads to.
#[derive(Debug, Clone)]
struct Candidate {
    strategy: Strategy,
    positions: Vec<Vec<Point>>,
    /// Drapes; `None` for one that was not draped, or of which only the score is known.
    drapes: Option<Drapes>,
    score: f64,
    /// The key of its drapes in the journal, until it was compared with the others.
    unranked: Option<u64>,
    /// Whether it is known from a race to break a limit in so many cells that no sample is asked for it while the search goes on.
    fails_often: bool,
}

impl Candidate {
    /// One of which the score alone is known.
    fn new(strategy: Strategy, positions: Vec<Vec<Point>>, score: f64) -> Self {
        let (drapes, unranked, fails_often) = (None, None, false);
        Candidate { strategy, positions, drapes, score, unranked, fails_often }
    }
}

/// What all candidates of a search share.
struct Shared<'a, 'b> {
    scene: &'a Scene,
    fronts: Fronts<'a>,
    state: &'a SearchState<'b>,
    /// How candidates are ranked; it changes between generations only.
    ranking: Mutex<Ranking>,
    /// Why the model that decides cannot drape, if it cannot.
    fault: Mutex<Option<Error>>,
}

/// How candidates are ranked.
#[derive(Debug, Clone)]
struct Ranking {
    mesh: Mesh,
    /// How far the coarse mesh was wrong where it was decided. What the mesh of the scene says differs from a decision by the
    /// steps and the time alone, by another factor for each plan: there is nothing to learn from it.
    bias: Bias,
}

/// A candidate on which was decided.
struct Choice {
    strategy: Strategy,
    positions: Vec<Vec<Point>>,
    known: Known,
    /// The decision itself; `None` if a search before has made it.
    decision: Option<Decision>,
    /// Whether a sample has refused it, or would.
    refused: bool,
}

impl Choice {
    fn is_accepted(&self) -> bool {
        !self.refused && self.known.judged.accepted()
    }

    fn score(&self) -> f64 {
        self.known.score
    }
}

/// A search under way.
struct Search<'a, 'b> {
    shared: &'a Shared<'a, 'b>,
    /// The best candidates on which was not decided.
    candidates: Vec<Candidate>,
    best: Option<Choice>,
    /// Families that are draped when those before have led to no plan.
    later: Vec<Strategy>,
    /// On mounts those that came to the end of the race of the first fronts, and race again with others.
    raced: Vec<Candidate>,
    /// On mounts the front that won the race, or has come farthest in the walk.
    leader: Option<Racer<'a>>,
    /// Lowest score of a ranking by the coarse mesh that was decided on.
    tried: f64,
    /// The first that could not become a motion.
    fault: Option<Error>,
    /// Rounds in which an accepted plan was not improved.
    idle: usize,
    /// Drapes that may be tried.
    left: usize,
    /// Drapes that may be tried with the other mesh beside these, on mounts; 0 where both meshes share them.
    spare: usize,
}

/// Most candidates that a search drapes: on mounts that give as many as the scene says with its mesh, and as many before with a coarse one,
/// which costs a tenth.
#[must_use]
pub fn most_candidates(scene: &Scene) -> usize {
    let (layup, most) = (&scene.layup, scene.plan.evaluations);
    let doubled = layup.settings.model == Model::Sheet && layup.settings.pad.gives();
    if doubled { most.saturating_mul(2) } else { most }
}

/// The best plan that is found: families first, or the result of an earlier search, then evolution. None without
/// a mold or a target. Where it is `sampled`, a plan that is accepted is judged by the sample of the scene too, and the search goes on
/// if that refuses it.
///
/// # Errors
/// If no candidate can become a motion.
pub fn search(
    scene: &Scene,
    checkpoint: Option<&Checkpoint>,
    sampled: bool,
    state: &SearchState,
) -> Result<Option<Decision>, Error> {
    let Some(fronts) = Fronts::new(scene) else { return Ok(None) };
    let ranking = Mutex::new(Ranking { mesh: Mesh::Coarse, bias: Bias::default() });
    let shared = Shared { scene, fronts, state, ranking, fault: Mutex::new(None) };
    let mut search = Search {
        shared: &shared,
        candidates: Vec::new(),
        best: None,
        later: Vec::new(),
        raced: Vec::new(),
        leader: None,
        tried: f64::INFINITY,
        fault: None,
        idle: 0,
        left: scene.plan.evaluations.max(1),
        spare: most_candidates(scene).saturating_sub(scene.plan.evaluations.max(1)),
    };
    // infeasible limits are not searched for: no motion could keep them
    search.first(checkpoint);
    if infeasible_limits(scene).is_empty() {
        search.improve(checkpoint);
        while sampled && search.is_refused_by_sample()? && state.refusals() < TUNING.search.samples
        {
            search.go_on(checkpoint);
        }
    }
    // at least one is decided on, even if the search was stopped
    if search.best.is_none() {
        state.finish();
        search.ensure_candidate(checkpoint);
        search.decide_on_best(f64::INFINITY);
    }
    let Search { best, fault, .. } = search;
    if let Some(fault) = lock(&shared.fault).take() {
        return Err(fault);
    }
    // a decision that an earlier search made is only known by its score, so it is draped again
    match (best, fault) {
        (None, Some(fault)) => Err(fault),
        (Some(Choice { decision: None, strategy, positions, known, .. }), _) => {
            state.finish();
            Decision::again(scene, Some(strategy), positions, &known, state).map(Some)
        }
        (best, _) => Ok(best.and_then(|best| best.decision)),
    }
}

impl Search<'_, '_> {
    /// The first candidates: families, or what an earlier search found.
    fn first(&mut self, checkpoint: Option<&Checkpoint>) {
        let Shared { scene, fronts, state, .. } = self.shared;
        state.begin("draping the first candidates");
        match checkpoint.and_then(|checkpoint| checkpoint.path(scene)) {
            Some((strategy, Some(positions))) => {
                self.left = self.left.saturating_sub(1);
                self.candidates.push(self.shared.along(strategy, positions));
                self.rank();
                self.decide_on_best(f64::INFINITY);
            }
            Some((strategy, None)) => {
                self.drape(&[strategy]);
                self.decide_on_best(f64::INFINITY);
            }
            None => {
                // none of it counts once the search is stopped
                let goes_on = || state.report().is_continue();
                let steepest = |shape: Strategy| match goes_on() {
                    true => fronts.steepest(shape),
                    false => shape.slope,
                };
                if self.on_mounts() && scene.layup.settings.model == Model::Sheet {
                    self.race_first(&Strategy::racing_first(scene, steepest));
                }
                let families = Strategy::families(scene, steepest);
                // what grippers alone cannot do comes last
                let excess = |strategy: &Strategy| match goes_on() {
                    true => fronts.excess(*strategy).max(1.0),
                    false => 1.0,
                };
                let excess: Vec<f64> = families.par_iter().map(excess).collect();
                let mut order: Vec<usize> = (0..families.len()).collect();
                order.sort_by(|a, b| excess[*a].total_cmp(&excess[*b]));
                self.later = order.into_iter().map(|n| families[n]).collect();
                self.drape_families();
            }
        }
    }

    /// A race of as many families as it takes, however few wait: a sample may have refused one of the first few.
    fn race_families(&mut self) {
        if !self.later.is_empty() && !self.can_race() {
            self.shared.state.begin("draping more candidates");
            self.drape_families();
        }
        self.race();
        if self.best.is_none() {
            self.decide_on_best(f64::INFINITY);
        }
    }

    /// Drapes families, and decides on promising ones, until those that wait are enough for a race.
    fn drape_families(&mut self) {
        while !(self.later.is_empty() || self.left == 0 || self.is_done() || self.can_race()) {
            let batch = self.later.len().min(TUNING.search.batch).min(self.left);
            let batch: Vec<Strategy> = self.later.drain(..batch).collect();
            self.drape(&batch);
            self.decide();
        }
    }

    /// A candidate, even if the search was stopped before the first was draped.
    fn ensure_candidate(&mut self, checkpoint: Option<&Checkpoint>) {
        let Shared { scene, fronts, .. } = self.shared;
        if !self.candidates.is_empty() || self.fault.is_some() {
            return;
        }
        let earlier = checkpoint.and_then(|checkpoint| checkpoint.path(scene));
        let families = || Strategy::families(scene, |shape| shape.slope);
        let strategies = earlier.map_or_else(families, |(strategy, _)| vec![strategy]);
        let with_positions = |strategy| Some((strategy, fronts.positions(strategy)?));
        if let Some((strategy, positions)) = strategies.into_iter().find_map(with_positions) {
            self.candidates.push(Candidate::new(strategy, positions, f64::INFINITY));
        }
    }

    /// Evolution about the best of the first candidates; a walk from it for grippers on mounts.
    fn improve(&mut self, checkpoint: Option<&Checkpoint>) {
        if self.on_mounts() {
            // the mesh of the scene ranks for those that have no plan yet
            if self.is_accepted() && !self.shared.scene.plan.improve {
                return;
            }
            let first = lock(&self.shared.ranking).clone();
            match first.mesh {
                Mesh::Coarse => self.race_families(),
                Mesh::Own => self.decide_on_waiting(),
            }
            self.walk();
            // families that are left, as long as drapes by the coarse mesh are
            while !self.later.is_empty() && self.spare > 0 && !self.is_done() {
                self.rank_with(Ranking { mesh: Mesh::Coarse, ..first.clone() });
                self.candidates.clear();
                self.race_families();
                self.walk();
            }
            return;
        }
        let coarse = lock(&self.shared.ranking).clone();
        let catenaries = self.shared.scene.layup.settings.model == Model::Catenaries;
        if catenaries || coarse.mesh == Mesh::Own {
            return self.evolve(checkpoint, 0);
        }
        if !self.is_accepted() {
            self.rank_with_own_mesh();
        }
        if self.is_done() {
            return;
        }
        let score = self.best.as_ref().map_or(f64::INFINITY, Choice::score);
        if self.is_accepted() || score > TUNING.search.near {
            // a plan has only to become better, or none is near: many coarse drapes
            if lock(&self.shared.ranking).mesh == Mesh::Own {
                self.candidates.clear();
                self.rank_with(coarse);
            }
            let fine = match self.spare {
                0 => (TUNING.search.fine * self.left as f64) as usize,
                _ => 0,
            };
            self.evolve(checkpoint, fine);
            self.rank_with_own_mesh();
        }
        self.evolve(checkpoint, 0);
    }

    /// Ranks candidates so from now on.
    fn rank_with(&mut self, ranking: Ranking) {
        let before = std::mem::replace(&mut *lock(&self.shared.ranking), ranking.clone());
        if self.on_mounts() && before.mesh != ranking.mesh {
            std::mem::swap(&mut self.left, &mut self.spare);
        }
    }

    /// Ranks candidates with the mesh of the scene from now on, and the best of those that wait, too.
    fn rank_with_own_mesh(&mut self) {
        if self.is_done() {
            return;
        }
        self.rank_with(Ranking { mesh: Mesh::Own, bias: Bias::default() });
        let mut waiting = std::mem::take(&mut self.candidates);
        waiting.truncate(TUNING.search.batch.min(self.left));
        let strategies: Vec<Strategy> = waiting.into_iter().map(|c| c.strategy).collect();
        self.shared.state.begin("draping the best with the mesh of the scene");
        self.drape(&strategies);
        for _ in 0..strategies.len() {
            if !self.is_done() {
                self.decide();
            }
        }
        if self.best.is_none() {
            self.decide_on_best(f64::INFINITY);
        }
    }

    /// Evolution about the best until no more than this many drapes are left; a search that continues an earlier one takes other
    /// samples.
    fn evolve(&mut self, checkpoint: Option<&Checkpoint>, left: usize) {
        // start from the best that is known, whether it was ranked on the coarse sheet or decided on the whole one
        let ranked = self.candidates.first().map(|first| (first.score, first.strategy));
        let decided = self.best.as_ref().map(|best| (best.score(), best.strategy));
        let start = ranked.into_iter().chain(decided).reduce(|a, b| if b.0 < a.0 { b } else { a });
        let Some((_, start)) = start else { return };
        let shared = self.shared;
        shared.state.begin("improving the best by evolution");
        // a seed of its own for each call, so that a search that goes on does not draw the same samples
        let before = checkpoint.map_or(0, |checkpoint| checkpoint.evaluations as u64);
        let seed = before + (left + shared.state.refusals()) as u64;
        let found: Mutex<Vec<Candidate>> = Mutex::new(Vec::new());
        let objective = |unit: &DVector<f64>| -> f64 {
            let strategy = Strategy::of_unit(unit.as_slice());
            let Some(candidate) = shared.candidate(strategy) else { return f64::MAX };
            let score = candidate.score;
            lock(&found).push(candidate);
            score
        };
        // the first step of the evolution depends on the mesh
        let fine = lock(&shared.ranking).mesh == Mesh::Own;
        let step = TUNING.search.steps[usize::from(fine)];
        let options = CMAESOptions::new(start.to_unit().to_vec(), step)
            .population_size(TUNING.search.generation)
            .seed(shared.scene.plan.seed.wrapping_add(seed));
        let Ok(mut evolution) = options.build(objective) else { return };
        // each generation is ranked, and its best is decided on the whole sheet
        while !self.is_done() && self.left >= left + TUNING.search.generation {
            self.left -= TUNING.search.generation;
            let ended = evolution.next_parallel().is_some();
            self.candidates.append(&mut lock(&found));
            self.rank();
            self.decide();
            if ended {
                break;
            }
        }
    }

    /// Whether the sample of the scene refuses the plan with which the search would end. From then on plans are proven by as many cells
    /// as the sample has, of the planner's own: those of the sample judge, and nothing is learned from them.
    fn is_refused_by_sample(&mut self) -> Result<bool, Error> {
        let Shared { scene, state, .. } = self.shared;
        let errors = scene.errors.filter(|errors| errors.is_drawn() && !state.is_stopped());
        let Some(errors) = errors else { return Ok(false) };
        let Some(best) = self.best.as_mut().filter(|best| best.is_accepted()) else {
            return Ok(false);
        };
        let Choice { strategy, positions, known, decision, refused } = best;
        let mut made = match decision.take() {
            Some(made) => made,
            None => Decision::again(scene, Some(*strategy), positions.clone(), known, state)?,
        };
        let sample = made.sample(scene, state)?.filter(|sample| !sample.ok).cloned();
        *decision = Some(made);
        let Some(SampleVerdict { limits, .. }) = sample else { return Ok(false) };
        *refused = true;
        known.judged.limits = limits;
        known.score = evaluation::score(&known.judged);
        let cells = errors.samples.max(state.proof().cells);
        let proof = Proof { cells, spare: cells - errors.needed(cells) };
        state.refuse(proof, &known.judged.limits, known.score);
        Ok(true)
    }

    /// The search behind a sample that has refused the best plan: those that wait and kept all limits in the cells that ranked them, and
    /// then evolution. On mounts those are ranked with the mesh of the scene first.
    fn go_on(&mut self, checkpoint: Option<&Checkpoint>) {
        let waits = |search: &Self| search.candidates.first().is_some_and(|c| c.score < 1.0);
        while !self.on_mounts() && waits(self) && !self.is_accepted() && !self.is_done() {
            self.decide();
        }
        if !self.is_done() {
            self.improve(checkpoint);
        }
    }

    /// Whether the grippers are on mounts that give.
    fn on_mounts(&self) -> bool {
        self.shared.scene.layup.settings.pad.gives()
    }

    fn is_accepted(&self) -> bool {
        self.best.as_ref().is_some_and(Choice::is_accepted)
    }

    /// Whether the search shall end: an accepted plan is not improved for long, unless the scene asks for it.
    fn is_done(&self) -> bool {
        let improve = self.shared.scene.plan.improve;
        // drapes with the mesh of the scene are for those that have no plan yet
        let patience = match lock(&self.shared.ranking).mesh {
            Mesh::Coarse => TUNING.search.patience,
            Mesh::Own => 0,
        };
        let enough = |best: &Choice| {
            let good = best.score() <= TUNING.search.good;
            !improve && best.is_accepted() && (good || self.idle >= patience)
        };
        (self.left == 0 && self.spare == 0)
            || self.shared.state.is_stopped()
            || self.best.as_ref().is_some_and(enough)
    }

    /// Drapes along strategies.
    fn drape(&mut self, strategies: &[Strategy]) {
        self.left = self.left.saturating_sub(strategies.len());
        let candidate = |strategy: &Strategy| self.shared.candidate(*strategy);
        let found: Vec<Candidate> = strategies.par_iter().filter_map(candidate).collect();
        self.candidates.extend(found);
        self.rank();
    }

    /// The best candidates first, and no more of them than can matter.
    fn rank(&mut self) {
        self.candidates.sort_by(|a, b| {
            let [first, second] = [a, b].map(|candidate| candidate.strategy.to_unit());
            let by_strategy = first.partial_cmp(&second).unwrap_or(Ordering::Equal);
            a.score.total_cmp(&b.score).then(by_strategy)
        });
        let kept = TUNING.search.kept.min(self.candidates.len());
        for dropped in self.candidates.drain(kept..) {
            if let Some(key) = dropped.unranked {
                self.shared.state.keep_score(key, dropped.score);
            }
        }
        self.candidates.iter_mut().for_each(|candidate| candidate.unranked = None);
    }

    /// Decides on the best candidate if it is promising.
    fn decide(&mut self) {
        let known = !lock(&self.shared.ranking).bias.is_empty();
        let score = |best: &Option<Choice>| best.as_ref().map_or(f64::INFINITY, Choice::score);
        let before = score(&self.best);
        let mut promising = TUNING.search.promising[usize::from(known)];
        if self.on_mounts() {
            promising = TUNING.search.promising_on_mounts;
            if lock(&self.shared.ranking).mesh == Mesh::Coarse {
                // a coarse ranking says little of what is nearly as good
                promising = promising.min(TUNING.search.gain * self.tried);
                let first = self.candidates.first().map_or(f64::INFINITY, |first| first.score);
                self.tried = if first <= promising { first } else { self.tried };
            }
        }
        // a plan that is accepted is only replaced by a better one
        if let Some(best) = self.best.as_ref().filter(|best| best.is_accepted()) {
            promising = promising.min(TUNING.search.gain * best.score());
        }
        self.decide_on_best(promising);
        let gained = score(&self.best) < TUNING.search.gain * before;
        self.idle = if self.is_accepted() && !gained { self.idle + 1 } else { 0 };
    }

    /// Decides on the best candidate if its score is at most `promising`.
    fn decide_on_best(&mut self, promising: f64) {
        let Shared { scene, state, .. } = self.shared;
        let waits = self.candidates.first().is_some_and(|candidate| candidate.score <= promising);
        if !waits || (state.is_stopped() && !state.is_finishing()) {
            return;
        }
        let candidate = self.candidates.remove(0);
        let stage = if state.is_finishing() { "finishing the best plan" } else { "deciding" };
        let before = state.begin(stage);
        let positions = candidate.positions.clone();
        let ranked = candidate.drapes.as_ref().and_then(|drapes| drapes.worst.effort);
        // what was decided before is read from the journal, and counts as if it were draped now
        let key = journal::key(&positions, None, &state.cells());
        let (strategy, refused) = (candidate.strategy, candidate.fails_often);
        let choice = match state.decided(key) {
            Some(known) => {
                for _ in 0..known.drapes {
                    let plan = Some((Some(strategy), positions.as_slice()));
                    state.record(&known.judged, known.score, true, plan);
                }
                Ok(Choice { strategy, positions, known, decision: None, refused })
            }
            None => {
                let made = Decision::on(scene, Some(strategy), positions.clone(), ranked, state);
                made.map(|decision| {
                    let known = decision.known();
                    state.keep_decision(key, &known);
                    Choice { strategy, positions, known, decision: Some(decision), refused }
                })
            }
        };
        state.begin(before);
        match choice {
            // what the end of the search broke off is decided on when it is finished
            Ok(cut) if state.is_cut_short(&cut.known.judged) && !state.is_finishing() => {
                self.candidates.push(candidate);
            }
            Ok(choice) => {
                // later candidates are draped with the cell that refused this one
                if let Some(cell) = choice.known.refused_by {
                    state.add_cell(cell);
                }
                let mut ranking = lock(&self.shared.ranking);
                if let (Mesh::Coarse, Some(ranked)) = (ranking.mesh, candidate.drapes) {
                    ranking.bias.learn(&ranked.worst, &choice.known.judged);
                }
                drop(ranking);
                let key = |choice: &Choice| (!choice.is_accepted(), choice.score());
                if self.best.as_ref().is_none_or(|best| key(&choice) < key(best)) {
                    self.best = Some(choice);
                }
            }
            Err(fault) => self.fault = self.fault.take().or(Some(fault)),
        }
        // coarse scores of all that wait are corrected by what was learned
        let bias = lock(&self.shared.ranking).bias.clone();
        for candidate in &mut self.candidates {
            if let Some(drapes) = &candidate.drapes {
                candidate.score = drapes.score(&bias);
            }
        }
        self.rank();
    }
}

impl Shared<'_, '_> {
    /// The candidate of a strategy; none once the search is stopped.
    fn candidate(&self, strategy: Strategy) -> Option<Candidate> {
        if self.state.is_stopped() {
            return None;
        }
        Some(self.along(strategy, self.fronts.positions(strategy)?))
    }

    /// The candidate with these positions (m).
    fn along(&self, strategy: Strategy, positions: Vec<Vec<Point>>) -> Candidate {
        let Ranking { mesh, bias } = lock(&self.ranking).clone();
        let key = journal::key(&positions, Some(mesh), &self.state.cells());
        if let Some(score) = self.state.scored(key) {
            return Candidate::new(strategy, positions, score);
        }
        let ranked = self.fronts.rank(&positions, mesh, &bias, self.state);
        let (score, drapes) = ranked.unwrap_or_else(|fault| {
            *lock(&self.fault) = Some(fault);
            (f64::INFINITY, None)
        });
        if let Some(drapes) = &drapes {
            let plan = Some((Some(strategy), positions.as_slice()));
            self.state.record(&drapes.worst, score, false, plan);
        }
        let unranked = drapes.as_ref().map(|_| key);
        Candidate { drapes, unranked, ..Candidate::new(strategy, positions, score) }
    }
}
