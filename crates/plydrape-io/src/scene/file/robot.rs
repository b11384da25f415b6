//! The keys of the table `[robot]`.

use crate::scene::located::{Fixed, Located};
use crate::scene::quantity::{Quantity, written};
use crate::scene::usual::{
    AnyAngle, Heading, JointAcceleration, JointAngle, JointRate, Place, Share,
};
use plydrape::arm::{LEAST_MARGIN, LEAST_SINGULAR};
use schemars::JsonSchema;
use serde::Deserialize;

/// The arm that carries the frame of [tool]: six turning joints. Its foot is at the origin of the robot's world, see `world` in [tool]. Without
/// this table nothing is known of the arm.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Robot")]
pub(in crate::scene) struct RobotTable {
    /// A shipped arm by its name, or a URDF file relative to the scene. Bodies of its links are judged as those of grippers are.
    pub arm: Option<Located<String>>,
    /// The joints from foot to flange as a table of Denavit and Hartenberg, in place of `arm`.
    pub dh: Option<Located<Fixed<DhTable, 6>>>,
    /// Name of the link at the foot of a URDF file; `base`, or the link that carries all others, unless given.
    pub foot: Option<Located<String>>,
    /// Name of the link at the flange of a URDF file; `tool0`, or the only link that carries none, unless given.
    pub flange: Option<Located<String>>,
    /// Whether the links of a URDF file are bodies.
    #[schemars(extend("default" = true))]
    pub bodies: Option<bool>,
    /// Angles of the joints (rad): the motion begins in the configuration nearest to them, and in the best one unless given.
    pub start: Option<Located<Fixed<Quantity<JointAngle>, 6>>>,
    /// Least distance of a joint from the ends of its range (rad).
    #[schemars(extend("default" = written(LEAST_MARGIN, "deg")))]
    pub joint_margin: Option<Quantity<AnyAngle>>,
    /// Least singular value of the flange's motion by the joints, with lengths in units of the arm's reach.
    #[schemars(extend("default" = LEAST_SINGULAR))]
    pub singularity: Option<Quantity<Share>>,
    /// Largest angular acceleration of a joint (rad/s²); no limit unless given, because makers publish none.
    pub joint_acceleration: Option<Quantity<JointAcceleration>>,
}

/// A joint after Denavit and Hartenberg: a turn about z by its angle and `theta`, `d` along z, `a` along the new x, and a turn about that by `alpha`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Joint")]
pub(in crate::scene) struct DhTable {
    /// Distance along the new x (m), 0 unless given.
    pub a: Option<Quantity<Place>>,
    /// Turn about the new x (rad), 0 unless given.
    pub alpha: Option<Quantity<Heading>>,
    /// Distance along z (m), 0 unless given.
    pub d: Option<Quantity<Place>>,
    /// What is added to the joint's angle (rad), 0 unless given.
    pub theta: Option<Quantity<Heading>>,
    /// Smallest and largest angle (rad).
    pub range: Located<Fixed<Quantity<JointAngle>, 2>>,
    /// Largest angular speed (rad/s).
    pub speed: Quantity<JointRate>,
}
