//! Units of the integers that the page is drawn from.

/// Micrometers in a meter.
pub(super) const MICRO: f64 = 1e6;

/// A place (m) in whole micrometers.
pub(super) fn micrometers(place: &[f64; 3]) -> [i32; 3] {
    place.map(|c| (c * MICRO).round() as i32)
}

/// An angle (°) in whole hundredths.
pub(super) fn hundredths(degrees: f64) -> i32 {
    (degrees * 1e2).round() as i32
}

/// A coordinate (m) to the nearest micrometer, in the fewest digits.
pub(super) fn short(coordinate: f64) -> f64 {
    (coordinate * MICRO).round() / MICRO
}
