//! What a corrected plan keeps and what it changes, on a small ply that is carried over the flank of a dome, turned, and laid on its top.

use super::*;
use crate::Error;
use crate::bodies::{Bodies, Body, Mount, Obstacle, Shape};
use crate::clearance::{self, Poses};
use crate::geometry::vector::{distance, norm, sub};
use crate::layup::{Layup, Model, Settings, SheetSettings, Target};
use crate::material::{Section, ShearCurve, TensionLaw};
use crate::measure::{Limits, Name, Scope, Verdict};
use crate::mold::{Face, Mold, Pose, Sphere};
use crate::motion::Motion;
use crate::outcome::{Drape, simulate};
use crate::planner::evaluation::clearance_verdict;
use crate::planner::sample::cloth;
use crate::ply::Grid;
use crate::scene::PlanMethod;
use crate::tool::{Axis, Tool};
use std::f64::consts::FRAC_PI_6;
use std::ops::ControlFlow;

type Steps = Vec<Vec<[f64; 3]>>;

const GRID: Grid = Grid { nu: 3, nv: 2 };
/// Control points of the path; the second half lays the ply down.
const STEPS: usize = 32;

/// Grippers around a middle (m), so far apart (m), turned (rad).
fn array(middle: [f64; 3], spacing: f64, yaw: f64) -> Vec<[f64; 3]> {
    let pose = Pose::new(middle, [0.0, 0.0, yaw]);
    let place = |n: usize| {
        let [i, j] = GRID.id(n).map(|k| k as f64);
        pose.place([spacing * (i - 1.0), spacing * (j - 0.5), 0.0])
    };
    (0..GRID.grippers()).map(place).collect()
}

fn path() -> Steps {
    let onto = |p: &[f64; 3]| [p[0], p[1], (1.0 - p[0] * p[0] - p[1] * p[1]).sqrt() - 1.0];
    let (over, end) = (array([0.0, 0.0, 0.05], 0.098, 0.0), array([0.0; 3], 0.0995, 0.0));
    let half = STEPS / 2;
    let step = |k: usize| {
        if k < half {
            let t = k as f64 / (half - 1) as f64;
            let s = t * t * (3.0 - 2.0 * t);
            return array([-0.5 * (1.0 - s), 0.0, -0.05 + 0.1 * s], 0.098, FRAC_PI_6 * (1.0 - s));
        }
        let t = (k - half + 1) as f64 / half as f64;
        let way = over.iter().zip(end.iter().map(onto));
        way.map(|(a, b)| [0, 1, 2].map(|c| a[c] + t * (b[c] - a[c]))).collect()
    };
    (0..STEPS).map(step).collect()
}

struct Found {
    scene: Scene,
    record: PlanRecord,
    drape: Drape,
}

impl Found {
    fn plan(&self) -> KnownPlan<'_> {
        KnownPlan {
            scene: &self.scene,
            record: &self.record,
            steps: &self.drape.steps,
            summary: &self.drape.summary,
        }
    }

    fn replanner(&self) -> Replanner<'_> {
        Replanner::new(self.plan(), None).unwrap()
    }
}

/// A plan that is draped by catenaries, of grippers that move by themselves.
fn planned(path: Steps, bodies: Bodies) -> Found {
    carried(path, bodies, None)
}

/// The clearance along a path, with a tool.
fn carried(path: Steps, bodies: Bodies, tool: Option<Tool>) -> Found {
    let (ply, mut settings) = (cloth(GRID), Settings::default());
    settings.model = Model::Catenaries;
    let sphere = Sphere { pose: Pose::upright([0.0, 0.0, -1.0]), radius: 1.0, face: Face::Outside };
    let grippers = path[path.len() - 1].clone();
    let mut scene = Scene::new(ply, settings, Motion { times: vec![], positions: vec![] });
    scene.layup = Layup {
        mold: Some(Mold::Sphere(sphere)),
        target: Some(Target { grippers, drape: None }),
        bodies,
        tool,
        ..scene.layup
    };
    scene.limits = Limits::usual(&scene.layup);
    scene.limits.workspace = Some([[-1.5, 1.5]; 3]);
    let motion = TimedMotion::new(&path, &scene.limits.motion_bounds()).unwrap();
    let record = PlanRecord::new(PlanMethod::Path, 1, 100.0, path, &motion, Vec::new());
    scene.layup.motion = motion.steps();
    let drape = draped(&scene);
    assert_eq!(drape.summary.steps, scene.layup.motion.times.len(), "{:?}", drape.summary.stopped);
    Found { scene, record, drape }
}

/// The drape by the model that decides.
fn draped(scene: &Scene) -> Drape {
    simulate(scene, |_| ControlFlow::Continue(())).expect("a model").drape
}

fn dome() -> Found {
    planned(path(), Bodies::default())
}

fn off(x: f64, y: f64, yaw_deg: f64) -> Offset {
    Offset { shift: [x, y], yaw: yaw_deg.to_radians(), about: None }
}

/// 12 mm, −7 mm and 4°, as a camera may see it.
const SEEN: [f64; 3] = [0.012, -0.007, 4.0];

fn seen() -> Offset {
    off(SEEN[0], SEEN[1], SEEN[2])
}

/// The start is the planned one, turned about the middle of its grippers and shifted, by the rotation of a pose; about another
/// point, the same turn shifts the middle further.
#[test]
fn the_motion_starts_where_the_ply_lies() {
    let found = dome();
    let replanned = found.replanner().replan(&seen(), None).unwrap();
    let start = &found.scene.layup.motion.positions[0];
    let turned = Pose::new([-0.5 + SEEN[0], SEEN[1], 0.0], [0.0, 0.0, SEEN[2].to_radians()]);
    for (p, q) in start.iter().zip(&replanned.motion.positions()[0]) {
        let expected = turned.place([p[0] + 0.5, p[1], p[2]]);
        assert!(distance(expected, *q) < 1e-15, "{expected:?} {q:?}");
    }
    let about = Offset { about: Some([0.0; 2]), ..seen() };
    let replanned = found.replanner().replan(&about, None).unwrap();
    let turned = Pose::new([SEEN[0], SEEN[1], 0.0], [0.0, 0.0, SEEN[2].to_radians()]);
    for (p, q) in start.iter().zip(&replanned.motion.positions()[0]) {
        assert!(distance(turned.place(*p), *q) < 1e-15);
    }
}

/// From the step before the first contact on, the path is the planned one to the last bit, at the times of the plan over the
/// factor by which the motion is longer; also between its steps.
#[test]
fn the_landing_is_the_planned_one_to_the_last_bit() {
    let found = dome();
    let replanner = found.replanner();
    let replanned = replanner.replan(&seen(), None).unwrap();
    let first = found.drape.summary.first_contact_step().unwrap();
    assert_eq!(replanner.last_free + 2, first);
    let (before, after) = (replanner.planned(), &replanned.motion);
    assert_eq!(before.positions()[first - 2..], after.positions()[first - 2..]);
    assert_ne!(before.positions()[first - 5], after.positions()[first - 5]);
    for (a, b) in before.times().iter().zip(after.times()) {
        assert!((a * replanned.longer - b).abs() <= 1e-12 * b);
    }
    for n in 0..100 {
        let t = before.times()[first - 2];
        let t = t + (before.duration() - t) * f64::from(n) / 100.0;
        for (a, b) in before.at(t).into_iter().zip(after.at(t * replanned.longer)) {
            assert!(distance(a, b) < 1e-12);
        }
    }
}

/// Every distance of two grippers in every step is that of the plan: the weights and the means of the path are made so that the array is moved as one body.
#[test]
fn the_array_is_moved_as_one_body() {
    let found = dome();
    let replanner = found.replanner();
    for offset in [seen(), off(-0.05, 0.04, -15.0)] {
        let replanned = replanner.replan(&offset, None).unwrap();
        let steps = replanner.planned().positions().iter().zip(replanned.motion.positions());
        for (k, (from, to)) in steps.enumerate() {
            for a in 0..from.len() {
                for b in 0..a {
                    let [before, after] = [from, to].map(|places| distance(places[a], places[b]));
                    assert!((before - after).abs() < 2e-6 * before, "{k}: {before} {after}");
                }
            }
        }
    }
}

/// Without an offset the steps, the path and the verdict are those of the plan, bit by bit.
#[test]
fn no_offset_gives_the_plan_itself() {
    let found = dome();
    let replanner = found.replanner();
    let replanned = replanner.replan(&off(0.0, 0.0, 0.0), None).unwrap();
    assert_eq!(replanned.record.path, found.record.path);
    assert_eq!(&replanned.motion, replanner.planned());
    assert_eq!((replanned.longer, &replanned.steps), (1.0, &found.drape.steps));
    let planned = &found.drape.summary;
    // of the motion in time the plan of this test has what its steps say, and the correction its peaks
    let of_ply = |summary: &Summary| -> Vec<Verdict> {
        let limits = summary.limits.iter();
        limits.filter(|v| v.name.measure().scope() != Scope::Motion).cloned().collect()
    };
    assert_eq!(of_ply(&replanned.summary), of_ply(planned));
    assert_eq!(replanned.summary.worst, planned.worst);
    assert_eq!(replanned.summary.last, planned.last);
}

/// The record of a corrected plan makes its motion again, bit by bit.
#[test]
fn the_record_makes_the_motion_again() {
    let found = dome();
    for offset in [seen(), off(-0.1, -0.3, 20.0)] {
        let replanned = found.replanner().replan(&offset, None).unwrap();
        assert_eq!(replanned.record.motion().unwrap(), replanned.motion);
    }
}

/// A drape by catenaries along the corrected motion finds what the record of the plan became when it was moved: forces, slopes and
/// orientations in the air, and the landing with its verdict. What is left is the equilibrium's tolerance.
#[test]
fn a_drape_along_the_corrected_motion_finds_the_moved_record() {
    let found = dome();
    let replanned = found.replanner().replan(&seen(), None).unwrap();
    let layup = Layup { motion: replanned.motion.steps(), ..found.scene.layup.clone() };
    let drape = draped(&Scene { layup, ..found.scene.clone() });
    let near = |a: f64, b: f64, tolerance: f64| (a - b).abs() <= tolerance * (1.0 + a.abs());
    for (own, other) in replanned.steps.iter().zip(&drape.steps) {
        for (a, b) in own.grippers.iter().zip(&other.grippers) {
            assert_eq!(a.position, b.position);
            let dot: f64 = a.quaternion.iter().zip(b.quaternion).map(|(p, q)| p * q).sum();
            assert!((dot.abs() - 1.0).abs() < 1e-6, "{} {a:?} {b:?}", own.step);
            assert!(near(a.tilt_deg, b.tilt_deg, 1e-3), "{} {a:?} {b:?}", own.step);
        }
        let [own_lines, other_lines] =
            [own, other].map(|step| &step.catenaries.as_ref().expect("catenaries").catenaries);
        for (a, b) in own_lines.iter().zip(other_lines) {
            assert_eq!(a.contact.is_some(), b.contact.is_some(), "{}", own.step);
            for (a, b) in a.spans.iter().zip(&b.spans) {
                assert!(near(a.force.unwrap_or(0.0), b.force.unwrap_or(0.0), 1e-3), "{a:?} {b:?}");
            }
        }
        for (name, worst) in own.measures.iter() {
            let value = other.measures.value(name).unwrap();
            assert!(near(worst.value, value, 2e-3), "{name:?} {} {worst:?} {value}", own.step);
        }
    }
    assert_eq!(drape.summary.first_contact_step(), found.drape.summary.first_contact_step());
    for verdict in &drape.summary.limits {
        let mut own = replanned.summary.limits.iter();
        let own = own.find(|other| other.name == verdict.name).unwrap();
        assert_eq!(own.ok, verdict.ok, "{own:?} {verdict:?}");
        // the steps of a motion never say more than its peaks
        if verdict.name.measure().scope() == Scope::Motion {
            assert!(verdict.value > 0.0 && verdict.value <= own.value, "{own:?} {verdict:?}");
            continue;
        }
        assert!(near(own.value, verdict.value, 2e-3), "{own:?} {verdict:?}");
    }
}

/// The sheet of a coarse mesh lands along the corrected motion as along the planned one: the height at the end within a hundredth
/// of a millimeter, and at the same step.
#[test]
fn a_sheet_along_the_corrected_motion_lands_alike() {
    let found = dome();
    let replanned = found.replanner().replan(&seen(), None).unwrap();
    let settings = Settings {
        model: Model::Sheet,
        sheet: SheetSettings { mesh: Some(0.034), ..SheetSettings::default() },
        ..found.scene.layup.settings
    };
    let mut ply = found.scene.layup.ply.clone();
    ply.material.section = Section::Areal { mass: 0.3, warp_rigidity: 1e-4, weft_rigidity: 1e-4 };
    ply.material.tension = Some(TensionLaw::Linear { stiffness: 1e5 });
    ply.material.shear_curve = Some(ShearCurve::Polynomial { coefficients: vec![5.0] });
    let drape = |motion: Motion| {
        let layup = Layup { motion, settings, ply: ply.clone(), ..found.scene.layup.clone() };
        draped(&Scene { layup, ..found.scene.clone() }).summary
    };
    let planned = drape(found.scene.layup.motion.clone());
    let moved = drape(replanned.motion.steps());
    assert_eq!(planned.status, moved.status);
    assert_eq!(planned.first_contact_step(), moved.first_contact_step());
    let near = |a: Option<f64>, b: Option<f64>| (a.unwrap() - b.unwrap()).abs() < 0.01;
    assert!(
        near(planned.last.value(Name::Height), moved.last.value(Name::Height)),
        "{planned:?} {moved:?}"
    );
    assert!(near(planned.height_rms_mm, moved.height_rms_mm), "{planned:?} {moved:?}");
}

/// Speed, acceleration and jerk of differences over a fine sampling stay within the limits, of a small offset and of one for which the motion
/// must be slower; so do the rates of the verdict, and the tilt rate.
#[test]
fn a_corrected_motion_keeps_its_limits_at_fine_samples() {
    let found = dome();
    for (offset, slower) in [(seen(), false), (off(0.3, -0.5, 60.0), true)] {
        let replanned = found.replanner().replan(&offset, None).unwrap();
        let motion = &replanned.motion;
        assert!(!slower || replanned.longer > 1.05, "{}", replanned.longer);
        let count = 4000;
        let h = motion.duration() / f64::from(count);
        let at: Steps = (0..=count).map(|n| motion.at(f64::from(n) * h)).collect();
        let difference = |values: &Steps| -> Steps {
            let pair = |pair: &[Vec<[f64; 3]>]| {
                let both = pair[0].iter().zip(&pair[1]);
                both.map(|(a, b)| sub(*b, *a).map(|c| c / h)).collect()
            };
            values.windows(2).map(pair).collect()
        };
        let speed = difference(&at);
        let acceleration = difference(&speed);
        let jerk = difference(&acceleration);
        let most = |values: &Steps| values.iter().flatten().map(|v| norm(*v)).fold(0.0, f64::max);
        let [v, a, j] =
            [Name::Speed, Name::Acceleration, Name::Jerk].map(|name| found.scene.limits.most(name));
        // the third difference of positions of 1 m has a rounding of 1e-15/h³
        assert!(most(&speed) <= v * (1.0 + 1e-4), "{}", most(&speed));
        assert!(most(&acceleration) <= a * (1.0 + 1e-4), "{}", most(&acceleration));
        assert!(most(&jerk) <= j * (1.0 + 1e-3) + 1e-14 / h.powi(3), "{}", most(&jerk));
        for name in [Name::Speed, Name::Acceleration, Name::Jerk] {
            let mut limits = replanned.summary.limits.iter();
            assert!(limits.any(|verdict| verdict.name == name && verdict.ok), "{name:?}");
        }
        // this ply is laid down faster than its joints should tilt, and no faster than in the plan
        let rate = |summary: &Summary| summary.worst.value(Name::TiltRate).unwrap();
        let most =
            rate(&found.drape.summary).max(found.scene.limits.most(Name::TiltRate).to_degrees());
        assert!(rate(&replanned.summary) <= most * (1.0 + 1e-9));
    }
}

/// 300 mm nearer to the top of the dome the flank is higher than the ply is picked up: it would be in the mold from the first step on.
#[test]
fn an_offset_into_the_mold_is_refused_with_its_place() {
    let found = dome();
    let refused = found.replanner().replan(&off(0.3, 0.0, 0.0), None).unwrap_err();
    let Error::ReplanTouches { step, place, distance_mm, .. } = &refused else {
        panic!("{refused}");
    };
    assert!(*step <= 3 && *distance_mm < 0.2, "{refused}");
    let from_mold = distance(*place, [0.0, 0.0, -1.0]) - 1.0;
    assert!((from_mold * 1e3 - distance_mm).abs() < 1e-9, "{refused}");
    assert!(!refused.remedy().is_empty());
}

/// A start outside of the workspace, and a body that is carried into an obstacle beside the way, are judged with their values.
#[test]
fn a_workspace_and_an_obstacle_are_judged_again() {
    let cup = Body {
        name: "cup".into(),
        on: Mount::Pad,
        shape: Shape::Cylinder { radius: 0.01, from: 0.0, to: 0.03 },
    };
    let post = Obstacle {
        name: "post".into(),
        pose: Pose::upright([-0.5, 0.35, 0.0]),
        shape: Shape::Box { size: [0.3, 0.1, 0.5], at: [0.0; 3] },
    };
    let mut found = planned(path(), Bodies::new(vec![cup], vec![post]));
    found.scene.limits.workspace = Some([[-1.0, 1.0], [-0.4, 0.4], [-1.0, 1.0]]);
    let verdict = |replanned: &Replanned, name: Name| {
        let mut limits = replanned.summary.limits.iter();
        limits.find(|verdict| verdict.name == name).unwrap().clone()
    };
    let replanner = found.replanner();
    let here = replanner.replan(&off(0.0, 0.0, 0.0), None).unwrap();
    let planned = verdict(&here, Name::Clearance);
    assert!(planned.ok && verdict(&here, Name::Workspace).ok);

    let near = replanner.replan(&off(0.0, 0.2, 0.0), None).unwrap();
    let clearance = verdict(&near, Name::Clearance);
    assert!(!clearance.ok && clearance.at.contains("post") && !near.summary.accepted());
    assert!(clearance.value < planned.value);
    let outside = verdict(&replanner.replan(&off(0.0, -0.35, 0.0), None).unwrap(), Name::Workspace);
    // the farthest gripper of the turned array is 98 sin 30° + 49 cos 30° mm from its middle
    let reach = 98.0 * 0.5 + 49.0 * 0.75_f64.sqrt();
    assert!(
        (outside.value - (reach - 50.0)).abs() < 1e-9 && outside.step == Some(1),
        "{outside:?}"
    );
}

/// A ply that is on the mold from the start leaves no transport; a plan is corrected once; numbers that are none are refused.
#[test]
fn a_plan_that_leaves_no_room_is_refused() {
    let found = planned(path()[STEPS - 3..].to_vec(), Bodies::default());
    let refused = Replanner::new(found.plan(), None).unwrap_err();
    assert!(matches!(refused, Error::ReplanNoTransport { .. }), "{refused}");

    let mut found = dome();
    for offset in [off(f64::NAN, 0.0, 0.0), off(0.0, 1e7, 0.0), off(0.0, 0.0, 200.0)] {
        let refused = found.replanner().replan(&offset, None).unwrap_err();
        assert_eq!(refused, Error::ReplanOffset);
    }
    found.record = found.replanner().replan(&seen(), None).unwrap().record;
    let again = Replanner::new(found.plan(), None).unwrap_err();
    assert_eq!(again, Error::ReplanAgain);
}

/// Over a table the whole offset is kept until the ply is clear of it; without one it fades from the first step on.
#[test]
fn the_offset_is_whole_as_long_as_the_ply_may_lie_on_its_table() {
    let table = Obstacle {
        name: "table".into(),
        pose: Pose::upright([-0.5, 0.0, -0.08]),
        shape: Shape::Box { size: [0.4, 0.4, 0.04], at: [0.0; 3] },
    };
    let found = planned(path(), Bodies::new(vec![], vec![table]));
    let replanner = found.replanner();
    let whole = replanner.weights().iter().filter(|w| **w == 1.0).count();
    // its top is at −60 mm: 5 mm above it the lowest point of the ply is clear
    let lowest = |step: &Step| {
        let Layup { ply, settings, .. } = &found.scene.layup;
        let places: Vec<[f64; 3]> = step.grippers.iter().map(|g| g.position).collect();
        let catenaries = &step.catenaries.as_ref().expect("catenaries").catenaries;
        let curves = crate::draping::free_curves(ply, settings, &places, catenaries);
        curves.iter().flat_map(|(_, points)| points).map(|p| p[2]).fold(f64::INFINITY, f64::min)
    };
    let clear = found.drape.steps.iter().position(|step| lowest(step) >= -0.055).unwrap();
    assert!(clear > 0 && whole == clear + 1, "{clear} {whole}");
    assert_eq!(dome().replanner().weights().iter().filter(|w| **w == 1.0).count(), 1);
}

/// A frame with cups on three axes each, a table and a post beside the way.
fn cell() -> Found {
    let cylinder = |name: &str, on: Mount, radius: f64, from: f64, to: f64| Body {
        name: name.into(),
        on,
        shape: Shape::Cylinder { radius, from, to },
    };
    let frame = Body {
        name: "frame".into(),
        on: Mount::Flange,
        shape: Shape::Box { size: [0.3, 0.2, 0.04], at: [0.0, 0.0, 0.2] },
    };
    let bodies = vec![
        cylinder("cup", Mount::Pad, 0.015, 0.0, 0.03),
        cylinder("axis", Mount::Stem, 0.01, 0.03, 0.15),
        frame,
    ];
    let obstacle = |name: &str, size: [f64; 3], at: [f64; 3]| Obstacle {
        name: name.into(),
        pose: Pose::upright(at),
        shape: Shape::Box { size, at: [0.0; 3] },
    };
    let obstacles = vec![
        obstacle("table", [0.5, 0.5, 0.04], [-0.5, 0.0, -0.15]),
        obstacle("post", [0.06, 0.04, 0.3], [-0.3, 0.17, 0.0]),
    ];
    let path = path();
    let axis = |name: &str, direction: [f64; 3], stroke: f64| Axis {
        name: name.into(),
        direction,
        stroke: [-stroke, stroke],
        speed: 0.1,
    };
    let axes = vec![
        axis("x", [1.0, 0.0, 0.0], 0.01),
        axis("y", [0.0, 1.0, 0.0], 0.01),
        axis("z", [0.0, 0.0, 1.0], 0.05),
    ];
    let tool = Tool::new(&path[0], axes);
    carried(path, Bodies::new(bodies, obstacles), Some(tool))
}

/// The nearest bodies of an answer are those of its whole motion, judged without the plan, and no sample of the motion that is judged
/// by itself has nearer ones; the rates of the tool are those of the whole motion.
#[test]
fn the_clearance_and_the_tool_are_those_of_the_whole_motion() {
    let found = cell();
    let scene = &found.scene;
    let (least, rate) = (scene.limits.most(Name::Clearance), scene.plan.rate);
    let replanner = found.replanner();
    for offset in [seen(), off(0.0, 0.0, 0.0), off(-0.03, 0.02, -8.0), off(0.01, 0.035, 11.0)] {
        let replanned = replanner.replan(&offset, None).unwrap();
        let Replanned { motion, attitudes, summary, .. } = &replanned;
        let own = |name: Name| -> &Verdict {
            summary.limits.iter().rfind(|verdict| verdict.name == name).unwrap()
        };
        let whole = Nearest::of_motion(&scene.layup, least, rate, motion, attitudes).unwrap();
        let whole = clearance_verdict(scene, &whole, 1);
        let clearance = own(Name::Clearance);
        // a slower landing is sampled at other places
        let near = |a: f64, b: f64| (a - b).abs() <= 1e-4 * b.abs().max(1.0);
        assert!(near(clearance.value, whole.value), "{clearance:?} {whole:?}");
        let [place, other] = [clearance, &whole].map(|verdict| verdict.place.unwrap());
        assert!(distance(place, other) < 1e-3, "{clearance:?} {whole:?}");
        assert_eq!(clearance.ok, whole.ok);

        let samples = motion.samples(rate).unwrap();
        let alone = samples.iter().map(|t| {
            let positions = motion.at(*t);
            let poses = Poses::new(&scene.layup, &positions, &attitudes.at(*t), &positions);
            1e3 * clearance::at_poses(&scene.layup, least, &poses).unwrap().distance
        });
        let least = alone.fold(f64::INFINITY, f64::min);
        assert!(clearance.value <= least + 1e-4 * least.abs().max(1.0), "{clearance:?} {least}");
        // between samples it changes by half of what goes on in one: a way, and as much again for the turn
        let most = 1e3 * scene.limits.most(Name::Speed) / rate;
        assert!(clearance.value >= least - most, "{clearance:?} {least}");

        let tool = scene.layup.tool.as_ref().unwrap();
        let peaks = tool.peaks(motion, rate).unwrap();
        let rates = [
            (Name::ToolTurnRate, peaks.turn_rate.value.to_degrees()),
            (Name::ToolTurnAcceleration, peaks.turn_acceleration.value.to_degrees()),
            (Name::AxisSpeed, 1e2 * peaks.axis_share.value),
        ];
        for (name, value) in rates {
            let own = own(name).value;
            assert!((own - value).abs() <= 1e-9 * value, "{name:?} {own} {value}");
        }
    }
}

/// An answer is that of a fresh replanner, bit by bit, whatever was asked before.
#[test]
fn answers_do_not_depend_on_earlier_ones() {
    let found = cell();
    let replanner = found.replanner();
    let offsets = [seen(), off(-0.03, 0.02, -8.0), off(2.0, 0.0, 0.0), seen()];
    for offset in offsets {
        let (again, fresh) =
            (replanner.replan(&offset, None), found.replanner().replan(&offset, None));
        let (Ok(again), Ok(fresh)) = (&again, &fresh) else {
            assert_eq!(again.err(), fresh.err());
            continue;
        };
        let text = |found: &Replanned| format!("{:?}", found.summary);
        assert_eq!(text(again), text(fresh));
        assert_eq!(again.steps, fresh.steps);
        assert_eq!((&again.motion, &again.record), (&fresh.motion, &fresh.record));
    }
}
