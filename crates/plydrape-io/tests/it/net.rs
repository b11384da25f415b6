//! The ideal drape against closed forms, printed figures, invariants and an independent solver.

use crate::common::{distance, meshed};
use plydrape::LayupError;
use plydrape::geometry::vector::dot;
use plydrape::mold::{Cylinder, Face, Graph, Mold, Plane, Pose, Saddle, Sphere, Surface, Torus};
use plydrape::net::{EdgeRule, Generators, Net, Placement, Reason};

const BOTH_GENERATORS: [Generators; 2] = [Generators::Geodesic, Generators::LeastShear];
const BOTH_RULES: [EdgeRule; 2] = [EdgeRule::Along, EdgeRule::Chord];

fn sphere(radius: f64) -> Mold {
    Mold::Sphere(Sphere { pose: Pose::ORIGIN, radius, face: Face::Outside })
}

fn torus(pose: Pose, ring_radius: f64, tube_radius: f64) -> Mold {
    Mold::Torus(Torus { pose, ring_radius, tube_radius, face: Face::Outside })
}

/// A net of 24 × 24 nodes, mesh 0.075 m, as in the published example.
fn published() -> Placement {
    let d: f64 = 0.075;
    Placement {
        nodes: [24, 24],
        mesh: [d, d],
        origin: [0.0; 2],
        seed: [11, 11],
        place: [-d / 2.0, -d / 2.0, (1.0 - d * d / 2.0).sqrt()],
        heading: 0.0,
        shear: 0.0,
        generators: Generators::LeastShear,
        edges: EdgeRule::Chord,
    }
}

/// A net of n × n nodes with meshes of a width d, whose middle node is the seed.
fn centered(n: usize, d: f64, place: [f64; 3]) -> Placement {
    Placement { nodes: [n; 2], mesh: [d; 2], seed: [n / 2; 2], place, ..published() }
}

fn drape(mold: &Mold, layup: Placement) -> Net {
    Net::drape(mold, layup).expect("a sensible layup")
}

/// Nodes with their grid indices.
fn nodes(net: &Net) -> impl Iterator<Item = ([usize; 2], [f64; 3])> + '_ {
    let nu = net.placement.nodes[0];
    net.nodes.iter().enumerate().filter_map(move |(n, p)| Some(([n % nu, n / nu], (*p)?)))
}

/// KinDrape on the analytic hemisphere: 38.005° and 10.533°, and the corner node, from benches/peers/net.py.
#[test]
fn hemisphere_has_the_published_shear() {
    let net = drape(&sphere(1.0), published());
    let (largest, cell) = net.report.largest_shear.expect("all cells");
    assert!((largest.to_degrees() - 38.005).abs() < 0.001, "{}", largest.to_degrees());
    assert!((net.report.mean_shear.to_degrees() - 10.5334).abs() < 0.0002);
    assert!([0, 22].contains(&cell[0]) && [0, 22].contains(&cell[1]));
    assert!(net.missing.is_empty() && net.report.placed == 576);
    // the peer's own bars are right to 2e-9, its generators' directions to about 1e-7
    let corner = net.node([0, 0]).expect("placed");
    assert!(distance(corner, [-0.690_243_3, -0.690_243_3, 0.217_090_7]) < 1e-6, "{corner:?}");
}

#[test]
fn every_edge_has_its_length_and_every_node_lies_on_the_mold() {
    let saddle = Mold::Graph(Graph {
        pose: Pose::ORIGIN,
        surface: Surface::Saddle(Saddle { radii: [1.2, 0.9] }),
        domain: None,
    });
    let torus = torus(Pose::ORIGIN, 2.0, 1.1);
    for (mold, start) in [(sphere(1.0), [0.03, -0.02]), (saddle, [0.1, 0.05]), (torus, [2.2, 0.1])]
    {
        for generators in BOTH_GENERATORS {
            for edges in BOTH_RULES {
                let place = mold.highest_point(start).expect("mold below");
                let mesh = [0.05, 0.04];
                let layup = Placement {
                    generators,
                    edges,
                    place,
                    mesh,
                    heading: 0.4,
                    shear: 0.1,
                    ..published()
                };
                let net = drape(&mold, layup);
                assert_eq!(net.report.placed, 576, "{generators:?} {edges:?} {:?}", net.report);
                assert!(net.report.largest_edge_error < 1e-13, "{}", net.report.largest_edge_error);
                for (_, p) in nodes(&net) {
                    assert!(mold.signed_distance(p).abs() < 1e-13);
                }
            }
        }
    }
}

#[test]
fn net_on_a_plane_is_affine() {
    let normal = [0.3, -0.2, 1.0].map(|x: f64| x / (1.13_f64).sqrt());
    let mold = Mold::Plane(Plane { point: [0.1, 0.2, 0.3], normal });
    for generators in BOTH_GENERATORS {
        for edges in BOTH_RULES {
            for (heading, shear) in [(0.0, 0.0), (2.1, 20.0_f64.to_radians()), (-0.8, -0.9)] {
                let layup = Placement {
                    nodes: [12, 9],
                    mesh: [0.03, 0.02],
                    seed: [11, 3],
                    place: mold.highest_point([0.5, -0.4]).expect("a plane is everywhere"),
                    heading,
                    shear,
                    generators,
                    edges,
                    ..published()
                };
                let net = drape(&mold, layup);
                let (sin, cos) = f64::sin_cos(heading);
                let rise = -(normal[0] * cos + normal[1] * sin) / normal[2];
                let u = [cos, sin, rise].map(|x| x / rise.hypot(1.0));
                let left = [
                    normal[1] * u[2] - normal[2] * u[1],
                    normal[2] * u[0] - normal[0] * u[2],
                    normal[0] * u[1] - normal[1] * u[0],
                ];
                let v = [0, 1, 2].map(|n| shear.cos() * left[n] + shear.sin() * u[n]);
                let flat = |p: f64, q: f64| {
                    let (p, q) = (p - 11.0 * 0.03, q - 3.0 * 0.02);
                    [0, 1, 2].map(|n| layup.place[n] + p * u[n] + q * v[n])
                };
                assert_eq!(net.report.placed, 108);
                for ([i, j], p) in nodes(&net) {
                    assert!(distance(p, flat(0.03 * i as f64, 0.02 * j as f64)) < 1e-12);
                }
                let between = net.place(&mold, [0.1234, 0.0567]).expect("within the ply");
                assert!(distance(between, flat(0.1234, 0.0567)) < 1e-12);
                let fibers = net.fibers(&mold, [0.001, 0.159]).expect("within the ply");
                assert!(distance(fibers[0], u) < 1e-11 && distance(fibers[1], v) < 1e-11);
                for cell in &net.shear {
                    assert!((cell.expect("whole").angle - shear).abs() < 1e-11);
                }
            }
        }
    }
}

/// A cylinder can be developed: the net on it is the flat one. Edges are measured exactly there, so only
/// rounding is left, some 1e-15 a node over 30 nodes.
#[test]
fn net_on_a_cylinder_is_the_flat_one() {
    let radius = 0.6;
    let pose = Pose::new([0.2, -0.1, 0.4], [0.0, 0.25, 0.9]);
    let mold = Mold::Cylinder(Cylinder { pose, radius, face: Face::Outside });
    for generators in BOTH_GENERATORS {
        for (heading, shear) in [(0.9, 0.0), (1.7, 0.0), (0.3, 0.3), (-2.0, -0.2)] {
            let layup = Placement {
                nodes: [30, 20],
                mesh: [0.02, 0.03],
                origin: [0.0; 2],
                seed: [4, 13],
                place: mold.highest_point([0.25, 0.0]).expect("mold below"),
                heading,
                shear,
                generators,
                edges: EdgeRule::Along,
            };
            let net = drape(&mold, layup);
            let developed = |p: [f64; 3]| {
                let [x, y, z] = pose.local(p);
                [x, radius * y.atan2(z)]
            };
            let node = |n: [usize; 2]| developed(net.node(n).expect("placed"));
            let [o, u, v] = [node([4, 13]), node([5, 13]), node([4, 14])];
            let side = |p: [f64; 2]| [0, 1].map(|n| p[n] - o[n]);
            let (u, v) = (side(u), side(v));
            assert!((u[0].hypot(u[1]) - 0.02).abs() < 1e-14);
            assert!((v[0].hypot(v[1]) - 0.03).abs() < 1e-14);
            let sine = (u[0] * v[0] + u[1] * v[1]) / (0.02 * 0.03);
            assert!((sine - shear.sin()).abs() < 1e-11, "{sine}");
            for ([i, j], p) in nodes(&net) {
                let (a, b) = (i as f64 - 4.0, j as f64 - 13.0);
                let flat = [0, 1].map(|n| o[n] + a * u[n] + b * v[n]);
                let found = developed(p);
                assert!((0..2).all(|n| (found[n] - flat[n]).abs() < 1e-12), "{generators:?}");
            }
            assert_eq!(net.report.placed, 600);
        }
    }
}

#[test]
fn hemisphere_net_is_its_own_mirror_image() {
    for generators in BOTH_GENERATORS {
        let d = 0.075;
        let odd = Placement {
            nodes: [23, 23],
            place: [0.0, 0.0, 1.0],
            edges: EdgeRule::Along,
            ..published()
        };
        let even = Placement { generators: Generators::LeastShear, ..published() };
        let layup =
            if generators == Generators::Geodesic { Placement { generators, ..odd } } else { even };
        let net = drape(&sphere(1.0), layup);
        let [nu, nv] = layup.nodes;
        for ([i, j], [x, y, z]) in nodes(&net) {
            let twin = |n| net.node(n).expect("placed");
            assert!(distance(twin([nu - 1 - i, j]), [-x, y, z]) < 1e-10 * d);
            assert!(distance(twin([i, nv - 1 - j]), [x, -y, z]) < 1e-10 * d);
            assert!(distance(twin([j, i]), [y, x, z]) < 1e-10 * d);
        }
    }
}

#[test]
fn geodesic_generators_of_a_sphere_are_great_circles() {
    let mold = sphere(0.8);
    for edges in BOTH_RULES {
        let layup = Placement {
            place: mold.highest_point([0.2, -0.3]).expect("mold below"),
            heading: 0.7,
            generators: Generators::Geodesic,
            edges,
            ..published()
        };
        let net = drape(&mold, layup);
        let node = |n: [usize; 2]| net.node(n).expect("placed");
        // two nodes span the circle's plane; each node is one arc further
        let arc = match edges {
            EdgeRule::Along => 0.075 / 0.8,
            EdgeRule::Chord => 2.0 * (0.075_f64 / 1.6).asin(),
        };
        for n in 0..24 {
            for p in [node([n, 11]), node([11, n])] {
                let turned = arc * (n as f64 - 11.0);
                assert!((dot(p, node([11, 11])) / 0.64 - turned.cos()).abs() < 1e-13);
            }
            let [a, b] = [node([11, 11]), node([12, 11])];
            let across =
                [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            assert!(dot(across, node([n, 11])).abs() < 1e-14);
        }
    }
}

/// A net on a sphere of radius 0.6 m over a ply of 0.4 × 0.4 m, and places spread over it.
fn refined(cells: usize, generators: Generators) -> Vec<[f64; 3]> {
    let mold = sphere(0.6);
    let d = 0.4 / cells as f64;
    let layup = Placement {
        heading: 0.3,
        shear: 0.1,
        generators,
        edges: EdgeRule::Along,
        ..centered(cells + 1, d, [0.0, 0.0, 0.6])
    };
    let net = drape(&mold, layup);
    let spread = |n: usize, by: f64| 0.4 * (n as f64 * by).fract();
    (0..50)
        .map(|n| net.place(&mold, [spread(n, 0.618), spread(n, 0.414)]).expect("within the ply"))
        .collect()
}

fn farthest(a: &[[f64; 3]], b: &[[f64; 3]]) -> f64 {
    a.iter().zip(b).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max)
}

/// The second order of the net's edges; 10 mm on a radius of 0.6 m is well below 1 µm.
#[test]
fn places_converge_with_the_square_of_the_mesh_width() {
    let finest = refined(320, Generators::Geodesic);
    let errors = [20, 40, 80].map(|cells| farthest(&refined(cells, Generators::Geodesic), &finest));
    assert!(errors[1] < 4e-7, "{errors:?}");
    assert!(errors[0] > 3.8 * errors[1] && errors[1] > 3.8 * errors[2], "{errors:?}");
}

/// A line along which the shear does not change is straight. The cells that keep their shear lie half a
/// mesh width beside the seed, hence the first order.
#[test]
fn least_shear_generators_tend_to_geodesics() {
    let limit = refined(320, Generators::Geodesic);
    let errors =
        [20, 40, 80].map(|cells| farthest(&refined(cells, Generators::LeastShear), &limit));
    for (coarse, fine) in [(errors[0], errors[1]), (errors[1], errors[2])] {
        assert!((1.8..2.2).contains(&(coarse / fine)), "{errors:?}");
    }
}

#[test]
fn net_moves_with_its_mold() {
    let moved = Pose::new([0.3, -0.7, 0.2], [0.0, 0.0, 1.1]);
    let [here, there] = [Pose::ORIGIN, moved].map(|pose| torus(pose, 0.9, 0.5));
    for generators in BOTH_GENERATORS {
        for edges in BOTH_RULES {
            let place = here.highest_point([0.8, 0.5]).expect("mold below");
            let layup = Placement {
                place,
                heading: 0.2,
                mesh: [0.03, 0.035],
                generators,
                edges,
                ..published()
            };
            let turned = Placement { place: moved.place(place), heading: 1.3, ..layup };
            let (a, b) = (drape(&here, layup), drape(&there, turned));
            assert_eq!(a.report.placed, b.report.placed);
            for (n, p) in nodes(&a) {
                assert!(distance(moved.place(p), b.node(n).expect("placed")) < 1e-11);
            }
        }
    }
}

/// Hazzidakis: with straight generators the shear at a corner is the total curvature ∬K dA of the fabric
/// between it and the seed. K of a torus is cos θ/(r(R + r cos θ)).
#[test]
fn shear_on_a_torus_is_its_total_curvature() {
    let (ring, tube) = (0.9, 0.5);
    let mold = torus(Pose::ORIGIN, ring, tube);
    let misses = [20_usize, 40].map(|cells| {
        let d = 0.5 / cells as f64;
        let layup = Placement {
            nodes: [cells + 1; 2],
            mesh: [d, d],
            seed: [0, 0],
            place: mold.highest_point([0.9, 0.2]).expect("mold below"),
            heading: 0.2,
            generators: Generators::Geodesic,
            edges: EdgeRule::Along,
            ..published()
        };
        let net = drape(&mold, layup);
        let mut total = 0.0;
        for j in 0..cells {
            for i in 0..cells {
                let ring4 = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]]
                    .map(|n| net.node(n).expect("placed"));
                let [x, y, z] = [0, 1, 2].map(|n| ring4.iter().map(|p| p[n]).sum::<f64>() / 4.0);
                let out = x.hypot(y) - ring;
                let cosine = out / out.hypot(z);
                let gauss = cosine / (tube * (ring + tube * cosine));
                let cell = net.cell_shear([i, j]).expect("whole");
                // the last cell's middle is half a cell before its corner
                let share = |k: usize| if k + 1 == cells { 0.5 } else { 1.0 };
                total += share(i) * share(j) * gauss * d * d * cell.angle.cos();
            }
        }
        let shear = net.cell_shear([cells - 1; 2]).expect("whole").angle;
        assert!(shear.abs() > 0.1);
        (shear - total).abs()
    });
    assert!(misses[1] < 1e-4 && misses[0] > 3.0 * misses[1], "{misses:?}");
}

/// A saddle of 0.6 × 0.4 m under a ply of 0.8 × 0.8 m.
#[test]
fn nodes_beyond_the_border_are_named() {
    let mold = Mold::Graph(Graph {
        pose: Pose::ORIGIN,
        surface: Surface::Saddle(Saddle { radii: [1.5, 1.5] }),
        domain: Some([[-0.3, 0.3], [-0.2, 0.2]]),
    });
    for generators in BOTH_GENERATORS {
        let edges = EdgeRule::Along;
        let layup = Placement { generators, edges, ..centered(21, 0.04, [0.0; 3]) };
        let net = drape(&mold, layup);
        assert_eq!((net.report.folded, net.report.unreached), (0, 0));
        assert_eq!(net.report.off_mold + net.report.placed, 441);
        let first = &net.report.first[0];
        // along x five meshes of 40 mm take less than 0.2 m in plan, along y too
        assert_eq!(first.reason, Reason::OffMold);
        assert_eq!(first.node[0].abs_diff(10) + first.node[1].abs_diff(10), 6);
        assert!(first.to_string().contains("beyond the boundary of the mold"), "{first}");
        for ([i, j], p) in nodes(&net) {
            assert!(p[0].abs() <= 0.3 + 1e-12 && p[1].abs() <= 0.2 + 1e-12, "{i} {j} {p:?}");
        }
        for missing in &net.missing {
            let p = missing.near.expect("it was looked for");
            assert!(p[0].abs() > 0.3 || p[1].abs() > 0.2, "{missing}");
            // on the tangent plane of the boundary
            let boundary = mold.closest_point(p);
            let beyond = missing.beyond.expect("beyond the boundary");
            assert!(beyond > 0.0 && (beyond - distance(p, boundary.point)).abs() < 1e-12);
            let side = [0, 1, 2].map(|n| p[n] - boundary.point[n]);
            assert!(dot(side, boundary.normal).abs() < 1e-12, "{missing}");
        }
        assert_eq!(net.place(&mold, [0.0, 0.0]), None);
        assert!(net.place(&mold, [0.4, 0.4]).is_some() && net.place(&mold, [0.81, 0.4]).is_none());
    }
}

/// Shear γ of the limit of ever finer meshes on the unit sphere, at a quarter of the mesh width: straight
/// generators have none, and ∂²γ/∂u∂v = cos γ.
fn sine_gordon(cells: usize, mesh: f64) -> Vec<Vec<f64>> {
    let (fine, h) = (4 * cells, mesh / 4.0);
    let mut shear = vec![vec![0.0; fine + 1]; fine + 1];
    for j in 0..fine {
        for i in 0..fine {
            let (a, b, c) = (shear[j][i], shear[j][i + 1], shear[j + 1][i]);
            let middle = 0.5 * (b + c);
            shear[j + 1][i + 1] = b + c - a + h * h * f64::cos(middle);
        }
    }
    shear
}

#[test]
fn shear_on_a_sphere_obeys_its_equation_and_folds_where_cells_shut() {
    for edges in BOTH_RULES {
        let generators = Generators::Geodesic;
        let layup = Placement { generators, edges, ..centered(51, 0.06, [0.0, 0.0, 1.0]) };
        let net = drape(&sphere(1.0), layup);
        let limit = sine_gordon(25, 0.06);
        let mut worst = 0.0_f64;
        for j in 0..25 {
            for i in 0..25 {
                // the quadrant along u and v has positive shear
                if let Some(shear) = net.cell_shear([25 + i, 25 + j]) {
                    worst = worst.max((shear.angle - limit[4 * j + 2][4 * i + 2]).abs());
                }
            }
        }
        // bars lie lower by half the angle they span, which shows in the corners of cells that are nearly shut
        let tolerance = if edges == EdgeRule::Along { 5e-4 } else { 0.03 };
        assert!(worst < tolerance, "{edges:?} {worst}");

        assert!(net.report.folded > 0 && net.report.unreached > 0 && net.report.off_mold == 0);
        assert!(net.report.largest_edge_error < 1e-12);
        for missing in &net.missing {
            let [i, j] = missing.node;
            let shear = limit[4 * j.abs_diff(25)][4 * i.abs_diff(25)].to_degrees();
            assert!(shear > 88.0, "{missing} {shear}");
            // what lies behind a fold is all that is unreached
            let toward = |n: usize| if n > 25 { n - 1 } else { n + 1 };
            let hung_on = [[toward(i), j], [i, toward(j)], [toward(i), toward(j)]];
            let hangs = hung_on.iter().any(|n| net.node(*n).is_none());
            assert_eq!(hangs, missing.reason == Reason::Unreached, "{missing}");
        }
        let first = net.report.first[0].to_string();
        assert!(first.contains("shuts: the ply folds, at ("), "{first}");
    }
}

/// A sphere's cap of 1 × 1 m of arc, its vertices on the sphere.
fn meshed_cap(radius: f64, n: usize) -> Mold {
    let on_sphere = |shares: [f64; 2]| {
        let [x, y] = shares.map(|share| share - 0.5);
        let angle = x.hypot(y) / radius;
        let out = radius * angle.sin() / x.hypot(y).max(1e-300);
        [out * x, out * y, radius * angle.cos()]
    };
    meshed(n, on_sphere, |_, _| true)
}

/// Facets of length a lie a²/8R inside the sphere: the nets differ by that order, and Newton's method
/// gets over the facets' kinks.
#[test]
fn net_on_a_mesh_of_a_sphere_tends_to_that_on_the_sphere() {
    let radius = 0.6;
    for generators in BOTH_GENERATORS {
        for edges in BOTH_RULES {
            let away = [20, 40, 80].map(|n| {
                let mold = meshed_cap(radius, n);
                let place = mold.highest_point([0.0123, -0.0071]).expect("mold below");
                let central = centered(41, 0.015, place);
                let layup = Placement { heading: 0.3, generators, edges, ..central };
                let net = drape(&mold, layup);
                assert_eq!(net.report.placed, 1681, "{:?}", net.report);
                assert!(net.report.largest_edge_error < 1e-12, "{:?}", net.report);
                assert!(nodes(&net).all(|(_, p)| mold.signed_distance(p).abs() < 1e-12));
                let smooth = sphere(radius);
                let ideal = drape(
                    &smooth,
                    Placement { place: smooth.closest_point(layup.place).point, ..layup },
                );
                nodes(&net)
                    .map(|(n, p)| distance(p, ideal.node(n).expect("placed")))
                    .fold(0.0, f64::max)
            });
            assert!(away[2] < 1e-4 && away[0] > 8.0 * away[2], "{away:?}");
        }
    }
}

#[test]
fn a_ply_larger_than_its_mesh_leaves_it_at_the_border() {
    let mold = meshed_cap(0.6, 40);
    let central = centered(31, 0.04, mold.highest_point([0.0, 0.0]).expect("mold below"));
    let layup = Placement { generators: Generators::Geodesic, edges: EdgeRule::Along, ..central };
    let net = drape(&mold, layup);
    // half a meter of arc holds twelve meshes of 40 mm on the generators
    for n in 0..31_usize {
        let held = n.abs_diff(15) <= 12;
        assert_eq!(net.node([n, 15]).is_some(), held, "{n}");
        assert_eq!(net.node([15, n]).is_some(), held, "{n}");
    }
    let off = net.report.first.iter().find(|m| m.reason == Reason::OffMold).expect("some are off");
    assert!(off.beyond.is_some_and(|far| far < 0.04), "{off}");
}

/// A flat mold with a hole of 0.2 × 0.2 m: what lies behind the hole lies as if there were none.
#[test]
fn a_ply_goes_on_behind_a_hole() {
    let in_hole = |i: usize, j: usize| (12..16).contains(&i) && (10..14).contains(&j);
    let slope = |shares: [f64; 2]| {
        let [x, y] = shares.map(|share| share - 0.5);
        [x, y, 0.25 * x]
    };
    let mold = meshed(20, slope, |i, j| !in_hole(i, j));
    for generators in BOTH_GENERATORS {
        let central = centered(21, 0.04, [0.01, -0.02, 0.0025]);
        let layup = Placement { generators, edges: EdgeRule::Along, ..central };
        let net = drape(&mold, layup);
        assert_eq!((net.report.folded, net.report.unreached), (0, 0));
        let run = 0.04 / 0.25_f64.hypot(1.0);
        for j in 0..21_usize {
            for i in 0..21_usize {
                let (x, y) = (0.01 + run * (i as f64 - 10.0), -0.02 + 0.04 * (j as f64 - 10.0));
                let off = x > 0.1 && x < 0.3 && y > 0.0 && y < 0.2;
                match net.node([i, j]) {
                    Some(p) => assert!(!off && distance(p, [x, y, 0.25 * x]) < 1e-12, "{i} {j}"),
                    None => assert!(off, "{i} {j}"),
                }
            }
        }
    }
}

#[test]
fn layups_that_cannot_begin_say_why() {
    let mold = sphere(1.0);
    let refused = |layup: Placement| Net::drape(&mold, layup).expect_err("refused");
    let good = published();
    assert!(matches!(refused(Placement { nodes: [0, 4], ..good }), LayupError::NetNoNodes { .. }));
    assert!(matches!(
        refused(Placement { mesh: [0.1, 0.0], ..good }),
        LayupError::NetMeshWidth { .. }
    ));
    assert!(matches!(refused(Placement { seed: [24, 0], ..good }), LayupError::NetSeedNode { .. }));
    assert!(matches!(refused(Placement { shear: 1.56, ..good }), LayupError::NetShear { .. }));
    let aside = Placement { place: [0.0, 0.0, 1.002], ..good };
    let words = refused(aside).to_string();
    assert_eq!(words, "the seed lies 2.000 mm off the mold: give a point of the mold");
    assert_eq!(refused(Placement { place: [1.0, 0.0, 0.0], ..good }), LayupError::NetUpright);
}

/// A ply of one yarn, or of one point, has places and no cells.
#[test]
fn a_single_line_of_nodes_is_a_net() {
    for nodes in [[7, 1], [1, 7], [1, 1]] {
        let layup = Placement { nodes, seed: [0, 0], ..published() };
        let net = drape(&sphere(1.0), layup);
        assert_eq!(net.report.placed, nodes[0] * nodes[1]);
        assert_eq!(net.report.largest_shear, None);
        let seed = net.place(&sphere(1.0), [0.0, 0.0]).expect("the seed");
        assert!(distance(seed, layup.place) < 1e-15, "{seed:?}");
    }
}
