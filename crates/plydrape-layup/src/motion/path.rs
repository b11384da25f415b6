//! One smooth path of all grippers: a clamped cubic B-spline in one common parameter.
//!
//! The control points are the planned positions P_0 … P_{n−1}, and the knots u_0 … u_{n−1} stand for them
//! one by one. A further control point in the first and in the last leg
//! makes the numbers match and the end curvature vanish:
//! `Q = P_0, Q_1, P_1, P_2, …, P_{n−2}, Q_n, P_{n−1}` with `Q_1 = P_0 + h_0/(2h_0 + h_1) (P_1 − P_0)`.
//! Any point of the path is a mean of four neighboring control points: a gripper that stands there
//! stands, and none leaves the hull of what was planned (de Boor 1978).

use crate::geometry::vector::{along, sub};

/// Positions of one gripper or their derivatives, to the parameter or to time.
pub(super) type Vector = [f64; 3];

/// A clamped cubic B-spline through space for every gripper.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Path {
    /// Distinct knots u_k (m), ascending from 0; one for each planned step.
    pub knots: Vec<f64>,
    /// Their distances (m), from which they are summed up.
    pub spacing: Vec<f64>,
    /// Number of grippers.
    pub grippers: usize,
    /// Taylor coefficients p, p', p'', p''' at the beginning of every span, grippers running fastest.
    pieces: Vec<[Vector; 4]>,
    /// Where it ends (m).
    target: Vec<Vector>,
}

impl Path {
    /// The path of planned positions (two steps or more, all of the same grippers) with knots `spacing`
    /// (m, positive, one less than steps) apart.
    pub fn new(planned: &[&[Vector]], spacing: &[f64]) -> Self {
        let grippers = planned[0].len();
        let polygon = Polygon::new(planned, spacing);
        let [first, second, third] = polygon.derivatives();
        let mut pieces = Vec::with_capacity(spacing.len() * grippers);
        for k in 0..spacing.len() {
            let before = if k == 0 { 0.0 } else { spacing[k - 1] };
            let share = before / (before + spacing[k]);
            for g in 0..grippers {
                let index = |row: usize| row * grippers + g;
                pieces.push([
                    polygon.knot(k, g),
                    between(first[index(k)], first[index(k + 1)], share),
                    second[index(k)],
                    third[index(k)],
                ]);
            }
        }
        let knots = knots(spacing);
        let target = planned[planned.len() - 1].to_vec();
        Path { knots, spacing: spacing.to_vec(), grippers, pieces, target }
    }

    /// The path of other positions with the same knots: where four neighbors are the same, so is the path between, to the last bit.
    pub fn through(&self, planned: &[&[Vector]]) -> Self {
        Path::new(planned, &self.spacing)
    }

    /// Where the grippers are at each knot (m).
    pub fn at_knots(&self) -> Vec<Vec<Vector>> {
        let last = self.knots.len() - 1;
        let places = |k: usize| {
            let place = |g| self.jet(k.min(last - 1), g, self.knots[k])[0];
            (0..self.grippers).map(place).collect()
        };
        (0..=last).map(places).collect()
    }

    /// This path and then another of the same grippers, which begins where it ends.
    pub fn then(mut self, next: &Path) -> Self {
        let end = self.length();
        self.knots.extend(next.knots[1..].iter().map(|u| end + u));
        self.spacing.extend(&next.spacing);
        self.pieces.extend(&next.pieces);
        Path { target: next.target.clone(), ..self }
    }

    /// Length of the parameter (m).
    pub fn length(&self) -> f64 {
        self.knots.last().copied().unwrap_or(0.0)
    }

    /// The span of a parameter; at a knot the one that begins there.
    pub fn span(&self, s: f64) -> usize {
        let after = self.knots.partition_point(|u| *u <= s);
        after.saturating_sub(1).min(self.knots.len().saturating_sub(2))
    }

    /// p, p', p'', p''' of a gripper at s by the polynomial of a span.
    pub fn jet(&self, span: usize, gripper: usize, s: f64) -> [Vector; 4] {
        let [p, d, e, f] = self.pieces[span * self.grippers + gripper];
        let x = s - self.knots[span];
        let dd = along(d, x, along(e, x / 2.0, f));
        let position = along(p, x, along(d, x / 2.0, along(e, x / 3.0, f)));
        let position = if s >= self.length() { self.target[gripper] } else { position };
        [position, dd, along(e, x, f), f]
    }
}

/// The control points of a spacing, grippers running fastest, and the knots with their multiplicity.
pub(super) struct Polygon {
    grippers: usize,
    points: Vec<Vector>,
    /// u_0 and u_{n−1} four times, the others once (m).
    knots: Vec<f64>,
}

impl Polygon {
    /// The control points Q of planned positions.
    pub fn new(planned: &[&[Vector]], spacing: &[f64]) -> Self {
        let (grippers, last) = (planned[0].len(), planned.len() - 1);
        // A single leg is cut in three.
        let share = |own: f64, next: Option<&f64>| match next {
            Some(next) => own / (2.0 * own + next),
            None => 1.0 / 3.0,
        };
        let (begin, end) = (spacing[0], spacing[last - 1]);
        let begin = share(begin, spacing.get(1));
        let end = share(end, last.checked_sub(2).map(|k| &spacing[k]));
        let mut points = Vec::with_capacity((last + 3) * grippers);
        let leg = |points: &mut Vec<Vector>, a: usize, b: usize, share: f64| {
            points.extend(planned[a].iter().zip(planned[b]).map(|(p, q)| between(*p, *q, share)));
        };
        points.extend(planned[0]);
        leg(&mut points, 0, 1, begin);
        for step in &planned[1..last] {
            points.extend(*step);
        }
        leg(&mut points, last, last - 1, end);
        points.extend(planned[last]);

        let distinct = knots(spacing);
        let mut knots = vec![0.0; 3];
        knots.extend(&distinct);
        knots.extend([distinct[last]; 3]);
        Polygon { grippers, points, knots }
    }

    /// Control points of p' (one more than knots), p'' (one a knot) and p''' (one a span).
    pub fn derivatives(&self) -> [Vec<Vector>; 3] {
        let first = self.derivative(&self.points, 3);
        let second = self.derivative(&first, 2);
        let third = self.derivative(&second, 1);
        [first, second, third]
    }

    /// Control points of the derivative of a spline of a degree.
    fn derivative(&self, points: &[Vector], degree: usize) -> Vec<Vector> {
        // A derivative has lost a knot at each end for every degree below the third.
        let knots = &self.knots[3 - degree..];
        let rows = points.len() / self.grippers - 1;
        let mut derivative = Vec::with_capacity(rows * self.grippers);
        for i in 0..rows {
            let factor = degree as f64 / (knots[i + degree + 1] - knots[i + 1]);
            let row = i * self.grippers;
            for g in row..row + self.grippers {
                derivative.push(sub(points[g + self.grippers], points[g]).map(|x| factor * x));
            }
        }
        derivative
    }

    /// The place of a gripper at knot k, by de Boor's algorithm.
    fn knot(&self, k: usize, gripper: usize) -> Vector {
        let (u, t) = (self.knots[k + 3], &self.knots);
        let point = |row: usize| self.points[row * self.grippers + gripper];
        let low = between(point(k), point(k + 1), (u - t[k + 1]) / (t[k + 4] - t[k + 1]));
        let high = between(point(k + 1), point(k + 2), (u - t[k + 2]) / (t[k + 5] - t[k + 2]));
        between(low, high, (u - t[k + 2]) / (t[k + 4] - t[k + 2]))
    }
}

/// Running sum of spacings, from 0.
fn knots(spacing: &[f64]) -> Vec<f64> {
    let mut knots = vec![0.0];
    knots.extend(spacing.iter().scan(0.0, |sum, h| {
        *sum += h;
        Some(*sum)
    }));
    knots
}

/// A share of the way from a to b; exactly a where they are equal.
fn between(a: Vector, b: Vector, share: f64) -> Vector {
    along(a, share, sub(b, a))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Position, p' and p'' of one span's end are those of the next one's beginning, uneven knots or not;
    /// the path ends at its ends without curvature.
    #[test]
    fn spans_meet_with_slope_and_curvature() {
        let places = [0.0, 0.3, 0.7, 0.9, 2.0, 2.2_f64];
        let rows: Vec<Vec<Vector>> =
            places.iter().map(|x| vec![[*x, x.sin(), x * x], [x.cos(), 0.0, 1.0]]).collect();
        for count in 2..=rows.len() {
            let planned: Vec<&[Vector]> = rows[..count].iter().map(Vec::as_slice).collect();
            let spacing = &[0.4, 0.1, 0.35, 1.0, 0.2][..count - 1];
            let path = Path::new(&planned, spacing);
            let near = |a: Vector, b: Vector| (0..3).all(|c| (a[c] - b[c]).abs() < 1e-12);
            for g in 0..2 {
                for k in 1..count - 1 {
                    let [before, after] = [k - 1, k].map(|span| path.jet(span, g, path.knots[k]));
                    assert!(
                        (0..3).all(|n| near(before[n], after[n])),
                        "{count} {k} {before:?} {after:?}"
                    );
                }
                let [begin, end] = [0.0, path.length()].map(|s| path.jet(path.span(s), g, s));
                assert!(begin[0] == planned[0][g] && end[0] == planned[count - 1][g]);
                // Three points of one leg: with three steps both legs have theirs.
                assert!(
                    near(begin[2], [0.0; 3]) && near(end[2], [0.0; 3]),
                    "{count} {begin:?} {end:?}"
                );
            }
        }
    }
}
