//! How fast a ply whose shear takes time may be draped along a motion, and how cold it may be.
//!
//! A ply whose resin relaxes this many times as slowly is to a motion what a motion that is this many times as fast is to the ply itself, but
//! for inertia. So the times of the motion stay as they are, every drape costs alike, and the answer is one of speed and of temperature.

use super::Watch;
use super::sample::draped;
use crate::layup::{Layup, Model, SheetTime};
use crate::material::ShearRate;
use crate::scene::Scene;

/// Multiples of the speed are tried from 2 to the minus sixth power to 2 to the sixth one.
const OCTAVES: i32 = 6;
/// 0 °C (K).
const FREEZING: f64 = 273.15;

/// How fast a ply whose shear takes time may be draped along a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct RateTolerance {
    /// The largest multiple of the motion's speed, a power of 2, up to which every limit of the ply is kept; `None` if not even at the least
    /// one that was tried.
    pub speed: Option<f64>,
    /// The lowest temperature of the ply at which the same is kept at the motion's own speed (°C); `None` where that is not among those at
    /// which its relaxation is known.
    pub temperature: Option<f64>,
}

impl RateTolerance {
    /// The largest multiple of the speed that is tried; the least is its inverse.
    pub const MOST: f64 = (1 << OCTAVES) as f64;

    /// How resin resists the shear of a layup by the model that decides; `None` where time does not matter to it.
    #[must_use]
    pub fn applies_to(layup: &Layup) -> Option<&ShearRate> {
        let settings = &layup.settings;
        let is_real = settings.model == Model::Sheet && settings.sheet.time == SheetTime::Real;
        layup.ply.material.shear_rate.as_ref().filter(|_| is_real)
    }

    /// How fast the ply of a scene may be draped along its motion, of which is known whether it is accepted as it is; `None` if it was
    /// stopped, or time does not matter.
    #[must_use]
    pub fn new(scene: &Scene, is_accepted: bool, watch: &Watch) -> Option<Self> {
        let rate = Self::applies_to(&scene.layup)?;
        let keeps = |octave: i32| {
            let mut other = Scene { errors: None, ..scene.clone() };
            other.layup.ply.material.shear_rate = Some(rate.slower(f64::from(octave).exp2()));
            Some(draped(&other, None, watch.stop)?.judged.accepted())
        };
        let mut fastest = is_accepted.then_some(0);
        for n in 1..=OCTAVES {
            let octave = if is_accepted { n } else { -n };
            let kept = keeps(octave)?;
            if kept {
                fastest = Some(octave);
            }
            if kept != is_accepted {
                break;
            }
        }
        let speed = fastest.map(|octave| f64::from(octave).exp2());
        let temperature = speed.and_then(|speed| {
            let coldest = rate.relaxation.temperature_of(speed * rate.time());
            coldest.map(|kelvin| kelvin - FREEZING)
        });
        Some(RateTolerance { speed, temperature })
    }
}
