//! Sheets on molds: ridges, friction, rolling, energy.

use super::*;
use crate::mold::{Cylinder, Face, Pose};
use crate::sheet::energy::Phase;

/// A strip that has an excess length s and lies on a floor without friction rises by 1.32 l^(3/7) s^(4/7),
/// l = (D′/areal weight)^(1/3), whatever its length: the heavy elastica, of which only the height of the ridge matters.
#[test]
fn excess_length_rises_as_a_heavy_ridge() {
    for (length, excess) in [(0.3, 0.5e-3), (0.3, 2e-3), (0.5, 2e-3)] {
        let spacings = (length / 0.0025_f64).round() as usize;
        let mut sheet = sheet([even(length, spacings), vec![0.0]], &[[0.0, 0.0], [length, 0.0]]);
        sheet.mold = Some(plane(0.0));
        sheet.friction = Friction::Coulomb(0.0);
        sheet.mesh = 0.0025;
        let mut cloth = flat(&sheet, 0.0);
        // from a hump A exp(−(x/w)²) that is longer than its base by 0.627 A²/w
        let width = 0.02;
        let amplitude = f64::sqrt(excess * width / 0.627);
        for x in &mut cloth.now.x {
            x[0] = 0.5 * excess + x[0] * (1.0 - excess / length);
            x[2] = amplitude * (-((x[0] - 0.5 * length) / width).powi(2)).exp();
        }
        let ends = [[0.5 * excess, 0.0, 0.0], [length - 0.5 * excess, 0.0, 0.0]];
        for (pad, end) in cloth.now.pads.iter_mut().zip(ends) {
            *pad = Pad::new(end);
        }
        rest(&mut cloth, &ends);
        let rise = cloth.now.x.iter().map(|x| x[2]).fold(0.0, f64::max);
        let l = (9e-5_f64 / (3.143 * G)).cbrt();
        let expected = 1.32 * l.powf(3.0 / 7.0) * excess.powf(4.0 / 7.0);
        assert!((rise / expected - 1.0).abs() < 0.05, "{length} {excess}: {rise} {expected}");
    }
}

/// A strip on an incline stays where μ > tan α and slides where μ < tan α; its acceleration is g (sin α − μ cos α).
#[test]
fn a_strip_on_an_incline_slips_at_tan_alpha() {
    let alpha = 0.3_f64;
    for share in [0.9, 0.99, 1.02, 1.1] {
        let mu = share * alpha.tan();
        let mut sheet = sheet([even(0.1, 10), even(0.02, 2)], &[]);
        sheet.mold = Some(plane(alpha));
        sheet.friction = Friction::Coulomb(mu);
        let mut cloth = flat(&sheet, 0.0);
        // on the plane, which falls along +x
        for x in &mut cloth.now.x {
            let u = x[0];
            (x[0], x[2]) = (u * alpha.cos(), u * alpha.sin());
        }
        let dt = 0.002;
        let steps = 300;
        for _ in 0..steps {
            cloth.advance(&[], dt, 1e-9).expect("a step is solved");
        }
        let slid = (cloth.now.x[0][0] / alpha.cos()).abs();
        let time = dt * steps as f64;
        // a node rubs from the time step on after the one in which it touches
        let start = G * alpha.sin() * dt;
        let rate = G * (alpha.sin() - mu * alpha.cos());
        let expected = match rate > 0.0 {
            true => start * time + 0.5 * rate * time * time,
            false => -start * start / (2.0 * rate),
        };
        // steps are of first order in time
        assert!((slid / expected - 1.0).abs() < 0.15, "{share}: {slid} {expected}");
    }
}

/// A ply that is rolled isometrically on a plane or a cylinder, its free part straight ahead of the front, lies down
/// without height, stretch or shift.
#[test]
fn an_isometric_roll_leaves_nothing() {
    let radius = 0.5;
    let pose = Pose::new([0.0; 3], [0.0; 3]);
    let cylinder = Mold::Cylinder(Cylinder { pose, radius, face: Face::Outside });
    let held = pins();
    for (mold, radius) in [(plane(0.0), f64::INFINITY), (cylinder, radius)] {
        let mut sheet = sheet([even(0.3, 15), even(0.1, 5)], &held);
        sheet.mesh = 0.02;
        sheet.mold = Some(mold);
        // fabric point (u, v) where the front has come to s: on the mold behind it, on its tangent raised a little ahead
        let place = |[u, v]: [f64; 2], s: f64| {
            let angle = u.min(s) / radius;
            let ahead = (u - s).max(0.0);
            let (rise, slope) = (0.6 * ahead, 0.8 * ahead);
            if radius.is_infinite() {
                return [v, u.min(s) + slope, rise];
            }
            let normal = [angle.sin(), angle.cos()];
            let tangent = [angle.cos(), -angle.sin()];
            let coordinate = |n: usize| (radius + rise) * normal[n] + slope * tangent[n];
            [v, coordinate(0), coordinate(1)]
        };
        let mut cloth = flat(&sheet, 0.0);
        // the front starts beside the ply
        let first = -0.03;
        let start = |uv: &[f64; 2]| place(*uv, first);
        cloth.now.x = sheet.fabric.places.iter().map(start).collect();
        for (pad, uv) in cloth.now.pads.iter_mut().zip(&held) {
            *pad = Pad::new(place(*uv, first));
        }
        let steps = 330;
        for k in 0..=steps {
            let s = first + (0.3 - first) * k as f64 / steps as f64;
            let targets: Vec<[f64; 3]> = held.iter().map(|uv| place(*uv, s)).collect();
            follow(&mut cloth, &targets, 0.1);
        }
        let last: Vec<[f64; 3]> = held.iter().map(|uv| place(*uv, 0.3)).collect();
        rest(&mut cloth, &last);
        let mold = sheet.mold.as_ref().expect("a mold");
        for (x, uv) in cloth.now.x.iter().zip(&sheet.fabric.places) {
            let height = mold.signed_distance(*x);
            let off = crate::mold::distance(*x, place(*uv, 0.3));
            // ahead of the front the taut fabric sags by (3 w L⁴ / 64 EA′)^(1/3), half a millimeter, as its yarns stretch
            assert!(height < 2e-4 && off < 1.5e-3, "{radius} {uv:?}: {height} {off}");
        }
    }
}

/// A ply that lies on the mold comes off again where grippers lift it, and ends where it does if all of its nodes are
/// unknowns all the time; the nodes that were left out before are lifted too.
#[test]
fn nodes_that_were_left_out_are_lifted() {
    let held = pins();
    for friction in [Friction::Stick, Friction::StickForEver] {
        let mut sheet = sheet([even(0.3, 18), even(0.1, 6)], &held);
        sheet.mesh = 0.1 / 6.0;
        sheet.mold = Some(plane(0.0));
        sheet.friction = friction;
        let [ends, all] = [true, false].map(|leaves_out| {
            let mut cloth = flat(&sheet, 1e-4);
            let raised = |lift: f64| -> Vec<[f64; 3]> {
                let place = |[u, v]: &[f64; 2]| [*u, *v, if *u > 0.15 { lift } else { 0.0 }];
                held.iter().map(place).collect()
            };
            bring(&mut cloth, &raised(0.0), 2, 1.0);
            cloth.phase = if leaves_out { Phase::Follow } else { Phase::Rest };
            let mut most = 0;
            for step in 1..=20 {
                follow(&mut cloth, &raised(4e-4 * f64::from(step)), 1.0);
                most = most.max(cloth.resting.still.iter().filter(|still| **still).count());
            }
            assert_eq!(most > 20, leaves_out, "{most} of {} nodes", cloth.resting.still.len());
            let lifted = cloth.now.x.iter().filter(|x| x[2] > 5e-5).count();
            assert_eq!(lifted > 50, friction == Friction::Stick, "{lifted} nodes");
            cloth.now.x
        });
        // each step is solved to 0.01 mm, and the point where the ply comes off is known to 0.05 mm of height
        for (a, b) in ends.iter().zip(&all) {
            let off = crate::mold::distance(*a, *b);
            assert!(off < 5e-5, "{friction:?} {a:?}: {off}");
        }
    }
}

/// With its grippers held, a sheet that was let go never gains energy, kinetic energy included, in flight or on a mold.
#[test]
fn energy_never_rises_where_grippers_stand() {
    let held = [[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]];
    for friction in [Friction::Stick, Friction::Coulomb(0.3), Friction::Coulomb(0.0)] {
        let mut sheet = sheet([even(0.14, 14), even(0.14, 14)], &held);
        sheet.mold = Some(plane(0.1));
        sheet.friction = friction;
        let mut cloth = flat(&sheet, 0.03);
        let at: Vec<[f64; 3]> = cloth.now.pads.iter().map(|pad| pad.position).collect();
        let mut before = cloth.energy() + cloth.kinetic_energy();
        for step in 0..60 {
            follow(&mut cloth, &at, 0.004);
            let now = cloth.energy() + cloth.kinetic_energy();
            // friction is that of the pressure one step ago: what this lifts the ply by is below 0.01 mm
            let lift = 1e-5 * 3.143 * 0.14 * 0.14 * G;
            assert!(now <= before + lift, "{friction:?} step {step}: {before} {now}");
            before = now;
        }
    }
}
