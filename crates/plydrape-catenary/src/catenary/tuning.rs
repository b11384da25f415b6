//! The tuning constants of a span. All are numbers of its scaled equation: none is a length or a force.

/// Where a span's forms, panels and search change over.
///
/// They are constants of the program, not settings of a solve, so that the sums over panels are compiled for them.
/// Slopes are rise over run, widths of a layer multiples of 1/k, steps of H relative to its height above buckling.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CatenaryTuning {
    /// κ = Hℓ²/EI from which the exponential form is used. 25: the layers, e^(−5), no longer cancel there, and the
    /// series of the stiff form still has its last digits.
    pub taut_kappa: f64,
    /// Exponent beyond which a boundary layer is neglected. 45: e^(−45) = 3e-20.
    pub vanishing_exponent: f64,
    /// Share of a boundary layer that is neglected: 1e-20, for the same reason.
    pub vanishing_layer: f64,
    /// Slope range that one panel of the long rule takes to the last digits.
    pub sweep: f64,
    /// Slope range that the short rule takes to the last digits.
    pub short_sweep: f64,
    /// Where a layer's panels are cut if its amplitude is large, in units of 1/k. Beyond the last it no longer
    /// counts: e^(−24) = 4e-11.
    pub layer_grades: [f64; GRADES],
    /// k(0.6 + amplitude) up to which one panel of the long rule takes both layers of a span to about 1e-11.
    pub single_panel: f64,
    /// k(0.6 + amplitude) up to which one panel of the short rule takes both layers.
    pub short_panel: f64,
    /// Amplitude up to which one panel takes a whole layer to about 1e-11.
    pub weak_layer: f64,
    /// Most panels of a stretch. 256: a slope of thousands is a fold that no quadrature needs to resolve.
    pub panels: f64,
    /// Slack, as a share of the length, up to which a span is taut: the rounding of its chord.
    pub slack: f64,
    /// Evaluations of the arc length after which the search for H gives up; bisection alone needs about 60.
    pub evaluations: usize,
    /// Error of the length, as a share of it, up to which a span counts as solved. A root that is found has 1e-9 or less; 1e-6 is a
    /// micrometer in a meter.
    pub length_error: f64,
    /// Relative step of H below which the next error is lost in rounding: it is the square of the step.
    pub small_step: f64,
}

/// Number of cuts of a layer.
pub(super) const GRADES: usize = 3;

/// The constants in use.
pub(crate) const TUNING: CatenaryTuning = CatenaryTuning {
    taut_kappa: 25.0,
    vanishing_exponent: 45.0,
    vanishing_layer: 1e-20,
    sweep: 3.0,
    short_sweep: 2.0,
    layer_grades: [3.0, 9.0, 24.0],
    single_panel: 55.0,
    short_panel: 28.0,
    weak_layer: 1.0,
    panels: 256.0,
    slack: 1e-13,
    evaluations: 100,
    length_error: 1e-6,
    small_step: 1e-9,
};
