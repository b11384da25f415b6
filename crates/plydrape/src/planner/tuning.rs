//! The tuning constants of the evaluation of a plan.
//!
//! None is a length, a force or a time. Lengths are in terms of a cell: a scaled scene has the scaled plan.

/// Constants of complete drapes along a plan and of their score.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlannerTuning {
    /// Largest distance between neighboring lines of the sheet that ranks candidates (of the pitch of the grippers). A
    /// fifth: cell middles hang and land as in a finer one, and a drape takes a tenth of the time.
    pub mesh: f64,
    /// Weight of the mean of all ratios of measures to limits beside the largest. 0.1, so that it decides only among
    /// plans that are about equally good at their worst.
    pub mean_weight: f64,
    /// Share of a limit that only has to be kept, up to which a measure does not count.
    pub counted_share: f64,
    /// Largest factor between a measure of a coarse sheet and that of a fine one, and its inverse the smallest, that is believed.
    pub largest_bias: f64,
    /// Cells with errors by which candidates are ranked, where the scene has errors, beside the drape without: few for rigid grippers; more for
    /// those on mounts, whose fronts differ in how often a cell fails.
    pub cells: [usize; 2],
    /// Cells with errors that prove a plan that is decided on, for rigid grippers and for those on mounts: of these as many as race.
    pub proving: [usize; 2],
    /// How many of them may break a limit: about the share that may in a sample. A front that breaks one in more of as many cells of a race
    /// is shown to no sample.
    pub spare: [usize; 2],
    /// How many of those that refused a plan are added to them.
    pub added_cells: usize,
    /// Cells that are draped at once: whole pairs, for two cores.
    pub batch: usize,
    /// Score without errors from which on those are not draped.
    pub far: f64,
    /// Equilibria a step on the average from which on a drape is broken off; good drapes take two or three.
    pub most_equilibria: usize,
    /// Score of a drape that was broken off, per share of the steps that are missing, and of a candidate that is not draped, per
    /// ratio to the limit that its grippers alone exceed: worse than that of any whole drape.
    pub missing_weight: f64,
    /// Factor by which a motion stays below the limits of tilt rates and of the tool, which are evaluated at samples only: between
    /// them a rate may be larger.
    pub sampled_margin: f64,
}

/// The constants in use.
pub const TUNING: PlannerTuning = PlannerTuning {
    mesh: 0.2,
    mean_weight: 0.1,
    counted_share: 0.9,
    largest_bias: 2.0,
    cells: [3, 12],
    proving: [16, super::path::tuning::TUNING.race.all_cells()],
    spare: [1, 2],
    added_cells: 3,
    batch: 4,
    far: 3.0,
    most_equilibria: 12,
    missing_weight: 1e3,
    sampled_margin: 1.001,
};
