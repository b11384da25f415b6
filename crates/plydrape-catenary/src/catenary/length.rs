//! Arc length of a span, eq. (4) of `docs/theory/span.md`, with exact derivatives.
//!
//! What is integrated is the excess over the chord. With w = z' − θ and σ = √(1+θ²),
//! `√(1+z'²) − σ − θw/σ = w² / (σ(σ√(1+z'²) + 1 + θz'))`, and w has zero mean: every term is positive
//! and nothing cancels, however taut the span.

use super::basis::{Form, Sum};
use super::jet::{Chain, Jet};
use super::profile::Profile;
use super::quadrature::{Interval, LONG, SHORT, Stretches};
use super::sums::{AllSum, ExcessSum, LengthSum, ToForce, UnknownsSum};
use pulp::{Arch, Simd, WithSimd};

/// Excess of a span's arc length over its chord, per run, with its derivative to H.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excess {
    /// (L − chord)/ℓ, positive.
    pub value: f64,
    /// ∂/∂H of it (1/N).
    pub to_force: f64,
}

/// A sum to be taken over the panels of a span up to a fraction `end` of its run.
struct Integral<'a, S> {
    form: &'a Form,
    stretches: Stretches,
    end: f64,
    sum: &'a mut S,
}

impl<S: Sum> WithSimd for Integral<'_, S> {
    type Output = ();

    #[inline(always)]
    fn with_simd<T: Simd>(self, _: T) {
        let Integral { form, stretches, end, sum } = self;
        stretches.for_each_panel(
            end,
            #[inline(always)]
            |Interval { start, width, short }| {
                if short {
                    form.add_panel(&SHORT, start, width, sum);
                } else {
                    form.add_panel(&LONG, start, width, sum);
                }
            },
        );
    }
}

impl Profile {
    /// Adds every panel of the span to a sum.
    #[inline(always)]
    fn integrate(&self, sum: &mut impl Sum) {
        self.integrate_to(1.0, sum);
    }

    /// Adds the panels of the span up to a fraction `end` of its run to a sum, with the widest instructions that the
    /// machine has: the same operations in the same order, several points at a time.
    #[inline(always)]
    fn integrate_to(&self, end: f64, sum: &mut impl Sum) {
        Arch::new().dispatch(Integral { form: &self.form, stretches: self.stretches(), end, sum });
    }

    /// Excess of the arc length over the chord, with its derivative to H alone.
    #[must_use]
    pub fn excess(&self) -> Excess {
        let mut sum = ExcessSum {
            to_force: ToForce::new(self, self.response_to_force()),
            value: 0.0,
            slope: 0.0,
        };
        self.integrate(&mut sum);
        Excess { value: sum.value, to_force: sum.slope }
    }

    /// Arc length L (m) with derivatives to H and both slopes, and its excess: the solver's inner loop.
    ///
    /// The numbers of the general kernel with `N` = 3, at half its cost.
    fn length_to_unknowns(&self) -> (Jet<3>, Excess) {
        let r = self.response();
        let mut sum = UnknownsSum::new(self, &r);
        self.integrate(&mut sum);
        let chi_h = sum.to_force.chi_h;
        let [excess, to_h, mu, mv, to_hh, mux, mvx, hh, hu, hv, uu, uv, vv] = sum.total;
        let run = self.span.run;
        let mut out = Jet { value: run * (excess + sum.to_force.sigma), ..Jet::default() };
        out.gradient[0] = run * to_h;
        out.hessian[0][0] = run * (hh + to_hh);
        for i in 0..2 {
            let [a, b] = r.first[3 + i];
            out.gradient[1 + i] = run * (a * mu + b * mv);
            // ∂²z'/∂H∂s = χ_H (a U_χ + b V_χ + a_χ U + b_χ V)
            let [ax, bx] = r.second[3 + i];
            let cross = chi_h * (a * mux + b * mvx + ax * mu + bx * mv) + a * hu + b * hv;
            out.hessian[0][1 + i] = run * cross;
            out.hessian[1 + i][0] = run * cross;
            for j in 0..2 {
                let [c, d] = r.first[3 + j];
                out.hessian[1 + i][1 + j] = run * (a * c * uu + (a * d + b * c) * uv + b * d * vv);
            }
        }
        (out, Excess { value: excess, to_force: to_h })
    }

    /// Arc length L (m) with derivatives to the first `N` variables, and its excess over the chord per run.
    #[must_use]
    pub fn length_and_excess<const N: usize>(&self) -> (Jet<N>, Excess) {
        if N == 3 {
            let (jet, excess) = self.length_to_unknowns();
            return (jet.first(), excess);
        }
        self.general_length()
    }

    /// Arc length L (m) with derivatives to any number of variables, and its excess.
    fn general_length<const N: usize>(&self) -> (Jet<N>, Excess) {
        let response = self.response();
        let sums = self.sums();
        let chain = Chain::<N>::new(self);
        let (first, second) = sums.derivatives(&response);
        let relative = chain.outer(sums.excess + self.theta.hypot(1.0), &first, &second);
        // L = ℓ Λ
        let run = self.span.run;
        let mut out = Jet { value: run * relative.value, ..Jet::default() };
        for i in 0..N {
            out.gradient[i] = run * relative.gradient[i];
            for j in 0..N {
                out.hessian[i][j] = run * relative.hessian[i][j];
            }
        }
        let run_slot = super::Variable::Run as usize;
        if N > run_slot {
            out.gradient[run_slot] += relative.value;
            for i in 0..N {
                out.hessian[run_slot][i] += relative.gradient[i];
                out.hessian[i][run_slot] += relative.gradient[i];
            }
        }
        (out, Excess { value: sums.excess, to_force: relative.gradient[0] })
    }

    fn sums(&self) -> AllSum {
        let mut sums = AllSum {
            profile: *self,
            excess: 0.0,
            mean: [0.0; 5],
            mean_chi: [0.0; 4],
            gram: [[0.0; 5]; 5],
        };
        self.integrate(&mut sums);
        sums
    }

    /// Arc length from the first end to the horizontal distance `x` (m) from it (m).
    #[must_use]
    pub fn length_to(&self, x: f64) -> f64 {
        let mut sum = LengthSum::new(self);
        self.integrate_to((x / self.span.run).clamp(0.0, 1.0), &mut sum);
        self.span.run * sum.value
    }
}

#[cfg(test)]
mod tests {
    use super::super::{EndCondition, Span};
    use super::*;

    /// The inner loop's kernel gives the numbers of the general one, in every form and end condition.
    #[test]
    fn both_kernels_agree() {
        let ends = [EndCondition::Free, EndCondition::Slope(0.3)];
        for (rigidity, force) in [(0.0, 0.4), (9e-6, 0.4), (9e-6, 300.0), (1e-2, -3.0), (1e-3, 0.0)]
        {
            for (first, second) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let span = Span {
                    run: 0.098,
                    rise: 0.02,
                    length: 0.104,
                    ends: [ends[first], ends[second]],
                    weight: 3.0,
                    flexural_rigidity: rigidity,
                    axial_stiffness: 1e5,
                };
                let profile = Profile::new(&span, force);
                let (fast, excess) = profile.length_to_unknowns();
                let (general, same) = profile.general_length::<3>();
                let close = |a: f64, b: f64| (a - b).abs() <= 1e-12 * (a.abs() + b.abs()) + 1e-15;
                assert!(close(fast.value, general.value) && close(excess.value, same.value));
                for i in 0..3 {
                    assert!(
                        close(fast.gradient[i], general.gradient[i]),
                        "{i} {fast:?} {general:?}"
                    );
                    for j in 0..3 {
                        assert!(
                            close(fast.hessian[i][j], general.hessian[i][j]),
                            "{fast:?} {general:?}"
                        );
                    }
                }
            }
        }
    }
}
