//! Penetration: the greatest depth of the ply and of the grippers below the mold.
//!
//! Grippers of catenaries are followed along their straight paths from the step before: the distance from the mold changes by no more
//! than the length of the path, so halving the path finds the deepest point. In the sheet they are points of the ply.

use super::{Bound, Description, Found, Measure, Most, Observation, TUNING, Unit, UsualLimit};
use crate::geometry::vector::between;
use crate::geometry::{Point, distance};
use crate::layup::{Layup, Model};
use crate::mold::Mold;
use crate::state::Site;

/// Penetration; see the head of this file.
pub struct Penetration;

impl Measure for Penetration {
    fn description(&self) -> Description {
        Description::new("penetration", "penetration_mm", "penetration", Unit::MILLIMETER)
    }

    fn bound(&self) -> Option<Bound> {
        Some(
            Bound::depth("Depth of ply and grippers below the mold")
                .follows("the contact's `tolerance`", 5e-4),
        )
    }

    fn usual_limit(&self, layup: &Layup) -> Option<UsualLimit> {
        UsualLimit::new(layup.settings.contact.tolerance, "the tolerance of contact")
    }

    fn applies(&self, layup: &Layup) -> bool {
        layup.mold.is_some()
    }

    fn evaluate(&self, seen: &Observation) -> Option<Found> {
        let mold = seen.layup.mold.as_ref()?;
        let mut most = Most::default();

        // the straight paths of the grippers
        if seen.state.model == Model::Catenaries {
            let resolution = TUNING.depth_resolution * seen.layup.settings.contact.tolerance;
            for (n, gripper) in seen.state.grippers.iter().enumerate() {
                let to = gripper.position;
                let from = seen.past.map_or(to, |past| past.positions[n]);
                let (depth, place) = deepest(mold, from, to, resolution);
                most.meet(depth, Site::Gripper(n), place);
            }
        }

        // the ply
        for point in &seen.state.points {
            if let Some(height) = point.height {
                most.meet(-height, point.site, point.place);
            }
        }
        let found = most.in_units_of(1e-3)?;
        Some(if found.value <= 0.0 { Found::NONE } else { found })
    }
}

/// Greatest depth (m) along a straight path and its place, to a resolution (m); 0 where all of it is outside.
fn deepest(mold: &Mold, from: Point, to: Point, resolution: f64) -> (f64, Point) {
    let depth = |p: Point| -mold.signed_distance(p);
    let mut best = (0.0, to);
    let mut meet = |depth: f64, place: Point| {
        // NaN is deeper than all
        if depth > best.0 || depth.is_nan() {
            best = (depth, place);
        }
        best.0
    };
    let [start, end] = [depth(from), depth(to)];
    meet(start, from);
    meet(end, to);
    let mut open = vec![([from, to], [start, end])];
    for _ in 0..TUNING.path_parts {
        let Some(([a, b], [da, db])) = open.pop() else { break };
        let reach = 0.5 * (da + db + distance(a, b));
        let middle = between(a, b, 0.5);
        // a path without a finite length cannot be halved
        if !reach.is_finite() {
            return (f64::INFINITY, middle);
        }
        if reach <= meet(0.0, middle) + resolution {
            continue;
        }
        let dm = depth(middle);
        meet(dm, middle);
        open.push(([a, middle], [da, dm]));
        open.push(([middle, b], [dm, db]));
    }
    // a part that was not evaluated counts as deep as it could be
    for ([a, b], [da, db]) in open {
        meet(0.5 * (da + db + distance(a, b)), between(a, b, 0.5));
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mold::{Face, Pose, Sphere};

    /// Straight across a ball from side to side the deepest point is the middle: R − √(R² − c²/4) less of the chord's
    /// height above it.
    #[test]
    fn a_path_through_a_ball_is_deepest_in_its_middle() {
        let pose = Pose::new([0.0; 3], [0.0; 3]);
        let ball = Mold::Sphere(Sphere { pose, radius: 0.5, face: Face::Outside });
        for height in [0.1, 0.3, 0.49, 0.6] {
            let [from, to] = [[-0.8, 0.1, height], [0.9, 0.1, height]];
            let (depth, _) = deepest(&ball, from, to, 1e-6);
            let expected = (0.5 - f64::hypot(0.1, height)).max(0.0);
            assert!((depth - expected).abs() < 1.1e-6, "{height}: {depth} {expected}");
        }
    }
}
