//! One span of ply between two held points: a small-sag catenary with bending stiffness.
//!
//! Solves `H z'' − EI z'''' = q` in closed form, eq. (1) of `docs/theory/span.md`, after Krogh et al. 2018,
//! eq. (2), for every sign of H: a short stiff span with slack is in compression. The files follow the
//! derivation: [`Span`] states the problem, `profile` is the closed form at a given H, `length` its arc
//! length with exact derivatives, `solve` finds the H of a given length, `shape` reads off the result. `tuning` holds every constant of the method.

mod basis;
mod decay;
mod entire;
mod jet;
mod length;
mod profile;
mod quadrature;
mod shape;
mod solve;
mod station;
mod sums;
mod tuning;

pub use jet::{Jet, Variable};
pub(crate) use jet::{compose, power, product, variable};
pub use length::Excess;
pub use profile::Profile;
pub use shape::Station;
pub use solve::{Root, SpanState};
pub use station::{Graded, Stations};

/// A free length of ply between two ends in one vertical plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    /// Horizontal distance of the ends ℓ (m), positive.
    pub run: f64,
    /// Height of the second end above the first h (m).
    pub rise: f64,
    /// Fabric length to fit between them L_set (m), positive.
    pub length: f64,
    /// What holds each end: free slope or a prescribed one.
    pub ends: [EndCondition; 2],
    /// Weight per length w = m g (N/m), positive.
    pub weight: f64,
    /// Flexural rigidity EI (N·m²), not negative; slopes can be prescribed only if it is positive.
    pub flexural_rigidity: f64,
    /// Axial stiffness EA (N), positive; infinite for an inextensible ply.
    pub axial_stiffness: f64,
}

/// What holds an end of a span.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EndCondition {
    /// No moment: z'' = 0.
    Free,
    /// A prescribed slope z' = s.
    Slope(f64),
}

impl Span {
    /// Straight distance of the ends √(ℓ²+h²) (m).
    #[must_use]
    pub fn chord(&self) -> f64 {
        self.run.hypot(self.rise)
    }

    /// Load per horizontal length q = w sec θ (N/m).
    #[must_use]
    pub fn load(&self) -> f64 {
        self.weight * self.chord() / self.run
    }

    /// The horizontal force below which the span has buckled (N): the end of the hanging branch.
    ///
    /// −n EI/ℓ² with n = π² (both ends free), 4π² (both slopes prescribed) or the first root of
    /// tan √n = √n (one of each).
    #[must_use]
    pub fn buckling_force(&self) -> f64 {
        -self.buckling_number() * self.flexural_rigidity / (self.run * self.run)
    }

    fn buckling_number(&self) -> f64 {
        const PI2: f64 = std::f64::consts::PI * std::f64::consts::PI;
        match self.ends {
            [EndCondition::Free, EndCondition::Free] => PI2,
            [EndCondition::Slope(_), EndCondition::Slope(_)] => 4.0 * PI2,
            _ => 20.190_728_556_426_63,
        }
    }
}
