//! The array for `ros2_control`: its description, its controllers, and a file that launches both with hardware that only pretends.
//!
//! Each axis is a sliding joint of the name that it has in the trajectory, and each gripper a `gpio` whose interface `vacuum` is that of the
//! commands. The axes of a gripper are a chain of links from the carrier of the array: the tool's center, or the mold of grippers that are
//! gantries of their own. Where the arm is known, its joints are between its foot and the tool's center. A launch file reads the other two beside itself, so a folder can be copied.

use super::{FRAME, PREFIX, TOOL};
use crate::result::ResultFile;
use crate::robot::program::Program;
use crate::robot::program::pose::euler_zyx;
use crate::store::folder::Files;
use plydrape::arm::{Arm, Joint};
use plydrape::geometry::Pose;
use std::fmt::Write;

/// Name of the controller of the axes.
pub const AXES: &str = "ply_controller";
/// The link of the foot of an arm.
const FOOT: &str = "ply_foot";
/// Name of the controller of the vacuum.
pub const OUTPUTS: &str = "ply_vacuum";

/// What launches the description and its controllers.
const LAUNCH: &str = r#""""The array of plydrape with hardware that only pretends: put the plugin of yours into array.urdf."""

from pathlib import Path

from launch import LaunchDescription
from launch_ros.actions import Node

HERE = Path(__file__).resolve().parent


def generate_launch_description():
    description = {"robot_description": (HERE / "array.urdf").read_text(encoding="utf-8")}
    controllers = str(HERE / "controllers.yaml")
    names = CONTROLLERS
    return LaunchDescription([
        Node(
            package="robot_state_publisher",
            executable="robot_state_publisher",
            parameters=[description],
        ),
        Node(
            package="controller_manager",
            executable="ros2_control_node",
            parameters=[description, controllers],
        ),
        Node(package="controller_manager", executable="spawner", arguments=names),
    ])
"#;

/// The files `array.urdf`, `controllers.yaml` and `array.launch.py` of a program and of the result that it is made of.
pub(super) fn files(result: &ResultFile, program: &Program) -> Files {
    let moves = !program.axes.is_empty() || program.arm.is_some();
    let controllers: Vec<&str> = ["joint_state_broadcaster", AXES, OUTPUTS]
        .into_iter()
        .skip(if moves { 0 } else { 2 })
        .collect();
    let launch = LAUNCH.replace("CONTROLLERS", &format!("{controllers:?}"));
    vec![
        ("array.urdf".into(), description(result, program).into_bytes()),
        ("controllers.yaml".into(), parameters(program, &controllers).into_bytes()),
        ("array.launch.py".into(), launch.into_bytes()),
    ]
}

/// The description in URDF.
fn description(result: &ResultFile, program: &Program) -> String {
    let tool = result.scene.tool.as_ref();
    let base = if tool.is_some() { TOOL } else { FRAME };
    let each = tool.map_or(3, |tool| tool.axes.len());
    let mut links = format!("  <link name=\"{base}\"/>\n");
    let mut joints = String::new();
    if let Some(known) = &program.arm {
        links += &arm(&known.arm, &program.frames.tool);
        for (joint, initial) in known.arm.joints.iter().zip(known.angles[0]) {
            joints += &controlled(&joint.name, initial);
        }
    }
    for (n, axis) in program.axes.iter().enumerate() {
        let (gripper, own) = (n / each, n % each);
        let (home, direction) = match tool {
            Some(tool) => (tool.mounts[gripper], tool.axes[own].direction),
            None => ([0.0; 3], [0, 1, 2].map(|c| f64::from(c == own))),
        };
        // the first axis of a gripper begins at the carrier, and each other one at the axis before
        let (parent, origin) = match own {
            0 => (base.to_owned(), home),
            _ => (format!("{}_slide", program.axes[n - 1].name), [0.0; 3]),
        };
        let least = axis.values.iter().copied().fold(f64::INFINITY, f64::min);
        let most = axis.values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let [lower, upper] = axis.stroke.unwrap_or([least, most]);
        let (name, speed) = (&axis.name, axis.speed);
        let [origin, direction] = [origin, direction].map(|[x, y, z]| format!("{x} {y} {z}"));
        // writing to a string does not fail
        let _ = write!(
            links,
            r#"  <link name="{name}_slide"/>
  <joint name="{name}" type="prismatic">
    <parent link="{parent}"/>
    <child link="{name}_slide"/>
    <origin xyz="{origin}"/>
    <axis xyz="{direction}"/>
    <limit lower="{lower}" upper="{upper}" velocity="{speed}" effort="1000"/>
  </joint>
"#
        );
        joints += &controlled(name, axis.values[0]);
    }
    for gripper in program.grippers() {
        let _ = write!(
            joints,
            r#"    <gpio name="{gripper}">
      <command_interface name="vacuum"/>
      <state_interface name="vacuum"/>
    </gpio>
"#
        );
    }
    let ends = match tool {
        Some(_) => "",
        None => {
            "\n     The ends of the axes are those of this motion, because the scene knows no others."
        }
    };
    format!(
        r#"<?xml version="1.0"?>
<!-- The axes of the array, without shapes and masses, which plydrape does not know; nor does it know the effort of a joint.{ends} -->
<robot name="ply_array">
{links}  <ros2_control name="ply_array" type="system">
    <hardware>
      <plugin>mock_components/GenericSystem</plugin>
    </hardware>
{joints}  </ros2_control>
</robot>
"#
    )
}

/// A joint whose position is commanded, from an initial one.
fn controlled(name: &str, initial: f64) -> String {
    format!(
        r#"    <joint name="{name}">
      <command_interface name="position"/>
      <state_interface name="position"><param name="initial_value">{initial}</param></state_interface>
      <state_interface name="velocity"/>
    </joint>
"#
    )
}

/// The joints of the arm from its foot to the tool's center, which is at a pose in the frame of the flange.
fn arm(arm: &Arm, tool: &Pose) -> String {
    // a pose in URDF: a place, and roll, pitch and yaw
    let mut text = format!("  <link name=\"{FOOT}\"/>\n");
    let origin = |pose: &Pose| {
        let ([x, y, z], [yaw, pitch, roll]) = (pose.position, euler_zyx(pose));
        format!("<origin xyz=\"{x} {y} {z}\" rpy=\"{roll} {pitch} {yaw}\"/>")
    };

    // each joint begins at the link that the joint before turns
    let mut parent = FOOT.to_owned();
    for joint in &arm.joints {
        let Joint { name, axis: [x, y, z], range: [lower, upper], speed, pose } = joint;
        let place = origin(pose);
        let _ = write!(
            text,
            r#"  <link name="{PREFIX}{name}"/>
  <joint name="{name}" type="revolute">
    <parent link="{parent}"/>
    <child link="{PREFIX}{name}"/>
    {place}
    <axis xyz="{x} {y} {z}"/>
    <limit lower="{lower}" upper="{upper}" velocity="{speed}" effort="1000"/>
  </joint>
"#
        );
        parent = format!("{PREFIX}{name}");
    }

    // the tool is fixed to the last link
    let place = origin(&arm.flange.compose(tool));
    let _ = write!(
        text,
        r#"  <joint name="{PREFIX}tool_at_flange" type="fixed">
    <parent link="{parent}"/>
    <child link="{TOOL}"/>
    {place}
  </joint>
"#
    );
    text
}

/// The parameters of the controllers.
fn parameters(program: &Program, controllers: &[&str]) -> String {
    // the type of each controller
    let mut text = "controller_manager:\n  ros__parameters:\n    update_rate: 500\n".to_owned();
    for name in controllers {
        let kind = match *name {
            AXES => "joint_trajectory_controller/JointTrajectoryController",
            OUTPUTS => "gpio_controllers/GpioCommandController",
            _ => "joint_state_broadcaster/JointStateBroadcaster",
        };
        let _ = write!(text, "    {name}:\n      type: {kind}\n");
    }

    // joints of the arm and axes of the array follow one trajectory
    if !program.axes.is_empty() || program.arm.is_some() {
        let arm = program.arm.iter().flat_map(|known| &known.arm.joints);
        let arm = arm.map(|joint| joint.name.as_str());
        let names: Vec<&str> =
            arm.chain(program.axes.iter().map(|axis| axis.name.as_str())).collect();
        let _ = write!(
            text,
            "{AXES}:\n  ros__parameters:\n    joints: [{}]\n    command_interfaces: [position]\n    \
             state_interfaces: [position, velocity]\n",
            names.join(", ")
        );
    }

    // the vacuum of each gripper can be commanded and read
    let grippers = program.grippers();
    let _ = write!(text, "{OUTPUTS}:\n  ros__parameters:\n    gpios: [{}]\n", grippers.join(", "));
    for part in ["command_interfaces", "state_interfaces"] {
        let _ = writeln!(text, "    {part}:");
        for gripper in &grippers {
            let _ = writeln!(text, "      {gripper}:\n        interfaces: [vacuum]");
        }
    }
    text
}
