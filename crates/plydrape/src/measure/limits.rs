//! Limits of an accepted drape: a map from measures to bounds.

use super::{ByName, Name, Preset, Scope, Verdict, slack_of_angle};
use crate::layup::Layup;
use crate::motion::Bounds;

/// Relative difference that reading a number with a unit may leave: "95 %" is not 0.95 to the last digit.
const ROUNDING: f64 = 1e-12;

/// The limit of a measure unless a scene sets another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UsualLimit {
    /// The bound, in SI units.
    pub value: f64,
    /// Why it is that one.
    pub reason: &'static str,
}

impl UsualLimit {
    /// A bound (SI) and why it is that one.
    #[must_use]
    pub const fn new(value: f64, reason: &'static str) -> Option<Self> {
        Some(UsualLimit { value, reason })
    }
}

/// Limits of an accepted drape.
#[derive(Debug, Clone, PartialEq)]
pub struct Limits {
    /// The preset that the limits come from, but for those that the scene sets itself.
    pub preset: Option<Preset>,
    /// Bounds in SI units; a measure without one has no limit.
    pub(super) bounds: ByName<f64>,
    /// Box that the grippers can reach: [from, to] in x, y and z (m).
    pub workspace: Option<[[f64; 2]; 3]>,
    /// Factor by which the slip force and the holding force of a pad must exceed the loads on it.
    pub grip_safety: f64,
}

impl Limits {
    /// Safety of pads against slip and loss, unless a scene sets another: usual for vacuum cups that are moved slowly.
    pub const GRIP_SAFETY: f64 = 1.5;

    /// The limits of a layup unless a scene sets others, [`super::Measure::usual_limit`].
    #[must_use]
    pub fn usual(layup: &Layup) -> Self {
        let usual = |name: &Name| Some((*name, name.measure().usual_limit(layup)?.value));
        Limits {
            preset: None,
            bounds: Name::ALL.iter().filter_map(usual).collect(),
            workspace: None,
            grip_safety: Self::GRIP_SAFETY,
        }
    }

    /// The bound of a measure (SI); `None` if it has no limit.
    #[must_use]
    pub fn get(&self, name: Name) -> Option<f64> {
        self.bounds.get(name).copied()
    }

    /// The bound of a measure (SI) that must not exceed it, infinite if it has no limit.
    #[must_use]
    pub fn most(&self, name: Name) -> f64 {
        self.get(name).unwrap_or(f64::INFINITY)
    }

    /// The bound of a measure (SI) that must not fall below it, zero if it has no limit.
    #[must_use]
    pub fn least(&self, name: Name) -> f64 {
        self.get(name).unwrap_or(0.0)
    }

    /// The bounds that no gripper exceeds in a planned motion.
    #[must_use]
    pub fn motion_bounds(&self) -> Bounds {
        Bounds {
            speed: self.most(Name::Speed),
            acceleration: self.most(Name::Acceleration),
            jerk: self.most(Name::Jerk),
        }
    }

    /// The bounds that no gripper exceeds in the transport of a planned motion, if they are others.
    #[must_use]
    pub fn transport_bounds(&self) -> Option<Bounds> {
        let own = [Name::TransportSpeed, Name::TransportAcceleration, Name::TransportJerk]
            .map(|name| self.get(name));
        let [speed, acceleration, jerk] = own;
        let usual = self.motion_bounds();
        own.iter().any(Option::is_some).then(|| Bounds {
            speed: speed.unwrap_or(usual.speed),
            acceleration: acceleration.unwrap_or(usual.acceleration),
            jerk: jerk.unwrap_or(usual.jerk),
        })
    }

    /// Sets the bound of a measure (SI), or removes it. A slack angle bounds the slack ratio with it, which is the same slack.
    pub fn set(&mut self, name: Name, bound: Option<f64>) {
        if let (Name::SlackAngle, Some(angle)) = (name, bound) {
            self.bounds.set(Name::SlackRatio, Some(slack_of_angle(angle)));
        }
        self.bounds.set(name, bound);
    }

    /// These limits with another bound of a measure (SI).
    #[must_use]
    pub fn with(mut self, name: Name, bound: f64) -> Self {
        self.set(name, Some(bound));
        self
    }

    /// The limits of a layup on which there is no verdict among these, in the measure's own unit: limits of a motion in time, and limits that are
    /// neither usual nor of a preset, whether the layup has what they measure or not.
    #[must_use]
    pub fn unjudged(&self, layup: &Layup, verdicts: &[Verdict]) -> Vec<(Name, f64)> {
        let usual = Limits::usual(layup);
        let usual = match self.preset {
            Some(preset) => usual.with_preset(preset),
            None => usual,
        };
        let limit = |name: &Name| {
            let measure = name.measure();
            if verdicts.iter().any(|verdict| verdict.name == *name) {
                return None;
            }
            // a bound that was written with a unit is the usual one but for rounding
            let is_usual = |bound: f64| {
                usual
                    .get(*name)
                    .is_some_and(|usual| (bound - usual).abs() <= ROUNDING * usual.abs())
            };
            let set = self.get(*name).filter(|bound| !is_usual(*bound));
            let own = set.map(|bound| bound / measure.unit().si);
            let of_motion = || name.limit(layup, self).filter(|_| measure.scope() == Scope::Motion);
            Some((*name, own.or_else(of_motion)?))
        };
        Name::ALL.iter().filter_map(limit).collect()
    }

    /// Every bound (SI), in the order of [`Name::ALL`].
    pub fn iter(&self) -> impl Iterator<Item = (Name, f64)> {
        self.bounds.iter().map(|(name, bound)| (name, *bound))
    }

    /// These limits with those of a preset in place of what they had.
    #[must_use]
    pub fn with_preset(mut self, preset: Preset) -> Self {
        self.preset = Some(preset);
        for figure in preset.figures() {
            self.set(figure.name, Some(figure.value));
        }
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::sample;

    /// A bound that nobody can give a reason for is not set unless a scene sets it.
    #[test]
    fn every_usual_limit_has_a_reason() {
        let layup = sample::layup();
        let mut count = 0;
        for name in Name::ALL {
            let Some(UsualLimit { value, reason }) = name.measure().usual_limit(&layup) else {
                continue;
            };
            count += 1;
            assert!(value.is_finite() && value > 0.0, "{name:?} {value}");
            assert!(reason.split_whitespace().count() >= 3, "{name:?} {reason}");
            assert!(!reason.ends_with('.') && !reason.contains("  "), "{name:?} {reason}");
        }
        assert_eq!(Limits::usual(&layup).iter().count(), count);
    }

    /// A preset replaces what its source speaks of; the slack ratio follows the slack angle, which is the same slack.
    #[test]
    fn a_preset_sets_its_figures_and_nothing_else() {
        let before = Limits::usual(&sample::layup());
        for preset in Preset::ALL {
            let after = before.clone().with_preset(*preset);
            assert_eq!(after.preset, Some(*preset));
            for name in Name::ALL {
                let figure = match name {
                    Name::SlackRatio => preset.value(Name::SlackAngle).map(slack_of_angle),
                    name => preset.value(*name),
                };
                let expected = figure.or(before.get(*name));
                assert_eq!(after.get(*name), expected, "{preset:?} {name:?}");
            }
        }
    }

    /// A limit in the unit of its measure, where it applies: the contact tolerance of 0.2 mm, the forces of a pad by the safety, and none of the
    /// landing of grippers whose mounts give.
    #[test]
    fn a_limit_is_in_the_unit_of_its_measure_where_it_applies() {
        let mut layup = sample::layup();
        let limits = Limits::usual(&layup);
        let limit = |layup: &Layup, name: Name| name.limit(layup, &limits);
        assert_eq!(limit(&layup, Name::Penetration), Some(0.2));
        assert_eq!(limit(&layup, Name::LandingGripper), Some(0.5));
        assert_eq!(limit(&layup, Name::Slip), None);
        layup.settings.pad.slip_force = Some(9.0);
        layup.settings.pad.lateral_stiffness = Some(2e3);
        assert_eq!(limit(&layup, Name::Slip), Some(6.0));
        assert_eq!(limit(&layup, Name::LandingGripper), None);
        layup.mold = None;
        assert_eq!(limit(&layup, Name::Penetration), None);
    }

    #[cfg(feature = "serde")]
    /// Every limit, set to a number of its own, comes back from JSON as it was.
    #[test]
    fn limits_survive_json() {
        let mut limits = Limits::usual(&sample::layup()).with_preset(Preset::PlyAngle);
        limits.workspace = Some([[-1.0, 1.0], [0.0, 2.0], [0.1, 0.7]]);
        for (n, name) in Name::ALL.iter().enumerate().filter(|(n, _)| n % 3 > 0) {
            if name.measure().bound().is_some() {
                limits.set(*name, Some(0.1 * n as f64));
            }
        }
        let text = serde_json::to_string(&limits).unwrap();
        assert_eq!(serde_json::from_str::<Limits>(&text).unwrap(), limits, "{text}");
        for other in ["no_such_limit", "slip", "steps"] {
            let text = text.replacen('{', &format!("{{\"{other}\":1.0,"), 1);
            let error = serde_json::from_str::<Limits>(&text).unwrap_err().to_string();
            assert!(error.contains(other), "{error}");
        }
    }
}
