//! Expected loads on the grippers, at the times of their trajectory: for grippers that control a force.
//!
//! A `JointTrajectory` has efforts, so each mount is three sliding joints, along x, y and z: the effort is the load of the ply on the gripper (N), the position the preload of the
//! mount (m). Rigid grippers have no positions.

use super::FRAME;
use super::message::{Header, JointTrajectory, JointTrajectoryPoint};
use super::time;
use crate::Error;
use crate::robot::program::Program;
use crate::write::loads::{Load, Loads, Stiffness};

/// The loads at the times of a program, as far as they are known.
///
/// # Errors
/// [`Error`] if a time is none that ROS 2 can say.
pub(super) fn loads(program: &Program, loads: &Loads) -> Result<JointTrajectory, Error> {
    let clock = time::clock(&program.times)?;
    let point = |(t, at): (&f64, &u64)| {
        let all = loads.interpolate(*t)?;
        let flat = |vector: fn(&Load) -> [f64; 3]| all.iter().flat_map(vector).collect::<Vec<_>>();
        Some(JointTrajectoryPoint {
            positions: loads.mounts.map(|_| flat(|load| load.preload)).unwrap_or_default(),
            velocities: Vec::new(),
            accelerations: Vec::new(),
            effort: flat(|load| load.force),
            time_from_start: time::duration(*at),
        })
    };
    let names = program.pads.iter().map(|pad| &pad.name);
    Ok(JointTrajectory {
        header: Header { frame_id: FRAME.into(), ..Header::default() },
        joint_names: names
            .flat_map(|name| ["x", "y", "z"].map(|c| format!("{name}_{c}")))
            .collect(),
        points: program.times.iter().zip(&clock).map_while(point).collect(),
    })
}

/// The stiffness of the mounts as names and values (N/mm).
pub(super) fn stiffness(Stiffness { lateral, axial }: Stiffness) -> [(&'static str, String); 2] {
    let value = |k: Option<f64>| k.map_or("rigid".into(), |k| format!("{k:?}"));
    [("lateral_stiffness_n_per_mm", value(lateral)), ("axial_stiffness_n_per_mm", value(axial))]
}

/// The mounts as a comment at the head of a YAML file.
pub(super) fn head(mounts: Stiffness) -> String {
    let line = |(name, value): (&str, String)| format!("# {name}: {value}\n");
    stiffness(mounts).map(line).concat()
}
