//! Ply and mounts against closed forms, limits, invariants and central differences.

use super::{Continuation, MountedSolver, Standing};
use crate::catenary::{EndCondition, Span};
use crate::equilibrium::{Direction, Equilibrium, Property, Solver, Status, Tuning};
use crate::layup::{PadSettings, Settings, SlopeRule};
use crate::material::{Material, Section, ShearCurve};
use crate::ply::{Grid, Ply};

const RULES: [SlopeRule; 2] = [SlopeRule::MinForce, SlopeRule::MomentBalance];

fn ply(nu: usize, nv: usize) -> Ply {
    Ply::of_array(
        Grid { nu, nv },
        [0.1; 2],
        Material {
            name: "krogh2018".into(),
            source: "Krogh et al. 2018, Table 1".into(),
            section: Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 },
            shear_curve: None,
            tension: None,
            locking_angle: None,
            moment: Default::default(),
            scatter: Default::default(),
        },
    )
}

fn pads(lateral: Option<f64>, axial: Option<f64>) -> PadSettings {
    PadSettings { lateral_stiffness: lateral, axial_stiffness: axial, ..PadSettings::default() }
}

fn settings(slopes: SlopeRule, pad: PadSettings) -> Settings {
    Settings { slopes, pad, ..Settings::default() }
}

/// Level grippers at a spacing, turned by half a radian so that no line runs along an axis.
fn turned(grid: Grid, spacing: f64) -> Vec<[f64; 3]> {
    let (s, c) = 0.5_f64.sin_cos();
    let place = |n: usize| {
        let [x, y] = grid.id(n).map(|k| spacing * k as f64);
        [c * x - s * y, s * x + c * y, 0.05]
    };
    (0..grid.grippers()).map(place).collect()
}

/// Level grippers along the axes.
fn level(grid: Grid, spacing: f64) -> Vec<[f64; 3]> {
    let place = |n: usize| {
        let [x, y] = grid.id(n).map(|k| spacing * k as f64);
        [x, y, 0.05]
    };
    (0..grid.grippers()).map(place).collect()
}

/// Places without any symmetry, some millimeters from level ones.
fn uneven(grid: Grid, spacing: f64) -> Vec<[f64; 3]> {
    let mut places = turned(grid, spacing);
    for (n, place) in places.iter_mut().enumerate() {
        let x = n as f64;
        place[0] += 1e-3 * (1.3 * x).sin();
        place[1] += 1e-3 * (2.1 * x).cos();
        place[2] += 4e-3 * (1.7 * x).sin();
    }
    places
}

/// A ply on its mounts, solved.
struct Solved {
    solver: Solver,
    mounts: MountedSolver,
    found: Equilibrium,
}

fn solved(ply: &Ply, settings: &Settings, commanded: &[[f64; 3]]) -> Solved {
    let mut solver = Solver::new(ply, settings);
    let mut mounts = MountedSolver::new(ply, settings).expect("mounts yield");
    let contacts = vec![None; ply.lines().catenaries()];
    let found = mounts.solve(&mut solver, commanded, &contacts, Continuation::IfNeeded);
    Solved { solver, mounts, found }
}

fn balanced(ply: &Ply, settings: &Settings, commanded: &[[f64; 3]]) -> Solved {
    let solved = solved(ply, settings, commanded);
    assert_eq!(solved.found.status, Status::Converged, "{:?}", solved.found);
    solved
}

/// Two pads on springs under a strip: each goes inwards by d, where k d = H(ℓ − 2d) of the span between them, which an
/// independent bisection finds. A limp strip that does not stretch, a stiff one, and a strip that is taut to begin with.
#[test]
fn a_span_draws_its_pads_in_until_the_springs_hold_its_force() {
    let taut = (0.1002, f64::INFINITY);
    for (spacing, axial) in [(0.098, 1e5), (0.0999, 1e5), (0.0999, f64::INFINITY), taut] {
        for stiffness in [10.0, 2e3, 1e6] {
            let ply = ply(2, 1);
            let pad = pads(Some(stiffness), None);
            let settings =
                Settings { axial_stiffness: axial, ..settings(SlopeRule::MomentBalance, pad) };
            let force = |run: f64| {
                let span = Span {
                    run,
                    rise: 0.0,
                    length: 0.1,
                    ends: [EndCondition::Free; 2],
                    weight: 0.3143 * settings.gravity,
                    flexural_rigidity: 9e-6,
                    axial_stiffness: axial,
                };
                span.solve(None).force.unwrap_or(f64::INFINITY)
            };
            let (mut low, mut high) = (0.0, 0.5 * spacing);
            for _ in 0..200 {
                let d = 0.5 * (low + high);
                if stiffness * d < force(spacing - 2.0 * d) { low = d } else { high = d }
            }
            let solved = balanced(&ply, &settings, &turned(ply.grid, spacing));
            let [first, second] = [0, 1].map(|n| solved.mounts.pads()[n]);
            let run = (second[0] - first[0]).hypot(second[1] - first[1]);
            let d = 0.5 * (spacing - run);
            assert!((d - high).abs() < 1e-8 * high, "{spacing} {axial} {stiffness}: {d} {high}");
            let pull = solved.mounts.gripper_force(0);
            let pull = pull[0].hypot(pull[1]);
            assert!((pull - stiffness * high).abs() < 1e-7 * pull, "{pull}");
        }
    }
}

/// A strip pulled far beyond its length is a spring between two springs: its force is δ/(L/EA + 2/k) for grippers δ too far
/// apart, but for the sag, which takes w²L³/24H² of length.
#[test]
fn a_taut_span_and_its_mounts_are_springs_in_series() {
    let ply = ply(2, 1);
    for (stiffness, axial, beyond) in [(2e3, 1e3, 0.01), (2e3, 1e5, 0.01), (2e5, 1e5, 1e-3)] {
        let pad = pads(Some(stiffness), None);
        let settings = Settings { axial_stiffness: axial, ..settings(SlopeRule::MinForce, pad) };
        let solved = balanced(&ply, &settings, &level(ply.grid, 0.1 + beyond));
        let force = solved.mounts.gripper_force(0)[0];
        let compliance = 0.1 / axial + 2.0 / stiffness;
        let weight = 0.3143 * settings.gravity;
        let sag = weight * weight * 1e-3 / (24.0 * force * force);
        let expected = (beyond + sag) / compliance;
        assert!((force - expected).abs() < 1e-4 * expected, "{force} {expected}");
    }
}

/// As the mounts become stiffer the state tends to that of rigid grippers, ten times as near for ten times the stiffness.
#[test]
fn rigid_grippers_are_the_limit_of_stiff_mounts() {
    for slopes in RULES {
        let ply = ply(4, 3);
        let commanded = uneven(ply.grid, 0.098);
        let contacts = vec![None; ply.lines().catenaries()];
        let mut rigid = Solver::new(&ply, &settings(slopes, PadSettings::default()));
        assert_eq!(rigid.solve(&commanded, &contacts).status, Status::Converged);
        let elements = rigid.problem().elements.len();
        let off = |stiffness: f64| {
            let pad = pads(Some(stiffness), Some(2.0 * stiffness));
            let solved = balanced(&ply, &settings(slopes, pad), &commanded);
            let difference =
                |n: usize| (solved.solver.force(n).unwrap() - rigid.force(n).unwrap()).abs();
            (0..elements).map(difference).fold(0.0, f64::max)
        };
        let [coarse, middle, fine] = [1e6, 1e7, 1e8].map(off);
        for ratio in [coarse / middle, middle / fine] {
            assert!((ratio - 10.0).abs() < 0.1, "{slopes:?}: {coarse} {middle} {fine}");
        }
    }
}

/// The mounts together hold the weight of the ply, w times the chord of every edge at its share, and no horizontal force.
#[test]
fn all_mounts_together_hold_the_weight() {
    for slopes in RULES {
        for pad in [pads(Some(2e3), Some(5e3)), pads(Some(2e3), None), pads(None, Some(500.0))] {
            let mut ply = ply(4, 3);
            ply.material.shear_curve = Some(ShearCurve::Polynomial { coefficients: vec![5.0] });
            let mut commanded = uneven(ply.grid, 0.098);
            // sheared by about six degrees
            commanded.iter_mut().for_each(|place| place[0] += 0.1 * place[1]);
            let solved = balanced(&ply, &settings(slopes, pad), &commanded);
            assert!(solved.solver.problem().shearing.iter().any(Option::is_some));
            let mut sum = [0.0; 3];
            for n in 0..commanded.len() {
                let force = solved.mounts.gripper_force(n);
                (0..3).for_each(|axis| sum[axis] += force[axis]);
            }
            let weight: f64 = (solved.solver.problem().elements.iter())
                .filter(|element| element.catenary < ply.lines().edges())
                .map(|e| ply.lines().tributary(e.catenary) * e.weight * e.run.hypot(e.rise))
                .sum();
            let scale = 1e-8 * solved.mounts.largest_force();
            assert!((sum[2] + weight).abs() < scale.max(1e-9 * weight), "{sum:?} {weight}");
            assert!(sum[0].abs() < scale && sum[1].abs() < scale, "{sum:?}");
        }
    }
}

/// A cell that resists shear pulls at the corners of its longer diagonal and pushes at those of the shorter one, by how its
/// shear energy changes with them: one cell sheared by springs whose grippers are held at a shear of twenty degrees gives way
/// until the springs hold just that.
#[test]
fn a_cell_that_resists_shear_acts_along_both_diagonals() {
    let mut ply = ply(2, 2);
    ply.material.section = Section::Line { mass: 1e-6, flexural_rigidity: 0.0 };
    ply.material.shear_curve = Some(ShearCurve::Polynomial { coefficients: vec![50.0] });
    let settings = settings(SlopeRule::MomentBalance, pads(Some(2e3), None));
    let (s, c) = 20_f64.to_radians().sin_cos();
    let b = 0.0999;
    let commanded = [[0.0, 0.0], [b, 0.0], [b * s, b * c], [b + b * s, b * c]]
        .map(|[x, y]| [x, y, 0.0])
        .to_vec();
    let solved = balanced(&ply, &settings, &commanded);
    let pads = solved.mounts.pads();
    let diagonal = |from: usize, to: usize| {
        let line = [0, 1].map(|n| pads[to][n] - pads[from][n]);
        let length = line[0].hypot(line[1]);
        (length, line.map(|c| c / length))
    };
    let (rising, falling) = (diagonal(0, 3), diagonal(1, 2));
    let energy = |rising: f64, falling: f64| {
        let angle = ((rising * rising - falling * falling) / 0.04).asin();
        0.01 * 25.0 * angle * angle
    };
    let h = 1e-6;
    let tension = [
        (energy(rising.0 + h, falling.0) - energy(rising.0 - h, falling.0)) / (2.0 * h),
        (energy(rising.0, falling.0 + h) - energy(rising.0, falling.0 - h)) / (2.0 * h),
    ];
    assert!(tension[0] > 1.0 && tension[1] < -1.0, "{tension:?}");
    // the edges are slack and weigh almost nothing
    for (gripper, tension, along) in [(0, tension[0], rising.1), (1, tension[1], falling.1)] {
        let pull = solved.mounts.gripper_force(gripper);
        let found = pull[0] * along[0] + pull[1] * along[1];
        assert!((found - tension).abs() < 0.02 * tension.abs(), "{found} {tension}");
    }
}

/// Derivatives of the balanced state to where the robot holds the mounts, and to the material, against central differences:
/// every kind of mount, one of them sliding, pads on the mold, both rules.
#[test]
fn derivatives_with_mounts_agree_with_central_differences() {
    let slipping = PadSettings { slip_force: Some(0.2), ..pads(Some(2e3), Some(5e3)) };
    let all =
        [pads(Some(2e3), Some(5e3)), pads(Some(200.0), None), pads(None, Some(500.0)), slipping];
    for slopes in RULES {
        for (case, pad) in all.into_iter().enumerate() {
            let mut ply = ply(3, 2);
            ply.material.shear_curve = Some(ShearCurve::Polynomial { coefficients: vec![5.0] });
            let settings = settings(slopes, pad);
            let commanded = uneven(ply.grid, 0.0985);
            let contacts = vec![None; ply.lines().catenaries()];
            let mut base = balanced(&ply, &settings, &commanded);
            if case < 2 {
                // one pad stands where it is
                let standing = Standing { place: base.mounts.pads()[4], normal: [0.0, 0.0, 1.0] };
                base.mounts.stand(4, Some(standing));
                base.found = base.mounts.solve(
                    &mut base.solver,
                    &commanded,
                    &contacts,
                    Continuation::IfNeeded,
                );
            }
            if case == 3 {
                let slid = |n: usize| base.mounts.reactions()[n].slip != [0.0; 2];
                assert!((0..6).any(slid));
            }
            let mut linearized = base.mounts.linearize(&base.solver, &contacts);
            let mut compare = |direction: &Direction, at: &dyn Fn(f64) -> Solved, h: f64| {
                let (tangent, ways) = linearized.along(direction);
                assert!(tangent.is_sound, "{slopes:?} {case}");
                // central differences of fourth order
                let around = [-2.0, -1.0, 1.0, 2.0].map(|n| at(n * h));
                let differ = |read: &dyn Fn(&Solved) -> f64| {
                    let [a, b, c, d] = [0, 1, 2, 3].map(|n| read(&around[n]));
                    (a - 8.0 * b + 8.0 * c - d) / (12.0 * h)
                };
                for n in 0..base.solver.problem().elements.len() {
                    let difference = differ(&|s| s.solver.force(n).unwrap());
                    let off = (tangent.force[n] - difference).abs();
                    let scale = tangent.force.iter().fold(1.0_f64, |most, f| f.abs().max(most));
                    assert!(
                        off < 2e-5 * scale,
                        "{slopes:?} {case} force {n}: {} {difference}",
                        tangent.force[n]
                    );
                }
                for n in 0..6 {
                    for axis in 0..3 {
                        let difference = differ(&|s| s.mounts.pads()[n][axis]);
                        let way = ways[n][axis];
                        assert!(
                            (way - difference).abs() < 2e-5 * (1.0 + way.abs()),
                            "{slopes:?} {case} pad {n}: {way} {difference}"
                        );
                    }
                }
            };
            let again = |ply: &Ply, commanded: &[[f64; 3]]| {
                // differences magnify what a search leaves
                let solver = Solver::new(ply, &settings);
                let tuning = Tuning { mount_tolerance: 1e-12, ..*solver.tuning() };
                let mut solver = solver.with_tuning(tuning);
                let mut mounts = base.mounts.clone();
                let found = mounts.solve(&mut solver, commanded, &contacts, Continuation::IfNeeded);
                assert_eq!(found.status, Status::Converged);
                Solved { solver, mounts, found }
            };
            for (gripper, axis) in [(0, 0), (1, 1), (2, 2), (4, 0), (5, 2)] {
                let moved = |by: f64| {
                    let mut commanded = commanded.clone();
                    commanded[gripper][axis] += by;
                    again(&ply, &commanded)
                };
                compare(&Direction::gripper(&ply, gripper, axis), &moved, 1e-5);
            }
            let heavier = |by: f64| {
                let mut ply = ply.clone();
                let Section::Line { mass, .. } = &mut ply.material.section else { unreachable!() };
                *mass += by;
                again(&ply, &commanded)
            };
            compare(&Direction::property(&ply, Property::Mass).unwrap(), &heavier, 1e-5);
        }
    }
}

/// Pulled apart, a strip slides under its pads at exactly the slip force; brought back, the slide stays, and the fabric hangs
/// by as much more.
#[test]
fn fabric_slides_at_the_slip_force_and_the_slide_is_kept() {
    let ply = ply(2, 1);
    for stiffness in [Some(2e3), None] {
        let pad = PadSettings { slip_force: Some(6.0), ..pads(stiffness, None) };
        let settings = settings(SlopeRule::MomentBalance, pad);
        let contacts = vec![None; 1];
        let mut solver = Solver::new(&ply, &settings);
        let mut mounts = MountedSolver::new(&ply, &settings).unwrap();
        let mut at = |spacing: f64| {
            let found = mounts.solve(
                &mut solver,
                &level(ply.grid, spacing),
                &contacts,
                Continuation::IfNeeded,
            );
            assert_eq!(found.status, Status::Converged, "{spacing}");
            mounts.keep();
            (mounts.gripper_force(0)[0], mounts.reactions()[0].slip[0], mounts.pads().to_vec())
        };
        let (force, slip, _) = at(0.099);
        assert!(force < 1.0 && slip == 0.0);
        let (force, slip, pads) = at(0.12);
        assert!((force - 6.0).abs() < 1e-12, "{force}");
        // what is beyond the fabric's length, less what the springs yield
        let (run, yielded) = (pads[1][0] - pads[0][0], stiffness.map_or(0.0, |k| 6.0 / k));
        assert!((slip - (0.5 * (0.12 - run) - yielded)).abs() < 1e-6, "{slip}");
        assert!((run - 0.1).abs() < 3e-5, "{run}");
        let (force, kept, pads) = at(0.112);
        assert!(force < 1.0 && kept == slip, "{force} {kept} {slip}");
        let lead = pads[0][0] - slip;
        assert!((lead - stiffness.map_or(0.0, |k| force / k)).abs() < 1e-7 * 0.1, "{lead}");
    }
}

/// Lengths, weights, rigidities and stiffnesses in other units make the same state in other units.
#[test]
fn a_scaled_ply_on_scaled_mounts_is_in_the_scaled_state() {
    let (length, force) = (37.0, 0.02);
    let mut small = ply(3, 2);
    small.material.shear_curve = Some(ShearCurve::Polynomial { coefficients: vec![5.0] });
    let pad = PadSettings { slip_force: Some(0.35), ..pads(Some(2e3), Some(5e3)) };
    let first = settings(SlopeRule::MomentBalance, pad);
    let mut large = small.clone();
    large.cell = small.cell.map(|side| length * side);
    large.material.section = Section::Line {
        mass: 0.3143 * force / length,
        flexural_rigidity: 9e-6 * force * length * length,
    };
    large.material.shear_curve =
        Some(ShearCurve::Polynomial { coefficients: vec![5.0 * force / length] });
    let scaled = |stiffness: Option<f64>| stiffness.map(|k| k * force / length);
    let second = Settings {
        axial_stiffness: force * first.axial_stiffness,
        pad: PadSettings {
            lateral_stiffness: scaled(pad.lateral_stiffness),
            axial_stiffness: scaled(pad.axial_stiffness),
            slip_force: Some(0.35 * force),
            ..pad
        },
        ..first
    };
    let mut commanded = uneven(small.grid, 0.099);
    commanded.iter_mut().for_each(|place| place[0] += 0.1 * place[1]);
    let larger: Vec<_> = commanded.iter().map(|place| place.map(|c| length * c)).collect();
    let (first, second) =
        (balanced(&small, &first, &commanded), balanced(&large, &second, &larger));
    for n in 0..commanded.len() {
        for axis in 0..3 {
            let (a, b) =
                (first.mounts.balance.offset[n][axis], second.mounts.balance.offset[n][axis]);
            assert!((length * a - b).abs() < 1e-9 * length * 0.1, "{n}: {a} {b}");
            let (a, b) =
                (first.mounts.gripper_force(n)[axis], second.mounts.gripper_force(n)[axis]);
            assert!((force * a - b).abs() < 1e-7 * force, "{n}: {a} {b}");
        }
    }
}

/// A square array in a square way stays one: the pads of mirrored grippers are mirrored.
#[test]
fn a_symmetric_array_stays_symmetric() {
    for slopes in RULES {
        let ply = ply(4, 4);
        let pad = PadSettings { slip_force: Some(0.5), ..pads(Some(500.0), Some(2e3)) };
        let commanded = level(ply.grid, 0.0995);
        let solved = balanced(&ply, &settings(slopes, pad), &commanded);
        let offset = |i: usize, j: usize| solved.mounts.balance.offset[ply.grid.index([i, j])];
        for i in 0..4 {
            for j in 0..4 {
                let ([x, y, z], [mx, my, mz], [sx, sy, sz]) =
                    (offset(i, j), offset(3 - i, j), offset(j, i));
                let near = |a: f64, b: f64| (a - b).abs() < 1e-10;
                assert!(near(x, -mx) && near(y, my) && near(z, mz), "{slopes:?} {i} {j}");
                assert!(near(x, sy) && near(y, sx) && near(z, sz), "{slopes:?} {i} {j}");
                assert!(z < 0.0);
            }
        }
    }
}

/// Arrays far too wide for their fabric, of plies that stretch, hardly stretch or do not, are balanced by mounts of any
/// stiffness that grippers have.
#[test]
fn taut_and_slack_arrays_are_balanced_by_soft_and_stiff_mounts() {
    let ply = ply(3, 3);
    for slopes in RULES {
        for (axial_stiffness, most) in [(1e3, 1e6), (1e5, 1e6), (f64::INFINITY, 2e4)] {
            for stiffness in [100.0, 2e3, 2e4, 1e6].into_iter().filter(|k| *k <= most) {
                for spacing in [0.09, 0.0999, 0.1001, 0.103] {
                    let pad = pads(Some(stiffness), Some(stiffness));
                    let settings = Settings { axial_stiffness, ..settings(slopes, pad) };
                    let found = solved(&ply, &settings, &uneven(ply.grid, spacing)).found;
                    let case = (slopes, axial_stiffness, stiffness, spacing);
                    assert_eq!(found.status, Status::Converged, "{case:?}");
                }
            }
        }
    }
}

/// Beyond its first four grippers the matrix knows neighbors alone; the balance is that of the whole all the same.
#[test]
fn a_long_array_is_balanced_to_the_same_tolerance() {
    let ply = ply(9, 6);
    let pad = pads(Some(2e3), Some(5e3));
    for slopes in RULES {
        let solved = balanced(&ply, &settings(slopes, pad), &uneven(ply.grid, 0.0995));
        let most = 1e-9 * solved.mounts.largest_force();
        for (ply, mount) in solved.mounts.ply_forces().iter().zip(solved.mounts.reactions()) {
            for (ply, mount) in ply.iter().zip(mount.force) {
                assert!((ply + mount).abs() <= most);
            }
        }
    }
}

/// A sheared array at 45° to the yarns, its cups moved at random: the force on each pad in excess of that without a shear curve is
/// minus the slope of the shear energy, ∑ area ∫τ dγ with the angles of all cells, by central differences.
#[test]
fn bias_lines_pull_by_the_slope_of_the_shear_energy() {
    let curve = ShearCurve::Polynomial { coefficients: vec![5.0, 0.0, 40.0] };
    let mut plies = [1.0, 0.0].map(|_| crate::ply::held([3, 3], 45.0, |_| true));
    plies[0].material.shear_curve = Some(curve.clone());
    let lines = plies[0].lines();
    let mut places = uneven(Grid { nu: 3, nv: 3 }, 0.098);
    places.iter_mut().for_each(|place| place[0] *= 1.05);
    let contacts = vec![None; lines.catenaries()];
    let forces = plies.each_ref().map(|ply| {
        let mut solver = Solver::new(ply, &Settings::default());
        solver.solve(&places, &contacts);
        let held = super::force::Held { solver: &solver, pads: &places, contacts: &contacts };
        held.forces().expect("all lines hang or stretch").0
    });
    let energy = |places: &[[f64; 3]]| -> f64 {
        let path = |n: usize| {
            let [a, b] = lines.ends(n).map(|gripper| places[gripper]);
            crate::mold::distance(a, b)
        };
        let cell = |cell: &crate::ply::LineCell| {
            // sin γ from the squares of all four sides, the fibres d long and the flat cell d²/2 large
            let [rising, falling] =
                cell.bias.map(|bias| bias.list().iter().map(|n| path(*n).powi(2)).sum::<f64>());
            let d = 0.1 * std::f64::consts::SQRT_2;
            let angle = ((rising - falling) / (2.0 * d * d)).asin();
            0.5 * d * d * curve.energy(angle.abs())
        };
        lines.cells().iter().map(cell).sum()
    };
    let step = 1e-6;
    for gripper in 0..9 {
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut places = places.clone();
                places[gripper][axis] += by;
                energy(&places)
            };
            let slope = (moved(step) - moved(-step)) / (2.0 * step);
            let force = forces[0][gripper][axis] - forces[1][gripper][axis];
            // the forces of taut fibres, up to a hundred newtons, are subtracted
            assert!((force + slope).abs() < 1e-6, "{gripper} {axis}: {force} {slope}");
        }
    }
}
