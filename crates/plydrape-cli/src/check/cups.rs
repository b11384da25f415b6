//! The cups of an array over a ply that is cut, as text: which of them hold, and why the others do not.

use super::SummaryLine;
use super::limits::packed;
use crate::numbers::millimeters;
use plydrape::ply::{GripperId, gripper_name};
use plydrape_io::scene::{CupArray, LeftOff, SceneFile};

/// Most cups that are named for one reason.
const NAMED: usize = 6;

/// How many cups of the array hold, and where it lies over the ply.
pub(super) fn cups(scene: &SceneFile) -> Vec<SummaryLine> {
    let Some(CupArray { cups, left_off, off }) = &scene.cups else { return Vec::new() };
    let mut parts = match left_off.len() {
        0 => vec![format!("all {cups} cups of the array hold")],
        without => vec![format!("{} of {cups} cups of the array hold", cups - without)],
    };
    let reasons = [
        (LeftOff::Beside, "beside the ply"),
        (LeftOff::Hole, "over a hole"),
        (LeftOff::Partly, "only partly on the ply"),
        (LeftOff::Off, "switched off by `holds`"),
    ];
    for (reason, words) in reasons {
        let ids: Vec<GripperId> =
            left_off.iter().filter(|cup| cup.why == reason).map(|cup| cup.id).collect();
        if !ids.is_empty() {
            parts.push(format!("{} {words} ({})", ids.len(), names(&ids)));
        }
    }
    let [x, y] = off.map(millimeters);
    if *off != [0.0; 2] {
        parts.push(format!("the array's middle is ({x}, {y}) mm from that of the ply"));
    }
    packed("", &parts).into_iter().map(|text| ("", text)).collect()
}

/// The names of cups, the first few of many.
fn names(ids: &[GripperId]) -> String {
    let named: Vec<String> = ids.iter().take(NAMED).map(|id| gripper_name(*id)).collect();
    let more = if ids.len() > NAMED { ", …" } else { "" };
    named.join(", ") + more
}
