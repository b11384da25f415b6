use super::*;
use crate::Error;
use crate::geometry::vector::{distance, dot, norm};
use crate::mold::{Cylinder, Face, Graph, Mesh, Plane, Pose, Saddle, Sphere, Surface};

fn level() -> Pose {
    Pose::new([0.0; 3], [0.0; 3])
}

fn placement(mold: &Mold, nodes: [usize; 2], mesh: f64, heading: f64) -> Placement {
    Placement {
        nodes,
        mesh: [mesh; 2],
        origin: [0.0; 2],
        seed: nodes.map(|n| n / 2),
        place: mold.highest_point([0.0; 2]).unwrap(),
        heading,
        shear: 0.0,
        generators: Generators::Geodesic,
        edges: EdgeRule::Along,
    }
}

fn plane() -> Mold {
    Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] })
}

/// Unrolled, the boundary of a ply on a cylinder is its outline turned by the heading, hole included: the cylinder keeps all
/// lengths. Between two points the boundary is within a thousandth of the mesh width of their straight line.
#[test]
fn on_a_cylinder_the_boundary_is_the_outline_rolled_up() {
    let (radius, heading) = (0.25, 0.6_f64);
    let mold = Mold::Cylinder(Cylinder { pose: level(), radius, face: Face::Outside });
    let placement = placement(&mold, [33, 25], 0.0125, heading);
    let hole = vec![[0.15, 0.1], [0.25, 0.12], [0.21, 0.2]];
    let around = vec![[0.01, 0.02], [0.39, 0.0], [0.37, 0.3], [0.2, 0.24], [0.02, 0.29]];
    let outline = Outline::new(around, vec![hole]).unwrap();
    let net = Net::drape_cut(&mold, placement, Some(outline.clone())).unwrap();
    let boundary = net.boundary(&mold).unwrap();
    assert_eq!(
        boundary.lines.iter().map(|line| (line.ring, line.closed)).collect::<Vec<_>>(),
        [(0, true), (1, true)]
    );
    let middle = placement.fabric(placement.seed);
    let rolled = |[u, v]: [f64; 2]| {
        let (sin, cos) = heading.sin_cos();
        let (a, b) = (u - middle[0], v - middle[1]);
        let (x, y) = (cos * a - sin * b, sin * a + cos * b);
        let (s, c) = (y / radius).sin_cos();
        [x, radius * s, radius * c]
    };
    for line in &boundary.lines {
        let count = line.points.len();
        assert!(count > 20);
        for n in 0..count {
            let (a, b) = (&line.points[n], &line.points[(n + 1) % count]);
            // cubics between nodes: of fourth order in the mesh width
            assert!(distance(a.place, rolled(a.fabric)) < 5e-8, "{a:?}");
            let middle = rolled([0, 1].map(|c| 0.5 * (a.fabric[c] + b.fabric[c])));
            let chord = [0, 1, 2].map(|c| 0.5 * (a.place[c] + b.place[c]));
            assert!(distance(middle, chord) < 1.1e-3 * 0.0125);
        }
    }
    let flat: f64 = outline.lines().map(|[a, b]| (b[0] - a[0]).hypot(b[1] - a[1])).sum();
    assert!((boundary.length - flat).abs() < 1e-8, "{} {flat}", boundary.length);
    assert_eq!((boundary.off_mold, boundary.folded), (LeftOut::default(), LeftOut::default()));
    assert_eq!(boundary.farthest, None);
    // every corner is a point
    for corner in outline.rings().flatten() {
        let near = |p: &PlyPoint| (p.fabric[0] - corner[0]).hypot(p.fabric[1] - corner[1]) < 1e-12;
        assert!(boundary.lines.iter().flat_map(|line| &line.points).any(near));
    }
}

/// From a seed in the middle of a square on a sphere the middles of its sides are a quarter of the ply's length of arc away.
#[test]
fn on_a_sphere_the_middles_of_the_sides_are_an_arc_away() {
    let radius = 0.5;
    let mold = Mold::Sphere(Sphere { pose: level(), radius, face: Face::Outside });
    let placement = placement(&mold, [41, 41], 0.01, 0.3);
    let net = Net::drape(&mold, placement).unwrap();
    let boundary = net.boundary(&mold).unwrap();
    for uv in [[0.4, 0.2], [0.0, 0.2], [0.2, 0.4], [0.2, 0.0]] {
        let near = |p: &&PlyPoint| (p.fabric[0] - uv[0]).hypot(p.fabric[1] - uv[1]) < 1e-9;
        let point = boundary.lines[0].points.iter().find(near).unwrap();
        let cos = dot(point.place, placement.place) / (radius * radius);
        assert!((radius * cos.acos() - 0.2).abs() < 1e-12);
    }
}

/// A square of 400 mm on a flat mold that ends 150 mm from its middle along x: 50 mm hang over, at one side and half of each
/// neighbor.
#[test]
fn what_hangs_over_a_straight_boundary_is_measured() {
    let saddle = Saddle { radii: [1e9, 1e9] };
    let domain = Some([[-1.0, 0.15], [-1.0, 1.0]]);
    let mold = Mold::Graph(Graph { pose: level(), surface: Surface::Saddle(saddle), domain });
    let net = Net::drape(&mold, placement(&mold, [21, 21], 0.02, 0.0)).unwrap();
    let boundary = net.boundary(&mold).unwrap();
    assert!((boundary.off_mold.length - 0.5).abs() < 1e-7, "{:?}", boundary.off_mold);
    assert!((boundary.length - 1.1).abs() < 1e-7);
    assert!((boundary.off_mold.area - 0.05 * 0.4).abs() < 1e-5 * 0.4, "{:?}", boundary.off_mold);
    let far = boundary.farthest.unwrap();
    assert!((far.beyond - 0.05).abs() < 1e-7 && far.at.fabric[0] == 0.4, "{far:?}");
    let [line] = &boundary.lines[..] else { panic!("{:?}", boundary.lines) };
    assert!(!line.closed);
    let ends = [0, line.points.len() - 1].map(|n| line.points[n].fabric);
    for end in ends {
        assert!((end[0] - 0.35).abs() < 1e-8, "{ends:?}");
    }
}

/// What the net has beside a ply that is cut counts nowhere: a round ply on a bowl has fewer nodes, and less shear than the
/// square around it; what hangs over beside it is not missing.
#[test]
fn only_what_is_on_the_ply_counts() {
    let mold = Mold::Sphere(Sphere {
        pose: Pose::new([0.0, 0.0, 0.3], [0.0; 3]),
        radius: 0.3,
        face: Face::Inside,
    });
    let placement = Placement { place: [0.0; 3], ..placement(&mold, [61, 61], 0.01, 0.2) };
    let round = (0..200).map(|n| {
        let (sin, cos) = (f64::from(n) * std::f64::consts::TAU / 200.0).sin_cos();
        [0.3 + 0.295 * cos, 0.3 + 0.295 * sin]
    });
    let outline = Outline::new(round.collect(), Vec::new()).unwrap();
    let square = Net::drape(&mold, placement).unwrap();
    let net = Net::drape_cut(&mold, placement, Some(outline.clone())).unwrap();
    assert_eq!(net.nodes, square.nodes);
    assert!(!square.missing.is_empty() && net.missing.is_empty(), "{:?}", net.report);
    assert!(net.report.largest_shear.unwrap().0 < 0.7 * square.report.largest_shear.unwrap().0);
    for j in 0..60 {
        for i in 0..60 {
            let share =
                outline.area_in(placement.fabric([i, j]), placement.fabric([i + 1, j + 1])) / 1e-4;
            assert_eq!(net.cell_shear([i, j]).is_some(), share >= 0.5 - 1e-9, "{i} {j} {share}");
        }
    }
}

/// A roof of two slopes that meet at a right angle in the line x = 0, of triangles `step` wide.
fn roof(step: f64) -> Mold {
    let count = (0.6 / step).round() as i32;
    let across = 2 * count + 1;
    let numbers = (0..across * across).map(|n| (n % across - count, n / across - count));
    let vertices = numbers.map(|(i, j)| {
        let (x, y) = (f64::from(i) * step, f64::from(j) * step);
        [x, y, -x.abs()]
    });
    let mut triangles = Vec::new();
    for n in (0..across * (across - 1)).filter(|n| n % across + 1 < across) {
        let [a, b, c, d] = [n, n + 1, n + 1 + across, n + across].map(|n| n as u32);
        triangles.extend([[a, b, c], [a, c, d]]);
    }
    let (mesh, _) = Mesh::of_triangles(vertices.collect(), &triangles).unwrap();
    Mold::Mesh(std::sync::Arc::new(mesh))
}

/// A ply of 300 mm along the ridge of a roof runs over 300 mm of sharp edge, which turns by 90°; one beside it over none, and
/// a mold without triangles cannot tell.
#[test]
fn a_ply_over_a_ridge_crosses_it_by_its_width() {
    let mold = roof(0.02);
    let over = Net::drape(&mold, placement(&mold, [21, 31], 0.01, 0.0)).unwrap();
    let edges = over.sharp_edges(&mold).unwrap();
    assert!((edges.length - 0.3).abs() < 0.004, "{edges:?}");
    let (turn, at) = edges.sharpest.unwrap();
    assert!((turn.to_degrees() - 90.0).abs() < 1e-6 && at.place[0].abs() < 1e-12);
    assert!((at.fabric[0] - 0.1).abs() < 0.005, "{at:?}");
    let place = mold.highest_point([0.3, 0.0]).unwrap();
    let beside = Net::drape(&mold, Placement { place, ..over.placement }).unwrap();
    assert_eq!(beside.sharp_edges(&mold).unwrap().length, 0.0);
    assert_eq!(
        Net::drape(&plane(), placement(&plane(), [21, 31], 0.01, 0.0))
            .unwrap()
            .sharp_edges(&plane()),
        None
    );
}

/// A flat rectangle of 400 mm × 300 mm against one that is 10 mm larger at two sides, 4 mm smaller at one and as large at the
/// last: each error is kept, with its place, and a curve the other way around says the same.
#[test]
fn trim_of_a_flat_rectangle_is_the_distance_of_its_sides() {
    let mold = plane();
    let net = Net::drape(&mold, placement(&mold, [41, 31], 0.01, 0.0)).unwrap();
    let boundary = net.boundary(&mold).unwrap();
    let mut corners =
        [[-0.21, -0.15], [0.196, -0.15], [0.196, 0.16], [-0.21, 0.16]].map(|[x, y]| [x, y, 0.0]);
    for _ in 0..2 {
        let wanted = TargetBoundary::new(&mold, &corners, 0.01).unwrap();
        let trim = boundary.trim(&mold, &wanted).unwrap();
        let (beyond, short) = (trim.beyond.unwrap(), trim.short.unwrap());
        assert!((beyond.error - 0.004).abs() < 1e-12 && (beyond.at.fabric[0] - 0.4).abs() < 1e-12);
        assert!((short.error + 0.01).abs() < 1e-12, "{short:?}");
        assert!((trim.compared - 1.4).abs() < 1e-12 && trim.not_compared == 0.0);
        // sides: 0, 4 mm beyond, 10 mm short twice; near the corners the lower side's error ends the others
        let mean = (0.3 * 0.004 - 0.4 * 0.01 - 0.3 * 0.01) / 1.4;
        assert!((trim.mean - mean).abs() < 3e-4, "{} {mean}", trim.mean);
        // the corner that is larger both ways
        let (place, far) = trim.farthest_wanted;
        assert!((far - 0.01 * 2.0_f64.sqrt()).abs() < 1e-12, "{far}");
        assert!(distance(place, [-0.21, 0.16, 0.0]) < 1e-12);
        corners.reverse();
    }
}

/// A strip of 100 mm around a cylinder over 500 mm of arc, against one that is 6 mm wider on each side and ends 5 mm before
/// and 7 mm behind it: lengths along the cylinder, not chords.
#[test]
fn trim_around_a_cylinder_is_measured_along_it() {
    let radius = 0.2;
    let mold = Mold::Cylinder(Cylinder { pose: level(), radius, face: Face::Outside });
    // u across the axis, over the top
    let net =
        Net::drape(&mold, placement(&mold, [51, 11], 0.01, std::f64::consts::FRAC_PI_2)).unwrap();
    let boundary = net.boundary(&mold).unwrap();
    let point = |arc: f64, x: f64| {
        let (sin, cos) = (arc / radius).sin_cos();
        [x, radius * sin, radius * cos]
    };
    let mut points = Vec::new();
    let (from, to) = (-0.255, 0.243);
    points.extend((0..=20).map(|n| point(from + (to - from) * f64::from(n) / 20.0, 0.056)));
    points.extend((0..=20).rev().map(|n| point(from + (to - from) * f64::from(n) / 20.0, -0.056)));
    let trim = boundary.trim(&mold, &TargetBoundary::new(&mold, &points, 0.01).unwrap()).unwrap();
    let (beyond, short) = (trim.beyond.unwrap(), trim.short.unwrap());
    assert!((beyond.error - 0.007).abs() < 1e-5, "{beyond:?}");
    assert!((beyond.at.fabric[0] - 0.5).abs() < 1e-9);
    assert!((short.error + 0.006).abs() < 1e-5, "{short:?}");
    assert!(
        (trim.farthest_wanted.1 - 0.006_f64.hypot(0.005)).abs() < 1e-4,
        "{:?}",
        trim.farthest_wanted
    );
    // 60 mm short all around: no chord is as long as its arc
    let wide = [
        point(-0.31, -0.11),
        point(0.0, -0.11),
        point(0.31, -0.11),
        point(0.31, 0.11),
        point(0.0, 0.11),
        point(-0.31, 0.11),
    ];
    let trim = boundary.trim(&mold, &TargetBoundary::new(&mold, &wide, 1.0).unwrap()).unwrap();
    assert!(trim.beyond.is_none());
    assert!((trim.short.unwrap().error + 0.06).abs() < 5e-8, "{:?}", trim.short);
}

/// A target boundary that is not on the mold, or none, is refused with its point.
#[test]
fn a_wanted_boundary_lies_on_the_mold() {
    let corners = [[0.0; 3], [0.1, 0.0, 0.0], [0.1, 0.1, 0.02]];
    let refused = TargetBoundary::new(&plane(), &corners, 0.01).unwrap_err();
    assert_eq!(refused, Error::BoundaryOffMold { point: 2, distance: 0.02 });
    assert_eq!(
        TargetBoundary::new(&plane(), &corners[..2], 0.01).unwrap_err(),
        Error::BoundaryTooFew { points: 2 }
    );
    assert!(
        TargetBoundary::new(&plane(), &corners, 0.03)
            .is_ok_and(|wanted| (wanted.distance - 0.02).abs() < 1e-15)
    );
    assert!(norm(corners[0]) == 0.0);
}

/// A ply over the round rim of a bowl: what hangs over is its area less that within the circle of the rim's arc, measured by
/// counting fabric points that lie beyond.
#[test]
fn what_hangs_over_a_round_rim_is_measured() {
    let pose = Pose::new([0.0, 0.0, 0.2], [0.0; 3]);
    let mold = Mold::Sphere(Sphere { pose, radius: 0.2, face: Face::Inside });
    let placement = Placement { place: [0.0; 3], ..placement(&mold, [31, 31], 0.018, 0.2) };
    let net = Net::drape(&mold, placement).unwrap();
    let boundary = net.boundary(&mold).unwrap();
    let (mut off, side) = (0_u32, 400);
    for j in 0..side {
        for i in 0..side {
            let uv = [i, j].map(|n| (f64::from(n) + 0.5) * 0.54 / f64::from(side));
            off += u32::from(net.place(&mold, uv).is_none());
        }
    }
    let counted = f64::from(off) * (0.54 / f64::from(side)).powi(2);
    let area = boundary.off_mold.area + boundary.folded.area;
    // points on a grid count an area to about its boundary times a share of their distance
    assert!((area - counted).abs() < 2e-3 * counted && counted > 0.01, "{area} {counted}");
}
