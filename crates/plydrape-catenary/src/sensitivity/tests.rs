//! What is left out of gradients.

use super::tuning::TUNING;
use super::{Quantity, Sensitivity};
use crate::draping::Draping;
use crate::draping::attitude::attitude;
use crate::layup::{Layup, SlopeRule};
use crate::ply::{Cut, Grid, Held, Outline, Ply};
use crate::stepwise::tests::layup;

/// On an array that takes more than one gripper in each group, each gradient differs from the whole one by a few shares that
/// count as negligible, and holds a fraction of its numbers.
#[test]
fn gradients_of_distant_grippers_together_are_those_of_each_alone() {
    for slopes in [SlopeRule::MinForce, SlopeRule::MomentBalance] {
        let mut layup = layup(16);
        layup.settings.slopes = slopes;
        let positions = &layup.motion.positions[0];
        let mut draping = Draping::new(&layup);
        let shape = draping.move_to(positions);
        let contacts = draping.contacts.clone();
        let solver = &mut draping.solver;
        let whole = Sensitivity::new(&layup, solver, &shape, positions, &contacts, 0.0);
        let sparse =
            Sensitivity::new(&layup, solver, &shape, positions, &contacts, TUNING.negligible);
        let quantities = |sensitivity: &Sensitivity| -> Vec<Quantity> {
            let spans = shape.spans.iter().flat_map(|span| {
                let place = sensitivity.place(span, 0.3).along([0.0, 0.0, 1.0]);
                let slope = sensitivity.slope(span, 0.0);
                [sensitivity.force(span), Some(place), Some(slope)].into_iter().flatten()
            });
            let tilts = (0..positions.len()).map(|n| sensitivity.tilt(n));
            spans.chain(tilts).collect()
        };
        let (mut all, mut kept) = (0, 0);
        for (whole, sparse) in quantities(&whole).into_iter().zip(quantities(&sparse)) {
            all += whole.gradient.count();
            kept += sparse.gradient.count();
            let mut off = sparse.gradient;
            off.add(-1.0, &whole.gradient);
            let (most, largest) = (off.largest(), whole.gradient.largest());
            assert!(most <= 1e-3 * largest, "{slopes:?}: {most} beside {largest}");
        }
        assert!(3 * kept < all, "{slopes:?}: {kept} of {all}");
    }
}

/// In an array at 45° to the yarns one family of yarns alone runs through the cups at its corners: their tilt is that of the drape
/// there too, and its derivatives are central differences of it.
#[test]
fn tilts_of_cups_between_the_yarns_are_differentiated_as_they_are_draped() {
    let (sin, cos) = 45_f64.to_radians().sin_cos();
    let turned = |[x, y]: [f64; 2]| [0.1 * (cos * x - sin * y), 0.1 * (sin * x + cos * y)];
    let boundary = [[-0.4, -0.4], [2.4, -0.4], [2.4, 2.4], [-0.4, 2.4]].map(turned).to_vec();
    let outline = Outline::new(boundary, Vec::new()).unwrap();
    let ids = (0..9).map(|n| [n % 3, n / 3]);
    let held = ids.map(|id| Held { id, place: turned(id.map(|k| k as f64)) }).collect();
    let cut = Cut { outline, held, angle: 0.0, turn: 45_f64.to_radians(), origin: [0.0; 2] };
    let layup = layup(2);
    let ply =
        Ply { cut: Some(cut), ..Ply::of_array(Grid::NONE, [0.1; 2], layup.ply.material.clone()) };
    let place = |n: usize| {
        let [u, v] = ply.place(n);
        [0.985 * u, 0.98 * v, 0.3 + 2e-3 * (1.7 * n as f64).sin()]
    };
    let positions: Vec<[f64; 3]> = (0..ply.grippers()).map(place).collect();
    let layup = Layup { ply, mold: None, target: None, ..layup };
    let neighbors = layup.ply.neighbors();
    let tilts = |positions: &[[f64; 3]]| -> Vec<f64> {
        let mut draping = Draping::new(&layup);
        draping.move_to(positions);
        let tilt = |n| attitude(&draping.solver, &layup.ply, &neighbors, positions, n, None).tilt;
        (0..positions.len()).map(tilt).collect()
    };
    let mut draping = Draping::new(&layup);
    let shape = draping.move_to(&positions);
    let contacts = draping.contacts.clone();
    let whole = Sensitivity::new(&layup, &mut draping.solver, &shape, &positions, &contacts, 0.0);
    let here = tilts(&positions);
    let found: Vec<Quantity> = (0..positions.len()).map(|n| whole.tilt(n)).collect();
    for (found, draped) in found.iter().zip(&here) {
        assert!((found.value - draped).abs() < 1e-12 && *draped > 1e-3, "{draped}");
    }
    let h = 1e-6;
    for column in 0..3 * positions.len() {
        let moved = |by: f64| {
            let mut moved = positions.clone();
            moved[column / 3][column % 3] += by;
            tilts(&moved)
        };
        let (ahead, behind) = (moved(h), moved(-h));
        for (n, found) in found.iter().enumerate() {
            let central = (ahead[n] - behind[n]) / (2.0 * h);
            let off = (found.gradient.value_at(column) - central).abs();
            assert!(off < 1e-4 * central.abs().max(1.0), "cup {n}, {column}: {central}, off {off}");
        }
    }
}
