//! A front that lays the ply: the lifted mold, the formation of grippers on it, and the trajectory that it gives.

use crate::common::{RING, distance, example, ideal, parse};
use plydrape::mold::{FrontSurface, HeightGrid, Rise};
use plydrape::planner::path::{Formation, MoldHeights, Strategy, trajectory};
use std::sync::Arc;

/// Slopes and curvatures of the lifted mold are the central differences of its height and slopes, for a turned
/// ellipse and what is between it and a rectangle or a rhombus, inside and ahead of its front.
#[test]
fn a_lifted_mold_has_the_derivatives_of_its_height() {
    let axis: Vec<f64> = (0..11).map(|n| 0.04 * f64::from(n) - 0.2).collect();
    let z = axis.iter().flat_map(|y| axis.iter().map(move |x| x * x - 0.5 * x * y + y * y * y));
    let mold = Arc::new(HeightGrid::new(axis.clone(), axis.clone(), z.collect()).expect("a grid"));
    let center = [0.02, -0.03];
    let ellipse = Rise {
        center,
        angle: 0.4,
        ratio: 1.3,
        squareness: 0.0,
        front: 0.06,
        curvature: 4.0,
        slope: 0.3,
        tip: 1e-4,
    };
    for squareness in [-0.8, 0.0, 0.6] {
        has_the_derivatives(&FrontSurface {
            mold: Arc::clone(&mold),
            rise: Rise { squareness, ..ellipse },
        });
    }
    // far ahead it is no steeper than it may be
    let far = Rise { front: 0.0, ratio: 1.0, ..ellipse };
    let flat = FrontSurface { rise: far, mold };
    let rise = (flat.rise_at(0.2, -0.03) - flat.rise_at(0.19, -0.03)) / 0.01;
    assert!(rise < 0.3 && rise > 0.25, "{rise}");
}

/// Slopes and curvatures of a lifted mold are central differences.
fn has_the_derivatives(lifted: &FrontSurface) {
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
}

/// How far a front has come along its axes and its diagonals: r⁴ = (u² + v²)² − 2 s u² v² is u⁴ on an axis whatever s is, and 2 (2 − s) u⁴ on
/// a diagonal. So the diagonal of a square front is reached when its sides are reached, and that of a rhombus later than that of a circle.
#[test]
fn a_square_front_reaches_its_corners_earlier_than_a_circle() {
    let front = |squareness| Rise {
        center: [0.0; 2],
        angle: 0.3,
        ratio: 1.0,
        squareness,
        front: 0.0,
        curvature: 4.0,
        slope: 0.3,
        tip: 0.0,
    };
    let (sin, cos) = 0.3_f64.sin_cos();
    for squareness in [-1.0, 0.0, 0.6, 1.0] {
        let axis = front(squareness).radius([0.1 * cos, 0.1 * sin]);
        let corner = front(squareness).radius([0.1 * (cos - sin), 0.1 * (sin + cos)]);
        assert!((axis - 0.1).abs() < 1e-15, "{squareness}: {axis}");
        let expected = 0.1 * (2.0 * (2.0 - squareness)).powf(0.25);
        assert!((corner - expected).abs() < 1e-15, "{squareness}: {corner}");
    }
}

/// Behind the front grippers stand on their targets, ahead of it they are above the mold; and no edge is ever longer than its
/// fabric and the pretension, but for what a straight line cuts off the curved net.
#[test]
fn a_formation_stands_behind_its_front_and_keeps_the_fabric() {
    for name in ["01_flat_sheared_mold", "04_dome", "05_cylinder", "06_saddle"] {
        let scene = ideal(name);
        let heights = MoldHeights::new(&scene).expect("a mold");
        let formation = Formation::new(&scene, &heights, RING).expect("a target");
        let (lines, targets) =
            (scene.layup.ply.lines(), &scene.layup.target.as_ref().expect("a target").grippers);
        let mold = scene.layup.mold.as_ref().expect("a mold");
        for k in 0..=10 {
            let front = formation.reach() * f64::from(k) / 10.0;
            let grippers = formation.grippers(front);
            for edge in 0..lines.edges() {
                let c = lines.catenary(edge);
                let [a, b] = lines.ends(edge).map(|gripper| grippers[gripper]);
                let most = scene.layup.ply.flat_length(edge) * (1.0 + 2e-4);
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

/// A trajectory begins at the start and ends at the target, to the last bit, in the number of steps of the scene; with a
/// move limit no step is longer where the path allows it.
#[test]
fn a_trajectory_goes_from_start_to_target_in_its_steps() {
    let mut scene = ideal("04_dome");
    let heights = MoldHeights::new(&scene).expect("a mold");
    for steps in [30, 90] {
        scene.plan.steps = steps;
        let positions = trajectory(&scene, &heights, RING).expect("a target");
        assert_eq!(positions.len(), steps);
        assert_eq!(positions[0], scene.layup.motion.positions[0]);
        assert_eq!(positions[steps - 1], scene.layup.target.as_ref().expect("a target").grippers);
    }
    let longest = |positions: &[Vec<[f64; 3]>]| {
        let pairs = positions.windows(2).flat_map(|pair| pair[0].iter().zip(&pair[1]));
        pairs.map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max)
    };
    let free = longest(&trajectory(&scene, &heights, RING).expect("a target"));
    scene.plan.move_limit = Some(0.5 * free);
    let limited = longest(&trajectory(&scene, &heights, RING).expect("a target"));
    assert!(free > 1e-3 && limited <= 0.5 * free, "{free} {limited}");
}

/// A scene scaled by 10 has the scaled trajectory, because no constant of a front is a length. 1e-5 of a cell is room
/// for the net on the lifted mold, which differs by 2e-6; a height of landing in meters makes 1.5e-4.
#[test]
fn a_scaled_scene_has_the_scaled_trajectory() {
    let planned = |s: f64| {
        let text = format!(
            "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [4, 4]\ncell = [{c}, {c}]\nmaterial = \"krogh2018\"\n\
             [mold]\nkind = \"sphere\"\nradius = {r}\nposition = [0, 0, -{r}]\n\
             [grippers]\nspacing = [{d}, {d}]\nheight = {h}\norigin = \"centered\"\n\
             [target]\nseed = \"middle\"\n[motion]\nkind = \"straight\"\nsteps = 30\n",
            c = 0.1 * s,
            r = 0.6 * s,
            d = 0.098 * s,
            h = 0.05 * s,
        );
        let scene = parse(&text);
        let heights = MoldHeights::new(&scene).expect("a mold");
        trajectory(&scene, &heights, RING).expect("a target")
    };
    for (a, b) in planned(1.0).iter().flatten().zip(planned(10.0).iter().flatten()) {
        assert!(distance(a.map(|c| 10.0 * c), *b) < 1e-5, "{a:?} {b:?}");
    }
}

/// On a mold that curves alike in all directions the first fronts follow the lines of grippers: turned with its target, a scene has
/// the fronts turned with it. On a cylinder they follow its axis, however the ply lies.
#[test]
fn the_first_fronts_turn_with_the_ply_unless_the_mold_has_a_direction() {
    let molds = [
        ("kind = \"plane\"", 40.0),
        ("kind = \"sphere\"\nradius = 0.6\nposition = [0, 0, -0.6]", 40.0),
        ("kind = \"cylinder\"\nradius = 0.6\nposition = [0, 0, -0.6]", 0.0),
    ];
    for (mold, expected) in molds {
        let angles = |direction: f64| {
            let text = format!(
                "[ply]\ngrippers = [4, 3]\ncell = [0.1, 0.08]\nmaterial = \"krogh2018\"\n[mold]\n{mold}\n\
                 [grippers]\nspacing = [0.098, 0.078]\nheight = 0.1\norigin = \"centered\"\n\
                 [target]\nseed = \"middle\"\ndirection = \"{direction} deg\"\n\
                 [motion]\nkind = \"straight\"\nsteps = 10\n",
            );
            let families = Strategy::families(&parse(&text), |_| 0.4);
            let directed = families.into_iter().filter(|strategy| strategy.ratio > 1.0);
            directed.map(|strategy| strategy.angle.to_degrees()).collect::<Vec<_>>()
        };
        let (level, turned) = (angles(0.0), angles(40.0));
        assert!(level.len() > 4 && level.len() == turned.len(), "{mold}");
        for (before, after) in level.iter().zip(&turned) {
            let off = (after - before - expected).rem_euclid(180.0);
            assert!(off.min(180.0 - off) < 0.5, "{mold}: {before}° {after}°");
        }
    }
}

/// A strategy is a point of the search's cube and back; a point outside the cube is reflected into it.
#[test]
fn a_strategy_is_a_point_of_the_search_and_back() {
    for strategy in Strategy::families(&example("06_saddle"), |_| 0.4) {
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
