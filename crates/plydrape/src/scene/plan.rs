//! How gripper trajectories are planned.

/// How gripper trajectories are planned.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PlanSettings {
    /// The planner.
    pub method: PlanMethod,
    /// Steps of the planned motion, the start being the first; of the stepwise planner the most it may take.
    pub steps: usize,
    /// Farthest that a gripper may move in one step (m); the stepwise planner needs one and takes a share of
    /// its distance to go where there is none.
    pub move_limit: Option<f64>,
    /// Seed of the search.
    pub seed: u64,
    /// Most candidates that the search may drape. Those on which is decided are draped once more, in the time of their
    /// motion and where the sheet decides with the mesh of the scene. On mounts that give as many are draped by a coarse sheet before.
    pub evaluations: usize,
    /// Whether the search goes on improving a plan that keeps every limit with a margin.
    pub improve: bool,
    /// Samples a second of the dense motion file (Hz).
    pub rate: f64,
}

impl PlanSettings {
    /// How many candidates the search may drape of this many grippers on mounts that give, unless the scene says it: a walk from a good front goes
    /// on as long as it gains, in small steps, and the drape of a small array costs little. 300 of 16 grippers and more, 1200 of 4 and fewer.
    #[must_use]
    pub fn evaluations_on_mounts(grippers: usize) -> usize {
        (4800 / grippers.max(1)).clamp(300, 1200)
    }
}

impl Default for PlanSettings {
    fn default() -> Self {
        let method = PlanMethod::Path;
        PlanSettings {
            method,
            steps: 90,
            move_limit: None,
            seed: 0,
            evaluations: 100,
            improve: false,
            rate: 100.0,
        }
    }
}

/// The planner of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum PlanMethod {
    /// Whole trajectories, judged by complete drapes.
    Path,
    /// Step by step, as Krogh et al. 2018 sketch it.
    Stepwise,
}
