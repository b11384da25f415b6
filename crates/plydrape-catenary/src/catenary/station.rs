//! Height, slope and arc length along a span with exact derivatives to what the span depends on.
//!
//! At a fixed fraction t of the run all three follow from eq. (2) of `docs/theory/span.md`: the slope is linear in
//! (θ, ρ, α, β), the height is its integral, and the arc length ℓ∫₀ᵗ√(1+z'²) is differentiated under the
//! integral, as in eq. (4a). The amplitudes' response contains the end conditions.

use super::basis::Values;
use super::jet::Chain;
use super::profile::{INNER, Profile, Response};
use super::quadrature::LONG;
use super::{Span, Variable};

/// A value with its gradient to the eight [`Variable`]s, the fabric length having no part in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Graded {
    /// The value.
    pub value: f64,
    /// First derivatives.
    pub gradient: [f64; 8],
}

/// A span at a given force, ready to be differentiated along its run.
pub struct Stations<'a> {
    profile: &'a Profile,
    response: Response,
    chain: Chain<8>,
}

impl Profile {
    /// Prepares the derivatives of what happens along the run.
    #[must_use]
    pub fn stations(&self) -> Stations<'_> {
        Stations { profile: self, response: self.response(), chain: Chain::new(self) }
    }
}

impl Stations<'_> {
    fn span(&self) -> &Span {
        &self.profile.span
    }

    /// A quantity of the inner parameters times the run.
    fn times_run(&self, value: f64, first: &[f64; INNER]) -> Graded {
        let run = self.span().run;
        let mut gradient = self.chain.gradient(first).map(|g| run * g);
        gradient[Variable::Run as usize] += value;
        Graded { value: run * value, gradient }
    }

    /// Height above the first end (m) at a fraction `t` of the run.
    #[must_use]
    pub fn height(&self, t: f64) -> Graded {
        let basis: Values = self.profile.form.integral(t);
        let local = self.profile.local(&self.response, &basis, t);
        self.times_run(local.value, &local.first)
    }

    /// Slope at a fraction `t` of the run.
    #[must_use]
    pub fn slope(&self, t: f64) -> Graded {
        let local = self.profile.local(&self.response, &self.profile.form.slope(t), 1.0);
        Graded { value: local.value, gradient: self.chain.gradient(&local.first) }
    }

    /// Arc length from the first end (m) to a fraction `t` of the run.
    #[must_use]
    pub fn arc(&self, t: f64) -> Graded {
        let (mut value, mut first) = (0.0, [0.0; INNER]);
        self.profile.stretches().for_each_panel(t, |panel| {
            for (s, weight) in LONG.t.iter().zip(&LONG.weight) {
                let basis = self.profile.form.slope(panel.start + panel.width * s);
                let slope = self.profile.local(&self.response, &basis, 1.0);
                let (secant, weight) = (slope.value.hypot(1.0), panel.width * weight);
                value += weight * secant;
                for n in 0..INNER {
                    first[n] += weight * slope.value / secant * slope.first[n];
                }
            }
        });
        self.times_run(value, &first)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{EndCondition, Span};
    use super::*;

    /// Central differences of the closed form, in every form and end condition, at points inside.
    #[test]
    fn derivatives_along_a_span_agree_with_central_differences() {
        // limp and stiff spans in tension, and one in compression
        for (rigidity, force) in [(0.0, 0.4), (9e-6, 0.4), (9e-6, 30.0), (1e-2, -3.0), (1e-3, 0.2)]
        {
            for held in 0..4 {
                // force, slopes of both ends, run, rise, weight and rigidity
                let base = [force, 0.31, -0.12, 0.098, 0.02, 3.0, rigidity];
                let profile_at = |x: &[f64; 7]| {
                    let end = |n: usize| {
                        let slope = EndCondition::Slope(x[1 + n]);
                        if held & (1 << n) == 0 { EndCondition::Free } else { slope }
                    };
                    let span = Span {
                        run: x[3],
                        rise: x[4],
                        length: 0.104,
                        ends: [end(0), end(1)],
                        weight: x[5],
                        flexural_rigidity: x[6],
                        axial_stiffness: 1e5,
                    };
                    Profile::new(&span, x[0])
                };
                let profile = profile_at(&base);

                // height, slope and arc length at points inside
                for t in [0.13, 0.5, 0.83] {
                    let read = |p: &Profile| {
                        let station = p.station(t * p.span.run);
                        [station.z, station.slope, p.length_to(t * p.span.run)]
                    };
                    let stations = profile.stations();
                    let found = [stations.height(t), stations.slope(t), stations.arc(t)];
                    let values = read(&profile);

                    // their gradients by central differences; a limp span has no rigidity
                    for n in 0..7 {
                        if base[n] == 0.0 {
                            continue;
                        }
                        let h = 1e-5 * base[n].abs().max(1e-3 * f64::from(n == 4));
                        let (mut low, mut high) = (base, base);
                        low[n] -= h;
                        high[n] += h;
                        let (low, high) = (read(&profile_at(&low)), read(&profile_at(&high)));
                        for q in 0..3 {
                            assert!((found[q].value - values[q]).abs() < 1e-12);
                            let difference = (high[q] - low[q]) / (2.0 * h);
                            let scale = difference.abs() + (values[q] / base[n]).abs();
                            assert!(
                                (found[q].gradient[n] - difference).abs() < 1e-6 * scale,
                                "{q} to {n} at {t}, {rigidity} {force} {held}: {} {difference}",
                                found[q].gradient[n]
                            );
                        }
                    }
                }
            }
        }
    }
}
