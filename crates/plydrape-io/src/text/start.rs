//! A start that is too low, in words.

use crate::store::shown::millimeters;
use plydrape::planner::path::LowStart;
use plydrape::scene::Scene;

/// What a plan does about a start at which the ply hangs into the mold; `None` where it hangs clear.
#[must_use]
pub fn low(scene: &Scene) -> Option<String> {
    scene.layup.target.as_ref()?;
    let LowStart { depth, raise } = LowStart::find(scene)?;
    // a raise that is too small would not do
    let [depth, raise] = [(1e5 * depth).round(), (1e5 * raise).ceil()].map(|tens| 1e-5 * tens);
    Some(format!(
        "at its start the ply would hang {} mm into the mold, and stick there: a plan starts {} mm higher; raise the start by as much for other motions",
        millimeters(depth),
        millimeters(raise)
    ))
}
