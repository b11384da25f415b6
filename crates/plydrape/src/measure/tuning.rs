//! The tuning constants of the measures.

/// Resolutions of the measures and rounding of the verdicts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MeasureTuning {
    /// Share of a limit by which a value may exceed it: a slope that is held exactly at its limit does not break it.
    pub limit_rounding: f64,
    /// Residual (a slope) up to which an equilibrium counts as found: the one at which a stalled solve still counts as
    /// converged, [`crate::equilibrium::EquilibriumTuning::rounding_residual`].
    pub equilibrium_residual: f64,
    /// Shortest length over which a strain has a meaning, in contact tolerances: the tolerance alone strains a segment of ten
    /// tolerances by 0.5 %.
    pub gauge_length: f64,
    /// Shortest time over which a rate is taken, as a share of the motion's time. 0.01: the steps of a drape are uneven in time,
    /// and a rate over the shortest of them would be mostly rounding.
    pub rate_window: f64,
    /// Resolution of a depth, as a share of the contact tolerance. 0.01: far finer than the limit.
    pub depth_resolution: f64,
    /// Most parts of a gripper's path that are evaluated; a path of 1 m that slides on the mold needs half a million.
    pub path_parts: usize,
    /// Distance outside the workspace, as a share of the shorter side of a cell, that is rounding.
    pub workspace_rounding: f64,
}

/// The constants in use.
pub(crate) const TUNING: MeasureTuning = MeasureTuning {
    limit_rounding: 1e-9,
    equilibrium_residual: 1e-6,
    gauge_length: 10.0,
    rate_window: 0.01,
    depth_resolution: 0.01,
    path_parts: 4_000_000,
    workspace_rounding: 1e-8,
};
