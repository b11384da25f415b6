//! Arc length of a span, eq. (4) of `docs/theory.md`, with exact derivatives.
//!
//! What is integrated is the excess over the chord. With w = z' − θ and σ = √(1+θ²),
//! `√(1+z'²) − σ − θw/σ = w² / (σ(σ√(1+z'²) + 1 + θz'))`, and w has zero mean: every term is positive
//! and nothing cancels, however taut the span.

use super::basis::Panel;
use super::jet::{Chain, Jet};
use super::profile::{INNER, Profile, Response};
use super::quadrature::{ABSCISSAS, POINTS, WEIGHTS, stretches};

/// Excess of a span's arc length over its chord, per run, with its derivative to H.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excess {
    /// (L − chord)/ℓ, positive.
    pub value: f64,
    /// ∂/∂H of it (1/N).
    pub to_force: f64,
}

impl Profile {
    /// Calls `visit(scale, panel)` for every panel; the weights of its points are `scale·WEIGHTS`.
    #[inline]
    fn for_each_panel(&self, mut visit: impl FnMut(f64, &Panel<POINTS>)) {
        for stretch in stretches(self).iter() {
            let width = (stretch.end - stretch.start) / stretch.panels as f64;
            for panel in 0..stretch.panels {
                let start = stretch.start + panel as f64 * width;
                let t = ABSCISSAS.map(|s| start + width * s);
                let [near, far] = self.form.panel_layers(&ABSCISSAS, start, width);
                visit(width, &self.form.at(&t, &near, &far));
            }
        }
    }

    /// Excess of the arc length over the chord, with its derivative to H alone.
    #[must_use]
    pub fn excess(&self) -> Excess {
        let chain = Chain::<3>::new(self);
        let response = self.response();
        let [chi_h, rho_h] = [chain.to_force(0), chain.to_force(1)];
        let ([alpha, beta], rho, theta) = (self.amplitude, self.rho, self.theta);
        let sigma = theta.hypot(1.0);
        // ∂z'/∂H = χ_H (ρ G_χ + α U_χ + β V_χ + α_χ U + β_χ V) + ρ_H (G + α_ρ U + β_ρ V)
        let [a1, b1] = [0, 1].map(|n| chi_h * response.first[0][n] + rho_h * response.first[1][n]);
        let [a0, b0, r0] = [alpha, beta, rho].map(|x| x * chi_h);
        let (mut value, mut to_force) = (0.0, 0.0);
        self.for_each_panel(|scale, panel| {
            let Panel {
                value: [u, v, g],
                first: [ux, vx, gx],
                ..
            } = panel;
            let mut sums = [[0.0; LANES]; 2];
            for chunk in (0..POINTS).step_by(LANES) {
                for lane in 0..LANES {
                    let p = chunk + lane;
                    let w = rho * g[p] + alpha * u[p] + beta * v[p];
                    let w_h =
                        r0 * gx[p] + a0 * ux[p] + b0 * vx[p] + rho_h * g[p] + a1 * u[p] + b1 * v[p];
                    let slope = theta + w;
                    let r = (1.0 + slope * slope).sqrt();
                    // one division for both terms
                    let d = sigma * (sigma * r + 1.0 + theta * slope);
                    let both = WEIGHTS[p] / (d * r);
                    sums[0][lane] += both * w * w * r;
                    sums[1][lane] += both * d * slope * w_h;
                }
            }
            value += scale * total(sums[0]);
            to_force += scale * total(sums[1]);
        });
        Excess { value, to_force }
    }

    /// Arc length L (m) with derivatives to H and both slopes, and its excess: the solver's inner loop.
    ///
    /// The same numbers as [`Profile::length_and_excess`] with `N` = 3, at half its cost.
    pub(crate) fn length_to_unknowns(&self) -> (Jet<3>, Excess) {
        let r = self.response();
        let chain = Chain::<3>::new(self);
        let (chi_h, rho_h) = (chain.to_force(0), chain.to_force(1));
        let (chi_hh, rho_hh) = (chain.second_to_force(0), chain.second_to_force(1));
        let ([alpha, beta], rho, theta) = (self.amplitude, self.rho, self.theta);
        let sigma = theta.hypot(1.0);
        let mix =
            |x: f64, a: [f64; 2], y: f64, b: [f64; 2]| [x * a[0] + y * b[0], x * a[1] + y * b[1]];
        // ∂z'/∂H = χ_H D + ρ_H G + a₁ U + b₁ V with D = ρ G_χ + α U_χ + β V_χ
        let [a1, b1] = mix(chi_h, r.first[0], rho_h, r.first[1]);
        // the part of ∂²z'/∂H² that multiplies U and V
        let second = mix(chi_h * chi_h, r.second[0], 2.0 * chi_h * rho_h, r.second[1]);
        let direct = mix(chi_hh, r.first[0], rho_hh, r.first[1]);
        let [a2, b2] = [second[0] + direct[0], second[1] + direct[1]];
        let [da, db] = [2.0 * chi_h * a1, 2.0 * chi_h * b1];
        let (dg, dd) = (2.0 * chi_h * rho_h, chi_h * chi_h);

        let (mut excess, mut mean, mut gram) = (0.0, [0.0; 6], [0.0; 6]);
        self.for_each_panel(|scale, panel| {
            let Panel {
                value: [u, v, g],
                first: [ux, vx, gx],
                second: [uxx, vxx, gxx],
            } = panel;
            let mut sums = [[0.0; LANES]; 13];
            for chunk in (0..POINTS).step_by(LANES) {
                for lane in 0..LANES {
                    let p = chunk + lane;
                    let w = rho * g[p] + alpha * u[p] + beta * v[p];
                    let drift = rho * gx[p] + alpha * ux[p] + beta * vx[p];
                    let drift_chi = rho * gxx[p] + alpha * uxx[p] + beta * vxx[p];
                    let w_h = chi_h * drift + rho_h * g[p] + a1 * u[p] + b1 * v[p];
                    let w_hh = dd * drift_chi
                        + chi_hh * drift
                        + da * ux[p]
                        + db * vx[p]
                        + dg * gx[p]
                        + rho_hh * g[p]
                        + a2 * u[p]
                        + b2 * v[p];
                    let slope = theta + w;
                    let square = 1.0 + slope * slope;
                    let r = square.sqrt();
                    let d = sigma * (sigma * r + 1.0 + theta * slope);
                    let both = WEIGHTS[p] / (d * r * square);
                    let stretch = both * d;
                    let tilt = stretch * square * slope;
                    let terms = [
                        both * w * w * r * square,
                        tilt * w_h,
                        tilt * u[p],
                        tilt * v[p],
                        tilt * w_hh,
                        tilt * ux[p],
                        tilt * vx[p],
                        stretch * w_h * w_h,
                        stretch * w_h * u[p],
                        stretch * w_h * v[p],
                        stretch * u[p] * u[p],
                        stretch * u[p] * v[p],
                        stretch * v[p] * v[p],
                    ];
                    for n in 0..13 {
                        sums[n][lane] += terms[n];
                    }
                }
            }
            excess += scale * total(sums[0]);
            for n in 0..6 {
                mean[n] += scale * total(sums[1 + n]);
                gram[n] += scale * total(sums[7 + n]);
            }
        });
        let [to_h, mu, mv, to_hh, mux, mvx] = mean;
        let [hh, hu, hv, uu, uv, vv] = gram;
        let run = self.span.run;
        let mut out = Jet {
            value: run * (excess + sigma),
            ..Jet::default()
        };
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
        (
            out,
            Excess {
                value: excess,
                to_force: to_h,
            },
        )
    }

    /// Arc length L (m) with derivatives to the first `N` variables.
    #[must_use]
    pub fn length_jet<const N: usize>(&self) -> Jet<N> {
        self.length_and_excess().0
    }

    /// Arc length L (m) with derivatives, and its excess over the chord per run.
    #[must_use]
    pub fn length_and_excess<const N: usize>(&self) -> (Jet<N>, Excess) {
        let response = self.response();
        let sums = self.sums();
        let chain = Chain::<N>::new(self);
        let (first, second) = sums.derivatives(&response);
        let relative = chain.outer(sums.excess + self.theta.hypot(1.0), &first, &second);
        // L = ℓ Λ
        let run = self.span.run;
        let mut out = Jet {
            value: run * relative.value,
            ..Jet::default()
        };
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
        (
            out,
            Excess {
                value: sums.excess,
                to_force: relative.gradient[0],
            },
        )
    }

    fn sums(&self) -> Sums {
        let mut sums = Sums::default();
        let ([alpha, beta], rho, theta) = (self.amplitude, self.rho, self.theta);
        let sigma = theta.hypot(1.0);
        self.for_each_panel(|scale, panel| {
            let Panel {
                value: [u, v, g],
                first: [ux, vx, gx],
                second: [uxx, vxx, gxx],
            } = panel;
            let mut excess = [0.0; LANES];
            let mut mean = [[0.0; LANES]; 9];
            let mut gram = [[0.0; LANES]; 15];
            for chunk in (0..POINTS).step_by(LANES) {
                for lane in 0..LANES {
                    let p = chunk + lane;
                    let w = rho * g[p] + alpha * u[p] + beta * v[p];
                    let drift = rho * gx[p] + alpha * ux[p] + beta * vx[p];
                    let drift_chi = rho * gxx[p] + alpha * uxx[p] + beta * vxx[p];
                    let slope = theta + w;
                    let square = 1.0 + slope * slope;
                    let r = square.sqrt();
                    let d = sigma * (sigma * r + 1.0 + theta * slope);
                    let both = WEIGHTS[p] / (d * r * square);
                    excess[lane] += both * w * w * r * square;
                    let stretch = both * d;
                    let tilt = stretch * square * slope;
                    let f = [1.0, u[p], v[p], g[p], drift];
                    let others = [ux[p], vx[p], gx[p], drift_chi];
                    for n in 0..5 {
                        mean[n][lane] += tilt * f[n];
                    }
                    for n in 0..4 {
                        mean[5 + n][lane] += tilt * others[n];
                    }
                    let mut n = 0;
                    for i in 0..5 {
                        for j in 0..=i {
                            gram[n][lane] += stretch * f[i] * f[j];
                            n += 1;
                        }
                    }
                }
            }
            sums.excess += scale * total(excess);
            for n in 0..5 {
                sums.mean[n] += scale * total(mean[n]);
            }
            for n in 0..4 {
                sums.mean_chi[n] += scale * total(mean[5 + n]);
            }
            let mut n = 0;
            for i in 0..5 {
                for j in 0..=i {
                    sums.gram[i][j] += scale * total(gram[n]);
                    n += 1;
                }
            }
        });
        sums
    }
}

/// Points that are summed side by side.
const LANES: usize = 4;

fn total(lanes: [f64; LANES]) -> f64 {
    (lanes[0] + lanes[2]) + (lanes[1] + lanes[3])
}

/// Integrals over a span from which all derivatives of its length follow.
#[derive(Default)]
struct Sums {
    /// ∫√(1+z'²) − σ.
    excess: f64,
    /// ∫ z'/√(1+z'²) f for f = 1, U, V, G and D = ρG_χ + αU_χ + βV_χ.
    mean: [f64; 5],
    /// The same for U_χ, V_χ, G_χ and D_χ at fixed ρ, α, β.
    mean_chi: [f64; 4],
    /// ∫ f g /(1+z'²)^(3/2) for the five functions, lower half.
    gram: [[f64; 5]; 5],
}

impl Sums {
    /// First and second derivatives of Λ to the inner parameters.
    fn derivatives(&self, r: &Response) -> ([f64; INNER], [[f64; INNER]; INNER]) {
        // z'_y as a combination of 1, U, V, G, D
        let mut weights = [[0.0; 5]; INNER];
        for y in 0..INNER {
            weights[y][1] = r.first[y][0];
            weights[y][2] = r.first[y][1];
        }
        weights[0][4] = 1.0;
        weights[1][3] = 1.0;
        weights[2][0] = 1.0;
        let mut first = [0.0; INNER];
        for y in 0..INNER {
            first[y] = (0..5).map(|n| weights[y][n] * self.mean[n]).sum();
        }
        let gram = |i: usize, j: usize| {
            if i >= j {
                self.gram[i][j]
            } else {
                self.gram[j][i]
            }
        };
        let mut second = [[0.0; INNER]; INNER];
        for x in 0..INNER {
            let row: [f64; 5] =
                std::array::from_fn(|n| (0..5).map(|m| weights[x][m] * gram(m, n)).sum());
            for y in 0..=x {
                let sum: f64 = (0..5).map(|n| row[n] * weights[y][n]).sum();
                second[x][y] = sum;
                second[y][x] = sum;
            }
        }
        // z' z'_{χy}/√(1+z'²)
        let [ux, vx, gx, dx] = self.mean_chi;
        for y in 0..INNER {
            let mut sum = r.second[y][0] * self.mean[1]
                + r.second[y][1] * self.mean[2]
                + r.first[y][0] * ux
                + r.first[y][1] * vx;
            match y {
                0 => sum += r.first[0][0] * ux + r.first[0][1] * vx + dx,
                1 => sum += gx,
                _ => {}
            }
            second[0][y] += sum;
            if y > 0 {
                second[y][0] += sum;
            }
        }
        (first, second)
    }
}

impl Profile {
    /// Arc length from the first end to the horizontal distance `x` (m) from it (m).
    #[must_use]
    pub fn length_to(&self, x: f64) -> f64 {
        let Profile {
            span,
            theta,
            rho,
            amplitude,
            ..
        } = *self;
        let end = (x / span.run).clamp(0.0, 1.0);
        let mut sum = 0.0;
        for stretch in stretches(self).iter() {
            let width = (stretch.end - stretch.start) / stretch.panels as f64;
            for panel in 0..stretch.panels {
                let start = stretch.start + panel as f64 * width;
                let width = width.min(end - start);
                if width <= 0.0 {
                    return span.run * sum;
                }
                for p in 0..POINTS {
                    let [u, v, g] = self.form.slope(start + width * ABSCISSAS[p]).value;
                    let slope = theta + rho * g + amplitude[0] * u + amplitude[1] * v;
                    sum += width * WEIGHTS[p] * slope.hypot(1.0);
                }
            }
        }
        span.run * sum
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
        for (rigidity, force) in [
            (0.0, 0.4),
            (9e-6, 0.4),
            (9e-6, 300.0),
            (1e-2, -3.0),
            (1e-3, 0.0),
        ] {
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
                let (general, same) = profile.length_and_excess::<3>();
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
