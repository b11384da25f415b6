//! A scene: everything that one drape needs, as numbers in SI units.
//!
//! What reads a scene from a file, and refuses it with the place of a fault, is the crate `plydrape-io`.

use crate::clearance::Bodies;
use crate::errors::Errors;
use crate::mold::Mold;
use crate::net::Net;
use crate::ply::Ply;
use crate::preset::Preset;
use crate::tool::Tool;
use std::sync::Arc;

/// A scene: everything that one drape needs.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Name for reports.
    pub title: String,
    /// The ply between the grippers.
    pub ply: Ply,
    /// The mold; none for a ply that only hangs.
    pub mold: Option<Mold>,
    /// Where the grippers are in every step.
    pub motion: Motion,
    /// Where the ply should end, if it is to be draped.
    pub target: Option<Target>,
    /// Rules of the model.
    pub settings: Settings,
    /// Limits of an accepted drape.
    pub limits: Limits,
    /// What moves with grippers and robot, and what stands in the cell.
    pub bodies: Bodies,
    /// How a motion is planned, where none is followed.
    pub plan: Plan,
    /// How far a real cell may be from this scene, if that is known.
    pub errors: Option<Errors>,
    /// What carries the grippers; each moves by itself unless given.
    pub tool: Option<Tool>,
    /// When the pads let go of the ply; none if they hold it to the end.
    pub release: Option<Release>,
}

impl Scene {
    /// A ply along a motion by the rules of the model, with the usual limits and nothing else: no mold, no target, and grippers that each
    /// move by themselves.
    #[must_use]
    pub fn new(ply: Ply, settings: Settings, motion: Motion) -> Self {
        Scene {
            title: String::new(),
            limits: Limits::of(&ply, &settings),
            ply,
            mold: None,
            motion,
            target: None,
            settings,
            bodies: Bodies::default(),
            plan: Plan::default(),
            errors: None,
            tool: None,
            release: None,
        }
    }
}

/// When the pads let go of the ply.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Release {
    /// Which of them, and after what.
    pub order: ReleaseOrder,
    /// How long a pad presses before it lets go (s).
    pub dwell: f64,
    /// When each pad lets go (s), as an earlier drape along the same motion has found it: a robot does so at that time, wherever
    /// the ply is. None to find that out.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub times: Option<Arc<[f64]>>,
}

impl Release {
    /// In an order, after a dwell (s).
    #[must_use]
    pub fn new(order: ReleaseOrder, dwell: f64) -> Self {
        Release { order, dwell, times: None }
    }
}

/// The order in which pads let go of the ply.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ReleaseOrder {
    /// All at once, after the motion.
    End,
    /// Each when the ply around it lies, the others after the motion.
    Landed,
}

/// How gripper trajectories are planned.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Plan {
    /// The planner.
    pub method: PlanMethod,
    /// Steps of the planned motion, the start being the first; of the stepwise planner the most it may take.
    pub steps: usize,
    /// Farthest that a gripper may move in one step (m); the stepwise planner needs one and takes a share of
    /// its distance to go where there is none.
    pub move_limit: Option<f64>,
    /// Seed of the search.
    pub seed: u64,
    /// Most candidates that the search may drape. Those on which is decided are draped once more, in the time of their
    /// motion and where the sheet decides with the mesh of the scene.
    pub evaluations: usize,
    /// Whether the search goes on improving a plan that keeps every limit with a margin.
    pub improve: bool,
    /// Samples a second of the dense motion file (Hz).
    pub rate: f64,
}

impl Default for Plan {
    fn default() -> Self {
        let method = PlanMethod::Path;
        Plan {
            method,
            steps: 90,
            move_limit: None,
            seed: 0,
            evaluations: 100,
            improve: false,
            rate: 100.0,
        }
    }
}

/// The planner of a motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum PlanMethod {
    /// Whole trajectories, judged by complete drapes.
    Path,
    /// Step by step, as Krogh et al. 2018 sketch it.
    Stepwise,
}

/// Gripper positions over the steps.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Time of each step (s), ascending, from 0.
    pub times: Vec<f64>,
    /// Positions (m) of each step, in the order of [`crate::ply::Ply::index`].
    pub positions: Vec<Vec<[f64; 3]>>,
}

/// Where the ideal drape puts the grippers and the fabric.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Target {
    /// Final gripper positions (m), in the order of [`crate::ply::Ply::index`].
    pub grippers: Vec<[f64; 3]>,
    /// The ideal drape, of which the grippers are nodes; none where their positions were given.
    pub drape: Option<Arc<Net>>,
}

/// Rules of the model that a scene may choose.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Settings {
    /// How shared slopes are found.
    pub slopes: SlopeRule,
    /// Axial stiffness EA (N); infinite for an inextensible ply (written as null).
    #[cfg_attr(
        feature = "serde",
        serde(serialize_with = "infinite_as_null", deserialize_with = "null_as_infinite")
    )]
    pub axial_stiffness: f64,
    /// Acceleration of gravity g (m/s²).
    pub gravity: f64,
    /// Limit of the ball joints: largest gripper tilt (rad).
    pub max_tilt: f64,
    /// How contact is found.
    pub contact: ContactSettings,
    /// Which model drapes and decides.
    pub model: Model,
    /// How the ply is divided and followed as a sheet.
    pub sheet: SheetSettings,
    /// How each gripper holds the sheet.
    pub pad: PadSettings,
}

/// Of new scenes: moments are passed on at ball joints that tilt by 40° at most, EA = 100 kN, g = 9.81 m/s².
impl Default for Settings {
    fn default() -> Self {
        Settings {
            slopes: SlopeRule::MomentBalance,
            axial_stiffness: 1e5,
            gravity: 9.81,
            max_tilt: 40_f64.to_radians(),
            contact: ContactSettings::default(),
            model: Model::Sheet,
            sheet: SheetSettings::default(),
            pad: PadSettings::default(),
        }
    }
}

/// The model of the ply that drapes and decides.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Model {
    /// A net of catenaries, as in the paper.
    Catenaries,
    /// The whole ply as cloth, [`crate::sheet`].
    Sheet,
}

/// How the ply is divided and followed as a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SheetSettings {
    /// Largest distance between neighboring lines of nodes (m); none for a tenth of the shorter side of a cell.
    pub mesh: Option<f64>,
    /// Fabric beyond the outermost grippers, on all sides (m).
    pub overhang: f64,
    /// Which time the motion takes.
    pub time: SheetTime,
    /// Most states that are kept, the first and the last among them.
    pub keep: usize,
}

impl Default for SheetSettings {
    fn default() -> Self {
        SheetSettings { mesh: None, overhang: 0.0, time: SheetTime::QuasiStatic, keep: 100 }
    }
}

/// The time in which a sheet follows the motion of its grippers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SheetTime {
    /// Stretched until the ply's kinetic energy is of no matter.
    QuasiStatic,
    /// That of the motion.
    Real,
}

/// How each gripper holds the sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct PadSettings {
    /// Radius of the pad that holds the fabric flat (m); zero holds one point.
    pub radius: f64,
    /// Stiffness of the mount along the ply (N/m); none if rigid.
    pub lateral_stiffness: Option<f64>,
    /// Stiffness of the mount across the ply (N/m); none if rigid.
    pub axial_stiffness: Option<f64>,
    /// Largest load along the ply that a pad holds before the fabric slides under it (N); none if it never slides.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub slip_force: Option<f64>,
    /// Largest load across the ply that a pad holds (N); none if it holds any.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub holding_force: Option<f64>,
}

impl PadSettings {
    /// Whether its mount gives, along the ply or across it.
    #[must_use]
    pub fn gives(&self) -> bool {
        self.lateral_stiffness.is_some() || self.axial_stiffness.is_some()
    }
}

impl Default for PadSettings {
    fn default() -> Self {
        PadSettings {
            radius: 0.0,
            lateral_stiffness: None,
            axial_stiffness: None,
            slip_force: None,
            holding_force: None,
        }
    }
}

#[cfg(feature = "serde")]
/// An infinite value on purpose becomes null; any other number stays.
fn infinite_as_null<S: serde::Serializer>(value: &f64, to: S) -> Result<S::Ok, S::Error> {
    let finite = (*value != f64::INFINITY).then_some(*value);
    serde::Serialize::serialize(&finite, to)
}

#[cfg(feature = "serde")]
/// The inverse of [`infinite_as_null`].
fn null_as_infinite<'de, D: serde::Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(<Option<f64> as serde::Deserialize>::deserialize(from)?.unwrap_or(f64::INFINITY))
}

/// How shared slopes are found, eqs. (9) and (10) of `docs/theory/equilibrium.md`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SlopeRule {
    /// The paper's: smallest norm of the horizontal forces.
    MinForce,
    /// A ball joint passes no moment: EI z'' is continuous across each gripper.
    MomentBalance,
}

/// How contact between ply and mold is found.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct ContactSettings {
    /// Distance that counts as touching (m).
    pub tolerance: f64,
    /// Once per step, or with steps cut where the ply would penetrate the mold deeper than the tolerance.
    pub stepping: Stepping,
    /// Slope of a span where it leaves the mold.
    pub end: ContactEnd,
    /// What holds the sheet along the mold; catenaries always stick.
    pub friction: Friction,
    /// Shear stress τ₀ that the sheet's tack bears besides friction (Pa).
    pub tack: f64,
}

impl Default for ContactSettings {
    fn default() -> Self {
        ContactSettings {
            tolerance: 2e-4,
            stepping: Stepping::Cut,
            end: ContactEnd::Free,
            friction: Friction::Stick,
            tack: 0.0,
        }
    }
}

/// What holds the sheet along the mold where it touches.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Friction {
    /// A point stays where it touched until it is lifted off.
    Stick,
    /// A point stays where it touched for ever, and is not lifted off.
    StickForEver,
    /// Coulomb's law with this coefficient.
    Coulomb(f64),
}

/// When contact is evaluated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Stepping {
    /// Once per step, as in the paper.
    Once,
    /// A step that would move a point deeper than the tolerance is halved until it does not.
    Cut,
}

/// The slope of a span at the end of a contact segment.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ContactEnd {
    /// Free, as in the paper.
    Free,
    /// The slope of the mold.
    Tangent,
}

/// Limits of an accepted drape.
///
/// Overstretch, strain, penetration, tilt and its rate, shear, forces and loads are judged in every step of every
/// scene; slack, bridging, landing errors and contact share at the end of scenes with a [`Target`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Limits {
    /// The preset that they come from, but for those that the scene sets itself.
    pub preset: Option<Preset>,
    /// Slack of a catenary, all its free segments, as a share of its length.
    pub slack_ratio: f64,
    /// The same slack ε as a fiber angle 2√ε (rad).
    pub slack_angle: Option<f64>,
    /// Height of the ruck that the slack of a segment makes (m).
    pub wrinkle: Option<f64>,
    /// Bridging gap (m).
    pub bridging: f64,
    /// Chord beyond the free length, as a share of the whole edge.
    pub overstretch: f64,
    /// Distance of a contact point from its ideal place (m).
    pub landing_contact: f64,
    /// Distance of a gripper from its ideal place (m).
    pub landing_gripper: f64,
    /// Angle between landed edges and the fibers of the ideal drape (rad).
    pub fibre_angle: f64,
    /// Shear angle (rad): the scene's, else the material's locking angle, else 45 deg.
    pub shear: f64,
    /// Difference between a cell's shear at the end and when its diagonal landed (rad).
    pub landing_shear: f64,
    /// Strain of a free segment, of its own length.
    pub strain: f64,
    /// Depth of grippers and spans below the mold (m).
    pub penetration: f64,
    /// Gripper tilt (rad).
    pub tilt: f64,
    /// Angular rate of a gripper's ball joint (rad/s).
    pub tilt_rate: f64,
    /// Height of the sheet over the mold at the end (m).
    pub height: f64,
    /// Angle between the sheet's fibers and the mold at the end (rad).
    pub out_of_plane: f64,
    /// Distance of the sheet's landed points from their ideal places (m).
    pub position: f64,
    /// Force of the sheet on one gripper (N).
    pub gripper_force: Option<f64>,
    /// Horizontal force of a span (N).
    pub force: Option<f64>,
    /// Vertical load that one gripper holds (N).
    pub gripper_load: f64,
    /// Horizontal pull (pretension) at one gripper (N).
    pub gripper_pull: Option<f64>,
    /// By how much the slip force and the holding force of a pad must exceed its loads.
    #[cfg_attr(
        feature = "serde",
        serde(default = "usual_grip_safety", skip_serializing_if = "is_usual_grip_safety")
    )]
    pub grip_safety: f64,
    /// Share of the ply's edges that lies on the mold.
    pub contact_share: f64,
    /// Smallest distance between grippers (m).
    pub gripper_distance: f64,
    /// Smallest distance of the bodies of grippers and robot from mold, obstacles and each other (m).
    #[cfg_attr(
        feature = "serde",
        serde(default = "usual_clearance", skip_serializing_if = "is_usual_clearance")
    )]
    pub clearance: f64,
    /// Box that the grippers can reach: [from, to] in x, y and z (m).
    pub workspace: Option<[[f64; 2]; 3]>,
    /// Speed of a gripper (m/s), of planned motions.
    pub speed: f64,
    /// Acceleration of a gripper (m/s²), of planned motions.
    pub acceleration: f64,
    /// Jerk of a gripper (m/s³), of planned motions.
    pub jerk: f64,
    /// Longest time that a motion may take (s).
    pub duration: Option<f64>,
}

/// Safety of pads against slip and loss, unless a scene sets another: usual for vacuum cups that are moved slowly.
const GRIP_SAFETY: f64 = 1.5;

/// Clearance of bodies (m) unless a scene sets another: our assumption. It is to hold what a scene does not know, a fixture that is
/// placed by hand within 2 mm, hoses and heads of screws of 2 mm, and the error of the robot of less than 1 mm.
const CLEARANCE: f64 = 5e-3;

#[cfg(feature = "serde")]
fn usual_clearance() -> f64 {
    CLEARANCE
}

#[cfg(feature = "serde")]
/// The usual clearance is not written, so that files of scenes without bodies stay as they are.
fn is_usual_clearance(value: &f64) -> bool {
    *value == CLEARANCE
}

#[cfg(feature = "serde")]
fn usual_grip_safety() -> f64 {
    GRIP_SAFETY
}

#[cfg(feature = "serde")]
/// The usual safety is not written, so that files of scenes without pads' forces stay as they are.
fn is_usual_grip_safety(value: &f64) -> bool {
    *value == GRIP_SAFETY
}

impl Limits {
    /// The limits of a ply that a scene starts from; the tilt and the penetration that it allows are those of its
    /// settings.
    #[must_use]
    pub fn of(ply: &Ply, settings: &Settings) -> Self {
        Limits {
            preset: None,
            slack_ratio: 0.0005,
            slack_angle: None,
            wrinkle: None,
            bridging: 1e-3,
            overstretch: 0.001,
            landing_contact: 2e-3,
            landing_gripper: 5e-4,
            fibre_angle: 3_f64.to_radians(),
            shear: ply.material.locking_angle.unwrap_or(45_f64.to_radians()),
            landing_shear: 3_f64.to_radians(),
            strain: 0.005,
            penetration: settings.contact.tolerance,
            tilt: settings.max_tilt,
            // our assumption of a passive joint, from no data sheet
            tilt_rate: 90_f64.to_radians(),
            height: 5e-4,
            out_of_plane: 3_f64.to_radians(),
            position: 2e-3,
            gripper_force: None,
            force: None,
            // a vacuum cup of 30 mm holds more, and slips sideways at 4 to 10 N
            gripper_load: 10.0,
            gripper_pull: None,
            grip_safety: GRIP_SAFETY,
            contact_share: 0.95,
            gripper_distance: 0.5 * ply.cell[0].min(ply.cell[1]),
            clearance: CLEARANCE,
            workspace: None,
            speed: 0.25,
            acceleration: 1.0,
            jerk: 10.0,
            duration: None,
        }
    }
}
