//! The time-optimal law against closed forms and bounds.

use super::*;
use crate::geometry::vector::sub;
use std::f64::consts::PI;

const BOUNDS: Bounds = Bounds { speed: 0.25, acceleration: 1.0, jerk: 10.0 };

/// The quickest motion under the bounds of its grippers alone, of a motion that is slower than it need be.
fn quickest(motion: &TimedMotion, slower: f64, bounds: &Bounds) -> TimedMotion {
    let slow = motion.slowed(slower);
    let course = Quickening::new(&slow).unwrap();
    course.quickest(bounds, &course.grippers(bounds)).0
}

/// Steps of one gripper along a curve over 0 … 1.
fn along(curve: impl Fn(f64) -> [f64; 3], steps: usize) -> Vec<Vec<[f64; 3]>> {
    (0..=steps).map(|k| vec![curve(k as f64 / steps as f64)]).collect()
}

/// However slow a straight motion is at first, it ends within 1 % of the closed form of its bounds, which the law of seven phases
/// takes, whichever bounds rule.
#[test]
fn a_slow_straight_motion_becomes_the_closed_form() {
    let gentle = Bounds { acceleration: 0.1, ..BOUNDS };
    let jerky = Bounds { jerk: 1e3, ..BOUNDS };
    for bounds in [BOUNDS, gentle, jerky] {
        for length in [0.02, 0.5] {
            let steps = along(|x| [length * x, 0.0, 0.0], 20);
            let shortest = TimedMotion::new(&steps, &bounds).unwrap();
            for slower in [1.0, 1.5, 6.0] {
                let found = quickest(&shortest, slower, &bounds).duration();
                let ratio = found / shortest.duration();
                assert!((0.9998..1.01).contains(&ratio), "{ratio} {slower} {length} {bounds:?}");
            }
        }
    }
}

/// Around a circle the speed v that is gained along it leaves for the turn `v²/r ≤ a`, so `v̇ = √(a² − v⁴/r²)`: the time to half the
/// way is found by small steps of that. The bound of jerk is out of reach.
#[test]
fn around_a_circle_speed_and_turn_share_the_acceleration() {
    let (radius, bounds) = (0.2, Bounds { speed: 10.0, acceleration: 1.0, jerk: 1e4 });
    let steps = along(|x| [radius * (PI * x).cos(), radius * (PI * x).sin(), 0.0], 60);
    let motion = TimedMotion::new(&steps, &bounds).unwrap();
    let found = quickest(&motion, 1.0, &bounds).duration();

    let (mut way, mut speed, mut time, step) = (0.0, 0.0_f64, 0.0, 1e-5);
    while way < 0.5 * PI * radius {
        let left = (bounds.acceleration.powi(2) - (speed * speed / radius).powi(2)).max(0.0);
        speed += step * left.sqrt();
        way += step * speed;
        time += step;
    }
    let ratio = found / (2.0 * time);
    // a spline of sixty steps passes on the inner side, by 5e-4 of the radius
    assert!((0.995..1.02).contains(&ratio), "{ratio}: {found} against {}", 2.0 * time);
}

/// A random path of three grippers: no fine sample passes a bound, start and end are at rest, and the places are the same.
#[test]
fn no_sample_passes_a_bound_and_the_places_stay() {
    let curve =
        |x: f64, g: f64| [0.4 * x, 0.1 * (5.0 * x + g).sin(), 0.05 * (11.0 * x * x + g).cos()];
    let steps: Vec<Vec<[f64; 3]>> =
        (0..=40).map(|k| [0.0, 0.7, 1.9].map(|g| curve(f64::from(k) / 40.0, g)).to_vec()).collect();
    let motion = TimedMotion::new(&steps, &BOUNDS).unwrap();
    let course = Quickening::new(&motion).unwrap();
    let (found, limiting) = course.quickest(&BOUNDS, &course.grippers(&BOUNDS));
    assert!(limiting.iter().all(|l| l.share <= 1.0 + 1e-9));
    assert!(
        found.duration() < 0.95 * motion.duration(),
        "{} {}",
        found.duration(),
        motion.duration()
    );
    let limits = [BOUNDS.speed, BOUNDS.acceleration, BOUNDS.jerk];
    let peaks = found.peaks();
    let peaks = [peaks.speed, peaks.acceleration, peaks.jerk].map(|peak| peak.value);
    assert!((0..3).all(|n| peaks[n] <= limits[n] * (1.0 + 1e-9)), "{peaks:?}");
    assert!((0..3).any(|n| peaks[n] >= limits[n] * (1.0 - 1e-3)), "{peaks:?}");
    for k in 0..=20_000 {
        let t = found.duration() * f64::from(k) / 20_000.0;
        for (n, limit) in limits.into_iter().enumerate() {
            assert!(found.rate(t, n).iter().all(|rate| norm(*rate) <= limit * (1.0 + 1e-9)), "{t}");
        }
    }
    for t in [0.0, found.duration()] {
        assert!(
            found.velocity(t).iter().chain(&found.acceleration(t)).flatten().all(|x| *x == 0.0)
        );
    }
    assert_eq!(found.positions(), motion.positions());
    for k in 0..=100 {
        let t = motion.duration() * f64::from(k) / 100.0;
        let [a, b] = [motion.at(t), found.at(found.same_place(&motion, t))];
        assert!((0..3).all(|g| norm(sub(a[g], b[g])) < 1e-12));
    }
}

/// A bound that counts for a tenth of the way costs time there, and not elsewhere: the whole takes what both parts take, and the
/// time to slow down and to speed up between them.
#[test]
fn a_bound_of_a_part_slows_that_part() {
    let bounds = Bounds { speed: 0.25, acceleration: 2.0, jerk: 100.0 };
    let steps = along(|x| [x, 0.0, 0.0], 50);
    let motion = TimedMotion::new(&steps, &bounds).unwrap();
    let slowest = 0.025;
    let slow = motion.slowed(10.0);
    let course = Quickening::new(&slow).unwrap();
    let mut moving = course.grippers(&bounds);
    let within = |t: f64| (0.45..0.55).contains(&slow.at(t)[0][0]);
    let mut part = moving[0].clone();
    part.bounds = [slowest, f64::INFINITY, f64::INFINITY];
    for (rates, t) in part.rates.iter_mut().zip(course.times()) {
        if !within(*t) {
            rates[0] = [0.0; 3];
        }
    }
    moving.push(part);
    let (found, limiting) = course.quickest(&bounds, &moving);
    let least = motion.duration() - 0.1 / bounds.speed + 0.1 / slowest;
    let ramps = 2.0 * (bounds.speed / bounds.acceleration + bounds.acceleration / bounds.jerk);
    let takes = found.duration();
    assert!((least..least + ramps).contains(&takes), "{takes} {least} {ramps}");
    let slowed: f64 = limiting.iter().filter(|l| l.moving == 1).map(|l| l.time).sum();
    assert!((slowed / (0.1 / slowest) - 1.0).abs() < 0.05, "{slowed}");
    let all: f64 = limiting.iter().map(|l| l.time).sum();
    assert!((all / takes - 1.0).abs() < 1e-6, "{all} {takes}");
}

/// Other bounds until some step hold until there and not behind: each part takes what it takes with its own bounds, but for the way on which the motion
/// slows down from one to the other.
#[test]
fn the_first_part_of_a_motion_may_be_faster() {
    let fast = Bounds { speed: 1.0, acceleration: 4.0, jerk: 80.0 };
    let motion = TimedMotion::new(&along(|x| [x, 0.0, 0.0], 50), &BOUNDS).unwrap();
    let until = motion.times()[30];
    let course = Quickening::new(&motion).unwrap().with_early(until, fast);
    let (found, _) = course.quickest(&BOUNDS, &course.grippers(&BOUNDS));
    let within = |[t0, t1]: [f64; 2], bounds: &Bounds| {
        let peaks = found.peaks_within([t0, t1]);
        let limits = [bounds.speed, bounds.acceleration, bounds.jerk];
        let shares = [peaks.speed, peaks.acceleration, peaks.jerk];
        (0..3).map(|n| shares[n].value / limits[n]).fold(0.0, f64::max)
    };
    let between = found.same_place(&motion, until);
    for (times, bounds) in [([0.0, between], &fast), ([between, found.duration()], &BOUNDS)] {
        let most = within(times, bounds);
        assert!((0.99..1.0 + 1e-9).contains(&most), "{most} {times:?}");
    }
    // as fast as either for the whole way, and the time to slow down from 1 to 0.25 m/s on 0.6 m
    let [all, none] = [&fast, &BOUNDS]
        .map(|bounds| TimedMotion::new(motion.positions(), bounds).unwrap().duration());
    let due = 0.6 * all + 0.4 * none;
    assert!((0.9..1.25).contains(&(found.duration() / due)), "{} {due}", found.duration());
}

/// The quickest of the quickest is no quicker by more than half a percent: the rounds have come to their end.
#[test]
fn the_quickest_motion_has_none_quicker() {
    let curve = |x: f64| [0.3 * (4.0 * x).cos(), 0.3 * (4.0 * x).sin(), 0.1 * (9.0 * x).sin()];
    let motion = TimedMotion::new(&along(curve, 30), &BOUNDS).unwrap();
    let once = quickest(&motion, 1.0, &BOUNDS);
    let twice = quickest(&once, 1.0, &BOUNDS);
    assert!(twice.duration() > 0.995 * once.duration(), "{} {}", once.duration(), twice.duration());
    // however slow it was at first
    let slow = quickest(&motion, 4.0, &BOUNDS);
    assert!(
        (slow.duration() / once.duration() - 1.0).abs() < 0.01,
        "{} {}",
        slow.duration(),
        once.duration()
    );
}
