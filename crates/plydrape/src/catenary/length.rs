//! Arc length of a span, eq. (4) of `docs/theory.md`, with exact derivatives.
//!
//! What is integrated is the excess over the chord. With w = z' − θ and σ = √(1+θ²),
//! `√(1+z'²) − σ − θw/σ = w² / (σ(σ√(1+z'²) + 1 + θz'))`, and w has zero mean: every term is positive
//! and nothing cancels, however taut the span.

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
    /// Calls `visit(weight, t, e^(−kt), e^(−k(1−t)))` for every quadrature point.
    #[inline]
    fn for_each_point(&self, mut visit: impl FnMut(f64, f64, f64, f64)) {
        let stretches = stretches(self);
        if stretches.is_single() {
            // the abscissas are symmetric: one exponential serves both ends
            let mut layers = [0.0; POINTS];
            for n in 0..POINTS {
                layers[n] = self.form.layers(ABSCISSAS[n])[0];
            }
            for n in 0..POINTS {
                visit(WEIGHTS[n], ABSCISSAS[n], layers[n], layers[POINTS - 1 - n]);
            }
            return;
        }
        for stretch in stretches.iter() {
            let width = (stretch.end - stretch.start) / stretch.panels as f64;
            for panel in 0..stretch.panels {
                let start = stretch.start + panel as f64 * width;
                for n in 0..POINTS {
                    let t = start + width * ABSCISSAS[n];
                    let [near, far] = self.form.layers(t);
                    visit(width * WEIGHTS[n], t, near, far);
                }
            }
        }
    }

    /// Excess of the arc length over the chord, with its derivative to H alone.
    #[must_use]
    pub fn excess(&self) -> Excess {
        let chain = Chain::<3>::new(self);
        let response = self.response();
        let [chi_h, rho_h] = [chain.to_force(0), chain.to_force(1)];
        let [alpha, beta] = self.amplitude;
        let (rho, theta) = (self.rho, self.theta);
        let sigma = theta.hypot(1.0);
        // ∂z'/∂H = χ_H (ρ G_χ + α U_χ + β V_χ + α_χ U + β_χ V) + ρ_H (G + α_ρ U + β_ρ V)
        let [a1, b1] = [0, 1].map(|n| chi_h * response.first[0][n] + rho_h * response.first[1][n]);
        let (mut value, mut to_force) = (0.0, 0.0);
        self.for_each_point(|weight, t, near, far| {
            let basis = self.form.at(t, near, far);
            let ([u, v, g], [ux, vx, gx]) = (basis.value, basis.first);
            let w = rho * g + alpha * u + beta * v;
            let w_h = chi_h * (rho * gx + alpha * ux + beta * vx) + rho_h * g + a1 * u + b1 * v;
            let p = theta + w;
            let r = (1.0 + p * p).sqrt();
            value += weight * w * w / (sigma * (sigma * r + 1.0 + theta * p));
            to_force += weight * p / r * w_h;
        });
        Excess { value, to_force }
    }

    /// Arc length L (m) with derivatives to the first `N` variables.
    #[must_use]
    pub fn length_jet<const N: usize>(&self) -> Jet<N> {
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
        out
    }

    fn sums(&self) -> Sums {
        let mut sums = Sums::default();
        let [alpha, beta] = self.amplitude;
        let (rho, theta) = (self.rho, self.theta);
        let sigma = theta.hypot(1.0);
        self.for_each_point(|weight, t, near, far| {
            let basis = self.form.at(t, near, far);
            let ([u, v, g], [ux, vx, gx], [uxx, vxx, gxx]) =
                (basis.value, basis.first, basis.second);
            let w = rho * g + alpha * u + beta * v;
            let drift = rho * gx + alpha * ux + beta * vx;
            let p = theta + w;
            let r = 1.0 / (1.0 + p * p).sqrt();
            sums.excess += weight * w * w / (sigma * (sigma / r + 1.0 + theta * p));
            let tilt = weight * p * r;
            let functions = [1.0, u, v, g, drift];
            let others = [ux, vx, gx, rho * gxx + alpha * uxx + beta * vxx];
            for n in 0..5 {
                sums.mean[n] += tilt * functions[n];
            }
            for n in 0..4 {
                sums.mean_chi[n] += tilt * others[n];
            }
            let stretch = weight * r * r * r;
            for i in 0..5 {
                let left = stretch * functions[i];
                for j in 0..=i {
                    sums.gram[i][j] += left * functions[j];
                }
            }
        });
        sums
    }
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
