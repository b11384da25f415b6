//! Sheets and strips that hang, against printed figures, the elastica and closed forms.

use super::super::hand_over::{TILT_REACH, frame_around};
use super::*;
use crate::elastica::{Bending, Cantilever};
use crate::geometry::vector::angle_between;
use crate::material::MomentCurve;

/// 4 × 2 pins 98 mm apart hold cells of 100 mm: heights of the cells' middles, of the middles of the outer edges along u,
/// and of the edges along v (mm), by an independent cloth simulator (issue of 2026; shear 0.2 and 2 N/m per rad).
#[test]
fn a_net_of_pins_hangs_as_an_independent_simulator_has_it() {
    let figures = [
        (0.2, [-23.77, -21.24, -8.57, -8.92, -6.18, -8.68]),
        (2.0, [-19.30, -18.21, -8.91, -9.09, -8.70, -8.68]),
    ];
    let held = pins();
    for (shear, figures) in figures {
        let mut sheet = sheet([even(0.3, 36), even(0.1, 12)], &held);
        sheet.areal_mass = 0.3143;
        sheet.rigidity = [9e-6; 2];
        sheet.tension = TensionLaw::Linear { stiffness: 1e5 };
        sheet.shear = linear(shear);
        let mut cloth = flat(&sheet, 0.0);
        let to: Vec<[f64; 3]> = held.iter().map(|[u, v]| [0.98 * u, 0.98 * v, 0.0]).collect();
        bring(&mut cloth, &to, 20, 0.1);
        let height_mm =
            |u: f64, v: f64| sheet.fabric.node_at([u, v]).map(|n| cloth.now.x[n][2] * 1e3);
        let found = [
            height_mm(0.05, 0.05),
            height_mm(0.15, 0.05),
            height_mm(0.05, 0.0),
            height_mm(0.15, 0.0),
            height_mm(0.0, 0.05),
            height_mm(0.1, 0.05),
        ];
        for (found, figure) in found.into_iter().zip(figures) {
            let found = found.expect("a node");
            assert!((found / figure - 1.0_f64).abs() < 0.005, "{shear}: {found} {figure}");
        }
    }
}

/// The tilt of a gripper that is a point does not depend on the mesh: in the same net of pins, lines every fifth, tenth and
/// twentieth of a cell agree within 2°, and the finer two within 1°. Over the cells beside a pin
/// alone these two differ by 1.5°.
#[test]
fn the_tilt_of_a_point_does_not_depend_on_the_mesh() {
    let held = pins();
    let tilts = [5, 10, 20].map(|parts| {
        let mut sheet = sheet([even(0.3, 3 * parts), even(0.1, parts)], &held);
        sheet.mesh = 0.1 / parts as f64;
        let mut cloth = flat(&sheet, 0.0);
        let to: Vec<[f64; 3]> = held.iter().map(|[u, v]| [0.98 * u, 0.98 * v, 0.0]).collect();
        bring(&mut cloth, &to, 20, 0.1);
        let reach = TILT_REACH * sheet.pitch;
        let tilt = |place: &[f64; 2]| {
            let around = frame_around(&sheet.fabric, &cloth.now.x, *place, reach);
            angle_between(around.expect("cells").0, [0.0, 0.0, 1.0]).to_degrees()
        };
        held.iter().map(tilt).collect::<Vec<_>>()
    });
    for n in 0..held.len() {
        let [fifth, tenth, finest] = tilts.each_ref().map(|tilts| tilts[n]);
        let [coarse, fine] = [fifth, tenth].map(|tilt| (tilt - finest).abs());
        assert!(
            finest > 10.0 && coarse < 2.0 && fine < 1.0,
            "gripper {n}: {fifth} {tenth} {finest}"
        );
    }
}

/// A strip with slack hangs as the heavy inextensible elastica. Sag and force for EI = 9e-6 N m², w = 0.3143 · 9.8 N/m,
/// 100 mm on 98 mm between pins are those of SciPy's `solve_bvp` (8.6795 mm, 0.42296 N).
#[test]
fn a_strip_hangs_as_the_elastica() {
    let mut sheet = sheet([even(0.1, 40), vec![0.0]], &[[0.0, 0.0], [0.1, 0.0]]);
    sheet.mesh = 0.0025;
    let mut cloth = flat(&sheet, 0.0);
    bring(&mut cloth, &[[0.001, 0.0, 0.0], [0.099, 0.0, 0.0]], 20, 0.1);
    let sag = -cloth.now.x[20][2] * 1e3;
    let force = cloth.forces()[0][0];
    // the error of the mesh falls with its square, and is 2e-3 at 40 segments
    assert!((sag / 8.6795 - 1.0).abs() < 2e-3, "{sag}");
    assert!((force / 0.42296 - 1.0).abs() < 4e-3, "{force}");
}

/// Tip (m) of a heavy inextensible cantilever that leaves its clamp level: θ'' = (w/EI) (L − s) cos θ, θ(0) = 0,
/// θ'(L) = 0, by Runge–Kutta steps and bisection of θ'(0).
pub(crate) fn cantilever(length: f64, load_per_rigidity: f64) -> [f64; 2] {
    let shoot = |start: f64| {
        let steps = 2000;
        let h = length / steps as f64;
        let rate = |s: f64, [angle, bend, ..]: [f64; 4]| {
            [bend, load_per_rigidity * (length - s) * angle.cos(), angle.cos(), angle.sin()]
        };
        let mut y = [0.0, start, 0.0, 0.0];
        for k in 0..steps {
            let s = h * k as f64;
            let moved = |k: [f64; 4], t: f64| [0, 1, 2, 3].map(|n| y[n] + t * k[n]);
            let a = rate(s, y);
            let b = rate(s + 0.5 * h, moved(a, 0.5 * h));
            let c = rate(s + 0.5 * h, moved(b, 0.5 * h));
            let d = rate(s + h, moved(c, h));
            y = [0, 1, 2, 3].map(|n| y[n] + h / 6.0 * (a[n] + 2.0 * b[n] + 2.0 * c[n] + d[n]));
        }
        y
    };
    let (mut low, mut high) = (-load_per_rigidity * length * length, 0.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if shoot(middle)[1] > 0.0 { high = middle } else { low = middle }
    }
    let [.., x, z] = shoot(high);
    [x, z]
}

/// The heavy cantilever against Runge–Kutta steps of the same equation, from stiff to limp.
#[test]
fn a_cantilever_is_that_of_a_shooting_method() {
    for load_per_rigidity in [1e3, 3e4, 1e5] {
        let (length, weight) = (0.1, 3.0);
        let bending = Bending::Rigidity(weight / load_per_rigidity);
        let strip = Cantilever { length, angle: 0.0, weight, bending };
        let [x, z] = strip.solve().expect("a cantilever").at(length);
        let [a, b] = cantilever(length, load_per_rigidity);
        // the steps of the shooting method have an error of their own
        assert!(
            (x - a).abs() < 1e-7 && (z - b).abs() < 1e-7,
            "{load_per_rigidity}: {x} {a} {z} {b}"
        );
    }
}

/// A strip that is clamped level at one end hangs as the heavy cantilever, through large deflections.
#[test]
fn a_cantilever_is_the_elastica() {
    let (length, spacings) = (0.03, 48);
    let h = length / spacings as f64;
    // two held nodes are a clamp whose end is in the middle between them
    let lines = (0..=spacings + 1).map(|n| h * n as f64).collect();
    let mut sheet = sheet([lines, vec![0.0]], &[[0.0, 0.0], [h, 0.0]]);
    sheet.mesh = h;
    let mut cloth = flat(&sheet, 0.0);
    let held: Vec<[f64; 3]> = cloth.now.pads.iter().map(|pad| pad.position).collect();
    rest(&mut cloth, &held);
    let tip = cloth.now.x[spacings + 1];
    let free = length + 0.5 * h;
    let [x, z] = cantilever(free, 3.143 * G / 9e-5);
    let off = [tip[0] - 0.5 * h - x, tip[2] - z];
    assert!(off.iter().all(|c| c.abs() < 5e-3 * free), "{tip:?} {x} {z}");
    // it hangs by more than a third of its length, where a linear beam would be wrong by more than this
    assert!(z < -0.3 * free);
}

/// A moment that rises less and less, of a strip one cell of 100 mm wide per width.
fn softening() -> MomentCurve {
    MomentCurve { curvature: vec![0.0, 5.0, 20.0, 60.0], moment: vec![0.0, 4.5e-4, 9e-4, 1.2e-3] }
}

/// A strip whose moment is a table hangs as the exact elastica of the same table, far lower than with its rigidity at rest.
#[test]
fn a_softening_cantilever_is_the_exact_elastica() {
    let (length, spacings) = (0.03, 48);
    let h = length / spacings as f64;
    let lines = (0..=spacings + 1).map(|n| h * n as f64).collect();
    let mut sheet = sheet([lines, vec![0.0]], &[[0.0, 0.0], [h, 0.0]]);
    sheet.mesh = h;
    sheet.moment = [Some(softening()), None];
    let mut cloth = flat(&sheet, 0.0);
    let held: Vec<[f64; 3]> = cloth.now.pads.iter().map(|pad| pad.position).collect();
    rest(&mut cloth, &held);
    let tip = cloth.now.x[spacings + 1];
    let free = length + 0.5 * h;
    let weight = 3.143 * G;
    let strip =
        Cantilever { length: free, angle: 0.0, weight, bending: Bending::Curve(softening()) };
    let [x, z] = strip.solve().expect("a cantilever").at(free);
    let off = [tip[0] - 0.5 * h - x, tip[2] - z];
    assert!(off.iter().all(|c| c.abs() < 5e-3 * free), "{tip:?} {x} {z}");
    let [_, stiff] = cantilever(free, weight / 9e-5);
    assert!(z < 1.1 * stiff, "{z} {stiff}");
}

/// What the grippers do to a strip whose moment is a table is stored: slowly brought together, the energy of bending and
/// weight changes by the work of their forces.
#[test]
fn a_softening_strip_stores_the_work_of_its_grippers() {
    let mut sheet = sheet([even(0.1, 20), vec![0.0]], &[[0.0, 0.0], [0.1, 0.0]]);
    sheet.mesh = 0.005;
    sheet.moment = [Some(softening()), None];
    let mut cloth = flat(&sheet, 0.0);
    let places = |share: f64| [[0.01 * share, 0.0, 0.0], [0.1 - 0.01 * share, 0.0, 0.0]];
    bring(&mut cloth, &places(0.2), 10, 0.1);
    let (start, mut work) = (cloth.energy(), 0.0);
    let mut before = cloth.forces();
    for step in 1..=40 {
        bring(&mut cloth, &places(0.2 + 0.02 * f64::from(step)), 1, 0.1);
        let forces = cloth.forces();
        // both move by 0.2 mm, the first one along x and the second one against it
        let along = |forces: &[[f64; 3]]| forces[0][0] - forces[1][0];
        work += 0.5 * (along(&before) + along(&forces)) * 2e-4;
        before = forces;
    }
    let stored = cloth.energy() - start;
    assert!((stored.abs() / work.abs() - 1.0).abs() < 0.01, "{stored} {work}");
}

/// A cell whose frame is sheared stores area · ∫ τ dγ, and its frame is loaded as virtual work has it.
#[test]
fn a_picture_frame_gives_the_shear_law_back() {
    let side = 0.1;
    // the frame holds every node of the boundary
    let along = even(side, 4);
    let on_frame = |c: f64| c == 0.0 || c == side;
    let places = along.iter().flat_map(|v| along.iter().map(move |u| [*u, *v]));
    let held: Vec<[f64; 2]> = places.filter(|uv| uv.iter().any(|c| on_frame(*c))).collect();
    let mut sheet = sheet([along.clone(), along.clone()], &held);
    // all but without weight, so that the cell stays flat
    sheet.gravity = 1e-9;
    let coefficients = vec![5.0, -2.0, 30.0];
    sheet.shear = ShearCurve::Polynomial { coefficients };
    for degrees in [5.0_f64, 20.0, -20.0, 40.0] {
        let gamma = degrees.to_radians();
        let corner = |[u, v]: [f64; 2]| [u + v * gamma.sin(), v * gamma.cos(), 0.0];
        let mut cloth = flat(&sheet, 0.0);
        let to: Vec<[f64; 3]> = held.iter().map(|uv| corner(*uv)).collect();
        bring(&mut cloth, &to, 40, 1.0);
        // yarns give way by τ/EA′, some 1e-5
        let (tau, _) = sheet.shear.force(gamma);
        let g = gamma.abs();
        let stored = side * side * (2.5 * g * g - 2.0 / 3.0 * g.powi(3) + 7.5 * g.powi(4));
        assert!((cloth.energy() / stored - 1.0).abs() < 1e-4, "{degrees}: {}", cloth.energy());
        // the forces on the frame do work on the way that the shear moves them
        let work: f64 = cloth
            .forces()
            .iter()
            .zip(&held)
            .map(|(force, [_, v])| -v * (force[0] * gamma.cos() - force[1] * gamma.sin()))
            .sum();
        let torque = side * side * tau * gamma.signum();
        assert!((work / torque - 1.0).abs() < 1e-4, "{degrees}: {work} {torque}");
    }
}
