//! The tuning constants of the ply. All are shares of its own lengths.

/// Limits at which a free segment or a cell degenerates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PlyTuning {
    /// Length of a free segment, as a share of its catenary, up to which it has no length. 1e-9: shorter segments are left by
    /// rounding.
    pub shortest_segment: f64,
    /// Path of a free segment, as a share of its fabric, below which it is a fold. At one half a catenary sags by four
    /// fifths of its run, three times as far as small-sag theory holds.
    pub shortest_path: f64,
    /// Length that the shorter diagonal of a folded cell keeps, as a share of the shorter side: an element needs a
    /// length.
    pub folded_diagonal: f64,
    /// Relative length by which a diagonal must exceed that of the flat cell to count as stretched. 1e-12: above the
    /// rounding of a path.
    pub shear_rounding: f64,
    /// Cosine of the shear angle up to which a cell counts as folded and its angle has no derivative.
    pub folded_cosine: f64,
    /// How far cups may be off one yarn and still be on it, as a share of their pitch. 1e-3: places that are rounded to a tenth of a
    /// millimeter; the fabric between them is then longer than along the yarn by less than a millionth.
    pub same_yarn: f64,
    /// Largest share that the mold's curvature may add to the square of a diagonal. Beyond one half a cell is no small part
    /// of its mold, and the series does not hold.
    pub curvature_excess: f64,
}

/// The constants in use.
pub(crate) const TUNING: PlyTuning = PlyTuning {
    shortest_segment: 1e-9,
    shortest_path: 0.5,
    folded_diagonal: 1e-6,
    shear_rounding: 1e-12,
    folded_cosine: 1e-6,
    same_yarn: 1e-3,
    curvature_excess: 0.5,
};
