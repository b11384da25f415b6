//! The keys of the table `[plan]`.

use crate::scene::located::{Count, Located, Seed};
use crate::scene::quantity::Quantity;
use crate::scene::usual::{Move, Rate};
use schemars::JsonSchema;
use serde::Deserialize;

/// How `plydrape plan` looks for the motion; `plydrape simulate` does not read it.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Plan")]
pub(in crate::scene) struct PlanTable {
    /// The planner, "path" unless given.
    pub method: Option<MethodKey>,
    /// Steps of the planned motion, step 1 being the start; of "stepwise" the most it may take. Unless given 90, or as many as
    /// keep the positions of all grippers in all steps below fifty million.
    pub steps: Option<Located<Count>>,
    /// Farthest that a gripper may move in one step (m). Without it "path" is free, and "stepwise" takes a share
    /// of its way.
    pub move_limit: Option<Quantity<Move>>,
    /// Seed of the search, 0 unless given: the same seed, the same plan.
    pub seed: Option<Located<Seed>>,
    /// Most candidates that the search may drape, 100 unless given; those on which it decides are draped once more.
    pub evaluations: Option<Located<Count>>,
    /// Whether the search goes on improving a plan that keeps every limit with a margin, false unless given. The planner
    /// "stepwise" improves nothing.
    pub improve: Option<bool>,
    /// Samples a second of the file motion.csv (Hz), 100 unless given.
    pub rate: Option<Quantity<Rate>>,
}

/// The planner of a motion.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Method")]
pub(in crate::scene) enum MethodKey {
    /// Whole trajectories, judged by complete drapes.
    Path,
    /// Step by step, as Krogh et al. 2018 sketch it.
    Stepwise,
}
