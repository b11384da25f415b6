//! Newton's method on the offsets of the pads.
//!
//! The unbalanced force at a pad is r = f + m, that of the ply and that of the mount; a step solves K p = r with
//! K = −∂r/∂d. A line that becomes taut is a thousand times as stiff as one that hangs. So a step is cut where the work
//! r·p at its end has turned round: both forces are (nearly) the slope of an energy, and the step has crossed its lowest point.
//! A matrix is used again as long as its steps lower the unbalanced force well.

use super::super::coloring::Coloring;
use super::super::direction::Direction;
use super::super::solver::Solver;
use super::super::status::{Equilibrium, Status};
use super::super::tuning::Tuning;
use super::band::Band;
use super::force::Held;
use super::{Balance, Continuation, MountedSolver};
use crate::ply::{ContactSegment, Grid};

/// The stiffness of ply and mounts, factorized, and which unknowns its rows are.
#[derive(Debug, Clone)]
pub(super) struct Matrix {
    band: Band,
    unknowns: Unknowns,
    /// Cells to each side of a gripper within which it knows what the gripper does.
    reach: usize,
}

/// The unknowns: gripper and axis of each, and their numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Unknowns {
    pub list: Vec<(usize, usize)>,
    number: Vec<[Option<usize>; 3]>,
}

impl Unknowns {
    /// Those of pads in the air, numbered along the shorter side of the array so that the band is narrow.
    pub fn of(mounts: &MountedSolver, grid: Grid) -> Unknowns {
        let mut list = Vec::new();
        let mut number = vec![[None; 3]; grid.grippers()];
        let along_u = grid.nu <= grid.nv;
        let (inner, outer) = if along_u { (grid.nu, grid.nv) } else { (grid.nv, grid.nu) };
        for n in 0..inner * outer {
            let (fast, slow) = (n % inner, n / inner);
            let gripper = grid.index(if along_u { [fast, slow] } else { [slow, fast] });
            for axis in (0..3).filter(|axis| mounts.is_free(gripper, *axis)) {
                number[gripper][axis] = Some(list.len());
                list.push((gripper, axis));
            }
        }
        Unknowns { list, number }
    }

    /// Largest difference of the numbers of two grippers that are at most so many cells apart.
    fn half_band(&self, grid: Grid, cells: usize) -> usize {
        let mut half = 0;
        for &(gripper, axis) in &self.list {
            let [i, j] = grid.id(gripper);
            let own = self.number[gripper][axis].unwrap_or(0);
            for i in i.saturating_sub(cells)..(i + cells + 1).min(grid.nu) {
                for j in j.saturating_sub(cells)..(j + cells + 1).min(grid.nv) {
                    let others = self.number[grid.index([i, j])].iter().flatten();
                    half = others.fold(half, |most, other| most.max(own.abs_diff(*other)));
                }
            }
        }
        half
    }
}

impl Matrix {
    /// The matrix at a balance, shifted until it is positive; none where no shift helps.
    pub fn new(
        mounts: &MountedSolver,
        balance: &Balance,
        held: Held,
        unknowns: &Unknowns,
        reach: usize,
    ) -> Option<Matrix> {
        let (grid, lines) = (held.solver.ply().rows(), held.solver.lines());
        let coloring = Coloring::of(held.solver.ply(), reach);
        let half = if coloring.is_whole() {
            unknowns.list.len()
        } else {
            unknowns.half_band(grid, reach + 1)
        };
        let mut band = Band::new(unknowns.list.len(), half);
        for (n, reaction) in balance.reactions.iter().enumerate() {
            for (axis, row) in unknowns.number[n].iter().enumerate() {
                for (other, column) in unknowns.number[n].iter().enumerate() {
                    if let (Some(row), Some(column)) = (row, column) {
                        band.add(*row, *column, reaction.stiffness[axis][other]);
                    }
                }
            }
        }
        let mut linearized = held.solver.linearize(held.pads, held.contacts);
        let mut direction = Direction::none(grid.grippers());
        for group in 0..coloring.groups() {
            for axis in (0..3).filter(|axis| mounts.law.yields(*axis)) {
                let moved = |n: &usize| unknowns.number[*n][axis].is_some();
                let members: Vec<usize> = coloring.members(group).filter(moved).collect();
                if members.is_empty() {
                    continue;
                }
                members.iter().for_each(|n| direction.grippers[*n][axis] = 1.0);
                let tangent = linearized.along(&direction);
                held.changes(&direction, &tangent, |catenary, gripper, change| {
                    let c = lines.catenary(catenary);
                    let corner = [0, 1].map(|d| c.from[d].min(c.to[d]));
                    let Some((near, _)) = coloring.near(group, corner) else { return };
                    let Some(column) = unknowns.number[near][axis] else { return };
                    for (row, change) in unknowns.number[gripper].iter().zip(change) {
                        if let Some(row) = row {
                            band.add(*row, column, -change);
                        }
                    }
                });
                members.iter().for_each(|n| direction.grippers[*n][axis] = 0.0);
            }
        }
        let band = positive(band, held.solver.tuning())?;
        Some(Matrix { band, unknowns: unknowns.clone(), reach })
    }

    /// Solves with it, in place.
    pub fn solve(&self, x: &mut [f64]) {
        self.band.solve(x);
    }
}

/// The factors of a matrix, its diagonal raised as far as it must be, row by row in proportion to what stands there; none
/// where that does not help.
fn positive(band: Band, tuning: &Tuning) -> Option<Band> {
    let rows = band.row_sums();
    let mut shift = 0.0;
    loop {
        let mut factors = band.clone();
        rows.iter().enumerate().for_each(|(n, sum)| factors.add(n, n, shift * sum));
        if factors.factorize() {
            return Some(factors);
        }
        shift = if shift == 0.0 { tuning.first_shift } else { tuning.shift_growth * shift };
        if shift > tuning.largest_shift {
            return None;
        }
    }
}

/// A search under way.
struct Search<'a> {
    mounts: &'a mut MountedSolver,
    solver: &'a mut Solver,
    commanded: &'a [[f64; 3]],
    contacts: &'a [Option<ContactSegment>],
    tuning: Tuning,
    unknowns: Unknowns,
    /// Newton steps on the slopes, of all solves.
    iterations: usize,
}

/// A place of the pads and what is unbalanced there.
#[derive(Clone)]
struct Trial {
    balance: Balance,
    equilibrium: Equilibrium,
    residual: Vec<f64>,
}

impl Trial {
    fn size(&self) -> f64 {
        self.residual.iter().fold(0.0, |most, r| r.abs().max(most))
    }

    /// Unbalanced force as a share of the largest force.
    fn left(&self) -> f64 {
        let size = self.size();
        if size == 0.0 { 0.0 } else { size / self.balance.largest }
    }

    fn work(&self, step: &[f64]) -> f64 {
        self.residual.iter().zip(step).map(|(r, p)| r * p).sum()
    }
}

/// See [`MountedSolver::solve`].
pub(super) fn solve(
    mounts: &mut MountedSolver,
    solver: &mut Solver,
    commanded: &[[f64; 3]],
    contacts: &[Option<ContactSegment>],
    continuation: Continuation,
) -> Equilibrium {
    let unknowns = Unknowns::of(mounts, solver.ply().rows());
    let tuning = *solver.tuning();
    let mut search =
        Search { mounts, solver, commanded, contacts, tuning, unknowns, iterations: 0 };
    let (mut trial, mut is_balanced) = search.run();
    if !is_balanced && continuation == Continuation::IfNeeded {
        (trial, is_balanced) = search.stiffen(trial);
    }
    let iterations = search.iterations;
    search.mounts.balance = trial.balance;
    let mut equilibrium = Equilibrium { iterations, ..trial.equilibrium };
    if equilibrium.status == Status::Converged && !is_balanced {
        equilibrium.status = Status::MountsNotBalanced;
    }
    equilibrium
}

impl Search<'_> {
    /// The best place of the pads that was found, at which the solver is left, and whether it is one of balance.
    fn run(&mut self) -> (Trial, bool) {
        let mut at = match self.start() {
            Ok(trial) => trial,
            Err(trial) => return (*trial, false),
        };
        let mut reach = self.tuning.mount_reach;
        let mut matrix =
            self.mounts.matrix.take().filter(|matrix| matrix.unknowns == self.unknowns);
        let mut is_fresh = false;
        for _ in 0..self.tuning.mount_iterations {
            if at.left() <= self.tuning.mount_tolerance {
                self.mounts.matrix = matrix;
                return (at, true);
            }
            if matrix.is_none() {
                let held =
                    Held { solver: self.solver, pads: &at.balance.pads, contacts: self.contacts };
                matrix = Matrix::new(self.mounts, &at.balance, held, &self.unknowns, reach);
                is_fresh = true;
            }
            let Some(factors) = &matrix else { break };
            let mut step = at.residual.clone();
            factors.solve(&mut step);
            let next = self.step(&at, &step, is_fresh);
            let contraction = next.as_ref().map_or(f64::INFINITY, |next| next.size() / at.size());
            if contraction > self.tuning.mount_contraction {
                // a fresh matrix that knows too little of the ply gets to know more
                if is_fresh && contraction > 0.5 && factors.reach < self.widest() {
                    reach = 2 * factors.reach;
                }
                matrix = None;
            }
            match next {
                Some(next) => at = next,
                // the solver is where the last trial was: it goes back
                None if !is_fresh => {
                    if let Ok(same) = self.evaluate(&at.balance.offset.clone()) {
                        at = same;
                    }
                }
                None => {
                    let offset = at.balance.offset.clone();
                    let left = at.left();
                    if let Ok(same) = self.evaluate(&offset) {
                        at = same;
                    }
                    return (at, left <= self.tuning.mount_rounding);
                }
            }
            is_fresh = false;
        }
        let balanced = at.left() <= self.tuning.mount_rounding;
        (at, balanced)
    }

    /// By continuation in the stiffness of the mounts: soft ones let the ply hang, and their state leads to that of stiffer
    /// ones. `failed` is what the direct search ended with.
    fn stiffen(&mut self, failed: Trial) -> (Trial, bool) {
        let law = self.mounts.law;
        let Tuning { mount_soft, mut growth, smallest_growth, .. } = self.tuning;
        let (mut done, mut next) = (0.0, mount_soft);
        while growth > smallest_growth {
            let before = self.mounts.balance.clone();
            self.mounts.law = law.scaled(next);
            let (trial, is_balanced) = self.run();
            self.mounts.law = law;
            if !is_balanced {
                self.mounts.balance = before;
                growth = growth.sqrt();
                if done == 0.0 {
                    break;
                }
            } else if next >= 1.0 {
                return (trial, true);
            } else {
                self.mounts.balance = trial.balance;
                done = next;
            }
            next = f64::min(growth * done, 1.0);
        }
        let offset = failed.balance.offset.clone();
        (self.evaluate(&offset).unwrap_or_else(|trial| *trial), false)
    }

    /// Cells of the array's longer side.
    fn widest(&self) -> usize {
        let grid = self.solver.ply().rows();
        grid.nu.max(grid.nv)
    }

    /// Where the search starts: with the pads of the last balance, moved as the grippers have moved on average; else with
    /// its offsets; else with pads drawn together until no line that does not stretch is taut.
    fn start(&mut self) -> Result<Trial, Box<Trial>> {
        let last = self.mounts.balance.clone();
        let count = self.commanded.len() as f64;
        let mean = |part: &dyn Fn(usize, usize) -> f64| {
            [0, 1, 2]
                .map(|axis| (0..self.commanded.len()).map(|n| part(n, axis)).sum::<f64>() / count)
        };
        if last.pads.len() == self.commanded.len() {
            let way = mean(&|n, axis| {
                self.commanded[n][axis] - (last.pads[n][axis] - last.offset[n][axis])
            });
            let behind: Vec<_> = (last.pads.iter().zip(self.commanded))
                .map(|(pad, place)| [0, 1, 2].map(|n| pad[n] + way[n] - place[n]))
                .collect();
            if let Ok(trial) = self.evaluate(&behind) {
                return Ok(trial);
            }
        }
        let first = self.evaluate(&last.offset);
        if first.is_ok() {
            return first;
        }
        let middle = mean(&|n, axis| self.commanded[n][axis]);
        let mut share = self.tuning.mount_draw;
        while share < 0.5 {
            let drawn: Vec<_> = (self.commanded.iter().zip(&last.offset))
                .map(|(p, d)| [0, 1, 2].map(|n| d[n] + share * (middle[n] - p[n])))
                .collect();
            if let Ok(trial) = self.evaluate(&drawn) {
                return Ok(trial);
            }
            share *= 2.0;
        }
        first
    }

    /// The pads after a step: the whole one where the forces along it go on pulling, else as far as where their work turns
    /// round. None if no length of it is any good; a matrix that is not fresh must lower the unbalanced force at once.
    fn step(&mut self, from: &Trial, step: &[f64], is_fresh: bool) -> Option<Trial> {
        let first = from.work(step);
        let Tuning { mount_contraction, mount_overshoot, mount_trials, .. } = self.tuning;
        let (mut low, mut high, mut share) = (0.0, f64::INFINITY, 1.0);
        let mut best = None;
        for _ in 0..mount_trials {
            let mut offset = from.balance.offset.clone();
            for ((gripper, axis), p) in self.unknowns.list.iter().zip(step) {
                offset[*gripper][*axis] += share * p;
            }
            if offset == from.balance.offset {
                break;
            }
            let trial = self.evaluate(&offset).ok();
            if !is_fresh {
                return trial.filter(|trial| trial.size() < from.size());
            }
            let (work, size) = trial
                .as_ref()
                .map_or((f64::NEG_INFINITY, f64::INFINITY), |t| (t.work(step), t.size()));
            if size <= mount_contraction * from.size() || work.abs() <= mount_overshoot * first {
                return trial;
            }
            if work > 0.0 {
                // the forces go on pulling: a longer step, where one has been too long
                (low, best) = (share, trial);
                if high.is_infinite() {
                    break;
                }
            } else {
                high = share;
            }
            // the last trial that is good enough is kept where what is left is a jump
            if best.is_some() && high - low <= self.tuning.mount_jump * high {
                break;
            }
            share = if low > 0.0 { (low * high).sqrt() } else { self.tuning.mount_cut * high };
        }
        // the solver is left where the pads are
        let offset = best?.balance.offset;
        self.evaluate(&offset).ok()
    }

    /// Puts the pads at offsets (m) and solves the ply there; the error is a place where the ply has no equilibrium, or a
    /// taut line no force.
    fn evaluate(&mut self, offsets: &[[f64; 3]]) -> Result<Trial, Box<Trial>> {
        let mut offset = offsets.to_vec();
        let mut pads = self.commanded.to_vec();
        for n in 0..pads.len() {
            for axis in 0..3 {
                let standing = self.mounts.standing[n].map(|standing| standing.place);
                offset[n][axis] = match standing {
                    _ if !self.mounts.law.yields(axis) => 0.0,
                    Some(place) => place[axis] - self.commanded[n][axis],
                    None => offset[n][axis],
                };
                // one that stands does so to the last bit
                pads[n][axis] = match standing.filter(|_| self.mounts.law.yields(axis)) {
                    Some(place) => place[axis],
                    None => self.commanded[n][axis] + offset[n][axis],
                };
            }
        }
        let equilibrium = self.solver.solve(&pads, self.contacts);
        self.iterations += equilibrium.iterations;
        let held = Held { solver: self.solver, pads: &pads, contacts: self.contacts };
        let forces = held.forces();
        let is_known = forces.is_some() && equilibrium.status == Status::Converged;
        let (ply, span) = forces.unwrap_or_else(|| (vec![[0.0; 3]; pads.len()], 0.0));
        let (law, slip) = (self.mounts.law, &self.mounts.slip);
        let reactions: Vec<_> =
            offset.iter().zip(slip).map(|(offset, slip)| law.reaction(*offset, *slip)).collect();
        let forces = reactions.iter().map(|reaction| &reaction.force).chain(&ply).flatten();
        let largest = forces.fold(span, |most, c| c.abs().max(most));
        let residual = (self.unknowns.list.iter())
            .map(|(n, axis)| ply[*n][*axis] + reactions[*n].force[*axis])
            .collect();
        let balance = Balance { offset, pads, ply, reactions, largest };
        let trial = Trial { balance, equilibrium, residual };
        if is_known { Ok(trial) } else { Err(Box::new(trial)) }
    }
}
