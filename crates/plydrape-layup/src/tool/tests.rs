//! A tool against rigid motions, closed forms, and small changes of its posture.

use super::rates::turn_between;
use super::{Axis, Carried, Posture, Tool};
use crate::geometry::vector::{cross, distance, norm, turned};
use crate::mold::Pose;
use crate::motion::{Bounds, TimedMotion};
use proptest::prelude::*;
use std::f64::consts::PI;

const Z: [f64; 3] = [0.0, 0.0, 1.0];

fn axis(direction: [f64; 3], stroke: f64) -> Axis {
    Axis { name: "a".into(), direction, stroke: [-stroke, stroke], speed: 0.1 }
}

/// Grippers 100 mm apart on a plane at a height of 0.3 m.
fn start(nu: usize, nv: usize) -> Vec<[f64; 3]> {
    let place = |n: usize| [0.1 * (n % nu) as f64, 0.1 * (n / nu) as f64, 0.3];
    (0..nu * nv).map(place).collect()
}

fn farthest(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max)
}

/// Half a turn about any axis of the frame is as far as a turn goes, although its sine is zero; the axes as they are have no turn.
#[test]
fn half_a_turn_is_found() {
    let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let still = [x, y, Z];
    assert_eq!(turn_between(&still, &still), [0.0; 3]);
    for kept in 0..3 {
        let to = [0, 1, 2].map(|n| if n == kept { still[n] } else { still[n].map(|c: f64| -c) });
        let due = still[kept].map(|c| PI * c);
        assert!(distance(turn_between(&still, &to), due) < 1e-15, "{kept}");
    }
}

/// At the start the tool is as it was set up: no stroke, no turn.
#[test]
fn at_the_start_a_tool_stands_with_its_strokes_at_zero() {
    for axes in [vec![], vec![axis(Z, 0.05)]] {
        let start = start(4, 3);
        let tool = Tool::new(&start, axes);
        let posture = tool.posture(&start);
        assert!(farthest(&tool.places(&posture), &start) < 1e-15);
        assert!(posture.strokes.iter().flatten().all(|s| s.abs() < 1e-15), "{posture:?}");
    }
}

/// Four grippers 100 mm apart that close to half of it each need 25 mm of an axis that has 10, and no axis is missing where it has 30.
#[test]
fn a_motion_says_which_stroke_it_would_need() {
    let x = [1.0, 0.0, 0.0];
    let start = start(2, 2);
    let half = start.iter().map(|p| [0.025 + 0.5 * p[0], p[1], p[2]]).collect::<Vec<_>>();
    let record = |stroke| {
        Tool::new(&start, vec![axis(Z, 0.05), axis(x, stroke)])
            .carry(&[start.clone(), half.clone()])
            .record
    };
    let missing = record(0.01).missing.unwrap();
    assert_eq!((missing.axis, missing.step), (1, 2));
    assert!((missing.by_mm() - 15.0).abs() < 1e-9 && missing.has_mm.abs() == 10.0, "{missing:?}");
    assert!((record(0.01).residual_mm - 15.0).abs() < 1e-9);
    assert_eq!(record(0.03).missing, None);
}

fn turn() -> impl Strategy<Value = [f64; 3]> {
    [-0.8..0.8, -0.8..0.8, -0.8..0.8].prop_map(|w: [f64; 3]| w)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// What a rigid motion asks for, a tool does without strokes; whatever axes it has.
    #[test]
    fn a_rigid_motion_needs_no_strokes(w in turn(), shift in [-1.0..1.0, -1.0..1.0, 0.0..1.0]) {
        let start = start(4, 3);
        let asked: Vec<[f64; 3]> =
            start.iter().map(|p| turned(w, *p)).map(|p| [0, 1, 2].map(|c| p[c] + shift[c])).collect();
        for axes in [vec![], vec![axis(Z, 0.05)]] {
            let tool = Tool::new(&start, axes);
            let posture = tool.posture(&asked);
            prop_assert!(farthest(&tool.places(&posture), &asked) < 1e-12);
            prop_assert!(posture.strokes.iter().flatten().all(|s| s.abs() < 1e-10), "{:?}", posture.strokes);
            let found = turn_between(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z], &posture.frame.axes);
            prop_assert!(distance(found, w) < 1e-9, "{found:?} {w:?}");
        }
    }

    /// With three axes at right angles, turned or not, places within reach are reached.
    #[test]
    fn three_axes_follow_any_places_in_their_reach(
        w in turn(), own in turn(), off in prop::collection::vec([-0.03..0.03, -0.03..0.03, -0.03..0.03], 12)
    ) {
        let start = start(4, 3);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z].map(|d| axis(turned(own, d), 0.1)).to_vec();
        let tool = Tool::new(&start, axes);
        let asked: Vec<[f64; 3]> = start
            .iter()
            .zip(&off)
            .map(|(p, off)| turned(w, [0, 1, 2].map(|c| p[c] + off[c])))
            .collect();
        let off = farthest(&tool.places(&tool.posture(&asked)), &asked);
        prop_assert!(off < 1e-12, "{off}");
    }

    /// What a tool has made with no stroke at its end, it makes again: to the square of a stroke's cost, times a stroke across.
    #[test]
    fn a_motion_of_the_tool_is_followed_exactly(
        w in turn(), off in prop::collection::vec([-0.01..0.01, -0.01..0.01, -0.04..0.04], 12)
    ) {
        let start = start(4, 3);
        let asked: Vec<[f64; 3]> =
            start.iter().zip(&off).map(|(p, off)| turned(w, [0, 1, 2].map(|c| p[c] + off[c]))).collect();
        for (axes, across) in [(vec![axis(Z, 0.2)], 0.0), (vec![axis(Z, 0.2), axis([1.0, 0.0, 0.0], 0.1)], 0.1)] {
            let tool = Tool::new(&start, axes);
            let most = 1e-11 + across * tool.stroke_cost().powi(2);
            let made = tool.places(&tool.posture(&asked));
            let again = tool.places(&tool.posture(&made));
            prop_assert!(farthest(&again, &made) < most, "{}", farthest(&again, &made));
        }
    }

    /// Where every stroke is free, the frame lies in the mean plane of what is asked: strokes of an axis that lifts have no part that a tilt
    /// or a lift of the frame would take up, whatever other axes there are.
    #[test]
    fn the_frame_lies_in_the_mean_plane(
        w in turn(), off in prop::collection::vec([-0.01..0.01, -0.01..0.01, -0.04..0.04], 12)
    ) {
        let start = start(4, 3);
        let asked: Vec<[f64; 3]> =
            start.iter().zip(&off).map(|(p, off)| turned(w, [0, 1, 2].map(|c| p[c] + off[c]))).collect();
        let across = axis([1.0, 0.0, 0.0], 0.2);
        for axes in [vec![axis(Z, 0.2)], vec![axis(Z, 0.2), across.clone()]] {
            let tool = Tool::new(&start, axes);
            let posture = tool.posture(&asked);
            for lever in [|_: [f64; 3]| 1.0, |m: [f64; 3]| m[0], |m: [f64; 3]| m[1]] {
                let sum: f64 = tool.mounts.iter().zip(&posture.strokes).map(|(m, s)| {
                    s[0] * lever(*m)
                }).sum();
                prop_assert!(sum.abs() < 1e-10, "{sum}");
            }
        }
    }

    /// Residuals, and strokes by the square of their cost, are in equilibrium as forces at the mounts, with strokes at their ends or not.
    #[test]
    fn residuals_and_strokes_are_in_equilibrium_at_the_mounts(
        off in prop::collection::vec([-0.02..0.02, -0.02..0.02, -0.04..0.04], 12), w in turn()
    ) {
        let start = start(4, 3);
        let asked: Vec<[f64; 3]> = start.iter().zip(&off).map(|(p, off)| turned(w, [0, 1, 2].map(|c| p[c] + off[c]))).collect();
        let x = axis([1.0, 0.0, 0.0], 0.02);
        for axes in [vec![], vec![x.clone()], vec![axis(Z, 0.06)], vec![x, axis(Z, 0.06), axis([0.0, 1.0, 0.0], 0.01)]] {
            let tool = Tool::new(&start, axes);
            let posture = tool.posture(&asked);
            let cost = tool.stroke_cost().powi(2);
            let mut sums = [0.0; 6];
            for ((mount, place), (asked, strokes)) in
                tool.mounts.iter().zip(tool.places(&posture)).zip(asked.iter().zip(&posture.strokes))
            {
                let [made, asked] = [place, *asked].map(|p| posture.frame.local(p));
                let mut force = [0, 1, 2].map(|c| asked[c] - made[c]);
                for (axis, stroke) in tool.axes.iter().zip(strokes) {
                    force = [0, 1, 2].map(|c| force[c] + cost * stroke * axis.direction[c]);
                }
                let moment = cross(*mount, force);
                sums = [0, 1, 2, 3, 4, 5].map(|k| sums[k] + if k < 3 { force[k] } else { moment[k - 3] });
            }
            prop_assert!(sums.iter().all(|sum| sum.abs() < 1e-11), "{sums:?}");
        }
    }

    /// Where places move by 1 µm, with strokes at their ends or not, the farthest mount of the frame moves by less than 100 µm: the frame does not
    /// jump.
    #[test]
    fn a_frame_follows_its_places_without_a_jump(
        off in prop::collection::vec([-0.02..0.02, -0.02..0.02, -0.04..0.04], 12), nudge in prop::collection::vec(turn(), 12)
    ) {
        let start = start(4, 3);
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z].map(|d| axis(d, 0.02)).to_vec();
        let tool = Tool::new(&start, axes);
        let frame = |share: f64| {
            let pairs = start.iter().zip(off.iter().zip(&nudge));
            let asked: Vec<[f64; 3]> = pairs.map(|(p, (off, nudge))| [0, 1, 2].map(|c| p[c] + off[c] + share * nudge[c])).collect();
            tool.posture(&asked).frame
        };
        let turn = norm(turn_between(&frame(0.0).axes, &frame(1e-6).axes));
        prop_assert!(0.18 * turn < 100.0 * 1e-6, "{turn}");
    }
}

/// A pattern that is too short would be met by a frame that tilts to one side, and by one that tilts to the other, alike. The frame of an axis that lifts
/// does neither: it stays level while the pattern becomes shorter and longer, and leaves what no stroke takes up.
#[test]
fn a_frame_stays_level_where_the_pattern_is_too_short() {
    // a plane and a row of grippers; seen from its middle, each place is this share too short along x and y
    for (start, rows) in [(start(3, 2), 0.05), (start(3, 1), 0.0)] {
        let tool = Tool::new(&start, vec![axis(Z, 0.05)]);
        for short in [0.02, 0.016, 1e-3, 1e-9, 0.0, -1e-9, -0.01] {
            for [x, y] in [[1.0, 1.0], [1.0, 0.0]] {
                // one gripper a nanometer higher would say to which side
                let asked = start.iter().zip(&tool.mounts).enumerate().map(|(n, (p, m))| {
                    let higher = if n == 0 { 1e-9 } else { 0.0 };
                    [p[0] - short * x * m[0], p[1] - short * y * m[1], p[2] + higher]
                });
                let record = tool.carry(&[start.clone(), asked.collect()]).record;
                assert!(record.turn_deg < 1e-6, "{short}: {record:?}");
                let due = 1e3 * (short * x * 0.1).hypot(short * y * rows);
                assert!((record.residual_mm - due).abs() < 1e-5, "{due} {record:?}");
            }
        }
    }
}

/// One of two rows of three grippers is asked to be 50 µm longer to both sides than its strokes reach, the other to be shorter. A frame turned by
/// acos(110 / 110.05) = 1.7° about its normal would leave nothing, to either side alike, and 0.1 µm would say to which. The frame stays, and leaves
/// these 50 µm.
#[test]
fn a_frame_does_not_turn_aside_where_a_row_is_longer_than_its_strokes() {
    let start = start(3, 2);
    let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let tool = Tool::new(&start, vec![axis(x, 0.01), axis(y, 0.04), axis(Z, 0.05)]);
    for aside in [-1e-7, 1e-7] {
        let asked = tool.mounts.iter().map(|m| {
            let [long, aside] = if m[1] > 0.0 { [1.1005, aside] } else { [0.95, 0.0] };
            [0.1 + long * m[0], 0.05 + m[1] + aside * m[0] / 0.1, 0.3]
        });
        let record = tool.carry(&[start.clone(), asked.collect()]).record;
        assert!(record.turn_deg < 1e-3, "{record:?}");
        assert!((record.residual_mm - 0.05).abs() < 1e-3, "{record:?}");
    }
}

/// A square of 100 mm has a row whose grippers stand 20 µm aside of each other. They are asked 2 µm farther from each other than their strokes along x
/// reach; by this lever a turn of 0.1 rad, 5.7°, would leave nothing. Where 0.5 mm are accepted and the longest stroke is 50 mm, a stroke
/// costs ε = 0.05 / 50. With a = 10 µm, e = 1 µm, half a side l and strokes of s = 10 mm, the moments of residuals, a (e − a θ + ε² s), and of
/// the strokes that the turn takes, ε² (l (2 l + s) + 4 l²) θ, are in equilibrium at 0.04°; the row is
/// shorter by its turn then, which is 1.2 % of e.
#[test]
fn micrometers_of_residual_are_spent_before_a_frame_turns_far() {
    let [aside, l, stroke, beyond] = [1e-5, 0.05, 0.01, 1e-6];
    let start = [[-l, l - aside, 0.3], [l, l + aside, 0.3], [-l, -l, 0.3], [l, -l, 0.3]];
    let [x, y] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let axes = vec![axis(x, stroke), axis(y, 0.05), axis(Z, 0.05)];
    let tool = Tool { residual: Some(5e-4), ..Tool::new(&start, axes) };
    let mut asked = start;
    asked[0][0] -= stroke + beyond;
    asked[1][0] += stroke + beyond;
    let Carried { postures, record, .. } = tool.carry(&[asked.to_vec()]);
    let turn = norm(turn_between(&[x, y, Z], &postures[0].frame.axes));
    let cost = 1e-6;
    let strokes = cost * (l * (2.0 * l + stroke) + 4.0 * l * l);
    let due = aside * (beyond + cost * stroke) / (strokes + aside * aside);
    assert!((turn / due - 1.0).abs() < 2e-2 && turn.to_degrees() < 0.04, "{turn} {due}");
    assert!(record.residual_mm < 1.1e3 * beyond, "{record:?}");
}

/// One corner of a square is asked 6 mm higher: a plane through 1.5 mm leaves 1.5 mm up and down, which strokes from both sides take, or strokes to one side
/// and a lower frame; shorter ones leave their share. A tilt of 2.4° leaves 0.06 mm across.
#[test]
fn the_frame_is_where_the_ends_of_the_strokes_serve_best() {
    let start = start(2, 2);
    let mut asked = start.clone();
    asked[3][2] += 0.006;
    let record = |stroke| {
        let tool = Tool::new(&start, vec![Axis { stroke, ..axis(Z, 0.0) }]);
        tool.carry(std::slice::from_ref(&asked)).record
    };
    let tilt = 0.03_f64.hypot(0.03).atan().to_degrees();
    let ends =
        [([-0.002, 0.002], 0.0), ([0.0, 0.004], 0.0), ([-8e-4, 8e-4], 0.7), ([0.0, 0.0016], 0.7)];
    for (stroke, due) in ends {
        let found = record(stroke);
        assert!((found.turn_deg - tilt).abs() < 0.02, "{tilt} {found:?}");
        assert!((due..due + 0.13).contains(&found.residual_mm), "{due} {found:?}");
    }
}

/// A frame that tilts from one side to the other while its strokes hold the grippers where they are is refused with the step; one that turns with
/// its grippers is not.
#[test]
fn a_frame_that_tips_over_is_refused_with_its_step() {
    let start = start(3, 2);
    let tool = Tool::new(&start, vec![axis(Z, 0.05)]);
    let tilted = |angle: f64| {
        let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z].map(|d| turned([0.0, angle, 0.0], d));
        let strokes = tool.mounts.iter().map(|m| vec![m[0] * angle.tan()]).collect();
        Posture { frame: Pose { position: tool.origin, axes }, strokes }
    };
    let carried = |postures: Vec<Posture>| {
        let positions = postures.iter().map(|p| tool.places(p)).collect();
        Carried { positions, postures, record: tool.carry(std::slice::from_ref(&start)).record }
    };
    let fault =
        carried([0.0, 0.03, 0.06, 0.09, -0.09].map(tilted).into()).check(&tool).unwrap_err();
    assert!(fault.to_string().contains("tips over in step 5: it turns by 10.3°"), "{fault}");
    let rigid = |angle: f64| Posture { strokes: vec![vec![0.0]; 6], ..tilted(angle) };
    carried([0.0, 0.2, -0.2].map(rigid).into()).check(&tool).unwrap();
}

/// Axes along z alone cannot bring two grippers 10 mm nearer to each other: each is 5 mm off, and the tool says so.
#[test]
fn grippers_that_should_come_nearer_than_axes_allow_share_the_residual() {
    let tool = Tool::new(&[[-0.05, 0.0, 0.2], [0.05, 0.0, 0.2]], vec![axis(Z, 0.1)]);
    let asked = vec![[-0.045, 0.0, 0.2], [0.045, 0.0, 0.2]];
    let record = tool.carry(&[asked]).record;
    assert!((record.residual_mm - 5.0).abs() < 1e-6, "{record:?}");
    assert_eq!((record.step, record.turn_deg), (1, 0.0));
}

/// Grippers in a row leave the turn about the row open: the frame does not turn so.
#[test]
fn a_row_of_grippers_does_not_turn_its_frame_about_itself() {
    let start = start(5, 1);
    let tool = Tool::new(&start, vec![axis(Z, 0.1)]);
    let asked: Vec<[f64; 3]> = start.iter().map(|p| [p[0], p[1], p[2] + p[0] * p[0]]).collect();
    let posture = tool.posture(&asked);
    let turn = turn_between(&[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], Z], &posture.frame.axes);
    assert!(turn[0].abs() < 1e-9 && turn[2].abs() < 1e-9, "{turn:?}");
    assert!(posture.strokes.iter().flatten().all(|s| s.is_finite()));
}

/// Corners of a square that turns about its middle move as fast as it turns times half its diagonal; and the frame slows down as all
/// of the motion does.
#[test]
fn the_frame_turns_as_fast_as_the_corners_of_a_turning_square_say() {
    let corners = [[-0.2, -0.2, 0.0], [0.2, -0.2, 0.0], [-0.2, 0.2, 0.0], [0.2, 0.2, 0.0]];
    let steps: Vec<Vec<[f64; 3]>> = (0..=40)
        .map(|k| corners.iter().map(|p| turned([0.0, 0.0, 0.02 * f64::from(k)], *p)).collect())
        .collect();
    let motion =
        TimedMotion::new(&steps, &Bounds { speed: 0.2, acceleration: 0.5, jerk: 5.0 }).unwrap();
    let tool = Tool::new(&corners, vec![axis(Z, 0.1)]);
    let peaks = tool.peaks(&motion, 500.0).unwrap();
    let arm = norm(corners[0]);
    assert!(
        (peaks.turn_rate.value * arm / motion.peaks().speed.value - 1.0).abs() < 1e-3,
        "{peaks:?}"
    );
    let slow = tool.peaks(&motion.slowed(2.0), 250.0).unwrap();
    assert!((slow.turn_rate.value / peaks.turn_rate.value - 0.5).abs() < 1e-6);
    assert!((slow.turn_acceleration.value / peaks.turn_acceleration.value - 0.25).abs() < 1e-6);
    // so much longer, and the limit that is nearest is just kept
    let stretch = peaks.stretch(&tool);
    let kept = tool.peaks(&motion.slowed(stretch), 500.0 / stretch).unwrap();
    assert!((kept.stretch(&tool) - 1.0).abs() < 1e-6, "{stretch} {kept:?}");
}
