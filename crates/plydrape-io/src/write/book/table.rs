//! The plies of a planned book as plain text.

use super::PlyRecord;
use crate::text::table::{accepted_in, aligned};
use plydrape::scene::World;

/// One row a ply, in the order in which they are laid; below them the worlds in which plies are accepted, where those have no errors.
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
    let worlds: Vec<World> = plies.iter().filter(|ply| ply.accepted).map(|ply| ply.world).collect();
    aligned(&rows, &[1, 2, 3, 6]) + &accepted_in(&worlds)
}
