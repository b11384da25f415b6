//! The joints of the arm and the axes that carry the grippers, as one trajectory of joints.
//!
//! A planned motion has the velocity of each axis too, by differences of second order between its samples, and 0 at both
//! ends, where it rests. A simulated drape knows only its steps: velocities are left empty, as the message allows.

use super::message::{Header, JointTrajectory, JointTrajectoryPoint};
use super::{FRAME, time};
use crate::Error;
use crate::robot::program::Program;
use std::borrow::Cow;

/// The trajectory of the joints of the arm, where it is known, and of the axes of a program.
///
/// # Errors
/// [`Error`] if a time is none that ROS 2 can say.
pub(super) fn trajectory(program: &Program) -> Result<JointTrajectory, Error> {
    let clock = time::clock(&program.times)?;
    let last = clock.len() - 1;
    let joints = joints(program);
    let point = |k: usize| {
        let velocity = |values: &[f64]| match k {
            _ if k == 0 || k == last => 0.0,
            _ => {
                let around = [k - 1, k, k + 1];
                slope(around.map(|n| program.times[n]), around.map(|n| values[n]))
            }
        };
        let velocities = joints.iter().map(|(_, values)| velocity(values));
        JointTrajectoryPoint {
            positions: joints.iter().map(|(_, values)| values[k]).collect(),
            velocities: if program.rate.is_some() { velocities.collect() } else { Vec::new() },
            accelerations: Vec::new(),
            effort: Vec::new(),
            time_from_start: time::duration(clock[k]),
        }
    };
    Ok(JointTrajectory {
        // a time of 0: begin when the message is received
        header: Header { frame_id: FRAME.into(), ..Header::default() },
        joint_names: joints.iter().map(|(name, _)| (*name).to_owned()).collect(),
        points: (0..=last).map(point).collect(),
    })
}

/// The name and the values of each joint: those of the arm first, from foot to flange.
fn joints(program: &Program) -> Vec<(&str, Cow<'_, [f64]>)> {
    let arm = program.arm.iter().flat_map(|known| {
        known.arm.joints.iter().enumerate().map(|(n, joint)| {
            let angles = known.angles.iter().map(|angles| angles[n]).collect();
            (&*joint.name, Cow::Owned(angles))
        })
    });
    let axes = program.axes.iter().map(|axis| (&*axis.name, Cow::Borrowed(&*axis.values)));
    arm.chain(axes).collect()
}

/// The slope of the parabola through three values in the middle of them.
fn slope([before, now, after]: [f64; 3], [p, q, r]: [f64; 3]) -> f64 {
    let (h, k) = (now - before, after - now);
    ((q - p) / h * k + (r - q) / k * h) / (h + k)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A parabola has its own slope, at uneven times too.
    #[test]
    fn the_slope_of_a_parabola_is_exact() {
        let curve = |t: f64| 0.3 + 0.5 * t - 0.2 * t * t;
        let times = [0.5, 0.8, 1.5];
        assert!((slope(times, times.map(curve)) - (0.5 - 0.4 * 0.8)).abs() < 1e-15);
    }
}
