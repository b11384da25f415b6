//! Missing nodes: parts of the ideal drape without a place on the mold; none may be missing.

use super::{Measure, Scope, Unit};

/// Missing nodes; see the head of this file.
pub struct MissingNodes;

impl Measure for MissingNodes {
    fn name(&self) -> &'static str {
        "missing_nodes"
    }

    fn label(&self) -> &'static str {
        "missing nodes"
    }

    fn unit(&self) -> Unit {
        Unit::COUNT
    }

    fn scope(&self) -> Scope {
        Scope::Whole
    }
}
