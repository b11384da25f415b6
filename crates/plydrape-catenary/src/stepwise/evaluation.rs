//! Evaluation of a step by the true model.

use super::Task;
use super::tuning::TUNING;
use crate::draping::spans::Equilibrium;
use crate::draping::{Draping, attitude, lying_segments, misfit};
use crate::equilibrium::Status;

/// The largest measures of a state.
#[derive(Debug, Clone, Copy)]
pub struct Evaluation {
    /// The equilibrium was found.
    pub converged: bool,
    /// Largest overstretch of an edge, as a share of the whole edge.
    pub stretch: f64,
    /// Largest tilt of a gripper (rad).
    pub tilt: f64,
}

impl Evaluation {
    pub fn new(task: &Task, draping: &Draping, shape: &Equilibrium) -> Self {
        let (ply, positions) = (&task.layup.ply, &draping.positions);
        let tilt = |n| attitude(&draping.solver, ply, &[], positions, n, None).tilt;
        Evaluation {
            converged: shape.solved.status == Status::Converged,
            stretch: stretch(task, draping, shape),
            tilt: (0..ply.grippers()).map(tilt).fold(0.0, f64::max),
        }
    }

    /// Whether a step keeps its limits, or does not make worse what exceeded them before.
    pub fn is_acceptable(&self, task: &Task, before: &Evaluation) -> bool {
        let limits = &task.limits;
        self.converged
            && self.stretch <= (TUNING.stretch_share * limits.overstretch).max(before.stretch)
            && self.tilt <= limits.tilt.max(before.tilt) * (1.0 + 1e-9)
    }
}

fn stretch(task: &Task, draping: &Draping, shape: &Equilibrium) -> f64 {
    let (ply, lines) = (&task.layup.ply, task.layup.ply.lines());
    let edges = lines.edges();
    let length = |catenary: usize| lines.flat_length(catenary, ply.length_factor);
    let mut worst = 0.0_f64;
    for span in shape.spans.iter().filter(|span| span.catenary < edges) {
        let misfit = misfit(span, draping.contacts[span.catenary].as_ref());
        worst = worst.max(misfit.overstretch() / length(span.catenary));
    }
    let Some(mold) = &task.layup.mold else {
        return worst;
    };
    for (n, contact) in draping.contacts.iter().enumerate().take(edges) {
        let Some(contact) = contact else { continue };
        let ends = lines.ends(n).map(|gripper| draping.positions[gripper]);
        for segment in lying_segments(n, contact, ends, mold, task.layup.settings.contact.tolerance)
        {
            worst = worst.max(segment.misfit.overstretch() / length(n));
        }
    }
    worst
}
