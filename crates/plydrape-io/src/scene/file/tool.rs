//! The keys of the table `[tool]`.

use crate::scene::located::{Fixed, Located};
use crate::scene::quantity::{Measure, Quantity, written};
use crate::scene::usual::{
    AxisSpeed, Coordinate, Flange, Heading, Residual, Stroke, TurnAcceleration, TurnRate,
};
use plydrape::tool::Tool;
use schemars::JsonSchema;
use serde::Deserialize;

/// A frame at the flange of a robot that carries all grippers. Its origin is in the middle of the grippers at the start, and its axes
/// are those of the scene there. Without this table each gripper moves by itself.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Tool")]
pub(in crate::scene) struct ToolTable {
    /// Linear axes between the frame and each gripper, one for a direction; without them the grippers are fixed in the frame.
    pub axes: Option<Located<Vec<Located<AxisTable>>>>,
    /// What lets the pads tilt. By "ball" joints each follows the ply; with "none" they turn with the frame alone.
    #[schemars(extend("default" = "ball"))]
    pub joints: Option<Located<JointsKey>>,
    /// Largest angular speed of the frame (rad/s).
    #[schemars(extend("default" = written(Tool::new(&[], Vec::new()).turn_rate, "deg/s")))]
    pub turn_rate: Option<Quantity<TurnRate>>,
    /// Largest angular acceleration of the frame (rad/s²).
    #[schemars(extend("default" = written(Tool::new(&[], Vec::new()).turn_acceleration, "deg/s^2")))]
    pub turn_acceleration: Option<Quantity<TurnAcceleration>>,
    /// Farthest that the tool may bring a gripper from where it should be (m); no limit unless given.
    pub residual: Option<Quantity<Residual>>,
    /// Where the flange of the robot is in the frame, for programs; in the frame's origin unless given.
    pub flange: Option<PlacedTable<Flange>>,
    /// Where the origin of the scene is in the world of the robot, for programs; in its origin unless given.
    pub world: Option<PlacedTable<Coordinate>>,
}

/// A linear axis of each gripper.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Axis")]
pub(in crate::scene) struct AxisTable {
    /// Direction in the frame in which its stroke grows.
    pub direction: Located<AxisKey>,
    /// Smallest and largest stroke (m), from where the gripper is at the start.
    pub stroke: Located<Fixed<Quantity<Stroke>, 2>>,
    /// Largest speed (m/s), that of [limits] unless given.
    pub speed: Option<Quantity<AxisSpeed>>,
}

/// A direction of the frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Direction of an axis")]
pub(in crate::scene) enum AxisKey {
    /// Along the frame's x.
    X,
    /// Along the frame's y.
    Y,
    /// Along the frame's z, which is upwards at the start.
    Z,
}

/// What lets the pads of a tool tilt.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Joints of the pads")]
pub(in crate::scene) enum JointsKey {
    /// A passive ball joint at each pad, which follows the ply.
    Ball,
    /// Nothing: the pads keep the orientation of the array at the start, and turn with the frame alone.
    None,
}

/// A place and a turn.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, bound = "M: Measure", expecting = "a table of keys and values")]
#[schemars(inline, bound = "M: Measure")]
pub(in crate::scene) struct PlacedTable<M: Measure> {
    /// Origin (m).
    pub position: Option<Located<Fixed<Quantity<M>, 3>>>,
    /// How it is turned: about the fixed axes x, then y, then z (rad).
    pub rotation: Option<Located<Fixed<Quantity<Heading>, 3>>>,
}
