//! Definitions of the messages, as a bag carries them: each followed by those it is made of.
//!
//! The definitions of `trajectory_msgs`, `nav_msgs`, `tf2_msgs`, `control_msgs`, `visualization_msgs` and what they need (Apache-2.0, Open
//! Robotics and others), without their comments; the same in ROS 2 Humble and later, but for that of `control_msgs`, which is
//! that of Jazzy and later.

/// A message's full name and definition.
#[derive(Debug, Clone, Copy)]
pub(super) struct Schema {
    pub name: &'static str,
    pub text: &'static str,
}

/// A definition that others are made of, behind the line that parts it from the one before.
macro_rules! part {
    (Header) => {
        "\
================================================================================
MSG: std_msgs/Header
builtin_interfaces/Time stamp
string frame_id
"
    };
    (Time) => {
        "\
================================================================================
MSG: builtin_interfaces/Time
int32 sec
uint32 nanosec
"
    };
    (Pose) => {
        "\
================================================================================
MSG: geometry_msgs/Pose
geometry_msgs/Point position
geometry_msgs/Quaternion orientation
"
    };
    (Point) => {
        "\
================================================================================
MSG: geometry_msgs/Point
float64 x
float64 y
float64 z
"
    };
    (Quaternion) => {
        "\
================================================================================
MSG: geometry_msgs/Quaternion
float64 x
float64 y
float64 z
float64 w
"
    };
    (PoseStamped) => {
        "\
================================================================================
MSG: geometry_msgs/PoseStamped
std_msgs/Header header
geometry_msgs/Pose pose
"
    };
    (TransformStamped) => {
        "\
================================================================================
MSG: geometry_msgs/TransformStamped
std_msgs/Header header
string child_frame_id
geometry_msgs/Transform transform
"
    };
    (Transform) => {
        "\
================================================================================
MSG: geometry_msgs/Transform
geometry_msgs/Vector3 translation
geometry_msgs/Quaternion rotation
"
    };
    (Vector3) => {
        "\
================================================================================
MSG: geometry_msgs/Vector3
float64 x
float64 y
float64 z
"
    };
    (InterfaceValue) => {
        "\
================================================================================
MSG: control_msgs/InterfaceValue
string[] interface_names
float64[] values
"
    };
    (JointTrajectoryPoint) => {
        "\
================================================================================
MSG: trajectory_msgs/JointTrajectoryPoint
float64[] positions
float64[] velocities
float64[] accelerations
float64[] effort
builtin_interfaces/Duration time_from_start
"
    };
    (Duration) => {
        "\
================================================================================
MSG: builtin_interfaces/Duration
int32 sec
uint32 nanosec
"
    };
    (Marker) => {
        "\
================================================================================
MSG: visualization_msgs/Marker
int32 ARROW=0
int32 CUBE=1
int32 SPHERE=2
int32 CYLINDER=3
int32 LINE_STRIP=4
int32 LINE_LIST=5
int32 CUBE_LIST=6
int32 SPHERE_LIST=7
int32 POINTS=8
int32 TEXT_VIEW_FACING=9
int32 MESH_RESOURCE=10
int32 TRIANGLE_LIST=11
int32 ADD=0
int32 MODIFY=0
int32 DELETE=2
int32 DELETEALL=3
std_msgs/Header header
string ns
int32 id
int32 type
int32 action
geometry_msgs/Pose pose
geometry_msgs/Vector3 scale
std_msgs/ColorRGBA color
builtin_interfaces/Duration lifetime
bool frame_locked
geometry_msgs/Point[] points
std_msgs/ColorRGBA[] colors
string texture_resource
sensor_msgs/CompressedImage texture
visualization_msgs/UVCoordinate[] uv_coordinates
string text
string mesh_resource
visualization_msgs/MeshFile mesh_file
bool mesh_use_embedded_materials
"
    };
    (ColorRGBA) => {
        "\
================================================================================
MSG: std_msgs/ColorRGBA
float32 r
float32 g
float32 b
float32 a
"
    };
    (CompressedImage) => {
        "\
================================================================================
MSG: sensor_msgs/CompressedImage
std_msgs/Header header
string format
uint8[] data
"
    };
    (UVCoordinate) => {
        "\
================================================================================
MSG: visualization_msgs/UVCoordinate
float32 u
float32 v
"
    };
    (MeshFile) => {
        "\
================================================================================
MSG: visualization_msgs/MeshFile
string filename
uint8[] data
"
    };
}

/// A pose with its time.
pub(super) const POSE: Schema = Schema {
    name: "geometry_msgs/msg/PoseStamped",
    text: concat!(
        "\
std_msgs/Header header
geometry_msgs/Pose pose
",
        part!(Header),
        part!(Time),
        part!(Pose),
        part!(Point),
        part!(Quaternion),
    ),
};

/// Poses one after the other.
pub(super) const PATH: Schema = Schema {
    name: "nav_msgs/msg/Path",
    text: concat!(
        "\
std_msgs/Header header
geometry_msgs/PoseStamped[] poses
",
        part!(Header),
        part!(Time),
        part!(PoseStamped),
        part!(Pose),
        part!(Point),
        part!(Quaternion),
    ),
};

/// Frames.
pub(super) const FRAMES: Schema = Schema {
    name: "tf2_msgs/msg/TFMessage",
    text: concat!(
        "\
geometry_msgs/TransformStamped[] transforms
",
        part!(TransformStamped),
        part!(Header),
        part!(Time),
        part!(Transform),
        part!(Vector3),
        part!(Quaternion),
    ),
};

/// Values of digital outputs.
pub(super) const OUTPUTS: Schema = Schema {
    name: "control_msgs/msg/DynamicInterfaceGroupValues",
    text: concat!(
        "\
std_msgs/Header header
string[] interface_groups
control_msgs/InterfaceValue[] interface_values
",
        part!(Header),
        part!(Time),
        part!(InterfaceValue),
    ),
};

/// Positions, velocities and efforts of joints.
pub(super) const JOINTS: Schema = Schema {
    name: "trajectory_msgs/msg/JointTrajectory",
    text: concat!(
        "\
std_msgs/Header header
string[] joint_names
trajectory_msgs/JointTrajectoryPoint[] points
",
        part!(Header),
        part!(Time),
        part!(JointTrajectoryPoint),
        part!(Duration),
    ),
};

/// Shapes to look at.
pub(super) const MARKERS: Schema = Schema {
    name: "visualization_msgs/msg/MarkerArray",
    text: concat!(
        "\
visualization_msgs/Marker[] markers
",
        part!(Marker),
        part!(Header),
        part!(Time),
        part!(Pose),
        part!(Point),
        part!(Quaternion),
        part!(Vector3),
        part!(ColorRGBA),
        part!(Duration),
        part!(CompressedImage),
        part!(UVCoordinate),
        part!(MeshFile),
    ),
};
