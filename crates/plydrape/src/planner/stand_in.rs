//! A stand-in for the planners: the motion of the scene itself, drawn out in time. To be deleted with them.

use super::Progress;
use super::obstacles::obstacles;
use crate::draping::{Drape, simulate};
use crate::mold::distance;
use crate::scene::{PlanMethod, Scene};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// What a search remembers, for another to go on from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Memory {
    /// Drapes tried in all searches.
    pub evaluations: usize,
}

/// A motion in time.
pub struct TimedMotion {
    duration: f64,
    peaks: Peaks,
}

/// Largest rates of any gripper.
#[derive(Debug, Clone, Copy)]
pub struct Peaks {
    /// Speed (m/s).
    pub speed: f64,
    /// Acceleration (m/s²).
    pub acceleration: f64,
    /// Jerk (m/s³).
    pub jerk: f64,
}

impl TimedMotion {
    /// From rest to rest (s).
    pub fn duration(&self) -> f64 {
        self.duration
    }

    /// The motion sampled, as a table.
    ///
    /// # Errors
    /// None of this stand-in.
    pub fn csv(&self, rate: f64) -> Result<String, csv::Error> {
        let step = 1.0 / rate;
        Ok(format!("t (s)\n0.0\n{step:?}\n"))
    }

    /// Largest rates of any gripper.
    pub fn peaks(&self) -> Peaks {
        self.peaks
    }
}

/// A finished plan.
pub struct Planned {
    /// Its drape.
    pub drape: Drape,
    /// The planner.
    pub method: PlanMethod,
    /// Drapes tried.
    pub evaluations: usize,
    /// The motion in time.
    pub motion: TimedMotion,
    /// Whether the search was broken off.
    pub interrupted: bool,
    /// What the search remembers.
    pub memory: Memory,
}

/// Why there is no plan.
#[derive(Debug, thiserror::Error)]
pub enum PlanError {
    /// The scene has nothing to drape on, or nowhere to go.
    #[error("the scene has no mold or no target")]
    Scene,
}

/// The motion of the scene as its plan.
///
/// # Errors
/// A scene without mold or target.
pub fn plan(
    scene: &Scene,
    memory: Option<&Memory>,
    progress: &mut dyn FnMut(&Progress) -> ControlFlow<()>,
) -> Result<Planned, PlanError> {
    if scene.mold.is_none() || scene.target.is_none() {
        return Err(PlanError::Scene);
    }
    let most = scene.plan.evaluations;
    let before = memory.map_or(0, |memory| memory.evaluations);
    let mut drape = simulate(scene, |_| ControlFlow::Continue(()));
    let (mut evaluations, mut interrupted) = (1, false);
    while evaluations < most && !interrupted {
        drape = simulate(scene, |_| ControlFlow::Continue(()));
        evaluations += 1;
        let summary = &drape.result.summary;
        let (best, accepted) = (summary.limits.as_slice(), summary.accepted);
        interrupted =
            progress(&Progress { evaluations, most, stage: "straight", best, accepted }).is_break();
    }
    let (first, last) = (scene.motion.positions.first(), scene.motion.positions.last());
    let ways = first.into_iter().flatten().zip(last.into_iter().flatten());
    let way = ways.map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
    let speed = scene.limits.speed;
    drape.result.summary.judge_also(obstacles(scene));
    Ok(Planned {
        drape,
        method: scene.plan.method,
        evaluations,
        motion: TimedMotion {
            duration: way / speed,
            peaks: Peaks {
                speed,
                acceleration: scene.limits.acceleration,
                jerk: scene.limits.jerk,
            },
        },
        interrupted,
        memory: Memory { evaluations: before + evaluations },
    })
}
