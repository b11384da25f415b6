//! The tuning constants of the mold. None is a length.

/// Tolerances and limits of the questions that a mold answers. They are the engine's own, not the user's.
///
/// Lengths enter only as ratios, so a mold and its scaled copy give the same answers; tolerances of rounding are
/// relative to the coordinates, because these are what is rounded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MoldTuning {
    /// Newton steps for a closest point of a height field, or for its point on a vertical line; from above a mold it
    /// takes three to six.
    pub newton_steps: usize,
    /// Newton step, relative to the coordinates, after which a closest point is found. 1e-7: convergence is
    /// quadratic, so what is left is below rounding.
    pub newton_step: f64,
    /// Newton step, relative to the coordinates, that is taken unseen, because it is too small to show in the distance.
    pub unseen_step: f64,
    /// Smallest share of a Newton step that a line search tries.
    pub smallest_share: f64,
    /// Gradient of the squared distance, relative to the coordinates, that counts as none.
    pub stationary: f64,
    /// Determinant of the Hessian of the squared distance, as a share of that without the curvature of the mold, below
    /// which the step is taken without it.
    pub positive: f64,
    /// Share of the distance, or of the coordinates, by which a point may lie off to the side of the boundary of a height field
    /// and still count as over it.
    pub aside_of_domain: f64,
    /// Relative step below which a coordinate has converged to rounding.
    pub rounding: f64,
    /// Distance from a mesh, relative to the coordinates, below which its direction is lost in rounding.
    pub direction: f64,

    /// Turn of tangent or normal that a step along a section curve aims at (rad): the error of an arc is then some 1e-11
    /// of its length.
    pub turn: f64,
    /// Turn above which a step is tried again shorter (rad).
    pub largest_turn: f64,
    /// Step below which a turn is accepted whatever it is, as a share of the curve: at a kink no step turns less.
    pub kink_step: f64,
    /// Shortest step, as a share of the curve.
    pub shortest_step: f64,
    /// Most points of a section curve.
    pub curve_points: usize,
    /// Most steps that are tried for a section curve, those that were too long among them.
    pub curve_trials: usize,
    /// Distance from the mold, relative to the coordinates, at which a point of a section curve is on it. 1e-13: close
    /// to rounding, because Newton's method gets there in two or three steps.
    pub on_mold: f64,
    /// Newton steps for that.
    pub on_mold_steps: usize,
    /// Newton steps for the end of a curve over a horizontal distance.
    pub run_steps: usize,
    /// Run of a unit tangent, or vertical part of a unit normal, below which a mold counts as upright.
    pub upright: f64,

    /// Distance of two points, relative to their coordinates, up to which they are one.
    pub same_point: f64,
    /// Horizontal distance of two points, as a share of their distance, below which one is above the other.
    pub above: f64,
    /// Distance from its goal, as a share of the chord, within which a section curve has arrived. 1e-5: points from
    /// measurements and files are not on the mold to the last digit.
    pub arrival: f64,

    /// Steps of sphere tracing from above.
    pub tracing_steps: usize,
    /// Distance from the mold, as a share of the height that is traced, below which Newton's method takes over.
    pub tracing_end: f64,
    /// Shortest step of sphere tracing, as a share of that height.
    pub tracing_step: f64,
    /// Distance from the mold, as a share of that height, at which a traced point is on the mold, and Newton step after
    /// which it is: convergence is quadratic.
    pub tracing_tolerance: f64,

    /// Distance of two vertices, as a share of the mesh's diagonal, up to which they are merged. 1e-6: text files have
    /// six digits.
    pub merge: f64,
    /// Height of a triangle, as a share of its longest side, below which it has no area.
    pub needle: f64,
    /// Distance of the vertex of a cap from the ends of its side, in greatest heights of a cap, from which it is one.
    pub cap_flatness: f64,
    /// Share of the shorter of two sides over which both must run beside each other to face each other over a gap.
    pub beside: f64,
    /// Cosine of the angle between two sides up to which they run beside each other.
    pub parallel_sides: f64,
    /// Cosine of the angle between what points away from two faces across their sides, from which they lie back to back, as
    /// the two faces of a thin sheet: 26°.
    pub back_to_back: f64,
    /// Most rounds of stitching; in each, vertices become one or sides are divided. Where k faces meet it takes k rounds.
    pub stitch_rounds: usize,
    /// Radii of the rings that give the surface around a detail, in widths of the widest detail: a triangle in it is off its
    /// middle, and all of the detail shall lie within them.
    pub rings: [f64; 2],
    /// Points of each ring.
    pub ring_points: usize,
    /// Share of the points of both rings that the mold must have, and that must lie on the surface around a detail.
    pub ring_share: f64,
    /// Rounds in which the weights of these points are made anew.
    pub ring_rounds: usize,
    /// Distance from the surface around a place, in median distances of the points that it is made from, up to which a place
    /// lies on it.
    pub off_surface: f64,
    /// Difference of two unit normals within the width of a detail below which there is no detail: 30°.
    pub rough: f64,
    /// Upward part of a unit normal below which a triangle is a wall.
    pub wall: f64,
    /// Most triangles that are looked at for details; a mesh with more near sharp turns is rough everywhere.
    pub most_rough: usize,
    /// Share of the boundary of a detail that may go on at its own level.
    pub open_share: f64,
    /// Most corners of a cap.
    pub cap_corners: usize,
    /// Distance in plan, as a share of the width of the widest detail, up to which two points are above each other.
    pub same_in_plan: f64,
    /// Directions in which the extent of a detail is measured.
    pub extents: usize,
    /// Share of the area of a circle of the same perimeter below which a detail is long and narrow.
    pub slender: f64,
    /// Longest extent of a detail, as a multiple of its shortest, up to which it is round.
    pub round: f64,
    /// Upward part of the vector area of an open surface, as a share of its area, below which it faces sideways.
    pub sideways: f64,
    /// How far to the side of a boundary a point may lie and still count as over it, as a share of the mesh's diagonal
    /// and of the point's distance.
    pub aside: f64,
    /// Share by which the square of a known bound of a distance is taken larger, for rounding.
    pub bound_margin: f64,
    /// Share of a triangle by which a point may lie outside of it in plan.
    pub outside_in_plan: f64,
    /// Distance of a vertex from a cutting plane, as a share of the mesh's diagonal, up to which it lies in it.
    pub in_plane: f64,
    /// Distance of a point from a section curve, as a share of the mesh's diagonal, up to which it lies on it.
    pub on_curve: f64,
    /// Length of a section curve, as a multiple of the chord, at which it is no way to its goal any more.
    pub longest_way: f64,
    /// Points of a section curve for each triangle of a mesh at which it ends: a curve around a closed mesh crosses
    /// each triangle at most once a round.
    pub rounds: usize,

    /// Intervals along x and along y in which a formula is searched for undefined places; an even number, so that the
    /// middle is among them.
    pub formula_samples: usize,
    /// Parts along x and along y over each of which a formula is bounded: the more, the closer the bounds.
    pub formula_parts: usize,
}

/// The values in use.
pub(super) const TUNING: MoldTuning = MoldTuning {
    newton_steps: 60,
    newton_step: 1e-7,
    unseen_step: 1e-6,
    smallest_share: 1e-6,
    stationary: 1e-16,
    positive: 1e-3,
    aside_of_domain: 1e-12,
    rounding: 1e-15,
    direction: 1e-12,
    turn: 0.01,
    largest_turn: 0.012,
    kink_step: 1e-6,
    shortest_step: 1e-9,
    curve_points: 20_000,
    curve_trials: 200_000,
    on_mold: 1e-13,
    on_mold_steps: 6,
    run_steps: 8,
    upright: 1e-3,
    same_point: 1e-12,
    above: 1e-9,
    arrival: 1e-5,
    tracing_steps: 2000,
    tracing_end: 1e-4,
    tracing_step: 1e-9,
    tracing_tolerance: 1e-12,
    merge: 1e-6,
    needle: 1e-10,
    cap_flatness: 10.0,
    beside: 0.1,
    parallel_sides: 0.5,
    back_to_back: 0.9,
    stitch_rounds: 40,
    rings: [1.0, 1.6],
    ring_points: 24,
    ring_share: 0.6,
    ring_rounds: 12,
    off_surface: 5.0,
    rough: 0.517_638,
    wall: 0.05,
    most_rough: 50_000,
    open_share: 0.25,
    cap_corners: 200,
    same_in_plan: 1e-3,
    extents: 36,
    slender: 0.3,
    round: 1.1,
    sideways: 0.01,
    aside: 1e-9,
    bound_margin: 1e-6,
    outside_in_plan: 1e-12,
    in_plane: 1e-13,
    on_curve: 1e-9,
    longest_way: 4.0,
    rounds: 4,
    formula_samples: 64,
    formula_parts: 8,
};
