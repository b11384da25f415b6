//! The keys of the table `[limits]`.

use crate::scene::located::{Fixed, Located};
use crate::scene::quantity::{
    Acceleration, Angle, AngularRate, Force, Jerk, Length, Quantity, Ratio, Speed, Time,
};
use plydrape::preset::Preset;
use schemars::JsonSchema;
use serde::Deserialize;

/// What an accepted drape keeps to.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Limits")]
pub(in crate::scene) struct LimitsTable {
    /// A named set of limits, none unless given; the other keys here stand over it. `plydrape limits` lists them with
    /// the source of each figure.
    pub preset: Option<Located<PresetKey>>,
    /// Slack of a catenary, all its segments, as a share of its length, 0.0005 unless given.
    pub slack_ratio: Option<Quantity<Ratio>>,
    /// The same slack as a fiber angle (rad), 2√ε of the share ε; none unless given. Without a `slack_ratio` of its own
    /// the scene has the one of this angle.
    pub slack_angle: Option<Quantity<Angle>>,
    /// The slack of a segment as the height of the ruck that it makes (m); none unless given.
    pub wrinkle: Option<Quantity<Length>>,
    /// Bridging gap (m), 1 mm unless given.
    pub bridging: Option<Quantity<Length>>,
    /// Chord beyond the free length as a share of the edge, 0.001 unless given.
    pub overstretch: Option<Quantity<Ratio>>,
    /// Distance of a contact point from its ideal place (m), 2 mm unless given.
    pub landing_contact: Option<Quantity<Length>>,
    /// Distance of a gripper from its ideal place (m), 0.5 mm unless given.
    pub landing_gripper: Option<Quantity<Length>>,
    /// Angle between landed edges and the fibers of the ideal drape (rad), 3 deg unless given.
    pub fibre_angle: Option<Quantity<Angle>>,
    /// Shear angle (rad); the material's locking angle unless given, 45 deg where it has none.
    pub shear: Option<Quantity<Angle>>,
    /// Difference between a cell's shear at the end and when its diagonal landed (rad), 3 deg unless given.
    pub landing_shear: Option<Quantity<Angle>>,
    /// Strain of a free segment, of its own length, 0.005 unless given: what yarns bear.
    pub strain: Option<Quantity<Ratio>>,
    /// Depth of grippers and spans below the mold (m); the contact's `tolerance` unless given.
    pub penetration: Option<Quantity<Length>>,
    /// Gripper tilt (rad); the grippers' `max_tilt` unless given.
    pub tilt: Option<Quantity<Angle>>,
    /// Angular rate of a gripper's ball joint (rad/s), 90 deg/s unless given: assumed of a passive joint.
    pub tilt_rate: Option<Quantity<AngularRate>>,
    /// Height of the sheet over the mold at the end (m), 0.5 mm unless given.
    pub height: Option<Quantity<Length>>,
    /// Angle between the sheet's fibers and the mold at the end (rad), 3 deg unless given.
    pub out_of_plane: Option<Quantity<Angle>>,
    /// Distance of the sheet's landed points from their ideal places (m), 2 mm unless given.
    pub position: Option<Quantity<Length>>,
    /// Force of the sheet on one gripper (N); none unless given.
    pub gripper_force: Option<Quantity<Force>>,
    /// Horizontal force of a span (N); none unless given.
    pub force: Option<Quantity<Force>>,
    /// Vertical load that one gripper holds (N), 10 N unless given: a vacuum cup of 30 mm holds more.
    pub gripper_load: Option<Quantity<Force>>,
    /// Pull in the plane of the ply at one gripper (N); none unless given. A vacuum cup of 30 mm slips at 4 to 10 N.
    pub gripper_pull: Option<Quantity<Force>>,
    /// By how much the grippers' `slip_force` and `holding_force` must exceed the loads, 1.5 unless given.
    pub grip_safety: Option<Quantity<Ratio>>,
    /// Share of the ply's edges on the mold at the end, 0.95 unless given.
    pub contact_share: Option<Quantity<Ratio>>,
    /// Smallest distance between any two grippers (m), half the shorter side of a cell unless given.
    pub gripper_distance: Option<Quantity<Length>>,
    /// Smallest distance of the bodies of grippers and robot from mold, obstacles and each other (m), 5 mm unless given. It is
    /// judged where there are `bodies`.
    pub clearance: Option<Quantity<Length>>,
    /// Box that the grippers must stay in: [from, to] in x, y and z (m); none unless given.
    pub workspace: Option<Fixed<Fixed<Quantity<Length>, 2>, 3>>,
    /// Speed of a gripper (m/s), 0.25 unless given. It is kept by planned motions, as are the next two.
    pub speed: Option<Quantity<Speed>>,
    /// Acceleration of a gripper (m/s²), 1 unless given.
    pub acceleration: Option<Quantity<Acceleration>>,
    /// Jerk of a gripper (m/s³), 10 unless given.
    pub jerk: Option<Quantity<Jerk>>,
    /// Longest time that the motion may take (s), given or planned; none unless given.
    pub duration: Option<Quantity<Time>>,
}

/// A named set of limits.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Preset")]
pub(in crate::scene) enum PresetKey {
    /// Position 2 mm and fiber angle 3 deg, which the project DrapeBot gives for draping.
    #[serde(rename = "drapebot")]
    DrapeBot,
    /// Nothing higher over the mold than 0.5 mm.
    LowWrinkle,
    /// Angles of 3 deg in the plane of the ply and out of it.
    PlyAngle,
}

impl From<PresetKey> for Preset {
    fn from(key: PresetKey) -> Self {
        match key {
            PresetKey::DrapeBot => Preset::DrapeBot,
            PresetKey::LowWrinkle => Preset::LowWrinkle,
            PresetKey::PlyAngle => Preset::PlyAngle,
        }
    }
}
