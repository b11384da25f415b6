//! What the ply is made of: mass, flexural rigidity, shear curve and locking angle.

use serde::Serialize;

/// A woven ply, as the catenaries see it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Material {
    /// Name for reports.
    pub name: String,
    /// Where the numbers come from.
    pub source: String,
    /// Mass and bending, per line or per area.
    pub section: Section,
    /// Picture-frame shear force per length τ(γ); `None` leaves shear forces unknown.
    pub shear_curve: Option<ShearCurve>,
    /// Shear angle at which the weave locks (rad), with the test that found it.
    pub locking_angle: Option<f64>,
}

/// Mass and flexural rigidity of the ply.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Section {
    /// The same for every catenary, as in the paper.
    Line {
        /// Mass per length m (kg/m).
        mass: f64,
        /// Flexural rigidity EI (N·m²).
        flexural_rigidity: f64,
    },
    /// Per area; each catenary stands for a strip of the ply one cell wide.
    Areal {
        /// Areal mass (kg/m²).
        mass: f64,
        /// Bending rigidity per width along the warp (N·m).
        warp_rigidity: f64,
        /// Bending rigidity per width along the weft (N·m).
        weft_rigidity: f64,
    },
}

/// Mass per length and flexural rigidity of one catenary.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Line {
    /// Mass per length m (kg/m).
    pub mass: f64,
    /// Flexural rigidity EI (N·m²).
    pub flexural_rigidity: f64,
}

/// Picture-frame shear force per length over the shear angle.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum ShearCurve {
    /// Measured points (γ in rad ascending from 0, τ in N/m), joined by a monotone cubic.
    Table {
        /// Shear angles γ (rad).
        angle: Vec<f64>,
        /// Shear force per length τ (N/m).
        force: Vec<f64>,
    },
    /// τ = Σ cᵢ γⁱ⁺¹ (N/m, γ in rad): no constant term, so that τ(0) = 0.
    Polynomial {
        /// Coefficients c₀, c₁, … of γ, γ², …
        coefficients: Vec<f64>,
    },
}
