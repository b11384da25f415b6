//! Equilibrium: what is left of the worst residual, in a step whose equilibrium or contact was not found.

use super::{Measure, Scope, Unit};

/// Equilibrium; see the head of this file.
pub struct Equilibrium;

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
