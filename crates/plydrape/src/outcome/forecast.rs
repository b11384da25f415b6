//! How long drapes of the sheet will take, from what those before took on the same machine.
//!
//! A linear system of n nodes takes a time c w(n) with w(n) = n + n (n/n₀)^0.8: the energy is linear in the nodes, and the
//! factorization of a plane mesh takes nodes^1.8 operations (`benches/README.md`). c is measured ([`Pace`]): all time of the drapes before over the sum of
//! their w. How many systems a motion needs depends on the motion far more than on the mesh, so it is taken from a drape along it
//! that ranked it with another mesh; a finer one needs a little more, as (n/n′)^g.

use super::Flight;
use crate::layup::Layup;
use crate::sheet;
use std::time::Duration;

/// Constants of a forecast; medians of what `cargo bench -p plydrape-io --bench forecast` measures and prints.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Constants {
    /// Nodes n₀ of which the factorization takes as long as all else.
    pub even_nodes: f64,
    /// Power of the nodes by which the factorization takes longer than all else.
    pub factorization: f64,
    /// Power g of the nodes with which the number of linear systems grows.
    pub growth: f64,
    /// Linear systems in a step of a motion along which nothing was draped.
    pub solves: f64,
    /// Linear systems in a time step of a motion in its own time.
    pub real_solves: f64,
    /// Time of a drape with a step half-way between all steps beside that of the drape without (1).
    pub between: f64,
    /// Time of a drape with errors beside that of the drape without (1), where both share their flight.
    pub cell: f64,
    /// Time of a drape with errors beside that of the drape without (1), where each begins at its start.
    pub whole_cell: f64,
    /// c on a machine that has draped nothing yet (s).
    pub seconds: f64,
}

/// The constants in use.
pub const CONSTANTS: Constants = Constants {
    even_nodes: 3500.0,
    factorization: 0.8,
    growth: 0.13,
    solves: 6.5,
    real_solves: 2.0,
    between: 1.39,
    cell: 0.5,
    whole_cell: 1.25,
    seconds: 1e-6,
};

/// w, the time of a linear system of a sheet with this many nodes, in units of c.
fn work(nodes: usize) -> f64 {
    let Constants { even_nodes, factorization, .. } = CONSTANTS;
    let nodes = nodes as f64;
    nodes + nodes * (nodes / even_nodes).powf(factorization)
}

/// What a drape of the sheet took.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Nodes.
    pub nodes: usize,
    /// Linear systems that were solved.
    pub solves: usize,
    /// Time.
    pub time: Duration,
}

impl Effort {
    /// The effort of a finished drape.
    #[must_use]
    pub fn new(drape: &sheet::SheetDrape) -> Self {
        let sheet::Report { nodes, solves, .. } = drape.report;
        Effort { nodes, solves, time: drape.duration }
    }
}

/// How fast a machine drapes sheets: what it took so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pace {
    seconds: f64,
    work: f64,
}

impl Pace {
    /// Counts a drape.
    pub fn add(&mut self, effort: Effort) {
        self.seconds += effort.time.as_secs_f64();
        self.work += effort.solves as f64 * work(effort.nodes);
    }

    /// c (s): that of [`CONSTANTS`] before anything was draped.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        if self.work > 0.0 { self.seconds / self.work } else { CONSTANTS.seconds }
    }
}

/// How long drapes of the sheet along one motion will take; right within a factor of 1.5 by the benchmark `forecast`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// Nodes of the sheet.
    pub nodes: usize,
    /// Time of a drape by itself.
    pub drape: Duration,
    /// Drapes with minute changes and cells with errors that are draped to decide on a plan.
    pub cells: usize,
    /// Time of each of them beside that of the drape (1).
    pub cell: f64,
    /// Drapes that are made at once.
    pub threads: usize,
}

impl Forecast {
    /// A forecast for drapes of a sheet by its nodes, the linear systems that it needs, and a pace, on all threads.
    #[must_use]
    pub fn new(nodes: usize, solves: f64, pace: Pace) -> Self {
        let time = seconds(pace.seconds() * solves * work(nodes));
        Self::like(Effort { nodes, solves: solves as usize, time })
    }

    /// A forecast for drapes like one that is finished, on all threads.
    #[must_use]
    pub fn like(effort: Effort) -> Self {
        let (Effort { nodes, time: drape, .. }, cell) = (effort, CONSTANTS.cell);
        Forecast { nodes, drape, cells: 0, cell, threads: rayon::current_num_threads() }
    }

    /// The forecast for a layup, whose cells share a flight or do not.
    #[must_use]
    pub fn along(self, layup: &Layup) -> Self {
        let whole = !Flight::is_shared(layup);
        Forecast { cell: if whole { CONSTANTS.whole_cell } else { self.cell }, ..self }
    }

    /// Time of the decision on a plan, which ends earlier if it is refused: the drape, at once with it the one with a step half-way between
    /// all steps, then the cells.
    #[must_use]
    pub fn decision(&self) -> Duration {
        let alone = if self.threads > 1 { 0.0 } else { 1.0 };
        self.drape.mul_f64(CONSTANTS.between + alone) + self.sample(self.cells)
    }

    /// Time of what is left of that decision after a time, or of a sample of cells, once the drape is done up to one of its steps, or cells are:
    /// what was forecast, or, where that is over, what the steps that are done took for each of the others.
    #[must_use]
    pub fn left(
        &self,
        sample: Option<usize>,
        elapsed: Duration,
        step: Option<[usize; 2]>,
    ) -> Duration {
        let whole = sample.map_or_else(|| self.decision(), |cells| self.sample(cells));
        let left = whole.saturating_sub(elapsed);
        let by_steps = step
            .filter(|[done, _]| left.is_zero() && *done > 0)
            .map(|[done, of]| elapsed.mul_f64(of.saturating_sub(done) as f64 / done as f64));
        by_steps.unwrap_or(left)
    }

    /// Time of a sample of cells with errors.
    #[must_use]
    pub fn sample(&self, cells: usize) -> Duration {
        self.drape.mul_f64(self.cell * cells.div_ceil(self.threads.max(1)) as f64)
    }
}

/// The linear systems that a sheet with this many nodes needs, where one along the same motion with another mesh was draped.
#[must_use]
pub fn solves(nodes: usize, ranked: Effort) -> f64 {
    ranked.solves as f64 * (nodes as f64 / ranked.nodes.max(1) as f64).powf(CONSTANTS.growth)
}

/// A time (s) that may be beyond what a duration holds.
fn seconds(time: f64) -> Duration {
    Duration::try_from_secs_f64(time).unwrap_or(Duration::MAX / 1_000_000)
}
