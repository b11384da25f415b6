//! How a solve ended, as data: every early end is counted.

/// How a solve ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Status {
    /// The slopes satisfy their rule, and every span has its length, both as measured at the end.
    Converged,
    /// The rule could not be satisfied further: no step improves it.
    Stalled,
    /// The iteration limit came first.
    IterationLimit,
    /// No force was found that gives a span its length.
    LengthNotMet,
}

impl Status {
    /// Name in reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Status::Converged => "converged",
            Status::Stalled => "stalled",
            Status::IterationLimit => "iteration-limit",
            Status::LengthNotMet => "length-not-met",
        }
    }
}

/// How the last solve went.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solved {
    /// How it ended.
    pub status: Status,
    /// Iterations on the slopes.
    pub iterations: usize,
    /// Optimality that is left, measured at the final state and scaled to a slope: the largest gradient of the
    /// rule at a slope that is not at its limit, divided by the gradient's own derivative to that slope.
    pub residual: f64,
    /// Largest relative error of a fabric length, |L − L_set(1 + H sec θ/EA)|/L_set, measured.
    pub length_residual: f64,
    /// What was cut short or replaced on the way; all zero in a plain solve.
    pub early_ends: EarlyEnds,
}

impl Solved {
    /// A state that depends on another one: both must have converged.
    #[must_use]
    pub fn and(self, other: Solved) -> Solved {
        Solved {
            status: if self.status == Status::Converged { other.status } else { self.status },
            iterations: self.iterations + other.iterations,
            residual: other.residual.max(self.residual),
            length_residual: other.length_residual.max(self.length_residual),
            early_ends: self.early_ends.plus(other.early_ends),
        }
    }

    /// The next solve of a continuation: its outcome, with the iterations and early ends of all.
    #[must_use]
    pub fn then(self, next: Solved) -> Solved {
        let mut early_ends = self.early_ends.plus(next.early_ends);
        early_ends.continuation += 1;
        Solved { iterations: self.iterations + next.iterations, early_ends, ..next }
    }
}

/// How often a part of a solve ended early or was replaced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct EarlyEnds {
    /// Line searches that found no better point.
    pub line_searches: u32,
    /// Conjugate gradients that reached their limit of iterations.
    pub linear_solves: u32,
    /// Directions of negative curvature (min-force) or unstable states (moment-balance) met on the way.
    pub negative_curvatures: u32,
    /// Newton steps whose set of active slope limits was still changing at the limit of its rounds.
    pub active_sets: u32,
    /// Newton steps whose diagonal was raised as far as it may be, without a stable matrix.
    pub damping_limits: u32,
    /// Solves of the continuation in stiffness that replaced the direct solve.
    pub continuation: u32,
}

impl EarlyEnds {
    /// The sums of both counts.
    #[must_use]
    pub fn plus(self, other: EarlyEnds) -> EarlyEnds {
        EarlyEnds {
            line_searches: self.line_searches + other.line_searches,
            linear_solves: self.linear_solves + other.linear_solves,
            negative_curvatures: self.negative_curvatures + other.negative_curvatures,
            active_sets: self.active_sets + other.active_sets,
            damping_limits: self.damping_limits + other.damping_limits,
            continuation: self.continuation + other.continuation,
        }
    }
}
