//! A strip of ply as the exact elastica under its own weight: inextensible, any sag, curvature exact.
//!
//! With the arc length s, the slope angle θ(s), the curvature κ = θ' and the moment M(κ), the strip obeys
//!
//! *M' = H sin θ − V cos θ*, *V = V₁ − w (L − s)*, *x' = cos θ*, *z' = sin θ*,
//!
//! eq. (20) of `docs/theory/elastica.md`: H is the horizontal force, V the vertical one. The moment is EI κ or a measured
//! curve. The files follow the derivation: this one states the problems, `flexible` is the catenary without stiffness, where
//! the search starts, `panels` how θ is written, `band` the linear algebra, `solve` Newton's method and the continuation to
//! the strip's stiffness, `shape` reads off the result. `tuning` holds every constant.

mod band;
mod flexible;
mod panels;
mod shape;
mod solve;
#[cfg(test)]
mod tests;
mod tuning;

pub use shape::Shape;

use crate::catenary::EndCondition;
use crate::material::MomentCurve;

/// How a strip resists bending.
#[derive(Debug, Clone, PartialEq)]
pub enum Bending {
    /// M = EI κ; zero for a strip that does not resist.
    Rigidity(f64),
    /// A curve of the moment M (N·m) over the curvature.
    Curve(MomentCurve),
}

impl Bending {
    /// Moment M (N·m) and its slope (N·m²) at a curvature κ (1/m).
    #[must_use]
    pub fn bend(&self, curvature: f64) -> [f64; 2] {
        match self {
            Bending::Rigidity(rigidity) => [rigidity * curvature, *rigidity],
            Bending::Curve(curve) => {
                let [_, moment, slope] = curve.bend(curvature);
                [moment, slope]
            }
        }
    }

    /// Flexural rigidity at rest EI (N·m²).
    #[must_use]
    pub fn rigidity(&self) -> f64 {
        self.bend(0.0)[1]
    }

    /// The smallest flexural rigidity of any curvature (N·m²).
    fn least_rigidity(&self) -> f64 {
        match self {
            Bending::Rigidity(rigidity) => *rigidity,
            Bending::Curve(curve) => curve.least_slope(),
        }
    }
}

/// A strip between two ends in one vertical plane.
#[derive(Debug, Clone, PartialEq)]
pub struct HeavyStrip {
    /// Horizontal distance of the ends ℓ (m), positive.
    pub run: f64,
    /// Height of the second end above the first h (m).
    pub rise: f64,
    /// Length of the strip L (m), larger than the distance of the ends.
    pub length: f64,
    /// What holds each end: free slope or a prescribed one.
    pub ends: [EndCondition; 2],
    /// Weight per length w (N/m), positive.
    pub weight: f64,
    /// How it resists bending; slopes can be prescribed only if it does.
    pub bending: Bending,
}

/// A strip that is clamped at its first end and hangs freely.
#[derive(Debug, Clone, PartialEq)]
pub struct Cantilever {
    /// Length of the strip L (m), positive.
    pub length: f64,
    /// Angle at which it leaves the clamp, upwards (rad), less than a right angle to either side.
    pub angle: f64,
    /// Weight per length w (N/m), positive.
    pub weight: f64,
    /// How it resists bending; it must.
    pub bending: Bending,
}
