//! Orientations between the steps: along the shortest turn, at constant angular speed.
//!
//! Between unit quaternions a and b a share x of the way is
//! `(sin((1 − x)Ω) a + sin(xΩ) b) / sin Ω` with `cos Ω = a · b` (Shoemake 1985). A quaternion and its negative
//! turn alike; each step takes the sign that is nearer to the step before.

use super::tuning::TUNING;
use crate::Error;

/// The orientation of every gripper over time.
#[derive(Debug, Clone, PartialEq)]
pub struct Attitudes {
    times: Vec<f64>,
    /// Unit quaternions of each step, continuous in sign.
    steps: Vec<Vec<[f64; 4]>>,
}

impl Attitudes {
    /// Orientations from quaternions (x, y, z, w), one list of all grippers for each of the ascending
    /// times (s).
    ///
    /// # Errors
    /// [`Error::MotionEmpty`] without a gripper, [`Error::AttitudeTimes`] if times and steps differ in number or times do not
    /// ascend, [`Error::MotionUnequal`] if a step lacks grippers, [`Error::AttitudeQuaternion`] if a quaternion is not of about
    /// unit length.
    pub fn new(times: &[f64], quaternions: &[Vec<[f64; 4]>]) -> Result<Self, Error> {
        let grippers = quaternions.first().map_or(0, Vec::len);
        if grippers == 0 {
            return Err(Error::MotionEmpty);
        }
        let ascend = times.windows(2).all(|pair| pair[0] < pair[1]);
        if times.len() != quaternions.len() || !ascend || !times.iter().all(|t| t.is_finite()) {
            return Err(Error::AttitudeTimes { steps: quaternions.len(), times: times.len() });
        }
        // q and −q are the same orientation: take the one nearer to the step before, so that interpolation goes the short way
        let mut steps: Vec<Vec<[f64; 4]>> = Vec::with_capacity(quaternions.len());
        for (k, step) in quaternions.iter().enumerate() {
            if step.len() != grippers {
                return Err(Error::MotionUnequal {
                    step: k + 1,
                    found: step.len(),
                    expected: grippers,
                });
            }
            let mut signed = Vec::with_capacity(grippers);
            for (gripper, quaternion) in step.iter().enumerate() {
                let length = dot(quaternion, quaternion).sqrt();
                if !(0.9..=1.1).contains(&length) {
                    let quaternion = *quaternion;
                    return Err(Error::AttitudeQuaternion { step: k + 1, gripper, quaternion });
                }
                let turned =
                    steps.last().is_some_and(|before| dot(&before[gripper], quaternion) < 0.0);
                let length = if turned { -length } else { length };
                signed.push(quaternion.map(|c| c / length));
            }
            steps.push(signed);
        }
        Ok(Attitudes { times: times.to_vec(), steps })
    }

    /// Number of grippers.
    #[must_use]
    pub fn grippers(&self) -> usize {
        self.steps[0].len()
    }

    /// Unit quaternions (x, y, z, w) of all grippers at a time (s); before the first step its own, after
    /// the last its own.
    #[must_use]
    pub fn at(&self, t: f64) -> Vec<[f64; 4]> {
        (0..self.grippers()).map(|gripper| self.gripper_at(gripper, t)).collect()
    }

    /// The quaternion of one gripper at a time (s), as in [`Self::at`].
    #[must_use]
    pub fn gripper_at(&self, gripper: usize, t: f64) -> [f64; 4] {
        let after = self.times.partition_point(|time| *time <= t);
        if after == 0 || after == self.times.len() {
            return self.steps[after.saturating_sub(1)][gripper];
        }
        let (from, to) = (self.times[after - 1], self.times[after]);
        let share = (t - from) / (to - from);
        slerp(&self.steps[after - 1][gripper], &self.steps[after][gripper], share)
    }

    /// By how much a gripper turns between two times (rad).
    #[must_use]
    pub fn turn(&self, gripper: usize, [t0, t1]: [f64; 2]) -> f64 {
        let first = self.times.partition_point(|time| *time <= t0).saturating_sub(1);
        let mut turned = 0.0;
        for n in first..self.times.len().saturating_sub(1) {
            let [from, to] = [self.times[n], self.times[n + 1]];
            if from >= t1 {
                break;
            }
            let share = (t1.min(to) - t0.max(from)).max(0.0) / (to - from);
            turned += share * turn(&self.steps[n][gripper], &self.steps[n + 1][gripper]);
        }
        turned
    }
}

/// Angle (rad) of the shortest turn from one orientation to another, both unit quaternions of one sign.
pub fn turn(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    // half angles by the tangent: exact where the cosine is flat
    let [sum, difference] = [1.0, -1.0].map(|sign| {
        let c = [0, 1, 2, 3].map(|k| a[k] + sign * b[k]);
        dot(&c, &c).sqrt()
    });
    4.0 * difference.atan2(sum)
}

/// A share of the way from one unit quaternion to another less than half a turn apart.
pub fn slerp(a: &[f64; 4], b: &[f64; 4], share: f64) -> [f64; 4] {
    // the angle between two quaternions is half of the turn
    let angle = 0.5 * turn(a, b);
    let (p, q) = if angle < TUNING.small_angle {
        (1.0 - share, share)
    } else {
        (((1.0 - share) * angle).sin(), (share * angle).sin())
    };
    let c = [0, 1, 2, 3].map(|k| p * a[k] + q * b[k]);
    let length = dot(&c, &c).sqrt();
    c.map(|x| x / length)
}

fn dot(a: &[f64; 4], b: &[f64; 4]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
