//! Force: the largest horizontal force of an edge that hangs from gripper to gripper, as the model has it for its line.
//!
//! Segments that the mold holds are left out: their force is that of the axial stiffness, and so are diagonals, which
//! are no fibers.

use super::{Bound, Description, Found, Measure, Most, Observation, Unit, Worth};

/// Force; see the head of this file.
pub struct Force;

impl Measure for Force {
    fn description(&self) -> Description {
        let own = Description::of_catenaries("force", "force_n", "horizontal force", Unit::NEWTON);
        Description { worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(Bound::force("Horizontal force of a span").such_as(20.0))
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mut most = Most::default();
        for (_, line) in seen.edges().filter(|(_, line)| line.hangs) {
            if let Some(force) = line.force {
                most.meet(force.abs(), line.site, line.place);
            }
        }
        most.found()
    }
}
