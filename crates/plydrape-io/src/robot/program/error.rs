//! Why there is no program, and what to do about it.

use crate::OutputError;

/// Why there is no program.
#[derive(Debug, thiserror::Error)]
pub enum ProgramError {
    /// The motion is not accepted, and nobody said that it shall be written nevertheless.
    #[error(
        "the motion is not accepted, and these files would drive a machine along it ({verdict}): change the scene or plan again, or write them with --even-if-rejected (in Python even_if_rejected=True); they then say so in their heads"
    )]
    Rejected {
        /// The verdict.
        verdict: String,
    },
    /// There is no arm that such a program could be for.
    #[error(
        "a program in {format} is for one arm that carries the array, but the grippers of this scene are free: say in [tool] how the array is carried, or write the motion of each gripper with --to ros2 or --to csv"
    )]
    NoFlange {
        /// The format.
        format: &'static str,
    },
    /// No first time, or not 0.
    #[error("the motion has no point at 0 s: let it begin there")]
    Start,
    /// A time that is not after the one before.
    #[error(
        "point {point} at {time} s is not after the one before: leave one of them out of the motion"
    )]
    Times {
        /// Which, from 1.
        point: usize,
        /// Its time (s).
        time: f64,
    },
    /// A list of another length, or with a number that is none.
    #[error("{what} has not one finite value for each time of the program")]
    Values {
        /// Of what.
        what: String,
    },
    /// A tolerance that is no number above 0.
    #[error("a {what} of {value} cannot be kept: give a number above 0")]
    Tolerance {
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// More outputs than a controller has.
    #[error(
        "{format} has {most} digital outputs of its own, and {needed} are needed for the vacuum of the array: switch it by other means in a copy of the template, with --template (plydrape template {format} prints it)"
    )]
    Outputs {
        /// The format.
        format: &'static str,
        /// How many it has.
        most: usize,
        /// How many are needed.
        needed: usize,
    },
    /// The arm stops on the way while the axes go on.
    #[error(
        "the arm stops on the way, {why}, and the {axes} axes of the array, which another controller moves, would go on without it: let all pads let go at the end (order = \"end\" in [release]), let one controller move arm and axes (--to ros2), or hold the two together in a copy of the template, with --template (plydrape template {format} prints it)"
    )]
    ApartOnTheWay {
        /// The format.
        format: &'static str,
        /// Why it stops.
        why: String,
        /// How many axes.
        axes: usize,
    },
    /// A template that is none, or that asks for what is not there.
    #[error("the template {name} cannot be used: {reason}")]
    Template {
        /// Its name.
        name: String,
        /// Why.
        reason: String,
    },
}

impl From<ProgramError> for OutputError {
    fn from(error: ProgramError) -> Self {
        OutputError::Writer(error.into())
    }
}
