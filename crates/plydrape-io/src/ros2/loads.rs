//! Expected loads on the grippers, at the times of their trajectory: for grippers that control a force.
//!
//! `trajectory_msgs` has no forces on a `MultiDOFJointTrajectory`. A `JointTrajectory` has efforts, so each mount is three
//! sliding joints, along x, y and z: the effort is the load of the ply on the gripper (N), the position the preload of the
//! mount (m). Rigid grippers have no positions.

use super::FRAME;
use super::message::{
    Header, JointTrajectory, JointTrajectoryPoint, MultiDofJointTrajectory,
    MultiDofJointTrajectoryPoint,
};
use crate::OutputError;
use crate::loads::{Load, Loads, Stiffness};
use crate::result::ResultFile;

/// The loads at the points of a trajectory, as far as they are known.
pub(super) fn loads(
    result: &ResultFile,
    loads: &Loads,
    trajectory: &MultiDofJointTrajectory,
) -> Result<JointTrajectory, OutputError> {
    let times = match (&result.plan, result.motion()?) {
        (Some(plan), Some((motion, _))) => motion.samples(plan.rate)?,
        _ => result.steps.iter().map(|step| step.time).collect(),
    };
    let point = |(t, at): (&f64, &MultiDofJointTrajectoryPoint)| {
        let all = loads.at(*t)?;
        let flat = |vector: fn(&Load) -> [f64; 3]| all.iter().flat_map(vector).collect::<Vec<_>>();
        Some(JointTrajectoryPoint {
            positions: loads.mounts.map(|_| flat(|load| load.preload)).unwrap_or_default(),
            velocities: Vec::new(),
            accelerations: Vec::new(),
            effort: flat(|load| load.force),
            time_from_start: at.time_from_start,
        })
    };
    let names = trajectory.joint_names.iter();
    Ok(JointTrajectory {
        header: Header { frame_id: FRAME.into(), ..Header::default() },
        joint_names: names
            .flat_map(|name| ["x", "y", "z"].map(|c| format!("{name}_{c}")))
            .collect(),
        points: times.iter().zip(&trajectory.points).map_while(point).collect(),
    })
}

/// The stiffness of the mounts as names and values (N/mm).
pub(super) fn stiffness(Stiffness { lateral, axial }: Stiffness) -> [(&'static str, String); 2] {
    let value = |k: Option<f64>| k.map_or("rigid".into(), |k| format!("{k:?}"));
    [("lateral_stiffness_n_per_mm", value(lateral)), ("axial_stiffness_n_per_mm", value(axial))]
}

/// The same as a comment at the head of a YAML file.
pub(super) fn head(mounts: Stiffness) -> String {
    let line = |(name, value): (&str, String)| format!("# {name}: {value}\n");
    stiffness(mounts).map(line).concat()
}
