//! Limits and whether they hold.

use super::{Name, Sense, TUNING, Worst};
use std::borrow::Cow;

/// A limit and whether it holds.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Verdict {
    /// What is limited; in a file its key in the scene.
    pub name: Name,
    /// Worst value, in the unit of the limit as reported.
    pub value: f64,
    /// The limit, in the same unit: the least or the most allowed, see [`super::Measure::sense`].
    pub limit: f64,
    /// Unit of both.
    pub unit: Cow<'static, str>,
    /// Whether it holds.
    pub ok: bool,
    /// Step of the worst value; `None` where it belongs to no step, as the speed of a motion.
    pub step: Option<usize>,
    /// Which part of the ply has the worst value.
    #[cfg_attr(feature = "serde", serde(rename = "where"))]
    pub at: String,
    /// Place of the worst value in space (m), where it has one.
    pub place: Option<[f64; 3]>,
    /// Whether it could be judged; if not, `at` says why, the value is none, and it does not hold.
    #[cfg_attr(feature = "serde", serde(default = "judged", skip_serializing_if = "Clone::clone"))]
    pub judged: bool,
}

#[cfg(feature = "serde")]
fn judged() -> bool {
    true
}

impl Verdict {
    /// The verdict on a value (in the measure's unit) against its limit (in the same).
    #[must_use]
    pub fn new(name: Name, worst: Worst, limit: f64, step: Option<usize>) -> Verdict {
        let (measure, Worst { value, at, place }) = (name.measure(), worst);
        let unit = measure.unit();
        let ok = measure.sense().keeps(value, limit);
        let [value, limit] = [value, limit].map(|value| value * unit.factor);
        Verdict { name, value, limit, unit: unit.shown.into(), ok, step, at, place, judged: true }
    }

    /// The verdict on a limit (in the measure's unit) that could not be judged, and why. It does not hold.
    #[must_use]
    pub fn unjudged(name: Name, limit: f64, why: &str) -> Verdict {
        let worst = Worst { value: 0.0, at: format!("not judged: {why}"), place: None };
        Verdict { ok: false, judged: false, ..Verdict::new(name, worst, limit, None) }
    }

    /// Whether its limit is the least that is allowed.
    #[must_use]
    pub fn is_least(&self) -> bool {
        self.name.measure().sense() == Sense::AtLeast
    }

    /// The value as a multiple of its limit: up to 1 it holds. Of a least one, what is missing to the whole if it is
    /// a share, else the limit as a multiple of the value; where that may be below zero, 1 and what is missing as a multiple of
    /// the limit, or in its unit where the limit is zero.
    #[must_use]
    pub fn ratio(&self) -> f64 {
        let Verdict { value, limit, .. } = *self;
        let measure = self.name.measure();
        let (whole, is_signed) = (measure.unit().factor, measure.is_signed());
        if !(value.is_finite() && self.judged) {
            return f64::INFINITY;
        }
        let ratio = match self.is_least() {
            // at the limit as large as, and as steep as, the ratio of what keeps it
            true if is_signed && value < limit && limit > 0.0 => 2.0 - value / limit,
            // of no limit there is no multiple
            true if is_signed && value < limit => 1.0 + limit - value,
            true if whole != 1.0 => (whole - value) / (whole - limit).max(1e-5 * whole),
            true => limit / value.max(f64::MIN_POSITIVE),
            false if limit > 0.0 => value / limit,
            false if value > 0.0 => 1.0 + value,
            false => 0.0,
        };
        if self.ok { ratio.min(1.0) } else { ratio.max(1.0 + TUNING.limit_rounding) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::Measures;

    fn verdict(name: Name, value: f64, limit: f64) -> Verdict {
        Verdict::new(name, Worst { value, at: String::new(), place: None }, limit, None)
    }

    /// Shares are shown in percent; a share of 95 % has used up half of the way from 100 % to a least share of 90 %.
    #[test]
    fn a_ratio_says_how_much_of_a_limit_is_used_up() {
        let share = verdict(Name::ContactShare, 0.95, 0.9);
        assert!(share.ok && (share.value - 95.0).abs() < 1e-12 && share.unit == "%");
        assert!((share.ratio() - 0.5).abs() < 1e-12);
        assert!((verdict(Name::GripperDistance, 60.0, 30.0).ratio() - 0.5).abs() < 1e-12);
        assert!((verdict(Name::Tilt, 10.0, 40.0).ratio() - 0.25).abs() < 1e-12);
        let workspace = verdict(Name::Workspace, 3.0, 0.0);
        assert!(!workspace.ok && workspace.ratio() == 4.0);
    }

    /// Of a clearance, which may be a depth, what is missing counts evenly: a search sees which of two plans through an obstacle is nearer
    /// to none. At the limit the ratio is as large and as steep from both sides.
    #[test]
    fn a_depth_has_a_ratio_too() {
        let ratio = |value: f64| verdict(Name::Clearance, value, 5.0).ratio();
        for (value, expected) in [(20.0, 0.25), (5.0, 1.0), (0.0, 2.0), (-5.0, 3.0), (-50.0, 12.0)]
        {
            assert!((ratio(value) - expected).abs() < 1e-12, "{value}: {}", ratio(value));
        }
        assert_eq!(verdict(Name::TableGap, -3.0, 0.0).ratio(), 4.0);
        let slope = |from: f64, to: f64| (ratio(to) - ratio(from)) / (to - from);
        assert!((slope(4.99, 5.0) - slope(5.0, 5.01)).abs() < 1e-3);
        assert!(!verdict(Name::Clearance, -1.0, 5.0).ok && verdict(Name::Clearance, 5.0, 5.0).ok);
    }

    /// NaN compares with no number, and an infinite value says that something overflowed: neither keeps a limit, whichever way it
    /// bounds, not even one that is infinite itself.
    #[test]
    fn a_value_that_is_not_finite_is_never_accepted() {
        for name in Name::ALL {
            for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
                for limit in [0.0, 1.0, f64::INFINITY] {
                    let verdict = verdict(*name, value, limit);
                    assert!(!verdict.ok, "{name:?} {value} {limit}");
                    assert!(verdict.ratio() > 1.0);
                }
            }
        }
    }

    /// Of several values NaN is the worst, wherever it is: else it would be lost among sound ones.
    #[test]
    fn a_value_that_is_no_number_is_not_lost() {
        for values in [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]] {
            let mut most = super::super::Most::default();
            for value in values {
                most.meet(value, crate::state::Site::AllEdges, [0.0; 3]);
            }
            assert!(most.found().unwrap().value.is_nan());
            for name in [Name::Overstretch, Name::GripperDistance] {
                let worst_of = |value| Worst { value, at: String::new(), place: None };
                let steps: Vec<Measures> =
                    values.iter().map(|v| [(name, worst_of(*v))].into_iter().collect()).collect();
                let worst = crate::measure::worst_numbers(steps.iter());
                assert!(worst.value(name).is_some_and(f64::is_nan), "{name:?}");
            }
        }
    }

    /// A value beyond its limit by rounding alone is within it, above and below.
    #[test]
    fn rounding_breaks_no_limit() {
        assert!(verdict(Name::Tilt, 40.0 * (1.0 + 1e-12), 40.0).ok);
        assert!(!verdict(Name::Tilt, 40.0 * (1.0 + 1e-6), 40.0).ok);
        assert!(verdict(Name::GripperDistance, 50.0 * (1.0 - 1e-12), 50.0).ok);
        assert!(!verdict(Name::GripperDistance, 50.0 * (1.0 - 1e-6), 50.0).ok);
    }
}
