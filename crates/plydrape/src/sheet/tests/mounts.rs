//! Grippers on mounts that give.

use super::*;
use crate::geometry::vector::norm;

/// A strip of one cell between two grippers on mounts of a stiffness (N/m), pulled apart by `pull` (m) at each end where the
/// fabric slides from a load (N) on. Returns the forces of the ply on the grippers (N) and how far it has slid (m).
fn pulled(stiffness: f64, slip_force: Option<f64>, pull: f64) -> ([[f64; 3]; 2], [[f64; 3]; 2]) {
    let mut strip = sheet([even(0.1, 4), vec![0.0]], &[[0.0, 0.0], [0.1, 0.0]]);
    for gripper in &mut strip.grippers {
        gripper.mount = Some([stiffness, stiffness, 1e6]);
        gripper.slip_force = slip_force;
    }
    let mut cloth = flat(&strip, 0.0);
    bring(&mut cloth, &[[-pull, 0.0, 0.0], [0.1 + pull, 0.0, 0.0]], 5, 0.1);
    let forces = cloth.forces();
    let slips: Vec<[f64; 3]> = cloth.now.pads.iter().map(|pad| pad.slip).collect();
    ([forces[0], forces[1]], [slips[0], slips[1]])
}

/// Two mounts and a taut strip are springs in a row: the force is 2 p / (2/k + L/(EA′ b)), but for the sag of a strip of 3 N that
/// 20 N and more pull straight.
#[test]
fn two_mounts_and_a_strip_are_springs_in_a_row() {
    for stiffness in [2e3, 2e4, 2e5] {
        let pull = 20.0 / stiffness + 1e-4;
        let ([left, right], _) = pulled(stiffness, None, pull);
        let expected = 2.0 * pull / (2.0 / stiffness + 0.1 / (1e6 * 0.1));
        assert!((left[0] / expected - 1.0).abs() < 1e-3, "{stiffness}: {left:?} {expected}");
        assert!((left[0] + right[0]).abs() < 1e-4 * expected, "{left:?} {right:?}");
    }
}

/// The stiffer the mounts, the nearer is the force to that of rigid grippers: the difference falls as 1/k.
#[test]
fn rigid_grippers_are_the_limit_of_stiff_mounts() {
    let rigid = 2e-4 / (0.1 / (1e6 * 0.1));
    let off = |stiffness: f64| rigid / pulled(stiffness, None, 1e-4).0[0][0] - 1.0;
    let [soft, stiff] = [1e7, 1e8].map(off);
    assert!(soft > 0.0 && (soft / stiff - 10.0).abs() < 0.2, "{soft} {stiff}");
}

/// A pad that is pulled beyond its slip force lets the fabric slide at exactly that force, and by what the springs do not take:
/// p − F/k − F L/(2 EA′ b).
#[test]
fn fabric_slides_at_the_slip_force() {
    let (force, stiffness, pull) = (6.0, 2e3, 8e-3);
    let ([left, right], slips) = pulled(stiffness, Some(force), pull);
    for (load, slip) in [left, right].iter().zip(slips) {
        assert!((load[0].abs() / force - 1.0).abs() < 1e-4, "{load:?}");
        let expected = pull - force / stiffness - force * 0.1 / (2.0 * 1e6 * 0.1);
        assert!((norm(slip) / expected - 1.0).abs() < 5e-3, "{slip:?} {expected}");
    }
    assert!(slips[0][0] > 0.0 && slips[1][0] < 0.0, "fabric slides inwards: {slips:?}");
    let (_, still) = pulled(stiffness, Some(force), 2e-3);
    assert_eq!(still, [[0.0; 3]; 2]);
}

/// What has slid stays: back at the start, the fabric that slid is slack and pulls no more.
#[test]
fn fabric_that_has_slid_does_not_slide_back() {
    let mut strip = sheet([even(0.1, 4), vec![0.0]], &[[0.0, 0.0], [0.1, 0.0]]);
    for gripper in &mut strip.grippers {
        gripper.mount = Some([2e3, 2e3, 1e6]);
        gripper.slip_force = Some(6.0);
    }
    let mut cloth = flat(&strip, 0.0);
    bring(&mut cloth, &[[-8e-3, 0.0, 0.0], [0.108, 0.0, 0.0]], 5, 0.1);
    let slid = cloth.now.pads[0].slip;
    bring(&mut cloth, &[[-1e-3, 0.0, 0.0], [0.101, 0.0, 0.0]], 5, 0.1);
    assert_eq!(cloth.now.pads[0].slip, slid);
    let load = cloth.forces()[0];
    assert!(load[0].abs() < 3.0, "{load:?}");
}
