//! Gradients and second derivatives against central differences, and invariance.

use super::*;
use crate::geometry::matrix3::{rotation, times};
use crate::material::{MomentCurve, ShearCurve};

/// A crumpled sheet: every node off its place by a pseudo-random share of a spacing.
fn crumpled(sheet: &Sheet) -> Cloth<'_> {
    let mut cloth = flat(sheet, 0.05);
    let mut seed = 12345_u64;
    for x in &mut cloth.now.x {
        for c in x {
            seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            *c += 0.3 * 0.01 * ((seed >> 40) as f64 / (1_u64 << 24) as f64 - 0.5);
        }
    }
    cloth
}

fn uneven() -> [Vec<f64>; 2] {
    [vec![0.0, 0.01, 0.024, 0.03, 0.045], vec![0.0, 0.012, 0.02, 0.033]]
}

/// A moment that rises less and less; crumpled sheets reach all of its lines.
fn softening() -> MomentCurve {
    MomentCurve { curvature: vec![0.0, 8.0, 20.0, 40.0], moment: vec![0.0, 0.8, 1.2, 1.3] }
}

/// The gradient of all energies is what central differences of the energy give, within their error.
#[test]
fn the_gradient_is_that_of_the_energy() {
    let mut sheet = sheet(uneven(), &[]);
    sheet.mold = Some(plane(0.3));
    sheet.tension = TensionLaw::Table { strain: vec![0.0, 0.01, 0.1], force: vec![0.0, 10.0, 1e3] };
    sheet.shear = ShearCurve::Polynomial { coefficients: vec![5.0, 3.0] };
    sheet.moment[1] = Some(softening());
    let mut cloth = crumpled(&sheet);
    for x in &mut cloth.now.x {
        x[2] -= 0.05;
    }
    let gradient = cloth.gradient();
    let largest = gradient.iter().flatten().fold(0.0, |most: f64, g| most.max(g.abs()));
    let h = 1e-7;
    for node in 0..cloth.now.x.len() {
        for n in 0..3 {
            let mut at = |shift: f64| {
                cloth.now.x[node][n] += shift;
                let energy = cloth.energy();
                cloth.now.x[node][n] -= shift;
                energy
            };
            let central = (at(h) - at(-h)) / (2.0 * h);
            assert!((central - gradient[node][n]).abs() < 1e-5 * largest, "{node} {n}");
        }
    }
}

/// The whole second derivative, applied to a direction, is the central difference of the gradient along it.
#[test]
fn the_second_derivative_is_that_of_the_gradient() {
    let mut sheet = sheet(uneven(), &[]);
    sheet.tension = TensionLaw::Linear { stiffness: 300.0 };
    sheet.shear = ShearCurve::Polynomial { coefficients: vec![50.0, 30.0] };
    sheet.moment = [Some(softening()), None];
    let mut cloth = crumpled(&sheet);
    let direction: Vec<[f64; 3]> =
        (0..cloth.now.x.len()).map(|n| [(n as f64).sin(), (2.0 * n as f64).cos(), 0.7]).collect();
    let product = cloth.second_derivative_times(&direction);
    let h = 1e-6;
    let mut at = |shift: f64| {
        for (x, d) in cloth.now.x.iter_mut().zip(&direction) {
            crate::sheet::system::add(x, shift, *d);
        }
        let gradient = cloth.gradient();
        for (x, d) in cloth.now.x.iter_mut().zip(&direction) {
            crate::sheet::system::add(x, -shift, *d);
        }
        gradient
    };
    let (plus, minus) = (at(h), at(-h));
    let largest = product.iter().flatten().fold(0.0, |most: f64, g| most.max(g.abs()));
    for node in 0..product.len() {
        for n in 0..3 {
            let central = (plus[node][n] - minus[node][n]) / (2.0 * h);
            let off = (central - product[node][n]).abs();
            assert!(off < 1e-5 * largest, "{node} {n}: {central} {}", product[node][n]);
        }
    }
}

/// Moving and turning a flat sheet as a whole stores no energy but that of its weight, and loads no node.
#[test]
fn rigid_motions_cost_nothing() {
    let sheet = sheet(uneven(), &[]);
    let mut cloth = flat(&sheet, 0.0);
    let turn = rotation([0.4, -0.9, 0.3]);
    for x in &mut cloth.now.x {
        *x = times(&turn, *x);
        x[0] += 3.0;
    }
    let weight: f64 = sheet.areal_mass * G;
    let height: f64 =
        cloth.now.x.iter().zip(&sheet.fabric.areas).map(|(x, a)| weight * a * x[2]).sum();
    assert!((cloth.energy() - height).abs() < 1e-12);
    let gradient = cloth.gradient();
    for (g, area) in gradient.iter().zip(&sheet.fabric.areas) {
        let own = [g[0], g[1], g[2] - weight * area];
        // stiffness times rounding of the positions
        assert!(own.iter().all(|c| c.abs() < 1e6 * 0.01 * 1e-13), "{own:?}");
    }
}

/// A curve of the moment with one slope is the rigidity: energy, gradient and second derivative are the same.
#[test]
fn a_straight_curve_of_the_moment_is_its_rigidity() {
    let plain = sheet(uneven(), &[]);
    let mut curved = plain.clone();
    let straight = MomentCurve { curvature: vec![0.0, 5.0, 40.0], moment: vec![0.0, 45e-5, 36e-4] };
    curved.moment = [Some(straight.clone()), Some(straight)];
    let (mut a, mut b) = (crumpled(&plain), crumpled(&curved));
    assert!((a.energy() - b.energy()).abs() < 1e-12 * a.energy().abs());
    let direction: Vec<[f64; 3]> =
        (0..a.now.x.len()).map(|n| [(n as f64).sin(), 0.3, (2.0 * n as f64).cos()]).collect();
    let products = [&mut a, &mut b].map(|cloth| cloth.second_derivative_times(&direction));
    let gradients = [&mut a, &mut b].map(|cloth| cloth.gradient());
    for pair in [products, gradients] {
        let largest = pair[0].iter().flatten().fold(0.0, |most: f64, c| most.max(c.abs()));
        for (a, b) in pair[0].iter().flatten().zip(pair[1].iter().flatten()) {
            assert!((a - b).abs() < 1e-12 * largest);
        }
    }
}
