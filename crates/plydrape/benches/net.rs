//! How long the ideal drape takes: the published hemisphere, and fine nets.
//!
//! `benches/run` prints these beside a SciPy solver of the same net; `benches/README.md` is its table.

use divan::{Bencher, black_box};
use plydrape::mold::{Face, Mold, Pose, Sphere};
use plydrape::net::{EdgeRule, Generators, Layup, Net};

fn main() {
    divan::main();
}

fn sphere(radius: f64) -> Mold {
    Mold::Sphere(Sphere { pose: Pose::new([0.0; 3], [0.0; 3]), radius, face: Face::Outside })
}

/// 24 × 24 nodes on the unit sphere, as published with KinDrape.
fn hemisphere(generators: Generators, edges: EdgeRule) -> Layup {
    let d: f64 = 0.075;
    Layup {
        nodes: [24, 24],
        mesh: [d, d],
        seed: [11, 11],
        place: [-d / 2.0, -d / 2.0, (1.0 - d * d / 2.0).sqrt()],
        heading: 0.0,
        shear: 0.0,
        generators,
        edges,
    }
}

/// A ply of 0.9 m on a sphere of 0.6 m radius.
fn fine(side: usize) -> Layup {
    let d = 0.9 / side as f64;
    Layup {
        nodes: [side, side],
        mesh: [d, d],
        seed: [side / 2, side / 2],
        place: [0.0, 0.0, 0.6],
        ..hemisphere(Generators::Geodesic, EdgeRule::Along)
    }
}

#[divan::bench]
fn hemisphere_24_bars_least_shear(bencher: Bencher) {
    let (mold, layup) = (sphere(1.0), hemisphere(Generators::LeastShear, EdgeRule::Chord));
    bencher.bench(|| Net::drape(black_box(&mold), black_box(layup)));
}

#[divan::bench]
fn hemisphere_24_along_geodesic(bencher: Bencher) {
    let (mold, layup) = (sphere(1.0), hemisphere(Generators::Geodesic, EdgeRule::Along));
    bencher.bench(|| Net::drape(black_box(&mold), black_box(layup)));
}

#[divan::bench(args = [100, 300])]
fn sphere_along_geodesic(bencher: Bencher, side: usize) {
    let (mold, layup) = (sphere(0.6), fine(side));
    bencher.bench(|| Net::drape(black_box(&mold), black_box(layup)));
}

#[divan::bench]
fn place_between_nodes(bencher: Bencher) {
    let mold = sphere(0.6);
    let net = Net::drape(&mold, fine(100)).expect("a sensible layup");
    bencher.bench(|| net.place(black_box(&mold), black_box([0.3217, 0.5432])));
}
