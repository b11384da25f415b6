//! Whether gripper positions are such that the model has a solution, and times such that a motion has them.
//!
//! Scene files, tables and programs are held to the same: coordinates are finite and up to [`FARTHEST`], neighbors stand a
//! horizontal distance apart, because a span straight up has no horizontal force, and times ascend.

use super::{Catenary, GripperId, Ply, gripper_name};

/// Largest coordinate of a gripper (m): far beyond any robot, and far from where squares of distances overflow.
pub const FARTHEST: f64 = 1e6;
/// Least horizontal distance of neighbors as a share of the fabric between them: a span has no solution straight up.
pub const STEEPEST: f64 = 0.01;

/// Why gripper positions or their times are refused.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlaceError {
    /// There are more or fewer positions than grippers.
    #[error("there are {found} positions{}; the ply has {expected} grippers: give each of them one position", in_step(.step))]
    Count {
        /// Counts from 1; none of positions that belong to no step.
        step: Option<usize>,
        /// Positions given.
        found: usize,
        /// Grippers of the ply.
        expected: usize,
    },
    /// A coordinate is NaN, infinite or farther than any robot reaches.
    #[error("gripper {} is at {position:?} m{}: coordinates are finite numbers up to {FARTHEST:e} m", gripper_name(*gripper), in_step(.step))]
    Far {
        /// Counts from 1; none of positions that belong to no step.
        step: Option<usize>,
        /// The gripper.
        gripper: GripperId,
        /// Where it was put (m).
        position: [f64; 3],
    },
    /// Neighbors are (all but) straight above each other, or at one place.
    #[error(
        "grippers {} and {} are only {:.3} mm apart in plan{}; the ply between them is {:.2} mm: move them apart, because a span needs a horizontal distance of 1 % of its fabric or more",
        gripper_name(*a), gripper_name(*b), run * 1e3, in_step(.step), length * 1e3
    )]
    Steep {
        /// Counts from 1; none of positions that belong to no step.
        step: Option<usize>,
        /// One gripper.
        a: GripperId,
        /// The other.
        b: GripperId,
        /// Their horizontal distance (m).
        run: f64,
        /// Fabric between them in the flat ply (m).
        length: f64,
    },
    /// Times and steps of positions do not go together, or there are none.
    #[error(
        "there are {times} times and {steps} steps of positions: give as many of both, at least one"
    )]
    Steps {
        /// Times given.
        times: usize,
        /// Steps of positions given.
        steps: usize,
    },
    /// A time is not finite, or not after the one before.
    #[error("the time of step {step} is {time} s{}: times are finite numbers that ascend", after(.before))]
    Time {
        /// Counts from 1.
        step: usize,
        /// Its time (s).
        time: f64,
        /// Time of the step before (s).
        before: Option<f64>,
    },
}

impl PlaceError {
    /// The same fault in a step, counted from 1.
    #[must_use]
    pub(crate) fn at_step(mut self, number: usize) -> Self {
        if let PlaceError::Count { step, .. }
        | PlaceError::Far { step, .. }
        | PlaceError::Steep { step, .. } = &mut self
        {
            *step = Some(number);
        }
        self
    }
}

fn in_step(step: &Option<usize>) -> String {
    step.map(|step| format!(" in step {step}")).unwrap_or_default()
}

fn after(before: &Option<f64>) -> String {
    before.map(|before| format!(", after {before} s in the step before")).unwrap_or_default()
}

/// Whether every coordinate (m) is a number up to [`FARTHEST`]; NaN and infinity are not.
#[must_use]
pub fn is_near(position: &[f64; 3]) -> bool {
    position.iter().all(|x| x.abs() <= FARTHEST)
}

impl Ply {
    /// Refuses gripper positions (m, in the order of [`super::Ply::index`]) for which the model has no solution.
    ///
    /// # Errors
    /// [`PlaceError`]: the first gripper, or pair of neighbors, that cannot be where it is.
    pub fn check_places(&self, positions: &[[f64; 3]]) -> Result<(), PlaceError> {
        let (found, expected) = (positions.len(), self.grippers());
        if found != expected {
            return Err(PlaceError::Count { step: None, found, expected });
        }
        if let Some(far) = positions.iter().position(|position| !is_near(position)) {
            let (gripper, position) = (self.id(far), positions[far]);
            return Err(PlaceError::Far { step: None, gripper, position });
        }
        let lines = self.lines();
        (0..lines.catenaries()).try_for_each(|index| {
            let Catenary { from: a, to: b, .. } = lines.catenary(index);
            let [from, to] = lines.ends(index).map(|gripper| positions[gripper]);
            let (run, length) = (
                (to[0] - from[0]).hypot(to[1] - from[1]),
                lines.flat_length(index, self.length_factor),
            );
            if run >= STEEPEST * length {
                return Ok(());
            }
            Err(PlaceError::Steep { step: None, a, b, run, length })
        })
    }
}
