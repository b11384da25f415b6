//! What is left out of gradients.

use super::{Quantity, Sensitivity};
use crate::draping::Draping;
use crate::planner::stepwise::tests::scene;
use crate::scene::SlopeRule;

/// On an array that takes more than one gripper in each group, each gradient differs from the whole one by a few shares that
/// count as negligible, and holds a fraction of its numbers.
#[test]
fn gradients_of_distant_grippers_together_are_those_of_each_alone() {
    for slopes in [SlopeRule::MinForce, SlopeRule::MomentBalance] {
        let mut scene = scene(16);
        scene.settings.slopes = slopes;
        let positions = &scene.motion.positions[0];
        let mut draping = Draping::new(&scene);
        let shape = draping.move_to(positions);
        let contacts = draping.contacts.clone();
        let solver = &mut draping.solver;
        let whole = Sensitivity::whole(&scene, solver, &shape, positions, &contacts);
        let sparse = Sensitivity::new(&scene, solver, &shape, positions, &contacts);
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
