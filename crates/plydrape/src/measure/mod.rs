//! What is measured of a drape, section 13 of `docs/theory`: each measure is a type in a file of its own.
//!
//! A [`Measure`] says what it is called, in which unit, which way it is bounded ([`Sense`]), when it counts
//! ([`Scope`]), which limit of the scene bounds it, and how it is found on the ply of one step ([`State`]). Verdicts,
//! the search, tables, the page, CSV and Python take all of that from here; [`Name`] lists them.
//!
//! `state` holds what several measures share in one step, `verdict` turns values into verdicts, `record` is
//! what a result file keeps of them. `strength` is what published data say of an angle, for information.

mod found;
mod record;
#[cfg(feature = "serde")]
mod serial;
mod state;
mod strength;
mod tuning;
mod unit;
mod verdict;

pub(crate) use clearance::found as clearance_found;
pub(crate) use found::Most;
pub use found::{Found, Site};
pub use record::{ByName, Measures, Numbers, Worst};
pub use slack_angle::{angle_of_slack, slack_of_angle};
pub use state::State;
pub(crate) use state::{Before, since, window_of};
pub use strength::{Loss, Plane, Published};
pub(crate) use tilt_rate::fastest as fastest_tilt;
use tuning::TUNING;
pub use unit::Unit;
pub use verdict::Verdict;
pub(crate) use verdict::{Judge, last_numbers, worst_numbers};

use crate::scene::Scene;

/// Which way a limit bounds a measure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// No value above the limit is accepted.
    AtMost,
    /// No value below the limit is accepted.
    AtLeast,
}

impl Sense {
    /// Whether a value is worse than another. NaN is the worst of all, so that it is not lost.
    #[must_use]
    pub fn is_worse(self, value: f64, than: f64) -> bool {
        match self {
            _ if than.is_nan() => false,
            _ if value.is_nan() => true,
            Sense::AtMost => value > than,
            Sense::AtLeast => value < than,
        }
    }
}

/// When a measure counts for the verdict.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scope {
    /// In every step: the worst of all.
    EveryStep,
    /// At the end alone.
    End,
    /// Of the motion in time: it has no meaning where the steps have no times yet, as in a search.
    Time,
    /// Of a whole motion or plan, found outside the drape.
    Whole,
}

/// What a measure is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// The ply, as a model of it says.
    Ply,
    /// The motion of the grippers and its target, whichever model drapes.
    Motion,
}

/// What it is worth to stay below a limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Worth {
    /// Less is always better, because the measure describes the quality of the ply.
    Less,
    /// The limit is to be kept, and less has no worth, because the measure describes the capacity of a machine.
    Kept,
}

/// A measure's names, its unit, and how its limit counts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Description {
    /// Name of its limit in scenes and verdicts, `landing_shear`.
    pub name: &'static str,
    /// Its key among the measures of a step, the unit at its end where it has one, `landing_shear_deg`.
    pub key: &'static str,
    /// What it is called in tables and charts.
    pub label: &'static str,
    /// Unit of its values, and how they are shown.
    pub unit: Unit,
    /// Which way its limit bounds it.
    pub sense: Sense,
    /// When it counts.
    pub scope: Scope,
    /// What it is worth to stay below its limit.
    pub worth: Worth,
    /// Whether the model of the ply matters to it.
    pub subject: Subject,
}

impl Description {
    /// Of a measure that is bounded from above in every step, and of which less is better.
    const fn new(name: &'static str, key: &'static str, label: &'static str, unit: Unit) -> Self {
        let (sense, scope, worth) = (Sense::AtMost, Scope::EveryStep, Worth::Less);
        let subject = Subject::Ply;
        Description { name, key, label, unit, sense, scope, worth, subject }
    }
}

/// Something that is measured of a drape.
pub trait Measure: Sync {
    /// Its names, its unit, and how its limit counts.
    fn description(&self) -> Description;

    /// [`Description::name`].
    fn name(&self) -> &'static str {
        self.description().name
    }

    /// [`Description::key`].
    fn key(&self) -> &'static str {
        self.description().key
    }

    /// [`Description::label`].
    fn label(&self) -> &'static str {
        self.description().label
    }

    /// [`Description::unit`].
    fn unit(&self) -> Unit {
        self.description().unit
    }

    /// [`Description::sense`].
    fn sense(&self) -> Sense {
        self.description().sense
    }

    /// [`Description::scope`].
    fn scope(&self) -> Scope {
        self.description().scope
    }

    /// [`Description::worth`].
    fn worth(&self) -> Worth {
        self.description().worth
    }

    /// [`Description::subject`].
    fn subject(&self) -> Subject {
        self.description().subject
    }

    /// Whether its values may be below zero, as depths among distances.
    fn is_signed(&self) -> bool {
        false
    }

    /// Its limit in a scene, in its own unit; none where the scene sets none or it has no meaning there.
    fn limit(&self, _scene: &Scene) -> Option<f64> {
        None
    }

    /// Its worst value in the ply of one step and where that is; none where it has no meaning.
    fn evaluate(&self, _state: &State) -> Option<Found> {
        None
    }
}

/// Declares the measures: a file and a type each.
macro_rules! measures {
    ($($module:ident: $name:ident),* $(,)?) => {
        $(mod $module;)*

        /// Every measure, in the order in which tables show them.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub enum Name {
            $(
                #[doc = concat!("See `measure/", stringify!($module), ".rs`.")]
                $name,
            )*
        }

        impl Name {
            /// All of them, in order.
            pub const ALL: &[Name] = &[$(Name::$name),*];

            /// What it is.
            #[must_use]
            pub fn measure(self) -> &'static dyn Measure {
                match self {
                    $(Name::$name => &$module::$name,)*
                }
            }
        }
    };
}

measures! {
    overstretch: Overstretch,
    overstretch_length: OverstretchLength,
    strain: Strain,
    penetration: Penetration,
    tilt: Tilt,
    tilt_rate: TiltRate,
    shear: Shear,
    gripper_load: GripperLoad,
    gripper_pull: GripperPull,
    force: Force,
    workspace: Workspace,
    slack: Slack,
    slack_ratio: SlackRatio,
    slack_angle: SlackAngle,
    wrinkle: Wrinkle,
    wrinkle_angle: WrinkleAngle,
    diagonal_slack: DiagonalSlack,
    bridging: Bridging,
    landing_error: LandingError,
    landing_contact: LandingContact,
    landing_gripper: LandingGripper,
    landing_shear: LandingShear,
    fibre_angle: FibreAngle,
    gap: Gap,
    sag_ratio: SagRatio,
    slope: Slope,
    contact_share: ContactShare,
    gripper_distance: GripperDistance,
    clearance: Clearance,
    equilibrium: Equilibrium,
    duration: Duration,
    speed: Speed,
    acceleration: Acceleration,
    jerk: Jerk,
    tool_turn_rate: ToolTurnRate,
    tool_turn_acceleration: ToolTurnAcceleration,
    axis_speed: AxisSpeed,
    tool_residual: ToolResidual,
    missing_nodes: MissingNodes,
    off_mold: OffMold,
    move_limit: MoveLimit,
    steps: Steps,
    height: Height,
    out_of_plane: OutOfPlane,
    position: Position,
    gripper_force: GripperForce,
    slip: Slip,
    slip_length: SlipLength,
    holding: Holding,
}

impl Name {
    /// Its name as tables have it, `landing shear`: that of files in words, in their spelling.
    #[must_use]
    pub fn title(self) -> String {
        self.measure().name().replace('_', " ").replace("fibre", "fiber")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file is read by these names: no two measures share one.
    #[test]
    fn every_measure_has_a_name_and_a_key_of_its_own() {
        for (n, a) in Name::ALL.iter().enumerate() {
            for b in &Name::ALL[..n] {
                assert_ne!(a.measure().name(), b.measure().name());
                assert_ne!(a.measure().key(), b.measure().key());
            }
        }
    }
}
