//! A mold measured at the nodes of a grid, with a smooth surface through them.
//!
//! The surface is the tensor product of cubic splines: along each grid line a cubic between neighboring
//! nodes, slope and curvature continuous, and the third derivative too at the first and last node
//! inside ("not a knot"). So it reproduces every cubic in x and y, and its error falls with the fourth power
//! of the node distance. A cubic between two nodes follows from heights z and second derivatives m at both,
//!
//! s(t) = a z₀ + b z₁ + h²/6 [(a³ − a) m₀ + (b³ − b) m₁],  b = t/h = 1 − a,
//!
//! and the m are the solution of a tridiagonal system.

use super::height::{Height, Steepness};
use crate::Error;

/// A smooth surface through heights on a rectangular grid.
#[derive(Debug, Clone, PartialEq)]
pub struct HeightGrid {
    /// Places of the nodes along x (m), ascending.
    x: Vec<f64>,
    /// Places of the nodes along y (m), ascending.
    y: Vec<f64>,
    /// Heights (m), those along x side by side.
    z: Vec<f64>,
    /// At every node z, ∂²z/∂x², ∂²z/∂y² and ∂⁴z/∂x²∂y² of the surface.
    nodes: Vec<[f64; 4]>,
}

/// Fewest nodes of a spline.
const FEWEST: usize = 4;

impl HeightGrid {
    /// The surface through heights `z` (m) at nodes that lie at `x` and `y` (m), both ascending; z runs
    /// along x first.
    ///
    /// # Errors
    /// [`Error::HeightGridTooFew`] for fewer than 4 × 4 nodes, [`Error::HeightGridCount`] without one height for each,
    /// [`Error::HeightGridNotFinite`], and [`Error::HeightGridNotAscending`] for places that do not ascend.
    pub fn new(x: Vec<f64>, y: Vec<f64>, z: Vec<f64>) -> Result<Self, Error> {
        let (nx, ny) = (x.len(), y.len());
        if nx < FEWEST || ny < FEWEST {
            return Err(Error::HeightGridTooFew { nx, ny });
        }
        if z.len() != nx * ny {
            return Err(Error::HeightGridCount { found: z.len(), wanted: nx * ny });
        }
        if x.iter().chain(&y).chain(&z).any(|value| !value.is_finite()) {
            return Err(Error::HeightGridNotFinite);
        }
        for pair in x.windows(2).chain(y.windows(2)) {
            if pair[0] >= pair[1] {
                return Err(Error::HeightGridNotAscending { before: pair[0], after: pair[1] });
            }
        }
        let mut nodes: Vec<[f64; 4]> = z.iter().map(|z| [*z, 0.0, 0.0, 0.0]).collect();
        // second derivatives along x, then those along y of heights and of second derivatives
        for j in 0..ny {
            let row: Vec<f64> = (0..nx).map(|i| nodes[j * nx + i][0]).collect();
            for (i, m) in second_derivatives(&x, &row).into_iter().enumerate() {
                nodes[j * nx + i][1] = m;
            }
        }
        for i in 0..nx {
            for (from, to) in [(0, 2), (1, 3)] {
                let column: Vec<f64> = (0..ny).map(|j| nodes[j * nx + i][from]).collect();
                for (j, m) in second_derivatives(&y, &column).into_iter().enumerate() {
                    nodes[j * nx + i][to] = m;
                }
            }
        }
        Ok(HeightGrid { x, y, z, nodes })
    }

    /// Places of the nodes along x and along y, and their heights, those along x side by side (m).
    #[must_use]
    pub fn nodes(&self) -> [&[f64]; 3] {
        [&self.x, &self.y, &self.z]
    }

    /// Nodes along x and along y.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.x.len(), self.y.len()]
    }

    /// The rectangle of the grid: ranges of x and of y (m).
    #[must_use]
    pub fn range(&self) -> [[f64; 2]; 2] {
        [&self.x, &self.y].map(|axis| [axis[0], axis[axis.len() - 1]])
    }

    /// The height at (x, y) (m). Beyond the grid the cubics at its boundary go on.
    #[must_use]
    pub fn at(&self, x: f64, y: f64) -> Height {
        let (i, along_x) = weights(&self.x, x);
        let (j, along_y) = weights(&self.y, y);
        // along x at both grid lines around y: value, slope and curvature of z and of its m along y
        let nx = self.x.len();
        let line = |j: usize, part: usize| {
            let [a, b] = [self.nodes[j * nx + i], self.nodes[j * nx + i + 1]];
            along_x.map(|[za, zb, ma, mb]| {
                za * a[part] + zb * b[part] + ma * a[part + 1] + mb * b[part + 1]
            })
        };
        let [low, high] = [j, j + 1].map(|j| [line(j, 0), line(j, 2)]);
        let across = |along: usize, order: usize| {
            let [za, zb, ma, mb] = along_y[order];
            za * low[0][along] + zb * high[0][along] + ma * low[1][along] + mb * high[1][along]
        };
        Height {
            z: across(0, 0),
            gradient: [across(1, 0), across(0, 1)],
            hessian: [across(2, 0), across(1, 1), across(0, 2)],
        }
    }
}

/// Largest size of (a³ − a)/6 for 0 ≤ a ≤ 1, at a = 1/√3.
const LARGEST_CUBIC: f64 = 0.064_150_029_909_958_43;

impl HeightGrid {
    /// Bounds of its slope and bend over ranges of x and y (m) within the grid.
    ///
    /// Between two nodes a cubic is no larger than the larger of its ends and 0.064 h² (|m₀| + |m₁|), its slope no
    /// larger than that of its chord and h/3 (|m₀| + |m₁|), its second derivative no larger than the larger m.
    #[must_use]
    pub fn steepness(&self, range: [[f64; 2]; 2]) -> Steepness {
        let own = self.range();
        if (0..2).any(|n| range[n][0] < own[n][0] || range[n][1] > own[n][1]) {
            return Steepness::UNKNOWN;
        }
        let nx = self.x.len();
        let value = |ends: [f64; 2], m: [f64; 2], h: f64| {
            ends[0].abs().max(ends[1].abs()) + LARGEST_CUBIC * h * h * (m[0].abs() + m[1].abs())
        };
        let slope = |ends: [f64; 2], m: [f64; 2], h: f64| {
            (ends[1] - ends[0]).abs() / h + h / 3.0 * (m[0].abs() + m[1].abs())
        };
        let cells = (0..self.y.len() - 1).flat_map(|j| (0..nx - 1).map(move |i| [i, j]));
        cells.fold(Steepness::default(), |most, [i, j]| {
            let [h, k] = [self.x[i + 1] - self.x[i], self.y[j + 1] - self.y[j]];
            // at the corners, by x and then y
            let node = |a: usize, b: usize, part: usize| self.nodes[(j + b) * nx + i + a][part];
            let along_x = |b: usize, part: usize| [node(0, b, part), node(1, b, part)];
            let along_y = |a: usize, part: usize| [node(a, 0, part), node(a, 1, part)];
            // slope along x on both grid lines, interpolated by a cubic along y
            let fx =
                [0, 2].map(|part| [0, 1].map(|b| slope(along_x(b, part), along_x(b, part + 1), h)));
            let fy =
                [0, 1].map(|part| [0, 1].map(|a| slope(along_y(a, part), along_y(a, part + 2), k)));
            let xx = [0, 1].map(|a| value(along_y(a, 1), along_y(a, 3), k));
            let yy = [0, 1].map(|b| value(along_x(b, 2), along_x(b, 3), h));
            // the change along y of the slope along x: that of its chord and of its m
            let change = |part: usize| {
                let (low, high) = (along_x(0, part), along_x(1, part));
                [high[0] - low[0], high[1] - low[1]]
            };
            let across = slope(change(0), change(1), h) / k;
            let xy = across + k / 3.0 * (fx[1][0] + fx[1][1]);
            let size = |ends: [f64; 2]| ends[0].max(ends[1]);
            most.or(Steepness::new(
                [value(fx[0], fx[1], k), value(fy[0], fy[1], h)],
                [size(xx), xy, size(yy)],
            ))
        })
    }
}

/// The interval of `axis` around `t`, and for value, slope and curvature there the weights of z₀, z₁, m₀
/// and m₁.
fn weights(axis: &[f64], t: f64) -> (usize, [[f64; 4]; 3]) {
    let k = axis.partition_point(|node| *node <= t).clamp(1, axis.len() - 1) - 1;
    let h = axis[k + 1] - axis[k];
    let b = (t - axis[k]) / h;
    let a = (axis[k + 1] - t) / h;
    let square = h * h / 6.0;
    let value = [a, b, square * a * (a * a - 1.0), square * b * (b * b - 1.0)];
    let slope = [-1.0 / h, 1.0 / h, h / 6.0 * (1.0 - 3.0 * a * a), h / 6.0 * (3.0 * b * b - 1.0)];
    (k, [value, slope, [0.0, 0.0, a, b]])
}

/// Second derivatives at the nodes of the cubic spline through heights `z` at places `t`, four or more.
fn second_derivatives(t: &[f64], z: &[f64]) -> Vec<f64> {
    let last = t.len() - 1;
    let step: Vec<f64> = t.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let slope: Vec<f64> = (0..last).map(|k| (z[k + 1] - z[k]) / step[k]).collect();

    // rows 1 … last − 1: h₋ m₋ + 2 (h₋ + h) m + h m₊ = 6 Δslope; "not a knot" makes the outer m linear
    // in the two next to them, m₀ = (1 + q) m₁ − q m₂ with q = h₀/h₁
    let mut diagonal: Vec<f64> = (1..last).map(|k| 2.0 * (step[k - 1] + step[k])).collect();
    let mut lower: Vec<f64> = (1..last).map(|k| step[k - 1]).collect();
    let mut upper: Vec<f64> = (1..last).map(|k| step[k]).collect();
    let mut right: Vec<f64> = (1..last).map(|k| 6.0 * (slope[k] - slope[k - 1])).collect();
    let rows = right.len();
    let q = [step[0] / step[1], step[last - 1] / step[last - 2]];
    diagonal[0] += step[0] * (1.0 + q[0]);
    upper[0] -= step[0] * q[0];
    diagonal[rows - 1] += step[last - 1] * (1.0 + q[1]);
    lower[rows - 1] -= step[last - 1] * q[1];

    // elimination without exchange: the diagonal dominates
    for k in 1..rows {
        let factor = lower[k] / diagonal[k - 1];
        diagonal[k] -= factor * upper[k - 1];
        right[k] -= factor * right[k - 1];
    }
    let mut m = vec![0.0; last + 1];
    m[rows] = right[rows - 1] / diagonal[rows - 1];
    for k in (0..rows - 1).rev() {
        m[k + 1] = (right[k] - upper[k] * m[k + 2]) / diagonal[k];
    }
    m[0] = (1.0 + q[0]) * m[1] - q[0] * m[2];
    m[last] = (1.0 + q[1]) * m[last - 1] - q[1] * m[last - 2];
    m
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid over [0, 1] × [0, 2] whose nodes are not evenly spaced.
    fn grid(n: usize, height: impl Fn(f64, f64) -> f64) -> HeightGrid {
        let bent = |k: usize| {
            let t = k as f64 / (n - 1) as f64;
            t + 0.1 * (3.0 * t).sin() * (1.0 - t)
        };
        let x: Vec<f64> = (0..n).map(bent).collect();
        let y: Vec<f64> = (0..n).map(|k| 2.0 * bent(k)).collect();
        let z = y.iter().flat_map(|y| x.iter().map(|x| height(*x, *y))).collect();
        HeightGrid::new(x, y, z).unwrap()
    }

    fn worst(found: &Height, expected: &Height) -> f64 {
        let difference = found.plus(-1.0, expected);
        let parts = difference.gradient.iter().chain(&difference.hessian);
        parts.fold(difference.z.abs(), |most, part| most.max(part.abs()))
    }

    /// Not-a-knot splines hold all cubics; their products all x³y³.
    #[test]
    fn cubics_are_reproduced_with_their_derivatives() {
        // factor and powers of x and y
        let terms = [
            (1.0, 0, 0),
            (1.0, 1, 0),
            (-2.0, 0, 1),
            (0.5, 2, 0),
            (-1.0, 1, 1),
            (0.3, 3, 0),
            (-0.7, 2, 1),
            (0.2, 1, 2),
            (-0.4, 0, 3),
            (0.1, 3, 3),
        ];
        // the k-th derivative of tⁿ
        let power = |t: f64, n: i32, k: i32| {
            let factor: i32 = (0..k).map(|i| n - i).product();
            if factor == 0 { 0.0 } else { f64::from(factor) * t.powi(n - k) }
        };
        let sum = |x: f64, y: f64, i: i32, j: i32| -> f64 {
            terms.iter().map(|&(c, m, n)| c * power(x, m, i) * power(y, n, j)).sum()
        };
        let exact = |x: f64, y: f64| Height {
            z: sum(x, y, 0, 0),
            gradient: [sum(x, y, 1, 0), sum(x, y, 0, 1)],
            hessian: [sum(x, y, 2, 0), sum(x, y, 1, 1), sum(x, y, 0, 2)],
        };
        for n in [4, 5, 9] {
            let grid = grid(n, |x, y| exact(x, y).z);
            // inside, at a node, at the boundary and beyond it
            for [x, y] in [[0.31, 1.23], [grid.x[2], grid.y[1]], [0.0, 2.0], [1.2, -0.1]] {
                let error = worst(&grid.at(x, y), &exact(x, y));
                assert!(error < 1e-11, "{n} ({x}, {y}): {error:e}");
            }
        }
    }

    #[test]
    fn the_error_falls_with_the_fourth_power_of_the_node_distance() {
        let height = |x: f64, y: f64| (2.0 * x + 0.3).sin() * (1.5 * y).cos();
        // in the middle of every cell
        let error = |n: usize| {
            let grid = grid(n, height);
            let middles = |axis: &[f64]| -> Vec<f64> {
                axis.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect()
            };
            let (xs, ys) = (middles(&grid.x), middles(&grid.y));
            let errors = xs
                .iter()
                .flat_map(|x| ys.iter().map(|y| (grid.at(*x, *y).z - height(*x, *y)).abs()));
            errors.fold(0.0, f64::max)
        };
        let [coarse, fine] = [error(41), error(81)];
        let order = (coarse / fine).log2();
        assert!((3.9..4.2).contains(&order), "{coarse:e} {fine:e}: order {order}");
    }

    #[test]
    fn height_slope_and_curvature_are_continuous_across_nodes() {
        let grid = grid(7, |x, y| (5.0 * x * y).sin() + x.exp());
        let (x, y, e) = (grid.x[3], grid.y[2], 1e-9);
        let here = grid.at(x, y);
        for [dx, dy] in [[-e, 0.0], [0.0, -e], [-e, -e]] {
            // the third derivative is about 100: steps of 1e-9 change the curvature by 1e-7
            let change = worst(&grid.at(x + dx, y + dy), &here);
            assert!(change < 1e-6, "{change:e}");
        }
    }

    #[test]
    fn what_is_no_grid_is_refused() {
        let axis = vec![0.0, 1.0, 2.0, 3.0];
        let z = vec![0.0; 16];
        let new = HeightGrid::new;
        assert!(new(axis.clone(), axis.clone(), z.clone()).is_ok());
        let few = new(axis[..3].to_vec(), axis.clone(), vec![0.0; 12]);
        assert_eq!(few, Err(Error::HeightGridTooFew { nx: 3, ny: 4 }));
        let short = new(axis.clone(), axis.clone(), vec![0.0; 15]);
        assert_eq!(short, Err(Error::HeightGridCount { found: 15, wanted: 16 }));
        let back = new(vec![0.0, 2.0, 1.0, 3.0], axis.clone(), z.clone());
        assert_eq!(back, Err(Error::HeightGridNotAscending { before: 2.0, after: 1.0 }));
        let hole = new(axis.clone(), axis, [&[f64::NAN], &z[1..]].concat());
        assert_eq!(hole, Err(Error::HeightGridNotFinite));
    }
}
