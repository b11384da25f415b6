//! The surface of a shape as triangles.

use super::body::Shape;
use std::f64::consts::TAU;

impl Shape {
    /// Corners (m) and triangles, counterclockwise as seen from outside; a cylinder is a prism with this many `sides`.
    #[must_use]
    pub fn triangles(&self, sides: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
        match self {
            Shape::Mesh { vertices, triangles } => (vertices.clone(), triangles.clone()),
            Shape::Box { .. } => {
                let ends = self.bounds();
                // each bit of the number of a corner says at which end of one axis it is
                let corner = |n: usize| [0, 1, 2].map(|c| ends[n >> c & 1][c]);
                let faces: [[u32; 4]; 6] = [
                    [0, 2, 3, 1],
                    [4, 5, 7, 6],
                    [0, 1, 5, 4],
                    [2, 6, 7, 3],
                    [0, 4, 6, 2],
                    [1, 3, 7, 5],
                ];
                // each face is cut in two along a diagonal
                let halves = |[a, b, c, d]: [u32; 4]| [[a, b, c], [a, c, d]];
                ((0..8).map(corner).collect(), faces.into_iter().flat_map(halves).collect())
            }
            Shape::Cylinder { radius, from, to } => {
                let place = |k: u32, z: f64| {
                    let (sin, cos) = (TAU * f64::from(k) / f64::from(sides)).sin_cos();
                    [radius * cos, radius * sin, z]
                };
                // corners around the axis, low and high in turn, then the middles of the two ends
                let mut vertices: Vec<[f64; 3]> =
                    (0..sides).flat_map(|k| [place(k, *from), place(k, *to)]).collect();
                let [low, high] = [2 * sides, 2 * sides + 1];
                vertices.extend([[0.0, 0.0, *from], [0.0, 0.0, *to]]);
                // a side is two triangles, with one more to the middle of each end
                let side = |k: u32| {
                    let [a, b] = [2 * k, 2 * ((k + 1) % sides)];
                    [[a, b, b + 1], [a, b + 1, a + 1], [b, a, low], [a + 1, b + 1, high]]
                };
                (vertices, (0..sides).flat_map(side).collect())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The volume (m³) that triangles enclose: positive if they are counterclockwise from outside, all of them.
    fn volume(shape: &Shape, sides: u32) -> f64 {
        let (vertices, triangles) = shape.triangles(sides);
        let determinant = |t: &[u32; 3]| {
            let [[a, b, c], [d, e, f], [g, h, i]] = t.map(|n| vertices[n as usize]);
            a * (e * i - f * h) + b * (f * g - d * i) + c * (d * h - e * g)
        };
        triangles.iter().map(determinant).sum::<f64>() / 6.0
    }

    /// A box encloses the product of its sides, and a cylinder that of its height and a regular polygon.
    #[test]
    fn triangles_enclose_the_volume_of_their_shape() {
        let found = volume(&Shape::Box { size: [0.2, 0.3, 0.5], at: [1.0, -2.0, 0.4] }, 3);
        assert!((found - 0.03).abs() < 1e-12, "{found}");
        for sides in [3, 20] {
            let found = volume(&Shape::Cylinder { radius: 0.1, from: 0.3, to: 0.8 }, sides);
            let sides = f64::from(sides);
            let polygon = 0.5 * sides * 0.01 * (TAU / sides).sin();
            assert!((found - 0.5 * polygon).abs() < 1e-12, "{found}");
        }
    }
}
