//! The stepwise planner: its gradients against central differences of the model solved anew, and its plans
//! judged by draping along them.

use crate::common::{self, Point, RULES, cases, distance, example, ideal, lines, motion};
use crate::scaled::scaled;
use plydrape::draping::spans::Equilibrium;
use plydrape::equilibrium::{Side, Solver, Status};
use plydrape::layup::{ContactEnd, Stepping};
use plydrape::measure::Name;
use plydrape::mold::{Face, Mold, Plane, Pose, Sphere, SurfaceCurve};
use plydrape::planner::sensitivity::{Quantity, Sensitivity};
use plydrape::planner::stepwise::tuning::TUNING;
use plydrape::planner::stepwise::{Stepwise, StepwiseEnd, stepwise};
use plydrape::ply::{ContactSegment, Grid};
use plydrape::scene::Scene;
use plydrape_io::ResultFile;
use proptest::prelude::*;
use std::ops::ControlFlow;

/// A ply above or on a mold, with its contact segments.
#[derive(Debug, Clone)]
struct Ply {
    scene: Scene,
    positions: Vec<Point>,
    contacts: Vec<Option<ContactSegment>>,
}

/// Which part of a catenary is in contact.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Contact {
    Nothing,
    Middle,
    /// From its first gripper on.
    First,
    /// To its second gripper, the free segment there lying on the mold.
    Lying,
}

/// Puts a piece of a catenary on the mold below the line between its grippers.
fn in_contact(
    mold: &Mold,
    [a, b]: [Point; 2],
    length: f64,
    part: Contact,
) -> Option<ContactSegment> {
    let (from, to) = match part {
        Contact::Nothing => return None,
        Contact::Middle => (0.31, 0.56),
        Contact::First => (0.0, 0.47),
        Contact::Lying => (0.36, 0.74),
    };
    let run = (b[0] - a[0]).hypot(b[1] - a[1]);
    let heading = [(b[0] - a[0]) / run, (b[1] - a[1]) / run];
    let start = mold.highest_point([0, 1].map(|n| a[n] + from * (b[n] - a[n])))?;
    let lying = mold.lay(start, heading, (to - from) * length);
    let arc = lying.arc.iter().map(|s| s + from * length).collect();
    let line = SurfaceCurve { points: lying.points, arc };
    let normal = [line.points[0], line.end()].map(|p| mold.normal(p));
    let tangent = normal.map(|[nx, ny, nz]| {
        let slope = -(nx * heading[0] + ny * heading[1]) / nz;
        [heading[0], heading[1], slope].map(|c| c / slope.hypot(1.0))
    });
    Some(ContactSegment {
        length,
        line,
        normal,
        lying: [part == Contact::First, part == Contact::Lying],
        excess_length: [0.0, if part == Contact::Lying { 1e-5 } else { 0.0 }],
        outward: [tangent[0].map(|c| -c), tangent[1]],
        landed: None,
    })
}

fn any_ply() -> impl Strategy<Value = Ply> {
    let rule = prop::sample::select(RULES.as_slice());
    let end = prop::sample::select(vec![ContactEnd::Free, ContactEnd::Tangent]);
    let mold = any::<bool>();
    let tilt = prop::sample::select(vec![3.0_f64, 12.0, 40.0]);
    let part = prop::sample::select(vec![
        Contact::Nothing,
        Contact::Nothing,
        Contact::Nothing,
        Contact::Middle,
        Contact::Middle,
        Contact::First,
        Contact::Lying,
    ]);
    let numbers = prop::collection::vec(-1.0..1.0, 3 * 12);
    let touches = prop::collection::vec(part, 40);
    ((rule, end, mold, tilt), (2usize..5, 1usize..4), -0.35..0.35, 0.93..0.995, numbers, touches)
        .prop_map(|((rule, end, round, tilt), (nu, nv), shear, spacing, random, touches)| {
            let mut scene = example("01_flat_sheared_mold");
            scene.layup.ply.grid = Grid { nu, nv };
            scene.layup.settings.slopes = rule;
            scene.layup.settings.contact.end = end;
            scene.layup.settings.max_tilt = tilt.to_radians();
            scene.layup.target = None;
            let pose = Pose::new([0.1, 0.05, -0.6], [0.0; 3]);
            let mold = if round {
                Mold::Sphere(Sphere { pose, radius: 0.6, face: Face::Outside })
            } else {
                let size = (0.1_f64 * 0.1 + 0.05 * 0.05 + 1.0).sqrt();
                let normal = [0.1, -0.05, 1.0].map(|c| c / size);
                Mold::Plane(Plane { point: [0.0; 3], normal })
            };
            let positions: Vec<Point> = (0..nu * nv)
                .map(|n| {
                    let [i, j] = scene.layup.ply.grid.id(n).map(|k| 0.1 * spacing * k as f64);
                    let (sin, cos) = f64::sin_cos(shear);
                    let r = |k: usize| random[3 * n + k];
                    let at = [i + j * sin + 5e-4 * r(0), j * cos + 5e-4 * r(1)];
                    let surface = mold.highest_point(at).expect("the mold is everywhere");
                    [at[0], at[1], surface[2] + 0.008 + 0.005 * r(2)]
                })
                .collect();
            let lines = scene.layup.ply.lines();
            let contacts = (0..lines.catenaries())
                .map(|n| {
                    let c = lines.catenary(n);
                    let ends = lines.ends(n).map(|gripper| positions[gripper]);
                    let edge = scene.layup.ply.flat_length(n);
                    let chord = (0..3).map(|k| (ends[1][k] - ends[0][k]).powi(2)).sum::<f64>();
                    // a diagonal lands with the length that its shear gives it
                    let length = if c.kind.is_edge() { edge } else { 1.01 * chord.sqrt() };
                    in_contact(&mold, ends, length, touches[n])
                })
                .collect();
            scene.layup.mold = Some(mold);
            Ply { scene, positions, contacts }
        })
}

struct Solved {
    solver: Solver,
    shape: Equilibrium,
    positions: Vec<Point>,
}

fn solve(ply: &Ply, shift: f64, direction: &[f64]) -> Solved {
    let positions: Vec<Point> = (ply.positions.iter().enumerate())
        .map(|(n, p)| [0, 1, 2].map(|k| p[k] + shift * direction[3 * n + k]))
        .collect();
    let mut solver = Solver::new(&ply.scene.layup.ply, &ply.scene.layup.settings);
    let equilibrium = solver.solve(&positions, &ply.contacts);
    let shape =
        Equilibrium::new(&ply.scene.layup.ply, &solver, equilibrium, &positions, &ply.contacts);
    Solved { solver, shape, positions }
}

/// Every quantity that a plan may limit, by name.
fn quantities(ply: &Ply, solved: &mut Solved) -> Vec<(String, Quantity)> {
    let Solved { solver, shape, positions } = solved;
    let look = Sensitivity::new(&ply.scene.layup, solver, shape, positions, &ply.contacts, 0.0);
    let mut out = Vec::new();
    let grid = ply.scene.layup.ply.grid;
    for span in &look.shape.spans {
        let mut push = |what: &str, quantity: Option<Quantity>| {
            let name = format!("{what} of catenary {} segment {}", span.catenary, span.segment);
            out.extend(quantity.map(|q| (name, q)));
        };
        push("force", look.force(span));
        push("overstretch", Some(look.overstretch(span)));
        push("rise at 0", look.rise(span, 0));
        push("rise at 1", look.rise(span, 1));
        for t in [0.07, 0.5, 0.81] {
            push("slope", Some(look.slope(span, t)));
            push("gap", look.gap(span, t));
            for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                let mut unit = [0.0; 3];
                unit[axis] = 1.0;
                push(&format!("place {name} at {t}"), Some(look.place(span, t).along(unit)));
                let fabric = look.fabric_place(span, t).along(unit);
                push(&format!("fabric place {name} at {t}"), Some(fabric));
            }
        }
    }
    for gripper in 0..grid.grippers() {
        out.push((format!("tilt of {gripper}"), look.tilt(gripper)));
        let clearance = look.clearance(gripper).expect("a mold");
        out.push((format!("clearance of {gripper}"), clearance));
        if gripper > 0 {
            out.push((format!("separation of {gripper}"), look.separation(gripper, gripper - 1)));
        }
    }
    for cell in 0..grid.cells() {
        out.extend(look.shear(cell).map(|shear| (format!("shear of {cell}"), shear)));
    }
    out
}

/// What must be the same on both sides of a point for the state to be differentiable there.
fn kind(ply: &Ply, solved: &Solved) -> (Vec<Option<bool>>, Vec<bool>, Vec<bool>, usize) {
    let (problem, bound) = (solved.solver.problem(), ply.scene.layup.settings.max_tilt.tan());
    (
        problem.shearing.iter().map(|s| s.map(|(_, falling)| falling)).collect(),
        solved.solver.slopes().iter().map(|s| s.abs() >= bound).collect(),
        problem.sides().iter().flatten().flatten().map(|s| matches!(s, Side::Fixed(_))).collect(),
        problem.elements.len(),
    )
}

proptest! {
    #![proptest_config(ProptestConfig {
        max_global_rejects: 4000,
        max_shrink_iters: 0,
        ..cases(200)
    })]

    /// Both slope rules, free and tangent contact ends, slopes at their bounds, sheared and in contact in many ways:
    /// every gradient is that of the model solved anew on both sides.
    #[test]
    fn gradients_agree_with_central_differences(
        ply in any_ply(),
        direction in prop::collection::vec(-1.0..1.0, 3 * 12),
    ) {
        let h = 1e-6;
        let (mut low, mut middle, mut high) =
            (solve(&ply, -h, &direction), solve(&ply, 0.0, &direction), solve(&ply, h, &direction));
        for solved in [&low, &middle, &high] {
            prop_assume!(solved.shape.solved.status == Status::Converged);
            prop_assume!(solved.shape.solved.residual < 1e-9);
        }
        prop_assume!(kind(&ply, &low) == kind(&ply, &middle));
        prop_assume!(kind(&ply, &high) == kind(&ply, &middle));
        // where a span just becomes taut its force is all but a kink
        let kink = |s: &plydrape::draping::spans::FreeSpan| (s.chord() - s.length).abs() < 5e-5;
        prop_assume!(!middle.shape.spans.iter().any(|s| kink(s) && !s.shearing));
        // several minima: all on one of them
        let jump = |a: &Solved, b: &Solved| {
            a.solver.slopes().iter().zip(b.solver.slopes()).any(|(a, b)| (a - b).abs() > 1e-3)
        };
        prop_assume!(!jump(&low, &middle) && !jump(&high, &middle));
        let found = quantities(&ply, &mut middle);
        let differences = |h: f64, low: &mut Solved, high: &mut Solved| -> Vec<f64> {
            let (low, high) = (quantities(&ply, low), quantities(&ply, high));
            low.iter().zip(&high).map(|((_, a), (_, b))| (b.value - a.value) / (2.0 * h)).collect()
        };
        let near = differences(h, &mut low, &mut high);
        let (mut low, mut high) = (solve(&ply, -2.0 * h, &direction), solve(&ply, 2.0 * h, &direction));
        prop_assume!(kind(&ply, &low) == kind(&ply, &middle) && kind(&ply, &high) == kind(&ply, &middle));
        let far = differences(2.0 * h, &mut low, &mut high);
        for (n, (name, quantity)) in found.iter().enumerate() {
            // a segment close to taut bends within micrometers: the error of second order follows
            let difference = (4.0 * near[n] - far[n]) / 3.0;
            let along: f64 = quantity.gradient.dot(&direction);
            // differences carry the solver's 1e-8 of the slopes over h
            let scale = difference.abs() + quantity.value.abs() + 1.0;
            prop_assert!((along - difference).abs() < 2e-4 * scale, "{name}: {along} for {difference}");
        }
    }
}

/// A shipped scene, its contact followed at every place of the grippers.
fn cut(name: &str) -> Scene {
    let mut scene = ideal(name);
    scene.layup.settings.contact.stepping = Stepping::Cut;
    scene
}

fn plan(scene: &Scene) -> Stepwise {
    stepwise(scene, &mut |_| ControlFlow::Continue(()))
}

/// Drapes a scene along a plan.
fn drape(scene: &Scene, plan: &Stepwise) -> ResultFile {
    let mut scene = scene.clone();
    scene.layup.motion = motion(plan.positions.clone());
    common::drape(&scene)
}

/// Largest slack of an edge at the end (mm).
fn slack(result: &ResultFile) -> f64 {
    let last = result.steps.last().expect("steps");
    let edges = lines(last).iter().filter(|c| c.kind.is_edge());
    edges.flat_map(|c| c.spans.iter().map(|span| span.slack_mm(c.length))).fold(0.0, f64::max)
}

/// Largest value of a limit, and whether it holds.
fn verdict(result: &ResultFile, name: &str) -> (f64, bool) {
    let found = result.summary.limits.iter().find(|verdict| verdict.name.measure().name() == name);
    found.map(|verdict| (verdict.value, verdict.ok)).expect("a judged limit")
}

/// Every limit but two: how fast the grippers turn, for which `planner::plan` slows a motion down, and the strain of the
/// short free segments that come down beside the grippers, which the table in README.md shows.
fn keeps_its_limits(result: &ResultFile, what: &str) {
    let left_out = [Name::TiltRate, Name::Strain];
    let judged = result.summary.limits.iter().filter(|verdict| !left_out.contains(&verdict.name));
    let broken: Vec<_> = judged.filter(|verdict| !verdict.ok).collect();
    assert!(broken.is_empty(), "{what}: {broken:?}");
}

/// The purpose of the whole: on the paper's sheared flat mold, by both slope rules and at the tolerance of the paper
/// and of a new scene, nothing that is judged is broken, and the grippers stand on their targets to the last bit.
#[test]
fn the_plan_of_the_flat_sheared_mold_is_accepted() {
    for slopes in RULES {
        for tolerance in [1e-3, 2e-4] {
            let mut scene = cut("01_flat_sheared_mold");
            scene.layup.settings.slopes = slopes;
            scene.layup.settings.contact.tolerance = tolerance;
            let plan = plan(&scene);
            assert_eq!(plan.outcome, StepwiseEnd::Arrived);
            assert_eq!(plan.positions.first(), scene.layup.motion.positions.first());
            let target = scene.layup.target.as_ref().expect("a target");
            assert_eq!(plan.positions.last(), Some(&target.grippers));
            let result = drape(&scene, &plan);
            keeps_its_limits(&result, &format!("{slopes:?} {tolerance}"));
        }
    }
}

/// Molds that bend little: the same limits as on the flat one, as the table in README.md says. The saddle keeps too much slack.
#[test]
fn plans_of_gently_curved_molds_are_accepted() {
    for name in ["04_dome", "05_cylinder"] {
        let scene = cut(name);
        keeps_its_limits(&drape(&scene, &plan(&scene)), name);
    }
}

/// Straight paths leave 0.9–1.2 mm of slack in edges of these molds (simulated here too), the plan less than
/// a tenth of it, without pulling an edge beyond its limit.
#[test]
fn a_plan_leaves_a_tenth_of_the_slack_of_straight_paths_on_curved_molds() {
    for name in ["04_dome", "05_cylinder", "06_saddle"] {
        let scene = cut(name);
        let straight = slack(&common::drape(&scene));
        let plan = plan(&scene);
        assert_eq!(plan.outcome, StepwiseEnd::Arrived, "{name}");
        let result = drape(&scene, &plan);
        let left = slack(&result);
        assert!(left < 0.1 * straight, "{name}: {left} mm after {straight} mm");
        for limit in ["overstretch", "tilt", "landing_gripper", "contact_share"] {
            let (value, holds) = verdict(&result, limit);
            assert!(holds, "{name}: {limit} {value}");
        }
    }
}

/// Moves keep to the limit, and once something has landed no gripper rises: by more than the mold bends away
/// below a move, ½·|Δp|²/R.
#[test]
fn moves_keep_to_their_limit_and_nothing_rises_after_the_landing() {
    let mut scene = cut("04_dome");
    scene.plan.steps = 100;
    scene.plan.move_limit = Some(4e-3);
    let plan = plan(&scene);
    assert_eq!(plan.outcome, StepwiseEnd::Arrived);
    assert!(plan.positions.len() <= 100);
    assert_eq!(plan.positions.first(), scene.layup.motion.positions.first());
    let result = drape(&scene, &plan);
    let landed = result.summary.first_contact_step().expect("it lands");
    let mold = scene.layup.mold.as_ref().expect("a mold");
    for (step, pair) in plan.positions.windows(2).enumerate() {
        for (a, b) in pair[0].iter().zip(&pair[1]) {
            assert!(distance(*a, *b) <= 4e-3 * (1.0 + 1e-6), "step {step}: {}", distance(*a, *b));
            let rise = mold.signed_distance(*b) - mold.signed_distance(*a);
            let bend = 0.5 * distance(*a, *b).powi(2) / 0.6;
            assert!(step < landed || rise <= bend + 1e-8, "step {step} rises by {rise}");
        }
    }
    let targets = &scene.layup.target.as_ref().expect("a target").grippers;
    let last = plan.positions.last().expect("steps");
    for (place, target) in last.iter().zip(targets) {
        assert!(distance(*place, *target) <= scene.limits.most(Name::LandingGripper));
    }
}

/// Largest distance of a gripper in the steps of both plans, of which the other is of a scene multiplied by `s` (m).
fn apart(own: &Stepwise, other: &Stepwise, s: f64) -> f64 {
    let pairs = own.positions.iter().flatten().zip(other.positions.iter().flatten());
    pairs.map(|(a, b)| distance(*a, b.map(|x| x / s))).fold(0.0, f64::max)
}

/// No length but those of the scene: a scene of another size has the plan of that size, within a ten-thousandth of a cell.
/// That is room for rounding where the slack of a segment is just so large that it counts, and a move removes it.
#[test]
fn a_scaled_scene_has_the_scaled_plan() {
    for name in ["01_flat_sheared_mold", "04_dome", "05_cylinder"] {
        let scene = cut(name);
        let own = plan(&scene);
        for s in [0.1, 10.0] {
            let other = plan(&scaled(&scene, s));
            assert_eq!(other.outcome, own.outcome, "{name} × {s}");
            let more = own.positions.len().abs_diff(other.positions.len());
            assert!(more <= TUNING.slack.moves, "{name} × {s}: {more} steps");
            let apart = apart(&own, &other, s);
            assert!(apart < 1e-4 * scene.layup.ply.cell[0], "{name} × {s}: {apart}");
        }
        // powers of two change no digit, and without the net, which is draped anew, hardly anything remains
        let mut scene = scene;
        scene.layup.target.as_mut().expect("a target").drape = None;
        let own = plan(&scene);
        for s in [0.125, 8.0] {
            let other = plan(&scaled(&scene, s));
            assert_eq!(other.positions.len(), own.positions.len(), "{name} × {s}");
            let apart = apart(&own, &other, s);
            assert!(apart < 1e-9 * scene.layup.ply.cell[0], "{name} × {s}: {apart}");
        }
    }
}

/// A scene gives the same plan each time, to the last bit.
#[test]
fn a_plan_is_the_same_every_time() {
    let mut scene = cut("05_cylinder");
    scene.plan.steps = 40;
    let [a, b] = [plan(&scene), plan(&scene)];
    let bits = |plan: &Stepwise| -> Vec<u64> {
        plan.positions.iter().flatten().flatten().map(|x| x.to_bits()).collect()
    };
    assert_eq!(bits(&a), bits(&b));
}

/// What cannot be reached is said in numbers: the gripper with the longest way, and what is missing.
#[test]
fn a_target_out_of_reach_is_reported_with_the_way_that_is_missing() {
    let mut scene = cut("01_flat_sheared_mold");
    scene.plan.steps = 11;
    scene.plan.move_limit = Some(1e-3);
    let plan = plan(&scene);
    let targets = &scene.layup.target.as_ref().expect("a target").grippers;
    let starts = &scene.layup.motion.positions[0];
    let far: Vec<f64> = starts.iter().zip(targets).map(|(p, q)| distance(*p, *q)).collect();
    let farthest = (0..8).max_by(|a, b| far[*a].total_cmp(&far[*b])).expect("grippers");
    let StepwiseEnd::OutOfReach(error) = plan.outcome else {
        panic!("{:?}", plan.outcome);
    };
    assert_eq!(error.gripper, scene.layup.ply.grid.id(farthest));
    assert!((error.distance - (far[farthest] - 0.01)).abs() < 1e-12, "{error:?}");
    assert!(plan.positions.len() <= 11);
}

/// How a plan ends is data: without a target it is its start, and a caller may break it off.
#[test]
fn a_plan_without_a_target_or_broken_off_says_so() {
    let mut scene = cut("01_flat_sheared_mold");
    let mut reported = Vec::new();
    let broken = stepwise(&scene, &mut |step| {
        reported.push(step);
        if step == 5 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    assert_eq!(broken.outcome, StepwiseEnd::Interrupted);
    assert_eq!((broken.positions.len(), reported), (5, vec![1, 2, 3, 4, 5]));
    scene.layup.target = None;
    let none = plan(&scene);
    assert_eq!(none.outcome, StepwiseEnd::NoTarget);
    assert_eq!(none.positions, scene.layup.motion.positions[..1]);
}

/// Targets alone, without the ideal drape that they are of, do on the flat mold.
#[test]
fn targets_alone_are_enough_on_a_flat_mold() {
    let mut scene = cut("01_flat_sheared_mold");
    scene.layup.target.as_mut().expect("a target").drape = None;
    let plan = plan(&scene);
    assert_eq!(plan.outcome, StepwiseEnd::Arrived);
    let result = drape(&scene, &plan);
    assert!(result.summary.accepted(), "{:?}", result.summary.limits);
}
