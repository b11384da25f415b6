//! Rules of the models of the ply that a scene may choose.

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
    /// The whole ply as cloth, `plydrape::sheet`.
    Sheet,
}

impl Model {
    /// The model that this one is not.
    #[must_use]
    pub fn other(self) -> Model {
        match self {
            Model::Catenaries => Model::Sheet,
            Model::Sheet => Model::Catenaries,
        }
    }
}

/// How the ply is divided and followed as a sheet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct SheetSettings {
    /// Largest distance between neighboring lines of nodes (m); `None` for a tenth of the shorter side of a cell.
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
    /// Radius of the rigid pad that holds the fabric flat (m); zero holds one point.
    pub radius: f64,
    /// The soft lip around the point or the rigid pad; `None` without one.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub lip: Option<Lip>,
    /// Stiffness of the mount along the ply (N/m); `None` if rigid.
    pub lateral_stiffness: Option<f64>,
    /// Stiffness of the mount across the ply (N/m); `None` if rigid.
    pub axial_stiffness: Option<f64>,
    /// Largest load along the ply that a pad holds before the fabric slides under it (N); `None` if it never slides.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub slip_force: Option<f64>,
    /// Largest load across the ply that a pad holds (N); `None` if it holds any.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub holding_force: Option<f64>,
}

/// The lip of a vacuum cup: a soft disc that the vacuum joins to the fabric. Fabric under it bends with it, and shears as if it were free.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Lip {
    /// Radius (m).
    pub radius: f64,
    /// Flexural rigidity per width of the disc (N·m).
    pub rigidity: f64,
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
            lip: None,
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
