//! The tuning constants of the equilibrium. None is a length, a force or a moment.

/// Tolerances and limits of a [`super::Solver`].
///
/// Slopes are rise over run; forces, lengths and rigidities enter only as ratios, so a ply and its scaled copy
/// are solved alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tuning {
    /// Shear angle (rad) from which a shearing cell's plane prescribes the slopes around it alone; below it
    /// they are mixed with those of the unconstrained ply. 3°, because the slopes at the corners of the
    /// paper's example differ by up to 33° from the plane's at the onset of shear: over 3° of shear the
    /// grippers turn some ten times as fast as the cell shears.
    pub full_constraint: f64,
    /// Residual of the slopes at which a solve has converged. 1e-9: solutions are promised to 1e-6, and differences of
    /// them are taken.
    pub slope_tolerance: f64,
    /// Relative error of a length that a converged solve may leave. 1e-8, for the same promise.
    pub length_tolerance: f64,
    /// Residual of the slopes below which a line search that finds nothing better has met rounding, not an
    /// obstacle. 1e-6, because the objective is summed to about 1e-12 of itself and is flat to second order.
    pub rounding_residual: f64,
    /// Relative step of a force over which its element's derivatives may have been carried at a converged state.
    /// 2e-4: moments and gradients are then off by some 1e-11 of themselves.
    pub carried: f64,
    /// Newton steps after which a solve gives up; a regular one takes two to eight.
    pub iterations: usize,
    /// Smallest share of a Newton step that a line search tries.
    pub smallest_share: f64,
    /// Decrease of the objective that a step must bring, as a share of what its slope promises (Armijo).
    pub decrease: f64,
    /// Change of the objective that is rounding, relative to it.
    pub objective_rounding: f64,
    /// Change of a slope tried along a direction of negative curvature.
    pub far_step: f64,
    /// Rounds of the active set of slope limits in one step.
    pub active_sets: usize,
    /// Iterations of conjugate gradients for each unknown, at most 500 unknowns counted.
    pub linear_iterations: usize,
    /// Largest shift of the moment matrix's diagonal, as a multiple of its largest entry.
    pub largest_shift: f64,
    /// Share of the flexural rigidity from which the continuation starts.
    pub limp: f64,
    /// First growth of the rigidity from one solve of the continuation to the next; its root is taken where
    /// a solve fails.
    pub growth: f64,
    /// Growth below which the continuation gives up.
    pub smallest_growth: f64,
}

impl Default for Tuning {
    fn default() -> Self {
        Tuning {
            full_constraint: 3f64.to_radians(),
            slope_tolerance: 1e-9,
            length_tolerance: 1e-8,
            rounding_residual: 1e-6,
            carried: 2e-4,
            iterations: 100,
            smallest_share: 1e-9,
            decrease: 1e-4,
            objective_rounding: 1e-11,
            far_step: 0.2,
            active_sets: 12,
            linear_iterations: 2,
            largest_shift: 64.0,
            limp: 1e-4,
            growth: 4.0,
            smallest_growth: 1.05,
        }
    }
}
