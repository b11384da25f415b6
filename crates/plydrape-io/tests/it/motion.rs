//! Timed motions against closed forms, finite differences of their samples, and what was planned.

use crate::common::{cases, paper_ply};
use plydrape::LayupError;
use plydrape::geometry::vector::norm;
use plydrape::motion::{Attitudes, Bounds, TimedMotion};
use plydrape_io::scene;
use plydrape_io::write::csv;
use proptest::prelude::*;

type Point = [f64; 3];
type Quaternion = [f64; 4];

/// The defaults of a scene.
const BOUNDS: Bounds = Bounds { speed: 0.25, acceleration: 1.0, jerk: 10.0 };

fn timed(planned: &[Vec<Point>]) -> TimedMotion {
    TimedMotion::new(planned, &BOUNDS).unwrap_or_else(|e| panic!("{e}"))
}

/// Two grippers on straight lines, the second half as fast.
fn straight(length: f64, steps: usize) -> Vec<Vec<Point>> {
    let place = |k: usize| length * k as f64 / (steps - 1) as f64;
    (0..steps).map(|k| vec![[place(k), 0.0, 0.1], [0.0, 0.5 * place(k), 0.2]]).collect()
}

/// 4 × 4 grippers, 100 mm apart, roll a ply from its middle onto a dome of radius 0.6 m: the heights are
/// the dome's inside the front and curve away from it outside; one that has arrived stands.
fn rolling(steps: usize) -> Vec<Vec<Point>> {
    let places = |k: usize| {
        let front = 0.212 * k as f64 / (steps - 1) as f64;
        let place = |n: usize| {
            let [x, y] = [n % 4, n / 4].map(|m| 0.1 * (m as f64 - 1.5));
            let r = f64::hypot(x, y);
            let lifted = (r - front).max(0.0);
            let inwards = 1.0 - 0.3 * lifted;
            [x * inwards, y * inwards, -r * r / 1.2 + 2.0 * lifted * lifted]
        };
        (0..16).map(place).collect()
    };
    (0..steps).map(places).collect()
}

/// Down, then sideways: a right angle in the middle.
fn corner(steps: usize) -> Vec<Vec<Point>> {
    let leg = |k: usize| 0.3 * k as f64 / steps as f64;
    let down = (0..steps).map(|k| vec![[0.0, 0.0, 0.3 - leg(k)]]);
    down.chain((0..=steps).map(|k| vec![[leg(k), 0.0, 0.0]])).collect()
}

/// Uneven steps around a bend, one of them all but still.
fn uneven() -> Vec<Vec<Point>> {
    let angle = [0.0, 0.1, 0.15, 0.4, 0.40001, 0.6, 0.9, 0.91, 1.1, 1.5];
    angle.map(|a: f64| vec![[0.3 * a.cos(), 0.3 * a.sin(), 0.0], [0.1 * a, 0.0, 0.2]]).to_vec()
}

fn plans() -> Vec<Vec<Vec<Point>>> {
    vec![straight(0.5, 30), straight(0.01, 3), rolling(60), corner(30), uneven()]
}

/// Largest first, second and third differences of samples 1 ms apart: speed, acceleration, jerk.
fn differences(motion: &TimedMotion) -> [f64; 3] {
    let step: f64 = 1e-3;
    let count = (motion.duration() / step) as usize;
    let samples: Vec<_> = (0..=count).map(|k| motion.at(k as f64 * step)).collect();
    let mut rows = samples;
    [1, 2, 3].map(|order| {
        rows = rows.windows(2).map(|pair| differ(&pair[1], &pair[0])).collect();
        rows.iter().flatten().map(|d| norm(*d)).fold(0.0, f64::max) / step.powi(order)
    })
}

fn differ(a: &[Point], b: &[Point]) -> Vec<Point> {
    a.iter().zip(b).map(|(a, b)| [0, 1, 2].map(|k| a[k] - b[k])).collect()
}

/// The fastest motion over a length from rest to rest: with T_a the time to reach the top speed,
/// `T = L/v + T_a`; below the speed that a limit cuts off, T follows from the phases that are left.
fn fastest(length: f64, bounds: &Bounds) -> f64 {
    let Bounds { speed: v, acceleration: a, jerk: j } = *bounds;
    let rise = |v: f64| if v * j >= a * a { v / a + a / j } else { 2.0 * (v / j).sqrt() };
    if length >= v * rise(v) {
        return length / v + rise(v);
    }
    // No cruising: T = 2 T_a with top speed u, u T_a(u) = L.
    if length >= 2.0 * a.powi(3) / (j * j) {
        let u = 0.5 * (-a * a / j + (a.powi(4) / (j * j) + 4.0 * length * a).sqrt());
        return 2.0 * (u / a + a / j);
    }
    4.0 * (length / (2.0 * j)).cbrt()
}

/// Differences are means of derivatives, so they pass no limit; 1e-6 is their rounding.
#[test]
fn no_difference_of_samples_passes_a_limit() {
    for planned in plans() {
        let [speed, acceleration, jerk] = differences(&timed(&planned));
        assert!(speed <= BOUNDS.speed * (1.0 + 1e-9), "{speed}");
        assert!(acceleration <= BOUNDS.acceleration * (1.0 + 1e-6), "{acceleration}");
        assert!(jerk <= BOUNDS.jerk * (1.0 + 1e-6), "{jerk}");
    }
}

/// The peaks are what the samples show: never less, and no more than a sample can miss of a phase. Some
/// limit is all but reached.
#[test]
fn peaks_are_those_of_the_samples_and_some_limit_is_reached() {
    for planned in plans() {
        let motion = timed(&planned);
        let found = differences(&motion);
        let peaks = motion.peaks();
        let peaks = [peaks.speed, peaks.acceleration, peaks.jerk];
        let limits = [BOUNDS.speed, BOUNDS.acceleration, BOUNDS.jerk];
        for ((peak, found), limit) in peaks.iter().zip(found).zip(limits) {
            // 1e-4 is the tolerance of the peaks; a third difference of 3 ms cuts off short tops of jerk.
            assert!(
                found <= peak.value * (1.0 + 2e-4) && found >= 0.95 * peak.value,
                "{found} {peak:?}"
            );
            assert!(peak.value <= limit * (1.0 + 1e-12), "{peak:?} {limit}");
        }
        let reached =
            peaks.iter().zip(limits).map(|(p, limit)| p.value / limit).fold(0.0, f64::max);
        assert!(reached > 0.999, "{reached}");
        // A peak is at its gripper and time; jerk may jump there.
        let at = motion.velocity(peaks[0].time)[peaks[0].gripper];
        assert!((norm(at) - peaks[0].value).abs() < 1e-9);
        let at = motion.acceleration(peaks[1].time)[peaks[1].gripper];
        assert!((norm(at) - peaks[1].value).abs() < 1e-9);
    }
}

/// A straight path takes the closed form's time, whichever limits rule; 3e-4 is room for the peaks'
/// tolerance. On 0.5 m all three limits are reached.
#[test]
fn a_straight_motion_is_as_fast_as_the_closed_form() {
    let slow = Bounds { speed: 0.02, acceleration: 1.0, jerk: 10.0 };
    let gentle = Bounds { speed: 0.25, acceleration: 0.05, jerk: 10.0 };
    let loose = Bounds { speed: 0.25, acceleration: 1.0, jerk: 1e6 };
    for bounds in [BOUNDS, slow, gentle, loose] {
        for length in [1e-6, 1e-3, 0.03, 0.5, 20.0] {
            for steps in [2, 3, 4, 30] {
                let motion = TimedMotion::new(&straight(length, steps), &bounds).unwrap();
                let ratio = motion.duration() / fastest(length, &bounds);
                assert!(
                    (1.0 - 1e-9..1.0 + 3e-4).contains(&ratio),
                    "{ratio} {length} {steps} {bounds:?}"
                );
            }
        }
    }
    let peaks = *timed(&straight(0.5, 30)).peaks();
    assert!(peaks.speed.value > 0.999 * 0.25 && peaks.jerk.value > 0.999 * 10.0);
    assert!(peaks.acceleration.value > 0.999);
}

/// A right angle costs the time to slow down and speed up again, not a slow motion: at most the two legs
/// from rest to rest, and steps three times finer cost less than a third more.
#[test]
fn a_sharp_bend_is_slow_where_it_is() {
    let legs = 2.0 * fastest(0.3, &BOUNDS);
    let duration = timed(&corner(30)).duration();
    assert!(duration < legs, "{duration} {legs}");
    let finer = timed(&corner(90)).duration();
    assert!(finer < 4.0 / 3.0 * duration, "{finer} {duration}");
}

/// Rest is zero velocity and acceleration, to the last bit, and the positions are those of the plan.
#[test]
fn it_starts_and_ends_at_rest_at_the_exact_places() {
    for planned in plans() {
        let motion = timed(&planned);
        for (t, place) in [(0.0, &planned[0]), (motion.duration(), &planned[planned.len() - 1])] {
            assert_eq!(&motion.at(t), place);
            assert!(motion.velocity(t).iter().flatten().all(|x| *x == 0.0));
            assert!(motion.acceleration(t).iter().flatten().all(|x| *x == 0.0));
        }
        assert_eq!(motion.positions().first(), planned.first());
        assert_eq!(motion.positions().last(), planned.last());
        assert_eq!(motion.at(-1.0), planned[0]);
        assert_eq!(motion.at(f64::NAN), planned[0]);
        assert_eq!(&motion.at(1e9), &planned[planned.len() - 1]);
    }
}

/// Velocity, acceleration and jerk against central differences of the function before, at odd times away
/// from jumps of the jerk; the error of a difference is the square of its step times two derivatives more.
#[test]
fn derivatives_are_central_differences_of_one_another() {
    let h = 1e-5;
    for planned in plans() {
        let motion = timed(&planned);
        let mut jumps = 0;
        for k in 1..200 {
            let t = motion.duration() * (k as f64 + 0.3179) / 201.0;
            let central = |f: &dyn Fn(f64) -> Vec<Point>| -> Vec<Point> {
                differ(&f(t + h), &f(t - h)).iter().map(|d| d.map(|x| x / (2.0 * h))).collect()
            };
            let close = |a: Vec<Point>, b: Vec<Point>, tolerance: f64| {
                differ(&a, &b).iter().flatten().all(|x| x.abs() < tolerance)
            };
            assert!(close(central(&|t| motion.at(t)), motion.velocity(t), 1e-8));
            assert!(close(central(&|t| motion.velocity(t)), motion.acceleration(t), 2e-4));
            if !close(central(&|t| motion.acceleration(t)), motion.jerk(t), 0.05) {
                jumps += 1;
            }
        }
        // A jump within 10 µs of one of 199 times is rare.
        assert!(jumps <= 1, "{jumps}");
    }
}

/// A gripper that stands, at first, at last or always, does not move by a bit.
#[test]
fn a_standing_gripper_stands_still_to_the_last_bit() {
    let place = [0.1234567, -0.7654321, 1.0 / 3.0];
    let mut planned = corner(20);
    for (k, step) in planned.iter_mut().enumerate() {
        let away = |moved: usize| [place[0], place[1], place[2] + 0.01 * moved as f64];
        step.extend([place, away(k.saturating_sub(25)), away(15_usize.saturating_sub(k))]);
    }
    let motion = timed(&planned);
    let times = motion.times();
    for k in 0..=5000 {
        let t = motion.duration() * k as f64 / 5000.0;
        let at = motion.at(t);
        assert_eq!(at[1], place);
        // Control points reach two knots far.
        if t < times[24] {
            assert_eq!(at[2], place);
        }
        if t >= times[16] {
            assert_eq!(at[3], place);
        }
        assert_eq!(motion.velocity(t)[1], [0.0; 3]);
    }
    assert_ne!(motion.at(0.5 * (times[24] + times[25]))[2], place);
    assert_ne!(motion.at(0.5 * (times[15] + times[16]))[3], place);
}

/// No gripper leaves the box of its planned positions, so none dips below where it lands.
#[test]
fn no_gripper_leaves_the_hull_of_its_plan() {
    let planned = rolling(40);
    let motion = timed(&planned);
    for t in motion.samples(500.0).unwrap() {
        for (g, at) in motion.at(t).iter().enumerate() {
            for c in 0..3 {
                let values = || planned.iter().map(|step| step[g][c]);
                let low = values().fold(f64::INFINITY, f64::min);
                let high = values().fold(f64::NEG_INFINITY, f64::max);
                assert!(at[c] >= low - 1e-15 && at[c] <= high + 1e-15);
            }
        }
    }
}

/// Grippers share one parameter: where all are planned as fixed affine images of one, they are so at every
/// time, around every bend; and at the knots the shape is a mean of the three planned ones around it.
#[test]
fn the_sequence_of_shapes_is_the_planned_one() {
    let mut planned = uneven();
    for step in &mut planned {
        let [x, y, z] = step[0];
        step[1] = [0.3 - 0.2 * y, 0.5 * x + 0.1, 0.25 * z + 0.125 * x];
    }
    let motion = timed(&planned);
    for t in motion.samples(300.0).unwrap() {
        let at = motion.at(t);
        let [x, y, z] = at[0];
        let image = [0.3 - 0.2 * y, 0.5 * x + 0.1, 0.25 * z + 0.125 * x];
        assert!(norm(differ(&[image], &[at[1]])[0]) < 1e-15);
    }
    let planned = rolling(60);
    let motion = timed(&planned);
    assert_eq!(motion.times().len(), planned.len());
    for (k, (t, positions)) in motion.times().iter().zip(motion.positions()).enumerate() {
        let farthest =
            |other: &[Point]| differ(positions, other).into_iter().map(norm).fold(0.0, f64::max);
        let around = &planned[k.saturating_sub(1)..(k + 2).min(planned.len())];
        let step = around
            .windows(2)
            .map(|p| differ(&p[1], &p[0]).into_iter().map(norm).fold(0.0, f64::max));
        assert!(farthest(&planned[k]) <= step.fold(0.0, f64::max));
        // The law meets the knot's time to rounding.
        assert!(farthest(&motion.at(*t)) < 1e-14);
    }
}

#[test]
fn times_ascend_strictly_from_zero_to_the_end() {
    for planned in plans() {
        let motion = timed(&planned);
        let times = motion.times();
        assert_eq!((times[0], times[times.len() - 1]), (0.0, motion.duration()));
        assert!(times.windows(2).all(|pair| pair[0] < pair[1]), "{times:?}");
        assert_eq!(times.len(), motion.positions().len());
        let steps = motion.steps();
        assert_eq!((&steps.times[..], &steps.positions[..]), (times, motion.positions()));
    }
}

#[test]
fn the_same_plan_gives_the_same_bits() {
    let planned = rolling(30);
    assert_eq!(timed(&planned), timed(&planned));
}

/// Steps in which nothing moves are merged; they are no stops on the way.
#[test]
fn a_plan_that_waits_is_not_slower() {
    let planned = rolling(40);
    let waiting: Vec<_> = planned.iter().flat_map(|step| vec![step.clone(); 3]).collect();
    assert_eq!(timed(&waiting), timed(&planned));
}

/// One position, or one again and again, is a motion of no duration.
#[test]
fn a_path_of_no_length_takes_no_time() {
    for steps in [1, 2, 5] {
        let planned = vec![vec![[0.1, 0.2, 0.3], [0.4, 0.5, 0.6]]; steps];
        let motion = timed(&planned);
        assert_eq!((motion.duration(), motion.times()), (0.0, &[0.0][..]));
        assert_eq!(motion.positions(), &planned[..1]);
        assert_eq!(motion.sampled(100.0).unwrap(), motion.steps());
        assert_eq!(motion.jerk(0.0), vec![[0.0; 3]; 2]);
        assert_eq!(motion.peaks().speed.value, 0.0);
    }
}

#[test]
fn what_cannot_be_timed_is_refused_with_its_place() {
    let refused = |planned: &[Vec<Point>]| TimedMotion::new(planned, &BOUNDS).unwrap_err();
    assert_eq!(refused(&[]), LayupError::MotionEmpty);
    assert_eq!(refused(&[vec![], vec![]]), LayupError::MotionEmpty);
    let mut planned = straight(0.1, 4);
    planned[2].pop();
    assert_eq!(refused(&planned), LayupError::MotionUnequal { step: 3, found: 1, expected: 2 });
    for strange in [f64::NAN, f64::INFINITY, -1e300] {
        let mut planned = straight(0.1, 4);
        planned[3][1][2] = strange;
        assert!(matches!(refused(&planned), LayupError::MotionFar { step: 4, gripper: 1, .. }));
    }
    for strange in [f64::NAN, f64::INFINITY, 0.0, -1.0, 1e-300, 1e300] {
        let bounds = Bounds { jerk: strange, ..BOUNDS };
        let refused = TimedMotion::new(&straight(0.1, 4), &bounds).unwrap_err();
        assert!(matches!(refused, LayupError::MotionLimit { quantity: "jerk", .. }), "{refused}");
    }
}

/// Samples are 1/rate apart, the last at the end and not right after another; a rate that gives more than
/// a scene may hold is refused, with one that would do.
#[test]
fn samples_end_at_the_end_and_are_limited() {
    let motion = timed(&straight(0.5, 10));
    let times = motion.samples(100.0).unwrap();
    assert_eq!(times.last(), Some(&motion.duration()));
    assert!(times.windows(2).all(|pair| pair[1] - pair[0] <= 0.01 + 1e-12 && pair[0] < pair[1]));
    let whole = motion.samples(10.0 / motion.duration()).unwrap();
    assert_eq!(whole.len(), 11);
    for rate in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(motion.samples(rate), Err(LayupError::MotionRate { .. })));
    }
    for rate in [1e7, 1e300] {
        let Err(LayupError::MotionTooManySamples { largest_rate, .. }) = motion.samples(rate)
        else {
            panic!("{rate} Hz")
        };
        assert!(motion.samples(0.999 * largest_rate).is_ok());
        let fitting = motion.fitting_rate(rate);
        assert!((0.009..=0.01).contains(&(fitting / largest_rate)), "{fitting} {largest_rate}");
    }
    assert_eq!(motion.fitting_rate(100.0), 100.0);
}

/// A turn by an angle about an axis.
fn turn(angle: f64, axis: Point) -> Quaternion {
    let (s, c) = (0.5 * angle).sin_cos();
    let length = norm(axis);
    [s * axis[0] / length, s * axis[1] / length, s * axis[2] / length, c]
}

fn dot(a: &Quaternion, b: &Quaternion) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Signs of the steps are turned at random; the samples are unit and close to their neighbors, and between
/// steps the angle from one sample to the next is the same.
#[test]
fn attitudes_are_unit_continuous_and_turn_steadily_between_steps() {
    let times = [0.0, 0.3, 1.0, 1.1, 2.0];
    let angles = [0.0, 0.4, 2.9, 2.9, -0.2];
    let signs = [1.0, -1.0, -1.0, 1.0, -1.0];
    let steps: Vec<Vec<Quaternion>> = (0..5)
        .map(|k| {
            let tilted = turn(angles[k], [1.0, 2.0, -0.5]);
            vec![tilted.map(|c| signs[k] * c), turn(1e-9 * k as f64, [1.0, 0.0, 0.0])]
        })
        .collect();
    let attitudes = Attitudes::new(&times, &steps).unwrap();
    for (k, pair) in times.windows(2).enumerate() {
        let samples: Vec<_> = (0..=50)
            .map(|n| attitudes.at(pair[0] + (pair[1] - pair[0]) * f64::from(n) / 50.0))
            .collect();
        let expected = (angles[k + 1] - angles[k]).abs() / 50.0;
        for near in samples.windows(2) {
            for (a, b) in near[0].iter().zip(&near[1]) {
                assert!((dot(a, a) - 1.0).abs() < 1e-14);
                assert!(dot(a, b) > 0.99, "a sign turns");
            }
            // |a − b| = 2 sin(angle/4).
            let chord = (0..4).map(|c| (near[0][0][c] - near[1][0][c]).powi(2)).sum::<f64>().sqrt();
            assert!((4.0 * (0.5 * chord).asin() - expected).abs() < 1e-13, "{chord} {expected}");
        }
    }
    for (t, step) in times.iter().zip(&steps) {
        for (a, b) in attitudes.at(*t).iter().zip(step) {
            assert!((dot(a, b).abs() - 1.0).abs() < 1e-15);
        }
    }
    assert_eq!(attitudes.at(-1.0), attitudes.at(0.0));
    assert_eq!(attitudes.at(9.0), attitudes.at(2.0));
}

#[test]
fn attitudes_without_a_meaning_are_refused() {
    let level = vec![[0.0, 0.0, 0.0, 1.0]];
    let two = [level.clone(), level.clone()];
    assert_eq!(Attitudes::new(&[], &[]), Err(LayupError::MotionEmpty));
    for times in [&[0.0][..], &[0.0, 0.0], &[1.0, 0.0], &[0.0, f64::NAN], &[0.0, f64::INFINITY]] {
        assert!(
            matches!(Attitudes::new(times, &two), Err(LayupError::AttitudeTimes { .. })),
            "{times:?}"
        );
    }
    let unequal = [level.clone(), [level.clone(), level.clone()].concat()];
    assert!(matches!(
        Attitudes::new(&[0.0, 1.0], &unequal),
        Err(LayupError::MotionUnequal { step: 2, .. })
    ));
    for strange in [0.0, f64::NAN, 3.0] {
        let strange = [level.clone(), vec![[0.0, 0.0, 0.0, strange]]];
        let refused = Attitudes::new(&[0.0, 1.0], &strange).unwrap_err();
        assert!(matches!(refused, LayupError::AttitudeQuaternion { step: 2, gripper: 0, .. }));
    }
}

/// The dense table has the columns of `trajectory.csv`, and a scene follows it to the last bit.
#[test]
fn a_scene_follows_the_dense_table() {
    let motion = timed(&rolling(30));
    let level = vec![[0.0, 0.0, 0.0, 1.0]; 16];
    let attitudes = Attitudes::new(&[0.0, motion.duration()], &[level.clone(), level]).unwrap();
    let ply = paper_ply(4, 4);
    let table = csv::motion(&motion, &attitudes, &ply, 100.0).unwrap();
    assert_eq!(table.lines().next(), Some("t (s),gripper,x (m),y (m),z (m),qx,qy,qz,qw"));

    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("motion.csv"), &table).unwrap();
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [4, 4]\ncell = [0.12, 0.12]\nmaterial = \"krogh2018\"\n\
        [motion]\nkind = \"file\"\nfile = \"motion.csv\"\n";
    let scene = scene::parse(text, folder.path(), "scene").unwrap_or_else(|e| panic!("{e}")).scene;
    assert_eq!(scene.layup.motion, motion.sampled(100.0).unwrap());

    let other = paper_ply(4, 3);
    let refused = csv::motion(&motion, &attitudes, &other, 100.0);
    let expected = LayupError::MotionGrippers { found: ply.grippers(), expected: other.grippers() };
    assert_eq!(refused.unwrap_err().to_string(), expected.to_string());
}

/// A motion, its start and heights as a spreadsheet of another country saves them again are the same scene.
#[test]
fn tables_of_a_spreadsheet_are_the_same_scene() {
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
        [mold]\nkind = \"height-grid\"\nfile = \"heights.csv\"\n";
    let moved = format!("{text}[target]\n[motion]\nkind = \"file\"\nfile = \"motion.csv\"\n");
    let started = format!("{text}[grippers]\npositions = \"start.csv\"\n");
    let mut heights = "x (mm),y (mm),z (mm)\n".to_owned();
    for node in 0..16 {
        heights +=
            &format!("{},{},9.70{}\n", 100 * (node % 4) - 150, 100 * (node / 4) - 150, node % 3);
    }
    let motion = "t (s),gripper,x (mm),y (mm),z (mm)\n0,g0_0,0,0,50.5\n0,g1_0,98,0,50.5\n1,g0_0,0,0,25\n1,g1_0,98,0,25\n";
    let start = "i,j,x (mm),y (mm),z (mm)\n0,0,0,0,50.5\n1,0,98,0,50.5\n";
    let scenes = |change: &dyn Fn(&str) -> String| {
        let folder = tempfile::tempdir().unwrap();
        for (name, table) in [("heights", heights.as_str()), ("motion", motion), ("start", start)] {
            std::fs::write(folder.path().join(format!("{name}.csv")), change(table)).unwrap();
        }
        [&moved, &started].map(|text| {
            let scene = scene::parse(text, folder.path(), "scene");
            let scene = scene.unwrap_or_else(|e| panic!("{e}")).scene;
            (scene.layup.motion, scene.layup.mold)
        })
    };
    let plain = scenes(&|table| table.to_owned());
    let comma = |table: &str| table.replace(',', ";").replace('.', ",");
    assert_eq!(scenes(&comma), plain);
    assert_eq!(scenes(&|table| table.replace(',', "\t")), plain);
    assert_eq!(scenes(&|table| table.replace('(', "[").replace(')', "]").replace('x', "X")), plain);
    assert_eq!(scenes(&|table| format!("Messung vom 3.4.\r\n\r\n{}", comma(table))), plain);
}

/// Random smooth paths of two grippers: sums of a few waves and a straight way, uneven steps.
fn waves() -> impl Strategy<Value = Vec<Vec<Point>>> {
    let wave = prop::array::uniform6(-0.1..0.1_f64);
    let steps = prop::collection::vec(0.05..1.0_f64, 2..60);
    (prop::collection::vec(wave, 4), steps).prop_map(|(waves, steps)| {
        let total: f64 = steps.iter().sum();
        let mut share = 0.0;
        let mut planned = Vec::new();
        for step in std::iter::once(&0.0).chain(&steps) {
            share += step / total;
            let place = |n: usize| {
                [0, 1, 2].map(|c| {
                    let [a, b] = [waves[2 * n], waves[2 * n + 1]];
                    a[c] * share
                        + b[c] * (4.0 * share + a[c + 3]).sin()
                        + 0.3 * b[c + 3] * (9.0 * share).cos()
                })
            };
            planned.push(vec![place(0), place(1)]);
        }
        planned
    })
}

proptest! {
    #![proptest_config(cases(60))]

    /// On any smooth path: limits hold, one is reached, ends are exact, times ascend.
    #[test]
    fn limits_hold_on_random_smooth_paths(
        planned in waves(),
        speed in 0.05..1.0_f64,
        acceleration in 0.1..5.0_f64,
        jerk in 1.0..100.0_f64,
    ) {
        let bounds = Bounds { speed, acceleration, jerk };
        let motion = TimedMotion::new(&planned, &bounds).unwrap();
        let found = differences(&motion);
        prop_assert!(found[0] <= speed * (1.0 + 1e-9), "{found:?} {bounds:?}");
        prop_assert!(found[1] <= acceleration * (1.0 + 1e-6), "{found:?} {bounds:?}");
        prop_assert!(found[2] <= jerk + 1e-5, "{found:?} {bounds:?}");
        let peaks = motion.peaks();
        let reached = (peaks.speed.value / speed)
            .max(peaks.acceleration.value / acceleration)
            .max(peaks.jerk.value / jerk);
        prop_assert!(reached > 0.999 && reached <= 1.0 + 1e-12, "{reached}");
        prop_assert_eq!(&motion.at(0.0), &planned[0]);
        prop_assert_eq!(Some(&motion.at(motion.duration())), planned.last());
        prop_assert!(motion.times().windows(2).all(|pair| pair[0] < pair[1]));
    }
}
