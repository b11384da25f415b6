//! A mold given by a formula as a table of heights, because a search evaluates the heights millions of times. The
//! finished plan is draped on the mold itself.

use super::tuning::TUNING;
use crate::geometry::Point;
use crate::layup::Layup;
use crate::mold::{Formula, Graph, HeightGrid, Mold, Raised, Surface};
use crate::scene::Scene;
use std::borrow::Cow;
use std::sync::Arc;

/// The scene with its mold tabulated, where that is a formula smooth enough; else as it is.
#[must_use]
pub fn tabulated(scene: &Scene) -> Cow<'_, Scene> {
    let Some(Mold::Graph(graph)) = scene.layup.mold.as_ref().map(Mold::bare) else {
        return Cow::Borrowed(scene);
    };
    let (Surface::Formula { z }, Some(target)) = (&graph.surface, &scene.layup.target) else {
        return Cow::Borrowed(scene);
    };
    let domain = graph.domain.unwrap_or_else(|| {
        // the grippers also pass over it on their way from the start
        let places = target.grippers.iter().chain(scene.layup.start());
        let local: Vec<Point> = places.map(|p| graph.pose.local(*p)).collect();
        around(&local, TUNING.front.height_margin)
    });
    let tolerance = TUNING.front.table_error * scene.layup.ply.shorter_side();
    let Some(heights) = table(z, domain, tolerance) else { return Cow::Borrowed(scene) };
    let surface = Surface::HeightGrid(heights);
    let mut mold = Mold::Graph(Graph { surface, ..graph.clone() });
    if let Some(Mold::Layered(layered)) = &scene.layup.mold {
        mold = Mold::Layered(Arc::new(Raised { mold, relief: layered.relief.clone() }));
    }
    let layup = Layup { mold: Some(mold), ..scene.layup.clone() };
    Cow::Owned(Scene { layup, ..scene.clone() })
}

/// The formula as a table; `None` where its error exceeds a tolerance (m).
fn table(z: &Formula, domain: [[f64; 2]; 2], tolerance: f64) -> Option<HeightGrid> {
    let nodes = TUNING.front.table_nodes;
    let table = height_grid(domain, nodes, |[x, y]| z.at(x, y).z)?;
    let coordinate = |n: usize, k: f64| node(domain[n], k, nodes);
    // the error is largest in the middles of its squares
    let error = |i: usize, j: usize| {
        let [x, y] = [coordinate(0, i as f64 + 0.5), coordinate(1, j as f64 + 0.5)];
        (table.at(x, y).z - z.at(x, y).z).abs()
    };
    let sound = (0..nodes - 1).all(|j| (0..nodes - 1).all(|i| error(i, j) <= tolerance));
    sound.then_some(table)
}

/// A height grid (m) with evenly spaced nodes along each axis.
pub(super) fn height_grid(
    domain: [[f64; 2]; 2],
    nodes: usize,
    height: impl Fn([f64; 2]) -> f64,
) -> Option<HeightGrid> {
    let axis = |range| (0..nodes).map(|k| node(range, k as f64, nodes)).collect::<Vec<f64>>();
    let [x, y] = domain.map(axis);
    let z = y.iter().flat_map(|y| x.iter().map(|x| height([*x, *y]))).collect();
    HeightGrid::new(x, y, z).ok()
}

/// Node k of this many evenly spaced ones (m).
fn node([low, high]: [f64; 2], k: f64, nodes: usize) -> f64 {
    low + (high - low) * k / (nodes - 1) as f64
}

/// Range of x and y (m) around points, with a margin as a share of its size.
pub(super) fn around(points: &[Point], margin: f64) -> [[f64; 2]; 2] {
    let range = [0, 1].map(|n| {
        let low = points.iter().map(|p| p[n]).fold(f64::INFINITY, f64::min);
        let high = points.iter().map(|p| p[n]).fold(f64::NEG_INFINITY, f64::max);
        [low, high]
    });
    let margin = margin * range.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    range.map(|[low, high]| [low - margin, high + margin])
}
