//! How the grippers must move so that the ply ends where the ideal drape has it, without wrinkles.
//!
//! 1. [`infeasible_limits`]: limits that no plan can keep, found before any search; `spring_back`: a ply that does not stay where it is laid;
//! 2. [`path`]: whole trajectories of few parameters, evaluated by complete drapes, on all cores;
//! 3. [`stepwise`]: step by step, each step a quadratic program, by the planner of the catenaries, [`plydrape_catenary::stepwise`];
//! 4. [`sensitivity`]: a drape by catenaries with the derivatives of its end;
//! 5. `evaluation`: the complete drape along a plan, and its score against the limits; `decision`: the motion in time and
//!    the drape that decides;
//! 6. `search_state`: progress of a search that runs; [`Checkpoint`]: its result, from which another search continues; `journal`: what
//!    it has judged, from which one that was cut off goes on;
//! 7. [`tuning`]: the constants of the evaluation;
//! 8. `plan`: from a scene to a motion in time and the drape along it;
//! 9. `quickest`: the time-optimal law of a plan under the limits of grippers, joints and tool;
//! 10. `cycle`: what the grippers do before the drape and after it;
//! 11. [`comparison`]: the strategies that have a name, side by side;
//! 12. [`replan`]: a plan for a ply that lies elsewhere than planned;
//! 13. `tried`: changes of a scene without a plan, each of them tried.

mod checkpoint;
pub mod comparison;
mod cycle;
mod decision;
#[cfg(test)]
mod decision_tests;
mod evaluation;
#[cfg(test)]
mod evaluation_tests;
pub mod infeasible_limits;
mod journal;
pub mod path;
mod plan;
mod quickest;
pub mod record;
pub mod replan;
#[cfg(test)]
mod sample;
mod search_state;
pub mod sensitivity;
mod spring_back;
pub mod stepwise;
mod tried;
pub mod tuning;

pub use checkpoint::Checkpoint;
pub use cycle::{Cycle, RecordedMotion};
pub use plan::{Planned, along, plan, plan_without_errors};
pub use record::{LimitedBy, PickedUp, PlanRecord};
pub use search_state::{Progress, Watcher};
pub use tried::{Change, Near, TRYING, Tried};
