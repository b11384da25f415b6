//! What limits the time of a planned motion, as plain text.

use super::{aligned, significant};
use crate::result::ResultFile;
use plydrape::planner::LimitedBy;
use plydrape::ply::gripper_name;

/// One row for each limit that the motion meets, that of the longest time first; empty of a result without a plan.
#[must_use]
pub fn limited_by(result: &ResultFile) -> String {
    if let Some(slowed) = result.plan.as_ref().and_then(|plan| plan.slowed) {
        return format!(
            "{} times slower than its limits ask for: the resin of the ply takes its time\n",
            significant(slowed)
        );
    }
    let limited_by = result.plan.as_ref().map_or(&[][..], |plan| &plan.limited_by);
    let whole: f64 = limited_by.iter().map(|limit| limit.time_s).sum();
    if limited_by.is_empty() || whole <= 0.0 {
        return String::new();
    }
    let row = |LimitedBy { name, time_s, gripper }: &LimitedBy| {
        let who = gripper.as_ref().map_or_else(
            || "frame of the tool".to_owned(),
            |gripper| format!("gripper {}", gripper_name(*gripper)),
        );
        let share = format!("{:.0} %", 100.0 * time_s / whole);
        vec![name.measure().label().to_owned(), format!("{time_s:.2}"), share, who]
    };
    let titles = ["what limits its time", "s", "share", "most of it at"];
    let mut rows = vec![titles.map(str::to_owned).to_vec()];
    rows.extend(limited_by.iter().map(row));
    aligned(&rows, &[0, 3])
}
