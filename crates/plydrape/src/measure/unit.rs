//! Units of measures: as they are recorded, and as limits show them.

/// One degree (rad).
pub(super) const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// A unit, and the one that limits are shown in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Unit of recorded values: `mm`, `deg`, `N`, `1`.
    pub recorded: &'static str,
    /// Unit that limits are shown in: `mm`, `°`, `N`, `%`.
    pub shown: &'static str,
    /// From the recorded value to the shown one.
    pub factor: f64,
    /// The recorded unit in SI units, radians and shares: 0.001 of millimeters.
    pub si: f64,
}

impl Unit {
    /// Millimeters.
    pub const MILLIMETER: Unit = Unit { si: 1e-3, ..Unit::plain("mm") };
    /// Newtons.
    pub const NEWTON: Unit = Unit::plain("N");
    /// Seconds.
    pub const SECOND: Unit = Unit::plain("s");
    /// Numbers without a unit.
    pub const NUMBER: Unit = Unit::plain("1");
    /// Counts.
    pub const COUNT: Unit = Unit::plain("");
    /// Slopes, rise over run.
    pub const SLOPE: Unit = Unit::plain("slope");
    /// Degrees.
    pub const DEGREE: Unit = Unit { recorded: "deg", shown: "°", factor: 1.0, si: DEGREE };
    /// Degrees a second.
    pub const DEGREE_PER_SECOND: Unit =
        Unit { recorded: "deg/s", shown: "°/s", factor: 1.0, si: DEGREE };
    /// Degrees per second squared.
    pub const DEGREE_PER_SECOND_SQUARED: Unit = Unit { si: DEGREE, ..Unit::plain("°/s²") };
    /// Shares of a whole, shown in percent.
    pub const SHARE: Unit = Unit { recorded: "1", shown: "%", factor: 1e2, si: 1.0 };

    /// A unit that is shown as it is recorded.
    #[must_use]
    pub const fn plain(name: &'static str) -> Unit {
        Unit { recorded: name, shown: name, factor: 1.0, si: 1.0 }
    }
}
