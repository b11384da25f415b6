//! Lips of vacuum cups.

use super::*;
use crate::layup::Lip;
use crate::sheet::energy::Energy;
use crate::sheet::lip;

/// A narrow strip of a light ply (m) with half of its length on each side of a pin, whose lip has a radius (m) and a rigidity (N·m).
fn balanced(half: f64, radius: f64, rigidity: f64) -> Sheet {
    let width = 2e-3;
    let place = [half, 0.5 * width];
    let mut strip = sheet([even(2.0 * half, 100), even(width, 2)], &[place]);
    strip.areal_mass = 0.01;
    strip.lips = vec![lip::under(&strip.fabric, &Lip { radius, rigidity }, place)];
    strip
}

/// How far the ends of a balanced strip hang below its pin (m).
fn droop(strip: &Sheet, half: f64) -> f64 {
    let mut cloth = flat(strip, 0.0);
    rest(&mut cloth, &[[half, 1e-3, 0.0]]);
    let end = strip.fabric.places.iter().position(|place| place[0] == 0.0).expect("an end");
    -cloth.now.x[end][2]
}

/// Each half is a cantilever with the rigidity of ply and lip up to the lip's edge and that of the ply beyond: with the weight w per area the
/// end is w/8 ((L⁴ − (L − r)⁴)/(D + D_lip) + (L − r)⁴/D) lower.
#[test]
fn a_strip_under_a_lip_is_a_beam_with_both_rigidities() {
    let (half, radius, ply) = (0.05, 0.0205, 9e-5);
    let weight = 0.01 * G;
    for rigidity in [1e-5, 1e-4, 1e-3] {
        let free = f64::powi(half - radius, 4);
        let expected = weight / 8.0 * ((half.powi(4) - free) / (ply + rigidity) + free / ply);
        let found = droop(&balanced(half, radius, rigidity), half);
        assert!((found / expected - 1.0).abs() < 5e-3, "{rigidity}: {found} {expected}");
    }
}

/// A lip that has let go bends nothing, and one that holds does not resist shear.
#[test]
fn a_lip_bends_only_what_its_cup_holds_and_does_not_shear_it() {
    let place = [0.05, 0.05];
    let mut ply = sheet([even(0.1, 10), even(0.1, 10)], &[place, [0.0, 0.0]]);
    let bare = ply.clone();
    ply.lips[0] = lip::under(&ply.fabric, &Lip { radius: 0.03, rigidity: 1e-3 }, place);
    let bent = |sheet: &Sheet, released: &[usize], shape: &dyn Fn([f64; 2]) -> [f64; 3]| {
        let mut cloth = flat(sheet, 0.0);
        cloth.release(released);
        for (x, uv) in cloth.now.x.iter_mut().zip(&sheet.fabric.places) {
            *x = shape(*uv);
        }
        cloth.energies.bending.value(&cloth.now)
    };
    // the curvature 2 of a parabola along u, everywhere but at both ends: 2 D_lip on the area of the lip
    let parabola = |[u, v]: [f64; 2]| [u, v, u * u];
    let [held, let_go] = [&[1][..], &[0]].map(|released| bent(&ply, released, &parabola));
    let without = bent(&bare, &[1], &parabola);
    let area = std::f64::consts::PI * 0.03_f64.powi(2);
    let expected = 2.0 * 1e-3 * area;
    assert!(((held - without) / expected - 1.0).abs() < 0.05, "{held} {without} {expected}");
    assert!((let_go / without - 1.0).abs() < 1e-12, "{let_go} {without}");

    let sheared = |[u, v]: [f64; 2]| [u + 0.3 * v, v, 0.0];
    assert!(bent(&ply, &[1], &sheared) < 1e-20);
}

/// The rigidity under a lip is that of its disc, whatever the mesh: the sum over the bends of a direction of area times rigidity.
#[test]
fn a_lip_is_a_disc_whatever_the_mesh() {
    let place = [0.05, 0.05];
    let disc = Lip { radius: 0.015, rigidity: 2.0 };
    let expected = 2.0 * std::f64::consts::PI * disc.radius.powi(2);
    for spacings in [5, 8, 10, 20] {
        let ply = sheet([even(0.1, spacings), even(0.1, spacings)], &[place]);
        let found = lip::under(&ply.fabric, &disc, place);
        for direction in [0, 1] {
            let of = found.iter().filter(|(n, _)| ply.fabric.bends[*n].direction == direction);
            let sum: f64 = of
                .map(|(n, rigidity)| {
                    let bend = &ply.fabric.bends[*n];
                    rigidity * bend.width * 0.5 * (bend.spacing[0] + bend.spacing[1])
                })
                .sum();
            assert!((sum / expected - 1.0).abs() < 0.12, "{spacings}: {sum} {expected}");
        }
    }
}
