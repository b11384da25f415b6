//! How an array changes its shape: every edge turns and grows from what it was to what it shall be.
//!
//! Straight ways of the grippers would not do: where a cell shears, its edges turn, and half-way on straight ways they are
//! shorter by the cosine of half the angle. So the edges between neighboring grippers are changed, and the grippers go
//! where they fit these edges best (least squares, by conjugate gradients on the grid). Edges of a curved array that turn
//! each by themselves do not quite close; what is left is taken from them one after the other until all have their
//! lengths (Müller et al. 2007, "Position based dynamics").

use crate::geometry::Point;
use crate::geometry::vector::{along, between, cross, distance, dot, norm, sub};

/// Residual at which the conjugate gradients end, as a share of the first one.
const RESIDUAL: f64 = 1e-12;
/// Rounds over all edges at most in which they are given their lengths.
const ROUNDS: usize = 200;
/// Error of a length, as a share of it, at which the rounds end: small beside the pretension of a front, some 1e-4.
const ERROR: f64 = 1e-6;

/// The array a share of the way from one shape to another (m). Its edges have the share `tight[1]` of their change of length
/// after the share `tight[0]` of the way, because a ply that hangs slack tilts its grippers already, and what inclines it
/// afterwards adds to that; the rest of it comes last, because no edge may be too long meanwhile. `edges` are the grippers at
/// both ends of each.
pub fn formed(
    edges: &[[usize; 2]],
    from: &[Point],
    to: &[Point],
    share: f64,
    tight: [f64; 2],
) -> Vec<Point> {
    let [early, most] = tight;
    let lengthened = if share < early {
        most * share / early
    } else {
        most + (1.0 - most) * (share - early) / (1.0 - early).max(f64::MIN_POSITIVE)
    };
    let straight: Vec<Point> = from.iter().zip(to).map(|(a, b)| between(*a, *b, share)).collect();
    // what the edges lack on straight ways
    let turned: Vec<Point> = edges
        .iter()
        .map(|&[a, b]| turned(sub(from[b], from[a]), sub(to[b], to[a]), share, lengthened))
        .collect();
    let pairs = edges.iter().zip(&turned);
    let lacks: Vec<Point> =
        pairs.map(|(&[a, b], edge)| sub(*edge, sub(straight[b], straight[a]))).collect();
    let corrections = fitted(edges, from.len(), &lacks);
    let mut formed: Vec<Point> =
        straight.iter().zip(corrections).map(|(p, by)| along(*p, 1.0, by)).collect();
    let lengths: Vec<f64> = turned.iter().map(|edge| norm(*edge)).collect();
    give_lengths(edges, &mut formed, &lengths);
    formed
}

/// Moves both ends of each edge by the same way along it until all edges have their lengths (m).
fn give_lengths(edges: &[[usize; 2]], places: &mut [Point], lengths: &[f64]) {
    for _ in 0..ROUNDS {
        let mut worst = 0.0_f64;
        for (&[a, b], length) in edges.iter().zip(lengths) {
            let now = distance(places[a], places[b]);
            if now <= 0.0 {
                continue;
            }
            worst = worst.max((now / length - 1.0).abs());
            let way = sub(places[b], places[a]);
            let by = 0.5 * (length - now) / now;
            places[a] = along(places[a], -by, way);
            places[b] = along(places[b], by, way);
        }
        if worst < ERROR {
            break;
        }
    }
}

/// The vector a share of the way from the direction of one to that of another, with another share of the length.
fn turned(from: Point, to: Point, share: f64, lengthened: f64) -> Point {
    let (sin, cos) = (norm(cross(from, to)), dot(from, to));
    let angle = sin.atan2(cos);
    let lengths = [norm(from), norm(to)];
    if sin <= f64::EPSILON * lengths[0] * lengths[1] {
        return between(from, to, lengthened);
    }
    let length = lengths[0] + lengthened * (lengths[1] - lengths[0]);
    let weight = |share: f64, own: f64| length / own * (share * angle).sin() / angle.sin();
    let (p, q) = (weight(1.0 - share, lengths[0]), weight(share, lengths[1]));
    [0, 1, 2].map(|n| p * from[n] + q * to[n])
}

/// The moves of the grippers, zero on the average, whose differences along the edges fit the given ones best.
fn fitted(edges: &[[usize; 2]], count: usize, differences: &[Point]) -> Vec<Point> {
    // normal equations of a graph: right-hand side from the differences along edges
    let mut residual = vec![[0.0; 3]; count];
    for (&[a, b], difference) in edges.iter().zip(differences) {
        residual[a] = sub(residual[a], *difference);
        residual[b] = along(residual[b], 1.0, *difference);
    }
    // conjugate gradients; all directions sum to zero, which fixes the free constant
    let (mut moves, mut direction) = (vec![[0.0; 3]; count], residual.clone());
    let square = |v: &[Point]| v.iter().map(|p| dot(*p, *p)).sum::<f64>();
    let mut now = square(&residual);
    let enough = RESIDUAL * RESIDUAL * now;
    for _ in 0..count {
        if now <= enough {
            break;
        }
        // Laplacian of the graph times the direction
        let mut image = vec![[0.0; 3]; count];
        for &[a, b] in edges {
            let along_edge = sub(direction[b], direction[a]);
            image[a] = sub(image[a], along_edge);
            image[b] = along(image[b], 1.0, along_edge);
        }
        let curvature: f64 = direction.iter().zip(&image).map(|(d, i)| dot(*d, *i)).sum();
        let step = now / curvature;
        for n in 0..count {
            moves[n] = along(moves[n], step, direction[n]);
            residual[n] = along(residual[n], -step, image[n]);
        }
        let next = square(&residual);
        for n in 0..count {
            direction[n] = along(residual[n], next / now, direction[n]);
        }
        now = next;
    }
    moves
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mold::distance;
    use crate::ply::Grid;

    const GRID: Grid = Grid { nu: 5, nv: 4 };

    fn edges(grid: Grid) -> Vec<[usize; 2]> {
        crate::planner::sample::cloth(grid).neighbors().iter().map(|pair| pair.grippers).collect()
    }

    fn array(place: impl Fn(f64, f64) -> Point) -> Vec<Point> {
        let id = |n: usize| GRID.id(n).map(|k| k as f64);
        (0..GRID.grippers()).map(|n| place(id(n)[0], id(n)[1])).collect()
    }

    /// A level rectangle that becomes a parallelogram, sheared by 40° about its middle, has edges between their two
    /// lengths all the way; on straight ways they would be 1.5 % too short.
    #[test]
    fn a_cell_that_shears_keeps_the_lengths_of_its_edges() {
        let half = 20_f64.to_radians();
        let (sin, cos) = half.sin_cos();
        let from = array(|i, j| [0.099 * (i - 2.0), 0.099 * (j - 1.5), 0.0]);
        let to = array(|i, j| {
            let (u, v) = (0.1 * (i - 2.0), 0.1 * (j - 1.5));
            [cos * u + sin * v, sin * u + cos * v, 0.02]
        });
        for k in 0..=10 {
            let between = formed(&edges(GRID), &from, &to, f64::from(k) / 10.0, [0.5, 0.5]);
            for [a, b] in edges(GRID) {
                let length = distance(between[a], between[b]);
                let expected = 0.099 + 1e-4 * f64::from(k);
                assert!((length - expected).abs() < 1e-12, "{k}: {length} m, not {expected}");
            }
        }
    }

    /// A level array that becomes an inclined, curved one keeps the lengths of its edges on the way, once it is tight: the
    /// fabric is not stretched.
    #[test]
    fn an_array_that_is_bent_keeps_the_lengths_of_its_edges() {
        let from = array(|i, j| [0.098 * (i - 2.0), 0.098 * (j - 1.5), 0.1]);
        let to = array(|i, j| {
            let (x, y) = (0.095 * (i - 2.0), 0.095 * (j - 1.5));
            [x, y, 0.3 * x - 1.2 * x * x + 0.8 * x * y - 0.6 * y * y]
        });
        for k in 4..=10 {
            let between = formed(&edges(GRID), &from, &to, f64::from(k) / 10.0, [0.4, 1.0]);
            for [a, b] in edges(GRID) {
                let ratio = distance(between[a], between[b]) / distance(to[a], to[b]);
                assert!((ratio - 1.0).abs() < 1e-5, "{k}: {ratio}");
            }
        }
    }

    /// It begins as the one shape and ends as the other, and a flat array that is bent over a dome goes straight there to a
    /// two-hundredth of a cell.
    #[test]
    fn an_array_is_formed_from_one_shape_to_another() {
        let from = array(|i, j| [0.098 * (i - 2.0), 0.098 * (j - 1.5), 0.1]);
        let to = array(|i, j| {
            let (x, y) = (0.1 * (i - 2.0), 0.1 * (j - 1.5));
            [x, y, -0.5 * (x * x + y * y)]
        });
        for (share, expected) in [(0.0, &from), (1.0, &to)] {
            for (p, q) in formed(&edges(GRID), &from, &to, share, [0.5, 0.5]).iter().zip(expected) {
                assert!(distance(*p, *q) < 1e-12, "{share}: {p:?} {q:?}");
            }
        }
        for ((p, a), b) in
            formed(&edges(GRID), &from, &to, 0.5, [0.5, 0.5]).iter().zip(&from).zip(&to)
        {
            assert!(distance(*p, between(*a, *b, 0.5)) < 5e-4, "{p:?} {a:?} {b:?}");
        }
    }
}
