//! The equilibrium of a ply against printed reference values, its own optimality conditions and
//! central differences.

use crate::common::{cases, inextensible, paper_ply, settings, squares_of_forces};
use plydrape::catenary::Profile;
use plydrape::equilibrium::{Direction, Property, Solver, Status};
use plydrape::layup::{Settings, SlopeRule};
use plydrape::material::Section;
use plydrape::ply::{Grid, Kind, Lines, Ply};
use proptest::prelude::*;

fn level(grid: Grid, spacing: f64) -> Vec<[f64; 3]> {
    (0..grid.grippers())
        .map(|n| {
            let [i, j] = grid.id(n);
            [i as f64 * spacing, j as f64 * spacing, 0.0]
        })
        .collect()
}

fn forces(solver: &Solver, kind: Kind) -> Vec<f64> {
    let grid_kind = |n: usize| {
        let element = &solver.problem().elements[n];
        (element.catenary, solver.force(n).expect("it hangs"))
    };
    let lines = Lines::array(Grid { nu: 4, nv: 2 }, [0.1; 2]);
    (0..solver.problem().elements.len())
        .map(grid_kind)
        .filter(|(catenary, _)| lines.catenary(*catenary).kind == kind)
        .map(|(_, force)| force)
        .collect()
}

fn close(found: &[f64], expected: &[f64], tolerance: f64) {
    assert_eq!(found.len(), expected.len());
    for (a, b) in found.iter().zip(expected) {
        assert!((a - b).abs() <= tolerance, "{found:?} for {expected:?}");
    }
}

/// Reference of the model description: 4 × 2 grippers 98 mm apart, all slack, inextensible, worked out
/// with a different program; all digits printed there.
#[test]
fn min_force_meets_the_reference_solution() {
    let ply = paper_ply(4, 2);
    let mut solver = Solver::new(&ply, &inextensible(SlopeRule::MinForce));
    let outcome = solver.solve(&level(ply.grid, 0.098), &vec![None; 16]);
    assert_eq!(outcome.status, Status::Converged);
    close(&forces(&solver, Kind::EdgeU), &[0.372456, 0.332103, 0.372456].repeat(2), 6e-7);
    close(&forces(&solver, Kind::EdgeV), &[0.417284; 4], 6e-7);
    for kind in [Kind::Rising, Kind::Falling] {
        close(&forces(&solver, kind), &[0.605601, 0.574293, 0.605601], 6e-7);
    }
    close(solver.slopes(), &[-0.022395, 0.022395, -0.022395, 0.022395], 6e-7);
    let all = (0..16).map(|n| solver.force(n).expect("hangs").powi(2)).sum::<f64>().sqrt();
    close(&[all], &[1.897002], 6e-7);
}

/// The comparison with the moments balanced.
#[test]
fn moment_balance_meets_the_reference_solution() {
    let ply = paper_ply(4, 2);
    let mut solver = Solver::new(&ply, &inextensible(SlopeRule::MomentBalance));
    let outcome = solver.solve(&level(ply.grid, 0.098), &vec![None; 16]);
    assert_eq!(outcome.status, Status::Converged);
    close(&forces(&solver, Kind::EdgeU), &[0.37426, 0.32819, 0.37426].repeat(2), 6e-6);
    close(solver.slopes(), &[-0.00130, 0.00130, -0.00130, 0.00130], 6e-6);
}

/// Gripper arrays of several sizes, spacings from slack to stretched, uneven heights, some sheared.
fn any_array() -> impl Strategy<Value = (Ply, Vec<[f64; 3]>)> {
    (2usize..6, 1usize..5, 0.9..1.0, -0.4..0.4, 0.0..0.02, prop::collection::vec(-1.0..1.0, 3 * 30))
        .prop_map(|(nu, nv, spacing, shear, noise, random)| {
            let ply = paper_ply(nu, nv);
            let positions = (0..ply.grid.grippers())
                .map(|n| {
                    let [i, j] = ply.grid.id(n).map(|k| 0.1 * spacing * k as f64);
                    let r = |k: usize| noise * random[3 * n + k];
                    let (sin, cos) = f64::sin_cos(shear);
                    [i + j * sin + 0.2 * r(0), j * cos + 0.2 * r(1), 0.05 + 3.0 * r(2)]
                })
                .collect();
            (ply, positions)
        })
}

fn any_rule() -> impl Strategy<Value = Settings> {
    (any::<bool>(), prop::sample::select(vec![3.0, 15.0, 40.0])).prop_map(|(min_force, tilt)| {
        let rule = if min_force { SlopeRule::MinForce } else { SlopeRule::MomentBalance };
        Settings { max_tilt: f64::to_radians(tilt), ..settings(rule) }
    })
}

proptest! {
    #![proptest_config(cases(300))]

    /// Every length is met, and no slope within the bounds does better (min-force) or leaves a moment
    /// (moment-balance).
    #[test]
    fn an_equilibrium_satisfies_its_rule((ply, positions) in any_array(), settings in any_rule()) {
        let contacts = vec![None; ply.lines().catenaries()];
        let mut solver = Solver::new(&ply, &settings);
        let outcome = solver.solve(&positions, &contacts);
        prop_assert_eq!(outcome.status, Status::Converged, "{:?}", outcome);
        prop_assert!(outcome.residual < 1e-8);
        for n in 0..solver.problem().elements.len() {
            let Some(force) = solver.force(n) else { continue };
            let span = solver.span(n);
            let chord = span.chord() / span.run;
            let goal = span.length * (1.0 + force * chord / span.axial_stiffness);
            let length = Profile::new(&span, force).length_and_excess::<3>().0.value;
            prop_assert!((length / goal - 1.0).abs() < 1e-9, "{} {length} {goal}", n);
        }
        let bound = settings.max_tilt.tan();
        let slopes = solver.slopes().to_vec();
        for (joint, slope) in slopes.iter().enumerate() {
            prop_assert!(slope.abs() <= bound);
            if settings.slopes == SlopeRule::MinForce {
                let best = squares_of_forces(&solver, &slopes);
                for delta in [-1e-4, 1e-4] {
                    let mut other = slopes.clone();
                    other[joint] = (slope + delta).clamp(-bound, bound);
                    prop_assert!(squares_of_forces(&solver, &other) >= best * (1.0 - 1e-10), "joint {}", joint);
                }
            } else {
                let moment = |k: usize| {
                    let element = solver.problem().shared_slopes()[joint].elements[k];
                    let span = solver.span(element);
                    let profile = Profile::new(&span, solver.force(element).expect("hangs"));
                    profile.station(if k == 0 { span.run } else { 0.0 }).moment
                };
                let (before, after) = (moment(0), moment(1));
                let scale = before.abs().max(after.abs()).max(1e-6);
                let jump = before - after;
                let carried = (*slope >= bound && jump < 0.0) || (*slope <= -bound && jump > 0.0);
                // a slope off by 1e-7 leaves a moment of 1e-7 √(EI H) of the tauter edge
                let root = |element: &usize| {
                    let force = solver.force(*element).expect("hangs").abs();
                    (solver.span(*element).flexural_rigidity * force).sqrt()
                };
                let stiffness = solver.problem().shared_slopes()[joint].elements.iter().map(root).fold(0.0, f64::max);
                let small = (before - after).abs() < 1e-7 * stiffness + 1e-9 * scale;
                prop_assert!(small || carried, "joint {}: {} {}", joint, before, after);
            }
        }
    }

    /// A warm start reaches the same state as a cold one.
    #[test]
    fn a_warm_start_changes_nothing((ply, positions) in any_array(), settings in any_rule()) {
        let contacts = vec![None; ply.lines().catenaries()];
        let mut warm = Solver::new(&ply, &settings);
        warm.solve(&level(ply.grid, 0.097), &contacts);
        let first = warm.solve(&positions, &contacts);
        let mut cold = Solver::new(&ply, &settings);
        let second = cold.solve(&positions, &contacts);
        prop_assert_eq!((first.status, second.status), (Status::Converged, Status::Converged), "{:?} {:?}", first, second);
        for (a, b) in warm.slopes().iter().zip(cold.slopes()) {
            prop_assert!((a - b).abs() < 1e-7, "{a} {b}");
        }
        for n in 0..cold.problem().elements.len() {
            let (a, b) = (warm.force(n).unwrap_or(0.0), cold.force(n).unwrap_or(0.0));
            prop_assert!((a - b).abs() < 1e-6 * b.abs().max(0.1), "{n}: {a} {b}");
        }
    }

    /// Sensitivities to gripper positions, lengths and material agree with central differences.
    #[test]
    fn tangents_agree_with_central_differences(
        (ply, positions) in any_array(),
        settings in any_rule(),
        random in prop::collection::vec(-1.0..1.0, 3 * 30),
        others in (prop::array::uniform2(-1.0..1.0), prop::array::uniform3(-1.0..1.0)),
    ) {
        let contacts = vec![None; ply.lines().catenaries()];
        let count = ply.grid.grippers();
        let ([mass, rigidity], [along_u, along_v, _]) = others;
        let Section::Line { mass: m, flexural_rigidity: ei } = ply.material.section else { panic!() };
        // a sum of directions, each with its own unit
        let parts = [
            (Direction::property(&ply, Property::Mass).unwrap(), mass * m),
            (Direction::property(&ply, Property::FlexuralRigidity).unwrap(), rigidity * ei),
            (Direction::cell(&ply, 0), 0.01 * along_u * ply.cell[0]),
            (Direction::cell(&ply, 1), 0.01 * along_v * ply.cell[1]),
        ];
        let mut direction = Direction::none(count);
        direction.grippers = (0..count).map(|n| [0, 1, 2].map(|k| 0.01 * random[3 * n + k])).collect();
        for (part, factor) in &parts {
            for n in 0..3 {
                direction.length[n] += factor * part.length[n];
                direction.weight[n] += factor * part.weight[n];
                direction.rigidity[n] += factor * part.rigidity[n];
            }
        }
        let solved_at = |h: f64| {
            let mut ply = ply.clone();
            ply.cell[0] *= 1.0 + h * 0.01 * along_u;
            ply.cell[1] *= 1.0 + h * 0.01 * along_v;
            ply.material.section = Section::Line {
                mass: m * (1.0 + h * mass),
                flexural_rigidity: ei * (1.0 + h * rigidity),
            };
            let moved: Vec<_> = positions.iter().zip(&direction.grippers)
                .map(|(p, v)| [0, 1, 2].map(|k| p[k] + h * v[k])).collect();
            let mut solver = Solver::new(&ply, &settings);
            let outcome = solver.solve(&moved, &contacts);
            (solver, outcome)
        };
        let h = 1e-5;
        let ((middle, outcome), (low, _), (high, _)) = (solved_at(0.0), solved_at(-h), solved_at(h));
        prop_assume!(outcome.status == Status::Converged);
        // the state is differentiable here: the same spans, shear and active bounds on both sides
        let bound = settings.max_tilt.tan();
        let kind = |s: &Solver| (
            s.problem().shearing.iter().map(|s| s.map(|(_, f)| f)).collect::<Vec<_>>(),
            s.slopes().iter().map(|s| s.abs() >= bound).collect::<Vec<_>>(),
            s.problem().elements.iter().map(|e| e.state).collect::<Vec<_>>(),
        );
        prop_assume!(kind(&low) == kind(&middle) && kind(&high) == kind(&middle));
        // min-force may have several minima (mirror images in a symmetric ply): all on one of them
        let jump = low.slopes().iter().zip(high.slopes()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        prop_assume!(jump < 0.01);
        let tangent = middle.linearize(&positions, &contacts).along(&direction);
        for (j, slope) in tangent.slopes.iter().enumerate() {
            let difference = (high.slopes()[j] - low.slopes()[j]) / (2.0 * h);
            prop_assert!((slope - difference).abs() < 1e-4 * (1.0 + difference.abs()), "slope {j}: {slope} {difference}");
        }
        for n in 0..middle.problem().elements.len() {
            let Some(force) = middle.force(n) else { continue };
            let difference = (high.force(n).unwrap_or(0.0) - low.force(n).unwrap_or(0.0)) / (2.0 * h);
            let scale = force.abs() + difference.abs();
            prop_assert!((tangent.force[n] - difference).abs() < 1e-4 * scale,
                "force {n}: {} {difference}", tangent.force[n]);
            for end in 0..2 {
                let difference = (high.end_slopes(n)[end] - low.end_slopes(n)[end]) / (2.0 * h);
                prop_assert!((tangent.end_slopes[n][end] - difference).abs() < 1e-4 * (1.0 + difference.abs()));
            }
        }
    }
}
