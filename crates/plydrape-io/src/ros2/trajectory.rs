//! The grippers' trajectory: one joint a gripper, free in all six degrees, in the order of the grid.
//!
//! A planned motion is known at every time: it is sampled at the plan's rate, with velocity and acceleration.
//! A simulated drape knows only its steps: their poses are given, velocities and accelerations are left empty,
//! as the message allows. Orientations between steps turn at a constant rate; see `turning.rs` for what that
//! makes of their velocity and acceleration.

use super::message::{
    Header, MultiDofJointTrajectory, MultiDofJointTrajectoryPoint, Transform, Twist,
};
use super::{FRAME, Ros2Error, time, turning};
use crate::OutputError;
use crate::result::ResultFile;
use plydrape::draping::record::{Gripper, Step};
use plydrape::motion::{Attitudes, MotionError, TimedMotion};
use plydrape::ply::gripper_name;

/// The trajectory of a result.
///
/// # Errors
/// [`OutputError`] if a time is none that ROS 2 can say, or the plan is not one of this result.
pub(super) fn trajectory(result: &ResultFile) -> Result<MultiDofJointTrajectory, OutputError> {
    let ply = &result.scene.ply;
    let points = match (&result.plan, result.motion()?) {
        (Some(plan), Some((motion, attitudes))) => {
            samples(&motion, &attitudes, ply.grippers(), plan.rate)?
        }
        _ => steps(&result.steps)?,
    };
    // a time of 0: begin when the message is received
    let header = Header { frame_id: FRAME.into(), ..Header::default() };
    let joint = |k| gripper_name(ply.id(k));
    Ok(MultiDofJointTrajectory {
        header,
        joint_names: (0..ply.grippers()).map(joint).collect(),
        points,
    })
}

/// The steps of a drape, without velocities.
fn steps(steps: &[Step]) -> Result<Vec<MultiDofJointTrajectoryPoint>, Ros2Error> {
    let times: Vec<f64> = steps.iter().map(|step| step.time).collect();
    let points = steps.iter().zip(clock(&times)?).map(|(step, time)| {
        let transform = |g: &Gripper| Transform {
            translation: g.commanded().into(),
            rotation: g.quaternion.into(),
        };
        MultiDofJointTrajectoryPoint {
            transforms: step.grippers.iter().map(transform).collect(),
            velocities: Vec::new(),
            accelerations: Vec::new(),
            time_from_start: time::duration(time),
        }
    });
    Ok(points.collect())
}

/// Samples of a motion at a rate (Hz), from rest to rest.
fn samples(
    motion: &TimedMotion,
    attitudes: &Attitudes,
    grippers: usize,
    rate: f64,
) -> Result<Vec<MultiDofJointTrajectoryPoint>, OutputError> {
    for found in [motion.grippers(), attitudes.grippers()] {
        if found != grippers {
            return Err(MotionError::Grippers { found, expected: grippers }.into());
        }
    }
    let times = motion.samples(rate)?;
    let clock = clock(&times)?;
    let turned: Vec<Vec<[f64; 4]>> = times.iter().map(|t| attitudes.at(*t)).collect();
    let point = |k: usize| {
        let inner = k > 0 && k + 1 < times.len();
        let turning = |g: usize| match inner {
            true => {
                let around = [k - 1, k, k + 1];
                turning::rates(around.map(|n| turned[n][g]), around.map(|n| times[n]))
            }
            false => [[0.0; 3]; 2],
        };
        let turning: Vec<_> = (0..grippers).map(turning).collect();
        let transform = |(place, quaternion): ([f64; 3], &[f64; 4])| Transform {
            translation: place.into(),
            rotation: (*quaternion).into(),
        };
        let twists = |linear: Vec<[f64; 3]>, order: usize| {
            let twist = |(linear, angular): ([f64; 3], &[[f64; 3]; 2])| Twist {
                linear: linear.into(),
                angular: angular[order].into(),
            };
            linear.into_iter().zip(&turning).map(twist).collect()
        };
        MultiDofJointTrajectoryPoint {
            transforms: motion.at(times[k]).into_iter().zip(&turned[k]).map(transform).collect(),
            velocities: twists(motion.velocity(times[k]), 0),
            accelerations: twists(motion.acceleration(times[k]), 1),
            time_from_start: time::duration(clock[k]),
        }
    };
    Ok((0..times.len()).map(point).collect())
}

/// Times (s) in whole nanoseconds, each after the one before.
fn clock(times: &[f64]) -> Result<Vec<u64>, Ros2Error> {
    let mut clock: Vec<u64> = Vec::with_capacity(times.len());
    for (k, time) in times.iter().enumerate() {
        let now = time::nanoseconds(k + 1, *time)?;
        if clock.last().is_some_and(|before| now <= *before) {
            return Err(Ros2Error::Order { point: k + 1, time: *time });
        }
        clock.push(now);
    }
    Ok(clock)
}
