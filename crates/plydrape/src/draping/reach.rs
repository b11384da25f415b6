//! Where the grippers are: apart from each other, and within the workspace of their robot.

use super::spans::Point;
use super::tuning::TUNING;
use crate::measure::{Found, Sense, Site};
use crate::mold::distance;

/// The two grippers closest to each other: their distance (mm) and the middle between them.
pub(crate) fn closest(positions: &[Point]) -> Option<Found> {
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
    let place = [0, 1, 2].map(|n| 0.5 * (positions[a][n] + positions[b][n]));
    Some(Found { value: least * 1e3, site: Site::Grippers(a, b), place: Some(place) })
}

/// The gripper farthest outside a box ([from, to] in x, y and z, m): its distance from the box (mm), zero
/// where none is outside by more than rounding, a share of the shorter side of a cell (m).
pub(crate) fn outside(
    positions: &[Point],
    workspace: [[f64; 2]; 3],
    [a, b]: [f64; 2],
) -> Option<Found> {
    let beyond = |point: &Point| {
        let excess = |n: usize| {
            let [from, to] = workspace[n];
            // NaN is within no bounds, and stays
            if (from..=to).contains(&point[n]) { 0.0 } else { (from - point[n]).max(point[n] - to) }
        };
        let far = excess(0).hypot(excess(1)).hypot(excess(2));
        if far <= TUNING.workspace_rounding * a.min(b) { 0.0 } else { far }
    };
    let all = positions.iter().enumerate().map(|(n, point)| (beyond(point), n));
    // the first of several that are equal
    let (far, n) =
        all.reduce(|most, next| if Sense::AtMost.is_worse(next.0, most.0) { next } else { most })?;
    let found = Found { value: far * 1e3, site: Site::Gripper(n), place: Some(positions[n]) };
    Some(if far == 0.0 { Found::NONE } else { found })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A box of 1 m; 3 and 4 mm outside it make 5 mm from its edge.
    #[test]
    fn the_distance_from_the_workspace_is_that_of_its_nearest_point() {
        let workspace = [[0.0, 1.0]; 3];
        let mut positions = vec![[0.5; 3]; 6];
        let worst = outside(&positions, workspace, [0.1; 2]).unwrap();
        assert_eq!(worst, Found::NONE);
        positions[1] = [0.5, 0.5, 1.0 + 1e-12];
        assert_eq!(outside(&positions, workspace, [0.1; 2]).unwrap().value, 0.0);
        positions[4] = [1.003, 0.5, -0.004];
        let worst = outside(&positions, workspace, [0.1; 2]).unwrap();
        assert!((worst.value - 5.0).abs() < 1e-9, "{}", worst.value);
        assert_eq!(worst.site, Site::Gripper(4));
    }

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
            prop_assert_eq!(closest(&positions).unwrap().value, least * 1e3);
        }
    }
}
