//! 3 × 3 matrices as arrays of rows.

use crate::geometry::vector::{cross, dot};

/// A 3 × 3 matrix by its rows.
pub type Matrix3 = [[f64; 3]; 3];

/// The identity.
pub const IDENTITY: Matrix3 = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// M x.
pub fn times(m: &Matrix3, x: [f64; 3]) -> [f64; 3] {
    [dot(m[0], x), dot(m[1], x), dot(m[2], x)]
}

/// Mᵀ x.
pub fn transposed_times(m: &Matrix3, x: [f64; 3]) -> [f64; 3] {
    [0, 1, 2].map(|n| m[0][n] * x[0] + m[1][n] * x[1] + m[2][n] * x[2])
}

/// M N.
pub fn product(m: &Matrix3, n: &Matrix3) -> Matrix3 {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[i][0] * n[0][j] + m[i][1] * n[1][j] + m[i][2] * n[2][j]))
}

/// Mᵀ.
pub fn transposed(m: &Matrix3) -> Matrix3 {
    [0, 1, 2].map(|i| [m[0][i], m[1][i], m[2][i]])
}

/// M + s N.
pub fn plus(m: &Matrix3, s: f64, n: &Matrix3) -> Matrix3 {
    [0, 1, 2].map(|i| [0, 1, 2].map(|j| m[i][j] + s * n[i][j]))
}

/// s M.
pub fn scaled(s: f64, m: &Matrix3) -> Matrix3 {
    m.map(|row| row.map(|x| s * x))
}

/// a bᵀ.
pub fn outer(a: [f64; 3], b: [f64; 3]) -> Matrix3 {
    a.map(|x| b.map(|y| x * y))
}

/// The matrix of x ↦ a × x.
pub fn skew(a: [f64; 3]) -> Matrix3 {
    [[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]]
}

/// The rotation by |w| (rad) about w, after Rodrigues.
pub fn rotation(w: [f64; 3]) -> Matrix3 {
    let angle = dot(w, w).sqrt();
    // sin(φ)/φ and (1 − cos φ)/φ², which have limits at zero
    let (a, b) = if angle < 1e-6 {
        (1.0, 0.5)
    } else {
        (angle.sin() / angle, 2.0 * (0.5 * angle).sin().powi(2) / (angle * angle))
    };
    let k = skew(w);
    plus(&plus(&IDENTITY, a, &k), b, &product(&k, &k))
}

/// The nearest rotation of one that has lost digits: its columns made unit vectors at right angles.
pub fn orthonormal(m: &Matrix3) -> Matrix3 {
    let [x, y, _] = transposed(m);
    let length = dot(x, x).sqrt();
    let x = x.map(|c| c / length);
    let aside = dot(x, y);
    let y = [0, 1, 2].map(|n| y[n] - aside * x[n]);
    let length = dot(y, y).sqrt();
    let y = y.map(|c| c / length);
    transposed(&[x, y, cross(x, y)])
}
