//! How one strategy of a comparison came out.

use crate::result::sheet::ended;
use plydrape::measure::{Name, Verdict};
use plydrape::planner::comparison::{Compared, StrategyName};
use plydrape::scene::World;
use serde::Serialize;

/// One strategy of a comparison, as it is printed and written.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// The strategy.
    pub strategy: StrategyName,
    /// Whether its drape keeps all limits.
    pub accepted: bool,
    /// In which world that was judged; no sample of cells with errors is drawn.
    pub world: World,
    /// The time of its motion (s); `None` without a drape.
    pub time_s: Option<f64>,
    /// Whether there is no drape.
    pub not_draped: bool,
    /// Why there is no drape, or why it ended early or without rest.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The limits that decide.
    pub limits: Vec<Verdict>,
    /// The limits that it breaks, the one exceeded furthest first.
    #[serde(skip)]
    pub broken: Vec<Verdict>,
}

impl Row {
    /// The row of a strategy.
    #[must_use]
    pub fn new(compared: Compared) -> Self {
        let strategy = compared.name;
        match compared.drape {
            Ok(draped) => {
                let owned = |limits: Vec<&Verdict>| limits.into_iter().cloned().collect();
                Row {
                    strategy,
                    accepted: draped.is_accepted(),
                    world: draped.drape.summary.world,
                    time_s: Some(draped.time),
                    not_draped: false,
                    note: ended(&draped.drape.summary),
                    limits: owned(draped.limits()),
                    broken: owned(draped.broken()),
                }
            }
            Err(reason) => Row {
                strategy,
                accepted: false,
                world: World::default(),
                time_s: None,
                not_draped: true,
                note: Some(reason.to_string()),
                limits: Vec::new(),
                broken: Vec::new(),
            },
        }
    }

    /// The verdict on one limit.
    #[must_use]
    pub fn limit(&self, name: Name) -> Option<&Verdict> {
        self.limits.iter().find(|verdict| verdict.name == name)
    }
}
