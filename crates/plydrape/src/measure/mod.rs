//! What is measured of a drape, section 13 of `docs/theory`: each measure is a type in a file of its own.
//!
//! A [`Measure`] says what it is called, in which unit, which way it is bounded ([`Sense`]), when it counts ([`Scope`]), its limit unless a
//! scene sets another, with the reason, and how it is found on the ply of one step ([`Observation`]) or on a whole motion
//! ([`WholeMotion`]). It does not know which model drapes: a measure that a model cannot evaluate is `None` there and not in its verdict.
//! Limits ([`Limits`]), verdicts, the search, tables, the page, CSV and Python take all of that from here; [`Name`] lists the measures. So
//! a new measure is one new file and its line in that list.
//!
//! 1. `observation`: what a measure sees of one step; `whole`: what it sees of a motion in time;
//! 2. `limits`, `preset`: the limits of a scene, and named sets of them;
//! 3. `judge`, `verdict`: values that become verdicts;
//! 4. `record`: what a result file keeps of measures.

mod acceleration;
mod arm_miss;
mod arm_singularity;
mod axis_speed;
mod bound;
mod bridging;
mod clearance;
mod contact_share;
mod diagonal_slack;
mod duration;
mod equilibrium;
mod fiber_angle;
mod force;
mod found;
mod gap;
mod gripper_distance;
mod gripper_force;
mod gripper_load;
mod gripper_pull;
mod height;
mod holding;
mod jerk;
mod joint_acceleration;
mod joint_margin;
mod joint_speed;
mod judge;
mod landing_error;
mod landing_gripper;
mod landing_shear;
mod limits;
mod missing_nodes;
mod move_limit;
mod observation;
mod off_mold;
mod out_of_plane;
mod overstretch;
mod overstretch_length;
mod penetration;
mod position;
mod preset;
mod record;
mod sag_ratio;
#[cfg(test)]
pub(crate) mod sample;
mod sensitivity;
#[cfg(feature = "serde")]
mod serial;
mod shear;
mod slack;
mod slack_angle;
mod slack_ratio;
mod slip;
mod slip_length;
mod slope;
mod speed;
mod steps;
mod strain;
mod table_gap;
mod tilt;
pub(crate) mod tilt_rate;
mod tool_residual;
mod tool_turn_acceleration;
mod tool_turn_rate;
mod transport_acceleration;
mod transport_jerk;
mod transport_speed;
mod tuning;
mod unit;
mod verdict;
mod whole;
mod workspace;
mod wrinkle;
mod wrinkle_angle;

pub use bound::{Bound, Practice, Range, Refusal, Usual};
pub(crate) use clearance::found as clearance_found;
pub use found::Found;
pub(crate) use found::Most;
pub(crate) use gripper_distance::closest_grippers;
pub use judge::{Judge, WorstSoFar};
pub(crate) use judge::{last_numbers, worst_numbers};
pub use limits::{Limits, UsualLimit};
pub use observation::{Observation, Past};
pub use preset::{Figure, Preset};
pub use record::{ByName, Measures, Numbers, Worst};
pub use slack_angle::{angle_of_slack, slack_of_angle};
use tuning::TUNING;
use unit::DEGREE;
pub use unit::Unit;
pub use verdict::Verdict;
pub(crate) use whole::verdicts_of_steps;
pub use whole::{Course, MotionPeaks, WholeMotion};
pub(crate) use workspace::outside_workspace;

use crate::layup::{Layup, Model};

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

    /// Whether a value keeps a limit, but for rounding. A value that is not finite keeps none.
    #[must_use]
    pub fn keeps(self, value: f64, limit: f64) -> bool {
        value.is_finite()
            && match self {
                Sense::AtMost => value <= limit * (1.0 + TUNING.limit_rounding),
                Sense::AtLeast => value >= limit * (1.0 - TUNING.limit_rounding),
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
    /// In every step of a motion in time: it has no meaning where the steps have no times yet, as in a search.
    Time,
    /// Over a motion in time alone, whatever the ply does: every motion is judged by it, be it given or planned.
    Motion,
    /// Over a whole drape or plan, found outside of its steps.
    Whole,
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
    /// Key among the measures of a step, the unit at its end where it has one, `landing_shear_deg`.
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
    /// The only model that can evaluate it; `None` if both can.
    pub model: Option<Model>,
}

impl Description {
    /// A description of a measure that is bounded from above in every step, and of which less is better.
    const fn new(name: &'static str, key: &'static str, label: &'static str, unit: Unit) -> Self {
        let (sense, scope, worth) = (Sense::AtMost, Scope::EveryStep, Worth::Less);
        Description { name, key, label, unit, sense, scope, worth, model: None }
    }

    /// As [`Description::new`], of what catenaries alone follow.
    const fn of_catenaries(
        name: &'static str,
        key: &'static str,
        label: &'static str,
        unit: Unit,
    ) -> Self {
        Description { model: Some(Model::Catenaries), ..Self::new(name, key, label, unit) }
    }

    /// As [`Description::new`], of what the sheet alone follows.
    const fn of_sheet(
        name: &'static str,
        key: &'static str,
        label: &'static str,
        unit: Unit,
    ) -> Self {
        Description { model: Some(Model::Sheet), ..Self::new(name, key, label, unit) }
    }
}

/// Something that is measured of a drape.
pub trait Measure: Sync {
    /// Names, unit, and how its limit counts.
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

    /// Whether its values may be below zero, as depths among distances.
    fn is_signed(&self) -> bool {
        false
    }

    /// How a scene may bound it; `None` if it may not, because the limit follows from pads, tool or workspace, or is that there is no such
    /// case, or because the measure only describes.
    fn bound(&self) -> Option<Bound> {
        None
    }

    /// The limit in a layup unless a scene sets another; `None` if there is no limit unless a scene sets one.
    fn usual_limit(&self, _layup: &Layup) -> Option<UsualLimit> {
        match self.bound()?.usual {
            Usual::Always(limit) => Some(limit),
            Usual::OfLayup(_) | Usual::Never => None,
        }
    }

    /// Why no scene of this layup may bound it; `None` if it may.
    fn refusal(&self, _layup: &Layup) -> Option<Refusal> {
        None
    }

    /// Whether the measure is judged in a layup, if it has a limit.
    fn applies(&self, _layup: &Layup) -> bool {
        true
    }

    /// The limit that follows from pads, tool, workspace or another limit, in the measure's own unit; `None` if none does.
    fn derived_limit(&self, _layup: &Layup, _limits: &Limits) -> Option<f64> {
        None
    }

    /// The worst value in the ply of one step and where that is; `None` if the model of the ply cannot evaluate it, or it has no meaning
    /// there.
    fn evaluate(&self, _seen: &Observation) -> Option<Found> {
        None
    }

    /// The worst value of a whole motion in time, where it is and its time (s); `None` if it is not of a motion.
    fn evaluate_motion(&self, _motion: &WholeMotion) -> Option<(Found, Option<f64>)> {
        None
    }
}

/// Declares the measures: a file and a type each.
macro_rules! measures {
    ($($module:ident: $name:ident),* $(,)?) => {
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
    landing_gripper: LandingGripper,
    landing_shear: LandingShear,
    fiber_angle: FiberAngle,
    gap: Gap,
    sag_ratio: SagRatio,
    slope: Slope,
    contact_share: ContactShare,
    gripper_distance: GripperDistance,
    clearance: Clearance,
    table_gap: TableGap,
    equilibrium: Equilibrium,
    duration: Duration,
    speed: Speed,
    acceleration: Acceleration,
    jerk: Jerk,
    transport_speed: TransportSpeed,
    transport_acceleration: TransportAcceleration,
    transport_jerk: TransportJerk,
    tool_turn_rate: ToolTurnRate,
    tool_turn_acceleration: ToolTurnAcceleration,
    axis_speed: AxisSpeed,
    arm_miss: ArmMiss,
    joint_speed: JointSpeed,
    joint_acceleration: JointAcceleration,
    joint_margin: JointMargin,
    arm_singularity: ArmSingularity,
    tool_residual: ToolResidual,
    missing_nodes: MissingNodes,
    off_mold: OffMold,
    move_limit: MoveLimit,
    steps: Steps,
    height: Height,
    sensitivity: Sensitivity,
    out_of_plane: OutOfPlane,
    position: Position,
    gripper_force: GripperForce,
    slip: Slip,
    slip_length: SlipLength,
    holding: Holding,
}

impl Name {
    /// The measures that a scene may bound, and how.
    pub fn bounded() -> impl Iterator<Item = (Name, Bound)> {
        Name::ALL.iter().filter_map(|name| Some((*name, name.measure().bound()?)))
    }

    /// The limit that applies to a layup, in the measure's own unit; `None` if none does.
    #[must_use]
    pub fn limit(self, layup: &Layup, limits: &Limits) -> Option<f64> {
        let measure = self.measure();
        let own = || limits.get(self).filter(|_| measure.applies(layup));
        let derived = measure.derived_limit(layup, limits);
        derived.or_else(|| own().map(|own| own / measure.unit().si))
    }

    /// The measure that had a name before version 0.1.0; such names are read until version 0.2.0.
    #[must_use]
    pub fn renamed(old: &str) -> Option<Name> {
        (old == "fibre_angle").then_some(Name::FiberAngle)
    }

    /// The name in tables, as `landing shear`.
    #[must_use]
    pub fn title(self) -> String {
        self.measure().name().replace('_', " ")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::state::PlyState;

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

    /// The values of a state after another of the same layup.
    fn values(layup: &Layup, before: &PlyState, state: &PlyState) -> Vec<(Name, Option<f64>)> {
        let limits = Limits::usual(layup);
        let past = Past::after(before, None, 2.0);
        let seen = Observation { layup, limits: &limits, state, past: Some(&past) };
        let value = |name: &Name| (*name, name.measure().evaluate(&seen).map(|found| found.value));
        Name::ALL.iter().map(value).collect()
    }

    fn value(values: &[(Name, Option<f64>)], name: Name) -> Option<f64> {
        values.iter().find(|(own, _)| *own == name).and_then(|(_, value)| *value)
    }

    /// What the models have in common is one measure: the same state has the same value, whichever of them says it. The values are those of
    /// the sample by hand; a pad turns by 0.1 rad in 1 s.
    #[test]
    fn shared_measures_do_not_know_the_model() {
        let layup = sample::layup();
        let mut state = sample::state(&layup);
        let before = state.clone();
        state.time = 1.0;
        let (s, c) = 0.05_f64.sin_cos();
        state.grippers[1].quaternion = [0.0, s, 0.0, c];
        let catenaries = values(&layup, &before, &state);
        state.model = Model::Sheet;
        let sheet = values(&layup, &before, &state);
        for (name, expected) in [
            (Name::GripperLoad, 6.0),
            (Name::GripperPull, 5.0),
            (Name::Tilt, 0.1_f64.to_degrees()),
            (Name::TiltRate, 0.1_f64.to_degrees()),
            (Name::Shear, 0.2_f64.to_degrees()),
            (Name::Strain, 0.002),
            (Name::Penetration, 0.1),
            (Name::Position, 1.0),
        ] {
            let found = value(&catenaries, name).unwrap();
            assert!((found - expected).abs() < 1e-9, "{name:?} {found} {expected}");
            assert_eq!(value(&sheet, name), Some(found), "{name:?}");
        }
    }

    /// Slack 0.3 mm and overstretch 0.2 mm of an edge of 200 mm, of which 40 mm lie.
    #[test]
    fn segments_of_an_edge_add_up() {
        let layup = sample::layup();
        let state = sample::state(&layup);
        let found = values(&layup, &state, &state);
        for (name, expected) in [
            (Name::Slack, 0.3),
            (Name::SlackRatio, 0.3 / 200.0),
            (Name::OverstretchLength, 0.2),
            (Name::Overstretch, 0.2 / 200.0),
            (Name::ContactShare, 0.2),
            (Name::Bridging, 0.0),
            (Name::LandingShear, 0.0),
            (Name::Gap, 20.0),
            (Name::LandingGripper, 50.0),
            (Name::LandingError, 1.0),
        ] {
            let value = value(&found, name).unwrap();
            assert!((value - expected).abs() < 1e-9, "{name:?} {value} {expected}");
        }
    }

    /// A sheet follows no lines between grippers, and catenaries no surface: what is measured of those has no value there, and so no
    /// verdict.
    #[test]
    fn a_model_is_not_judged_by_what_it_does_not_follow() {
        let layup = sample::layup();
        let catenaries = sample::state(&layup);
        let mut sheet = PlyState { model: Model::Sheet, ..catenaries.clone() };
        sheet.lines.iter_mut().for_each(|line| line.catenary = None);
        for state in [&catenaries, &sheet] {
            let found = values(&layup, state, state);
            for name in Name::ALL {
                if name.measure().description().model == Some(state.model.other()) {
                    assert_eq!(value(&found, *name), None, "{name:?}");
                }
            }
            assert!(value(&found, Name::Strain).is_some());
        }
        assert_eq!(value(&values(&layup, &sheet, &sheet), Name::Height), Some(20.0));
        assert!(value(&values(&layup, &catenaries, &catenaries), Name::SlackRatio).is_some());
    }

    /// Nothing is asked of a pad that has let go, but where it is.
    #[test]
    fn a_released_gripper_has_no_load_and_no_tilt() {
        let mut layup = sample::layup();
        layup.settings.pad.slip_force = Some(10.0);
        layup.settings.pad.holding_force = Some(20.0);
        let mut state = PlyState { model: Model::Sheet, ..sample::state(&layup) };
        let asked = [
            Name::GripperLoad,
            Name::GripperPull,
            Name::GripperForce,
            Name::Slip,
            Name::Holding,
            Name::SlipLength,
            Name::Tilt,
            Name::TiltRate,
        ];
        let found = |state: &PlyState| {
            let values = values(&layup, state, state);
            asked.map(|name| value(&values, name))
        };
        assert!(found(&state).iter().all(Option::is_some));
        state.grippers[0].force = [30.0, 40.0, -60.0];
        state.grippers[0].holds = false;
        assert_eq!(found(&state)[..2], [Some(6.0), Some(5.0)]);
        state.grippers.iter_mut().for_each(|gripper| gripper.holds = false);
        assert_eq!(found(&state), [None; 8]);
        let distance = value(&values(&layup, &state, &state), Name::GripperDistance);
        assert!((distance.unwrap() - 100.0).abs() < 1e-9);
    }
}
