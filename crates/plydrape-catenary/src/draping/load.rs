//! Forces of the ply on each gripper: vertical load and horizontal pretension.
//!
//! Each family of edges has the weight of the whole ply in the model, so where there are two families each counts half. A line inside the
//! ply stands for a strip one cell wide, one on its boundary for half a strip. So the loads of a hanging ply add up to its weight.

use super::Snapshot;
use crate::layup::Layup;

/// The forces of the ply on all grippers (N), in the order of [`crate::ply::Ply::index`].
///
/// A span between two grippers pulls with its forces. Where the mold holds a segment at its other end, the tension is an
/// artifact of the axial stiffness; half of its weight counts.
#[must_use]
pub fn forces(layup: &Layup, snapshot: &Snapshot) -> Vec<[f64; 3]> {
    let (ply, lines) = (&layup.ply, layup.ply.lines());
    let mut out = vec![[0.0; 3]; ply.grippers()];
    for span in snapshot.shape.spans.iter().filter(|span| span.catenary < lines.edges()) {
        let share = lines.tributary(span.catenary);
        let grippers = lines.ends(span.catenary);
        let kind = lines.catenary(span.catenary).kind;
        let half_weight = 0.5 * ply.line(kind).mass * layup.settings.gravity * span.length;
        if snapshot.contacts[span.catenary].is_some() {
            out[grippers[span.segment]][2] -= share * half_weight;
            continue;
        }
        let [x, y] = span.heading();
        for (end, sign) in [(0, -1.0), (1, 1.0)] {
            let on_gripper = &mut out[grippers[end]];
            // each end is drawn towards the other
            let force = -sign * share * span.force.unwrap_or(0.0);
            on_gripper[0] += force * x;
            on_gripper[1] += force * y;
            on_gripper[2] -= share
                * match &span.profile {
                    Some(profile) => sign * profile.station(end as f64 * span.run()).vertical_force,
                    None => half_weight,
                };
        }
    }
    out
}
