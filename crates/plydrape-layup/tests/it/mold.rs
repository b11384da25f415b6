//! Molds of closed form: distances, normals, curvatures, and lines along them, against closed forms.

use plydrape_layup::geometry::vector::{dot, norm, sub};
use plydrape_layup::mold::{
    Cylinder, Face, Graph, Mesh, Mold, Plane, Pose, Saddle, Sphere, Surface, Torus,
};
use proptest::prelude::*;
use proptest::test_runner::{Config, RngSeed};

fn level(position: [f64; 3]) -> Pose {
    Pose::new(position, [0.0; 3])
}

/// One of every kind, turned and moved, as a ply would meet them.
fn molds() -> Vec<(&'static str, Mold)> {
    molds_of_size(1.0)
}

/// The mold, scaled by a factor.
fn molds_of_size(size: f64) -> Vec<(&'static str, Mold)> {
    let pose_at = |place: [f64; 3]| Pose::new(place.map(|c| size * c), [0.15, -0.1, 0.7]);
    let pose = pose_at([0.1, -0.2, 0.05]);
    let saddle = Surface::Saddle(Saddle { radii: [0.6 * size, 0.9 * size] });
    let radius = 0.6 * size;
    // the middle of the tube lies under the places that are tried
    let aside = pose_at([0.9, -0.2, 0.05]);
    let (ring_radius, tube_radius) = (0.85 * size, 0.5 * size);
    vec![
        ("plane", Mold::Plane(Plane { point: [0.0; 3], normal: [-0.28, 0.0, 0.96] })),
        ("cylinder", Mold::Cylinder(Cylinder { pose, radius, face: Face::Outside })),
        ("trough", Mold::Cylinder(Cylinder { pose, radius, face: Face::Inside })),
        ("sphere", Mold::Sphere(Sphere { pose, radius, face: Face::Outside })),
        ("bowl", Mold::Sphere(Sphere { pose, radius, face: Face::Inside })),
        (
            "torus",
            Mold::Torus(Torus { pose: aside, ring_radius, tube_radius, face: Face::Outside }),
        ),
        (
            "channel",
            Mold::Torus(Torus { pose: aside, ring_radius, tube_radius, face: Face::Inside }),
        ),
        ("saddle", Mold::Graph(Graph { pose, surface: saddle, domain: None })),
    ]
}

/// What is tried below is tried on every mold.
#[test]
fn every_mold_lies_under_the_places_that_are_tried() {
    for (name, mold) in molds() {
        for [x, y] in [[0.0, -0.15], [0.2, -0.05], [-0.1, -0.25]] {
            assert!(place(&mold, x, y).is_some(), "{name} at {x}, {y}");
        }
    }
}

/// No tolerance is a length: a mold a million times smaller or larger gives the same answers in its own size. What
/// two sizes are rounded to differs, which Newton's method and steps along a curve may enlarge to 1e-11.
#[test]
fn a_scaled_mold_gives_scaled_answers() {
    let answers = |mold: &Mold, size: f64| {
        let start = mold.highest_point([0.0, -0.15 * size]).expect("the mold is there");
        let off = mold.closest_point([0.1, 0.05, 0.4].map(|c| size * c));
        let line = mold.lay(start, [0.6, 0.8], 0.2 * size);
        let way = mold.path(start, line.end()).expect("a way back").length();
        let lengths = [start, off.point, line.end(), [off.distance, way, 0.0]];
        lengths.map(|p| p.map(|c| c / size))
    };
    let own = molds();
    for size in [1e-6, 1e6] {
        for ((name, mold), (_, scaled)) in own.iter().zip(molds_of_size(size)) {
            let pairs = answers(mold, 1.0).into_iter().zip(answers(&scaled, size));
            let worst = pairs.map(|(a, b)| norm(sub(a, b))).fold(0.0, f64::max);
            assert!(worst < 1e-11, "{name} at {size}: {worst:e}");
        }
    }
}

/// Above a place of the axis of a cylinder of slope tan φ lies its surface at R/cos φ.
#[test]
fn an_inclined_cylinder_is_found_from_above() {
    for tilt in [0.0_f64, 0.5, 1.0, 1.3] {
        let pose = Pose::new([0.3, 0.2, 0.1], [0.0, -tilt, 0.0]);
        let mold = Mold::Cylinder(Cylinder { pose, radius: 0.5, face: Face::Outside });
        let top = mold.highest_point([0.3, 0.2]).expect("a cylinder without ends")[2];
        assert!((top - 0.1 - 0.5 / tilt.cos()).abs() < 1e-12, "{tilt}: {top}");
    }
}

/// A place on the upper side of a mold near (x, y).
fn place(mold: &Mold, x: f64, y: f64) -> Option<[f64; 3]> {
    mold.highest_point([x, y])
}

proptest! {
    #![proptest_config(Config { cases: 200, failure_persistence: None, rng_seed: RngSeed::Fixed(2018), ..Config::default() })]

    /// A point raised off a mold along its normal by less than the radii of curvature has its closest point
    /// where it came from, at the distance it was raised, on either side.
    #[test]
    fn a_point_moved_along_the_normal_has_its_origin_as_closest_point(
        x in -0.25..0.35_f64, y in -0.4..0.1_f64, lift in -0.1..0.1_f64,
    ) {
        for (name, mold) in molds() {
            let Some(p) = place(&mold, x, y) else { continue };
            let closest = mold.closest_point(p);
            prop_assert!(norm(sub(closest.point, p)) < 1e-13, "{name}: {closest:?}");
            let off = [0, 1, 2].map(|n| p[n] + lift * closest.normal[n]);
            let back = mold.closest_point(off);
            prop_assert!((back.distance - lift).abs() < 1e-12, "{name}: {} {lift}", back.distance);
            prop_assert!(norm(sub(back.point, p)) < 1e-11, "{name}: {:?} {p:?}", back.point);
            prop_assert!((norm(back.normal) - 1.0).abs() < 1e-13, "{name}");
        }
    }

    /// The signed distance grows at unit rate along the normal: its gradient is the normal.
    #[test]
    fn the_gradient_of_the_distance_is_the_normal(
        x in -0.25..0.35_f64, y in -0.4..0.1_f64, lift in -0.05..0.15_f64,
    ) {
        for (name, mold) in molds() {
            let Some(p) = place(&mold, x, y) else { continue };
            let p = [p[0], p[1], p[2] + lift];
            let closest = mold.closest_point(p);
            let h = 1e-5;
            for n in 0..3 {
                let distance_at = |s: f64| { let mut q = p; q[n] += s; mold.signed_distance(q) };
                let slope = (distance_at(h) - distance_at(-h)) / (2.0 * h);
                prop_assert!((slope - closest.normal[n]).abs() < 1e-8, "{name}: {slope} {:?}", closest.normal);
            }
        }
    }

    /// How fast the normal turns along any tangent is the curvature along it (Rodrigues, Euler).
    #[test]
    fn curvatures_are_the_turning_of_the_normal(
        x in -0.25..0.35_f64, y in -0.4..0.1_f64, angle in 0.0..6.2_f64,
    ) {
        for (name, mold) in molds() {
            let Some(p) = place(&mold, x, y) else { continue };
            let bend = mold.curvatures(p);
            let [a, b] = bend.directions;
            prop_assert!(bend.principal[0] >= bend.principal[1]);
            prop_assert!(dot(a, b).abs() < 1e-9 && dot(a, mold.normal(p)).abs() < 1e-9, "{name}");
            let t = [0, 1, 2].map(|n| angle.cos() * a[n] + angle.sin() * b[n]);
            let h = 1e-5;
            let normal_at = |s: f64| mold.normal([0, 1, 2].map(|n| p[n] + s * t[n]));
            let turned = dot(sub(normal_at(h), normal_at(-h)), t) / (2.0 * h);
            prop_assert!((turned - bend.along(t)).abs() < 1e-7, "{name}: {turned} {bend:?}");
        }
    }

    /// Fabric that is laid stays on the mold and in its vertical plane, is as long as it was, and the way
    /// back between its ends is the same line.
    #[test]
    fn laid_fabric_stays_on_the_mold_in_its_plane_and_keeps_its_length(
        x in -0.15..0.25_f64, y in -0.3..0.0_f64, angle in 0.0..6.2_f64, length in 0.01..0.15_f64,
    ) {
        let heading = [angle.cos(), angle.sin()];
        for (name, mold) in molds() {
            let Some(p) = place(&mold, x, y) else { continue };
            let line = mold.lay(p, heading, length);
            if line.length() < length {
                // it ends where the mold does
                let [p, q] = [line.points[line.points.len() - 2], line.end()];
                let on = [0, 1, 2].map(|n| q[n] + 1e-4 * (q[n] - p[n]) / norm(sub(q, p)));
                prop_assert!(mold.closest_point(on).beyond, "{name}: {} {length}", line.length());
                continue;
            }
            prop_assert!(line.length() == length, "{name}: {}", line.length());
            let mut chords = 0.0;
            for (n, q) in line.points.iter().enumerate() {
                prop_assert!(mold.signed_distance(*q).abs() < 1e-9, "{name}");
                let aside = -heading[1] * (q[0] - p[0]) + heading[0] * (q[1] - p[1]);
                prop_assert!(aside.abs() < 1e-12, "{name}: {aside}");
                if n > 0 { chords += norm(sub(*q, line.points[n - 1])) }
            }
            // chords over a hundredth of a radian miss 1/240000 of the arc
            prop_assert!((chords - length).abs() < 1e-5 * length, "{name}: {chords} {length}");
            let back = mold.path(p, line.end()).expect("the same line leads there");
            prop_assert!((back.length() - length).abs() < 1e-9, "{name}: {} {length}", back.length());
            let again = mold.lay(line.end(), heading, -length);
            prop_assert!(norm(sub(again.end(), p)) < 1e-9, "{name}: there and back");
        }
    }
}

/// A vertical plane through the center of a sphere, or across a cylinder, cuts a circle: the chord of an
/// arc s is 2R sin(s/2R).
#[test]
fn fabric_laid_over_a_circle_spans_its_chord() {
    let radius = 0.6;
    let pose = level([0.0, 0.0, -radius]);
    let sphere = Mold::Sphere(Sphere { pose, radius, face: Face::Outside });
    let cylinder = Mold::Cylinder(Cylinder { pose, radius, face: Face::Outside });
    let trough =
        Mold::Cylinder(Cylinder { pose: level([0.0, 0.0, radius]), radius, face: Face::Inside });
    for (name, mold) in [("sphere", sphere), ("cylinder", cylinder), ("trough", trough)] {
        for s in [1e-3, 0.05, 0.3, 0.9] {
            let end = mold.lay([0.0; 3], [0.0, 1.0], s).end();
            let chord = 2.0 * radius * (s / (2.0 * radius)).sin();
            assert!((norm(end) - chord).abs() < 1e-10, "{name} {s}: {} {chord}", norm(end));
        }
    }
}

/// Beyond the boundary of a trough and of a bounded saddle there is no mold: the distance is that to the
/// boundary, and fabric that is laid ends there.
#[test]
fn beyond_an_open_boundary_there_is_no_mold() {
    let trough =
        Mold::Cylinder(Cylinder { pose: level([0.0, 0.0, 0.5]), radius: 0.5, face: Face::Inside });
    let closest = trough.closest_point([0.0, 0.3, 0.6]);
    assert!(closest.beyond && (closest.distance - 0.2_f64.hypot(0.1)).abs() < 1e-15, "{closest:?}");
    let line = trough.lay([0.0; 3], [0.0, 1.0], 1.0);
    assert!((line.length() - 0.25 * std::f64::consts::PI).abs() < 1e-6, "{}", line.length());

    let surface = Surface::Saddle(Saddle { radii: [0.5, 0.5] });
    let domain = Some([[-0.1, 0.1], [-0.1, 0.1]]);
    let saddle = Mold::Graph(Graph { pose: level([0.0; 3]), surface, domain });
    let closest = saddle.closest_point([0.15, 0.0, -0.2]);
    assert!(closest.beyond && closest.distance > 0.0, "{closest:?}");
    assert!((closest.point[0] - 0.1).abs() < 1e-15, "{closest:?}");
    assert!(!saddle.closest_point([0.05, 0.05, 0.1]).beyond);
    assert!(saddle.highest_point([0.2, 0.0]).is_none());
    let line = saddle.lay([0.0; 3], [1.0, 0.0], 1.0);
    assert!((line.end()[0] - 0.1).abs() < 1e-6 && line.length() < 0.103, "{:?}", line.end());
}

#[test]
fn a_vertex_that_there_is_not_is_named_with_its_triangle() {
    let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let error = Mesh::of_triangles(vertices, &[[0, 1, 2], [1, 2, 3]]).unwrap_err();
    assert_eq!(error.to_string(), "triangle 2 has vertex 3, and the mesh has 3 vertices");
    assert_eq!(error.remedy(), "number the vertices from 0");
}
