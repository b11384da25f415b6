//! Shape, slope, moment and forces along a span.

use super::{Profile, Span};

/// What a span does at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Station {
    /// Horizontal distance from the first end (m).
    pub x: f64,
    /// Height above the first end (m).
    pub z: f64,
    /// Slope z'.
    pub slope: f64,
    /// Bending moment EI z'' (N·m), positive where the span is hollow upwards.
    pub moment: f64,
    /// Vertical force H z' − EI z''' (N): what the part before x holds up of the part after it.
    pub vertical_force: f64,
}

impl Profile {
    /// The span at a horizontal distance `x` (m) from its first end, within [0, ℓ].
    #[must_use]
    pub fn station(&self, x: f64) -> Station {
        let Span { run, flexural_rigidity, .. } = self.span;
        let [integral, slope, curvature, third] = self.form.station(x / run);
        let combine =
            |f: [f64; 3]| self.amplitude[0] * f[0] + self.amplitude[1] * f[1] + self.rho * f[2];
        let slope = self.theta + combine(slope);
        let third = combine(third) / (run * run);
        Station {
            x,
            z: self.theta * x + run * combine(integral),
            slope,
            moment: flexural_rigidity * combine(curvature) / run,
            vertical_force: self.force * slope - flexural_rigidity * third,
        }
    }

    /// Heights above the first end (m) at `N` stations at equal distances from the first end to the second.
    ///
    /// To rounding as from [`Profile::station`], in a fraction of the time.
    #[must_use]
    pub fn heights<const N: usize>(&self) -> [f64; N] {
        let [a, b] = self.amplitude;
        let run = self.span.run;
        let integrals = self.form.integrals::<N>();
        std::array::from_fn(|n| {
            let ([u, v, g], t) = (integrals[n], n as f64 / (N - 1) as f64);
            run * (self.theta * t + a * u + b * v + self.rho * g)
        })
    }

    /// Largest vertical distance of the span below its chord, and where (m): (sag, x).
    ///
    /// Zero at x = 0 if the span lies nowhere below its chord.
    #[must_use]
    pub fn sag(&self) -> (f64, f64) {
        let Span { run, rise, .. } = self.span;
        let depth = |x: f64| rise / run * x - self.station(x).z;
        // the best of a grid, then golden sections around it
        const GRID: usize = 64;
        let x_at = |n: usize| run * n as f64 / GRID as f64;
        let best =
            (0..=GRID).fold(0, |best, n| if depth(x_at(n)) > depth(x_at(best)) { n } else { best });
        let (mut a, mut b) = (x_at(best.saturating_sub(1)), x_at((best + 1).min(GRID)));
        let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
        // 50 sections leave less than 1e-10 of the two grid widths
        for _ in 0..50 {
            if b - a <= 1e-9 * run {
                break;
            }
            let (c, d) = (b - golden * (b - a), a + golden * (b - a));
            if depth(c) > depth(d) { b = d } else { a = c }
        }
        let x = 0.5 * (a + b);
        if depth(x) > 0.0 { (depth(x), x) } else { (0.0, 0.0) }
    }
}
