//! The keys of a scene file and of a material file, as they may be written.
//!
//! These types say what is a key and what is not; [`super::check`] says what makes sense. Their
//! comments are the descriptions of the JSON Schema.

mod bodies;
mod cell;
mod errors;
mod limits;
mod mold;
mod pick_up;
mod plan;
mod release;
mod robot;
mod sheet;
mod target;
mod tool;

pub(super) use bodies::{BodyTable, BoxTable, CylinderTable, MountKey, ObstacleTable};
pub(super) use cell::{CellFile, CellTable};
pub(super) use errors::{ErrorsTable, MoldErrorsTable, ShareTable, Term};
pub(super) use limits::LimitsTable;
pub(super) use mold::{MoldKind, MoldTable, SideKey};
pub(super) use pick_up::PickUpTable;
pub(super) use plan::{MethodKey, PlanTable};
pub(super) use release::{OrderKey, ReleaseTable};
pub(super) use robot::{DhTable, RobotTable};
pub(super) use sheet::{LipTable, MountTable, SheetTable, TensionTable, TimeKey};
pub(super) use target::{EdgesKey, GeneratorsKey, TargetTable};
pub(super) use tool::{AxisKey, AxisTable, JointsKey, PlacedTable, ToolTable};

use super::choice::{
    Curve, FrictionChoice, HoleChoice, MaterialChoice, OutlineChoice, PlaceChoice, Polygon,
    Positions, WarpChoice,
};
use super::located::{Count, Fixed, Located};
use super::quantity::{Mass, Quantity, Ratio, written};
use super::usual::{
    AcuteAngle, AnyAngle, Axial, Bending, Cell, Drawn, Duration, FabricPoint, Factor, Flexural,
    Gravity, Heading, Height, Hole, Moment, Overhang, Pad, PadForce, Place, PlyCurvature, PlySize,
    PlyTemperature, Relaxation, Share, Shear, ShearForce, ShearRate, Spacing, Tack, Tension,
    Thickness, Tolerance,
};
use crate::scene::{dxf, motion};
use plydrape::layup::{ContactSettings, Model, PadSettings, Settings, SheetSettings};
use schemars::JsonSchema;
use serde::Deserialize;
use std::ops::Range;

/// A scene of plydrape: a ply, the grippers that hold it, the mold, and where all of it goes.
/// Plain numbers are in SI units; a string carries a unit, as in "98 mm".
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(title = "plydrape scene", rename = "Scene")]
pub(super) struct SceneKeys {
    /// Name for reports; the file's name unless given.
    pub title: Option<Located<String>>,
    /// What hangs between the grippers.
    pub ply: Located<PlyTable>,
    /// What the ply is laid on. Without it the ply just hangs.
    pub mold: Option<Located<MoldTable>>,
    /// Where the grippers start.
    pub grippers: Option<Located<GrippersTable>>,
    /// Where the ply shall end.
    pub target: Option<Located<TargetTable>>,
    /// How the grippers move.
    pub motion: Option<Located<MotionTable>>,
    /// Rules of the model.
    #[serde(default)]
    pub model: ModelTable,
    /// How the ply is divided and followed as a sheet.
    #[serde(default)]
    pub sheet: SheetTable,
    /// How contact between ply and mold is found.
    #[serde(default)]
    pub contact: ContactTable,
    /// What moves with grippers and robot.
    #[serde(default)]
    pub bodies: Vec<Located<BodyTable>>,
    /// What stands in the cell.
    #[serde(default)]
    pub obstacles: Vec<Located<ObstacleTable>>,
    /// What an accepted drape keeps to.
    #[serde(default)]
    pub limits: LimitsTable,
    /// How `plydrape plan` looks for the motion.
    #[serde(default)]
    pub plan: PlanTable,
    /// Which cell holds the ply and how far it may be off, where [grippers] and [errors] do not say so.
    pub cell: Option<Located<CellTable>>,
    /// How far a real cell may be from this scene.
    pub errors: Option<ErrorsTable>,
    /// How a robot carries the grippers; each moves by itself unless given.
    pub tool: Option<ToolTable>,
    /// The arm that carries them.
    pub robot: Option<Located<RobotTable>>,
    /// How the ply is picked up from a table, and how grippers come and leave. Without it a motion begins with a ply in the air.
    pub pick_up: Option<Located<PickUpTable>>,
    /// When the pads let go of the ply. Without it they hold it to the end.
    pub release: Option<Located<ReleaseTable>>,
}

impl SceneKeys {
    /// Where the scene says how many grippers there are.
    pub fn grippers_span(&self) -> &Range<usize> {
        let ply = &self.ply.value;
        let points = ply.points.as_ref().map(|points| &points.span);
        ply.grippers.as_ref().map(|grippers| &grippers.span).or(points).unwrap_or(&self.ply.span)
    }
}

/// What hangs between the grippers.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Ply")]
pub(super) struct PlyTable {
    /// Number of grippers along u and along v; [n, 1] is a strip. Of a ply that is cut, the columns and rows of the array of
    /// cups.
    pub grippers: Option<Located<Fixed<Located<Count>, 2>>>,
    /// Fabric length between neighboring grippers along u and along v (m); of a ply that is cut, the pitch of the array.
    pub cell: Option<Fixed<Quantity<Cell>, 2>>,
    /// Boundary: points [x, y] of a drawing (m), or a DXF file. Unless given, the ply is the rectangle between its
    /// outermost grippers and its `overhang`.
    pub outline: Option<Located<OutlineChoice>>,
    /// Which piece of the drawing it is, where that has several, as a nest for a cutter has.
    pub piece: Option<Located<PieceTable>>,
    /// A rectangle from the drawing's origin (m), in place of an `outline`.
    pub size: Option<Located<Fixed<Quantity<PlySize>, 2>>>,
    /// Holes of the ply: each points [x, y] of the drawing (m), or a circle.
    pub holes: Option<Located<Vec<Located<HoleChoice>>>>,
    /// Where the array of cups picks up a ply that is cut, and which of its cups hold.
    pub array: Option<Located<ArrayTable>>,
    /// The cups that hold a ply that is cut, as points [x, y] of the drawing (m), in place of an array.
    pub points: Option<Located<Polygon>>,
    /// A shipped material by name, a .toml file relative to the scene, or a table.
    pub material: Located<MaterialChoice>,
    /// Temperature of the ply in the cell (K), of a material whose resin is known at several; the lowest of those unless given.
    pub temperature: Option<Quantity<PlyTemperature>>,
    /// The grid direction along which the warp runs. Of a ply that is cut, the angle from the drawing's x
    /// axis to the warp (rad), or "u" for its x axis and "v" for its y axis.
    #[schemars(extend("default" = "u"))]
    pub warp: Option<Located<WarpChoice>>,
    /// Fabric beyond the outermost grippers, on all sides (m). Catenaries end at the grippers: the
    /// sheet alone has it.
    #[schemars(extend("default" = written(SheetSettings::default().overhang, "mm")))]
    pub overhang: Option<Quantity<Overhang>>,
    /// Thickness of the ply once it lies (m). A plybook needs it where another ply lies on this one; nothing else uses it.
    pub thickness: Option<Quantity<Thickness>>,
}

/// A DXF file and what of it is the ply.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Drawing")]
pub(super) struct DrawingTable {
    /// The file, relative to the scene.
    pub file: Located<String>,
    /// The layers with boundary and holes. Unless given, the only visible layer with closed lines: where several have some, they
    /// must be named.
    pub layers: Option<Located<Vec<Located<String>>>>,
    /// The unit of its coordinates, as "mm"; that of the file unless given.
    pub unit: Option<Located<String>>,
    /// How far a curve may be from the lines that stand for it, and the widest gap between ends of lines that is closed (m).
    #[schemars(extend("default" = written(dxf::TOLERANCE, "mm")))]
    pub tolerance: Option<Quantity<Drawn>>,
}

/// A piece of a drawing, by one of its keys.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Piece")]
pub(super) struct PieceTable {
    /// The name of its block, in small or capital letters.
    pub block: Option<Located<String>>,
    /// A text inside it or in its block, in small or capital letters.
    pub label: Option<Located<String>>,
    /// A point [x, y] of the drawing inside it (m).
    pub point: Option<Located<Fixed<Quantity<FabricPoint>, 2>>>,
}

/// A round hole.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Circle")]
pub(super) struct CircleTable {
    /// Middle in the drawing (m).
    pub middle: Located<Fixed<Quantity<FabricPoint>, 2>>,
    /// Diameter (m).
    pub diameter: Quantity<Hole>,
}

/// Where an array of cups picks up a ply that is cut.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Array")]
pub(super) struct ArrayTable {
    /// The middle of the array in the drawing (m); the middle of the ply unless given, that of the box around the drawing.
    pub middle: Option<Located<Fixed<Quantity<FabricPoint>, 2>>>,
    /// Angle from the drawing's x axis to the rows of the array (rad), 0 unless given.
    pub direction: Option<Quantity<Heading>>,
    /// Fabric that there must be around the pad of a cup that holds (m), 0 unless given.
    pub margin: Option<Quantity<Overhang>>,
    /// Which cups hold: a text for each row along v, "#" for a cup that holds and "." for one that does not. All that are on
    /// the ply unless given.
    pub holds: Option<Located<Vec<Located<String>>>>,
    /// What becomes of a cup whose pad is only partly on the ply.
    #[schemars(extend("default" = "refuse"))]
    pub partly: Option<PartlyKey>,
}

/// What becomes of a cup whose pad is only partly on the ply.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Partly")]
pub(super) enum PartlyKey {
    /// The scene is refused.
    Refuse,
    /// It does not hold.
    LeaveOff,
}

/// A woven ply, by line as in Krogh et al. 2018 or by area.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Material")]
pub(super) struct MaterialTable {
    /// Name for reports.
    pub name: Option<Located<String>>,
    /// Where the numbers come from; a material file must have it.
    pub source: Option<Located<String>>,
    /// The tests that gave them, and of how many specimens.
    pub test: Option<Located<String>>,
    /// How much they scatter between specimens.
    pub scatter: Option<ScatterTable>,
    /// Mass per length (kg/m) or per area (kg/m²).
    pub mass: Quantity<Mass>,
    /// Flexural rigidity EI of a line of ply (N·m²); goes with a mass per length.
    pub flexural_rigidity: Option<Quantity<Flexural>>,
    /// Bending rigidity per width along the warp (N·m), or the moment over the curvature as a table; goes with a mass per
    /// area.
    pub bending_rigidity_warp: Option<Located<Curve<Bending, MomentTable>>>,
    /// Bending rigidity per width along the weft (N·m), or the moment over the curvature as a table; goes with a mass per
    /// area.
    pub bending_rigidity_weft: Option<Located<Curve<Bending, MomentTable>>>,
    /// Tension per width over the strain of the yarns: a stiffness (N/m) or a table. The sheet needs it.
    pub tension: Option<Located<Curve<Tension, TensionTable>>>,
    /// Picture-frame shear force per length over the shear angle: a slope (N/m per rad) or a table. The sheet needs it.
    pub shear_curve: Option<Located<Curve<Shear, ShearCurveTable>>>,
    /// What resin adds to the shear force while the ply is sheared. Only a sheet with `time = "real"` knows it.
    pub shear_rate: Option<Located<ShearRateTable>>,
    /// Shear angle at which the weave locks (rad).
    pub locking_angle: Option<Quantity<AcuteAngle>>,
    /// The test that found the locking angle.
    pub locking_test: Option<Located<String>>,
    /// How its fibers are held together. "unidirectional" is refused so far.
    #[schemars(extend("default" = "woven"))]
    pub fabric: Option<Located<FabricKey>>,
}

/// What resin adds to the shear force: a spring and a damper one after the other, beside the shear curve.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "ShearRate")]
pub(super) struct ShearRateTable {
    /// Stiffness against a shear that is much faster than the relaxation (N/m per rad).
    pub stiffness: Quantity<ShearRate>,
    /// Time in which the force falls to its 1/e-th part where the ply is at rest (s), or a table of such times over temperatures.
    pub relaxation: Located<Curve<Relaxation, RelaxationTable>>,
}

/// Relaxation times over temperatures; between them the law of Arrhenius holds.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Relaxation")]
pub(super) struct RelaxationTable {
    /// Temperatures, ascending (K).
    pub temperature: Located<Vec<Quantity<PlyTemperature>>>,
    /// Relaxation time at each temperature, falling (s).
    pub time: Located<Vec<Quantity<Relaxation>>>,
}

/// How the fibers of a ply are held together.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Fabric")]
pub(super) enum FabricKey {
    /// Two families of yarns that cross: it shears as a trellis.
    Woven,
    /// One family of fibers in a resin or a stitching: it shears along them.
    Unidirectional,
}

/// Measured points of a bending test, the same to either side.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Moment")]
pub(super) struct MomentTable {
    /// Curvatures, ascending from 0 (1/m).
    pub curvature: Located<Vec<Quantity<PlyCurvature>>>,
    /// Bending moment per width at each curvature, rising from 0 (N, that is N m per m). Its first slope is the rigidity at rest.
    pub moment: Located<Vec<Quantity<Moment>>>,
}

/// Standard deviation of measured properties between specimens, as a share of their value.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Scatter")]
pub(super) struct ScatterTable {
    /// Of the mass.
    pub mass: Option<Quantity<Share>>,
    /// Of the flexural rigidity of a line.
    pub flexural_rigidity: Option<Quantity<Share>>,
    /// Of the bending rigidity or moment along the warp.
    pub bending_rigidity_warp: Option<Quantity<Share>>,
    /// Of the bending rigidity or moment along the weft.
    pub bending_rigidity_weft: Option<Quantity<Share>>,
    /// Of the tension.
    pub tension: Option<Quantity<Share>>,
    /// Of the shear force: a share, or a table with a factor.
    pub shear_curve: Option<Located<Curve<Share, FactorTable>>>,
}

/// A value that is known within a factor.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Factor")]
pub(super) struct FactorTable {
    /// The factor f, 1 or more: from 1/f to f times the value, every logarithm in between as likely.
    pub factor: Quantity<Factor>,
}

/// Measured points (`angle` and `force`), or a `polynomial`.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "ShearCurve")]
pub(super) struct ShearCurveTable {
    /// Shear angles, ascending from 0 (rad).
    pub angle: Option<Located<Vec<Quantity<AnyAngle>>>>,
    /// Shear force per length at each angle, never falling (N/m).
    pub force: Option<Located<Vec<Quantity<ShearForce>>>>,
    /// Coefficients of γ, γ², … (N/m, γ in rad).
    pub polynomial: Option<Located<Vec<Quantity<Ratio>>>>,
}

/// Where the grippers start: a rectangle by `spacing` and `height`, or `positions`. Without any of these
/// they start level above the middle of the target, 98 % of the fabric apart, half a cell above its
/// highest point.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Grippers")]
pub(super) struct GrippersTable {
    /// Distance of neighbors along u and along v (m).
    pub spacing: Option<Fixed<Quantity<Spacing>, 2>>,
    /// Height z of all grippers; above the mold, with `parallel_to_mold` (m).
    pub height: Option<Quantity<Height>>,
    /// Place x, y of gripper g0_0 (m), the origin unless given; with `parallel_to_mold`, of the mold point
    /// below it. Or "centered": the rectangle's middle is above the middle of the target.
    pub origin: Option<Located<PlaceChoice>>,
    /// Place x, y of the middle of the ply (m), of one that is cut the middle of its drawing, instead of the `origin`: where the ply
    /// is picked up.
    pub middle: Option<Located<Fixed<Quantity<Place>, 2>>>,
    /// Heading at the start (rad), from x towards y, 0 unless given; that of the target where the origin is "centered". It is
    /// that of u, or that of the warp where `warp` is an angle.
    pub direction: Option<Quantity<Heading>>,
    /// True turns the rectangle parallel to the mold, `height` along its normal.
    pub parallel_to_mold: Option<Located<bool>>,
    /// Every position: a table of rows along v of [x, y, z] along u, or a CSV file (i, j, x, y, z).
    pub positions: Option<Located<Positions>>,
    /// Limit of the ball joints: largest gripper tilt (rad), that of the cell or 40 deg unless given.
    pub max_tilt: Option<Quantity<AcuteAngle>>,
    /// Radius of the rigid pads that hold the sheet flat (m). A radius of 0 holds one point.
    #[schemars(extend("default" = written(PadSettings::default().radius, "mm")))]
    pub pad_radius: Option<Quantity<Pad>>,
    /// The soft lips of the cups; those of the cell or none unless given.
    pub lip: Option<Located<LipTable>>,
    /// How far the mounts of the pads yield; that of the cell or rigid unless given.
    pub stiffness: Option<Located<MountTable>>,
    /// Largest load along the ply that a pad holds before the fabric slides under it (N); that of the cell or any unless given.
    pub slip_force: Option<Quantity<PadForce>>,
    /// Largest load across the ply that a pad holds (N); that of the cell or any unless given.
    pub holding_force: Option<Quantity<PadForce>>,
}

/// How the grippers move. `plydrape plan` finds a motion of its own and takes only the start from here: the
/// first step of a file.
#[derive(Debug, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Motion")]
pub(super) struct MotionTable {
    /// Straight to the target, held still, or from a file.
    pub kind: MotionKind,
    /// Number of steps of a straight motion; step 1 is the start.
    #[schemars(extend("default" = motion::STEPS))]
    pub steps: Option<Located<Count>>,
    /// Time from the first to the last step of a straight motion (s), a second a step unless given. `plydrape plan`
    /// refuses it: what a plan keeps is the `duration` of [limits].
    pub duration: Option<Quantity<Duration>>,
    /// CSV file with columns t, gripper ("g2_0"), x, y, z, relative to the scene.
    pub file: Option<Located<String>>,
}

/// How the grippers move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub(super) enum MotionKind {
    /// From the start in straight lines to the target.
    Straight,
    /// One step, at the start.
    Hold,
    /// As the file says.
    File,
}

/// Which model drapes and decides, and its rules.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Model")]
pub(super) struct ModelTable {
    /// The whole ply as a sheet of cloth, or a net of catenaries.
    #[schemars(extend("default" = "sheet"))]
    pub kind: Option<Located<ModelKey>>,
    /// The other model, to be draped beside the one that decides; it is shown and judges nothing. Unless given, none.
    pub also: Option<Located<ModelKey>>,
    /// How shared slopes are found.
    #[schemars(extend("default" = "moment-balance"))]
    pub slopes: Option<Slopes>,
    /// How one span hangs. "exact" is refused so far: nets have the closed form of small sag, and
    /// `plydrape span --theory exact` solves one span.
    #[schemars(extend("default" = "small-sag"))]
    pub theory: Option<Located<TheoryKey>>,
    /// Axial stiffness EA of a line of ply (N), inf for an inextensible ply.
    #[schemars(extend("default" = written(Settings::default().axial_stiffness, "kN")))]
    pub axial_stiffness: Option<Quantity<Axial>>,
    /// Acceleration of gravity (m/s²).
    #[schemars(extend("default" = written(Settings::default().gravity, "m/s^2")))]
    pub gravity: Option<Quantity<Gravity>>,
}

/// The model of the ply.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Kind of model")]
pub(super) enum ModelKey {
    /// The whole ply, between and beyond the grippers.
    Sheet,
    /// Lines of ply between the grippers, as in Krogh et al. 2018.
    Catenaries,
}

impl From<ModelKey> for Model {
    fn from(key: ModelKey) -> Self {
        match key {
            ModelKey::Sheet => Model::Sheet,
            ModelKey::Catenaries => Model::Catenaries,
        }
    }
}

impl From<Model> for ModelKey {
    fn from(model: Model) -> Self {
        match model {
            Model::Sheet => ModelKey::Sheet,
            Model::Catenaries => ModelKey::Catenaries,
        }
    }
}

/// How one span hangs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[schemars(rename = "Theory")]
pub(super) enum TheoryKey {
    /// Small sag, in closed form, as in Krogh et al. 2018.
    SmallSag,
    /// The inextensible elastica.
    Exact,
}

/// How shared slopes are found.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Slopes {
    /// A ball joint passes no moment.
    MomentBalance,
    /// Smallest norm of the horizontal forces, as in Krogh et al. 2018.
    MinForce,
}

/// How contact between ply and mold is found.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
#[schemars(rename = "Contact")]
pub(super) struct ContactTable {
    /// Distance that counts as touching (m).
    #[schemars(extend("default" = written(ContactSettings::default().tolerance, "mm")))]
    pub tolerance: Option<Quantity<Tolerance>>,
    /// Once per step, or with steps cut so that none penetrates deeper than the tolerance.
    #[schemars(extend("default" = "cut"))]
    pub stepping: Option<SteppingKey>,
    /// Slope of a span where it leaves the mold.
    #[schemars(extend("default" = "free"))]
    pub end: Option<EndKey>,
    /// What holds the sheet along the mold: it sticks until it is lifted off, "stick-for-ever", or a coefficient of friction. Catenaries
    /// always stick.
    #[schemars(extend("default" = "stick"))]
    pub friction: Option<Located<FrictionChoice>>,
    /// Shear stress that the sheet's tack bears besides friction (Pa).
    #[schemars(extend("default" = written(ContactSettings::default().tack, "Pa")))]
    pub tack: Option<Quantity<Tack>>,
}

/// When contact is evaluated.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "Stepping")]
pub(super) enum SteppingKey {
    /// Once per step, as in Krogh et al. 2018.
    Once,
    /// A step that would carry a point deeper than the tolerance is halved until it does not.
    Cut,
}

/// Slope of a span where it leaves the mold.
#[derive(Debug, Clone, Copy, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
#[schemars(rename = "End")]
pub(super) enum EndKey {
    /// Free, as in Krogh et al. 2018.
    Free,
    /// The slope of the mold.
    Tangent,
}
