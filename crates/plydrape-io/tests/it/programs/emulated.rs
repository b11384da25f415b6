//! Programs run on emulated controllers at reduced speed, late, stopped and resumed: the array stays where it belongs to the place of the arm.
//!
//! An emulated controller is made from what was read of a program's text, by the rules of the makers: it goes along the way between two points and moves
//! its external axes by the same share. The array follows the progress by the table `NAME_cam.csv`, a cycle later.

use super::cell::{Played, cell, product, still, text, towards};
use super::script::Arm;
use super::{files, names, played};
use plydrape::geometry::vector::{distance, dot, sub};
use plydrape::mold::Pose;
use plydrape_io::Files;
use plydrape_io::robot::program::{Program, Robot, Tolerance, template};

/// A cam as its controller has it: rows of the progress (mm) with the strokes (m).
struct Cam(Vec<Vec<f64>>);

impl Cam {
    fn read(files: &Files) -> Self {
        let n = names(files).iter().position(|name| name.ends_with("_cam.csv")).unwrap();
        let text = text(files, n);
        let rows = text.lines().skip(1);
        let cam = Cam(rows.map(|r| r.split(',').map(|c| c.parse().unwrap()).collect()).collect());
        assert!(cam.0.windows(2).all(|pair| pair[0][0] < pair[1][0]), "the progress grows");
        assert_eq!((cam.0[0][0], cam.0[cam.0.len() - 1][0]), (0.0, 1000.0));
        cam
    }

    fn strokes(&self, progress: f64) -> Vec<f64> {
        let rows = &self.0;
        let after = rows.partition_point(|row| row[0] < progress).clamp(1, rows.len() - 1);
        let [a, b] = [&rows[after - 1], &rows[after]];
        let share = ((progress - a[0]) / (b[0] - a[0])).clamp(0.0, 1.0);
        (1..a.len()).map(|n| a[n] + share * (b[n] - a[n])).collect()
    }
}

/// How far the strokes are from those that belong to the place of the arm: where it is nearest to the way of the program, not far from the sample `near`.
fn off(program: &Program, center: &[Pose], arm: &Pose, strokes: &[f64], near: &mut usize) -> f64 {
    let away = |pose: &Pose| distance(pose.position, arm.position);
    let around = near.saturating_sub(150)..(*near + 150).min(center.len());
    *near = around.min_by(|a, b| away(&center[*a]).total_cmp(&away(&center[*b]))).unwrap();
    let k = *near;
    // the strokes of the samples around, and between them where the arm is between
    let strokes_at = |k: usize| program.axes.iter().map(move |axis| axis.values[k]);
    let mut least = f64::INFINITY;
    for pair in [[k.saturating_sub(1), k], [k, (k + 1).min(center.len() - 1)]] {
        let way = sub(center[pair[1]].position, center[pair[0]].position);
        let square = dot(way, way);
        let part = sub(arm.position, center[pair[0]].position);
        let share = if square > 0.0 { (dot(part, way) / square).clamp(0.0, 1.0) } else { 0.0 };
        let due = strokes_at(pair[0]).zip(strokes_at(pair[1])).map(|(a, b)| a + share * (b - a));
        let worst = due.zip(strokes).map(|(due, is)| (due - is).abs()).fold(0.0, f64::max);
        least = least.min(worst);
    }
    least
}

fn centers(program: &Program) -> Vec<Pose> {
    let flange = program.flange.as_ref().unwrap();
    flange.iter().map(|pose| product(pose, &program.frames.tool)).collect()
}

/// The largest error of the strokes while the controller of an arm plays its points: `override_at` says its speed as a share, over time; `by_clock` has an array
/// that keeps time by itself instead.
fn worst(
    program: &Program,
    played: &Played,
    cam: &Cam,
    override_at: impl Fn(f64) -> f64,
    by_clock: bool,
) -> f64 {
    let center = centers(program);
    let cycle = 0.004;
    let (mut clock, mut rate, mut time, mut worst) = (0.0, 0.0, 0.0, 0.0_f64);
    let (mut seen, mut near) = (0.0, 0);
    while clock < super::cell::DURATION && time < 120.0 {
        // the speed changes within some tenths of a second
        let wanted: f64 = override_at(time);
        rate += (wanted - rate).clamp(-5.0 * cycle, 5.0 * cycle);
        clock += rate * cycle;
        time += cycle;
        let points = &played.points;
        let after = points.partition_point(|p| p.time < clock).clamp(1, points.len() - 1);
        let [from, to] = [&points[after - 1], &points[after]];
        let span = to.time - from.time;
        let share = if span > 0.0 { ((clock - from.time) / span).clamp(0.0, 1.0) } else { 1.0 };
        let arm = towards(&from.pose, &to.pose, share);
        let progress = 1e3 * (from.axes[0] + share * (to.axes[0] - from.axes[0]));
        let strokes = match by_clock {
            false => cam.strokes(seen),
            true => {
                let k = program.times.partition_point(|t| *t < time).min(program.times.len() - 1);
                program.axes.iter().map(|axis| axis.values[k]).collect()
            }
        };
        worst = worst.max(off(program, &center, &arm, &strokes, &mut near));
        seen = progress;
    }
    worst
}

/// With any override, started late, stopped and resumed, the strokes are within 0.5 mm of where they belong, though the times of thinned points alone are off by
/// more; with an array that keeps time by itself they are off by centimeters.
#[test]
fn an_array_that_follows_the_progress_is_where_it_belongs_at_any_speed() {
    let program = still(cell(12, 1001));
    for robot in [Robot::Rapid, Robot::Krl] {
        let files = template::files(&program, robot, &[], &Tolerance::default()).unwrap();
        let (played, cam) = (played(robot, &files), Cam::read(&files));
        for (what, speed) in [
            ("full speed", Box::new(|_| 1.0) as Box<dyn Fn(f64) -> f64>),
            ("90 %", Box::new(|_| 0.9)),
            ("50 %", Box::new(|_| 0.5)),
            ("10 %", Box::new(|_| 0.1)),
            ("half a second late", Box::new(|t| f64::from(u8::from(t > 0.5)))),
            ("stopped and resumed", Box::new(|t| f64::from(u8::from(!(2.0..5.0).contains(&t))))),
            ("an emergency stop", Box::new(|t| f64::from(u8::from(t < 3.0)))),
        ] {
            let coupled = worst(&program, &played, &cam, &speed, false);
            assert!(coupled < 5e-4, "{robot:?}, {what}: {coupled}");
            let alone = worst(&program, &played, &cam, &speed, true);
            assert!(alone > 5e-3 || what == "full speed", "{robot:?}, {what}: {alone}");
        }
    }
}

/// A stream of `servoj` goes on only as the arm follows: at any slider, through a pause and a protective stop, the register is the arm's own progress, and the vacuum
/// is switched where the arm is at its point and still.
#[test]
fn a_script_waits_for_its_arm_and_says_where_that_is() {
    let program = still(cell(12, 1001));
    let files = files(&program, Robot::Urscript, 1e-4);
    let cam = Cam::read(&files);
    let (center, name) = (centers(&program), names(&files)[0].trim_end_matches(".script"));
    let in_base: Vec<Pose> = center.iter().map(|p| product(&program.frames.mold, p)).collect();
    let released = program.times.iter().position(|t| *t >= 4.8).unwrap();
    for (what, slider, longer) in [
        ("full speed", Box::new(|_| 1.0) as Box<dyn Fn(f64) -> f64>, 1.0),
        ("90 %", Box::new(|_| 0.9), 1.0),
        ("50 %", Box::new(|_| 0.5), 1.0),
        ("10 %", Box::new(|_| 0.1), 2.0),
        ("a pause", Box::new(|t| f64::from(u8::from(!(2.0..4.5).contains(&t)))), 1.2),
    ] {
        let mut arm = Arm::new(slider);
        arm.run(&[&text(&files, 1), &text(&files, 0)], name);
        assert!(!arm.halted && arm.said == 0, "{what}");
        let last = arm.moments.last().unwrap();
        assert!(last.time > longer * 9.9 && last.register == 1000.0, "{what}: {}", last.time);
        let (mut worst, mut near) = (0.0_f64, 0);
        for moment in &arm.moments {
            worst = worst.max(off(
                &program,
                &in_base,
                &moment.arm,
                &cam.strokes(moment.register),
                &mut near,
            ));
        }
        // the progress is found from the lag, which is large where the arm is slowed
        let most = if what == "full speed" || what == "90 %" { 2e-3 } else { 1e-2 };
        assert!(worst < most, "{what}: {worst}");
        println!("{what}: {worst} m");
        for pair in arm.moments.windows(2) {
            if pair[1].vacuum < pair[0].vacuum {
                let due = if pair[1].vacuum > 1 { released } else { center.len() - 1 };
                let away = distance(pair[0].arm.position, in_base[due].position);
                assert!(away < 1e-3, "{what}: released {away} m from its place");
            }
        }
    }
}

/// An arm that does not come to its point keeps the ply: the program ends with a message, and no vacuum is switched off.
#[test]
fn a_script_whose_arm_does_not_come_keeps_the_vacuum() {
    let program = still(cell(12, 1001));
    let files = files(&program, Robot::Urscript, 1e-4);
    let name = names(&files)[0].trim_end_matches(".script");
    let mut arm = Arm::new(|t| if t < 9.85 { 1.0 } else { 0.0 });
    arm.run(&[&text(&files, 1), &text(&files, 0)], name);
    assert!(arm.halted && arm.said == 1);
    let held = arm.moments.last().unwrap().vacuum;
    assert_eq!(held, 2, "what was not released before is held");
}
