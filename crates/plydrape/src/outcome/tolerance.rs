//! What a motion tolerates, in the engineer's units: errors of the grippers, and a ply that is stiffer in shear or heavier than
//! nominal, or less so.
//!
//! All of it is found by drapes along the same motion: errors of the grippers by cells in which nothing else is off, and the ply by complete
//! drapes in which one of its properties is a multiple of the nominal one.

use super::sample::draped;
use super::{Flight, Watch};
use crate::errors::{Errors, MaterialError, RelativeError, Term};
use crate::layup::{Layup, Model};
use crate::scene::Scene;
use crate::sheet;
use rayon::prelude::*;

/// Factors of the grippers' errors that are tried to each one of twice the size: what is found is known within 9 %.
const PER_OCTAVE: i32 = 8;
/// The least factor that is tried, and the most, in octaves: 1/64 and 16.
const OCTAVES: [i32; 2] = [-6, 4];
/// The first and the last place among the factors that are tried.
const PLACES: [i32; 2] = [OCTAVES[0] * PER_OCTAVE, OCTAVES[1] * PER_OCTAVE];
/// Drapes by which an error of the grippers is tried.
const TRIED: usize = 16;
/// Multiples of a property of the ply between which the largest one is found by halving, and their inverses.
const MULTIPLES: [f64; 6] = [1.25, 1.6, 2.0, 3.0, 5.0, 8.0];

/// What a motion tolerates.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Tolerance {
    /// The largest standard deviation of each gripper's position along each axis (mm) at which 95 % of 16 cells, which is all of them,
    /// keep every limit, found within 9 %; nothing else is off. 0 if they do not at the least one that was tried.
    pub gripper_mm: f64,
    /// Whether it is the largest one that was tried, so that the motion may tolerate more.
    pub gripper_at_least: bool,
    /// The least and the largest multiple of the ply's shear stiffness that were tried and at which every limit is kept, found by halving;
    /// `None` where the model that decides knows no shear stiffness.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub shear: Option<[f64; 2]>,
    /// The least and the largest multiple of the ply's mass at which every limit is kept, found in the same way.
    pub mass: [f64; 2],
    /// Cells by which each error of the grippers was tried; 0 where the motion is not accepted without errors, so that nothing was.
    pub tried: usize,
}

impl Tolerance {
    /// The largest multiple of a property of the ply that is tried; the least is its inverse.
    pub const MOST: f64 = MULTIPLES[MULTIPLES.len() - 1];

    /// What a motion tolerates that is not accepted without errors.
    pub const NOTHING: Tolerance = Tolerance {
        gripper_mm: 0.0,
        gripper_at_least: false,
        shear: None,
        mass: [1.0; 2],
        tried: 0,
    };

    /// The least error of the grippers of a layup that is tried (mm).
    #[must_use]
    pub fn least_mm(pitch: f64) -> f64 {
        1e3 * unit_error(pitch) * factor(PLACES[0])
    }

    /// What the motion of a scene tolerates that is accepted without errors; `None` if it was stopped.
    #[must_use]
    pub fn new(scene: &Scene, watch: &Watch) -> Option<Self> {
        let unit = unit_error(sheet::pitch(&scene.layup.ply));
        let mut errors = Errors::default();
        errors.gripper.position = Term::Deviation(unit);
        let place = largest_error(&errors, scene, watch)?;
        let times = if place < PLACES[0] { 0.0 } else { factor(place) };

        let Layup { settings, ply, .. } = &scene.layup;
        let shears = settings.model == Model::Sheet && ply.material.shear_curve.is_some();
        let of_mass = |mass| MaterialError { areal_mass: mass, ..MaterialError::default() };
        let of_shear = |shear| MaterialError { shear, ..MaterialError::default() };
        let (mass, shear) = rayon::join(
            || range(scene, of_mass, watch),
            || if shears { range(scene, of_shear, watch).map(Some) } else { Some(None) },
        );
        Some(Tolerance {
            gripper_mm: 1e3 * unit * times,
            gripper_at_least: place == PLACES[1],
            shear: shear?,
            mass: mass?,
            tried: TRIED,
        })
    }
}

/// The error of a gripper's position (m) of which multiples are tried: a thousandth of the grippers' pitch (m).
fn unit_error(pitch: f64) -> f64 {
    1e-3 * pitch
}

/// The least and the largest multiple of a property of the ply with which a scene along its motion is accepted; `error_of`
/// makes the error of that property. What is refused at one multiple is taken to be refused at those beyond it. Another ply hangs in another shape
/// from the start on, so each is draped from there. `None` if it was stopped.
fn range(
    scene: &Scene,
    error_of: impl Fn(RelativeError) -> MaterialError + Sync,
    watch: &Watch,
) -> Option<[f64; 2]> {
    let keeps = |multiple: f64| {
        let mut draw = Errors::default().draw(0, scene.layup.ply.grippers());
        draw.material = error_of(RelativeError::Share(multiple - 1.0));
        let other = Scene { layup: draw.apply(&scene.layup), errors: None, ..scene.clone() };
        Some(draped(&other, None, watch.stop)?.judged.accepted())
    };
    let end = |power: f64| {
        let multiples = [1.0].into_iter().chain(MULTIPLES).map(|multiple| multiple.powf(power));
        let multiples: Vec<f64> = multiples.collect();
        let [mut kept, mut refused] = [0, multiples.len()];
        while refused - kept > 1 {
            let next = usize::midpoint(kept, refused);
            if keeps(multiples[next])? {
                kept = next;
            } else {
                refused = next;
            }
        }
        Some(multiples[kept])
    };
    let (least, most) = rayon::join(|| end(-1.0), || end(1.0));
    Some([least?, most?])
}

/// The place of the largest common factor of errors at which a scene along its motion is still accepted; `None` if it was stopped.
///
/// Only the cells that decide are followed to the factor from which on they fail: all others are draped once, with the errors
/// that those before them still tolerate.
fn largest_error(errors: &Errors, scene: &Scene, watch: &Watch) -> Option<i32> {
    // this many of the cells may fail, so the next worse one decides
    let spare = TRIED - errors.needed(TRIED);
    let flight = Flight::new(&scene.layup, &scene.limits, &|| (watch.stop)());
    let mut worst: Vec<i32> = Vec::new();
    for pair in (0..TRIED).collect::<Vec<_>>().chunks(2) {
        let most = worst.get(spare).copied();
        let tolerated = |sample: &usize| {
            let keeps = |place: i32| {
                let drape = draped(
                    &errors.cell(scene, *sample, factor(place)),
                    flight.as_ref(),
                    watch.stop,
                )?;
                Some(drape.judged.accepted())
            };
            largest(most, keeps)
        };
        let found: Option<Vec<i32>> = pair.par_iter().map(tolerated).collect();
        worst.extend(found?);
        worst.sort_unstable();
    }
    worst.get(spare).copied()
}

/// The factor of a place.
fn factor(place: i32) -> f64 {
    (f64::from(place) / f64::from(PER_OCTAVE)).exp2()
}

/// The last place at which a cell keeps its limits, one before the first if it keeps them nowhere; no search beyond `most`, if
/// given. `None` if it was stopped.
fn largest(most: Option<i32>, keeps: impl Fn(i32) -> Option<bool>) -> Option<i32> {
    let [first, last] = PLACES;
    let start = most.unwrap_or(0);
    if start < first {
        return Some(start);
    }
    let (mut low, mut high) = (first - 1, last + 1);
    if keeps(start)? {
        low = start;
        // as far as it need be known
        high = most.map_or(high, |most| most + 1);
    } else {
        high = start;
    }
    // octave by octave, then by halves
    while high - low > 1 {
        let next = match (low < first, high > last) {
            (true, _) => (high - PER_OCTAVE).max(first),
            (_, true) => (low + PER_OCTAVE).min(last),
            _ => i32::midpoint(low, high),
        };
        if keeps(next)? {
            low = next;
        } else {
            high = next;
        }
    }
    Some(low)
}
