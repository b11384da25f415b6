//! What is known of a plan before any search, in words: a start that is too low, and an edge that no motion lays flat.

use crate::store::shown::{millimeters, rounded};
use crate::text::table::verdict_text;
use plydrape::layup::{Friction, Model};
use plydrape::measure::{Name, Verdict};
use plydrape::planner::path::LowStart;
use plydrape::ply::{Kind, Ply, Ruck};
use plydrape::scene::Scene;
use std::f64::consts::{FRAC_1_SQRT_2, SQRT_2};

/// Every warning, in a sentence.
#[must_use]
pub fn foreseen(scene: &Scene) -> Vec<String> {
    low_start(scene).into_iter().chain(overhang(scene)).collect()
}

/// A sentence for each limit that no plan can keep.
#[must_use]
pub fn infeasible(limits: &[Verdict]) -> Vec<String> {
    let sentence =
        |verdict: &Verdict| format!("no plan can keep this limit: {}", verdict_text(verdict));
    limits.iter().map(sentence).collect()
}

/// What a plan does about a start at which the ply hangs into the mold; `None` where it hangs clear.
fn low_start(scene: &Scene) -> Option<String> {
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

/// Fabric that hangs far over its cups above a mold that holds what touches it.
fn overhang(scene: &Scene) -> Option<String> {
    let layup = &scene.layup;
    let sticks =
        matches!(layup.settings.contact.friction, Friction::Stick | Friction::StickForEver);
    if layup.mold.is_none() || layup.settings.model != Model::Sheet || !sticks {
        return None;
    }
    let beyond = reach_beyond_cups(&layup.ply, layup.settings.sheet.overhang);
    let pad = &layup.settings.pad;
    // where the ply bends most easily
    let rucks = [Kind::EdgeU, Kind::EdgeV].into_iter().filter_map(|kind| {
        let line = layup.ply.line(kind);
        // a soft lip holds between nothing and what a rigid one does, by its share of the rigidity
        let rigidity = line.flexural_rigidity * layup.ply.areal_mass() / line.mass;
        let lip = pad.lip.map_or(0.0, |lip| lip.radius * lip.rigidity / (lip.rigidity + rigidity));
        // a corner is a square that is held along two sides, as wide as the pad or its lip leaves it along its diagonal
        let held = FRAC_1_SQRT_2 * pad.radius.max(lip);
        let free = beyond - held;
        let weight = line.mass * layup.settings.gravity;
        let ruck =
            (free > 0.0).then(|| Ruck::of_free_edge(free, line.flexural_rigidity, weight))?;
        Some((held, free, ruck?))
    });
    let (held, free, ruck) = rucks.max_by(|a, b| a.2.height().total_cmp(&b.2.height()))?;
    // it hangs from both sides: lower by what one edge hangs from the other, and as steeply along both
    let (height, slope) = (2.0 * ruck.height(), SQRT_2 * ruck.steepest());
    let [most, steepest] = [Name::Height, Name::OutOfPlane].map(|name| scene.limits.most(name));
    // the height goes as the fourth power of the edge, the slope as the third; a length of three digits is said, which is not warned of
    let share = (most / height).powf(0.25).min((steepest / slope).cbrt());
    (share < 1.0).then(|| {
        format!(
            "the ply reaches up to {} mm beyond the middles of its outer cups. Its corners hang lower than their cups, touch the mold first, and stick short of their places: folds of some {} mm stay beside them, where the limits allow what an edge of {} mm leaves. Cut the ply closer, or move the cups outwards",
            millimeters(rounded(beyond, 3)),
            millimeters(rounded(height.min(free), 3)),
            millimeters(rounded(0.995 * (share * free + held), 3))
        )
    })
}

/// How far the ply reaches beyond its cups (m): the way along the rows or the columns of cups from the corner of its outline that is
/// farthest from a cup, or its overhang.
fn reach_beyond_cups(ply: &Ply, overhang: f64) -> f64 {
    let Some(cut) = &ply.cut else { return overhang };
    let cups: Vec<[f64; 2]> = (0..ply.grippers()).map(|n| ply.place(n)).collect();
    let (sin, cos) = cut.turn.sin_cos();
    let to_cups = |p: &[f64; 2]| {
        let ways = cups.iter().map(|q| {
            let [u, v] = [p[0] - q[0], p[1] - q[1]];
            (cos * u + sin * v).abs().max((cos * v - sin * u).abs())
        });
        ways.fold(f64::INFINITY, f64::min)
    };
    cut.outline.boundary().iter().map(to_cups).fold(0.0, f64::max)
}
