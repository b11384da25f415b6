//! The tuning constants of the drape. None is a length: contact is scaled by its tolerance, fabric by its own length.

/// Tolerances and limits of contact, steps and what is handed over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct DrapingTuning {
    /// Depth from which a span penetrates the mold, as a share of the contact tolerance. 1e-3: above the rounding of a
    /// distance, and far below a depth that is seen.
    pub penetration: f64,
    /// Stretch that a new contact may add to the free segment beside it, as a share of that segment. 1e-4: a tenth of
    /// the overstretch that a layup allows by default.
    pub contact_stretch: f64,
    /// Smallest share of a step to which a step is cut. 1/256: a fiber that still jumps farther than the tolerance then is
    /// reported as penetration.
    pub smallest_cut: f64,
    /// Rounds of contact and equilibrium at one place of the grippers before the step counts as unsolved. 50: regular
    /// steps take one to five.
    pub contact_rounds: usize,
    /// Share of the tolerance by which a bound of a distance must clear it. 1e-6: far above the rounding of distances.
    pub bound_margin: f64,
    /// Heights over the mold, in contact tolerances, between which a gripper turns from the ply's normal to the mold's. A
    /// gripper stands on the mold from one tolerance on. The ply's own slope is not resolved just above: a free
    /// segment of twenty tolerances beside the gripper leads down by one of them.
    pub landing_heights: [f64; 2],
    /// Length of a contact segment, as a share of its catenary, up to which its direction is not compared with the ideal
    /// drape. 1e-2: below it the direction is mostly the error of its two ends.
    pub shortest_direction: f64,
    /// Sine of the angle in plan below which the two diagonals of a cell are parallel and do not cross.
    pub parallel_diagonals: f64,
    /// Share of its run at both ends in which a diagonal is not drawn through the other one: half spans that short have no
    /// shape.
    pub crossing_margin: f64,
    /// Stretch of an edge, as a share of its length, beyond which a drape ends. 0.1: carbon fiber breaks at 1.5 to
    /// 2 %, and the crimp of a woven ply adds some percent.
    pub breaking_stretch: f64,
    /// Landing error of the first contact, as a share of the ply's longer side, that explains such a stretch.
    pub large_landing_error: f64,
}

/// The constants in use.
pub(crate) const TUNING: DrapingTuning = DrapingTuning {
    penetration: 1e-3,
    contact_stretch: 1e-4,
    smallest_cut: 1.0 / 256.0,
    contact_rounds: 50,
    bound_margin: 1e-6,
    landing_heights: [1.0, 10.0],
    shortest_direction: 1e-2,
    parallel_diagonals: 1e-9,
    crossing_margin: 0.01,
    breaking_stretch: 0.1,
    large_landing_error: 0.1,
};
