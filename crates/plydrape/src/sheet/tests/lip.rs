//! Lips of vacuum cups.

use super::*;
use crate::layup::Lip;
use crate::mold::{Face, Pose, Sphere};
use crate::sheet::energy::Energy;
use crate::sheet::lip::Under;

/// A narrow strip of a light ply (m) with half of its length on each side of a pin, whose lip has a radius (m) and a rigidity (N·m).
fn balanced(half: f64, radius: f64, rigidity: f64) -> Sheet {
    let width = 2e-3;
    let place = [half, 0.5 * width];
    let mut strip = sheet([even(2.0 * half, 100), even(width, 2)], &[place]);
    strip.areal_mass = 0.01;
    strip.grippers[0].lip = Under::new(&strip.fabric, &Lip { radius, rigidity }, place);
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
    ply.grippers[0].lip = Under::new(&ply.fabric, &Lip { radius: 0.03, rigidity: 1e-3 }, place);
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
        let found = Under::new(&ply.fabric, &disc, place);
        for direction in [0, 1] {
            let of =
                found.bends.iter().filter(|(n, _)| ply.fabric.bends[*n].direction == direction);
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

/// What bears a lip is all of its mount, and its middle in the flat is the middle of the cup: inside the ply, beside its boundary, at a corner
/// that the lip hangs over, and on the boundary itself.
#[test]
fn the_nodes_under_a_lip_bear_it_around_its_middle() {
    let uneven = |ends: [f64; 2]| vec![0.0, ends[0], 0.02, 0.031, 0.04, 0.05, 0.062, ends[1]];
    let lip = Lip { radius: 0.015, rigidity: 1.0 };
    for place in [[0.031, 0.04], [0.008, 0.04], [0.008, 0.008], [0.0, 0.04]] {
        let ply = sheet([uneven([0.008, 0.07]), uneven([0.008, 0.07])], &[place]);
        let nodes = Under::new(&ply.fabric, &lip, place).nodes;
        let mean = |value: &dyn Fn([f64; 2]) -> f64| -> f64 {
            nodes.iter().map(|(n, share)| share * value(ply.fabric.places[*n])).sum()
        };
        assert!((mean(&|_| 1.0) - 1.0).abs() < 1e-12, "{nodes:?}");
        for axis in [0, 1] {
            assert!((mean(&|uv| uv[axis]) - place[axis]).abs() < 1e-12, "{place:?}: {nodes:?}");
        }
        assert!(nodes.iter().all(|(_, share)| *share > 0.0), "{nodes:?}");
        // inside the ply the mean square distance is that of a disc, r²/2, and more by what lies between nodes
        if place == [0.031, 0.04] {
            let square = mean(&|uv| (uv[0] - place[0]).powi(2) + (uv[1] - place[1]).powi(2));
            let between = 0.25 * 0.012_f64.powi(2);
            assert!(square > 0.5 * lip.radius.powi(2), "{square}");
            assert!(square < 0.5 * lip.radius.powi(2) + 2.0 * between, "{square}");
        }
    }
    // at the corner of a ply nothing has an opposite
    let corner = sheet([even(0.07, 7), even(0.07, 7)], &[[0.0; 2]]);
    assert_eq!(Under::new(&corner.fabric, &lip, [0.0; 2]).nodes, []);
}

/// A cup presses all of its lip on the mold. On a dome a flat disc would hover by r²/2R at its border, 0.19 mm; at its middle alone the weight
/// of the ply would have to bend it, which is a tenth of what that takes.
#[test]
fn a_cup_lays_its_whole_lip_on_a_dome() {
    let (radius, dome, place) = (0.015, 0.6, [0.03, 0.03]);
    let heights = |bears: bool| -> f64 {
        let mut ply = sheet([even(0.06, 12), even(0.06, 12)], &[place]);
        let pose = Pose::upright([place[0], place[1], -dome]);
        ply.areal_mass = 0.3;
        ply.grippers[0].mount = Some([2e3; 3]);
        ply.grippers[0].lip = Under::new(&ply.fabric, &Lip { radius, rigidity: 3e-4 }, place);
        if !bears {
            ply.grippers[0].lip.nodes.clear();
        }
        ply.mold = Some(Mold::Sphere(Sphere { pose, radius: dome, face: Face::Outside }));
        let mut cloth = flat(&ply, 5e-4);
        bring(&mut cloth, &[[place[0], place[1], -5e-4]], 10, 0.05);
        let mold = ply.mold.as_ref().expect("a dome");
        let is_under = |uv: &[f64; 2]| (uv[0] - place[0]).hypot(uv[1] - place[1]) <= radius;
        let under = ply.fabric.places.iter().zip(&cloth.now.x).filter(|(uv, _)| is_under(uv));
        under.map(|(_, x)| mold.closest_point(*x).distance).fold(0.0, f64::max)
    };
    let [whole, middle] = [true, false].map(heights);
    assert!(whole < 2e-5, "{whole}");
    assert!(middle > 1e-4 && middle < radius.powi(2) / (2.0 * dome) + 1e-5, "{middle}");
}

/// A mount pulls at the mean of what is under its lip: the nodes bear its force together, whatever their shape, and turning them about the
/// middle of the cup costs nothing.
#[test]
fn a_mount_feels_the_mean_of_its_lip_alone() {
    let place = [0.03, 0.03];
    let mut ply = sheet([even(0.06, 6), even(0.06, 6)], &[place]);
    ply.grippers[0].mount = Some([1e3, 2e3, 4e3]);
    ply.grippers[0].lip = Under::new(&ply.fabric, &Lip { radius: 0.015, rigidity: 1e-3 }, place);
    let energy = |shape: &dyn Fn([f64; 2]) -> [f64; 3]| {
        let mut cloth = flat(&ply, 0.0);
        for (x, uv) in cloth.now.x.iter_mut().zip(&ply.fabric.places) {
            *x = shape(*uv);
        }
        cloth.energies.mounts.value(&cloth.now)
    };
    let shifted = energy(&|[u, v]| [u + 1e-3, v, 2e-3]);
    assert!((shifted - 0.5 * (1e3 * 1e-6 + 4e3 * 4e-6)).abs() < 1e-12, "{shifted}");
    let tilted = energy(&|[u, v]| [u, v, 0.2 * (u - place[0]) - 0.1 * (v - place[1])]);
    assert!(tilted < 1e-20, "{tilted}");
}
