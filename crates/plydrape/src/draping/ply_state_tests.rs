//! What a step of the catenaries says of the ply.

use super::mount_tests::{down, draped, lowered};
use super::{Follow, follow};
use crate::layup::{Layup, PadSettings};
use crate::ply::Grid;
use crate::state::{LineState, PlyState, Site};
use std::ops::ControlFlow;

/// A ply that comes down to a plane with 1 % of slack along u and v, which it keeps in part.
fn layup() -> Layup {
    lowered(Grid { nu: 4, nv: 3 }, PadSettings::default(), &down(0.0, 20), [0.098, 0.0995])
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

/// A search and a record judge one ply: what the search is told is what the record is told, but for the shapes of spans and, before the
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
    let layup = lowered(Grid { nu: 3, nv: 1 }, PadSettings::default(), &[0.05; 18], spacings);
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
