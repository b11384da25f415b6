//! Missing nodes: parts of the ideal drape without a place on the mold; none may be missing.

use super::{Description, Measure, Scope, Unit};

/// Missing nodes; see the head of this file.
pub struct MissingNodes;

impl Measure for MissingNodes {
    fn description(&self) -> Description {
        let own = Description::new("missing_nodes", "missing_nodes", "missing nodes", Unit::COUNT);
        Description { scope: Scope::Whole, ..own }
    }
}
