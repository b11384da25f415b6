//! Gradients and second derivatives against central differences, and invariance.

use super::*;
use crate::geometry::vector::{cross, norm};
use crate::layup::Lip;
use crate::material::{MomentCurve, Relaxation, ShearCurve, ShearRate};
use crate::sheet::configuration::Configuration;
use crate::sheet::energy::Stiffness;
use crate::sheet::lip::Under;
use crate::sheet::matrix3::{rotation, times};
use crate::sheet::system::Parts;

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

/// Numbers between −1 and 1 from a seed.
fn random(seed: &mut u64) -> f64 {
    *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
    (*seed >> 33) as f64 / (1_u64 << 30) as f64 - 1.0
}

/// A sheet with laws that are no straight lines, on an inclined mold with friction, held by a pin on a mount that slides with a lip around it, a rigid
/// pin, and a pad on a mount whose tilt is limited.
fn held(max_tilt: f64) -> Sheet {
    let mut sheet = sheet(uneven(), &[[0.03, 0.02], [0.045, 0.0], [0.0, 0.012]]);
    sheet.mold = Some(plane(0.3));
    sheet.friction = Friction::Coulomb(0.4);
    sheet.tension = TensionLaw::Table { strain: vec![0.0, 0.01, 0.1], force: vec![0.0, 10.0, 1e3] };
    sheet.shear = ShearCurve::Polynomial { coefficients: vec![50.0, 30.0] };
    sheet.shear_rate = Some(ShearRate {
        stiffness: 80.0,
        relaxation: Relaxation { temperature: vec![300.0], time: vec![0.03] },
        temperature: 300.0,
    });
    sheet.moment[1] = Some(softening());
    let [pin, pad] = [0, 2];
    sheet.grippers[pin].mount = Some([2e3, 2e3, 5e3]);
    sheet.grippers[pin].slip_force = Some(0.5);
    let lip = Lip { radius: 0.005, rigidity: 1e-3 };
    sheet.grippers[pin].lip = Under::new(&sheet.fabric, &lip, sheet.grippers[pin].place);
    sheet.grippers[pad] = Gripper {
        radius: 0.013,
        mount: Some([1e3, 1e3, 3e3]),
        max_tilt,
        ..sheet.grippers[pad].clone()
    };
    sheet
}

/// The crumpled ply of a sheet on its mold: some nodes press and some do not, some slip and some stick, mounts are loaded and the pad
/// is tilted by 0.28 rad.
fn loaded(sheet: &Sheet) -> Cloth<'_> {
    // a penalty so soft that pressure and friction are of the size of the other forces
    let tuning = SheetTuning { contact_depth: 1e-3, slip: 1e-3, ..SheetTuning::default() };
    let Configuration { x, pads, .. } = crumpled(sheet).now;
    let mut cloth = Cloth::new(sheet, tuning, x, pads);
    let mut seed = 99_u64;
    let down = |x: &mut [f64; 3]| x[2] += 0.3 * x[0] - 0.0505;
    cloth.now.x.iter_mut().for_each(down);
    for pad in &mut cloth.now.pads {
        down(&mut pad.position);
        pad.target = pad.position.map(|c| c + 1e-3 * random(&mut seed));
    }
    cloth.now.pads[2].rotate([0.2, -0.2, 0.1]);
    cloth.now.v.iter_mut().flatten().for_each(|v| *v = random(&mut seed));
    cloth.energies.inertia.predict(&cloth.now, 0.02);
    let flat = flat(sheet, 0.05).now;
    cloth.energies.shear.begin(&flat.x, 0.01);
    cloth.energies.shear.end(&cloth.now.x);
    cloth.energies.shear.begin(&cloth.now.x, 0.02);
    if let Some(contact) = &mut cloth.energies.contact {
        contact.anchor(&cloth.now.x);
    }

    // away from the anchors, with the nodes of the pad on the pad
    let unknowns = cloth.system.gradient_of_unknowns().len();
    let away: Vec<f64> = (0..unknowns).map(|_| 3e-4 * random(&mut seed)).collect();
    cloth.now = moved(&mut cloth, &away, 1.0);
    cloth.energies.stretch.start(&cloth.now.x);
    if let Some(contact) = &mut cloth.energies.contact {
        contact.find(&cloth.now.x, |_| false);
    }
    cloth
}

/// The configuration of a ply that has gone a share of a direction of its unknowns.
fn moved(cloth: &mut Cloth, direction: &[f64], share: f64) -> Configuration {
    let mut now = cloth.now.clone();
    cloth.system.go_along(direction);
    cloth.pads.take(share, &mut now, &cloth.system);
    now
}

/// Linearizes the term with a number where the ply is `now`.
fn linearize(cloth: &mut Cloth, n: usize, now: &Configuration, stiffness: Stiffness) {
    let Cloth { energies, system, .. } = cloth;
    if let Some(contact) = &mut energies.contact {
        contact.find(&now.x, |_| false);
    }
    system.begin(now, Parts::All);
    let term = energies.incremental().nth(n).expect("a term");
    term.linearize(now, stiffness, system);
    system.end(stiffness);
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Largest of some numbers where a direction is not zero.
fn largest_along(numbers: &[f64], direction: &[f64]) -> f64 {
    let along = numbers.iter().zip(direction).filter(|(_, d)| **d != 0.0);
    along.fold(0.0, |most: f64, (number, _)| most.max(number.abs()))
}

/// Directions of all unknowns: of each block alone, and of all together.
fn directions(unknowns: usize) -> impl Iterator<Item = Vec<f64>> {
    let mut seed = 7_u64;
    let together = [None; 20];
    (0..unknowns / 3).map(Some).chain(together).map(move |block| {
        let acts = |n: usize| block.is_none_or(|block| n / 3 == block);
        (0..unknowns).map(|n| if acts(n) { random(&mut seed) } else { 0.0 }).collect()
    })
}

/// The terms in the order of eq. (19g) and (19).
const TERMS: [&str; 7] = ["inertia", "weight", "stretch", "shear", "bending", "contact", "mounts"];

/// The gradient of each term is the derivative of its value, along each unknown: of free nodes, and of the turn and shift of a pad
/// that is tilted beyond its limit.
#[test]
fn the_gradient_of_each_term_is_the_derivative_of_its_value() {
    let sheet = held(0.1);
    let mut cloth = loaded(&sheet);
    for (n, name) in TERMS.iter().enumerate() {
        let now = cloth.now.clone();
        linearize(&mut cloth, n, &now, Stiffness::WHOLE);
        let gradient = cloth.system.gradient_of_unknowns();
        let largest = gradient.iter().fold(0.0, |most: f64, g| most.max(g.abs()));
        assert!(largest > 0.0, "{name} does nothing");
        let h = 1e-7;
        for direction in directions(gradient.len()) {
            let mut value = |share: f64| {
                let now = moved(&mut cloth, &direction, share);
                cloth.energies.incremental().nth(n).expect("a term").value(&now)
            };
            let central = (value(h) - value(-h)) / (2.0 * h);
            let off = (central - product(&gradient, &direction)).abs();
            let own = largest_along(&gradient, &direction);
            // the square of the step, and rounding of the value over the step
            assert!(off < 1e-5 * own + 1e-8 * largest, "{name}: {central} {off} of {own}");
        }
    }
}

/// The whole stiffness of each term is the derivative of its gradient, where the pad is within its tilt limit.
#[test]
fn the_stiffness_of_each_term_is_the_derivative_of_its_gradient() {
    let sheet = held(1.0);
    let mut cloth = loaded(&sheet);
    for (n, name) in TERMS.iter().enumerate() {
        let now = cloth.now.clone();
        linearize(&mut cloth, n, &now, Stiffness::WHOLE);
        let all: Vec<Vec<f64>> = directions(cloth.system.gradient_of_unknowns().len()).collect();
        let products: Vec<Vec<f64>> = all.iter().map(|d| cloth.system.multiply(d)).collect();
        let largest = products.iter().flatten().fold(0.0, |most: f64, g| most.max(g.abs()));
        // weight has none but by the arms of the pad
        assert!(largest > 0.0, "{name} has no stiffness");
        let h = 1e-7;
        for (direction, expected) in all.iter().zip(&products) {
            // along a turn about one axis, the torque about this axis is the derivative of the value
            let mut slope = |share: f64| {
                let now = moved(&mut cloth, direction, share);
                linearize(&mut cloth, n, &now, Stiffness::WHOLE);
                product(&cloth.system.gradient_of_unknowns(), direction)
            };
            let central = (slope(h) - slope(-h)) / (2.0 * h);
            let off = (central - product(direction, expected)).abs();
            let own = largest_along(expected, direction);
            assert!(off <= 1e-5 * own + 1e-8 * largest, "{name}: {central} {off} of {own}");
        }
    }
}

/// Beyond the tilt limit the stiffness about the axis of the tilt is the derivative of the torque, k.
#[test]
fn a_tilt_limit_is_as_stiff_about_its_axis_as_its_torque_grows() {
    let sheet = held(0.1);
    let mut cloth = loaded(&sheet);
    let mounts = TERMS.len() - 1;
    let pad = &cloth.now.pads[2];
    let axis = cross(pad.stem, pad.normal());
    let axis = axis.map(|c| c / norm(axis));
    let mut direction = vec![0.0; cloth.system.gradient_of_unknowns().len()];
    // the pads' blocks come first, the turn before the shift
    direction[..3].copy_from_slice(&axis);
    let now = cloth.now.clone();
    linearize(&mut cloth, mounts, &now, Stiffness::WHOLE);
    let stiffness = product(&cloth.system.multiply(&direction), &direction);
    let mut torque = |turn: f64| {
        let now = moved(&mut cloth, &direction, turn);
        linearize(&mut cloth, mounts, &now, Stiffness::WHOLE);
        product(&cloth.system.gradient_of_unknowns(), &direction)
    };
    let central = (torque(1e-5) - torque(-1e-5)) / 2e-5;
    let k = SheetTuning::default().tilt_stiffness * 3.143 * G * sheet.pitch.powi(3);
    assert!((stiffness / k - 1.0).abs() < 1e-8, "{stiffness} {k}");
    assert!((central / k - 1.0).abs() < 1e-6, "{central} {k}");
}

/// The positive part of the stiffness of each term has no negative eigenvalue; the whole of stretch under compression and of shear
/// has.
#[test]
fn the_positive_part_of_each_term_is_positive_semi_definite() {
    let sheet = held(0.1);
    let mut cloth = loaded(&sheet);
    let now = cloth.now.clone();
    for (n, name) in TERMS.iter().enumerate() {
        let mut is_positive = |stiffness| {
            linearize(&mut cloth, n, &now, stiffness);
            cloth.system.is_positive(1e-9)
        };
        assert!(is_positive(Stiffness::POSITIVE), "{name}");
        if matches!(*name, "stretch" | "shear") {
            assert!(!is_positive(Stiffness::WHOLE), "{name}");
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
    let direction: Vec<f64> = (0..3 * a.now.x.len()).map(|n| (n as f64).sin()).collect();
    let gradients = [&mut a, &mut b].map(|cloth| cloth.gradient().into_flattened());
    let products = [&a, &b].map(|cloth| cloth.system.multiply(&direction));
    for pair in [products, gradients] {
        let largest = pair[0].iter().fold(0.0, |most: f64, c| most.max(c.abs()));
        for (a, b) in pair[0].iter().zip(&pair[1]) {
            assert!((a - b).abs() < 1e-12 * largest);
        }
    }
}
