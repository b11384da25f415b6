//! The constants of the elastica. Lengths and forces are those of a strip of unit length and weight.

/// Every tuning constant.
#[derive(Debug, Clone, Copy)]
pub(super) struct ElasticaTuning {
    /// Widest panel.
    pub panel: f64,
    /// Largest turn of the flexible catenary in a panel (rad): the polynomials follow it to about 1e-11.
    pub turn: f64,
    /// Width of the panels at the ends, in widths of the bending layer.
    pub layer: f64,
    /// Narrowest panel: thinner layers take no part in shape and force that can be seen.
    pub narrowest: f64,
    /// Stiffness EI/(wL³) at which the search starts from the flexible catenary, if the strip is stiffer.
    pub start: f64,
    /// Stiffness at which the search for a cantilever starts, if the strip is limper: it is all but straight there.
    pub stiff: f64,
    /// Largest turn of a node in one Newton step (rad); longer steps are shortened.
    pub largest_turn: f64,
    /// Newton steps of one point of the continuation.
    pub iterations: usize,
    /// Turn of all nodes (rad) below which Newton's method has ended: quadratic convergence leaves rounding.
    pub small_turn: f64,
    /// First step of the continuation, from 0 to 1, and the smallest.
    pub steps: [f64; 2],
    /// Slack as a share of the length below which a strip is straight, but for rounding.
    pub slack: f64,
}

pub(super) const TUNING: ElasticaTuning = ElasticaTuning {
    panel: 0.125,
    turn: 0.4,
    layer: 2.0,
    narrowest: 1e-6,
    start: 1e-4,
    stiff: 10.0,
    largest_turn: 0.5,
    iterations: 40,
    small_turn: 1e-9,
    steps: [0.5, 1e-5],
    slack: 1e-12,
};
