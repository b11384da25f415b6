//! The posture of a tool: the pose of its frame and the strokes of its axes.
//!
//! For places p_g of the grippers, the pose (R, t) and the strokes s_ga within their limits are sought that make
//!
//! `Σ_g |t + R (m_g + Σ_a s_ga d_a) − p_g|² + ε² Σ_ga s_ga²`
//!
//! smallest. The second term has no say but where the first leaves a choice: a lift of the frame and a stroke of all axes are
//! the same to the grippers. Axes are at right angles, so for a given pose each stroke is the component of
//! `y_g = Rᵀ(p_g − t) − m_g` along its axis, taken into its limits, and six unknowns are left. They are found first as if no axis moved,
//! by Horn's method (1987), and from there with the axes by Gauss and Newton's, so that a posture depends on the places alone and not
//! on the way there. Grippers in a row leave the turn about the row open to Horn's method; there, Gauss and Newton's finds the
//! least turn.

use super::tuning::{CONVERGED, FREE, HALVINGS, OPEN, ROUNDING, STEPS, STROKE_COST};
use super::{Axis, Tool};
use crate::geometry::vector::{along, cross, dot, norm, sub, turned};
use crate::mold::Pose;
use nalgebra::{SMatrix, SVector};

type Matrix6 = SMatrix<f64, 6, 6>;
type Vector6 = SVector<f64, 6>;

/// Where a tool is.
#[derive(Debug, Clone, PartialEq)]
pub struct Posture {
    /// The frame in the scene.
    pub frame: Pose,
    /// Strokes of each gripper (m), one for each axis.
    pub strokes: Vec<Vec<f64>>,
}

impl Tool {
    /// Where the grippers are in a posture (m).
    #[must_use]
    pub fn places(&self, posture: &Posture) -> Vec<[f64; 3]> {
        let place = |(mount, strokes): (&[f64; 3], &Vec<f64>)| {
            let moved = |at, (axis, stroke): (&Axis, &f64)| along(at, *stroke, axis.direction);
            posture.frame.place(self.axes.iter().zip(strokes).fold(*mount, moved))
        };
        self.mounts.iter().zip(&posture.strokes).map(place).collect()
    }

    /// The posture that follows places of the grippers (m) best.
    #[must_use]
    pub fn posture(&self, places: &[[f64; 3]]) -> Posture {
        let size = self.mounts.iter().map(|m| norm(*m)).fold(f64::MIN_POSITIVE, f64::max);
        // first as if no axis moved: what is left then is within the strokes of most motions
        let frame = rigid(&self.mounts, places).unwrap_or_else(|| {
            let upright = Pose::new(middle(places), [0.0; 3]);
            self.fitted(upright, &[], places, size)
        });
        let frame = self.fitted(frame, &self.axes, places, size);
        let strokes = places.iter().zip(&self.mounts).map(|(p, m)| {
            let off = sub(frame.local(*p), *m);
            self.axes.iter().map(|axis| axis.stroke_to(off)).collect()
        });
        Posture { strokes: strokes.collect(), frame }
    }

    /// The pose of the frame that leaves least, found from a pose near it.
    fn fitted(&self, mut frame: Pose, axes: &[Axis], places: &[[f64; 3]], size: f64) -> Pose {
        let mut cost = self.cost(&frame, axes, places);
        for _ in 0..STEPS {
            let (matrix, slope) = self.linear(&frame, axes, places, size);
            let Some(step) = solved(&matrix, &slope) else { break };
            let mut share = 1.0;
            let mut found = None;
            for _ in 0..HALVINGS {
                let tried = moved(&frame, &(share * step), size);
                let now = self.cost(&tried, axes, places);
                if now <= cost * (1.0 + ROUNDING) {
                    found = Some((tried, now));
                    break;
                }
                share *= 0.5;
            }
            let Some((tried, now)) = found else { break };
            (frame, cost) = (tried, now);
            if share * step.amax() <= CONVERGED {
                break;
            }
        }
        frame
    }

    /// What a pose of the frame leaves, squared (m²).
    fn cost(&self, frame: &Pose, axes: &[Axis], places: &[[f64; 3]]) -> f64 {
        let one = |(p, m): (&[f64; 3], &[f64; 3])| {
            let off = sub(frame.local(*p), *m);
            let mut left = off;
            let mut strokes = 0.0;
            for axis in axes {
                let stroke = axis.stroke_to(off);
                left = along(left, -stroke, axis.direction);
                strokes += stroke * stroke;
            }
            dot(left, left) + STROKE_COST * STROKE_COST * strokes
        };
        places.iter().zip(&self.mounts).map(one).sum()
    }

    /// Gauss and Newton's matrix and slope of half the cost, to a move of the frame along its own axes (of `size`) and a turn about them.
    fn linear(
        &self,
        frame: &Pose,
        axes: &[Axis],
        places: &[[f64; 3]],
        size: f64,
    ) -> (Matrix6, Vector6) {
        let (mut matrix, mut slope) = (Matrix6::zeros(), Vector6::zeros());
        let mut add = |residual: f64, row: Vector6| {
            matrix += row * row.transpose();
            slope += residual * row;
        };
        for (p, m) in places.iter().zip(&self.mounts) {
            let local = frame.local(*p);
            let off = sub(local, *m);
            // a direction n of what is left: dn·y = −n·dt + n·(q × dw) = −n·dt + (n × q)·dw
            let row = |n: [f64; 3]| {
                let turn = cross(n, local);
                Vector6::from([0, 1, 2, 3, 4, 5].map(|k: usize| match k {
                    0..3 => -size * n[k],
                    _ => turn[k - 3],
                }))
            };
            let mut left = off;
            // what a free axis takes is left by no direction along it
            let mut directions = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            for axis in axes {
                let stroke = axis.stroke_to(off);
                left = along(left, -stroke, axis.direction);
                if axis.is_free(stroke) {
                    for direction in &mut directions {
                        let share = dot(*direction, axis.direction);
                        *direction = along(*direction, -share, axis.direction);
                    }
                    add(STROKE_COST * stroke, STROKE_COST * row(axis.direction));
                }
            }
            for (n, direction) in directions.iter().enumerate() {
                if *direction != [0.0; 3] {
                    add(left[n], row(*direction));
                }
            }
        }
        (matrix, slope)
    }
}

impl Axis {
    /// The stroke that comes nearest to a place off its zero (m).
    pub(super) fn stroke_to(&self, off: [f64; 3]) -> f64 {
        dot(self.direction, off).clamp(self.stroke[0], self.stroke[1])
    }

    /// Whether a stroke is at neither limit.
    fn is_free(&self, stroke: f64) -> bool {
        self.stroke[0] < stroke && stroke < self.stroke[1]
    }
}

/// The middle of places (m).
fn middle(places: &[[f64; 3]]) -> [f64; 3] {
    let count = places.len().max(1) as f64;
    [0, 1, 2].map(|c| places.iter().map(|p| p[c]).sum::<f64>() / count)
}

/// The pose that brings mounts nearest to places (m), by the sum of squares; none where they leave a turn open (Horn 1987, eq. 26: the quaternion
/// is the eigenvector to the largest eigenvalue).
fn rigid(mounts: &[[f64; 3]], places: &[[f64; 3]]) -> Option<Pose> {
    let [from, to] = [mounts, places].map(middle);
    let mut s = [[0.0; 3]; 3];
    for (m, p) in mounts.iter().zip(places) {
        let [m, p] = [sub(*m, from), sub(*p, to)];
        s = [0, 1, 2].map(|a| [0, 1, 2].map(|b| s[a][b] + m[a] * p[b]));
    }
    let [[xx, xy, xz], [yx, yy, yz], [zx, zy, zz]] = s;
    let matrix = SMatrix::<f64, 4, 4>::new(
        xx + yy + zz,
        yz - zy,
        zx - xz,
        xy - yx, //
        yz - zy,
        xx - yy - zz,
        xy + yx,
        zx + xz, //
        zx - xz,
        xy + yx,
        yy - xx - zz,
        yz + zy, //
        xy - yx,
        zx + xz,
        yz + zy,
        zz - xx - yy,
    );
    if !matrix.iter().all(|c| c.is_finite()) {
        return None;
    }
    let parts = matrix.symmetric_eigen();
    let values = &parts.eigenvalues;
    let (best, largest) = values.argmax();
    let next = (0..4).filter(|n| *n != best).map(|n| values[n]).fold(f64::NEG_INFINITY, f64::max);
    if largest - next <= OPEN * values.amax() {
        return None;
    }
    let v = parts.eigenvectors.column(best);
    let turn = Pose::of_quaternion([0.0; 3], [v[1], v[2], v[3], v[0]]);
    Some(Pose { position: sub(to, turn.turn(from)), ..turn })
}

/// The frame moved along its own axes and turned about them; the move is in shares of `size` (m).
fn moved(frame: &Pose, step: &Vector6, size: f64) -> Pose {
    let shift = frame.turn([step[0], step[1], step[2]].map(|c| size * c));
    let turn = frame.turn([step[3], step[4], step[5]]);
    let [x, y, _] = frame.axes.map(|axis| turned(turn, axis));
    // at right angles again, whatever rounding has left
    let z = cross(x, y);
    let z = z.map(|c| c / norm(z));
    let y = cross(z, x);
    let y = y.map(|c| c / norm(y));
    Pose { position: along(frame.position, 1.0, shift), axes: [cross(y, z), y, z] }
}

/// The step of least length that a symmetric positive matrix gives; none of numbers that are not finite.
fn solved(matrix: &Matrix6, slope: &Vector6) -> Option<Vector6> {
    if !(matrix.iter().all(|c| c.is_finite()) && slope.iter().all(|c| c.is_finite())) {
        return None;
    }
    let parts = matrix.symmetric_eigen();
    let largest = parts.eigenvalues.amax();
    let mut step = Vector6::zeros();
    for (value, vector) in parts.eigenvalues.iter().zip(parts.eigenvectors.column_iter()) {
        if *value > FREE * largest {
            step -= vector * (vector.dot(slope) / value);
        }
    }
    Some(step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(32))]

        /// The posture from Horn's start is the one that Gauss and Newton's method finds from an upright frame, with axes in their limits or at them.
        #[test]
        fn a_posture_does_not_depend_on_where_its_search_begins(
            w in [-0.5..0.5, -0.5..0.5, -0.9..0.9],
            off in prop::collection::vec([-0.02..0.02, -0.02..0.02, -0.04..0.04], 12),
        ) {
            let place = |n: usize| [0.1 * (n % 4) as f64, 0.12 * (n / 4) as f64, 0.02 * n as f64];
            let start: Vec<[f64; 3]> = (0..12).map(place).collect();
            let of = |off: [f64; 3], p: [f64; 3]| turned(w, [0, 1, 2].map(|c| p[c] + off[c] + 0.3));
            let asked: Vec<[f64; 3]> = start.iter().zip(&off).map(|(p, off)| of(*off, *p)).collect();
            let axis = |direction: [f64; 3], stroke: f64| {
                Axis { name: "a".into(), direction, stroke: [-stroke, stroke], speed: 0.1 }
            };
            let z = axis([0.0, 0.0, 1.0], 0.02);
            let all = vec![axis([1.0, 0.0, 0.0], 0.2), axis([0.0, 1.0, 0.0], 0.2), axis([0.0, 0.0, 1.0], 0.2)];
            for axes in [vec![], vec![z], all] {
                let tool = Tool::new(&start, axes);
                let size = tool.mounts.iter().map(|m| norm(*m)).fold(0.0, f64::max);
                let upright = Pose::new(middle(&asked), [0.0; 3]);
                let frame = tool.fitted(upright, &[], &asked, size);
                let frame = tool.fitted(frame, &tool.axes, &asked, size);
                let found = tool.posture(&asked).frame;
                let near = |a: [f64; 3], b: [f64; 3]| norm(sub(a, b)) < 1e-9;
                prop_assert!(near(found.position, frame.position), "{found:?} {frame:?}");
                prop_assert!((0..3).all(|c| near(found.axes[c], frame.axes[c])), "{found:?} {frame:?}");
            }
        }
    }
}
