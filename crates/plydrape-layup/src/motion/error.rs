//! Why positions cannot become a motion, and what to do about it.

/// Why positions cannot become a motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// There is nothing to move.
    #[error("a motion needs at least one step with at least one gripper")]
    Empty,
    /// A step has another number of grippers than the first.
    #[error(
        "step {step} has {found} grippers and the first step {expected}: give every gripper a position in every step"
    )]
    Unequal {
        /// Counts from 1.
        step: usize,
        /// Grippers in that step.
        found: usize,
        /// Grippers in the first step.
        expected: usize,
    },
    /// There are not as many positions as the motion has steps.
    #[error(
        "{found} lists of positions were given and the motion has {expected} steps: give one a step"
    )]
    Steps {
        /// Lists given.
        found: usize,
        /// Steps of the motion.
        expected: usize,
    },
    /// A motion or its attitudes are of another grid.
    #[error("{found} grippers move and the grid has {expected}: give both the same grippers")]
    Grippers {
        /// Grippers of the motion or the attitudes.
        found: usize,
        /// Grippers of the grid.
        expected: usize,
    },
    /// A coordinate is NaN, infinite or farther than any robot reaches.
    #[error(
        "gripper {gripper} in step {step} is at {position:?} m: coordinates are numbers up to {most:e} m"
    )]
    Place {
        /// Counts from 1.
        step: usize,
        /// Index of the gripper.
        gripper: usize,
        /// Where it was put (m).
        position: [f64; 3],
        /// Largest coordinate (m).
        most: f64,
    },
    /// A limit is out of range.
    #[error("the limit of the {quantity} is {value}: give a number from {least:e} to {most:e}")]
    Limit {
        /// `speed`, `acceleration` or `jerk`.
        quantity: &'static str,
        /// The value of the caller (SI).
        value: f64,
        /// Least value (SI).
        least: f64,
        /// Largest value (SI).
        most: f64,
    },
    /// A recorded time law is none of the recorded path.
    #[error("the recorded time law does not belong to the recorded path: plan again")]
    Law,
    /// A rate is no number above zero.
    #[error("{rate} samples a second: give a rate above 0 Hz")]
    Rate {
        /// The value of the caller (Hz).
        rate: f64,
    },
    /// The dense motion would be larger than a motion may be.
    #[error(
        "{rate} Hz over {duration:.3} s and {grippers} grippers are {samples:e} samples; {most} are the most: choose a rate below {largest_rate:.3e} Hz"
    )]
    TooManySamples {
        /// The value of the caller (Hz).
        rate: f64,
        /// Duration of the motion (s).
        duration: f64,
        /// Number of grippers.
        grippers: usize,
        /// Samples that the rate asks for.
        samples: f64,
        /// Most samples.
        most: usize,
        /// Largest rate with that number (Hz).
        largest_rate: f64,
    },
    /// Times of attitudes are not one a step, or do not ascend.
    #[error("{steps} steps of attitudes at {times} times: give one finite time a step, ascending")]
    Times {
        /// Steps given.
        steps: usize,
        /// Times given.
        times: usize,
    },
    /// A quaternion has no direction.
    #[error(
        "gripper {gripper} in step {step} has the quaternion {quaternion:?}: its length must be about 1"
    )]
    Quaternion {
        /// Counts from 1.
        step: usize,
        /// Index of the gripper.
        gripper: usize,
        /// The value of the caller (x, y, z, w).
        quaternion: [f64; 4],
    },
}
