//! e^(−x) for x ≥ 0, at several points side by side: the boundary layers of taut spans.
//!
//! x = n ln 2 + r with |r| ≤ ½ ln 2, and e^(−x) = 2⁻ⁿ e^(−r) with the Taylor series of e^(−r). The loops are free of
//! branches, so that the compiler works on several points at once, where the library's `exp` takes one.

use std::f64::consts::LOG2_E;

/// ln 2 in two parts: the first has so few digits that a multiple of it up to 2¹¹ is exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// x from which e^(−x) is taken for 0: its smallest normal number is e^(−708.4).
const UNDERFLOW: f64 = 700.0;

/// Terms of the series: 0.3466¹⁴/14! = 4e-18.
const TERMS: usize = 14;

const INVERSE_FACTORIAL: [f64; TERMS] = {
    let mut out = [1.0; TERMS];
    let mut n = 1;
    while n < TERMS {
        out[n] = out[n - 1] / n as f64;
        n += 1;
    }
    out
};

/// 1.5 · 2⁵²: what is added to it is rounded to a whole number, which is in its last bits.
const ROUNDING: f64 = 6_755_399_441_055_744.0;

/// e^(−x) of every x ≥ 0, to the last two digits; 0 for an x above 700.
#[inline(always)]
pub fn decay<const N: usize>(x: &[f64; N]) -> [f64; N] {
    let least = x.map(|x| if x < UNDERFLOW { x } else { UNDERFLOW });
    let shifted = least.map(|x| x * LOG2_E + ROUNDING);
    let mut r = [0.0; N];
    for n in 0..N {
        let whole = shifted[n] - ROUNDING;
        r[n] = (least[n] - whole * LN_2[0]) - whole * LN_2[1];
    }
    let mut out = [INVERSE_FACTORIAL[TERMS - 1]; N];
    for j in (0..TERMS - 1).rev() {
        for n in 0..N {
            out[n] = INVERSE_FACTORIAL[j] - r[n] * out[n];
        }
    }
    for n in 0..N {
        // 2⁻ⁿ by its bits: the exponent of 1 less the whole number
        let power = (1023_u64 << 52).wrapping_sub(shifted[n].to_bits() << 52);
        let value = out[n] * f64::from_bits(power);
        out[n] = if x[n] < UNDERFLOW { value } else { 0.0 };
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the library's exponential, to 4e-16 of it.
    #[test]
    fn decay_is_the_exponential() {
        for n in 0..20_000 {
            let x = [0.0353 * f64::from(n), 1e-3 * f64::from(n), 1e-9 * f64::from(n)];
            for (x, found) in x.into_iter().zip(decay(&x)) {
                let exact = if x < 700.0 { (-x).exp() } else { 0.0 };
                assert!((found - exact).abs() <= 4e-16 * exact, "{x}: {found} for {exact}");
            }
        }
    }

    /// Sums of boundary layers ask for exponents without bound.
    #[test]
    fn decay_ends_at_zero() {
        assert_eq!(decay(&[701.0, 1e6, f64::INFINITY]), [0.0; 3]);
    }
}
