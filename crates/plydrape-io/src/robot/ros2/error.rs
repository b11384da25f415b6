//! Why a result has no ROS 2 messages.

use crate::OutputError;

/// Why a result has no ROS 2 messages.
#[derive(Debug, thiserror::Error)]
pub enum Ros2Error {
    /// A time that a message cannot say.
    #[error(
        "point {point} is at {time} s, but ROS 2 takes times from 0 to 2147483647 s: let the motion begin at 0"
    )]
    Time {
        /// Which point of the trajectory, from 1.
        point: usize,
        /// Its time (s).
        time: f64,
    },
    /// A time that is not after the one before.
    #[error(
        "point {point} at {time} s is less than a nanosecond after the one before, and ROS 2 would take both for one: leave one of them out of the motion"
    )]
    Order {
        /// Which point of the trajectory, from 1.
        point: usize,
        /// Its time (s).
        time: f64,
    },
    /// The message has no bytes.
    #[error("cannot encode a ROS 2 message: {0}")]
    Cdr(#[from] cdr_encoding::Error),
    /// The message has no text.
    #[error("cannot write a ROS 2 message as YAML: {0}")]
    Yaml(#[from] serde_saphyr::ser::Error),
    /// The bag could not be made.
    #[error("cannot make the bag: {0}")]
    Bag(#[from] mcap::McapError),
    /// A message for a topic that the bag does not have; a fault of plydrape.
    #[error("the bag has no topic {0}; this is a fault of plydrape, please report it")]
    Topic(&'static str),
}

impl From<Ros2Error> for OutputError {
    fn from(error: Ros2Error) -> Self {
        OutputError::Writer(error.into())
    }
}
