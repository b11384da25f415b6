//! How the ply is picked up from a table, and how the grippers come to it and leave it at the end.
//!
//! The ply lies flat. Pads come down on it upright, as far apart as the fabric between them is long, stand there for the vacuum to build up, and lift it
//! while they close to the distances at which it hangs. A span with a relative slack ε sags by `L √(3ε/8)`, so the slack grows with the
//! square of the height: what hangs between the pads is then a constant share of the height below them, and leaves the table early. After the pads
//! have let go they go back along the normals of the mold, and then up.

use crate::geometry::vector::{along, between};
use crate::mold::Mold;
use crate::ply::Ply;

/// Positions between the flat ply and the start.
const LIFT_STEPS: usize = 8;

/// The pick-up of a ply from a table, and the departure from it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct PickUp {
    /// Height of the ply on its table z (m).
    pub height: f64,
    /// How far above the ply the pads come from, and go to at the end (m).
    pub clearance: f64,
    /// How long the pads stand on the ply before they lift it (s).
    pub grip: f64,
    /// How long a program waits at most until the vacuum of each pad is there before it stops and holds (s); `None` if it does not look.
    #[cfg_attr(feature = "serde", serde(default, skip_serializing_if = "Option::is_none"))]
    pub vacuum_timeout: Option<f64>,
    /// How far the pads go back along their normals at the end (m).
    pub retreat: f64,
    /// The obstacle that is the table, by its number; pads are not judged against it, as against the mold.
    pub table: Option<usize>,
    /// Steps of the motion before the ply hangs from the grippers as it is draped from; zero of a motion that comes from a file.
    pub lift_steps: usize,
}

impl PickUp {
    /// Where the pads stand on the flat ply (m): about the same middle and with the same heading as grippers that hang it at `start` (m).
    #[must_use]
    pub fn flat(&self, ply: &Ply, start: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let count = start.len() as f64;
        let held: Vec<[f64; 2]> = (0..start.len()).map(|n| ply.place(n)).collect();
        let middle = [0, 1].map(|c| start.iter().map(|p| p[c]).sum::<f64>() / count);
        let origin = [0, 1].map(|c| held.iter().map(|place| place[c]).sum::<f64>() / count);
        let [u, ..] = ply.flat_axes(start);
        let (sin, cos) = u[1].atan2(u[0]).sin_cos();
        let place = |place: &[f64; 2]| {
            let [a, b] = [0, 1].map(|c| ply.length_factor * (place[c] - origin[c]));
            [middle[0] + a * cos - b * sin, middle[1] + a * sin + b * cos, self.height]
        };
        held.iter().map(place).collect()
    }

    /// The steps (m) from the flat ply to grippers at `start` (m), without that one.
    #[must_use]
    pub fn lift(&self, ply: &Ply, start: &[[f64; 3]]) -> Vec<Vec<[f64; 3]>> {
        let flat = self.flat(ply, start);
        let step = |k: usize| {
            let share = k as f64 / LIFT_STEPS as f64;
            let pairs = flat.iter().zip(start);
            let place = |(a, b): (&[f64; 3], &[f64; 3])| {
                let [x, y, _] = between(*a, *b, share * share);
                [x, y, between(*a, *b, share)[2]]
            };
            pairs.map(place).collect()
        };
        (0..LIFT_STEPS).map(step).collect()
    }

    /// Where the pads come from (m) before they stand on the flat ply at `flat` (m).
    #[must_use]
    pub fn above(&self, flat: &[[f64; 3]]) -> Vec<[f64; 3]> {
        flat.iter().map(|[x, y, z]| [*x, *y, z + self.clearance]).collect()
    }

    /// Where the pads go (m) from where they have let go of the ply on a mold, `landed` (m): along its normals, then up.
    #[must_use]
    pub fn departure(&self, mold: &Mold, landed: &[[f64; 3]]) -> [Vec<[f64; 3]>; 2] {
        let back = |p: &[f64; 3]| along(*p, self.retreat, mold.closest_point(*p).normal);
        let away: Vec<[f64; 3]> = landed.iter().map(back).collect();
        let up = self.above(&away);
        [away, up]
    }
}
