//! What a step of the catenaries says of the ply.

use super::record::CatenaryStep;
use super::{Follow, follow};
use crate::layup::{Layup, Model, Settings};
use crate::material::{Material, Section};
use crate::mold::{Mold, Plane};
use crate::motion::Motion;
use crate::ply::{Grid, Ply};
use crate::state::{LineState, PlyState, Site};
use std::ops::ControlFlow;

fn plane() -> Mold {
    Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] })
}

/// A ply that is lowered onto the plane z = 0 in steps, its grippers at a spacing (m) that grows to another.
fn lowered(grid: Grid, heights: &[f64], [first, last]: [f64; 2]) -> Layup {
    let section = Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 };
    let material = Material { section, ..Material::woven("krogh2018", 0.3143, 9e-6, 1e6, 5.0) };
    let ply = Ply::of_array(grid, [0.1; 2], material);
    let settings = Settings { model: Model::Catenaries, ..Settings::default() };
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
fn draped(layup: &Layup) -> Vec<(PlyState, CatenaryStep)> {
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

/// From 40 mm down to a last height (m).
fn down(last: f64, steps: usize) -> Vec<f64> {
    (0..steps).map(|n| 0.04 + (last - 0.04) * n as f64 / (steps - 1) as f64).collect()
}

/// A ply that comes down to a plane with 2 % of slack along u and v, of which it keeps a quarter.
fn layup() -> Layup {
    lowered(Grid { nu: 4, nv: 3 }, &down(0.0, 20), [0.098, 0.0995])
}

/// Every step as a search sees it.
fn searched(layup: &Layup, most_equilibria: usize) -> Vec<(PlyState, bool)> {
    let mut states = Vec::new();
    let options = Follow { most_equilibria, full: false };
    follow(layup, options, |state, record, last| {
        assert!(record.is_none());
        states.push((state.clone(), last));
        ControlFlow::Continue(())
    });
    states
}

/// No fabric is made or lost where a part of it comes to lie: the segments of a line are as long as the line, and the fibers as all edges
/// of the flat ply. In the end all of them lie.
#[test]
fn the_fiber_lines_are_the_fabric_of_all_edges() {
    let layup = layup();
    let edges = layup.ply.lines().edges();
    let fabric: f64 = (0..edges).map(|n| layup.ply.flat_length(n)).sum();
    let steps = draped(&layup);
    for (state, _) in &steps {
        let fibers = || state.lines.iter().filter(|line| line.is_fiber);
        let length: f64 = fibers().map(|line| line.length).sum();
        assert!((length - fabric).abs() < 1e-12, "step {}: {length} {fabric}", state.step);
        for n in 0..edges {
            let own = fibers().filter(|line| line.catenary == Some(n));
            let left = own.fold(layup.ply.flat_length(n), |left, line| left - line.length);
            assert!(left.abs() < 1e-14, "step {}: {left} of line {n}", state.step);
        }
    }
    let lying = |state: &PlyState| -> f64 {
        let lying = state.lines.iter().filter(|line| line.is_fiber && line.lies);
        lying.map(|line| line.length).sum()
    };
    assert_eq!(lying(&steps[0].0), 0.0);
    assert!((lying(&steps[19].0) - fabric).abs() < 1e-12);
}

/// The loads of rigid grippers add up to the weight of the ply as long as it hangs, and their pulls to nothing.
#[test]
fn the_forces_on_rigid_grippers_balance_the_weight_of_the_hanging_ply() {
    let (state, _) = &draped(&layup())[0];
    let sum = |axis: usize| state.grippers.iter().map(|g| g.force[axis]).sum::<f64>();
    // six cells of 0.1 m by 0.1 m of 3.143 kg/m²; the lines count by their chords, 2 % less
    let weight = 3.143 * 0.06 * 9.81;
    assert!((sum(2) + weight).abs() < 0.03 * weight, "{} {weight}", sum(2));
    assert!(sum(0).abs() < 1e-9 && sum(1).abs() < 1e-9);
}

/// A search and a record judge one ply: the search has the same values as the record, but for the shapes of spans and, before the
/// last step, how the ply has landed.
#[test]
fn a_search_sees_the_ply_that_is_recorded() {
    let layup = layup();
    let (recorded, searched) = (draped(&layup), searched(&layup, usize::MAX));
    assert_eq!(recorded.len(), searched.len());
    for ((full, _), (state, last)) in recorded.iter().zip(&searched) {
        assert_eq!(*last, state.step == recorded.len());
        assert_eq!((&full.grippers, &full.unsolved), (&state.grippers, &state.unsolved));
        let bare = |line: &LineState| LineState { sag: None, slope: None, ..*line };
        assert_eq!(full.lines.iter().map(bare).collect::<Vec<_>>(), state.lines);
        assert!(full.cells.iter().zip(&state.cells).all(|(a, b)| a.shear == b.shear));
        assert!(!*last || full.cells == state.cells);
    }
}

/// A search ends with the step that takes more equilibria than it may.
#[test]
fn a_search_ends_when_its_equilibria_are_spent() {
    let layup = layup();
    assert_eq!(searched(&layup, 1).len(), 2);
    let options = Follow { most_equilibria: 1, full: false };
    let followed = follow(&layup, options, |_, _, _| ControlFlow::Continue(()));
    assert_eq!((followed.steps, followed.equilibria, followed.torn), (2, 2, None));
}

/// Grippers 12 % too far apart: the drape ends in the step in which they come there, which a record takes for the end, and says why.
#[test]
fn a_drape_ends_where_a_fiber_is_torn() {
    let spacings = [0.098, 0.115];
    let layup = lowered(Grid { nu: 3, nv: 1 }, &[0.05; 18], spacings);
    let (mut last, mut steps) = (false, 0);
    let options = Follow { most_equilibria: usize::MAX, full: true };
    let followed = follow(&layup, options, |state, _, is_last| {
        assert!(!last);
        (last, steps) = (is_last, state.step);
        ControlFlow::Continue(())
    });
    // from 98 mm by 1 mm a step: 111 mm are beyond 10 %, 110 mm at most there
    assert!(last && steps == followed.steps && (13..=14).contains(&steps), "{steps}");
    let torn = followed.torn.unwrap();
    let edge = Site::Catenary(0).label(&layup);
    assert!(torn.starts_with(&edge) && torn.contains("bring grippers closer"), "{torn}");
}
