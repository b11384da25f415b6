//! Ticks: round numbers within a range, and their texts.

/// Size of tick labels (picture points).
pub(super) const TICK: f64 = 11.5;
/// Size of axis labels (picture points).
pub(super) const LABEL: f64 = 12.5;

/// Round numbers (mm) within a range (m), at most this many intervals.
pub(super) fn ticks(low: f64, high: f64, most: f64) -> Vec<f64> {
    round_numbers(low * 1e3, high * 1e3, most)
}

/// Round numbers within a range, at most this many intervals.
pub(super) fn round_numbers(low: f64, high: f64, most: f64) -> Vec<f64> {
    let raw = (high - low) / most.max(1.0);
    if !raw.is_finite() || raw <= 0.0 {
        return Vec::new();
    }
    let ten = 10f64.powf(raw.log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|m| m * ten);
    let step = steps.into_iter().find(|s| *s >= raw * 0.999).unwrap_or(10.0 * ten);
    let (first, last) = ((low / step - 1e-6).ceil(), (high / step + 1e-6).floor());
    if !(first.abs() < 1e12 && last - first < 1e3) {
        return Vec::new();
    }
    (first as i64..=last as i64).map(|k| k as f64 * step).collect()
}

/// A tick's text: no more digits than the tick needs.
pub(super) fn label(value: f64) -> String {
    let digits = (0..6).find(|d| {
        let shift = 10f64.powi(*d);
        (value * shift - (value * shift).round()).abs() < 1e-6 * shift.max(1.0)
    });
    let text = format!("{value:.*}", digits.unwrap_or(6) as usize);
    if text == "-0" { "0".into() } else { text.replace('-', "−") }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Ticks are round numbers inside the range; their texts carry no digits in vain.
    #[test]
    fn ticks_are_round() {
        assert_eq!(ticks(-0.012, 0.078, 4.0), [0.0, 50.0]);
        assert_eq!(ticks(0.0, 0.3, 6.0), [0.0, 50.0, 100.0, 150.0, 200.0, 250.0, 300.0]);
        assert_eq!(ticks(0.0, 0.0, 6.0), Vec::<f64>::new());
        assert_eq!([0.0, -50.0, 0.25, 1e-3 * 30.0].map(label), ["0", "−50", "0.25", "0.03"]);
    }
}
