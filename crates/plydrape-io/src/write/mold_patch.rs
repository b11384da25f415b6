//! The mold under a drape, in triangles: as far as the grippers go, and a little beyond.

use crate::result::ResultFile;
use plydrape::mold::patch::{Triangles, patch};

/// How far the mold is shown beyond the grippers, as a share of the longer side of what they cover.
const BEYOND: f64 = 0.15;

/// The rectangle of the plan that the grippers cover in all steps and at the target: lowest and highest x and y
/// (m); `None` for a result without steps and target.
pub(crate) fn extent(result: &ResultFile) -> Option<[[f64; 2]; 2]> {
    let places = result.steps.iter().flat_map(|step| &step.grippers).map(|g| g.position);
    let targets = result.scene.target_grippers().into_iter().flatten().copied();
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for place in places.chain(targets) {
        for c in 0..2 {
            low[c] = low[c].min(place[c]);
            high[c] = high[c].max(place[c]);
        }
    }
    low.iter().chain(&high).all(|c| c.is_finite()).then_some([low, high])
}

/// The mold under all steps and the target, in at most this many triangles; `None` without a mold there.
#[must_use]
pub fn mold_patch(result: &ResultFile, most: usize) -> Option<Triangles> {
    let mold = result.scene.mold.as_ref()?;
    let [low, high] = extent(result)?;
    let more = BEYOND * (high[0] - low[0]).max(high[1] - low[1]);
    let found = patch(mold, low.map(|c| c - more), high.map(|c| c + more), most);
    (!found.triangles.is_empty()).then_some(found)
}
