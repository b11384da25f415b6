//! A start that is too low: the ply would hang into the mold before anything moves.
//!
//! What touches in the first step sticks where it must not lie, and no way of the grippers undoes that. So a plan begins higher, with the
//! ply as far from the mold as while it is carried. Whether it touches is seen of the ply itself, hung without a mold, and not of a bound. What hangs beside the
//! cups does not count: it may lie on the mold first, which keeps it from folding under the ply.

use super::transport::is_surely_clear;
use super::tuning::TUNING;
use crate::geometry::Point;
use crate::layup::{Layup, Model};
use crate::mold::Mold;
use crate::planner::evaluation::{Mesh, as_ranked};
use crate::ply::Ply;
use crate::scene::Scene;
use crate::sheet::{self, SheetTuning};
use std::ops::ControlFlow;

/// Times that a height is doubled, and halved again, to find how high a start must be.
const BISECTIONS: u32 = 12;

/// A start at which the ply hangs into the mold between its cups.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LowStart {
    /// How deep it would hang into the mold there (m).
    pub depth: f64,
    /// How much higher a plan starts (m).
    pub raise: f64,
}

impl LowStart {
    /// The low start of a scene whose sheet decides; `None` where the ply hangs clear, or lies on a table first.
    #[must_use]
    pub fn find(scene: &Scene) -> Option<Self> {
        let layup = &scene.layup;
        let mold = layup.mold.as_ref()?;
        let hangs = layup.settings.model == Model::Sheet && layup.pick_up.is_none();
        if !hangs || is_surely_clear(scene, mold) {
            return None;
        }

        // the ply as it hangs where no mold is
        let held =
            Layup { mold: None, target: None, release: None, tool: None, ..layup.held_at_start() };
        let held = as_ranked(held, Mesh::Coarse);
        let go_on = |_: &sheet::Sheet, _: &sheet::ClothState, _| ControlFlow::Continue(());
        let hung = sheet::drape(&held, SheetTuning::default(), &|| false, go_on).ok()?;
        // a ply that does not come to rest says nothing
        if hung.status != sheet::Status::Converged {
            return None;
        }
        let between = between_cups(&layup.ply, &hung.sheet.fabric.places);
        let points: Vec<Point> = between.map(|node| hung.last.positions[node]).collect();

        let depth = -clear(mold, &points, 0.0);
        if depth <= 0.0 {
            return None;
        }
        // as high as it is carried: twice as high until that is enough, then lower again as far as it may
        let margin = TUNING.transport.margin * layup.ply.shorter_side();
        let is_enough = |raise: f64| clear(mold, &points, raise) >= margin;
        let mut doubled = (0..BISECTIONS).map(|n| f64::from(1 << n) * (depth + margin));
        let mut raise = doubled.find(|raise| is_enough(*raise))?;
        let mut low = depth;
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + raise);
            *(if is_enough(middle) { &mut raise } else { &mut low }) = middle;
        }
        Some(LowStart { depth, raise })
    }

    /// The scene with its grippers as much higher at the start.
    #[must_use]
    pub fn raised(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        for place in scene.layup.motion.positions.iter_mut().take(1).flatten() {
            place[2] += self.raise;
        }
        scene
    }
}

/// Which places of the fabric (m) lie between the rows and columns of cups.
fn between_cups<'a>(ply: &Ply, places: &'a [[f64; 2]]) -> impl Iterator<Item = usize> + 'a {
    let (sin, cos) = ply.cut.as_ref().map_or((0.0, 1.0), |cut| cut.turn.sin_cos());
    let along_rows = move |[u, v]: [f64; 2]| [cos * u + sin * v, cos * v - sin * u];
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    for cup in (0..ply.grippers()).map(|n| along_rows(ply.place(n))) {
        (low, high) = ([0, 1].map(|c| low[c].min(cup[c])), [0, 1].map(|c| high[c].max(cup[c])));
    }
    (0..places.len()).filter(move |node| {
        let place = along_rows(places[*node]);
        (0..2).all(|c| (low[c]..=high[c]).contains(&place[c]))
    })
}

/// Least distance of points (m) from the mold if they were higher by `raise` (m); infinite where no mold is above or below any of them.
fn clear(mold: &Mold, points: &[Point], raise: f64) -> f64 {
    let over = points.iter().filter(|[x, y, _]| mold.highest_point([*x, *y]).is_some());
    over.map(|[x, y, z]| mold.signed_distance([*x, *y, z + raise])).fold(f64::INFINITY, f64::min)
}
