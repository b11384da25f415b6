//! The tuning constants of a motion. All but one are numbers; [`Tuning::still`] is a resolution of input.

/// Constants of the knots, the time law and the peaks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// Distance (m) up to which two positions are one: rounding of files, and less than any robot resolves.
    pub still: f64,
    /// A step shorter than this share of the mean step is merged with the one before, because it would be a stop.
    pub shortest_step: f64,
    /// A last sample closer to the end than this share of an interval gives way to the end.
    pub last_sample: f64,
    /// Rounds of the iteration of the knots.
    pub rounds: usize,
    /// Power of ρ that is applied in a round; 1 would overshoot, because neighbors change too.
    pub damping: f64,
    /// Least and largest factor of a spacing in a round.
    pub change: [f64; 2],
    /// Share of its neighbors in a smoothed spacing in the first round; it falls to 0 with the third power.
    pub smoothing: f64,
    /// Passes of smoothing in a round.
    pub passes: usize,
    /// Largest ratio of neighboring spacings at the start.
    pub growth: f64,
    /// Cruising speeds that are tried, as shares of the limit of speed.
    pub cruise: [f64; 5],
    /// Acceleration and jerk of bends that are tried, as shares of their limits.
    pub bend: [f64; 3],
    /// Accelerations of the time law that are tried, as shares of the limit.
    pub acceleration: [f64; 3],
    /// Jerks of the time law that are tried, as shares of the limit.
    pub jerk: [f64; 4],
    /// Relative error of the peaks while motions are compared: durations are then right to the same share.
    pub trial_tolerance: f64,
    /// Relative error of the peaks of the motion that is taken, and what the motion is longer for it.
    pub tolerance: f64,
    /// Times that an interval is halved at most: 2⁻²⁴ of a piece is less than any tolerance needs.
    pub halvings: u32,
    /// Share of the largest value by which the states of a time law that was read may miss each other: rounding of its rows.
    pub law_rounding: f64,
    /// Shortest and longest part of the pace of the quickest motion, whose square is a parabola in each, as shares of the motion.
    pub pace_parts: [f64; 2],
    /// Where the bounds are looked at in a part of the pace, from both its ends, as a share of it.
    pub pace_inside: f64,
    /// Most programs that are solved for the pace, and the share of time that one must gain for another.
    pub pace_rounds: usize,
    /// See [`Self::pace_rounds`].
    pub pace_gain: f64,
    /// Most iterations of the solver of a program, and its tolerance.
    pub pace_iterations: u32,
    /// See [`Self::pace_iterations`].
    pub pace_tolerance: f64,
    /// Angle (rad) below which its sine is the angle to the last digit, and the chord is the arc.
    pub small_angle: f64,
}

/// The constants in use.
pub const TUNING: Tuning = Tuning {
    still: 1e-9,
    shortest_step: 0.01,
    last_sample: 1e-6,
    rounds: 120,
    damping: 0.3,
    change: [0.5, 2.0],
    smoothing: 0.9,
    passes: 4,
    growth: 2.0,
    cruise: [1.0, 0.7, 0.5, 0.35, 0.25],
    bend: [1.0, 0.7, 0.5],
    acceleration: [1.0, 0.7, 0.5],
    jerk: [1.0, 0.7, 0.5, 0.35],
    trial_tolerance: 1e-2,
    tolerance: 1e-4,
    halvings: 24,
    law_rounding: 1e-9,
    pace_parts: [1e-5, 5e-3],
    pace_inside: 0.02,
    pace_rounds: 20,
    pace_gain: 1e-3,
    pace_iterations: 100,
    pace_tolerance: 1e-6,
    small_angle: 1e-8,
};
