//! The entire functions `c_n(y) = Σ_j y^j / (2j+n)!`, n = 0 … 8, for −50 ≤ y ≤ 25.
//!
//! c₀ is cosh √y, c₁ is sinh √y / √y, and so on: they join the hanging, straight and buckled spans
//! without a case for the sign of H. `c_n = 1/n! + y c_{n+2}`, so two series give all nine.

/// 1/n! for n = 0 … 6.
const INVERSE_FACTORIAL: [f64; 7] =
    [1.0, 1.0, 0.5, 1.0 / 6.0, 1.0 / 24.0, 1.0 / 120.0, 1.0 / 720.0];

/// Terms of the two series, enough for |y| ≤ 50 to the last digit of c₀.
const TERMS: usize = 20;

/// 1/(2j+7)! and 1/(2j+8)!.
const SERIES: [[f64; TERMS]; 2] = [series(7), series(8)];

const fn series(n: usize) -> [f64; TERMS] {
    let mut out = [0.0; TERMS];
    let mut value = 1.0;
    let mut k = 1;
    while k <= n {
        value /= k as f64;
        k += 1;
    }
    let mut j = 0;
    while j < TERMS {
        out[j] = value;
        value /= ((2 * j + n + 1) * (2 * j + n + 2)) as f64;
        j += 1;
    }
    out
}

/// Number of terms that `|y| ≤ bound` needs.
pub fn terms(bound: f64) -> usize {
    match bound {
        b if b <= 1.0 => 6,
        b if b <= 5.0 => 9,
        b if b <= 12.0 => 12,
        b if b <= 26.0 => 15,
        _ => TERMS,
    }
}

/// c₀ … c₈ at y, summing the given number of terms.
#[inline]
pub fn entire(y: f64, terms: usize) -> [f64; 9] {
    entire_at(&[y], terms).map(|[c]| c)
}

/// c₀ … c₈ at several y at once: `[n][point]`.
#[inline(always)]
pub fn entire_at<const P: usize>(y: &[f64; P], terms: usize) -> [[f64; P]; 9] {
    let mut c = [[0.0; P]; 9];
    for j in (0..terms.min(TERMS)).rev() {
        for p in 0..P {
            c[7][p] = c[7][p] * y[p] + SERIES[0][j];
            c[8][p] = c[8][p] * y[p] + SERIES[1][j];
        }
    }
    for n in (0..7).rev() {
        for p in 0..P {
            c[n][p] = INVERSE_FACTORIAL[n] + y[p] * c[n + 2][p];
        }
    }
    c
}

/// First derivative c_n'(y) from the values, n ≤ 6.
#[inline(always)]
pub fn slope(c: &[f64; 9], n: usize) -> f64 {
    0.5 * (c[n + 1] - n as f64 * c[n + 2])
}

/// Second derivative c_n''(y) from the values, n ≤ 4.
#[inline(always)]
pub fn curvature(c: &[f64; 9], n: usize) -> f64 {
    let m = n as f64;
    0.25 * (c[n + 2] - (2.0 * m + 1.0) * c[n + 3] + m * (m + 2.0) * c[n + 4])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// c₀ = cosh √y = cos √−y, c₁ = sinh √y/√y = sin √−y/√−y.
    #[test]
    fn entire_functions_are_hyperbolic_and_trigonometric() {
        for y in [-48.0_f64, -39.5, -20.0, -3.0, -1e-3, 0.0, 1e-6, 0.7, 4.0, 11.0, 24.9] {
            let c = entire(y, terms(y.abs()));
            let r = y.abs().sqrt();
            let (c0, c1) = if y > 0.0 {
                (r.cosh(), r.sinh() / r)
            } else if y < 0.0 {
                (r.cos(), r.sin() / r)
            } else {
                (1.0, 1.0)
            };
            // absolute, since they are added to 1; the recurrence multiplies rounding by y⁴/8!
            assert!((c[0] - c0).abs() < 1e-13 * c0.abs().max(1.0), "c0({y}) {} {c0}", c[0]);
            assert!((c[1] - c1).abs() < 1e-13 * c1.abs().max(1.0), "c1({y}) {} {c1}", c[1]);
        }
    }

    /// Central differences of the values and of the slopes; h = 1e-4 leaves h²/6 ≈ 2e-9 of the third.
    #[test]
    fn derivatives_agree_with_central_differences() {
        let h = 1e-4;
        for y in [-31.0, -2.2, 0.3, 17.0] {
            let [low, mid, high] = [y - h, y, y + h].map(|y| entire(y, TERMS));
            for n in 0..=4 {
                let first = (high[n] - low[n]) / (2.0 * h);
                let second = (slope(&high, n) - slope(&low, n)) / (2.0 * h);
                let scale = mid[n].abs().max(1e-3);
                assert!((slope(&mid, n) - first).abs() < 1e-8 * scale, "c{n}'({y})");
                assert!((curvature(&mid, n) - second).abs() < 1e-8 * scale, "c{n}''({y})");
            }
        }
    }
}
