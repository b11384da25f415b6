//! The tuning constants of what both planners share.
//!
//! None is a length, a force or a time. Lengths are in terms of a cell: a scaled scene has the scaled plan.

use crate::scene::Scene;

/// Constants of evaluations and derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// Complete drapes along a plan and their score.
    pub evaluation: Evaluation,
    /// Derivatives that have no closed form.
    pub sensitivity: Sensitivity,
    /// Iterations of the interior point method for a quadratic program; it needs ten to thirty.
    pub program_iterations: u32,
    /// Unit of length of a quadratic program (cells): a millimeter for cells of 100 mm, the size of what grippers have left
    /// to correct, so that its residuals are neither tiny nor large.
    pub program_unit: f64,
}

/// Constants of the evaluation of a plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evaluation {
    /// Largest distance between neighboring lines of the sheet that ranks candidates (of the pitch of the grippers). A
    /// fifth: cell middles hang and land as in a finer one, and a drape takes a tenth of the time.
    pub mesh: f64,
    /// Weight of the mean of all ratios of measures to limits beside the largest. 0.1, so that it decides only among
    /// plans that are about equally good at their worst.
    pub mean_weight: f64,
    /// Largest ratio that counts in the mean, so that one very bad measure does not hide the others.
    pub largest_ratio: f64,
    /// Share of a limit that only has to be kept, up to which a measure does not count.
    pub counted_share: f64,
    /// Ratio to its limit below which a measure of a coarse sheet is not compared with that of a fine one.
    pub compared_share: f64,
    /// Least and largest factor between both that is believed.
    pub bias: [f64; 2],
    /// Cells with errors that are draped beside the one without, where the scene has errors: few, since a whole sample judges in
    /// the end.
    pub cells: usize,
    /// Score without errors from which on those are not draped.
    pub far: f64,
    /// Equilibria a step on the average from which on a drape is broken off; good drapes take two or three.
    pub most_equilibria: usize,
    /// Score of a drape that was broken off, per share of the steps that are missing: worse than that of any other.
    pub missing_weight: f64,
    /// How much faster grippers may turn between two steps of a plan than over the whole of both, within which the
    /// limit of the tilt rate is to hold for finer samples of the motion too.
    pub tilt_rate_margin: f64,
    /// How much slower a motion is made than its tool would allow, because its samples fall elsewhere then.
    pub tool_margin: f64,
}

/// Constants of derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sensitivity {
    /// Share of the largest derivative of a quantity below which others of it are left out. 1e-4: a quadratic program for
    /// steps that the true model judges needs no more digits.
    pub negligible: f64,
    /// Distance (cells) up to which a gripper counts, at first: twice as far where derivatives there are not negligible. 4:
    /// they decay by a factor of 20 to 100 a cell.
    pub reach: usize,
    /// Share of the largest derivative of all quantities of a kind below which there is only rounding.
    pub noise: f64,
    /// Step of the central differences of a lying path's length (cells): small beside a mold's radii, large beside
    /// rounding.
    pub step: f64,
    /// Distance from the mold below which the gradient of the distance is the normal (cells).
    pub on_mold: f64,
    /// Step of a fraction of a span at which Newton's method for it ends.
    pub fraction: f64,
    /// Steps of that method at most.
    pub fraction_steps: usize,
    /// Cosine of the shear angle below which a cell is folded and shears no further.
    pub folded: f64,
}

/// The constants in use.
pub const TUNING: Tuning = Tuning {
    program_iterations: 60,
    program_unit: 0.01,
    evaluation: Evaluation {
        mesh: 0.2,
        mean_weight: 0.1,
        largest_ratio: 10.0,
        counted_share: 0.9,
        compared_share: 0.3,
        bias: [0.5, 2.0],
        cells: 3,
        far: 3.0,
        most_equilibria: 12,
        missing_weight: 1e3,
        tilt_rate_margin: 1.5,
        tool_margin: 1.001,
    },
    sensitivity: Sensitivity {
        negligible: 1e-4,
        reach: 4,
        noise: 1e-9,
        step: 1e-5,
        on_mold: 1e-8,
        fraction: 1e-13,
        fraction_steps: 50,
        folded: 1e-6,
    },
};

/// The planners' unit of length: the shorter side of a cell (m).
pub(super) fn cell(scene: &Scene) -> f64 {
    scene.layup.ply.cell[0].min(scene.layup.ply.cell[1])
}
