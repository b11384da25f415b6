//! What the sheet must agree with: closed forms, the elastica, printed figures, invariants.

mod derivatives;
mod fixed_pads;
pub(crate) mod hanging;
mod lip;
mod mounts;
mod on_mold;
mod pick_up;
mod random;
mod rate;
mod release;

use super::cloth::Cloth;
use super::gripper::{Gripper, Pad};
use super::{Fabric, Sheet, SheetTuning};
use crate::layup::Friction;
use crate::material::{ShearCurve, TensionLaw};
use crate::mold::{Mold, Plane};

/// Acceleration of gravity of the references (m/s²).
const G: f64 = 9.8;

/// A linear shear law (N/m per rad).
fn linear(slope: f64) -> ShearCurve {
    ShearCurve::Polynomial { coefficients: vec![slope] }
}

/// A sheet between lines (m) of the paper's ply by area, with grippers on single points of it.
fn sheet(lines: [Vec<f64>; 2], held: &[[f64; 2]]) -> Sheet {
    let gripper = |place: &[f64; 2]| Gripper {
        place: *place,
        radius: 0.0,
        mount: None,
        slip_force: None,
        max_tilt: 40_f64.to_radians(),
        lip: Default::default(),
    };
    let pitch = 0.1;
    Sheet {
        fabric: Fabric::rectangle(lines, pitch),
        grippers: held.iter().map(gripper).collect(),
        mold: None,
        areal_mass: 3.143,
        rigidity: [9e-5; 2],
        moment: Default::default(),
        tension: TensionLaw::Linear { stiffness: 1e6 },
        shear: linear(5.0),
        shear_rate: None,
        gravity: G,
        friction: Friction::Stick,
        tack: 0.0,
        pitch,
        mesh: 0.01,
        tool: None,
        table: None,
    }
}

/// Lines from 0 to `length` (m), a number of spacings.
fn even(length: f64, spacings: usize) -> Vec<f64> {
    (0..=spacings).map(|n| length * n as f64 / spacings as f64).collect()
}

/// Fabric coordinates (m) of 4 × 2 grippers at the corners of cells of 100 mm.
fn pins() -> Vec<[f64; 2]> {
    (0..8).map(|n| [0.1 * (n % 4) as f64, 0.1 * (n / 4) as f64]).collect()
}

/// The sheet flat at a height (m), where its fabric coordinates are x and y.
fn flat(sheet: &Sheet, z: f64) -> Cloth<'_> {
    let lifted = |[u, v]: [f64; 2]| [u, v, z];
    let x = sheet.fabric.places.iter().map(|uv| lifted(*uv)).collect();
    let pads = sheet.grippers.iter().map(|gripper| Pad::new(lifted(gripper.place))).collect();
    Cloth::new(sheet, SheetTuning::default(), x, pads)
}

/// Moves the grippers straight to places (m) in a time (s), in shorter steps where one is not solved.
fn follow(cloth: &mut Cloth, to: &[[f64; 3]], dt: f64) {
    let from: Vec<[f64; 3]> = cloth.now.pads.iter().map(|pad| pad.target).collect();
    let (mut done, mut share) = (0.0, 1.0_f64);
    while done < 1.0 {
        let t = f64::min(done + share, 1.0);
        let between = |(a, b): (&[f64; 3], &[f64; 3])| crate::geometry::vector::between(*a, *b, t);
        let targets: Vec<[f64; 3]> = from.iter().zip(to).map(between).collect();
        match cloth.advance(&targets, dt * share, 1e-5) {
            Ok(_) => done = t,
            Err(failure) if share < 1e-6 => panic!("a short step is not solved: {failure:?}"),
            Err(_) => share *= 0.5,
        }
    }
}

/// Moves the grippers to places (m) in steps of a time each (s), then waits until nothing moves.
fn bring(cloth: &mut Cloth, to: &[[f64; 3]], steps: usize, dt: f64) {
    let from: Vec<[f64; 3]> = cloth.now.pads.iter().map(|pad| pad.target).collect();
    for k in 1..=steps {
        let t = k as f64 / steps as f64;
        let between = |(a, b): (&[f64; 3], &[f64; 3])| crate::geometry::vector::between(*a, *b, t);
        let targets: Vec<[f64; 3]> = from.iter().zip(to).map(between).collect();
        follow(cloth, &targets, dt);
    }
    rest(cloth, to);
}

/// Waits until nothing moves.
fn rest(cloth: &mut Cloth, at: &[[f64; 3]]) {
    let mut dt = 0.01;
    for _ in 0..1000 {
        match cloth.advance(at, dt, 1e-9) {
            Ok(_) if cloth.movement() < 1e-8 && dt == 1.0 => return,
            Ok(_) => dt = f64::min(2.0 * dt, 1.0),
            Err(_) => dt *= 0.25,
        }
    }
    panic!("the sheet does not come to rest: it moves by {} m", cloth.movement());
}

/// The plane z = 0, turned by an angle (rad) about y.
fn plane(angle: f64) -> Mold {
    Mold::Plane(Plane { point: [0.0; 3], normal: [-angle.sin(), 0.0, angle.cos()] })
}
