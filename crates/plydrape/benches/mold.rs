//! How long a mold of 200 000 triangles takes: to load, and to be asked.
//!
//! The mold is a wavy sheet of 1 m by 1 m, in a binary STL file in memory.

use divan::{Bencher, black_box};
use plydrape::mold::Pose;
use plydrape::mold::mesh::Mesh;
use std::sync::LazyLock;

fn main() {
    divan::main();
}

/// Cells of the sheet along x and along y: 2 · 500 · 200 triangles.
const CELLS: [usize; 2] = [500, 200];

fn height(x: f64, y: f64) -> f64 {
    0.05 * (9.0 * x).sin() * (7.0 * y).cos()
}

/// The sheet as a binary STL file.
static FILE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let at = |i: usize, j: usize| {
        let (x, y) = (i as f64 / CELLS[0] as f64, j as f64 / CELLS[1] as f64);
        stl_io::Vertex::new([x, y, height(x, y)].map(|x| x as f32))
    };
    let normal = stl_io::Normal::new([0.0, 0.0, 1.0]);
    let mut triangles = Vec::new();
    for i in 0..CELLS[0] {
        for j in 0..CELLS[1] {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.push(stl_io::Triangle { normal, vertices: [a, b, c] });
            triangles.push(stl_io::Triangle { normal, vertices: [a, c, d] });
        }
    }
    let mut bytes = Vec::new();
    stl_io::write_stl(&mut bytes, triangles.iter()).expect("memory can be written");
    bytes
});

fn load() -> Mesh {
    let still = Pose::new([0.0; 3], [0.0; 3]);
    Mesh::parse("sheet.stl", &FILE, 1.0, &still).expect("the sheet is a mold").0
}

static MESH: LazyLock<Mesh> = LazyLock::new(load);

/// How many places are asked for in one sample.
const PLACES: usize = 1000;

/// Points along a line that winds over the sheet, as the points of a ply do, within `off` (m) of it.
fn points(off: f64) -> Vec<[f64; 3]> {
    let at = |n: usize| {
        let x = (n as f64 / PLACES as f64 * 30.0).fract();
        let y = n as f64 / PLACES as f64;
        [x, y, height(x, y) + off * (2.0 * (n as f64 * 0.618_034).fract() - 1.0)]
    };
    (0..PLACES).map(at).collect()
}

/// Everything from the bytes of the file to a mesh that can be asked.
#[divan::bench(sample_count = 20)]
fn load_200k_triangles(bencher: Bencher) {
    LazyLock::force(&FILE);
    bencher.bench(load);
}

/// 1000 closest points with normal and side, from points that far from the mesh at most (mm).
#[divan::bench(args = [1, 10, 100])]
fn feet_on_200k_triangles_1000(bencher: Bencher, off: u32) {
    let points = points(f64::from(off) * 1e-3);
    LazyLock::force(&MESH);
    bencher.bench(|| points.iter().map(|p| MESH.foot(black_box(*p)).distance).sum::<f64>());
}

/// 1000 lines of 0.1 m along the mesh, each over some 70 triangles.
#[divan::bench]
fn sections_of_100_mm_on_200k_triangles_1000(bencher: Bencher) {
    let points = points(0.0);
    LazyLock::force(&MESH);
    let line = |p: &[f64; 3]| MESH.section(*p, black_box([0.8, 0.6]), 0.1).length();
    bencher.bench(|| points.iter().map(line).sum::<f64>());
}

/// 1000 highest points.
#[divan::bench]
fn drops_on_200k_triangles_1000(bencher: Bencher) {
    let points = points(0.0);
    LazyLock::force(&MESH);
    bencher.bench(|| points.iter().filter_map(|p| MESH.drop_to(black_box([p[0], p[1]]))).count());
}
