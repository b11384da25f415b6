//! The same mold, quicker to ask: a formula is tabulated once, since a search asks for its heights millions of
//! times. What is handed over at the end is draped on the mold itself.

use crate::draping::spans::Point;
use crate::mold::{Formula, Graph, HeightGrid, Mold, Surface};
use crate::scene::Scene;
use std::borrow::Cow;

/// Nodes of the table along each axis.
const NODES: usize = 161;
/// Error (m) of the table from which on it is not used.
const ERROR: f64 = 1e-7;
/// Margin around the drape where the formula has no boundaries, as a share of its size.
const MARGIN: f64 = 0.5;

/// The scene with its mold tabulated, where that is a formula smooth enough; else as it is.
#[must_use]
pub fn quick(scene: &Scene) -> Cow<'_, Scene> {
    let Some(Mold::Graph(graph)) = &scene.mold else { return Cow::Borrowed(scene) };
    let (Surface::Formula { z }, Some(target)) = (&graph.surface, &scene.target) else {
        return Cow::Borrowed(scene);
    };
    let domain = graph.domain.unwrap_or_else(|| around(graph, &target.grippers));
    let Some(heights) = tabulated(z, domain) else { return Cow::Borrowed(scene) };
    let surface = Surface::HeightGrid(heights);
    let mold = Some(Mold::Graph(Graph { surface, ..graph.clone() }));
    Cow::Owned(Scene { mold, ..scene.clone() })
}

/// The formula as a table; none where that would be off.
fn tabulated(z: &Formula, domain: [[f64; 2]; 2]) -> Option<HeightGrid> {
    let at =
        |n: usize, k: f64| domain[n][0] + (domain[n][1] - domain[n][0]) * k / (NODES - 1) as f64;
    let axis = |n: usize| (0..NODES).map(|k| at(n, k as f64)).collect::<Vec<f64>>();
    let [x, y] = [0, 1].map(axis);
    let nodes = y.iter().flat_map(|y| x.iter().map(move |x| z.at(*x, *y).z)).collect();
    let table = HeightGrid::new(x, y, nodes).ok()?;
    // it is off most in the middles of its squares
    let off = |i: usize, j: usize| {
        let [x, y] = [at(0, i as f64 + 0.5), at(1, j as f64 + 0.5)];
        (table.at(x, y).z - z.at(x, y).z).abs()
    };
    let sound = (0..NODES - 1).all(|j| (0..NODES - 1).all(|i| off(i, j) <= ERROR));
    sound.then_some(table)
}

/// Range of local x and y (m) around the drape.
fn around(graph: &Graph, targets: &[Point]) -> [[f64; 2]; 2] {
    let local: Vec<Point> = targets.iter().map(|p| graph.pose.local(*p)).collect();
    let range = [0, 1].map(|n| {
        let low = local.iter().map(|p| p[n]).fold(f64::INFINITY, f64::min);
        let high = local.iter().map(|p| p[n]).fold(f64::NEG_INFINITY, f64::max);
        [low, high]
    });
    let margin = MARGIN * range.iter().map(|[low, high]| high - low).fold(0.0, f64::max);
    range.map(|[low, high]| [low - margin, high + margin])
}
