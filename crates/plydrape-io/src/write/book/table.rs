//! The plies of a planned book as plain text.

use super::PlyRecord;
use crate::text::table::aligned;

/// One row a ply, in the order in which they are laid.
#[must_use]
pub fn table(plies: &[PlyRecord]) -> String {
    let titles = ["order", "ply", "lies on", "verdict", "motion s", "drapes", "worst limit"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(plies.iter().enumerate().map(|(n, ply)| {
        vec![
            (n + 1).to_string(),
            ply.name.clone(),
            ply.lies_on_text(),
            if ply.accepted { "accepted" } else { "not accepted" }.into(),
            format!("{:.1}", ply.motion_s),
            ply.evaluations.to_string(),
            ply.worst_text(),
        ]
    }));
    aligned(&rows, &[1, 2, 3, 6])
}
