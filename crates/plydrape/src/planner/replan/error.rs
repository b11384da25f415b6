//! Why a plan cannot be corrected, and what to do about it.

use crate::LayupError;

/// Why a plan cannot be corrected.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReplanError {
    /// It was corrected before.
    #[error("the plan was corrected for another pick-up already")]
    Again,
    /// Nothing was recorded of the ply on its way.
    #[error("the result has no states of the ply on its way to the mold")]
    NoShapes,
    /// Its sheet was draped with its inertia.
    #[error(
        "the sheet of the plan was draped in real time, and how it swings is another thing along another motion"
    )]
    RealTime,
    /// Its drape ended early.
    #[error("the plan was draped in {steps} of {planned} steps: how its ply lands is not known")]
    Unfinished {
        /// Steps done.
        steps: usize,
        /// Steps of the motion.
        planned: usize,
    },
    /// The ply is on the mold before an offset could be taken out.
    #[error("{}", no_transport(*.clear, *.first))]
    NoTransport {
        /// First step, from 1, in which the ply is clear of what it may lie on.
        clear: usize,
        /// First step in which it touches the mold.
        first: Option<usize>,
    },
    /// The offset is no number, or beyond all cells.
    #[error("the offset is no number, or a shift beyond 10⁶ m, or a yaw beyond half a turn")]
    Numbers,
    /// The ply would touch the mold on the way.
    #[error(
        "{at} would touch the mold before the planned landing, in step {step}: it is {distance_mm:.2} mm from it at ({:.1}, {:.1}, {:.1}) mm, and closer than {tolerance_mm} mm counts as touching",
        1e3 * .place[0], 1e3 * .place[1], 1e3 * .place[2]
    )]
    Touches {
        /// Which part of the ply.
        at: String,
        /// In which step, or on the way to it, from 1.
        step: usize,
        /// Where (m).
        place: [f64; 3],
        /// How far from the mold it is (mm), negative inside it.
        distance_mm: f64,
        /// Distance that counts as touching (mm).
        tolerance_mm: f64,
    },
    /// The turn is too large for the steps that the transport has.
    #[error(
        "the grippers would pull at the ply in step {step}: the distance of two of them changes by {:.3} %, more than {:.3} %",
        1e2 * .change, 1e2 * .limit
    )]
    NotRigid {
        /// In which step, from 1.
        step: usize,
        /// Change of the distance as a share of it.
        change: f64,
        /// The largest that is accepted.
        limit: f64,
    },
    /// Pads press on the way, and the motion must be slower.
    #[error(
        "the motion would have to take {longer:.3} times as long, and pads that let go on the way after a dwell would do so elsewhere"
    )]
    Dwells {
        /// How many times as long.
        longer: f64,
    },
    /// The positions cannot become a motion.
    #[error(transparent)]
    Motion(#[from] LayupError),
}

fn no_transport(clear: usize, first: Option<usize>) -> String {
    match first {
        Some(first) => format!(
            "the ply is clear of what it may lie on from step {clear} on and touches the mold in step {first}: the offset cannot be taken out in between"
        ),
        None => format!(
            "the ply is clear of what it may lie on only from step {clear} on: the offset cannot be taken out after it"
        ),
    }
}

impl ReplanError {
    /// What would help.
    #[must_use]
    pub fn remedy(&self) -> &'static str {
        match self {
            ReplanError::Again => {
                "replan the plan that it came from: the offset is from where that one picks the ply up"
            }
            ReplanError::NoShapes => "plan again, and keep `sheet.npz` beside the result",
            ReplanError::RealTime => {
                "plan with time = \"quasi-static\" in [sheet], or plan again with [grippers] where the ply lies"
            }
            ReplanError::Unfinished { .. } => "replan a plan that was draped to its end",
            ReplanError::NoTransport { .. } => {
                "plan a pick-up farther from the mold or higher above it, or plan again with [grippers] where the ply lies"
            }
            ReplanError::Numbers => "give a shift in mm and a yaw up to 180 deg",
            ReplanError::Touches { .. } => {
                "lay the ply down nearer to where it was planned, or plan again with [grippers] where it lies"
            }
            ReplanError::NotRigid { .. } => {
                "plan with more `steps`, lay the ply down with less yaw, or plan again with [grippers] where it lies"
            }
            ReplanError::Dwells { .. } => {
                "plan with lower limits of speed and acceleration, or without a dwell"
            }
            ReplanError::Motion(_) => "this is a fault of the plan: plan anew",
        }
    }
}
