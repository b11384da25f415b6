//! The messages as Rust types, with the same names and same order of fields as in their definitions (`messages.txt`).

use crate::write::csv::without_rounding;
use serde::Serialize;

/// `builtin_interfaces/msg/Time`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct Time {
    pub sec: i32,
    pub nanosec: u32,
}

/// `builtin_interfaces/msg/Duration`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct Duration {
    pub sec: i32,
    pub nanosec: u32,
}

/// `std_msgs/msg/Header`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Header {
    pub stamp: Time,
    pub frame_id: String,
}

/// `geometry_msgs/msg/Vector3`, and `Point`, which has the same fields.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct Vector3 {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

/// `geometry_msgs/msg/Quaternion`.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub(super) struct Quaternion {
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub w: f64,
}

/// `geometry_msgs/msg/Transform`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct Transform {
    pub translation: Vector3,
    pub rotation: Quaternion,
}

/// `geometry_msgs/msg/Pose`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct Pose {
    pub position: Vector3,
    pub orientation: Quaternion,
}

/// `geometry_msgs/msg/PoseStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct PoseStamped {
    pub header: Header,
    pub pose: Pose,
}

/// `nav_msgs/msg/Path`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Path {
    pub header: Header,
    pub poses: Vec<PoseStamped>,
}

/// `geometry_msgs/msg/TransformStamped`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct TransformStamped {
    pub header: Header,
    pub child_frame_id: String,
    pub transform: Transform,
}

/// `tf2_msgs/msg/TFMessage`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct TfMessage {
    pub transforms: Vec<TransformStamped>,
}

/// `control_msgs/msg/InterfaceValue`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct InterfaceValue {
    pub interface_names: Vec<String>,
    pub values: Vec<f64>,
}

/// `control_msgs/msg/DynamicInterfaceGroupValues`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct DynamicInterfaceGroupValues {
    pub header: Header,
    pub interface_groups: Vec<String>,
    pub interface_values: Vec<InterfaceValue>,
}

/// `trajectory_msgs/msg/JointTrajectory`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct JointTrajectory {
    pub header: Header,
    pub joint_names: Vec<String>,
    pub points: Vec<JointTrajectoryPoint>,
}

/// `trajectory_msgs/msg/JointTrajectoryPoint`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(super) struct JointTrajectoryPoint {
    pub positions: Vec<f64>,
    pub velocities: Vec<f64>,
    pub accelerations: Vec<f64>,
    pub effort: Vec<f64>,
    pub time_from_start: Duration,
}

/// `std_msgs/msg/ColorRGBA`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct ColorRgba {
    pub r: f32,
    pub g: f32,
    pub b: f32,
    pub a: f32,
}

/// `sensor_msgs/msg/CompressedImage`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct CompressedImage {
    pub header: Header,
    pub format: String,
    pub data: Vec<u8>,
}

/// `visualization_msgs/msg/UVCoordinate`.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
pub(super) struct UvCoordinate {
    pub u: f32,
    pub v: f32,
}

/// `visualization_msgs/msg/MeshFile`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct MeshFile {
    pub filename: String,
    pub data: Vec<u8>,
}

/// `visualization_msgs/msg/Marker`, of ROS 2 Humble and later.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct Marker {
    pub header: Header,
    pub ns: String,
    pub id: i32,
    pub r#type: i32,
    pub action: i32,
    pub pose: Pose,
    pub scale: Vector3,
    pub color: ColorRgba,
    pub lifetime: Duration,
    pub frame_locked: bool,
    pub points: Vec<Vector3>,
    pub colors: Vec<ColorRgba>,
    pub texture_resource: String,
    pub texture: CompressedImage,
    pub uv_coordinates: Vec<UvCoordinate>,
    pub text: String,
    pub mesh_resource: String,
    pub mesh_file: MeshFile,
    pub mesh_use_embedded_materials: bool,
}

/// `visualization_msgs/msg/MarkerArray`.
#[derive(Debug, Clone, Default, PartialEq, Serialize)]
pub(super) struct MarkerArray {
    pub markers: Vec<Marker>,
}

impl From<[f64; 3]> for Vector3 {
    fn from(vector: [f64; 3]) -> Self {
        let [x, y, z] = without_rounding(vector);
        Vector3 { x, y, z }
    }
}

impl From<[f64; 4]> for Quaternion {
    fn from(quaternion: [f64; 4]) -> Self {
        let [x, y, z, w] = without_rounding(quaternion);
        Quaternion { x, y, z, w }
    }
}

impl Default for Quaternion {
    /// No turn.
    fn default() -> Self {
        [0.0, 0.0, 0.0, 1.0].into()
    }
}
