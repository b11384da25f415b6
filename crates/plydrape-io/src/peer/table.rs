//! A comparison as plain text, at most 100 columns wide.

use super::{Comparison, NAME, Pair, Touch};
use crate::text::table::{aligned, fixed};

/// Most steps that are shown.
const STEPS: usize = 12;

/// What is compared of the end and of the first touch: words, plydrape's value, the other program's.
pub(crate) fn ends(comparison: &Comparison) -> Vec<[String; 3]> {
    let heights = [
        ("largest height at the end (mm)", comparison.height_max_mm, 2),
        ("its root of the mean square (mm)", comparison.height_rms_mm, 2),
        ("share above the limit (%)", percent(comparison.height_share), 1),
    ];
    let heights = heights.map(|(title, pair, digits)| {
        [title.into(), fixed(pair.plydrape, digits), fixed(pair.peer, digits)]
    });
    let touch = |title: &str, value: fn(&Touch) -> String| {
        let both = &comparison.first_touch;
        let [ours, theirs] = both.each_ref().map(|t| t.as_ref().map_or("–".into(), value));
        [title.into(), ours, theirs]
    };
    let touches = [
        touch("first touch in step", |touch| format!("{:.1}", touch.step)),
        touch("at fabric point u, v (mm)", |Touch { uv_mm: [u, v], .. }| format!("{u:.0}, {v:.0}")),
    ];
    heights.into_iter().chain(touches).collect()
}

/// What the other drape took, in a sentence.
pub(crate) fn cost(comparison: &Comparison) -> String {
    format!(
        "{NAME} took {:.0} s of processor time: {} time steps, {} linear systems, {} time steps refused.",
        comparison.cpu_s, comparison.time_steps, comparison.solves, comparison.refused,
    )
}

/// The end, the first touch, and steps of both drapes side by side.
#[must_use]
pub fn table(comparison: &Comparison) -> String {
    // the end and the first touch
    let mut cells = vec![["", "plydrape", NAME].map(str::to_owned).to_vec()];
    cells.extend(ends(comparison).into_iter().map(|row| row.to_vec()));

    // steps at even distances, from the first to the last
    let mut steps = vec![
        ["step", "lowest mm", "lies %", "shear °", "cup N", "apart mm", "at most", "at u, v mm"]
            .map(str::to_owned)
            .to_vec(),
    ];
    let last = comparison.steps.len().saturating_sub(1);
    let mut shown: Vec<usize> =
        (0..STEPS).map(|n| (n * last + (STEPS - 1) / 2) / (STEPS - 1)).collect();
    shown.dedup();
    for step in shown.into_iter().filter_map(|n| comparison.steps.get(n)) {
        let [u, v] = step.apart_uv_mm;
        steps.push(vec![
            step.step.to_string(),
            both(step.lowest_mm, 1),
            both(percent(step.lies), 0),
            both(step.shear_deg, 1),
            both(step.load_n, 2),
            fixed(Some(step.apart_rms_mm), 2),
            fixed(Some(step.apart_max_mm), 2),
            format!("{u:.0}, {v:.0}"),
        ]);
    }
    format!(
        "{}\n{}\nA pair is plydrape, then {NAME}, whose last state is that at rest. Apart is the distance of\n\
         the same fabric points: root of the mean square over the area, and largest.\n{}\n",
        aligned(&cells, &[0]),
        aligned(&steps, &[]),
        cost(comparison),
    )
}

pub(crate) fn percent(Pair { plydrape, peer }: Pair) -> Pair {
    let percent = |share: Option<f64>| share.map(|share| 100.0 * share);
    Pair { plydrape: percent(plydrape), peer: percent(peer) }
}

fn both(pair: Pair, digits: usize) -> String {
    format!("{}  {}", fixed(pair.plydrape, digits), fixed(pair.peer, digits))
}
