//! Numbers as a user reads them.

use plydrape::measure::Unit;
use plydrape_io::store::shown;

/// A limit in the unit that its measure is recorded in, as it is shown: `0.5 mm`, `3°`, `0.05 %`.
pub fn shown(value: f64, unit: Unit) -> String {
    let number = short(without_noise(value * unit.factor));
    match unit.shown {
        "1" | "" => number,
        unit if unit.starts_with('°') => format!("{number}{unit}"),
        unit => format!("{number} {unit}"),
    }
}

/// A limit (SI) as a scene has it, in the unit that its measure is recorded in: `3 deg`.
pub fn written(value: f64, unit: Unit) -> String {
    let number = short(without_noise(value / unit.si));
    match unit.recorded {
        "1" | "" => number,
        unit => format!("{number} {unit}"),
    }
}

/// Millimeters, of meters.
pub fn millimeters(meters: f64) -> String {
    short(without_noise(meters * 1e3))
}

/// Degrees, of radians.
pub fn degrees(radians: f64) -> String {
    short(without_noise(radians.to_degrees()))
}

/// Six digits at most, without trailing zeros; very large and small values by powers of ten.
pub fn short(value: f64) -> String {
    shown::short(value, 6, 1e7)
}

/// A value with three digits.
pub fn rounded(value: f64) -> f64 {
    shown::rounded(value, 3)
}

/// Nine decimals; a zero without a sign.
fn without_noise(value: f64) -> f64 {
    (value * 1e9).round() / 1e9 + 0.0
}
