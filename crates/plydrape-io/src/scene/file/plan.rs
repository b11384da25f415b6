//! The keys of the table `[plan]`.

use crate::scene::located::{Count, Located, Seed};
use crate::scene::quantity::{Quantity, written};
use crate::scene::usual::{Move, Rate};
use plydrape::scene::PlanSettings;
use schemars::JsonSchema;
use serde::Deserialize;

/// How `plydrape plan` looks for the motion; `plydrape simulate` does not read it.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Plan")]
pub(in crate::scene) struct PlanTable {
    /// The planner.
    #[schemars(extend("default" = "path"))]
    pub method: Option<MethodKey>,
    /// Steps of the planned motion, step 1 being the start; of "stepwise" the most it may take. Fewer where the positions of all grippers
    /// in all steps would be more than fifty million.
    #[schemars(extend("default" = PlanSettings::default().steps))]
    pub steps: Option<Located<Count>>,
    /// Farthest that a gripper may move in one step (m). Without it "path" is free, and "stepwise" takes a share
    /// of its way.
    pub move_limit: Option<Quantity<Move>>,
    /// Seed of the search. The same seed gives the same plan.
    #[schemars(extend("default" = PlanSettings::default().seed))]
    pub seed: Option<Located<Seed>>,
    /// Most candidates that the search may drape. Those on which it decides are draped once more. Of grippers on mounts that give it is 4800
    /// divided by their number unless given, 300 at least and 1200 at most, and as many may be draped by a coarse sheet before, which costs a tenth.
    #[schemars(extend("default" = PlanSettings::default().evaluations))]
    pub evaluations: Option<Located<Count>>,
    /// Whether the search goes on improving a plan that keeps every limit with a margin. The planner
    /// "stepwise" improves nothing.
    #[schemars(extend("default" = PlanSettings::default().improve))]
    pub improve: Option<bool>,
    /// Samples a second of the file motion.csv (Hz).
    #[schemars(extend("default" = written(PlanSettings::default().rate, "Hz")))]
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
