//! The tuning constants of the stepwise planner.
//!
//! Lengths are in terms of a cell, the shorter side of a cell of the ply.

/// Constants of the stepwise planner, eqs. (15) and (16) of `docs/theory/planner.md`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepwiseTuning {
    /// Iterations of the interior point method for a quadratic program; it needs ten to thirty.
    pub program_iterations: u32,
    /// Unit of length of a quadratic program (cells): a millimeter for cells of 100 mm, the size of what grippers have left
    /// to correct, so that its residuals are neither tiny nor large.
    pub program_unit: f64,
    /// Times that a step is halved; in the first half of them grippers go down onto their targets.
    pub halvings: usize,
    /// Distance from its target at which a gripper that goes down is put on its target (cells). 5e-4: a stretch of less
    /// than the overstretch limit.
    pub snap: f64,
    /// Share of the overstretch limit that a step may use; the rest is for the last moves and for finer steps.
    pub stretch_share: f64,
    /// Stretch that the program allows an edge, as a share of the whole edge: a tenth of the default limit, because the
    /// program is linear.
    pub most_stretch: f64,
    /// Stretch that an edge should have, as a share of the whole edge: taut, at half of what the program allows.
    pub target_stretch: f64,
    /// Slack of an edge over a hollow beyond that with which it will lie in the hollow, as a share of the whole edge:
    /// too short an edge would bridge the hollow, too long a one is drawn taut at the end.
    pub hollow_slack: f64,
    /// Shares of the fabric of a span at which position errors are taken.
    pub points: [f64; 3],
    /// Height at which the position error of a point counts half (cells).
    pub near: f64,
    /// Weight below which the position error of a point is left out.
    pub least_weight: f64,
    /// Weights of the squares.
    pub weights: Weights,
    /// Rate of rise A over the largest curvature of the mold. 2.4: from 2 to 3 the slack is as small, see `benches/README.md`.
    pub rise: f64,
    /// Share of the tilt limit that the front may use; contact turns grippers a little further.
    pub tilt_share: f64,
    /// Least and largest slope of the straight part of the front, where the tilt leaves room for it.
    pub slopes: [f64; 2],
    /// Vertical part of the mold's normal below which its slope does not count as steeper.
    pub upright: f64,
    /// Least height of the front at the start (cells).
    pub base: f64,
    /// Height from which a gripper goes down in one step, over the tolerance of contact. 5: with 3, one of three weights
    /// of rolling broke the tilt limit on a cylinder.
    pub last: f64,
    /// Share of the move limit by which the front moves the grippers, so that they can also correct position errors.
    pub pace: f64,
    /// Factor by which the growth of the front is reduced until the grippers can follow, and most such reductions.
    pub reduction: (f64, usize),
    /// Distance from the form above the mold at which the ply has taken it (cells).
    pub formed: f64,
    /// Share of the steps after which the ply comes down even if it has not taken its form.
    pub forming_share: f64,
    /// Share of the move limit below which the grippers stand still.
    pub still: f64,
    /// Steps that are left at the end of rolling, for grippers that are late.
    pub late: usize,
    /// Distance of the front beyond the farthest gripper at the end (cells).
    pub beyond: f64,
    /// Removal of slack by the last moves.
    pub slack: Slack,
}

/// Weights of (15); all residuals are lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Height of a gripper.
    pub height: f64,
    /// Stretch of an edge; large, because its residuals are micrometers and those of heights millimeters.
    pub stretch: f64,
    /// Position error of a gripper anywhere.
    pub place: f64,
    /// Position error of a point on the mold.
    pub landing: f64,
    /// Rise of the ply from its contact. Small: from 0 to 0.1 the results differ by their scatter, 1 stops a plan.
    pub rolling: f64,
    /// Difference from the move before.
    pub smoothness: f64,
}

/// Constants of the removal of slack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slack {
    /// Most moves.
    pub moves: usize,
    /// Share of the limits of slack and of the landing error of grippers that is used.
    pub share: f64,
    /// Stretch that a slack segment gets, as a share of the whole edge.
    pub target_stretch: f64,
    /// Share of the overstretch limit that a move may use.
    pub stretch_share: f64,
    /// Weight of the stretch of a segment beside that of a gripper's move.
    pub weight: f64,
    /// Share of its edge below which the slack of a segment does not count.
    pub short: f64,
    /// Share of its edge below which two points of a line on the mold give no direction: what is less is rounding.
    pub shortest: f64,
    /// Rounds in which segments that have become slack are added.
    pub rounds: usize,
}

/// The constants in use.
pub const TUNING: StepwiseTuning = StepwiseTuning {
    program_iterations: 60,
    program_unit: 0.01,
    halvings: 6,
    snap: 5e-4,
    stretch_share: 0.5,
    most_stretch: 1e-4,
    target_stretch: 5e-5,
    hollow_slack: 2e-4,
    points: [0.25, 0.5, 0.75],
    near: 0.01,
    least_weight: 1e-3,
    weights: Weights {
        height: 1.0,
        stretch: 100.0,
        place: 1e-2,
        landing: 1.0,
        rolling: 1e-3,
        smoothness: 1e-2,
    },
    rise: 2.4,
    tilt_share: 0.8,
    slopes: [0.05, 0.35],
    upright: 1e-3,
    base: 0.1,
    last: 5.0,
    pace: 0.7,
    reduction: (0.8, 30),
    formed: 1e-3,
    forming_share: 0.5,
    still: 0.03,
    late: 5,
    beyond: 0.01,
    slack: Slack {
        moves: 3,
        share: 0.5,
        target_stretch: 2e-5,
        stretch_share: 0.8,
        weight: 1e3,
        short: 1e-2,
        shortest: 1e-9,
        rounds: 6,
    },
};
