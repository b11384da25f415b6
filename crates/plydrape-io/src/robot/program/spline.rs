//! Points for a controller that passes them on a spline by a rule that its maker does not publish (KRL's `SPL`).
//!
//! Two splines through the points stand for it: the cubic one with continuous second derivatives, and the quintic one whose first and
//! second derivatives at a point are those of the polynomial through it and its neighbors, two on each side. Their parameter is the length of the chords.
//! Points are added in the middle of the way between two until both stay near the motion, or points would be too near to each other. So the points
//! also become as even as both need, and a third rule is near them too.

use super::pose::{of_quaternion, quaternion};
use super::sampling::{Deviation, Tolerance, Track};
use plydrape::geometry::vector::distance;

/// Rounds in which points are added; each halves the ways that need it.
const ROUNDS: usize = 24;

/// Shortest way between two points (m), also of a turn in place: the squares of its inverse are finite.
const LEAST_WAY: f64 = 1e-9;

/// Adds points between the `stops`, which are among those that are `kept`, and returns the largest error that is left: where the splines pass
/// the motion.
pub(super) fn refine(
    track: &Track,
    stops: &[usize],
    kept: &mut Vec<usize>,
    tolerance: &Tolerance,
) -> Deviation {
    let mut points = vec![0];
    let mut error = Deviation::default();
    for pair in [0].iter().chain(stops).copied().collect::<Vec<_>>().windows(2) {
        let [from, to] = [pair[0], pair[1]];
        if from == to {
            continue;
        }
        let mut run: Vec<usize> =
            kept.iter().copied().filter(|k| (from..=to).contains(k)).collect();
        if !track.rests(from, to, tolerance) {
            // a block of one way has no place for a trigger
            if run.len() == 2 && to - from > 1 {
                run.insert(1, track.halfway(from, to).unwrap_or(from + (to - from) / 2));
            }
            error = error.max(refined(track, &mut run, tolerance));
        }
        points.extend(&run[1..]);
    }
    *kept = points;
    error
}

/// Adds points between those of one block.
fn refined(track: &Track, run: &mut Vec<usize>, tolerance: &Tolerance) -> Deviation {
    for _ in 0..ROUNDS {
        let errors = errors(track, run);
        let is_far = |error: &Deviation| {
            error.position > tolerance.position || error.angle > tolerance.angle
        };
        let added: Vec<usize> = run
            .windows(2)
            .zip(&errors)
            .filter(|(_, error)| is_far(error))
            .filter_map(|(pair, _)| {
                let middle = track.halfway(pair[0], pair[1])?;
                let fits = track.is_apart(pair[0], middle, tolerance)
                    && track.is_apart(middle, pair[1], tolerance);
                fits.then_some(middle)
            })
            .collect();
        if added.is_empty() {
            return errors.into_iter().fold(Deviation::default(), Deviation::max);
        }
        run.extend(added);
        run.sort_unstable();
    }
    errors(track, run).into_iter().fold(Deviation::default(), Deviation::max)
}

/// The largest error of both splines on each way between two points.
fn errors(track: &Track, run: &[usize]) -> Vec<Deviation> {
    let rows: Vec<Vec<f64>> = track.rows(run);
    let mut knots = vec![0.0];
    for pair in run.windows(2) {
        let last = knots[knots.len() - 1];
        // where the center stands and an axis moves, the way is that of the axis
        let way = match track.distance(pair[0], pair[1]) {
            0.0 => track.movement(pair[0], pair[1]).position,
            way => way,
        };
        knots.push(last + way.max(LEAST_WAY).max(1e-9 * last));
    }
    let splines = [cubic(&knots, &rows), quintic(&knots, &rows)];
    let on_way = |n: usize| {
        let shares = track.shares(run[n], run[n + 1]);
        let mut worst = Deviation::default();
        for (k, share) in (run[n] + 1..run[n + 1]).zip(shares) {
            for spline in &splines {
                worst = worst.max(track.deviation_of_row(k, &spline.row(n, share)));
            }
        }
        worst
    };
    (0..run.len() - 1).map(on_way).collect()
}

impl Track<'_> {
    /// What a controller interpolates, at some samples: the place and the quaternion of the center, and the axes or the progress.
    fn rows(&self, samples: &[usize]) -> Vec<Vec<f64>> {
        let mut before: Option<[f64; 4]> = None;
        let row = |k: &usize| {
            let mut row = Vec::new();
            if let Some(center) = &self.center {
                let mut turn = quaternion(&center[*k]);
                let cosine: f64 =
                    before.map_or(1.0, |b| b.iter().zip(turn).map(|(p, q)| p * q).sum());
                if cosine < 0.0 {
                    turn = turn.map(|q| -q);
                }
                before = Some(turn);
                row.extend(center[*k].position);
                row.extend(turn);
            }
            match self.moves_axes {
                true => row.extend(self.program.axes.iter().map(|axis| axis.values[*k])),
                false => row.push(self.progress[*k]),
            }
            row
        };
        samples.iter().map(row).collect()
    }

    /// The error at sample k of such a row.
    fn deviation_of_row(&self, k: usize, row: &[f64]) -> Deviation {
        let (pose, own) = match &self.center {
            Some(_) => {
                let turn = [row[3], row[4], row[5], row[6]];
                (Some(of_quaternion([row[0], row[1], row[2]], turn)), &row[7..])
            }
            None => (None, row),
        };
        let axis = |n: usize| match self.moves_axes {
            true => own[n],
            false => self.followed(n, own[0]),
        };
        self.deviation_of(k, pose.as_ref(), &axis)
    }

    /// For each sample between two the share of the way that is behind it.
    fn shares(&self, a: usize, b: usize) -> Vec<f64> {
        let step = |k: usize| match &self.center {
            Some(center) => distance(center[k - 1].position, center[k].position),
            None => self.movement(k - 1, k).position,
        };
        let mut way = 0.0;
        let ways: Vec<f64> = (a + 1..=b)
            .map(|k| {
                way += step(k);
                way
            })
            .collect();
        let times = &self.program.times;
        let timely = |k: usize| (times[k] - times[a]) / (times[b] - times[a]);
        let share = |k: usize| if way > 0.0 { ways[k - a - 1] / way } else { timely(k) };
        (a + 1..b).map(share).collect()
    }

    /// The sample nearest to the middle of the way between two, if there is one.
    fn halfway(&self, a: usize, b: usize) -> Option<usize> {
        let shares = self.shares(a, b);
        let from_middle = |k: &usize| (shares[k - a - 1] - 0.5).abs();
        (a + 1..b).min_by(|p, q| from_middle(p).total_cmp(&from_middle(q)))
    }
}

/// A spline of polynomials, one between two knots, each by the values and derivatives at both.
struct Spline<'a> {
    knots: &'a [f64],
    rows: &'a [Vec<f64>],
    first: Vec<Vec<f64>>,
    second: Option<Vec<Vec<f64>>>,
}

impl Spline<'_> {
    /// The row at a share of the n-th way.
    fn row(&self, n: usize, share: f64) -> Vec<f64> {
        let (h, x) = (self.knots[n + 1] - self.knots[n], share);
        let column = |c: usize| {
            let [p, q] = [self.rows[n][c], self.rows[n + 1][c]];
            let [v, w] = [h * self.first[n][c], h * self.first[n + 1][c]];
            match &self.second {
                // Hermite's polynomials of the third and of the fifth degree
                None => {
                    let rise = q - p;
                    p + x * (v + x * (3.0 * rise - 2.0 * v - w + x * (v + w - 2.0 * rise)))
                }
                Some(second) => {
                    let [a, b] = [h * h * second[n][c], h * h * second[n + 1][c]];
                    let rise = q - p - v - 0.5 * a;
                    let slope = w - v - a;
                    let bend = b - a;
                    let c3 = 10.0 * rise - 4.0 * slope + 0.5 * bend;
                    let c4 = -15.0 * rise + 7.0 * slope - bend;
                    let c5 = 6.0 * rise - 3.0 * slope + 0.5 * bend;
                    p + x * (v + x * (0.5 * a + x * (c3 + x * (c4 + x * c5))))
                }
            }
        };
        (0..self.rows[n].len()).map(column).collect()
    }
}

/// The cubic spline with continuous second derivatives, which are zero at both ends.
fn cubic<'a>(knots: &'a [f64], rows: &'a [Vec<f64>]) -> Spline<'a> {
    let last = knots.len() - 1;
    let h = |n: usize| knots[n + 1] - knots[n];
    // for the slopes: a tridiagonal system, solved from the front (Thomas)
    let mut factor = vec![0.0; last + 1];
    let mut first: Vec<Vec<f64>> = Vec::with_capacity(last + 1);
    for n in 0..=last {
        let before = if n > 0 { 1.0 / h(n - 1) } else { 0.0 };
        let after = if n < last { 1.0 / h(n) } else { 0.0 };
        let pivot = 2.0 * (before + after) - if n > 0 { before * factor[n - 1] } else { 0.0 };
        factor[n] = after / pivot;
        let right = |c: usize| {
            let rise = |m: usize| rows[m + 1][c] - rows[m][c];
            let mut sum = 0.0;
            if n > 0 {
                sum += 3.0 * rise(n - 1) * before * before - before * first[n - 1][c];
            }
            if n < last {
                sum += 3.0 * rise(n) * after * after;
            }
            sum / pivot
        };
        first.push((0..rows[0].len()).map(right).collect());
    }
    for n in (0..last).rev() {
        for c in 0..rows[0].len() {
            let next = first[n + 1][c];
            first[n][c] -= factor[n] * next;
        }
    }
    Spline { knots, rows, first, second: None }
}

/// The quintic spline whose derivatives at a knot are those of the polynomial through it and up to two neighbors on each side.
fn quintic<'a>(knots: &'a [f64], rows: &'a [Vec<f64>]) -> Spline<'a> {
    let count = knots.len();
    let mut first = Vec::with_capacity(count);
    let mut second = Vec::with_capacity(count);
    for n in 0..count {
        let near: Vec<usize> = (n.saturating_sub(2)..(n + 3).min(count)).collect();
        let [slopes, bends] =
            weights(knots[n], &near.iter().map(|m| knots[*m]).collect::<Vec<_>>());
        let sum = |weights: &[f64], c: usize| -> f64 {
            near.iter().zip(weights).map(|(m, w)| w * rows[*m][c]).sum()
        };
        first.push((0..rows[0].len()).map(|c| sum(&slopes, c)).collect());
        second.push((0..rows[0].len()).map(|c| sum(&bends, c)).collect());
    }
    Spline { knots, rows, first, second: Some(second) }
}

/// What the values at some places weigh in the first and in the second derivative at x of the polynomial through them (Fornberg 1988).
fn weights(x: f64, places: &[f64]) -> [Vec<f64>; 2] {
    let count = places.len();
    let mut found = vec![[0.0; 3]; count];
    found[0][0] = 1.0;
    let mut before = 1.0;
    for n in 1..count {
        let mut product = 1.0;
        let (off, last) = (places[n] - x, places[n - 1] - x);
        for m in 0..n {
            let apart = places[n] - places[m];
            product *= apart;
            if m == n - 1 {
                let old = found[n - 1];
                for k in (0..3).rev() {
                    let lower = if k > 0 { k as f64 * old[k - 1] } else { 0.0 };
                    found[n][k] = before / product * (lower - last * old[k]);
                }
            }
            for k in (0..3).rev() {
                let lower = if k > 0 { k as f64 * found[m][k - 1] } else { 0.0 };
                found[m][k] = (off * found[m][k] - lower) / apart;
            }
        }
        before = product;
    }
    [1, 2].map(|k| found.iter().map(|w| w[k]).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both splines pass through their points, and are a straight line where these are on one; the quintic one is a parabola where these are.
    #[test]
    fn splines_reproduce_lines_and_the_quintic_a_parabola() {
        let knots = [0.0, 0.3, 0.5, 1.4, 1.5, 2.5];
        let line = |x: f64| vec![2.0 - 0.7 * x];
        let parabola = |x: f64| vec![1.0 + 0.5 * x - 0.3 * x * x];
        for share in [0.0, 0.2, 0.5, 0.9, 1.0] {
            for n in 0..5 {
                let x = knots[n] + share * (knots[n + 1] - knots[n]);
                let rows: Vec<Vec<f64>> = knots.iter().map(|x| line(*x)).collect();
                for spline in [cubic(&knots, &rows), quintic(&knots, &rows)] {
                    assert!((spline.row(n, share)[0] - line(x)[0]).abs() < 1e-13);
                }
                let rows: Vec<Vec<f64>> = knots.iter().map(|x| parabola(*x)).collect();
                let off = quintic(&knots, &rows).row(n, share)[0] - parabola(x)[0];
                assert!(off.abs() < 1e-12, "{off}");
            }
        }
    }

    /// The cubic spline has no jump in its second derivative, by differences on both sides of a knot.
    #[test]
    fn the_cubic_spline_bends_continuously() {
        let knots = [0.0, 1.0, 1.5, 3.0];
        let rows: Vec<Vec<f64>> = [0.0, 1.0, -0.5, 2.0].map(|y| vec![y]).into();
        let spline = cubic(&knots, &rows);
        let bend = |n: usize, share: f64| {
            let h = 1e-4;
            let step = h / (knots[n + 1] - knots[n]);
            let [a, b, c] = [-1.0, 0.0, 1.0].map(|k: f64| spline.row(n, share + k * step)[0]);
            (a - 2.0 * b + c) / (h * h)
        };
        for n in 0..2 {
            assert!((bend(n, 1.0) - bend(n + 1, 0.0)).abs() < 1e-5);
        }
        assert!(bend(0, 0.0).abs() < 1e-5 && bend(2, 1.0).abs() < 1e-5);
    }
}
