//! Equilibrium: what is left of the worst residual, in a step whose equilibrium or contact was not found.

use super::{Measure, Scope, Unit};

/// Equilibrium; see the head of this file.
pub struct Equilibrium;

/// Residual (a slope) up to which an equilibrium counts as found.
pub(super) const RESIDUAL: f64 = 1e-6;

impl Measure for Equilibrium {
    fn name(&self) -> &'static str {
        "equilibrium"
    }

    fn label(&self) -> &'static str {
        "equilibrium"
    }

    fn unit(&self) -> Unit {
        Unit::SLOPE
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }
}
