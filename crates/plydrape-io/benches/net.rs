//! How long the ideal drape takes: the published hemisphere, and fine nets.
//!
//! `benches/run` prints these beside a SciPy solver of the same net; `benches/README.md` is its table.

use divan::{Bencher, black_box};
use plydrape::mold::{Face, Mold, Pose, Sphere};
use plydrape::net::{EdgeRule, Generators, Net, Placement};
use std::fmt::Write;
use std::sync::Arc;

fn main() {
    divan::main();
}

fn sphere(radius: f64) -> Mold {
    Mold::Sphere(Sphere { pose: Pose::new([0.0; 3], [0.0; 3]), radius, face: Face::Outside })
}

/// 24 × 24 nodes on the unit sphere, as published with KinDrape.
fn hemisphere(generators: Generators, edges: EdgeRule) -> Placement {
    let d: f64 = 0.075;
    Placement {
        nodes: [24, 24],
        mesh: [d, d],
        origin: [0.0; 2],
        seed: [11, 11],
        place: [-d / 2.0, -d / 2.0, (1.0 - d * d / 2.0).sqrt()],
        heading: 0.0,
        shear: 0.0,
        generators,
        edges,
    }
}

/// A ply of 0.9 m on a sphere of 0.6 m radius.
fn fine(side: usize) -> Placement {
    let d = 0.9 / side as f64;
    Placement {
        nodes: [side, side],
        mesh: [d, d],
        origin: [0.0; 2],
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

/// A cap of the sphere of 0.6 m radius as 100 352 triangles.
fn meshed_cap() -> Mold {
    let (n, radius) = (224, 0.6);
    let mut text = String::new();
    let arc = |k: usize| 1.2 * (k as f64 / n as f64 - 0.5);
    for (i, j) in (0..=n).flat_map(|j| (0..=n).map(move |i| (i, j))) {
        let (x, y) = (arc(i), arc(j));
        let angle = x.hypot(y) / radius;
        let out = radius * angle.sin() / x.hypot(y).max(1e-300);
        let _ = writeln!(text, "v {:?} {:?} {:?}", out * x, out * y, radius * angle.cos());
    }
    for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
        let a = j * (n + 1) + i + 1;
        let (b, c, d) = (a + 1, a + n + 2, a + n + 1);
        let _ = writeln!(text, "f {a} {b} {c}\nf {a} {c} {d}");
    }
    let pose = Pose::new([0.0; 3], [0.0; 3]);
    let (mesh, _) = plydrape_io::read::mesh::parse("cap.obj", text.as_bytes(), 1.0, &pose, 0.0)
        .expect("a sound mesh");
    Mold::Mesh(Arc::new(mesh))
}

#[divan::bench(args = [100, 300], sample_count = 10)]
fn mesh_along_geodesic(bencher: Bencher, side: usize) {
    let mold = meshed_cap();
    let layup = fine(side);
    bencher.bench(|| Net::drape(black_box(&mold), black_box(layup)));
}

#[divan::bench]
fn place_between_nodes(bencher: Bencher) {
    let mold = sphere(0.6);
    let net = Net::drape(&mold, fine(100)).expect("a sensible layup");
    bencher.bench(|| net.place(black_box(&mold), black_box([0.3217, 0.5432])));
}
