//! A ply that is lifted from a table.

use super::release::{GRID, layup};
use super::*;
use crate::layup::{Layup, PickUp};
use crate::sheet::{ClothState, SheetDrape, Status, drape};
use std::ops::ControlFlow;

/// Height of the table (m), and of the grippers from which the ply hangs.
const HEIGHTS: [f64; 2] = [0.3, 0.35];

/// Grippers 98 mm apart that hang the ply of [`GRID`].
fn start() -> Vec<[f64; 3]> {
    let place = |n: usize| {
        let [u, v] = GRID.id(n).map(|k| 0.098 * k as f64);
        [u, v, HEIGHTS[1]]
    };
    (0..8).map(place).collect()
}

/// The ply, lifted from the table to its start and held there.
fn lifted() -> Layup {
    let mut layup = layup(vec![start()], None);
    let mut pick_up = PickUp {
        height: HEIGHTS[0],
        clearance: 0.05,
        grip: 0.5,
        retreat: 0.02,
        vacuum_timeout: None,
        table: None,
        lift_steps: 0,
    };
    let mut steps = pick_up.lift(&layup.ply, &start());
    pick_up.lift_steps = steps.len();
    steps.push(start());
    layup.motion.times = (0..steps.len()).map(|step| step as f64).collect();
    layup.motion.positions = steps;
    layup.pick_up = Some(pick_up);
    layup
}

fn draped(layup: &Layup, mut see: impl FnMut(&ClothState)) -> SheetDrape {
    let found = drape(layup, SheetTuning::default(), &|| false, |_, state, _| {
        see(state);
        ControlFlow::Continue(())
    });
    let found = found.unwrap();
    assert_eq!(found.status, Status::Converged);
    found
}

/// On the table nothing hangs from the grippers, and above it they carry all of the ply's weight; the ply is never in the table.
#[test]
fn the_table_carries_the_ply_until_it_is_lifted() {
    let layup = lifted();
    let mut carried = Vec::new();
    let mut lowest = f64::INFINITY;
    let found = draped(&layup, |state| {
        carried.push(-state.forces.iter().map(|force| force[2]).sum::<f64>());
        lowest = state.positions.iter().fold(lowest, |low, x| low.min(x[2]));
    });
    let sheet = &found.sheet;
    let of_areas = |areas: &mut dyn Iterator<Item = f64>| {
        sheet.areal_mass * sheet.gravity * areas.sum::<f64>()
    };
    let weight = of_areas(&mut sheet.fabric.areas.iter().copied());
    // pads hold a node each, whose weight they carry by themselves
    let held = sheet.held();
    let of_pads = of_areas(&mut held.iter().flatten().map(|(node, _)| sheet.fabric.areas[*node]));
    assert!((carried[0] - of_pads).abs() < 1e-3 * weight, "{carried:?} {of_pads} {weight}");
    let last = carried[carried.len() - 1];
    assert!((last / weight - 1.0).abs() < 1e-3, "{last} {weight}");
    // some ten times the depth that the weight of a free ply sinks in, which is 1e-7 of the pitch
    assert!(lowest > HEIGHTS[0] - 1e-6 * sheet.pitch, "{lowest}");
}

/// The ply hangs from its grippers after the lift as it hangs from grippers that always held it in the air: its shape does not depend on
/// where it came from.
#[test]
fn a_lifted_ply_hangs_as_one_that_never_lay() {
    let lifted = lifted();
    let from_table = draped(&lifted, |_| {}).last.positions;
    let in_the_air = draped(&lifted.held_at_start(), |_| {}).last.positions;
    let apart = |(a, b): (&[f64; 3], &[f64; 3])| crate::geometry::vector::distance(*a, *b);
    let apart = from_table.iter().zip(&in_the_air).map(apart).fold(0.0, f64::max);
    let low = in_the_air.iter().map(|x| x[2]).fold(f64::INFINITY, f64::min);
    assert!(HEIGHTS[1] - low > 5e-3, "it hangs: {low}");
    assert!(apart < 2e-4, "{apart}");
}

/// Pads stand as far apart on the table as the fabric between them is long, under the middle of the start and with its heading.
#[test]
fn pads_stand_on_the_flat_ply_at_fabric_spacing() {
    let layup = lifted();
    let (sin, cos) = 0.4_f64.sin_cos();
    let turned: Vec<[f64; 3]> =
        start().iter().map(|[x, y, z]| [1.0 + x * cos - y * sin, x * sin + y * cos, *z]).collect();
    let flat = layup.pick_up.unwrap().flat(&layup.ply, &turned);
    let mean = |points: &[[f64; 3]], c: usize| points.iter().map(|p| p[c]).sum::<f64>() / 8.0;
    for c in [0, 1] {
        assert!((mean(&flat, c) - mean(&turned, c)).abs() < 1e-12);
    }
    assert!(flat.iter().all(|p| p[2] == HEIGHTS[0]));
    for (a, b) in (0..8).flat_map(|a| (0..a).map(move |b| (a, b))) {
        let [p, q] = [a, b].map(|n| layup.ply.place(n));
        let fabric = (p[0] - q[0]).hypot(p[1] - q[1]);
        let [dx, dy] = [0, 1].map(|c| flat[a][c] - flat[b][c]);
        assert!((dx.hypot(dy) - fabric).abs() < 1e-12);
        let [u, v] = [p[0] - q[0], p[1] - q[1]];
        assert!((dx - (u * cos - v * sin)).abs() < 1e-9 && (dy - (u * sin + v * cos)).abs() < 1e-9);
    }
}
