//! The integrals over a span from which its length and all derivatives follow, eq. (4a) of
//! `docs/theory/span.md`, summed panel by panel.
//!
//! Four sums: the length alone ([`LengthSum`]), the excess with its derivative to H ([`ExcessSum`]), the solver's
//! inner loop ([`UnknownsSum`]), and everything ([`AllSum`]).

use super::basis::{Panel, Sum, Values};
use super::jet::Chain;
use super::profile::{INNER, Profile, Response};

/// Points that are summed side by side.
const LANES: usize = 4;

/// The sums of `M` terms over the points of a panel. The loops are plain and over whole columns, so that the compiler
/// takes several points at once.
#[inline(always)]
fn over_points<const M: usize, const P: usize>(terms: impl Fn(usize) -> [f64; M]) -> [f64; M] {
    let mut columns = [[0.0; P]; M];
    for p in 0..P {
        let row = terms(p);
        for m in 0..M {
            columns[m][p] = row[m];
        }
    }
    let mut out = [0.0; M];
    for m in 0..M {
        let mut lanes = [0.0; LANES];
        for chunk in (0..P).step_by(LANES) {
            for lane in 0..LANES {
                lanes[lane] += columns[m][chunk + lane];
            }
        }
        out[m] = (lanes[0] + lanes[2]) + (lanes[1] + lanes[3]);
    }
    out
}

/// ∂z'/∂H = χ_H D + ρ_H G + a U + b V with D = ρ G_χ + α U_χ + β V_χ, and what else a point needs.
pub struct ToForce {
    amplitude: [f64; 2],
    rho: f64,
    theta: f64,
    pub sigma: f64,
    pub chi_h: f64,
    rho_h: f64,
    mix: [f64; 2],
}

impl ToForce {
    pub fn new(profile: &Profile, [to_chi, to_rho]: [[f64; 2]; 2]) -> Self {
        let chain = Chain::<3>::new(profile);
        let (chi_h, rho_h) = (chain.to_force(0), chain.to_force(1));
        let mix = [0, 1].map(|n| chi_h * to_chi[n] + rho_h * to_rho[n]);
        let Profile { amplitude, rho, theta, .. } = *profile;
        ToForce { amplitude, rho, theta, sigma: theta.hypot(1.0), chi_h, rho_h, mix }
    }

    /// ρ, α, β times G, U, V or their derivatives.
    #[inline(always)]
    fn combine(&self, [u, v, g]: [f64; 3]) -> f64 {
        self.rho * g + self.amplitude[0] * u + self.amplitude[1] * v
    }

    /// ∂z'/∂H.
    #[inline(always)]
    fn slope(&self, basis: &Values, drift: f64) -> f64 {
        let [u, v, g] = basis.value;
        self.chi_h * drift + self.rho_h * g + self.mix[0] * u + self.mix[1] * v
    }
}

/// ∫√(1+z'²) − σ and its derivative to H.
pub struct ExcessSum {
    pub to_force: ToForce,
    pub value: f64,
    pub slope: f64,
}

impl Sum for ExcessSum {
    #[inline(always)]
    fn add<const P: usize>(&mut self, scale: f64, weights: &[f64; P], panel: &impl Panel) {
        let c = &self.to_force;
        let [value, slope] = over_points::<2, P>(
            #[inline(always)]
            |p| {
                let basis = panel.values(p);
                let w = c.combine(basis.value);
                let w_h = c.slope(&basis, c.combine(basis.first));
                let slope = c.theta + w;
                let r = (1.0 + slope * slope).sqrt();
                // one division for both terms
                let d = c.sigma * (c.sigma * r + 1.0 + c.theta * slope);
                let both = weights[p] / (d * r);
                [both * w * w * r, both * d * slope * w_h]
            },
        );
        self.value += scale * value;
        self.slope += scale * slope;
    }
}

/// ∫√(1+z'²).
pub struct LengthSum {
    amplitude: [f64; 2],
    rho: f64,
    theta: f64,
    pub value: f64,
}

impl LengthSum {
    pub fn new(profile: &Profile) -> Self {
        let Profile { amplitude, rho, theta, .. } = *profile;
        LengthSum { amplitude, rho, theta, value: 0.0 }
    }
}

impl Sum for LengthSum {
    #[inline(always)]
    fn add<const P: usize>(&mut self, scale: f64, weights: &[f64; P], panel: &impl Panel) {
        let [length] = over_points::<1, P>(
            #[inline(always)]
            |p| {
                let [u, v, g] = panel.values(p).value;
                let slope =
                    self.theta + self.rho * g + self.amplitude[0] * u + self.amplitude[1] * v;
                [weights[p] * (1.0 + slope * slope).sqrt()]
            },
        );
        self.value += scale * length;
    }
}

/// Integrals of the inner loop, in this order: the excess; z'/√(1+z'²) times z'_H, U, V, z'_HH, U_χ, V_χ;
/// (1+z'²)^(−3/2) times the products of z'_H, U, V.
pub struct UnknownsSum {
    pub to_force: ToForce,
    /// Factors of D_χ, D, U_χ, V_χ, G_χ, G, U, V in z'_HH.
    second: [f64; 8],
    pub total: [f64; 13],
}

impl UnknownsSum {
    pub fn new(profile: &Profile, r: &Response) -> Self {
        let chain = Chain::<3>::new(profile);
        let to_force = ToForce::new(profile, [r.first[0], r.first[1]]);
        let (chi, rho) = (to_force.chi_h, to_force.rho_h);
        let (chi2, rho2) = (chain.second_to_force(0), chain.second_to_force(1));
        let direct = |n: usize| {
            chi * chi * r.second[0][n]
                + 2.0 * chi * rho * r.second[1][n]
                + chi2 * r.first[0][n]
                + rho2 * r.first[1][n]
        };
        let [a, b] = to_force.mix;
        let second = [
            chi * chi,
            chi2,
            2.0 * chi * a,
            2.0 * chi * b,
            2.0 * chi * rho,
            rho2,
            direct(0),
            direct(1),
        ];
        UnknownsSum { to_force, second, total: [0.0; 13] }
    }
}

impl Sum for UnknownsSum {
    #[inline(always)]
    fn add<const P: usize>(&mut self, scale: f64, weights: &[f64; P], panel: &impl Panel) {
        let (c, k) = (&self.to_force, &self.second);
        let sums = over_points::<13, P>(
            #[inline(always)]
            |p| {
                // w is the slope less its mean θ; its derivatives to H are w_H and w_HH
                let basis = panel.values(p);
                let ([u, v, g], [ux, vx, gx]) = (basis.value, basis.first);
                let w = c.combine(basis.value);
                let drift = c.combine(basis.first);
                let w_h = c.slope(&basis, drift);
                let w_hh = k[0] * c.combine(basis.second)
                    + k[1] * drift
                    + k[2] * ux
                    + k[3] * vx
                    + k[4] * gx
                    + k[5] * g
                    + k[6] * u
                    + k[7] * v;

                // w²/d is √(1+z'²) − σ − θw/σ without loss of digits; one division serves all
                let slope = c.theta + w;
                let square = 1.0 + slope * slope;
                let r = square.sqrt();
                let d = c.sigma * (c.sigma * r + 1.0 + c.theta * slope);
                let both = weights[p] / (d * r * square);
                let stretch = both * d;
                let tilt = stretch * square * slope;

                // the terms in the order of the struct
                let (h, su, sv) = (stretch * w_h, stretch * u, stretch * v);
                [
                    both * w * w * r * square,
                    tilt * w_h,
                    tilt * u,
                    tilt * v,
                    tilt * w_hh,
                    tilt * ux,
                    tilt * vx,
                    h * w_h,
                    h * u,
                    h * v,
                    su * u,
                    su * v,
                    sv * v,
                ]
            },
        );
        for n in 0..13 {
            self.total[n] += scale * sums[n];
        }
    }
}

/// Integrals over a span from which all derivatives of its length follow.
pub struct AllSum {
    pub profile: Profile,
    /// ∫√(1+z'²) − σ.
    pub excess: f64,
    /// ∫ z'/√(1+z'²) f for f = 1, U, V, G and D = ρG_χ + αU_χ + βV_χ.
    pub mean: [f64; 5],
    /// ∫ z'/√(1+z'²) f for f = U_χ, V_χ, G_χ and D_χ at fixed ρ, α, β.
    pub mean_chi: [f64; 4],
    /// ∫ f g /(1+z'²)^(3/2) for the five functions, lower half.
    pub gram: [[f64; 5]; 5],
}

impl Sum for AllSum {
    fn add<const P: usize>(&mut self, scale: f64, weights: &[f64; P], panel: &impl Panel) {
        let Profile { amplitude: [alpha, beta], rho, theta, .. } = self.profile;
        let sigma = theta.hypot(1.0);
        let combine = |[u, v, g]: [f64; 3]| rho * g + alpha * u + beta * v;
        for p in 0..P {
            let basis = panel.values(p);
            let ([u, v, g], [ux, vx, gx]) = (basis.value, basis.first);
            let w = combine(basis.value);
            let slope = theta + w;
            let r = slope.hypot(1.0);
            let weight = scale * weights[p];
            self.excess += weight * w * w / (sigma * (sigma * r + 1.0 + theta * slope));
            let (tilt, stretch) = (weight * slope / r, weight / (r * r * r));
            let f = [1.0, u, v, g, combine(basis.first)];
            let others = [ux, vx, gx, combine(basis.second)];
            for (mean, f) in self.mean.iter_mut().zip(f) {
                *mean += tilt * f;
            }
            for (mean, f) in self.mean_chi.iter_mut().zip(others) {
                *mean += tilt * f;
            }
            for i in 0..5 {
                for j in 0..=i {
                    self.gram[i][j] += stretch * f[i] * f[j];
                }
            }
        }
    }
}

impl AllSum {
    /// First and second derivatives of Λ to the inner parameters.
    pub fn derivatives(&self, r: &Response) -> ([f64; INNER], [[f64; INNER]; INNER]) {
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
            if i >= j { self.gram[i][j] } else { self.gram[j][i] }
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
