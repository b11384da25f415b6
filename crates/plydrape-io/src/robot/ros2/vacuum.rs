//! The vacuum of the grippers, as commands to digital outputs: `control_msgs/msg/DynamicInterfaceGroupValues`, which the
//! `gpio_command_controller` of `ros2_control` follows. A group is a gripper, its one interface `vacuum` is 1 or 0.

use super::message::{DynamicInterfaceGroupValues, Header, InterfaceValue};
use super::{FRAME, time};
use crate::Error;
use crate::robot::program::{EventKind, Program};
use plydrape::ply::gripper_name;

/// The commands of a program, each with its time (ns).
///
/// # Errors
/// [`Error`] if a time is none that ROS 2 can say.
pub(super) fn commands(
    program: &Program,
) -> Result<Vec<(u64, DynamicInterfaceGroupValues)>, Error> {
    let switched = program.events.iter().filter(|event| event.kind != EventKind::Press);
    let command = |(n, event): (usize, &crate::robot::program::Event)| {
        let at = time::nanoseconds(n + 1, event.time)?;
        let value = if event.kind == EventKind::Grip { 1.0 } else { 0.0 };
        let vacuum = InterfaceValue { interface_names: vec!["vacuum".into()], values: vec![value] };
        let groups: Vec<String> = event.grippers.iter().map(|id| gripper_name(*id)).collect();
        let message = DynamicInterfaceGroupValues {
            header: Header { stamp: time::stamp(at), frame_id: FRAME.into() },
            interface_values: vec![vacuum; groups.len()],
            interface_groups: groups,
        };
        Ok((at, message))
    };
    switched.enumerate().map(command).collect()
}
