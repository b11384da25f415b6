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
    let vertex = |[i, j]: [usize; 2]| {
        let (x, y) = (i as f64 / CELLS[0] as f64, j as f64 / CELLS[1] as f64);
        stl_io::Vertex::new([x, y, height(x, y)].map(|x| x as f32))
    };
    let normal = stl_io::Normal::new([0.0, 0.0, 1.0]);
    let mut triangles = Vec::new();
    for i in 0..CELLS[0] {
        for j in 0..CELLS[1] {
            let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(vertex);
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
    plydrape_io::read::mesh::parse("sheet.stl", &FILE, 1.0, &still, 0.0)
        .expect("the sheet is a mold")
        .0
}

static MESH: LazyLock<Mesh> = LazyLock::new(load);

/// Points all over the sheet within `off` (m) of it.
fn points(off: f64) -> impl FnMut() -> [f64; 3] {
    let mut n = 0.0;
    move || {
        n += 1.0;
        let [x, y, z] = [0.819_172_5, 0.671_043_6, 0.549_700_5].map(|step: f64| (n * step).fract());
        [x, y, height(x, y) + off * (2.0 * z - 1.0)]
    }
}

/// Everything from the bytes of the file to a mesh that can be asked.
#[divan::bench(sample_count = 10)]
fn load_200k_triangles(bencher: Bencher) {
    LazyLock::force(&FILE);
    bencher.bench(load);
}

/// A thousand closest points with normal and side, from all over the mesh, that far from it at most (mm).
#[divan::bench(args = [1, 10, 100])]
fn thousand_closest_points_on_200k_triangles(bencher: Bencher, off: u32) {
    LazyLock::force(&MESH);
    let mut next = points(f64::from(off) * 1e-3);
    let points: Vec<_> = (0..1000).map(|_| next()).collect();
    let ask = || points.iter().map(|p| MESH.closest_point(*p).distance).sum::<f64>();
    bencher.bench_local(|| black_box(ask()));
}

/// 0.1 m along the mesh, over some 70 triangles.
#[divan::bench]
fn section_of_100_mm_on_200k_triangles(bencher: Bencher) {
    LazyLock::force(&MESH);
    let next = points(0.0);
    bencher.with_inputs(next).bench_local_values(|[x, y, _]| {
        MESH.section([x, y, height(x, y)], black_box([0.8, 0.6]), 0.1)
    });
}

/// The highest point at a place.
#[divan::bench]
fn highest_point_of_200k_triangles(bencher: Bencher) {
    LazyLock::force(&MESH);
    let next = points(0.0);
    bencher.with_inputs(next).bench_local_values(|[x, y, _]| MESH.highest_point(black_box([x, y])));
}
