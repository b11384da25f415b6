//! The values of one sample.
//!
//! Every number has a place of its own: the stream of the generator is the number of the sample, and the position in the
//! stream is that of the quantity and the gripper. A number so depends on the seed and on what it is, not on how many samples,
//! grippers, threads or other terms there are, and not on which of them was drawn before.

use super::{Errors, Term};
use crate::mold::Waves;
use crate::ply::PickUpError;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Standard, StandardNormal};
use std::f64::consts::TAU;

/// One cell out of all that are possible: the value of every error.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Draw {
    /// Error of the tool frame.
    pub frame: RigidError,
    /// Error of each gripper, in the order of [`crate::ply::Ply::index`].
    pub grippers: Vec<GripperError>,
    /// Error of where the grippers hold the ply.
    pub pick_up: PickUpError,
    /// Error of the ply.
    pub material: MaterialError,
    /// Error of the mold.
    pub mold: MoldError,
}

/// A small rigid motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct RigidError {
    /// Shift (m).
    pub shift: [f64; 3],
    /// Turn by its length about its direction (rad).
    pub turn: [f64; 3],
}

/// The error of one gripper.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GripperError {
    /// Constant shift (m).
    pub position: [f64; 3],
    /// Shift along each axis as a share of the way gone along it since the start.
    pub stroke: [f64; 3],
}

/// The error of the ply.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MaterialError {
    /// Error of the mass.
    pub areal_mass: RelativeError,
    /// Error of the bending rigidities.
    pub bending: RelativeError,
    /// Error of the shear force.
    pub shear: RelativeError,
    /// Error of the length, as a share of it.
    pub length: f64,
}

/// The error of one value of the ply; written as the share of the nominal value that the true one has more.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(into = "f64"))]
pub enum RelativeError {
    /// A share e: the true value is 1 + e times the nominal one.
    Share(f64),
    /// A logarithm x: the true value is eˣ times the nominal one.
    Logarithm(f64),
}

/// The error of the mold.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MoldError {
    /// Shift, and turn about the middle of the target.
    pub motion: RigidError,
    /// Waves on its surface; `None` where it has no waviness.
    pub waves: Option<Waves>,
}

/// What a random number is for; its place in the stream of a sample. New quantities go to the end, so that the numbers of
/// the others stay.
#[derive(Clone, Copy)]
enum Quantity {
    FramePosition,
    FrameAngle,
    GripperPosition,
    GripperStroke,
    PickUpOffset,
    PickUpYaw,
    ArealMass,
    Bending,
    Shear,
    Length,
    MoldOffset,
    MoldTilt,
    WaveDirection,
    WavePhase,
}

/// Places in a stream for quantities; there are fewer.
const QUANTITIES: u128 = 64;
/// Numbers that a quantity has at most, of one gripper or of the cell.
const NUMBERS: u128 = 16;
/// Words of the stream for each number. A normal number takes two of them in 99 of 100 cases, and all of them in none.
const WORDS: u128 = 64;

/// The random numbers of one sample.
struct Stream {
    /// The generator at the beginning of the stream.
    start: ChaCha8Rng,
}

impl Stream {
    fn new(seed: u64, sample: usize) -> Self {
        let mut start = ChaCha8Rng::seed_from_u64(seed);
        start.set_stream(sample as u64);
        Stream { start }
    }

    /// The generator at the place of number `n` of a quantity of gripper `item`, 0 for what has no gripper.
    fn generator(&self, quantity: Quantity, item: usize, n: usize) -> ChaCha8Rng {
        let place = (item as u128 * QUANTITIES + quantity as u128) * NUMBERS + n as u128;
        let mut random = self.start.clone();
        random.set_word_pos(place * WORDS);
        random
    }

    /// An even number from 0 up to 1.
    fn even(&self, quantity: Quantity, item: usize, n: usize) -> f64 {
        Standard.sample(&mut self.generator(quantity, item, n))
    }

    /// Numbers of the law of a term; of a factor their logarithms.
    fn draw<const N: usize>(&self, term: Term, quantity: Quantity, item: usize) -> [f64; N] {
        std::array::from_fn(|n| match term {
            _ if term.is_zero() => 0.0,
            Term::Deviation(deviation) => {
                let normal: f64 = StandardNormal.sample(&mut self.generator(quantity, item, n));
                deviation * normal
            }
            Term::Bound(bound) => bound * (2.0 * self.even(quantity, item, n) - 1.0),
            Term::Factor(most) => most.ln() * (2.0 * self.even(quantity, item, n) - 1.0),
        })
    }

    /// The waves of a waviness; `None` without one, or without a wavelength.
    fn waves(&self, waviness: Term, wavelength: f64) -> Option<Waves> {
        if waviness.is_zero() || wavelength.is_nan() || wavelength <= 0.0 {
            return None;
        }
        let angles = |quantity| std::array::from_fn(|n| TAU * self.even(quantity, 0, n));
        let (headings, phases) = (angles(Quantity::WaveDirection), angles(Quantity::WavePhase));
        let amplitude = match waviness {
            Term::Deviation(deviation) => Waves::amplitude_of_deviation(deviation),
            Term::Bound(bound) | Term::Factor(bound) => Waves::amplitude_of_bound(bound),
        };
        Some(Waves { amplitude, wavelength, headings, phases })
    }
}

impl Errors {
    /// The values of a sample, which counts from 0, for a number of grippers.
    #[must_use]
    pub fn draw(&self, sample: usize, grippers: usize) -> Draw {
        // each quantity has numbers of its own, so a term that is added changes no other draw
        let stream = Stream::new(self.seed, sample);
        let number = |term: Term, quantity: Quantity| stream.draw::<1>(term, quantity, 0)[0];
        let relative = |term: Term, quantity: Quantity| match term {
            Term::Factor(_) => RelativeError::Logarithm(number(term, quantity)),
            Term::Deviation(_) | Term::Bound(_) => RelativeError::Share(number(term, quantity)),
        };
        // likewise each gripper: another array keeps the errors of those that it shares
        let gripper = |n: usize| GripperError {
            position: stream.draw(self.gripper.position, Quantity::GripperPosition, n),
            stroke: stream.draw(self.gripper.stroke, Quantity::GripperStroke, n),
        };
        let [about_x, about_y] = stream.draw(self.mold.tilt, Quantity::MoldTilt, 0);
        Draw {
            frame: RigidError {
                shift: stream.draw(self.frame.position, Quantity::FramePosition, 0),
                turn: stream.draw(self.frame.angle, Quantity::FrameAngle, 0),
            },
            grippers: (0..grippers).map(gripper).collect(),
            pick_up: PickUpError {
                offset: stream.draw(self.pick_up.offset, Quantity::PickUpOffset, 0),
                yaw: number(self.pick_up.yaw, Quantity::PickUpYaw),
            },
            material: MaterialError {
                areal_mass: relative(self.material.areal_mass, Quantity::ArealMass),
                bending: relative(self.material.bending, Quantity::Bending),
                shear: relative(self.material.shear, Quantity::Shear),
                length: number(self.material.length, Quantity::Length),
            },
            mold: MoldError {
                motion: RigidError {
                    shift: stream.draw(self.mold.offset, Quantity::MoldOffset, 0),
                    turn: [about_x, about_y, 0.0],
                },
                waves: stream.waves(self.mold.waviness, self.mold.wavelength),
            },
        }
    }
}

impl RelativeError {
    /// This error, larger by a factor: twice the error of a half is that of a quarter if it is a logarithm.
    #[must_use]
    pub fn scaled(self, factor: f64) -> Self {
        match self {
            RelativeError::Share(share) => RelativeError::Share(factor * share),
            RelativeError::Logarithm(log) => RelativeError::Logarithm(factor * log),
        }
    }

    /// The true value over the nominal one.
    #[must_use]
    pub fn ratio(self) -> f64 {
        match self {
            RelativeError::Share(share) => 1.0 + share,
            RelativeError::Logarithm(log) => log.exp(),
        }
    }
}

/// No error.
impl Default for RelativeError {
    fn default() -> Self {
        RelativeError::Share(0.0)
    }
}

/// As a share of the nominal value.
impl From<RelativeError> for f64 {
    fn from(error: RelativeError) -> f64 {
        match error {
            RelativeError::Share(share) => share,
            RelativeError::Logarithm(log) => log.exp_m1(),
        }
    }
}

impl RigidError {
    /// This error, larger by a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let times = |v: [f64; 3]| v.map(|x| factor * x);
        RigidError { shift: times(self.shift), turn: times(self.turn) }
    }
}

impl Draw {
    /// This cell with every error larger by a factor; 0 is the nominal cell.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        let times = |v: [f64; 3]| v.map(|x| factor * x);
        let gripper = |error: &GripperError| GripperError {
            position: times(error.position),
            stroke: times(error.stroke),
        };
        let MaterialError { areal_mass, bending, shear, length } = self.material;
        let wave = |waves: Waves| Waves { amplitude: factor * waves.amplitude, ..waves };
        Draw {
            frame: self.frame.scaled(factor),
            grippers: self.grippers.iter().map(gripper).collect(),
            pick_up: PickUpError {
                offset: self.pick_up.offset.map(|x| factor * x),
                yaw: factor * self.pick_up.yaw,
            },
            material: MaterialError {
                areal_mass: areal_mass.scaled(factor),
                bending: bending.scaled(factor),
                shear: shear.scaled(factor),
                length: factor * length,
            },
            mold: MoldError {
                motion: self.mold.motion.scaled(factor),
                waves: self.mold.waves.map(wave),
            },
        }
    }
}
