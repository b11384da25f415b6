//! Units of measures: as they are recorded, and as limits show them.

/// A unit, and the one that limits are shown in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Unit {
    /// Unit of recorded values: `mm`, `deg`, `N`, `1`.
    pub recorded: &'static str,
    /// Unit that limits are shown in: `mm`, `°`, `N`, `%`.
    pub shown: &'static str,
    /// From the recorded value to the shown one.
    pub factor: f64,
}

impl Unit {
    /// Millimetres.
    pub const MILLIMETRE: Unit = Unit::plain("mm");
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
    pub const DEGREE: Unit = Unit { recorded: "deg", shown: "°", factor: 1.0 };
    /// Degrees a second.
    pub const DEGREE_PER_SECOND: Unit = Unit { recorded: "deg/s", shown: "°/s", factor: 1.0 };
    /// Shares of a whole, shown in percent.
    pub const SHARE: Unit = Unit { recorded: "1", shown: "%", factor: 1e2 };

    /// A unit that is shown as it is recorded.
    #[must_use]
    pub const fn plain(name: &'static str) -> Unit {
        Unit { recorded: name, shown: name, factor: 1.0 }
    }
}
