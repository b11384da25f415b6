//! What a color stands for: heights evenly, gaps by their order of size.
//!
//! A ply comes in a hundred millimeters above its mold and ends within a few tenths. On an even scale the end
//! would be one color; by orders of size a bridge of a millimeter shows beside the start.

use super::axes;

/// Values of a color scale's ends, and how values in between are spaced.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Scale {
    /// Equal differences are equally far apart.
    Even([f64; 2]),
    /// Equal ratios are equally far apart; both ends are positive.
    Orders([f64; 2]),
}

impl Scale {
    /// Share of the way from the low to the high end; beyond 0 and 1 outside of them.
    pub fn share(self, value: f64) -> f64 {
        match self {
            Scale::Even([low, high]) => (value - low) / (high - low),
            Scale::Orders([low, high]) => (value.max(low) / low).ln() / (high / low).ln(),
        }
    }

    /// The scale in a unit of so many of its values, such as 1e3 for millimeters.
    pub fn times(self, factor: f64) -> Self {
        match self {
            Scale::Even(ends) => Scale::Even(ends.map(|end| end * factor)),
            Scale::Orders(ends) => Scale::Orders(ends.map(|end| end * factor)),
        }
    }

    /// Round values on the scale, not many more than `most`.
    pub fn ticks(self, most: f64) -> Vec<f64> {
        match self {
            Scale::Even([low, high]) => axes::round(low, high, most),
            Scale::Orders([low, high]) => {
                let tens = |x: f64| (x.log10() * (1.0 + 1e-12)).floor() as i32;
                let each = (tens(low)..=tens(high))
                    .flat_map(|ten| [1.0, 2.0, 5.0].map(|m| (m, m * 10_f64.powi(ten))));
                let within = |(_, tick): &(f64, f64)| *tick >= 0.999 * low && *tick <= 1.001 * high;
                let all: Vec<(f64, f64)> = each.filter(within).collect();
                let whole = all.len() as f64 <= most;
                all.into_iter().filter(|(m, _)| whole || *m == 1.0).map(|(_, tick)| tick).collect()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By orders of size, ten times as much is as far everywhere; ends are 0 and 1.
    #[test]
    fn every_order_of_size_is_equally_wide() {
        let scale = Scale::Orders([0.1, 100.0]);
        for (value, share) in [(0.1, 0.0), (1.0, 1.0 / 3.0), (10.0, 2.0 / 3.0), (100.0, 1.0)] {
            assert!((scale.share(value) - share).abs() < 1e-12);
        }
        assert_eq!(scale.share(0.0), 0.0);
        assert_eq!(scale.ticks(4.0).len(), 4);
        assert_eq!(scale.ticks(20.0).len(), 10);
        assert_eq!(Scale::Even([0.0, 10.0]).share(2.5), 0.25);
        assert_eq!(Scale::Orders([1e-4, 2e-3]).times(1e3).ticks(9.0), [0.1, 0.2, 0.5, 1.0, 2.0]);
    }
}
