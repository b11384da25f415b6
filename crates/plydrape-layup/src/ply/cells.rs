//! The cells between fiber lines, from the places of the cups in the fabric.

use super::Outline;
use super::lines::{Fibers, Pair, Quad, fiber_quad};
use super::tuning::TUNING;
use std::collections::BTreeMap;

/// Cells with straight fiber sides: four lines that close, with no cup inside and fabric along both diagonals.
pub(super) fn fiber_cells(
    places: &[[f64; 2]],
    outline: &Outline,
    [u, v]: &[Vec<Pair>; 2],
    pitch: [f64; 2],
) -> Vec<Quad> {
    let next = |pairs: &[Pair]| -> BTreeMap<usize, usize> {
        pairs.iter().map(|pair| (pair.ends[0], pair.ends[1])).collect()
    };
    let (ahead, above) = (next(u), next(v));
    let same = TUNING.same_yarn * pitch[0].min(pitch[1]);
    let mut cells = Vec::new();
    for Pair { ends: [low, right], offset } in u {
        let (Some(left), Some(top)) = (above.get(low), above.get(right)) else { continue };
        if ahead.get(left) != Some(top) {
            continue;
        }
        let [p, q] = [*low, *top].map(|n| places[n]);
        let inside =
            |place: &[f64; 2]| (0..2).all(|n| place[n] > p[n] + same && place[n] < q[n] - same);
        let diagonals = [[*low, *top], [*right, *left]].map(|ends| ends.map(|n| places[n]));
        let is_there = diagonals.iter().all(|line| outline.has_line(*line));
        if is_there && !places.iter().any(inside) {
            let trellis = [offset[0], q[1] - p[1]];
            cells.push(fiber_quad([*low, *right, *top, *left], trellis));
        }
    }
    cells
}

/// Cells with fibers as diagonals: a line along u and one along v that cross in their middles, and sides that are no longer than
/// `side` (m), the pitch of the array, and lie in the fabric.
pub(super) fn bias_cells(
    places: &[[f64; 2]],
    outline: &Outline,
    [u, v]: &[Vec<Pair>; 2],
    side: f64,
) -> Vec<Quad> {
    let same = TUNING.same_yarn * side;
    let middle = |pair: &Pair| {
        let [a, b] = pair.ends.map(|n| places[n]);
        [0, 1].map(|n| 0.5 * (a[n] + b[n]))
    };
    // lines along v by buckets, since each line along u is near few of them
    let bucket = |place: [f64; 2]| place.map(|c| (c / (4.0 * same)).floor() as i64);
    let mut crossing: BTreeMap<[i64; 2], Vec<&Pair>> = BTreeMap::new();
    v.iter().for_each(|pair| crossing.entry(bucket(middle(pair))).or_default().push(pair));
    let mut cells = Vec::new();
    for along in u {
        let (center, [i, j]) = (middle(along), bucket(middle(along)));
        let near = (0..9).filter_map(|k| crossing.get(&[i + k % 3 - 1, j + k / 3 - 1])).flatten();
        let meets = |pair: &&&Pair| {
            let other = middle(pair);
            (0..2).all(|n| (other[n] - center[n]).abs() <= 2.0 * same)
        };
        for across in near.filter(meets) {
            let ([left, right], [low, high]) = (along.ends, across.ends);
            let half = [0.5 * along.offset[0], 0.5 * across.offset[1]];
            // sides of the cell are bias lines between ends of the two diagonals
            let rising = |ends| Pair { ends, offset: half };
            let falling = |ends| Pair { ends, offset: [-half[0], half[1]] };
            let bias = [
                vec![rising([low, right]), rising([left, high])],
                vec![falling([right, high]), falling([low, left])],
            ];
            let is_there =
                bias.iter().flatten().all(|pair| outline.has_line(pair.ends.map(|n| places[n])));
            if is_there && half[0].hypot(half[1]) <= side + same {
                let corners = [low, right, high, left];
                let name = corners.into_iter().min().unwrap_or(low);
                let fibers = Fibers::Diagonals;
                cells.push(Quad { name, corners, trellis: half, fibers, bias });
            }
        }
    }
    cells.sort_by_key(|cell| cell.name);
    cells
}
