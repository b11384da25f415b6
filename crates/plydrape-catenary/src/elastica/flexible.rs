//! The catenary of a strip that does not resist bending: where the search starts.
//!
//! With a = H/w and ξ = ℓ/(2a), the length L and the rise h give sinh ξ/ξ = √(L² − h²)/ℓ (Irvine 1981, *Cable structures*,
//! section 1.2). All lengths are those of a strip of unit length and weight.

/// Horizontal force, and vertical force at the second end, of a flexible strip.
#[derive(Debug, Clone, Copy)]
pub(super) struct Flexible {
    pub horizontal: f64,
    pub vertical_end: f64,
}

impl Flexible {
    /// The catenary of a strip of unit length, with slack, over a run and a rise.
    pub fn new(run: f64, rise: f64) -> Flexible {
        let chord = run.hypot(rise);
        // sinh ξ/ξ − 1, from the slack so that no digits cancel
        let wide = (1.0 - rise * rise).sqrt();
        let excess = (1.0 - chord) * (1.0 + chord) / (run * (wide + run));
        let xi = inverse(excess);
        let a = run / (2.0 * xi);
        let lift = (rise / (2.0 * a * xi.sinh())).asinh();
        Flexible { horizontal: a, vertical_end: a * (lift + xi).sinh() }
    }

    /// Slope angle at an arc length (rad).
    pub fn angle(&self, s: f64) -> f64 {
        (self.vertical_end - (1.0 - s)).atan2(self.horizontal)
    }
}

/// The ξ at which sinh ξ/ξ − 1 has a value above zero.
fn inverse(excess: f64) -> f64 {
    // the leading order from below, the exponential from above
    let mut xi = if excess < 3.0 {
        (6.0 * excess).sqrt()
    } else {
        let y = 2.0 * (1.0 + excess);
        (y.ln() * y).ln()
    };
    for _ in 0..60 {
        let (value, slope) = if xi < 0.5 {
            let y = xi * xi;
            let sum = |c: [f64; 6]| c.iter().rev().fold(0.0, |sum, c| sum * y + c);
            let factorials = [6.0, 120.0, 5040.0, 362_880.0, 39_916_800.0, 6_227_020_800.0];
            let value = y * sum(factorials.map(|f| 1.0 / f));
            let powers: [f64; 6] = std::array::from_fn(|n| 2.0 * (n as f64 + 1.0) / factorials[n]);
            (value, xi * sum(powers))
        } else {
            (xi.sinh() / xi - 1.0, (xi.cosh() - xi.sinh() / xi) / xi)
        };
        // Newton's method on the logarithm where the function is steep
        let step = if value > 1.0 {
            ((1.0 + value) / (1.0 + excess)).ln() * (1.0 + value) / slope
        } else {
            (value - excess) / slope
        };
        xi -= step;
        if step.abs() <= 1e-15 * xi {
            break;
        }
    }
    xi
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_gives_the_excess_back() {
        for xi in [1e-5, 0.01, 0.4, 0.6, 2.0, 7.0, 30.0] {
            let excess = if xi < 0.1 {
                xi * xi / 6.0 * (1.0 + xi * xi / 20.0 * (1.0 + xi * xi / 42.0))
            } else {
                f64::sinh(xi) / xi - 1.0
            };
            assert!((inverse(excess) / xi - 1.0).abs() < 1e-11, "{xi}: {}", inverse(excess));
        }
    }
}
