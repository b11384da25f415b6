//! Net and mold for ParaView and other readers of VTK's files: polygons, `.vtp`.
//!
//! Only nodes with a place and cells with all four are there.

use super::nodal_shear;
use crate::write::vtk::polydata::{Array, Kind, PolyData};
use plydrape::mold::Mold;
use plydrape::mold::patch::patch;
use plydrape::net::Net;
use std::collections::HashMap;

type Point = [f64; 3];

/// Triangles of the mold, at most, and how far it goes beyond the net, as a share of the net's width.
const TRIANGLES: usize = 8000;
const BEYOND: f64 = 0.06;

/// The net. At points: fabric coordinates `u`, `v` (m), grid indices `i`, `j`, `shear_deg` as in
/// `nodes.csv`, and `has_shear`, 1 where that is known; else both 0. In cells: `shear_deg`, the magnitude; `signed_shear_deg`, positive where u and v meet at
/// less than 90°; `fiber_u`, `fiber_v`, unit vectors along the two fiber directions in the cell's middle.
#[must_use]
pub fn net(net: &Net) -> Vec<u8> {
    let [nu, nv] = net.placement.nodes;
    let nodes =
        || (0..nu * nv).map(|n| [n % nu, n / nu]).filter_map(|id| Some((id, net.node(id)?)));
    let number: HashMap<[usize; 2], usize> = nodes().map(|(id, _)| id).zip(0..).collect();
    let points: Vec<Point> = nodes().map(|(_, place)| place).collect();
    // unknown beside missing nodes only
    let shear: Vec<_> = nodes().map(|(id, _)| nodal_shear(net, id)).collect();
    let at_points = vec![
        Array::new("u", nodes().map(|(id, _)| net.placement.fabric(id)[0]).collect()),
        Array::new("v", nodes().map(|(id, _)| net.placement.fabric(id)[1]).collect()),
        Array::whole("i", nodes().map(|(id, _)| id[0])),
        Array::whole("j", nodes().map(|(id, _)| id[1])),
        Array::new("shear_deg", shear.iter().map(|s| s.unwrap_or(0.0).to_degrees()).collect()),
        Array::codes("has_shear", shear.iter().map(|s| s.is_some().into()).collect()),
    ];

    let mut cells = Vec::new();
    let (mut magnitude, mut angle, mut fibers) = (Vec::new(), Vec::new(), [Vec::new(), Vec::new()]);
    for [i, j] in (0..nv.saturating_sub(1)).flat_map(|j| (0..nu - 1).map(move |i| [i, j])) {
        let ring = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        let found = ring.map(|id| number.get(&id).copied());
        let (Some(shear), [Some(a), Some(b), Some(c), Some(d)]) = (net.cell_shear([i, j]), found)
        else {
            continue;
        };
        cells.push(vec![a, b, c, d]);
        let [p, q, r, s] = [a, b, c, d].map(|n| points[n]);
        magnitude.push(shear.magnitude.to_degrees());
        angle.push(shear.angle.to_degrees());
        fibers[0].push(mean_direction([p, q], [s, r]));
        fibers[1].push(mean_direction([p, s], [q, r]));
    }
    let in_cells = vec![
        Array::new("shear_deg", magnitude),
        Array::new("signed_shear_deg", angle),
        Array::vectors("fiber_u", &fibers[0]),
        Array::vectors("fiber_v", &fibers[1]),
    ];
    PolyData { points, kind: Kind::Polys, cells, at_points, in_cells, fields: Vec::new() }.bytes()
}

/// The mold under a net and a little beyond, in triangles; `None` if the mold is not near the net.
#[must_use]
pub fn mold(net: &Net, mold: &Mold) -> Option<Vec<u8>> {
    let places = || net.nodes.iter().flatten();
    let bound = |pick: fn(f64, f64) -> f64, start: f64| {
        [0, 1].map(|c| places().map(|place| place[c]).fold(start, pick))
    };
    let (low, high) = (bound(f64::min, f64::INFINITY), bound(f64::max, f64::NEG_INFINITY));
    let more = BEYOND * (high[0] - low[0]).hypot(high[1] - low[1]);
    let found = patch(mold, low.map(|c| c - more), high.map(|c| c + more), TRIANGLES);
    (!found.triangles.is_empty()).then(|| PolyData::surface(found, Vec::new()).bytes())
}

/// Unit vector along the mean of two opposite sides.
fn mean_direction(side: [Point; 2], opposite: [Point; 2]) -> Point {
    let sum = [0, 1, 2].map(|c| side[1][c] - side[0][c] + opposite[1][c] - opposite[0][c]);
    let size = sum.iter().map(|c| c * c).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    sum.map(|c| c / size)
}
