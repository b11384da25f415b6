//! The tuning constants of a correction. None is a length.

/// Constants of the correction of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReplanTuning {
    /// Rounds in which the control points are improved until the path passes the moved steps. Each takes off a third of the roughest
    /// part of what is left and far more of a smooth part.
    pub rounds: usize,
    /// What is left (of the largest displacement) at which the rounds end: below what any robot resolves.
    pub passed: f64,
    /// Largest change of the distance of two neighboring grippers in a step, as a share of it: a tenth of the usual limit of overstretch.
    pub rigid: f64,
    /// Share of the smallest distance found along a straight way that is good enough as a lower bound of the distances of all its
    /// points: the search for a better bound costs more than it saves.
    pub loose: f64,
}

/// The constants in use.
pub const TUNING: ReplanTuning =
    ReplanTuning { rounds: 40, passed: 1e-10, rigid: 1e-4, loose: 0.5 };
