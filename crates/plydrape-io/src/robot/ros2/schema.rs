//! Definitions of the messages, as a bag carries them: each followed by those it is made of.
//!
//! `messages.txt` has the definitions of `trajectory_msgs`, `nav_msgs`, `tf2_msgs`, `control_msgs`, `visualization_msgs` and what they need
//! (Apache-2.0, Open Robotics and others), without their comments; the same in ROS 2 Humble and later, but for that of `control_msgs`,
//! which is that of Jazzy and later.

/// A pose with its time.
pub(super) const POSE: &str = "geometry_msgs/msg/PoseStamped";
/// Poses one after the other.
pub(super) const PATH: &str = "nav_msgs/msg/Path";
/// Frames.
pub(super) const FRAMES: &str = "tf2_msgs/msg/TFMessage";
/// Values of digital outputs.
pub(super) const OUTPUTS: &str = "control_msgs/msg/DynamicInterfaceGroupValues";
/// Positions, velocities and efforts of joints.
pub(super) const JOINTS: &str = "trajectory_msgs/msg/JointTrajectory";
/// Shapes to look at.
pub(super) const MARKERS: &str = "visualization_msgs/msg/MarkerArray";

/// What begins a definition, before its name.
const BEGIN: &str = "MSG: ";
/// Characters of the line that parts a definition from the one before.
const WIDTH: usize = 80;

/// The definition of a message by its full name, followed by those that it is made of, in the order of their fields.
pub(super) fn text(name: &str) -> String {
    let name = name.replace("/msg/", "/");
    let mut all = vec![name.as_str()];
    add_parts(&name, &mut all);
    let mut text = definition(&name).to_owned();
    for part in &all[1..] {
        text += &format!("{}\n{BEGIN}{part}\n{}", "=".repeat(WIDTH), definition(part));
    }
    text
}

/// Adds the messages that a message is made of, each once.
fn add_parts(name: &str, all: &mut Vec<&str>) {
    for field in definition(name).lines() {
        let kind = field.split([' ', '[']).next().unwrap_or_default();
        // only messages have a package before their name
        if kind.contains('/') && !all.contains(&kind) {
            all.push(kind);
            add_parts(kind, all);
        }
    }
}

/// The fields of a message, a line each.
fn definition(name: &str) -> &'static str {
    let mut all = include_str!("messages.txt").split(BEGIN);
    all.find_map(|one| one.strip_prefix(name)?.strip_prefix('\n')).unwrap_or_default()
}
