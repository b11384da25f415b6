//! Slopes that shearing cells constrain: geometry of inclined plies, the onset of shear, derivatives through it.

use crate::common::{Point, RULES, free, paper_ply, settings};
use plydrape::equilibrium::{Direction, Solver, Status, heading};
use plydrape::layup::SlopeRule;
use plydrape::ply::{Grid, Lines, shear};

/// Parallelogram cells of sides 97.5 mm, sheared by `angle` (rad) in the horizontal plane.
fn sheared(grid: Grid, angle: f64) -> Vec<Point> {
    let side = 0.0975;
    let places = (0..grid.grippers()).map(|n| grid.id(n).map(|k| side * k as f64));
    places.map(|[u, v]| [u + v * angle.sin(), v * angle.cos(), 0.0]).collect()
}

/// Points turned about z by `turn`, then tilted so that it climbs by `climb` (rad) towards `towards`.
fn posed(points: &[Point], turn: f64, climb: f64, towards: f64) -> Vec<Point> {
    let (s, c) = turn.sin_cos();
    let (st, ct) = towards.sin_cos();
    let (sc, cc) = climb.sin_cos();
    let pose = |p: &Point| {
        let (x, y) = (c * p[0] - s * p[1], s * p[0] + c * p[1]);
        let (along, across) = (ct * x + st * y, -st * x + ct * y);
        let (along, z) = (along * cc, along * sc);
        [ct * along - st * across, st * along + ct * across, z + 0.2]
    };
    points.iter().map(pose).collect()
}

/// Normal of the ply at a gripper, from its slopes along u and v; `None` where an edge is missing.
fn normal(solver: &Solver, lines: &Lines, positions: &[Point], gripper: usize) -> Option<Point> {
    let tangent = |d| {
        let h = heading(lines, positions, gripper, d)?;
        Some([h[0], h[1], solver.gripper_slope(positions, gripper, d)?])
    };
    let ([a, b], [c, d], [e, f]) = {
        let (u, v): (Point, Point) = (tangent(0)?, tangent(1)?);
        ([u[0], u[1]], [u[2], v[0]], [v[1], v[2]])
    };
    let n = [b * f - c * e, c * d - a * f, a * e - b * d];
    let size = n.iter().map(|x| x * x).sum::<f64>().sqrt().copysign(n[2]);
    Some(n.map(|x| x / size))
}

/// A sheared ply that lies in a plane has that plane's normal at every gripper that a shearing cell constrains: the
/// invariant by which the constrained slopes are defined. To rounding, for all headings of the climb, turned,
/// mirrored, both senses of shear.
#[test]
fn a_sheared_ply_in_an_inclined_plane_has_its_normal_at_every_constrained_gripper() {
    let ply = paper_ply(4, 3);
    let grid = ply.grid;
    for rule in RULES {
        for (n, angle) in [15f64, -15.0, 15.0].into_iter().enumerate() {
            for twelfth in 0..12 {
                let towards = f64::from(twelfth) * 30f64.to_radians();
                let mut level = sheared(grid, angle.to_radians());
                if n == 2 {
                    level.iter_mut().for_each(|p| p[1] = -p[1]);
                }
                let turn = 0.3 * f64::from(twelfth);
                let positions = posed(&level, turn, 20f64.to_radians(), towards);
                let mut solver = Solver::new(&ply, &settings(rule));
                let outcome = solver.solve(&positions, &free(&ply));
                assert_eq!(outcome.status, Status::Converged, "{outcome:?}");
                let (sin, cos) = 20f64.to_radians().sin_cos();
                let expected = [-sin * towards.cos(), -sin * towards.sin(), cos];
                let mut constrained = 0;
                for gripper in 0..grid.grippers() {
                    let Some(constraint) = solver.problem().constraints[gripper] else {
                        continue;
                    };
                    constrained += 1;
                    let found = normal(&solver, &ply.lines(), &positions, gripper)
                        .expect("edges both ways");
                    for k in 0..3 {
                        assert!((constraint.normal[k] - expected[k]).abs() < 1e-13);
                        assert!((found[k] - expected[k]).abs() < 1e-12, "{found:?} {expected:?}");
                    }
                }
                assert_eq!(constrained, 10, "all but two corners lie on a stretched diagonal");
            }
        }
    }
}

/// On a level ply every constrained slope is 0, the stretched diagonal's own: the paper's rule, to the last digit.
#[test]
fn a_level_sheared_ply_has_level_constrained_grippers() {
    let ply = paper_ply(4, 2);
    let positions = sheared(ply.grid, 0.3);
    let mut solver = Solver::new(&ply, &settings(SlopeRule::MinForce));
    solver.solve(&positions, &free(&ply));
    for gripper in 0..8 {
        if solver.problem().constraints[gripper].is_some() {
            for d in 0..2 {
                let slope = solver.gripper_slope(&positions, gripper, d).expect("an edge");
                assert!(slope == 0.0 && slope.is_sign_positive(), "{slope}");
            }
        }
    }
}

/// A diagonal through two cells that shear alike out of level, each in its own plane: at the shared gripper the
/// normal is the mean of both, each with its weight, and in the limit of one cell's onset it is the other's alone.
#[test]
fn where_shearing_cells_meet_their_planes_are_averaged() {
    let ply = paper_ply(3, 2);
    let mut positions = sheared(ply.grid, 0.3);
    positions[2][2] = 0.03;
    positions[5][2] = 0.03;
    let mut solver = Solver::new(&ply, &settings(SlopeRule::MinForce));
    solver.solve(&positions, &free(&ply));
    let normal = |n: usize| solver.problem().constraints[n].expect("a stretched diagonal").normal;
    // gripper 4 ends the first cell's diagonal, 1 begins the second's, 0 and 5 see one cell alone
    assert_eq!(normal(0), normal(4));
    assert_eq!(normal(1), normal(5));
    let ply = self::paper_ply(3, 3);
    let mut positions = sheared(ply.grid, 0.3);
    for n in [2, 5, 8] {
        positions[n][2] = 0.03;
    }
    let mut solver = Solver::new(&ply, &settings(SlopeRule::MinForce));
    solver.solve(&positions, &free(&ply));
    let normal = |n: usize| solver.problem().constraints[n].expect("a stretched diagonal").normal;
    // the middle gripper: lower left cell's plane (level) and upper right one's
    let sum = [0, 1, 2].map(|k| normal(0)[k] + normal(8)[k]);
    let size = sum.iter().map(|x| x * x).sum::<f64>().sqrt();
    for k in 0..3 {
        assert!((normal(4)[k] - sum[k] / size).abs() < 1e-14);
    }
}

/// A ply out of level and out of plane, its shear given: no special position.
fn crooked(grid: Grid, angle: f64) -> Vec<Point> {
    let mut positions = posed(&sheared(grid, angle), 0.4, 0.2, 1.1);
    for (n, p) in positions.iter_mut().enumerate() {
        p[2] += 0.004 * (2.3 * n as f64).sin();
    }
    positions
}

/// Slopes at all ends of edges at all grippers.
fn all_slopes(solver: &Solver) -> Vec<f64> {
    let edges = solver.problem().edge_elements;
    (0..edges).flat_map(|n| solver.end_slopes(n)).collect()
}

/// Slopes do not jump as one cell begins to shear or ends its onset: over steps of 0.01° of shear no slope moves by more
/// than the smoothstep lets it, 1.5·0.01°/3° of the whole change and what the motion itself does; and just before
/// and just behind the onset they agree.
#[test]
fn slopes_are_continuous_over_the_onset_of_shear() {
    let ply = paper_ply(2, 2);
    for rule in RULES {
        let mut solver = Solver::new(&ply, &settings(rule));
        let mut before: Option<Vec<f64>> = None;
        let (mut largest, mut whole) = (0.0_f64, 0.0_f64);
        let mut first = Vec::new();
        for step in 0..1000 {
            let angle = (2.0 + 0.01 * f64::from(step)).to_radians();
            let outcome = solver.solve(&crooked(ply.grid, angle), &free(&ply));
            assert_eq!(outcome.status, Status::Converged, "{outcome:?}");
            let slopes = all_slopes(&solver);
            if let Some(before) = before.replace(slopes.clone()) {
                for (a, b) in before.iter().zip(&slopes) {
                    largest = largest.max((a - b).abs());
                }
            } else {
                first = slopes.clone();
            }
            for (a, b) in first.iter().zip(&slopes) {
                whole = whole.max((a - b).abs());
            }
        }
        assert!(whole > 0.2, "the onset is passed: {whole}");
        assert!(largest < 1.5 * whole * 0.01 / 3.0 + 2e-4, "{largest} of {whole}");
    }
}

/// Where all cells of a ply begin to shear at once, as in the paper's example, no slope jumps either.
#[test]
fn slopes_are_continuous_where_all_cells_begin_to_shear_at_once() {
    let ply = paper_ply(4, 2);
    for rule in RULES {
        let mut solver = Solver::new(&ply, &settings(rule));
        // the onset is where 2·97.5² (1 + sin γ) = 2·100² mm²; bracket it ever closer
        let onset = (1.0 / (0.975 * 0.975) - 1.0_f64).asin();
        let mut slopes = |angle: f64| {
            let positions = posed(&sheared(ply.grid, angle), 0.4, 0.2, 1.1);
            let outcome = solver.solve(&positions, &free(&ply));
            assert_eq!(outcome.status, Status::Converged, "{outcome:?}");
            all_slopes(&solver)
        };
        let (before, after) = (slopes(onset - 1e-7), slopes(onset + 1e-7));
        let jump = before.iter().zip(&after).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let (mut before, mut largest) = (after, 0.0_f64);
        for step in 1..400 {
            let after = slopes(onset + 1e-7 + (0.01 * f64::from(step)).to_radians());
            let moved = before.iter().zip(&after).map(|(a, b)| (a - b).abs());
            largest = moved.fold(largest, f64::max);
            before = after;
        }
        // forces of least norm turn fast where a diagonal becomes taut, shear or none: by 3.5° in 0.01°
        let steep = if rule == SlopeRule::MinForce { 0.1 } else { 0.003 };
        assert!(jump < 1e-3 && largest < steep, "{rule:?} {jump} {largest}");
    }
}

/// Every derivative of a state inside the onset, off the level, agrees with central differences: with each gripper's
/// coordinates, with lengths, weight and rigidity.
#[test]
fn derivatives_in_the_onset_agree_with_central_differences() {
    for rule in RULES {
        for (nu, nv, angle) in [(2, 2, 4.0f64), (3, 2, 4.4), (4, 3, 3.9)] {
            let ply = paper_ply(nu, nv);
            let positions = crooked(ply.grid, angle.to_radians());
            let contacts = free(&ply);
            let count = ply.grid.grippers();
            let mut direction = Direction::none(count);
            for n in 0..count {
                direction.grippers[n] = [0, 1, 2].map(|k| 0.02 * (1.7 * (3 * n + k) as f64).cos());
            }
            let solved = |h: f64| {
                let moved: Vec<Point> = positions
                    .iter()
                    .zip(&direction.grippers)
                    .map(|(p, v)| [0, 1, 2].map(|k| p[k] + h * v[k]))
                    .collect();
                let mut solver = Solver::new(&ply, &settings(rule));
                let outcome = solver.solve(&moved, &contacts);
                assert_eq!(outcome.status, Status::Converged, "{outcome:?}");
                (solver, moved)
            };
            let h = 2e-5;
            let ((middle, _), (low, below), (high, above)) = (solved(0.0), solved(-h), solved(h));
            assert!(middle.problem().is_partly_constrained(), "not in the onset");
            let mut linearized = middle.linearize(&positions, &contacts);
            let tangent = linearized.along(&direction);
            assert!(tangent.is_sound && linearized.is_sound());
            let close = |found: f64, low: f64, high: f64, scale: f64| {
                let difference = (high - low) / (2.0 * h);
                let scale = scale.max(difference.abs());
                assert!((found - difference).abs() < 1e-4 * scale, "{found} {difference}");
            };
            for n in 0..middle.problem().elements.len() {
                for end in 0..2 {
                    let slopes = [&low, &high].map(|s| s.end_slopes(n)[end]);
                    close(tangent.end_slopes[n][end], slopes[0], slopes[1], 1.0);
                }
                if let Some(force) = middle.force(n) {
                    let forces = [&low, &high].map(|s| s.force(n).expect("it hangs"));
                    close(tangent.force[n], forces[0], forces[1], force.abs());
                }
            }
            for gripper in 0..count {
                for d in 0..2 {
                    let slope = |s: &Solver, p: &[Point]| s.gripper_slope(p, gripper, d);
                    let (low, high) = (slope(&low, &below), slope(&high, &above));
                    let [low, high] = [low, high].map(|s| s.expect("edges both ways"));
                    close(tangent.grippers[gripper][d], low, high, 1.0);
                }
            }
        }
    }
}

/// The weight of a plane and its slope: 0 at the onset, ½ half way, 1 at the end, level at both ends.
#[test]
fn the_onset_s_weight_is_a_smoothstep_of_the_shear_angle() {
    let full = 3f64.to_radians();
    let stretched = |angle: f64| (0.02 + 0.02 * angle.sin()).sqrt();
    let weight = |angle: f64| shear::onset([0.1, 0.1], stretched(angle), full);
    assert_eq!(weight(-0.1), 0.0);
    assert!(weight(1e-6) < 2e-9);
    assert!((weight(0.5 * full) - 0.5).abs() < 1e-12);
    assert!(1.0 - weight(full * (1.0 - 1e-6)) < 1e-11);
    assert_eq!(weight(full * 1.001), 1.0);
}

/// Virtual work: the stretched diagonal's force times its lengthening is the shear force per length times the area
/// times the change of the shear angle; by central differences.
#[test]
fn the_stretched_diagonal_s_force_does_the_work_of_the_shear() {
    let (sides, tau): ([f64; 2], f64) = ([0.12, 0.08], 35.0);
    for stretched in [0.15, 0.16, 0.18] {
        let h = 1e-7;
        let angle = |d: f64| shear::angle(sides, d);
        let work =
            tau * sides[0] * sides[1] * (angle(stretched + h) - angle(stretched - h)) / (2.0 * h);
        let force = shear::force(angle(stretched), stretched, tau);
        assert!((force / work - 1.0).abs() < 1e-7, "{force} {work}");
    }
}
