//! The mold as signed distance on a grid around its surface, under all of the motion.

use crate::result::ResultFile;
use crate::write::mold_patch::extent;
use plydrape::mold::patch::patch;
use serde::Serialize;

/// Points of the grid on the shortest distance of two grippers. Between them the distance is linear, which on a ball of six pitches
/// of radius is a ten-thousandth of the pitch off.
const POINTS: f64 = 20.0;
/// Most points of a grid; a larger mold has a coarser one.
const MOST: f64 = 4e5;
/// Triangles of the mold by which its lowest and highest points are found.
const TRIANGLES: usize = 2000;
/// Layers of the grid beyond these points.
const LAYERS: f64 = 3.0;
/// Digits of a distance (m).
const ROUNDING: f64 = 1e8;

/// Signed distances (m), the last axis fastest.
#[derive(Debug, Serialize)]
pub(super) struct DistanceGrid {
    /// Lowest corner (m).
    low: [f64; 3],
    /// Distance of neighboring points (m).
    pitch: f64,
    /// Points along x, y and z.
    shape: [usize; 3],
    distance: Vec<f64>,
}

impl DistanceGrid {
    /// The distances of the mold of a result, `reach` (m) beyond the grippers, for grippers that are a `pitch` (m) apart; `None` without a mold.
    pub fn under(result: &ResultFile, reach: f64, pitch: f64) -> Option<DistanceGrid> {
        // how high and how low the mold is around the motion of the grippers
        let mold = result.scene.mold.as_ref()?;
        let [low, high] = extent(result)?;
        let (low, high) = (low.map(|c| c - reach), high.map(|c| c + reach));
        let surface = patch(mold, low, high, TRIANGLES).vertices;
        let heights = || surface.iter().map(|vertex| vertex[2]);
        let [bottom, top] = [heights().reduce(f64::min)?, heights().reduce(f64::max)?];

        // points at a share of the pitch of the grippers, farther apart for a large mold
        let sides = [high[0] - low[0], high[1] - low[1], top - bottom];
        let count = |step: f64| {
            [0, 1, 2].map(|c| {
                let layers = if c == 2 { 2.0 * LAYERS } else { 0.0 };
                (sides[c] / step).ceil() + layers + 1.0
            })
        };
        let mut step = pitch / POINTS;
        while count(step).iter().product::<f64>() > MOST {
            step *= 1.1;
        }

        // the distance at each point; beyond the boundary of the mold it is a pitch
        let shape = count(step).map(|n| n as usize);
        let low = [low[0], low[1], bottom - LAYERS * step];
        let far = pitch;
        let distance = |[i, j, k]: [usize; 3]| {
            let at = [i, j, k].map(|n| n as f64 * step);
            let closest = mold.closest_point([0, 1, 2].map(|c| low[c] + at[c]));
            let distance = if closest.beyond { far } else { closest.distance };
            (distance * ROUNDING).round() / ROUNDING
        };
        let [nx, ny, nz] = shape;
        let points =
            (0..nx).flat_map(|i| (0..ny).flat_map(move |j| (0..nz).map(move |k| [i, j, k])));
        Some(DistanceGrid { low, pitch: step, shape, distance: points.map(distance).collect() })
    }
}
