//! What a cell does over time: programs for controllers of robots, messages of ROS 2.

pub mod program;
pub mod ros2;
