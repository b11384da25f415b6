//! The tuning constants of derivatives. Lengths are in terms of a cell, the shorter side of a cell of the ply.

/// Constants of derivatives that have no closed form, and of what is left out of gradients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SensitivityTuning {
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
pub const TUNING: SensitivityTuning = SensitivityTuning {
    negligible: 1e-4,
    reach: 4,
    noise: 1e-9,
    step: 1e-5,
    on_mold: 1e-8,
    fraction: 1e-13,
    fraction_steps: 50,
    folded: 1e-6,
};
