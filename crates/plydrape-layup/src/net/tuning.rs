//! The tuning constants of the net. Lengths are shares of the mesh width.

/// Tolerances and limits of the net of the ideal drape.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct NetTuning {
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
    /// Share of a cell on the ply from which it counts.
    pub counted_share: f64,
    /// Largest distance of the ply's boundary from the straight line between two of its points, as a share of the mesh width.
    pub boundary_sag: f64,
    /// Most times that the boundary is halved between two net lines where it bends.
    pub boundary_halvings: usize,
    /// Most halvings where the boundary leaves the mold: the place where it does is known to 10⁻⁹ of the mesh width.
    pub boundary_end_halvings: usize,
    /// Distance along the boundary, as a share of the mesh width, up to which two points are one.
    pub same_boundary_point: f64,
    /// Most times that a cell is halved to measure what of it lies off the mold: an eighth of its side follows the boundary of
    /// the mold by a straight line.
    pub area_halvings: usize,
    /// Times that a side of such a part is halved to find where the mold ends on it.
    pub area_end_halvings: usize,
    /// Angle (rad) by which a mesh must turn across an edge for it to be sharp.
    pub sharp: f64,
    /// Longest part of a sharp edge that is looked for under the ply, as a share of the mesh width.
    pub edge_part: f64,
    /// Distance, as a share of the mesh width, up to which a place of the mold is under a cell.
    pub under: f64,
    /// Distance of a target boundary from the mold, as a share of the mesh width, beyond which it belongs to another mold.
    pub curve_distance: f64,
    /// Seeds tried along u and along v.
    pub seeds: usize,
    /// Most nodes of the net that a search compares choices with.
    pub search_nodes: usize,
    /// Angle between the headings that are tried first (rad), a whole part of a turn.
    pub heading_step: f64,
    /// Times that the angle between headings is halved around the best.
    pub heading_halvings: usize,
    /// Difference of the largest shear (rad) up to which choices are alike.
    pub alike: f64,
    /// Most corrections that bring the middle of the ply to its place.
    pub corrections: usize,
    /// Distance of the middle from its place, as a share of the mesh width, and turn there (rad), at which the net of the scene
    /// has reached it.
    pub in_place: f64,
    /// Distance (of the mesh width) and turn (rad) at which the net that choices are compared with is in place, and up to which one may be taken.
    pub about_in_place: f64,
    /// Choices that are compared once more with the net of the scene.
    pub finalists: usize,
}

/// The constants in use.
pub(crate) const TUNING: NetTuning = NetTuning {
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
    counted_share: 0.5 - 1e-9,
    boundary_sag: 1e-3,
    boundary_halvings: 6,
    boundary_end_halvings: 30,
    same_boundary_point: 1e-6,
    area_halvings: 3,
    area_end_halvings: 12,
    sharp: 30.0 / 180.0 * std::f64::consts::PI,
    edge_part: 0.1,
    under: 0.75,
    curve_distance: 1.0,
    seeds: 7,
    search_nodes: 900,
    heading_step: std::f64::consts::PI / 12.0,
    heading_halvings: 4,
    alike: 0.01 / 180.0 * std::f64::consts::PI,
    corrections: 12,
    in_place: 1e-6,
    about_in_place: 2e-3,
    finalists: 3,
};
