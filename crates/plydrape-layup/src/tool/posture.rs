//! The posture of a tool: the pose of its frame and the strokes of its axes.
//!
//! For places p_g of the grippers and a pose (R, t) of the frame, `y_g = Rᵀ(p_g − t) − m_g` is how far gripper g is to go from its mount
//! m_g, in the frame. Axes are at right angles, so each stroke s_ga is the component of y_g along the axis, taken into its limits, and
//! `r_g = y_g − Σ_a s_ga d_a` is the residual. The pose is the one in which residuals and strokes, as springs at the mounts of which that of a
//! stroke is softer by ε², are in equilibrium:
//!
//! `Σ_g f_g = 0, Σ_g m_g × f_g = 0, f_g = r_g + ε² Σ_a s_ga d_a`.
//!
//! Without axes this is the best rigid fit (Horn 1987), and where an axis lifts grippers off the plane of their mounts with no stroke at its
//! end, the frame lies in the mean plane of the grippers.
//!
//! **Levers are the mounts.** The pose of the least `Σ_g |r_g|² + ε² Σ_ga s_ga²` would have levers m_g + y_g instead. A pattern that is shorter, or
//! longer, than the ends of the strokes would then be met by a frame that turns to one side and to the other alike, since a turn by θ changes
//! a pattern by cos θ: after 1 µm of a row of 1 mm it is at 2.6°, and it tips over between both sides for nothing. With the mounts, the pose
//! nearby is the least of a convex function of the move, so there is one, and it follows the places without a jump.
//!
//! **A residual is spent before the frame turns.** Grippers at the ends of their strokes may hold a turn by a lever that is a small share of their
//! distances, so that the last micrometers of a residual would take degrees. The cost ε of a stroke is therefore so large that a share of the
//! residual which the scene allows is spent before the longest stroke is ([`Tool::stroke_cost`]).
//!
//! The pose is found from the best rigid fit by steps, each the least of that convex function, so a posture depends on the places alone and not on
//! the way there: a planner, a page and a program that see other moments of a motion agree. Grippers in a row leave the turn about the row open;
//! there, steps of least length find the least turn.

use super::tuning::{BISECTIONS, CONVERGED, FREE, OPEN, SPENT, SPENT_OF_PITCH, STEPS, STROKE_COST};
use super::{Axis, Tool};
use crate::geometry::vector::{along, cross, distance, dot, mean, norm, sub, turned};
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
            let moved =
                |place, (axis, stroke): (&Axis, &f64)| along(place, *stroke, axis.direction);
            posture.frame.place(self.axes.iter().zip(strokes).fold(*mount, moved))
        };
        self.mounts.iter().zip(&posture.strokes).map(place).collect()
    }

    /// The posture that follows places of the grippers (m) best.
    #[must_use]
    pub fn posture(&self, places: &[[f64; 3]]) -> Posture {
        // as if no axis moved, then with the axes: strokes of most motions are small beside the array
        let frame = rigid(&self.mounts, places)
            .unwrap_or_else(|| self.balanced(Pose::upright(mean(places)), &[], places));
        let frame = match self.axes.is_empty() {
            true => frame,
            false => self.balanced(frame, &self.axes, places),
        };
        let strokes = places.iter().zip(&self.mounts).map(|(p, m)| {
            let off = sub(frame.local(*p), *m);
            self.axes.iter().map(|axis| axis.stroke_to(dot(axis.direction, off))).collect()
        });
        Posture { strokes: strokes.collect(), frame }
    }

    /// What a stroke costs beside a residual of the same length, ε: the residual that may be spent as a share of the longest stroke.
    #[must_use]
    pub fn stroke_cost(&self) -> f64 {
        let ends = self.axes.iter().flat_map(|axis| axis.stroke);
        let longest = ends.map(f64::abs).fold(0.0, f64::max);
        let allowed = self.residual.map(|residual| SPENT * residual);
        let spent = allowed.unwrap_or_else(|| SPENT_OF_PITCH * self.pitch());
        let [least, most] = STROKE_COST;
        if longest > 0.0 { (spent / longest).clamp(least, most) } else { most }
    }

    /// The smallest distance of two mounts (m).
    fn pitch(&self) -> f64 {
        let pairs = self.mounts.iter().enumerate();
        let distances = pairs.flat_map(|(n, a)| self.mounts[..n].iter().map(|b| distance(*a, *b)));
        distances.reduce(f64::min).unwrap_or(0.0)
    }

    /// The pose of the frame in equilibrium, found from a pose near it.
    fn balanced(&self, mut frame: Pose, axes: &[Axis], places: &[[f64; 3]]) -> Pose {
        let size = self.mounts.iter().map(|m| norm(*m)).fold(f64::MIN_POSITIVE, f64::max);
        let springs = Springs { mounts: &self.mounts, axes, size, cost: self.stroke_cost() };
        let (mut share, mut before) = (1.0, Vector6::zeros());
        for _ in 0..STEPS {
            let pairs = places.iter().zip(&self.mounts);
            let offs: Vec<[f64; 3]> = pairs.map(|(p, m)| sub(frame.local(*p), *m)).collect();
            let step = springs.move_from(&offs);
            // moves that go back and forth, as between two ends of strokes, become shorter
            if step.dot(&before) < -0.5 * before.norm_squared() {
                share *= 0.5;
            }
            before = step;
            frame = moved(&frame, &(share * step), size);
            if step.amax() <= CONVERGED {
                break;
            }
        }
        frame
    }
}

/// Residuals and strokes as springs at the mounts, for small moves of the frame: a shift along its axes in shares of `size`, and a turn about them
/// with the mounts as levers.
struct Springs<'a> {
    /// Where the grippers are in the frame with strokes of zero (m).
    mounts: &'a [[f64; 3]],
    /// The axes of each gripper.
    axes: &'a [Axis],
    /// Size of the array (m).
    size: f64,
    /// What a stroke costs beside a residual of the same length.
    cost: f64,
}

impl Springs<'_> {
    /// The move that brings the springs into equilibrium, where grippers are these distances off their mounts (m): the least of a convex
    /// function with a piecewise linear slope, by Newton's method with the least along each of its steps.
    fn move_from(&self, offs: &[[f64; 3]]) -> Vector6 {
        let mut all = Vector6::zeros();
        for _ in 0..STEPS {
            let offs_now = self.moved(offs, &all);
            let (matrix, slope) = self.linear(&offs_now);
            let Some(step) = solved(&matrix, &slope) else { break };
            // slope along the step, at a share of it
            let changes: Vec<[f64; 3]> =
                self.mounts.iter().map(|mount| self.change(*mount, &step)).collect();
            let rises = |share: f64| {
                let slope_of = |(off, change): (&[f64; 3], &[f64; 3])| {
                    dot(*change, self.force(along(*off, share, *change)))
                };
                offs_now.iter().zip(&changes).map(slope_of).sum::<f64>() > 0.0
            };
            let mut share = 1.0;
            if rises(1.0) {
                let mut low = 0.0;
                for _ in 0..BISECTIONS {
                    let middle = 0.5 * (low + share);
                    *(if rises(middle) { &mut share } else { &mut low }) = middle;
                }
            }
            all += share * step;
            // a step of the size of rounding ends it
            if share * step.amax() <= CONVERGED {
                break;
            }
        }
        all
    }

    /// How a move of the frame changes the place of a gripper in it (m).
    fn change(&self, mount: [f64; 3], step: &Vector6) -> [f64; 3] {
        let lever = cross(mount, [step[3], step[4], step[5]]);
        [0, 1, 2].map(|c| lever[c] - self.size * step[c])
    }

    /// Distances off the mounts after a move (m).
    fn moved(&self, offs: &[[f64; 3]], step: &Vector6) -> Vec<[f64; 3]> {
        let pairs = offs.iter().zip(self.mounts);
        pairs.map(|(off, mount)| along(*off, 1.0, self.change(*mount, step))).collect()
    }

    /// The force at a mount whose gripper is this far off (m).
    fn force(&self, off: [f64; 3]) -> [f64; 3] {
        let eased = 1.0 - self.cost * self.cost;
        self.axes.iter().fold(off, |force, axis| {
            along(force, -eased * axis.stroke_to(dot(axis.direction, off)), axis.direction)
        })
    }

    /// Matrix and slope of half the cost, to a move of the frame.
    fn linear(&self, offs: &[[f64; 3]]) -> (Matrix6, Vector6) {
        let (mut matrix, mut slope) = (Matrix6::zeros(), Vector6::zeros());
        for (off, mount) in offs.iter().zip(self.mounts) {
            let rows = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].map(|n| {
                let [x, y, z] = cross(n, *mount);
                let [a, b, c] = n.map(|part| -self.size * part);
                Vector6::from([a, b, c, x, y, z])
            });
            // directions that no free axis takes are stiff, those of free axes soft
            let mut stiff = SMatrix::<f64, 3, 3>::identity();
            for axis in self.axes.iter().filter(|axis| axis.is_free(dot(axis.direction, *off))) {
                let d = SVector::<f64, 3>::from(axis.direction);
                stiff -= d * d.transpose() * (1.0 - self.cost * self.cost);
            }
            let force = self.force(*off);
            for (n, row) in rows.iter().enumerate() {
                slope += force[n] * row;
                for (other, to) in rows.iter().enumerate() {
                    matrix += stiff[(n, other)] * row * to.transpose();
                }
            }
        }
        (matrix, slope)
    }
}

impl Axis {
    /// The stroke that comes nearest to a place along it (m).
    pub(super) fn stroke_to(&self, off: f64) -> f64 {
        off.clamp(self.stroke[0], self.stroke[1])
    }

    /// Whether a stroke is at neither limit.
    fn is_free(&self, stroke: f64) -> bool {
        self.stroke[0] < stroke && stroke < self.stroke[1]
    }
}

/// The pose that brings mounts nearest to places (m), by the sum of squares; none where they leave a turn open (Horn 1987, eq. 26: the quaternion
/// is the eigenvector to the largest eigenvalue).
fn rigid(mounts: &[[f64; 3]], places: &[[f64; 3]]) -> Option<Pose> {
    let [from, to] = [mounts, places].map(mean);
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

        /// The posture from Horn's start is the one that the search finds from an upright frame, with axes in their limits or at them.
        #[test]
        fn a_posture_does_not_depend_on_where_its_search_begins(
            w in [-0.5..0.5, -0.5..0.5, -0.9..0.9],
            off in prop::collection::vec([-0.02..0.02, -0.02..0.02, -0.04..0.04], 12),
        ) {
            let place = |n: usize| [0.1 * (n % 4) as f64, 0.12 * (n / 4) as f64, 0.02 * n as f64];
            let start: Vec<[f64; 3]> = (0..12).map(place).collect();
            let turned_place = |off: [f64; 3], p: [f64; 3]| turned(w, [0, 1, 2].map(|c| p[c] + off[c] + 0.3));
            let asked: Vec<[f64; 3]> = start.iter().zip(&off).map(|(p, off)| turned_place(*off, *p)).collect();
            let axis = |direction: [f64; 3], stroke: f64| {
                Axis { name: "a".into(), direction, stroke: [-stroke, stroke], speed: 0.1 }
            };
            let z = axis([0.0, 0.0, 1.0], 0.02);
            let all = vec![axis([1.0, 0.0, 0.0], 0.2), axis([0.0, 1.0, 0.0], 0.2), axis([0.0, 0.0, 1.0], 0.2)];
            for axes in [vec![], vec![z], all] {
                let tool = Tool::new(&start, axes);
                let upright = Pose::upright(mean(&asked));
                let frame = tool.balanced(upright, &[], &asked);
                let frame = tool.balanced(frame, &tool.axes, &asked);
                let found = tool.posture(&asked).frame;
                let near = |a: [f64; 3], b: [f64; 3]| norm(sub(a, b)) < 1e-9;
                prop_assert!(near(found.position, frame.position), "{found:?} {frame:?}");
                prop_assert!((0..3).all(|c| near(found.axes[c], frame.axes[c])), "{found:?} {frame:?}");
            }
        }
    }
}
