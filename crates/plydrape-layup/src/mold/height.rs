//! The height of a mold z = f(x, y) with its first and second derivatives.

use num_dual::Dual2_64;

/// Height of a surface at a place (x, y), with first and second derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Height {
    /// Height z = f(x, y) (m).
    pub z: f64,
    /// Slopes ∂f/∂x and ∂f/∂y.
    pub gradient: [f64; 2],
    /// ∂²f/∂x², ∂²f/∂x∂y and ∂²f/∂y² (1/m).
    pub hessian: [f64; 3],
}

/// Bounds of the derivatives of a height over a region.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Steepness {
    /// No slope is larger.
    pub slope: f64,
    /// No second derivative along a horizontal unit vector is larger in size (1/m).
    pub bend: f64,
}

impl Steepness {
    /// Nothing is known.
    pub const UNKNOWN: Steepness = Steepness { slope: f64::INFINITY, bend: f64::INFINITY };

    /// From bounds of |∂f/∂x| and |∂f/∂y|, and of |∂²f/∂x²|, |∂²f/∂x∂y| and |∂²f/∂y²|: no eigenvalue of the
    /// Hessian is larger than the largest sum of sizes in one of its rows.
    #[must_use]
    pub fn new([fx, fy]: [f64; 2], [xx, xy, yy]: [f64; 3]) -> Self {
        Steepness { slope: fx.hypot(fy), bend: xx.max(yy) + xy }
    }

    /// Bounds over both regions.
    #[must_use]
    pub fn or(self, other: Self) -> Self {
        // what is no number is no bound
        let most = |a: f64, b: f64| if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) };
        Steepness { slope: most(self.slope, other.slope), bend: most(self.bend, other.bend) }
    }
}

impl Height {
    /// One height everywhere.
    pub(super) fn constant(z: f64) -> Self {
        Height { z, gradient: [0.0; 2], hessian: [0.0; 3] }
    }

    /// x or y as a height: 0 for x, 1 for y.
    pub(super) fn coordinate(value: f64, axis: usize) -> Self {
        let mut gradient = [0.0; 2];
        gradient[axis] = 1.0;
        Height { z: value, gradient, hessian: [0.0; 3] }
    }

    /// Whether the height and all its derivatives are finite.
    #[must_use]
    pub fn is_finite(&self) -> bool {
        let derivatives = self.gradient.iter().chain(&self.hessian);
        self.z.is_finite() && derivatives.copied().all(f64::is_finite)
    }

    /// f + t g.
    pub(super) fn plus(&self, t: f64, g: &Self) -> Self {
        Height {
            z: self.z + t * g.z,
            gradient: [0, 1].map(|n| self.gradient[n] + t * g.gradient[n]),
            hessian: [0, 1, 2].map(|n| self.hessian[n] + t * g.hessian[n]),
        }
    }

    /// f g, by the product rule.
    pub(super) fn times(&self, g: &Self) -> Self {
        let ([fx, fy], [gx, gy]) = (self.gradient, g.gradient);
        let mixed = [2.0 * fx * gx, fx * gy + fy * gx, 2.0 * fy * gy];
        Height {
            z: self.z * g.z,
            gradient: [fx * g.z + self.z * gx, fy * g.z + self.z * gy],
            hessian: [0, 1, 2].map(|n| self.hessian[n] * g.z + mixed[n] + self.z * g.hessian[n]),
        }
    }

    /// h(f) from h at f, as a dual number with h′ and h″, by the chain rule.
    pub(super) fn chain(&self, h: Dual2_64) -> Self {
        let (h, h1, h2) = (h.re, h.v1, h.v2);
        let [fx, fy] = self.gradient;
        let squares = [fx * fx, fx * fy, fy * fy];
        Height {
            z: h,
            gradient: [h1 * fx, h1 * fy],
            hessian: [0, 1, 2].map(|n| h1 * self.hessian[n] + h2 * squares[n]),
        }
    }
}
