//! How one strategy of a comparison came out.

use crate::ResultFile;
use crate::sheet::{self, SheetDrapeError, ended};
use plydrape::measure::{Name, Verdict};
use plydrape::planner::comparison::{Compared, StrategyName};
use plydrape::scene::Scene;
use serde::Serialize;
use std::path::Path;

/// One strategy of a comparison, as it is printed and written.
#[derive(Debug, Clone, Serialize)]
pub struct Row {
    /// The strategy.
    pub strategy: StrategyName,
    /// Whether its drape keeps all limits.
    pub accepted: bool,
    /// The time of its motion (s); none without a drape.
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
    /// Its drape.
    #[serde(skip)]
    pub result: Option<ResultFile>,
}

impl Row {
    /// The row of a strategy; the states of its sheet are kept in a hidden folder within `dir`.
    ///
    /// # Errors
    /// If the disk refuses.
    pub fn new(scene: &Scene, compared: Compared, dir: &Path) -> Result<Self, SheetDrapeError> {
        let strategy = compared.name;
        let draped = match compared.drape {
            Ok(draped) => draped,
            Err(reason) => {
                return Ok(Row {
                    strategy,
                    accepted: false,
                    time_s: None,
                    not_draped: true,
                    note: Some(reason.to_string()),
                    limits: Vec::new(),
                    broken: Vec::new(),
                    result: None,
                });
            }
        };
        let owned = |limits: Vec<&Verdict>| limits.into_iter().cloned().collect();
        let (limits, broken) = (owned(draped.limits()), owned(draped.broken()));
        let (accepted, time_s) = (draped.is_accepted(), Some(draped.time));
        let result = ResultFile::new(scene, None, sheet::keep(draped.drape, dir)?);
        let (note, result) = (ended(&result.summary), Some(result));
        Ok(Row { strategy, accepted, time_s, not_draped: false, note, limits, broken, result })
    }

    /// The verdict on one limit.
    #[must_use]
    pub fn limit(&self, name: Name) -> Option<&Verdict> {
        self.limits.iter().find(|verdict| verdict.name == name)
    }
}
