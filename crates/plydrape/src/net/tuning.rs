//! The tuning constants of the net. Lengths are shares of the mesh width.

/// Tolerances and limits of the net of the ideal drape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Tuning {
    /// Distance of the seed from the mold, as a share of the smaller mesh width, up to which it lies on the mold.
    pub seed_distance: f64,
    /// Vertical part of the unit normal at the seed up to which the mold is upright there, so that a heading in plan has no
    /// direction on it.
    pub upright: f64,
    /// Largest pre-shear (rad): at 90° a cell has no area.
    pub largest_shear: f64,
    /// Cosine of the smallest angle between u and v of an open cell: 1°.
    pub smallest_angle_cosine: f64,
    /// Gap of a condition, as a share of the mesh width, at which a place is found: its last digits.
    pub gap: f64,
    /// Gap that is accepted where Newton's method cannot improve the place further. 1e-10: close to the boundary of a mesh
    /// or a grid its closest points are less exact.
    pub largest_gap: f64,
    /// Most trials for one place; a regular one takes three to six.
    pub trials: usize,
    /// Smallest share of a Newton step that is tried.
    pub smallest_share: f64,
    /// Largest Newton step, as a share of the mesh width: half of it, because a longer one may pass the next node.
    pub longest_step: f64,
    /// Square of the sine between two gradients below which they are parallel and meet in no place.
    pub parallel: f64,
    /// Most iterations of the secant method for the shear of one cell.
    pub shear_iterations: usize,
    /// Error of a cell's shear (rad) at which it is found.
    pub shear_error: f64,
    /// Error of a cell's shear (rad) that is accepted where the secant method cannot improve it further.
    pub largest_shear_error: f64,
    /// Largest turn of a cell's side in one iteration (rad).
    pub longest_turn: f64,
    /// Rate of the shear, as a share of the flat cell's, below which the secant method keeps the last rate.
    pub smallest_rate: f64,
    /// Distance beyond the boundary of the fabric, in mesh widths, that is rounding.
    pub boundary_rounding: f64,
}

/// The constants in use.
pub(crate) const TUNING: Tuning = Tuning {
    seed_distance: 1e-4,
    upright: 1e-6,
    largest_shear: 89.0 / 180.0 * std::f64::consts::PI,
    smallest_angle_cosine: 0.999_847_7,
    gap: 1e-13,
    largest_gap: 1e-10,
    trials: 60,
    smallest_share: 1e-4,
    longest_step: 0.5,
    parallel: 1e-10,
    shear_iterations: 30,
    shear_error: 1e-13,
    largest_shear_error: 1e-9,
    longest_turn: 0.3,
    smallest_rate: 0.1,
    boundary_rounding: 1e-9,
};
