//! Pictures of nets. They stay in the `tmp` folder of the build's target for a look.

use plydrape::mold::{Face, Graph, Mold, Plane, Pose, Saddle, Sphere, Surface};
use plydrape::net::{EdgeRule, Generators, Net, Placement};
use plydrape_io::write::figure;
use plydrape_io::write::net::{Findings, write_all};
use std::path::Path;

/// The map says what the net reports; same net, same bytes; even a fine net stays a page's size.
#[test]
fn a_shear_map_says_what_its_net_reports() {
    let ball = |face| Mold::Sphere(Sphere { pose: Pose::ORIGIN, radius: 0.1, face });
    let (dome, bowl) = (ball(Face::Outside), ball(Face::Inside));
    let flat = Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
    let saddle = Mold::Graph(Graph {
        pose: Pose::ORIGIN,
        surface: Surface::Saddle(Saddle { radii: [0.2, 0.3] }),
        domain: None,
    });
    for (name, mold, nodes, mesh, seed, shear) in [
        ("dome", dome.clone(), [41, 41], 0.005, [20, 20], 0.0_f64),
        ("fine", dome, [161, 161], 0.00125, [80, 80], 0.0),
        ("bowl", bowl, [61, 41], 0.006, [30, 20], 0.0),
        ("flat", flat, [31, 21], 0.01, [0, 0], 20.0),
        ("saddle", saddle, [51, 31], 0.005, [50, 15], 10.0),
    ] {
        let down = if name == "bowl" { -0.1 } else { 0.1 };
        let layup = Placement {
            nodes,
            mesh: [mesh; 2],
            origin: [0.0; 2],
            seed,
            place: mold.closest_point([0.0, 0.0, down]).point,
            heading: 0.3,
            shear: shear.to_radians(),
            generators: Generators::Geodesic,
            edges: EdgeRule::Along,
        };
        let net = Net::drape(&mold, layup).expect("a net");
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("net_{name}"));
        let findings = Findings::new(&net, &mold, None, None);
        write_all(&net, &mold, &findings, name, &folder, &[]).expect("files");
        let svg = figure::shear_map::svg(&net, name).expect("a map");
        let (largest, _) = net.report.largest_shear.expect("whole cells");
        let said = match name {
            "flat" => "shear 20.0° everywhere".into(),
            _ => format!("largest shear {:.1}°", largest.to_degrees()),
        };
        assert!(svg.contains(&said), "{name}");
        assert!(svg.contains("shear (deg)") && !svg.contains("NaN"), "{name}");
        assert_eq!(svg.contains("no place on the mold"), !net.missing.is_empty(), "{name}");
        assert!(svg.len() < 3_000_000, "{name}: {} bytes", svg.len());
        assert_eq!(svg, figure::shear_map::svg(&net, name).expect("a map"));
    }
}
