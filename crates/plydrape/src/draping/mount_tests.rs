//! Drapes with grippers on mounts that yield.

use super::record::CatenaryStep;
use super::standing::Ground;
use super::{Draping, Follow, follow};
use crate::equilibrium::{Continuation, MountedSolver, Solver, Status};
use crate::layup::{Layup, Model, PadSettings, Settings};
use crate::material::{Material, Section};
use crate::mold::{Mold, Plane};
use crate::motion::Motion;
use crate::ply::{Grid, Ply};
use crate::state::PlyState;
use std::ops::ControlFlow;

fn plane() -> Mold {
    Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] })
}

/// A ply that is lowered onto the plane z = 0 in steps, its grippers at a spacing (m) that grows to another.
pub(super) fn lowered(
    grid: Grid,
    pad: PadSettings,
    heights: &[f64],
    [first, last]: [f64; 2],
) -> Layup {
    let material = Material {
        name: "krogh2018".into(),
        source: "Krogh et al. 2018, Table 1".into(),
        section: Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 },
        shear_curve: None,
        tension: None,
        locking_angle: None,
        moment: Default::default(),
        scatter: Default::default(),
    };
    let ply = Ply::of_array(grid, [0.1; 2], material);
    let settings = Settings { model: Model::Catenaries, pad, ..Settings::default() };
    let share = |step: usize| step as f64 / (heights.len() - 1).max(1) as f64;
    let place = |n: usize, step: usize| {
        let spacing = first + share(step) * (last - first);
        let middle = [grid.nu, grid.nv].map(|count| 0.5 * (count - 1) as f64);
        let [i, j] = grid.id(n);
        [spacing * (i as f64 - middle[0]), spacing * (j as f64 - middle[1]), heights[step]]
    };
    let positions = |step| (0..grid.grippers()).map(|n| place(n, step)).collect();
    let motion = Motion {
        times: (0..heights.len()).map(|n| n as f64).collect(),
        positions: (0..heights.len()).map(positions).collect(),
    };
    Layup { mold: Some(plane()), ..Layup::new(ply, settings, motion) }
}

/// Every step of a drape that is solved to its end.
pub(super) fn draped(layup: &Layup) -> Vec<(PlyState, CatenaryStep)> {
    let mut steps = Vec::new();
    let options = Follow { most_equilibria: usize::MAX, full: true };
    follow(layup, options, |state, record, _| {
        let record = record.unwrap();
        assert!(record.solver.found(), "step {}: {:?}", state.step, record.solver);
        steps.push((state.clone(), record));
        ControlFlow::Continue(())
    });
    assert_eq!(steps.len(), layup.motion.positions.len());
    steps
}

fn mounts(lateral: Option<f64>, axial: Option<f64>) -> PadSettings {
    PadSettings { lateral_stiffness: lateral, axial_stiffness: axial, ..PadSettings::default() }
}

/// From 40 mm down to a last height (m).
pub(super) fn down(last: f64, steps: usize) -> Vec<f64> {
    (0..steps).map(|n| 0.04 + (last - 0.04) * n as f64 / (steps - 1) as f64).collect()
}

/// Grippers that go on for 3 mm below the mold leave their pads on it: the mounts yield by that and press with k times it.
#[test]
fn the_mold_carries_what_presses_a_pad_down() {
    for grid in [Grid { nu: 3, nv: 1 }, Grid { nu: 3, nv: 3 }] {
        let pad = mounts(None, Some(5e3));
        let steps = draped(&lowered(grid, pad, &down(-3e-3, 25), [0.098, 0.0999]));
        let (last, _) = &steps[24];
        for gripper in &last.grippers {
            assert!(gripper.position[2].abs() < 1e-9, "{gripper:?}");
            assert!((gripper.force[2] - 15.0).abs() < 1e-6, "{gripper:?}");
            assert!((gripper.commanded[2] + 3e-3).abs() < 1e-15);
        }
        assert!(last.points.iter().all(|point| point.height >= Some(0.0)));
    }
}

/// In the air the mounts of each step hold the ply's weight; the pads hang as much lower as it takes.
#[test]
fn pads_in_the_air_hang_by_their_load_over_the_stiffness() {
    let pad = mounts(None, Some(500.0));
    let layup = lowered(Grid { nu: 4, nv: 3 }, pad, &[0.05, 0.045], [0.098, 0.098]);
    for (state, _) in draped(&layup) {
        for gripper in &state.grippers {
            let hang = gripper.commanded[2] - gripper.position[2];
            assert!((500.0 * hang - gripper.load()).abs() < 1e-9);
        }
        let sum: f64 = state.grippers.iter().map(|gripper| gripper.load()).sum();
        // six cells of 0.1 m by 0.1 m of 3.143 kg/m²; the lines count by their chords, 2 % less
        let weight = 3.143 * 0.06 * 9.81;
        assert!((sum - weight).abs() < 0.03 * weight, "{sum} {weight}");
    }
}

/// A pad that stands stays where it touched while the robot moves sideways, and the mold lets it go where it would have
/// to pull.
#[test]
fn a_pad_sticks_where_it_touched_and_is_lifted_off_where_the_mold_would_pull() {
    let grid = Grid { nu: 2, nv: 1 };
    let layup = lowered(grid, mounts(Some(2e3), Some(5e3)), &[0.05], [0.098, 0.098]);
    let mut solver = Solver::new(&layup.ply, &layup.settings);
    let mut mounts = MountedSolver::new(&layup.ply, &layup.settings).unwrap();
    let contacts = vec![None];
    let mold = plane();
    let lines = layup.ply.lines();
    let ground = Ground { mold: &mold, tolerance: 2e-4, lines, contacts: &contacts };
    // the ply itself is let through the mold here: only the pads are on it
    let mut at = |mounts: &mut MountedSolver, x: f64, z: f64| {
        let places = [[-0.049, 0.0, 0.01], [0.049 + x, 0.0, z]];
        let found = mounts.solve(&mut solver, &places, &contacts, Continuation::IfNeeded);
        assert_eq!(found.status, Status::Converged);
    };
    at(&mut mounts, 0.0, -1e-3);
    assert!(ground.land(&mut mounts));
    at(&mut mounts, 0.0, -1e-3);
    let place = mounts.pads()[1];
    assert!(place[2].abs() < 1e-12 && mounts.standing()[0].is_none());
    assert!(!ground.land(&mut mounts) && !ground.lift(&mut mounts));
    at(&mut mounts, 1e-3, -2e-3);
    assert_eq!(mounts.pads()[1], place);
    assert!(!ground.lift(&mut mounts));
    at(&mut mounts, 1e-3, 2e-3);
    assert!(ground.lift(&mut mounts) && mounts.standing()[1].is_none());
    at(&mut mounts, 1e-3, 2e-3);
    assert!(mounts.pads()[1][2] > 1e-3 && !ground.land(&mut mounts));
}

/// The whole drape with ever stiffer mounts tends to that of rigid grippers.
#[test]
fn a_drape_on_stiff_mounts_is_that_of_rigid_grippers() {
    let grid = Grid { nu: 3, nv: 3 };
    let heights = down(0.012, 8);
    let rigid = draped(&lowered(grid, PadSettings::default(), &heights, [0.098, 0.0985]));
    let mut grippers = rigid.iter().flat_map(|(state, _)| &state.grippers);
    assert!(grippers.all(|gripper| gripper.commanded == gripper.position));
    let off = |stiffness: f64| {
        let pad = mounts(Some(stiffness), Some(stiffness));
        let soft = draped(&lowered(grid, pad, &heights, [0.098, 0.0985]));
        let pairs = soft.iter().zip(&rigid);
        let lines = pairs.flat_map(|((a, _), (b, _))| a.lines.iter().zip(&b.lines));
        lines.map(|(a, b)| (a.force.unwrap() - b.force.unwrap()).abs()).fold(0.0, f64::max)
    };
    let (coarse, fine) = (off(1e6), off(1e7));
    assert!((coarse / fine - 10.0).abs() < 0.5, "{coarse} {fine}");
}

/// Grippers that go 3 % too far apart: the fabric slides under the outer pads at exactly the slip force, and at the end it has not slid
/// back.
#[test]
fn fabric_slides_under_the_outer_pads_at_the_slip_force() {
    let pad = PadSettings { slip_force: Some(2.0), ..mounts(Some(2e3), None) };
    let spacings = [0.098, 0.103];
    let steps = draped(&lowered(Grid { nu: 3, nv: 1 }, pad, &[0.05; 11], spacings));
    for outer in [0, 2] {
        let gripper = |step: usize| &steps[step].0.grippers[outer];
        assert!(gripper(0).pull() < 1.0 && gripper(0).slide == 0.0);
        assert!((gripper(10).pull() - 2.0).abs() < 1e-9);
        let slid: Vec<f64> = (0..11).map(|step| gripper(step).slide).collect();
        assert!(slid.is_sorted());
        // 3 mm too far on each side: the spring yields by 1 mm, and the line sags by w²L³/24H² = 0.1 mm
        assert!((slid[10] - 2.1e-3).abs() < 2e-5, "{slid:?}");
        assert_eq!(steps[10].0.grippers[1].slide, 0.0);
    }
}

/// A drape with mounts is the same however its first moves were made: a draping that is cloned goes on alike.
#[test]
fn a_cloned_drape_goes_on_alike() {
    let pad = PadSettings { slip_force: Some(2.0), ..mounts(Some(2e3), Some(5e3)) };
    let layup = lowered(Grid { nu: 3, nv: 2 }, pad, &down(0.0, 12), [0.098, 0.1]);
    let mut first = Draping::new(&layup);
    for positions in &layup.motion.positions[..6] {
        first.move_to(positions);
    }
    let mut second = first.clone();
    for positions in &layup.motion.positions[6..] {
        first.move_to(positions);
        second.move_to(positions);
        assert_eq!(first.pads(), second.pads());
    }
}
