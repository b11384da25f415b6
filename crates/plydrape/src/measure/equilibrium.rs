//! Equilibrium: what is left of the worst residual, in a step whose equilibrium or contact was not found.

use super::{Description, Measure, Scope, Unit};

/// Equilibrium; see the head of this file.
pub struct Equilibrium;

impl Measure for Equilibrium {
    fn description(&self) -> Description {
        let own = Description::new("equilibrium", "equilibrium", "equilibrium", Unit::SLOPE);
        Description { scope: Scope::Whole, ..own }
    }
}
