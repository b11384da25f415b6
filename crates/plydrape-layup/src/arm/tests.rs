//! Arms by closed forms: an arm with a spherical wrist, whose configurations can be counted and turned into each other by hand.

use super::tuning::{ALLOWED, LEAST_MARGIN, LEAST_SINGULAR};
use super::{Angles, Arm, JOINTS, Joint};
use crate::geometry::Pose;
use crate::geometry::vector::{distance, norm};
use crate::tool::turn_between;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// An arm with its joints at these places (m) in the frame before, turning about z, y, y, x, y and x; its flange looks along x.
fn arm() -> Arm {
    let at = [
        [0.0, 0.0, 0.5],
        [0.2, 0.0, 0.0],
        [0.0, 0.0, 0.9],
        [0.0, 0.0, 0.2],
        [1.0, 0.0, 0.0],
        [0.1, 0.0, 0.0],
    ];
    let [x, y, z] = Pose::ORIGIN.axes;
    let axes = [z, y, y, x, y, x];
    let joints = std::array::from_fn(|n| Joint {
        name: format!("joint_{}", n + 1),
        pose: Pose::upright(at[n]),
        axis: axes[n],
        range: [-PI, PI],
        speed: 2.0,
    });
    Arm {
        name: "arm".into(),
        joints,
        flange: Pose::ORIGIN,
        start: None,
        acceleration: None,
        margin: LEAST_MARGIN,
        singular: LEAST_SINGULAR,
    }
}

/// Angles without a symmetry.
const SOME: Angles = [0.3, 0.2, -0.4, 0.5, 0.8, -0.7];

/// Asserts that two poses are the same (m, rad).
fn assert_same(a: &Pose, b: &Pose) {
    assert!(distance(a.position, b.position) < 1e-7, "{a:?} is not {b:?}");
    assert!(norm(turn_between(&a.axes, &b.axes)) < 1e-7, "{a:?} is not {b:?}");
}

/// Stretched out the arm is as long as its links; turned at the foot its flange goes round; with the shoulder down by a right angle the upper arm is
/// level and the forearm hangs down.
#[test]
fn the_flange_is_at_the_end_of_the_links() {
    let arm = arm();
    let zero = arm.flange_at(&[0.0; JOINTS]);
    assert_same(&zero, &Pose::upright([0.2 + 1.0 + 0.1, 0.0, 0.5 + 0.9 + 0.2]));
    let mut angles = [0.0; JOINTS];
    angles[0] = FRAC_PI_2;
    assert_same(&arm.flange_at(&angles), &Pose::new([0.0, 1.3, 1.6], [0.0, 0.0, FRAC_PI_2]));
    angles = [0.0, FRAC_PI_2, 0.0, 0.0, 0.0, 0.0];
    assert_same(
        &arm.flange_at(&angles),
        &Pose::new([0.2 + 0.9 + 0.2, 0.0, 0.5 - 1.1], [0.0, FRAC_PI_2, 0.0]),
    );
}

/// The derivative of the flange's place and turn by each joint is their difference for a small angle.
#[test]
fn the_jacobian_is_the_derivative_of_the_flange() {
    let arm = arm();
    let (step, jacobian) = (1e-6, arm.jacobian(&SOME));
    for n in 0..JOINTS {
        let moved = |by: f64| {
            let mut angles = SOME;
            angles[n] += by;
            arm.flange_at(&angles)
        };
        let (less, more) = (moved(-step), moved(step));
        let turn = turn_between(&less.axes, &more.axes);
        for c in 0..3 {
            let moves = (more.position[c] - less.position[c]) / (2.0 * step * arm.reach());
            assert!((jacobian[(c, n)] - moves).abs() < 1e-8, "joint {n}, {c}");
            assert!((jacobian[(c + 3, n)] - turn[c] / (2.0 * step)).abs() < 1e-8, "joint {n}, {c}");
        }
    }
}

/// An arm with a spherical wrist reaches a pose with its shoulder and its elbow to either side and its wrist turned over: by eight
/// configurations, all of which bring the flange there. Turned over, the angles of a wrist are q₄ + π, −q₅ and q₆ + π.
#[test]
fn a_spherical_wrist_has_eight_configurations() {
    let mut arm = arm();
    arm.joints[5].pose = Pose::ORIGIN;
    arm.flange = Pose::upright([0.1, 0.0, 0.0]);
    // near enough for a shoulder that is turned away
    let near = [0.3, 0.2, 0.6, 0.5, 0.8, -0.7];
    let pose = arm.flange_at(&near);
    let found = arm.configurations(&pose);
    assert_eq!(found.len(), 8, "{found:?}");
    for one in &found {
        assert_same(&arm.flange_at(&one.angles), &pose);
        let [a, b, c, q4, q5, q6] = one.angles;
        let over = [a, b, c, q4 + PI, -q5, q6 + PI];
        let has = found.iter().any(|other| {
            other
                .angles
                .iter()
                .zip(over)
                .all(|(a, b)| (a - b - TAU * ((a - b) / TAU).round()).abs() < 1e-6)
        });
        assert!(has, "{over:?} is not among {found:?}");
    }
    let has =
        found.iter().any(|one| one.angles.iter().zip(near).all(|(a, b)| (a - b).abs() < 1e-6));
    assert!(has, "{found:?}");
}

/// With the wrist straight its first and last axis are one: the flange cannot turn about the third direction, and the least singular value is
/// zero. It grows with the angle of the wrist.
#[test]
fn a_straight_wrist_is_singular() {
    let arm = arm();
    let least = |angle: f64| arm.least_singular(&[0.3, 0.2, -0.4, 0.5, angle, -0.7]);
    assert!(least(0.0) < 1e-12);
    assert!(least(0.01) > 1e-4 && least(0.1) > 5.0 * least(0.01) && least(0.1) < 0.1);
}

/// A pose twice as far as the arm is long is missed by what lies between, and no configuration reaches it.
#[test]
fn what_is_out_of_reach_is_missed() {
    let arm = arm();
    let far = Pose::upright([2.0 * arm.reach(), 0.0, 0.5]);
    let course = arm.course(&[0.0], &[far], &[]).unwrap();
    assert_eq!((course.configurations, course.keeping), (0, 0));
    let flange = arm.flange_at(&course.angles[0]);
    assert!(course.peaks.missed.value >= 0.9 * distance(flange.position, far.position));
    assert!(course.peaks.missed.value > 0.5 * arm.reach());
}

/// Along a way on which the joints move evenly the arm finds their angles again, their speed as a share of what they may, no acceleration but at
/// the ends, and how near each comes to its end.
#[test]
fn a_course_finds_the_angles_of_its_motion() {
    let mut arm = arm();
    arm.start = Some(SOME);
    // one joint comes within a tenth of a radian of its end
    arm.joints[3].range = [-PI, 0.5 + 0.5 + 0.1];
    let times: Vec<f64> = (0..=100).map(|n| 0.01 * f64::from(n)).collect();
    let angles: Vec<Angles> = times.iter().map(|t| SOME.map(|angle| angle + 0.5 * t)).collect();
    let poses: Vec<Pose> = angles.iter().map(|angles| arm.flange_at(angles)).collect();
    let all: Vec<usize> = (0..times.len()).collect();
    let course = arm.course(&times, &poses, &all).unwrap();
    for (found, angles) in course.angles.iter().zip(&angles) {
        assert!(found.iter().zip(angles).all(|(a, b)| (a - b).abs() < 1e-7), "{found:?}");
    }
    let peaks = course.peaks;
    assert!(peaks.missed.value < ALLOWED * arm.reach());
    assert!((peaks.speed_share.value - 0.25).abs() < 1e-5);
    assert!((peaks.margin.value - 0.1).abs() < 1e-6 && peaks.margin.gripper == 3);
    assert!((peaks.margin.time - 1.0).abs() < 1e-12);
    // from rest to half a radian a second within half a sample
    assert!((peaks.acceleration.value - 0.5 / 0.005).abs() < 1e-3, "{peaks:?}");
    // others that begin elsewhere are counted too
    assert!((1..=course.configurations).contains(&course.keeping), "{}", course.keeping);
}

/// A joint of several turns is wound so that it stays within its range, and one that cannot says how far it is beyond its end.
#[test]
fn joints_are_wound_into_their_range() {
    let mut arm = arm();
    arm.start = Some([0.0; JOINTS]);
    arm.joints[5].range = [3.0, 9.5];
    let angles = |last: f64| [0.2, 0.3, -0.2, 0.1, 0.9, last];
    let poses = [0.1, 0.15].map(|last| arm.flange_at(&angles(last)));
    let course = arm.course(&[0.0, 1.0], &poses, &[0, 1]).unwrap();
    let last = course.angles[1][5];
    assert!((last - (0.15 + TAU)).abs() < 1e-7, "{last}");
    arm.joints[5].range = [1.0, 2.0];
    let course = arm.course(&[0.0, 1.0], &poses, &[0, 1]).unwrap();
    assert!((course.peaks.margin.value + 0.9).abs() < 1e-7, "{:?}", course.peaks);
}
