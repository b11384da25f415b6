//! The tuning constants of the equilibrium. None is a length, a force or a moment.

/// Tolerances and limits of a [`super::Solver`].
///
/// Slopes are rise over run; forces, lengths and rigidities enter only as ratios, so a ply and its scaled copy
/// are solved alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EquilibriumTuning {
    /// Shear angle (rad) from which a shearing cell's plane prescribes the slopes around it alone; below it
    /// they are mixed with those of the unconstrained ply. 3°, because the slopes at the corners of the
    /// paper's example differ by up to 33° from the plane's at the onset of shear: over 3° of shear the
    /// grippers turn some ten times as fast as the cell shears.
    pub full_constraint: f64,
    /// Run of a span, as a share of its length, up to which it is a vertical line: no horizontal force, no catenary.
    pub vertical_run: f64,
    /// Vertical part of a unit normal up to which its plane stands upright and prescribes no slope.
    pub upright_plane: f64,
    /// Sine of the angle in plan below which two edges are parallel and span no plane for a diagonal.
    pub parallel_edges: f64,
    /// Residual of the slopes at which a solve has converged. 1e-9: solutions are promised to 1e-6, and differences of
    /// them are taken.
    pub slope_tolerance: f64,
    /// Relative error of a length that a converged solve may leave. 1e-8, for the same promise.
    pub length_tolerance: f64,
    /// Residual of the slopes below which a line search that finds nothing better is limited by rounding. 1e-6, because the objective is summed to about 1e-12 of itself and is flat to second order.
    pub rounding_residual: f64,
    /// Relative step of a force over which its element's derivatives may have been extrapolated at a converged state.
    /// 2e-4: moments and gradients are then off by some 1e-11 of themselves.
    pub extrapolation: f64,
    /// Change of an element's end slopes that its series takes. 1e-5: the force is off by the cube of it and the
    /// derivatives by its square, 1e-10 of themselves.
    pub series_slope: f64,
    /// Relative step of a force over which its derivatives may be extrapolated by their own derivatives. 1e-2: their error
    /// is its square, which vanishes as the slopes converge, because forces are then predicted ever better.
    pub series_force: f64,
    /// Relative step of a force after which the error of the next force is lost in rounding. 3e-6: line searches
    /// compare sums of forces, so that these are taken to their last digits.
    pub exact_force: f64,
    /// Relative step of a force up to which the length measured before the step bounds the error after it: the steps
    /// contract quadratically.
    pub small_force: f64,
    /// Evaluations of the length that a force close to its solution may take before it is searched for anew.
    pub force_steps: usize,
    /// Share of the length tolerance above which a length is met anew at the end of a solve.
    pub length_margin: f64,
    /// Multiple of its height above the buckling force beyond which a force's own rounding moves the length, so that
    /// the length is measured once more. 1e3: three digits of sixteen are lost there.
    pub buckling_rounding: f64,
    /// Newton steps after which a solve gives up; a regular one takes two to eight.
    pub iterations: usize,
    /// Smallest share of a Newton step that a line search tries.
    pub smallest_share: f64,
    /// Decrease of the objective that a step must bring, as a share of what its slope promises (Armijo).
    pub decrease: f64,
    /// Change of the objective that is rounding, relative to it.
    pub objective_rounding: f64,
    /// Share of the work promised by a step's first moments that its last moments may take back (moment-balance).
    pub uphill: f64,
    /// Change of a slope tried along a direction of negative curvature (min-force).
    pub far_step: f64,
    /// Largest change of a slope in one step (moment-balance): far from the solution no step is worth more than a
    /// fraction of a right angle.
    pub longest_step: f64,
    /// Rounds of the active set of slope limits in one step.
    pub active_sets: usize,
    /// Iterations of conjugate gradients for each unknown, at most 500 unknowns counted.
    pub linear_iterations: usize,
    /// Unknowns counted for that limit.
    pub linear_unknowns: usize,
    /// Unknowns up to which the linear system of a step is solved to [`EquilibriumTuning::linear_exact`], because that is
    /// cheap.
    pub few_unknowns: usize,
    /// Relative residual of the linear system of a few unknowns.
    pub linear_exact: f64,
    /// Relative residual of other linear systems, per largest change of a slope in the step before: a Newton step is
    /// worth no more digits than it will have.
    pub linear_share: f64,
    /// Smallest and largest relative residual that is required of them.
    pub linear_tolerance: [f64; 2],
    /// Relative residual of the linear system of a derivative.
    pub tangent_tolerance: f64,
    /// Relative residual of a linear system that rounding may leave.
    pub linear_rounding: f64,
    /// First shift of the moment matrix's diagonal, as a share of its largest entry.
    pub first_shift: f64,
    /// Growth of the shift from one trial to the next.
    pub shift_growth: f64,
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

impl Default for EquilibriumTuning {
    fn default() -> Self {
        EquilibriumTuning {
            // geometry: shearing cells, vertical spans, upright planes, parallel edges
            full_constraint: 3f64.to_radians(),
            vertical_run: 1e-3,
            upright_plane: 1e-6,
            parallel_edges: 1e-6,
            // when a solve has converged
            slope_tolerance: 1e-9,
            length_tolerance: 1e-8,
            rounding_residual: 1e-6,
            // the force of one element: by series or anew, and how exact
            extrapolation: 2e-4,
            series_slope: 1e-5,
            series_force: 0.01,
            exact_force: 3e-6,
            small_force: 1e-7,
            force_steps: 4,
            length_margin: 0.1,
            buckling_rounding: 1e3,
            // Newton steps of the slopes, and the search along them
            iterations: 100,
            smallest_share: 1e-9,
            decrease: 1e-4,
            objective_rounding: 1e-11,
            uphill: 0.5,
            far_step: 0.2,
            longest_step: 0.3,
            active_sets: 12,
            // linear systems of a step and of a derivative
            linear_iterations: 2,
            linear_unknowns: 500,
            few_unknowns: 64,
            linear_exact: 1e-13,
            linear_share: 0.01,
            linear_tolerance: [1e-12, 1e-4],
            tangent_tolerance: 1e-14,
            linear_rounding: 1e-10,
            // shifts of the moment matrix where it is not positive
            first_shift: 1.0 / 64.0,
            shift_growth: 4.0,
            largest_shift: 64.0,
            // continuation from a limp ply to its own rigidity
            limp: 1e-4,
            growth: 4.0,
            smallest_growth: 1.05,
        }
    }
}
