//! A front that lays the ply: the lifted mold, the formation of grippers on it, and corrections by gradients.

use crate::common::{distance, example};
use plydrape::measure::Name;
use plydrape::mold::{HeightGrid, Lift, Lifted};
use plydrape::planner::board::Board;
use plydrape::planner::judge;
use plydrape::planner::path::{Formation, Ground, Strategy, correction, longest_move, trajectory};
use plydrape::scene::Scene;
use std::ops::ControlFlow;
use std::sync::Arc;

const RING: Strategy =
    Strategy { start: [0.5; 2], ratio: 1.0, angle: 0.0, curvature: 4.0, slope: 0.4, pull: 1e-4 };

/// Largest overstretch that a plan leaves (%).
fn overstretch(scene: &Scene, positions: &[Vec<[f64; 3]>]) -> f64 {
    let mut watcher = |_: &plydrape::planner::Progress| ControlFlow::Continue(());
    let board = Board::new(1, &mut watcher);
    let limits = judge::drape(scene, positions, &board).limits;
    limits.iter().find(|verdict| verdict.name == Name::Overstretch).expect("a limit").value
}

/// Slopes and curvatures of the lifted mold are the central differences of its height and slopes, for a turned
/// ellipse, inside and ahead of its front.
#[test]
fn a_lifted_mold_has_the_derivatives_of_its_height() {
    let axis: Vec<f64> = (0..11).map(|n| 0.04 * f64::from(n) - 0.2).collect();
    let z = axis.iter().flat_map(|y| axis.iter().map(move |x| x * x - 0.5 * x * y + y * y * y));
    let ground =
        Arc::new(HeightGrid::new(axis.clone(), axis.clone(), z.collect()).expect("a grid"));
    let metric = [0.7, -0.2, 0.9];
    let lift = Lift { centre: [0.02, -0.03], metric, front: 0.06, curvature: 4.0, slope: 0.3 };
    let lifted = Lifted { ground, lift };
    let h = 1e-5;
    for (x, y) in [(0.03, -0.02), (0.1, 0.07), (-0.15, 0.12), (0.02, -0.19), (-0.11, -0.13)] {
        let here = lifted.at(x, y);
        let [left, right] = [-h, h].map(|d| lifted.at(x + d, y));
        let [below, above] = [-h, h].map(|d| lifted.at(x, y + d));
        let difference = |a: f64, b: f64| (b - a) / (2.0 * h);
        let slopes = [difference(left.z, right.z), difference(below.z, above.z)];
        let bends = [
            difference(left.gradient[0], right.gradient[0]),
            difference(left.gradient[1], right.gradient[1]),
            difference(below.gradient[1], above.gradient[1]),
        ];
        for n in 0..2 {
            assert!((here.gradient[n] - slopes[n]).abs() < 1e-8, "({x}, {y}): {here:?} {slopes:?}");
        }
        for n in 0..3 {
            assert!((here.hessian[n] - bends[n]).abs() < 1e-6, "({x}, {y}): {here:?} {bends:?}");
        }
    }
    // far ahead it is no steeper than it may be
    let far = Lift { front: 0.0, metric: [1.0, 0.0, 1.0], ..lift };
    let flat = Lifted { lift: far, ground: Arc::clone(&lifted.ground) };
    let rise = (flat.raised(0.2, -0.03) - flat.raised(0.19, -0.03)) / 0.01;
    assert!(rise < 0.3 && rise > 0.25, "{rise}");
}

/// Behind the front grippers stand on their targets, ahead of it they hover; and no edge is ever longer than its
/// fabric and the pull, but for what a straight line cuts off the curved net.
#[test]
fn a_formation_stands_behind_its_front_and_keeps_the_fabric() {
    for name in ["01_flat_sheared_mold", "04_dome", "05_cylinder", "06_saddle"] {
        let scene = example(name);
        let ground = Ground::new(&scene).expect("a mold");
        let formation = Formation::new(&scene, &ground, RING).expect("a target");
        let (grid, targets) = (scene.ply.grid, &scene.target.as_ref().expect("a target").grippers);
        let mold = scene.mold.as_ref().expect("a mold");
        for k in 0..=10 {
            let front = formation.reach() * f64::from(k) / 10.0;
            let grippers = formation.grippers(front);
            for edge in 0..grid.edges() {
                let c = grid.catenary(edge);
                let [a, b] = [c.from, c.to].map(|g| grippers[grid.index(g)]);
                let most = scene.ply.flat_length(c.kind) * (1.0 + 2e-4);
                assert!(distance(a, b) < most, "{name}: {c:?} is {} m long", distance(a, b));
            }
            for (place, target) in grippers.iter().zip(targets) {
                let (height, off) = (mold.signed_distance(*place), distance(*place, *target));
                assert!(height > -1e-5, "{name}: {height} m above the mold");
                assert!(height > 1e-4 || off < 3e-4, "{name}: lands {off} m beside its target");
            }
        }
        let landed = formation.grippers(2.0 * formation.reach());
        for (place, target) in landed.iter().zip(targets) {
            assert!(distance(*place, *target) < 1e-9, "{name}: {place:?} {target:?}");
        }
    }
}

/// A trajectory begins at the start and ends at the target, to the last bit, in as many steps as it was given; with a
/// move limit no step is longer where the way allows it.
#[test]
fn a_trajectory_goes_from_start_to_target_in_its_steps() {
    let mut scene = example("04_dome");
    let ground = Ground::new(&scene).expect("a mold");
    for steps in [30, 90] {
        scene.plan.steps = steps;
        let positions = trajectory(&scene, &ground, RING).expect("a target");
        assert_eq!(positions.len(), steps);
        assert_eq!(positions[0], scene.motion.positions[0]);
        assert_eq!(positions[steps - 1], scene.target.as_ref().expect("a target").grippers);
    }
    let longest = |positions: &[Vec<[f64; 3]>]| {
        positions.windows(2).map(|pair| longest_move(&pair[0], &pair[1])).fold(0.0, f64::max)
    };
    let free = longest(&trajectory(&scene, &ground, RING).expect("a target"));
    scene.plan.move_limit = Some(0.5 * free);
    let limited = longest(&trajectory(&scene, &ground, RING).expect("a target"));
    assert!(free > 1e-3 && limited <= 0.5 * free, "{free} {limited}");
}

/// A strategy is a point of the search's cube and back; what leaves the cube is reflected into it.
#[test]
fn a_strategy_is_a_point_of_the_search_and_back() {
    for strategy in Strategy::families(&example("06_saddle")) {
        assert!(strategy.is_sound());
        let unit = strategy.to_unit();
        assert!(unit.iter().all(|x| (0.0..=1.0).contains(x)), "{unit:?}");
        let back = Strategy::of_unit(&unit).to_unit();
        assert!(unit.iter().zip(back).all(|(a, b)| (a - b).abs() < 1e-12), "{unit:?} {back:?}");
        let beyond = unit.map(|x| -x);
        let reflected = Strategy::of_unit(&beyond).to_unit();
        assert!(unit.iter().zip(reflected).all(|(a, b)| (a - b).abs() < 1e-12));
    }
}

/// A plan of the dome in which one gripper strays by up to half a millimetre in the middle of the landing pulls edges more than five
/// times as far; three rounds of corrections by gradients take a good part of that back.
#[test]
fn gradients_bring_a_stray_gripper_back() {
    let scene = example("04_dome");
    let ground = Ground::new(&scene).expect("a mold");
    let good = trajectory(&scene, &ground, RING).expect("a target");
    let mut stray = good.clone();
    let (from, to) = (25.0, good.len() as f64 - 1.0);
    for (k, positions) in stray.iter_mut().enumerate() {
        let t = ((k as f64 - from) / (to - from)).clamp(0.0, 1.0);
        positions[7][0] += 5e-4 * (std::f64::consts::PI * t).sin().powi(2);
    }
    let mut corrected = stray.clone();
    for _ in 0..3 {
        let correction = correction(&scene, &corrected).expect("something touches");
        for (positions, moves) in corrected.iter_mut().zip(correction) {
            for (place, by) in positions.iter_mut().zip(moves) {
                *place = [0, 1, 2].map(|n| place[n] + by[n]);
            }
        }
    }
    let [good, stray, corrected] =
        [&good, &stray, &corrected].map(|plan| overstretch(&scene, plan));
    assert!(stray > 5.0 * good, "{good} {stray}");
    assert!(corrected < good + 0.6 * (stray - good), "{good} {stray} {corrected}");
}
