//! Gripper distance: the smallest distance of any two grippers.

use super::{Bound, Description, Found, Measure, Observation, Sense, Unit, UsualLimit, Worth};
use crate::geometry::vector::between;
use crate::geometry::{Point, distance};
use crate::layup::Layup;
use crate::state::Site;

/// Gripper distance; see the head of this file.
pub struct GripperDistance;

impl Measure for GripperDistance {
    fn description(&self) -> Description {
        let own = Description::new(
            "gripper_distance",
            "gripper_distance_mm",
            "gripper distance",
            Unit::MILLIMETER,
        );
        Description { sense: Sense::AtLeast, worth: Worth::Kept, ..own }
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::distance("Smallest distance between any two grippers")
                .follows("half of the shorter side of a cell", 0.08),
        )
    }

    fn usual_limit(&self, layup: &Layup) -> Option<UsualLimit> {
        let side = layup.ply.shorter_side();
        UsualLimit::new(0.5 * side, "our choice: half of the shorter side of a cell")
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        closest_grippers(&seen.commanded())
    }
}

/// The two grippers closest to each other: their distance (mm) and the middle between them; `None` of fewer than two.
pub(crate) fn closest_grippers(positions: &[Point]) -> Option<Found> {
    // along x: who is further off in x alone than the closest pair is no candidate, nor is anyone behind
    let mut order: Vec<usize> = (0..positions.len()).collect();
    order.sort_by(|&a, &b| positions[a][0].total_cmp(&positions[b][0]).then(a.cmp(&b)));
    let mut least = f64::INFINITY;
    let mut pair = None;
    for (n, &a) in order.iter().enumerate() {
        for &b in &order[n + 1..] {
            if positions[b][0] - positions[a][0] >= least {
                break;
            }
            let apart = distance(positions[a], positions[b]);
            if apart < least {
                (least, pair) = (apart, Some([a.min(b), a.max(b)]));
            }
        }
    }
    let [a, b] = pair?;
    let place = between(positions[a], positions[b], 0.5);
    Some(Found { value: least * 1e3, site: Site::Grippers(a, b), place: Some(place) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against every pair; positions on a coarse raster, so that many share an x or a place.
        #[test]
        fn the_closest_pair_is_the_closest_of_all_pairs(
            raster in prop::collection::vec((0..4_i32, 0..4_i32, 0..4_i32), 6),
        ) {
            let positions: Vec<Point> =
                raster.iter().map(|&(x, y, z)| [x, y, z].map(|k| 0.1 * f64::from(k))).collect();
            let pairs = (0..6).flat_map(|a| (0..a).map(move |b| [a, b]));
            let least = pairs
                .map(|[a, b]| distance(positions[a], positions[b]))
                .fold(f64::INFINITY, f64::min);
            prop_assert_eq!(closest_grippers(&positions).unwrap().value, least * 1e3);
        }
    }
}
