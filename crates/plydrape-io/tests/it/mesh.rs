//! Meshes as molds: closest points, sides, normals, sections and curvatures against brute force and
//! against the surfaces that the meshes approximate.

use plydrape::geometry::vector::{distance, dot, norm, sub};
use plydrape::mold::mesh::{Mesh, MeshReport};
use plydrape::mold::{Pose, SurfaceCurve};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::fmt::Write;

type Point = [f64; 3];

fn unit(a: Point) -> Point {
    a.map(|x| x / norm(a))
}

/// The mesh of some vertices and triangles, by way of an OBJ file that keeps every digit.
fn mesh(vertices: &[Point], triangles: &[[usize; 3]]) -> (Mesh, MeshReport) {
    let mut text = String::new();
    for [x, y, z] in vertices {
        writeln!(text, "v {x:?} {y:?} {z:?}").unwrap();
    }
    for [a, b, c] in triangles {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
    }
    plydrape_io::read::mesh::parse("test.obj", text.as_bytes(), 1.0, &Pose::ORIGIN, 0.0)
        .unwrap_or_else(|e| panic!("{e}"))
}

/// A grid of nx by ny cells over [0, 1] x [0, 1], put where `place` says; diagonals alternate if asked.
fn grid(nx: usize, ny: usize, alternate: bool, place: impl Fn(f64, f64) -> Point) -> Mesh {
    let mut vertices = Vec::new();
    let mut triangles = Vec::new();
    for j in 0..=ny {
        for i in 0..=nx {
            vertices.push(place(i as f64 / nx as f64, j as f64 / ny as f64));
        }
    }
    for j in 0..ny {
        for i in 0..nx {
            let a = j * (nx + 1) + i;
            let (b, c, d) = (a + 1, a + nx + 2, a + nx + 1);
            if alternate && (i + j) % 2 == 1 {
                triangles.extend([[a, b, d], [b, c, d]]);
            } else {
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    mesh(&vertices, &triangles).0
}

/// A sphere of radius 1: an icosahedron whose triangles are cut into k² each.
fn sphere(k: usize) -> Mesh {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut corners = Vec::new();
    for s in [-1.0, 1.0] {
        for t in [-golden, golden] {
            corners.extend([[0.0, s, t], [s, t, 0.0], [t, 0.0, s]]);
        }
    }
    let mut vertices: Vec<Point> = Vec::new();
    let mut triangles = Vec::new();
    let near = |a: Point, b: Point| distance(a, b) < 2.1;
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                let [p, q, r] = [a, b, c].map(|n| corners[n]);
                if !(near(p, q) && near(q, r) && near(r, p)) {
                    continue;
                }
                let first = vertices.len();
                let mut index = HashMap::new();
                for i in 0..=k {
                    for j in 0..=k - i {
                        index.insert((i, j), first + index.len());
                        let [u, v] = [i, j].map(|n| n as f64 / k as f64);
                        vertices.push(unit(
                            [0, 1, 2].map(|n| p[n] + u * (q[n] - p[n]) + v * (r[n] - p[n])),
                        ));
                    }
                }
                for i in 0..k {
                    for j in 0..k - i {
                        triangles.push([(i, j), (i + 1, j), (i, j + 1)].map(|n| index[&n]));
                        if i + j + 1 < k {
                            let upper = [(i + 1, j), (i + 1, j + 1), (i, j + 1)];
                            triangles.push(upper.map(|n| index[&n]));
                        }
                    }
                }
            }
        }
    }
    let (mesh, report) = mesh(&vertices, &triangles);
    assert_eq!((report.triangles, report.closed), (20 * k * k, 1));
    // Euler: V − E + F = 2
    assert_eq!(report.vertices, 10 * k * k + 2);
    mesh
}

fn cube() -> Mesh {
    let vertices: Vec<Point> =
        (0..8).map(|n| [n & 1, n >> 1 & 1, n >> 2].map(|bit| bit as f64)).collect();
    let sides =
        [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
    let triangles: Vec<[usize; 3]> =
        sides.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    mesh(&vertices, &triangles).0
}

/// Points spread evenly over a cube of half width `half`, without a pattern (Roberts' sequence).
fn scatter(count: usize, half: f64) -> impl Iterator<Item = Point> {
    let root: f64 = 1.220_744_084_605_76;
    (1..=count).map(move |n| {
        [1, 2, 3].map(|d| half * (2.0 * (0.5 + n as f64 * root.powi(-d)).fract() - 1.0))
    })
}

/// Distance to a triangle by ternary search over both of its coordinates: slow and independent.
fn by_search([a, b, c]: [Point; 3], p: Point) -> f64 {
    let least = |f: &dyn Fn(f64) -> f64| {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let (s, t) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            if f(s) < f(t) { high = t } else { low = s }
        }
        f(0.5 * (low + high))
    };
    let point = |u: f64, v: f64| [0, 1, 2].map(|n| a[n] + u * (b[n] - a[n] + v * (c[n] - b[n])));
    least(&|u| least(&|v| distance(p, point(u, v))))
}

fn corners(mesh: &Mesh, triangle: usize) -> [Point; 3] {
    mesh.triangles()[triangle].map(|n| mesh.vertices()[n as usize])
}

/// How far a point is off the triangles (m).
fn off(mesh: &Mesh, p: Point) -> f64 {
    mesh.closest_point(p).distance.abs()
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 24, rng_seed: RngSeed::Fixed(7), failure_persistence: None, ..Default::default()
    })]

    /// Loose triangles of any shape, each a surface of its own.
    #[test]
    fn the_closest_point_is_that_of_a_search_over_all_triangles(
        coordinates in prop::collection::vec(-1.0..1.0f64, 9 * 60),
        p in prop::array::uniform3(-2.0..2.0f64),
    ) {
        let vertices: Vec<Point> = coordinates.as_chunks::<3>().0.to_vec();
        let upright = |t: &Vec<Point>| {
            let [u, v] = [sub(t[1], t[0]), sub(t[2], t[0])];
            (u[0] * v[1] - u[1] * v[0]).abs() > 0.05
        };
        let kept: Vec<Point> =
            vertices.chunks(3).map(<[Point]>::to_vec).filter(upright).flatten().collect();
        prop_assume!(!kept.is_empty());
        let triangles: Vec<[usize; 3]> =
            (0..kept.len() / 3).map(|n| [3 * n, 3 * n + 1, 3 * n + 2]).collect();
        let (mesh, _) = mesh(&kept, &triangles);
        let closest = mesh.closest_point(p);
        let expected = kept
            .chunks(3)
            .map(|t| by_search([t[0], t[1], t[2]], p))
            .fold(f64::INFINITY, f64::min);
        // ternary search finds the place of a minimum to half the digits, its value to nearly all
        prop_assert!((closest.distance.abs() - expected).abs() < 1e-9, "{closest:?} {expected}");
        prop_assert!((distance(closest.point, p) - closest.distance.abs()).abs() < 1e-14);
        prop_assert!((norm(closest.normal) - 1.0).abs() < 1e-14);
    }

    /// The distance to a cube in closed form, with points on edges and corners among them.
    #[test]
    fn distances_to_a_cube_have_the_right_sign_and_size(
        p in prop::array::uniform3(prop_oneof![
            -0.5..1.5f64, Just(0.0), Just(1.0), Just(0.5), Just(-0.25), Just(1.0 + 1e-9)
        ]),
    ) {
        let outside = norm(p.map(|x| (x - x.clamp(0.0, 1.0)).abs()));
        let inside = p.iter().map(|x| x.min(1.0 - x)).fold(f64::INFINITY, f64::min);
        let expected = if outside > 0.0 { outside } else { -inside };
        let closest = cube().closest_point(p);
        prop_assert!((closest.distance - expected).abs() < 1e-15, "{p:?} {closest:?} {expected}");
        prop_assert!(!closest.beyond);
    }
}

/// Normals blended between vertices follow a sphere of 5120 triangles.
#[test]
fn normals_of_a_fine_sphere_are_radial_to_half_a_degree() {
    let sphere = sphere(16);
    let mut worst: f64 = 0.0;
    for p in scatter(4000, 1.0) {
        let closest = sphere.closest_point(unit(p));
        worst = worst.max(distance(closest.normal, unit(closest.point)));
    }
    assert!(worst.to_degrees() < 0.5, "{}", worst.to_degrees());
}

/// Between an inscribed mesh and its sphere lies at most the sag of a triangle, e²/3 / 2 for edge e.
#[test]
fn distances_to_a_fine_sphere_are_signed_and_close() {
    let sphere = sphere(16);
    for p in scatter(4000, 1.5) {
        let closest = sphere.closest_point(p);
        let exact = norm(p) - 1.0;
        assert!((closest.distance - exact).abs() < 0.0012, "{p:?} {closest:?}");
        assert!(exact.abs() < 0.0012 || closest.distance.signum() == exact.signum());
    }
}

/// The wedge of a knife: on both sides of its edge the closest point is on the edge itself, and
/// the normal of one face alone would call some of the outside the inside.
#[test]
fn a_point_before_a_sharp_edge_is_outside() {
    let knife = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.05, -1.0], [0.5, -0.05, -1.0]];
    let (mesh, report) = mesh(&knife, &[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]);
    assert_eq!(report.closed, 1);
    for x in [0.1, 0.5, 0.9] {
        for (y, z) in [(0.01, 0.001), (-0.01, 0.001), (0.1, 0.0051), (-0.1, 0.0051)] {
            let closest = mesh.closest_point([x, y, z]);
            assert!((closest.distance - f64::hypot(y, z)).abs() < 1e-15, "{closest:?}");
        }
        assert!(mesh.closest_point([x, 0.0, -0.01]).distance < 0.0);
    }
}

/// Over an open square: above and below it, off its sides, off its corners.
#[test]
fn a_point_to_the_side_of_a_border_is_beyond_the_mold() {
    let square = grid(5, 5, true, |u, v| [u, v, 0.0]);
    for p in scatter(2000, 1.0) {
        let p = [p[0] + 0.5, p[1] + 0.5, p[2]];
        let closest = square.closest_point(p);
        let over = p[..2].iter().all(|x| (0.0..=1.0).contains(x));
        assert_eq!(closest.beyond, !over, "{p:?} {closest:?}");
        let expected = if over {
            p[2]
        } else {
            norm([p[0] - p[0].clamp(0.0, 1.0), p[1] - p[1].clamp(0.0, 1.0), p[2]])
        };
        assert!((closest.distance - expected).abs() < 1e-14, "{p:?} {closest:?}");
    }
    // exactly above the boundary and a corner there still is a mold
    for p in [[0.0, 0.3, 0.2], [1.0, 1.0, -0.2], [0.0, 0.0, 0.1], [0.4, 1.0, 0.0]] {
        let closest = square.closest_point(p);
        assert!(!closest.beyond && (closest.distance - p[2]).abs() < 1e-15, "{closest:?}");
    }
}

/// All points of a curve are on the triangles, and its arc is the sum of its chords.
fn check(mesh: &Mesh, curve: &SurfaceCurve) {
    assert_eq!(curve.points.len(), curve.arc.len());
    assert_eq!(curve.arc[0], 0.0);
    for n in 0..curve.points.len() {
        assert!(off(mesh, curve.points[n]) < 1e-12, "{:?}", curve.points[n]);
        if n > 0 {
            let step = curve.arc[n] - curve.arc[n - 1];
            assert!(step > 0.0, "{step}");
            assert!((step - distance(curve.points[n - 1], curve.points[n])).abs() < 1e-13);
            // the middle of a chord is on the mesh as well: no triangle is skipped
            let middle = [0, 1, 2].map(|c| 0.5 * (curve.points[n - 1][c] + curve.points[n][c]));
            assert!(off(mesh, middle) < 1e-12, "{middle:?}");
        }
    }
}

/// On a tilted plane, meshed and turned in several ways, from a vertex and from elsewhere, along edges,
/// through vertices and across.
#[test]
fn sections_of_a_plane_are_straight_lines_of_exact_length() {
    let mut along_edges = 0;
    for (turn, alternate) in [(0.0, false), (0.0, true), (0.3, true), (PI / 6.0, false)] {
        let (sin, cos) = f64::sin_cos(turn);
        let place = |u: f64, v: f64| {
            let (x, y) = (cos * u - sin * v, sin * u + cos * v);
            [x, y, 0.2 * x - 0.1 * y + 0.4]
        };
        let mesh = grid(8, 8, alternate, place);
        for (u, v) in [(0.5, 0.5), (0.25, 0.5), (0.37, 0.5), (0.4, 0.6), (0.5625, 0.4375)] {
            for degrees in [0.0, 45.0, 90.0, 135.0, 180.0, 225.0, 270.0, 315.0, 17.0, 26.56505] {
                let angle = f64::to_radians(degrees) + turn;
                let heading = [angle.cos(), angle.sin()];
                let from = place(u, v);
                for length in [0.2, -0.2, 1e-5] {
                    let curve = mesh.section(from, heading, length);
                    check(&mesh, &curve);
                    let slope = 0.2 * heading[0] - 0.1 * heading[1];
                    let run = length / slope.hypot(1.0);
                    let end = [
                        from[0] + run * heading[0],
                        from[1] + run * heading[1],
                        from[2] + run * slope,
                    ];
                    let found = curve.end();
                    assert!(distance(found, end) < 1e-12, "{degrees} {from:?} {found:?} {end:?}");
                    assert!((curve.length() - length.abs()).abs() < 1e-15);
                    let back = mesh.section_to(from, end).unwrap();
                    check(&mesh, &back);
                    assert!((back.length() - length.abs()).abs() < 1e-12);
                    along_edges += usize::from(degrees == 0.0);
                }
            }
        }
    }
    assert_eq!(along_edges, 60);
}

/// Along the boundary itself, in both directions, whichever side the mesh is on, and then off its end.
#[test]
fn sections_run_along_a_border_to_its_end() {
    for turn in [0.0f64, 0.5, 1.2, 2.9, -0.7] {
        let (sin, cos) = turn.sin_cos();
        let place = |u: f64, v: f64| [cos * u - sin * v, sin * u + cos * v, 0.3];
        let mesh = grid(4, 4, true, place);
        let about = |[x, y]: [f64; 2]| [cos * x - sin * y, sin * x + cos * y];
        for (start, heading, end) in [
            ([0.1, 0.0], [1.0, 0.0], [1.0, 0.0]),
            ([0.1, 1.0], [1.0, 0.0], [1.0, 1.0]),
            ([0.25, 0.0], [-1.0, 0.0], [0.0, 0.0]),
            ([0.0, 0.0], [0.0, 1.0], [0.0, 1.0]),
            ([1.0, 1.0], [0.0, -1.0], [1.0, 0.0]),
            ([0.0, 0.0], [0.5f64.sqrt(), 0.5f64.sqrt()], [1.0, 1.0]),
            ([0.3, 0.2], [0.0, 1.0], [0.3, 1.0]),
            ([0.3, 0.0], [0.0, -1.0], [0.3, 0.0]),
        ] {
            let curve = mesh.section(place(start[0], start[1]), about(heading), 3.0);
            let expected = f64::hypot(end[0] - start[0], end[1] - start[1]);
            check(&mesh, &curve);
            assert!(distance(curve.end(), place(end[0], end[1])) < 1e-12, "{turn} {start:?}");
            assert!((curve.length() - expected).abs() < 1e-12);
        }
        assert!(mesh.section_to(place(0.5, 0.5), [9.0, 9.0, 0.3]).is_none());
    }
}

/// Along the inner corner of an L the line has mesh on both sides, then on one, then on the other.
#[test]
fn a_section_changes_sides_where_the_border_does() {
    let square = |x: f64, y: f64| {
        [[x, y, 0.0], [x + 1.0, y, 0.0], [x + 1.0, y + 1.0, 0.0], [x, y + 1.0, 0.0]]
    };
    // a row below y = 0 from x = 0 to 2, a row above it from x = 1 to 3
    let squares = [square(0.0, -1.0), square(1.0, -1.0), square(1.0, 0.0), square(2.0, 0.0)];
    let vertices: Vec<Point> = squares.concat();
    let triangles: Vec<[usize; 3]> = (0..4)
        .flat_map(|n| [[4 * n, 4 * n + 1, 4 * n + 2], [4 * n, 4 * n + 2, 4 * n + 3]])
        .collect();
    let (mesh, report) = mesh(&vertices, &triangles);
    assert_eq!((report.surfaces, report.holes.len()), (1, 0));
    for (from, heading) in [([0.25, 0.0, 0.0], 1.0), ([2.75, 0.0, 0.0], -1.0)] {
        let curve = mesh.section(from, [heading, 0.0], 2.5);
        check(&mesh, &curve);
        assert!(distance(curve.end(), [from[0] + 2.5 * heading, 0.0, 0.0]) < 1e-15);
    }
}

/// A quarter of a great circle over the top: the polygon inscribed in it falls short by O(h²).
#[test]
fn sections_over_a_sphere_converge_to_great_circles_as_the_square_of_the_mesh_size() {
    let mut errors = Vec::new();
    for k in [8, 16, 32] {
        let sphere = sphere(k);
        let heading = [0.6, 0.8];
        let point = |angle: f64| {
            let p = [angle.sin() * heading[0], angle.sin() * heading[1], angle.cos()];
            sphere.closest_point(p).point
        };
        // closest points of points in a plane of the circle are in it only about; start where the ray drops
        let [a, b] = [point(-0.7), point(0.7)].map(|p| sphere.highest_point([p[0], p[1]]).unwrap());
        let run = [0, 1].map(|n| b[n] - a[n]);
        let curve = sphere.section_to(a, b).unwrap();
        check(&sphere, &curve);
        assert!(f64::hypot(run[0], run[1]) > 1.2);
        errors.push(1.4 - curve.length());
        // all around, back to the start
        let round = sphere.section([0.0, 0.0, 1.0], heading, 2.0 * PI);
        assert!(distance(round.end(), sphere.highest_point([0.0, 0.0]).unwrap()) < 0.04);
        check(&sphere, &round);
    }
    for pair in errors.windows(2) {
        assert!(pair[0] > 0.0 && (3.0..5.5).contains(&(pair[0] / pair[1])), "{errors:?}");
    }
}

/// A tent: over its ridge, which lies across the line, and along the ridge.
#[test]
fn a_section_goes_over_a_ridge_and_along_it() {
    let tent = grid(4, 6, false, |u, v| [u - 0.5, v, 0.5 - (u - 0.5).abs()]);
    let slope = 2f64.sqrt();
    let curve = tent.section_to([-0.4, 0.31, 0.1], [0.3, 0.31, 0.2]).unwrap();
    check(&tent, &curve);
    assert!((curve.length() - slope * 0.7).abs() < 1e-14);
    let curve = tent.section([0.0, 0.0, 0.5], [0.0, 1.0], 0.9);
    check(&tent, &curve);
    assert!(distance(curve.end(), [0.0, 0.9, 0.5]) < 1e-15);
}

/// R = 1: both curvatures are +1 outside, −1 for a bowl, everywhere within 3 %.
#[test]
fn a_sphere_of_5120_triangles_has_its_curvature_to_three_percent() {
    let sphere = sphere(16);
    for p in scatter(500, 1.0) {
        let found = sphere.curvatures(unit(p));
        for curvature in found.principal {
            assert!((curvature - 1.0).abs() < 0.03, "{p:?} {found:?}");
        }
    }
}

/// A trough of radius 0.5 along y, seen from above: −2 across, 0 along, away from its boundaries.
#[test]
fn a_trough_is_curved_across_and_straight_along() {
    let trough = grid(60, 20, true, |u, v| {
        let angle = (u - 0.5) * 2.0;
        [0.5 * angle.sin(), v, -0.5 * angle.cos()]
    });
    for v in [0.3, 0.51, 0.66] {
        for angle in [-0.5f64, 0.0, 0.33] {
            let found = trough.curvatures([0.5 * angle.sin(), v, -0.5 * angle.cos()]);
            assert!(found.principal[0].abs() < 0.01, "{found:?}");
            assert!((found.principal[1] + 2.0).abs() < 0.02, "{found:?}");
            assert!(found.directions[0][1].abs() > 0.999, "{found:?}");
            for direction in found.directions {
                assert!((norm(direction) - 1.0).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn the_highest_point_is_that_of_the_upper_surface() {
    let sphere = sphere(16);
    for p in scatter(500, 0.7) {
        let [x, y, z] = sphere.highest_point([p[0], p[1]]).unwrap();
        assert_eq!([x, y], [p[0], p[1]]);
        assert!((z - (1.0 - x * x - y * y).max(0.0).sqrt()).abs() < 0.003, "{z}");
        assert!(off(&sphere, [x, y, z]) < 1e-14);
    }
    assert!(sphere.highest_point([0.9, 0.9]).is_none());
    // on vertices, on edges and on the boundary of a grid
    let square = grid(4, 4, false, |u, v| [u, v, u + 2.0 * v]);
    for [x, y] in [[0.0, 0.0], [0.25, 0.5], [0.3, 0.25], [1.0, 1.0], [1.0, 0.1], [0.3, 0.3]] {
        let [_, _, z] = square.highest_point([x, y]).unwrap();
        assert!((z - (x + 2.0 * y)).abs() < 1e-15);
    }
}

/// No place is so odd that a question about it panics.
#[test]
fn odd_questions_get_an_answer() {
    let sphere = sphere(4);
    for x in [f64::NAN, f64::INFINITY, 1e300, -1e160] {
        let _ = sphere.closest_point([x, 0.0, 0.0]);
        let _ = sphere.highest_point([x, 0.0]);
        let _ = sphere.section([x, 0.0, 0.0], [1.0, 0.0], 1.0);
        let _ = sphere.section([0.0, 0.0, 1.0], [1.0, 0.0], x.min(1e3));
        let _ = sphere.section([0.0, 0.0, 1.0], [x, 0.0], 1.0);
        let _ = sphere.section_to([0.0, 0.0, 1.0], [x, 0.0, 1.0]);
        let _ = sphere.curvatures([x, x, x]);
    }
    let _ = sphere.curvatures([0.0; 3]);
    assert!(sphere.section_to([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]).is_none());
}

/// Every edge of a closed mesh is run along once in either direction.
#[test]
fn neighbors_run_along_their_edge_in_opposite_directions() {
    let sphere = sphere(4);
    let edges = sphere.triangles().iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
    let edges: Vec<[u32; 2]> = edges.collect();
    for [a, b] in &edges {
        assert_eq!(edges.iter().filter(|edge| **edge == [*b, *a]).count(), 1);
        assert_eq!(edges.iter().filter(|edge| **edge == [*a, *b]).count(), 1);
    }
    for t in 0..sphere.triangles().len() {
        let [a, b, c] = corners(&sphere, t);
        let (u, v) = (sub(b, a), sub(c, a));
        let normal =
            [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        assert!(dot(normal, a) > 0.0);
    }
}
