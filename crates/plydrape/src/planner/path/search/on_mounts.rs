//! What a search does for grippers on mounts that give: a race of the best fronts, and a walk from the one that wins.
//!
//! A front that fails in one cell of fifty and one that fails in one of seven differ in one cell of eight. So the best of the coarse
//! ranking race with the mesh of the scene: each is draped in a few cells, and the better half goes on to twice as many others
//! (successive halving, Karnin, Koren and Somekh 2013). Each step of the walk is a race of two fronts against the one where it is.

use super::walk::Walk;
use super::{Candidate, Choice, Ranking, Search, Shared};
use crate::geometry::Point;
use crate::planner::evaluation::{self, Bias, Draped, Mesh};
use crate::planner::journal;
use crate::planner::path::strategy::Strategy;
use crate::planner::path::tuning::TUNING;
use crate::planner::search_state::lock;
use crate::planner::tuning;
use rayon::prelude::*;

/// A front that is draped in one cell after the other, with the mesh of the scene.
pub struct Racer<'a> {
    strategy: Strategy,
    positions: Vec<Vec<Point>>,
    /// The drape without errors, once it was needed.
    draped: Option<Draped<'a>>,
    /// The scores of its drapes, that without errors first.
    scores: Vec<f64>,
    /// In how many of its cells a limit is broken.
    broken: usize,
}

impl Racer<'_> {
    /// The mean of its first scores.
    fn mean_of(&self, count: usize) -> f64 {
        self.scores.iter().take(count).sum::<f64>() / count.min(self.scores.len()) as f64
    }

    /// The mean of all of its scores.
    fn score(&self) -> f64 {
        self.mean_of(self.scores.len())
    }

    /// Cells that it was draped in.
    fn cells(&self) -> usize {
        self.scores.len().saturating_sub(1)
    }

    fn candidate(&self) -> Candidate {
        let Racer { strategy, ref positions, .. } = *self;
        let fails_often = self.fails_often();
        Candidate { fails_often, ..Candidate::new(strategy, positions.clone(), self.score()) }
    }

    /// Whether so many of its cells break a limit that a sample would refuse it.
    fn fails_often(&self) -> bool {
        self.broken > tuning::TUNING.spare[1]
    }
}

impl<'a> Search<'a, '_> {
    /// Races fronts that no coarse sheet has ranked, because it misjudges taut ones.
    pub(super) fn race_first(&mut self, fronts: &[Strategy]) {
        let shared = self.shared;
        let coarse = lock(&shared.ranking).clone();
        let candidate = |front: &Strategy| {
            Some(Candidate::new(*front, shared.fronts.positions(*front)?, f64::INFINITY))
        };
        self.candidates = fronts.par_iter().filter_map(candidate).collect();
        self.raced = self.race();
        if !self.is_done() {
            self.candidates.clear();
            self.rank_with(coarse);
            shared.state.begin("draping the first candidates");
        }
    }

    /// Races the best of those that wait with the mesh of the scene, by which candidates are ranked from now on, and decides on the best.
    /// Gives those that came to the end.
    pub(super) fn race(&mut self) -> Vec<Candidate> {
        if self.is_done() {
            return Vec::new();
        }
        let shared = self.shared;
        self.rank_with(Ranking { mesh: Mesh::Own, bias: Bias::default() });
        shared.state.begin("racing the best with the mesh of the scene");
        let mut waiting = std::mem::take(&mut self.candidates);
        waiting.truncate(TUNING.race.fronts.min(self.left));
        waiting.append(&mut self.raced);
        let racer = |candidate: Candidate| shared.racer(candidate.strategy, candidate.positions);
        let mut racers: Vec<Racer> = waiting.into_iter().filter_map(racer).collect();
        let cells = shared.state.race_cells();
        let mut decided = None;
        for (n, batch) in batches(&cells).into_iter().enumerate() {
            if self.is_done() {
                break;
            }
            self.left = self.left.saturating_sub(racers.len());
            racers.par_iter_mut().for_each(|racer| shared.run(racer, batch));
            racers.retain(|racer| !racer.scores.is_empty());
            racers.sort_by(|a, b| a.score().total_cmp(&b.score()));
            // rounds end after 1, 3, 7 batches
            let round_ends = (n + 2).is_power_of_two();
            if round_ends && racers.len() > TUNING.race.last {
                racers.truncate(racers.len().div_ceil(2));
            }
            if let (Some(best), true) = (racers.first().map(Racer::score), n > 0) {
                racers.retain(|racer| racer.score() <= TUNING.race.lag * best);
            }
            // one that has kept all limits in two rounds may do so in all others
            let faultless = racers.first().filter(|racer| round_ends && n > 0 && racer.broken == 0);
            if let (Some(racer), false) = (faultless, self.is_done()) {
                self.decide_on(racer, &mut decided);
            }
        }
        // those that fail too often are not worth a decision, but for the best
        let promising = |(n, racer): (usize, &Racer<'_>)| {
            (n == 0 || !racer.fails_often()).then(|| racer.candidate())
        };
        let promising = racers.iter().enumerate().filter_map(promising);
        self.candidates.extend(promising.filter(|next| Some(next.strategy) != decided));
        let finalists = racers.iter().map(Racer::candidate).collect();
        self.leader = racers.into_iter().next();
        self.rank();
        self.decide_on_waiting();
        finalists
    }

    /// Whether as many wait as race, all of them promising: on mounts they race before others are draped.
    pub(super) fn can_race(&self) -> bool {
        let is_promising = |c: &Candidate| c.score <= TUNING.search.promising_on_mounts;
        let promising = self.candidates.iter().filter(|c| is_promising(c)).count();
        self.on_mounts() && promising >= TUNING.race.fronts
    }

    /// Decides on those that wait, the best first, until one is accepted.
    pub(super) fn decide_on_waiting(&mut self) {
        for _ in 0..self.candidates.len() {
            if !self.is_done() {
                self.decide();
            }
        }
    }

    /// A walk downhill from the front that won the race, or else from the best that was decided on.
    pub(super) fn walk(&mut self) {
        let shared = self.shared;
        shared.state.begin("improving the best step by step");
        let best = |best: &Choice| shared.racer(best.strategy, best.positions.clone());
        let start = self.leader.take().or_else(|| self.best.as_ref().and_then(best));
        let Some(mut leader) = start else { return };
        let mut walk = Walk::new(leader.strategy);
        let mut decided = Some(leader.strategy);
        'walk: while !self.is_done() && !walk.is_over() {
            // cells that refused a plan count in what follows
            let cells = shared.state.race_cells();
            for number in 0..Walk::NUMBERS {
                let beside = walk.beside(number);
                if self.is_done() || self.left < beside.len() {
                    break 'walk;
                }
                self.left -= beside.len();
                let missing = &cells[leader.cells().min(cells.len())..];
                shared.run(&mut leader, missing);
                let racer = |front: Strategy| shared.racer(front, shared.fronts.positions(front)?);
                let mut racers: Vec<Racer> = beside.into_iter().filter_map(racer).collect();
                racers.par_iter_mut().for_each(|racer| shared.challenge(&leader, racer, &cells));
                let gained = |racer: &Racer<'_>| {
                    // one that is far from a plan without errors is draped in no cell
                    let is_whole = racer.scores.len() >= leader.scores.len();
                    is_whole && racer.score() < TUNING.walk.gain * leader.score()
                };
                let better = racers.into_iter().filter(gained);
                let better = better.min_by(|a, b| a.score().total_cmp(&b.score()));
                walk.go(number, better.as_ref().map(|racer| racer.strategy));
                leader = better.unwrap_or(leader);
                // one that hardly fails is not improved before it is decided on
                if !leader.fails_often() {
                    self.decide_on(&leader, &mut decided);
                }
            }
            self.decide_on(&leader, &mut decided);
        }
        self.decide_on(&leader, &mut decided);
        self.leader = Some(leader);
    }

    /// Decides on a racer if it is promising and another one than the last that was decided on.
    fn decide_on(&mut self, racer: &Racer<'_>, decided: &mut Option<Strategy>) {
        if *decided != Some(racer.strategy) {
            *decided = Some(racer.strategy);
            self.candidates.push(racer.candidate());
            self.rank();
            self.decide();
        }
    }
}

impl<'a> Shared<'a, '_> {
    /// A racer before its first drape; `None` where the grippers alone exceed a limit too far.
    fn racer(&self, strategy: Strategy, positions: Vec<Vec<Point>>) -> Option<Racer<'_>> {
        let is_possible = self.fronts.too_far(&positions).is_none();
        let (draped, scores, broken) = (None, Vec::new(), 0);
        is_possible.then_some(Racer { strategy, positions, draped, scores, broken })
    }

    /// Drapes a racer in the same cells as the one that leads, as long as it is not clearly worse.
    fn challenge<'s>(&'s self, leader: &Racer<'_>, racer: &mut Racer<'s>, cells: &[usize]) {
        for batch in batches(cells) {
            let before = racer.scores.len();
            self.run(racer, batch);
            let led = leader.mean_of(racer.scores.len());
            if racer.scores.len() == before || racer.score() > TUNING.race.lag * led {
                return;
            }
        }
    }

    /// Drapes a racer in some cells more, whatever limits they break.
    fn run<'s>(&'s self, racer: &mut Racer<'s>, cells: &[usize]) {
        let is_done = cells.is_empty() && !racer.scores.is_empty();
        if is_done || self.state.is_stopped() {
            return;
        }
        let Racer { positions, draped, .. } = racer;
        let key = journal::key(positions, Some(Mesh::Own), cells);
        let drapes = self.state.ranked(key, || {
            let draped = match draped {
                Some(draped) => draped,
                None => draped.insert(self.fronts.draped(positions, Mesh::Own, self.state)?),
            };
            Ok(draped.in_cells(cells, cells.len(), self.state))
        });
        match drapes {
            Ok(drapes) if !self.state.is_stopped() => {
                let known = usize::from(!racer.scores.is_empty());
                racer.scores.extend(drapes.each.iter().skip(known).map(evaluation::score));
                let in_cells = drapes.each.iter().skip(1);
                racer.broken += in_cells.filter(|judged| !judged.accepted()).count();
                let plan = Some((Some(racer.strategy), racer.positions.as_slice()));
                self.state.record(&drapes.worst, racer.score(), false, plan);
            }
            Ok(_) => {}
            Err(fault) => *lock(&self.fault) = Some(fault),
        }
    }
}

/// The cells of each round of a race; without cells one round, of the drape without errors.
fn batches(cells: &[usize]) -> Vec<&[usize]> {
    let rounds: Vec<&[usize]> = cells.chunks(TUNING.race.cells).collect();
    if rounds.is_empty() { vec![&[]] } else { rounds }
}
