//! How the grippers must move so that the ply ends where the ideal drape has it, without wrinkles.
//!
//! 1. [`infeasible_limits`]: limits that no plan can keep, found before any search;
//! 2. [`path`]: whole trajectories of few parameters, evaluated by complete drapes, on all cores;
//! 3. [`stepwise`]: step by step, each step a quadratic program, as Krogh et al. 2018 sketch it;
//! 4. [`sensitivity`]: the quantities of a solved ply that both planners weigh, with exact gradients;
//! 5. `evaluation`: the complete drape along a plan, and its score against the limits; `decision`: the motion in time and
//!    the drape that decides;
//! 6. `search_state`: progress of a search that runs; [`Checkpoint`]: its result, from which another search continues;
//! 7. [`tuning`]: the constants that both planners share;
//! 8. `plan`: from a scene to a motion in time and the drape along it;
//! 9. `quickest`: the time-optimal law of a plan under the limits of grippers, joints and tool;
//! 10. [`comparison`]: the strategies that have a name, side by side;
//! 11. [`replan`]: a plan for a ply that lies elsewhere than planned.

mod checkpoint;
pub mod comparison;
mod decision;
mod evaluation;
pub mod infeasible_limits;
pub mod path;
mod plan;
mod program;
mod quickest;
pub mod record;
pub mod replan;
pub mod row;
mod search_state;
pub mod sensitivity;
pub mod stepwise;
pub mod tuning;

pub use checkpoint::Checkpoint;
pub use plan::{PlanError, Planned, along, plan, plan_without_errors};
pub use record::{LimitedBy, PickedUp, PlanRecord};
pub use search_state::{Progress, Watcher};
