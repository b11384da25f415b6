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
//!
//! **An axis that lifts** grippers off the plane of their mounts takes up whatever a tilt of the frame does to them, but for a shortening of
//! the pattern by the cosine of the tilt. A pattern that is too short would be met by tilting to one side and to the other alike, and the
//! frame would tip over between them. So the tilt and the height of the frame follow from the strokes z_g of this axis alone,
//!
//! `Σ_g z_g (1, m_g) = 0`,
//!
//! which is the mean plane of the grippers, and the other three unknowns from the components across it. Where strokes come to their ends, what
//! they cannot take stands in the place of z_g: then it is that which has no part that the frame could take.

use super::rates::turn_between;
use super::tuning::{
    CHEAPER, CONVERGED, FREE, HALVINGS, LIFTS, OPEN, ROUNDING, SETTLED, STEPS, STROKE_COST,
};
use super::{Axis, Tool};
use crate::geometry::vector::{along, cross, distance, dot, norm, sub, turned};
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
            self.fitted(upright, &[], Part::Whole, places, size)
        });
        let frame = match self.lifting() {
            Some(axis) => self.lifted(frame, axis, places, size),
            None => self.fitted(frame, &self.axes, Part::Whole, places, size),
        };
        let strokes = places.iter().zip(&self.mounts).map(|(p, m)| {
            let off = sub(frame.local(*p), *m);
            self.axes.iter().map(|axis| axis.stroke_to(off)).collect()
        });
        Posture { strokes: strokes.collect(), frame }
    }

    /// The axis that lifts grippers off the plane, or the row, of their mounts.
    fn lifting(&self) -> Option<&Axis> {
        let center = middle(&self.mounts);
        let offs = || self.mounts.iter().map(|mount| sub(*mount, center));
        let spread: f64 = offs().map(|off| dot(off, off)).sum();
        self.axes.iter().find(|axis| {
            let rise: f64 = offs().map(|off| dot(off, axis.direction).powi(2)).sum();
            rise <= LIFTS * LIFTS * spread
        })
    }

    /// The pose of the frame whose height and tilt have the smallest strokes of an axis that lifts, found from a pose near it.
    fn lifted(&self, mut frame: Pose, axis: &Axis, places: &[[f64; 3]], size: f64) -> Pose {
        let across = Part::Across(axis.direction);
        let stroke = |frame: &Pose, (p, m): (&[f64; 3], &[f64; 3])| {
            dot(axis.direction, sub(frame.local(*p), *m))
        };
        // the mean plane: strokes along its normal have no part that grows along the mounts
        let (from, to) = (middle(&self.mounts), middle(places));
        let mut grows = SMatrix::<f64, 3, 3>::zeros();
        for (p, m) in places.iter().zip(&self.mounts) {
            let [p, m] = [sub(*p, to), across.of(sub(*m, from))].map(SVector::<f64, 3>::from);
            grows += p * m.transpose();
        }
        if !grows.iter().all(|c| c.is_finite()) {
            return frame;
        }
        let parts = grows.svd(true, false);
        let mut normal = frame.turn(axis.direction);
        for (value, tangent) in
            parts.singular_values.iter().zip(parts.u.iter().flat_map(|u| u.column_iter()))
        {
            if *value > OPEN * parts.singular_values.max() {
                let tangent = [tangent[0], tangent[1], tangent[2]];
                normal = along(normal, -dot(normal, tangent), tangent);
            }
        }
        let normal = frame.local(along(frame.position, 1.0, normal));
        let turn = cross(axis.direction, normal);
        let sine = norm(turn);
        let angle = sine.atan2(dot(axis.direction, normal));
        let [x, y, z] = turn.map(|c| if sine > 0.0 { c * angle / sine } else { 0.0 });
        frame = moved(&frame, &Vector6::from([0.0, 0.0, 0.0, x, y, z]), size);
        let pairs = || places.iter().zip(&self.mounts);
        let mean =
            pairs().map(|pair| stroke(&frame, pair)).sum::<f64>() / places.len().max(1) as f64;
        frame.position = along(frame.position, mean, frame.turn(axis.direction));
        frame = self.fitted(frame, &self.axes, across, places, size);

        // where strokes end, what they cannot take comes to count in full, step by step; seen from each mount, as above
        let mut cost = 1.0;
        for _ in 0..STEPS {
            if pairs().all(|pair| axis.is_free(stroke(&frame, pair))) {
                break;
            }
            let above = pairs()
                .map(|(p, m)| frame.place(along(*m, stroke(&frame, (p, m)), axis.direction)));
            let above: Vec<[f64; 3]> = above.collect();
            let part = Part::Along(axis.direction, cost);
            let next = self.fitted(frame, std::slice::from_ref(axis), part, &above, size);
            let next = self.fitted(next, &self.axes, across, places, size);
            let turned = norm(turn_between(&frame.axes, &next.axes));
            let change = turned.max(distance(frame.position, next.position) / size);
            frame = next;
            if cost == STROKE_COST && change <= SETTLED {
                break;
            }
            cost = STROKE_COST.max(CHEAPER * cost);
        }
        frame
    }

    /// The pose of the frame that leaves least of a part of the components, found from a pose near it.
    fn fitted(
        &self,
        mut frame: Pose,
        axes: &[Axis],
        part: Part,
        places: &[[f64; 3]],
        size: f64,
    ) -> Pose {
        let mut cost = self.cost(&frame, axes, part, places);
        // Gauss-Newton: the step of the linear problem, halved until the rest does not grow
        for _ in 0..STEPS {
            let (matrix, slope) = self.linear(&frame, axes, part, places, size);
            let Some(step) = solved(&matrix, &slope) else { break };
            let mut share = 1.0;
            let mut found = None;
            for _ in 0..HALVINGS {
                let tried = moved(&frame, &(share * step), size);
                let now = self.cost(&tried, axes, part, places);
                if now <= cost * (1.0 + ROUNDING) {
                    found = Some((tried, now));
                    break;
                }
                share *= 0.5;
            }
            let Some((tried, now)) = found else { break };
            (frame, cost) = (tried, now);
            // a step of the size of rounding ends it
            if share * step.amax() <= CONVERGED {
                break;
            }
        }
        frame
    }

    /// What a pose of the frame leaves, squared (m²).
    fn cost(&self, frame: &Pose, axes: &[Axis], part: Part, places: &[[f64; 3]]) -> f64 {
        let one = |(p, m): (&[f64; 3], &[f64; 3])| {
            let off = sub(frame.local(*p), *m);
            let mut left = off;
            let mut strokes = 0.0;
            for axis in axes {
                let stroke = axis.stroke_to(off);
                left = along(left, -stroke, axis.direction);
                strokes += stroke * stroke;
            }
            let left = part.of(left);
            dot(left, left) + part.stroke_cost() * part.stroke_cost() * strokes
        };
        places.iter().zip(&self.mounts).map(one).sum()
    }

    /// Gauss and Newton's matrix and slope of half the cost, to a move of the frame along its own axes (of `size`) and a turn about them.
    fn linear(
        &self,
        frame: &Pose,
        axes: &[Axis],
        part: Part,
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
                let [n, turn] = part.unknowns(n, cross(n, local));
                Vector6::from([0, 1, 2, 3, 4, 5].map(|k: usize| match k {
                    0..3 => -size * n[k],
                    _ => turn[k - 3],
                }))
            };
            let mut left = off;
            // what a free axis takes is left by no direction along it
            let mut directions =
                [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|d| part.of(d));
            for axis in axes {
                let stroke = axis.stroke_to(off);
                left = along(left, -stroke, axis.direction);
                if axis.is_free(stroke) {
                    for direction in &mut directions {
                        let share = dot(*direction, axis.direction);
                        *direction = along(*direction, -share, axis.direction);
                    }
                    add(part.stroke_cost() * stroke, part.stroke_cost() * row(axis.direction));
                }
            }
            for (n, direction) in directions.iter().enumerate() {
                if *direction != [0.0; 3] {
                    add(part.of(left)[n], row(*direction));
                }
            }
        }
        (matrix, slope)
    }
}

/// Which components of the places a pose of the frame is found from, and which unknowns of it.
#[derive(Debug, Clone, Copy)]
enum Part {
    /// All of them.
    Whole,
    /// Those along an axis (unit vector), which say nothing of a shift across it or a turn about it; with what a stroke costs.
    Along([f64; 3], f64),
    /// Those across an axis, from which a shift across it and a turn about it are found.
    Across([f64; 3]),
}

impl Part {
    /// This part of a vector in the frame.
    fn of(self, v: [f64; 3]) -> [f64; 3] {
        match self {
            Part::Whole => v,
            Part::Along(axis, _) => axis.map(|c| c * dot(v, axis)),
            Part::Across(axis) => along(v, -dot(v, axis), axis),
        }
    }

    /// What a stroke costs beside a residual of the same length.
    fn stroke_cost(self) -> f64 {
        match self {
            Part::Along(_, cost) => cost,
            Part::Whole | Part::Across(_) => STROKE_COST,
        }
    }

    /// A shift and a turn without the unknowns that are not found from this part.
    fn unknowns(self, shift: [f64; 3], turn: [f64; 3]) -> [[f64; 3]; 2] {
        match self {
            Part::Across(axis) => [self.of(shift), axis.map(|c| c * dot(turn, axis))],
            Part::Whole | Part::Along(..) => [shift, turn],
        }
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
    // covariance of mounts and places about their middles, and Horn's symmetric matrix of it
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
    // two equal eigenvalues leave a turn open, as for mounts in a row
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
                let frame = tool.fitted(upright, &[], Part::Whole, &asked, size);
                let frame = tool.fitted(frame, &tool.axes, Part::Whole, &asked, size);
                let found = tool.posture(&asked).frame;
                let near = |a: [f64; 3], b: [f64; 3]| norm(sub(a, b)) < 1e-9;
                prop_assert!(near(found.position, frame.position), "{found:?} {frame:?}");
                prop_assert!((0..3).all(|c| near(found.axes[c], frame.axes[c])), "{found:?} {frame:?}");
            }
        }
    }
}
