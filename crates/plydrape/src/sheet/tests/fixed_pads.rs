//! Pads without joints, which turn with the frame of their tool alone.

use super::release::{GRID, draped, handed_over, layup};
use super::*;
use crate::geometry::vector::{distance, norm, sub, turned};
use crate::layup::Layup;
use crate::sheet::ClothState;
use crate::tool::Tool;

/// A tool without axes whose pads have no joints.
fn frame(places: &[[f64; 2]]) -> Tool {
    let start: Vec<[f64; 3]> = places.iter().map(|[u, v]| [*u, *v, 0.0]).collect();
    let axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    Tool { fixed_pads: Some(axes), ..Tool::new(&start, vec![]) }
}

/// A stiff strip that sags by a two-thousandth of its free length L between two pads without joints is a beam clamped at both ends: the
/// moments are wL²/12 at the pads and wL²/24 in the middle. The pads hold nodes p apart, so that half of a segment of the pad bends with
/// the strip: a clamp of the stiffness D'/(p/2), which leaves 1/(1 + p/L) of the moment. As p falls to zero that is the beam.
#[test]
fn a_stiff_strip_between_pads_without_joints_is_a_clamped_beam() {
    let (free, radius, rigidity) = (0.08, 0.01, 0.1);
    for parts in [2, 8] {
        let p = radius / f64::from(parts);
        let mut lines: Vec<f64> = (-parts..=parts).map(|n| p * f64::from(n)).collect();
        lines.extend(even(free, 32).iter().skip(1).map(|u| radius + u));
        let far = free + 2.0 * radius;
        lines.extend((1..=2 * parts).map(|n| far - radius + p * f64::from(n)));
        let places = [[0.0, 0.0], [far, 0.0]];
        let mut strip = sheet([lines, vec![0.0]], &places);
        strip.rigidity = [rigidity; 2];
        strip.grippers.iter_mut().for_each(|gripper| gripper.radius = radius);
        strip.tool = Some(frame(&places));
        let mut cloth = flat(&strip, 0.0);
        rest(&mut cloth, &places.map(|[u, v]| [u, v, 0.0]));
        let moment = |at: f64| {
            let node = |u: &f64| (u - at).abs() < 1e-9;
            let b = strip.fabric.places.iter().position(|place| node(&place[0])).expect("a node");
            let [before, after] = [[b - 1, b], [b, b + 1]].map(|[i, j]| {
                let way = sub(cloth.now.x[j], cloth.now.x[i]);
                (way[2] / way[0], way[0])
            });
            rigidity * (after.0 - before.0) / (0.5 * (before.1 + after.1))
        };
        let load = strip.areal_mass * strip.gravity * free * free;
        let clamped = load / 12.0 / (1.0 + p / free);
        let [left, right] = [radius, radius + free].map(moment);
        for end in [left, right] {
            assert!((-end / clamped - 1.0).abs() < 5e-3, "{parts}: {end} {clamped}");
        }
        let middle = moment(radius + 0.5 * free);
        assert!((middle - 0.5 * (left + right) - load / 8.0).abs() < 5e-3 * load, "{middle}");
    }
}

/// A ply of 4 × 2 pads that a frame without axes turns by an angle (rad) about y on the way, 0.3 m above the floor; all of it yawed by
/// another about z and shifted.
fn turning(angle: f64, yaw: f64, joints: bool) -> Layup {
    let place = |n: usize, share: f64| {
        let [u, v] = GRID.id(n).map(|k| 0.098 * k as f64);
        let at = turned([0.0, share * angle, 0.0], [u - 0.15, v - 0.05, 0.0]);
        let [x, y, z] = turned([0.0, 0.0, yaw], at);
        [x + yaw, y - yaw, z + 0.3]
    };
    let steps = (0..=4).map(|k| (0..8).map(|n| place(n, f64::from(k) / 4.0)).collect());
    let mut layup = layup(steps.collect(), None);
    layup.settings.pad.radius = 0.01;
    layup.settings.sheet.overhang = 0.01;
    let start = &layup.motion.positions[0];
    let fixed_pads = (!joints).then(|| layup.ply.flat_axes(start));
    layup.tool = Some(Tool { fixed_pads, ..Tool::new(start, vec![]) });
    layup
}

/// A frame that turns takes pads without joints with it, and the fabric that they hold; on mounts that give too, which then carry the
/// weight of the ply. Ball joints let the pads of the same frame follow the ply.
#[test]
fn a_tilted_frame_tilts_pads_without_joints() {
    let angle = 0.3_f64;
    for stiffness in [None, Some(2e3)] {
        let mut layup = turning(angle, 0.0, false);
        layup.settings.pad.lateral_stiffness = stiffness;
        let (drape, states) = draped(&layup);
        let handed = handed_over(&layup, &drape, &states);
        let grippers = handed.iter().flat_map(|state| &state.grippers);
        let tilt = grippers.map(|gripper| gripper.tilt).fold(0.0, f64::max);
        // an angle by its cosine is zero to the root of the rounding, 1.5e-8
        assert!(tilt < 5e-8, "{tilt}");
        for state in &states {
            let turn = [0.0, angle * (state.step - 1) as f64 / 4.0, 0.0];
            let normal = turned(turn, [0.0, 0.0, 1.0]);
            for (pad, held) in state.pads.iter().zip(drape.sheet.held()) {
                assert!(distance(pad.normal(), normal) < 1e-9, "{:?} {normal:?}", pad.normal());
                for (node, [a, b]) in held {
                    let off = sub(state.positions[node], pad.position);
                    assert!(distance(off, turned(turn, [a, b, 0.0])) < 1e-9, "{off:?}");
                }
            }
        }
        let carried: f64 = drape.last.forces.iter().map(|force| force[2]).sum();
        let weight = 3.143 * G * 0.32 * 0.12;
        assert!((carried / -weight - 1.0).abs() < 2e-3, "{carried} {weight}");
    }
    let (drape, _) = draped(&turning(angle, 0.0, true));
    let tilted = |pad: &Pad| norm(sub(pad.normal(), turned([0.0, angle, 0.0], [0.0, 0.0, 1.0])));
    assert!(drape.last.pads.iter().any(|pad| tilted(pad) > 0.05), "{:?}", drape.last.pads);
}

/// A motion elsewhere and in another direction leaves the same ply, within the tolerance of the time steps.
#[test]
fn a_ply_in_pads_without_joints_does_not_know_where_it_is() {
    let [(here, before), (there, after)] = [0.0, 0.7].map(|yaw| draped(&turning(0.3, yaw, false)));
    let heights = here.last.heights.iter().zip(&there.last.heights);
    let off = heights.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(off < 2e-5, "{off}");
    let most = |states: &[ClothState]| {
        states.iter().flat_map(|state| &state.forces).map(|f| norm(*f)).fold(0.0, f64::max)
    };
    let (a, b) = (most(&before), most(&after));
    assert!((a / b - 1.0).abs() < 1e-2, "{a} {b}");
}

/// A pad without a joint that holds one point has nothing to hold it by.
#[test]
fn points_without_joints_are_refused() {
    let mut layup = turning(0.0, 0.0, false);
    layup.settings.pad.radius = 0.0;
    let refused = Sheet::new(&layup).unwrap_err().to_string();
    assert!(refused.contains("the pad of gripper g0_0 holds one point"), "{refused}");
}
