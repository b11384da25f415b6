//! Pictures of drapes on curved molds and of nets. They stay in the `tmp` folder of the build's target for a look.

use plydrape::layup::Target;
use plydrape::mold::{Cylinder, Face, Graph, Mold, Plane, Pose, Saddle, Sphere, Surface};
use plydrape::motion::Motion;
use plydrape::net::{EdgeRule, Generators, Net, Placement};
use plydrape::ply::Grid;
use plydrape::scene::Scene;
use plydrape_io::ResultFile;
use plydrape_io::net::{Findings, write_all};
use plydrape_io::{self, figure};
use std::path::Path;

/// The ply of the first example, its cells 100 mm, on a mold: let down in straight lines onto `target`
/// from `height` (m) above its highest gripper.
fn lowered(grid: Grid, mold: Mold, target: &[[f64; 3]], height: f64, steps: usize) -> ResultFile {
    let root =
        concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/01_flat_sheared_mold/scene.toml");
    let mut scene: Scene =
        plydrape_io::scene::read(Path::new(root)).expect("a shipped scene").scene;
    let top = target.iter().map(|p| p[2]).fold(f64::NEG_INFINITY, f64::max);
    let at = |share: f64| {
        let down = |p: &[f64; 3]| [p[0], p[1], p[2] + share * (top + height - p[2])];
        target.iter().map(down).collect()
    };
    scene.title = "A ply let down".into();
    scene.layup.ply.grid = grid;
    scene.layup.ply.cell = [0.1; 2];
    scene.layup.mold = Some(mold);
    scene.layup.target = Some(Target { grippers: target.to_vec(), drape: None });
    let last = steps - 1;
    scene.layup.motion = Motion {
        times: (0..steps).map(|n| n as f64).collect(),
        positions: (0..steps).map(|n| at(1.0 - n as f64 / last as f64)).collect(),
    };
    crate::common::drape(&scene)
}

/// Points of a mold above a grid about the origin, `spacing` (m) apart in plan.
fn above(grid: Grid, mold: &Mold, spacing: f64) -> Vec<[f64; 3]> {
    let middle = [grid.nu, grid.nv].map(|n| 0.5 * (n - 1) as f64);
    let place = |k: usize| {
        let [i, j] = grid.id(k);
        let plan = [(i as f64 - middle[0]) * spacing, (j as f64 - middle[1]) * spacing];
        mold.highest_point(plan).expect("mold below the grid")
    };
    (0..grid.grippers()).map(place).collect()
}

fn molds() -> Vec<(&'static str, Grid, Mold, f64)> {
    let pose = |z: f64| Pose::new([0.0, 0.0, z], [0.0; 3]);
    let across = Pose::new([0.0, 0.0, 0.4], [0.0, 0.0, std::f64::consts::FRAC_PI_2]);
    let (ply, strip) = (Grid { nu: 4, nv: 4 }, Grid { nu: 4, nv: 1 });
    let saddle = |radii| {
        let surface = Surface::Saddle(Saddle { radii });
        Mold::Graph(Graph { pose: pose(0.0), surface, domain: None })
    };
    let (radius, face) = (0.6, Face::Outside);
    vec![
        ("sphere", ply, Mold::Sphere(Sphere { pose: pose(-radius), radius, face }), 0.097),
        ("ball", ply, Mold::Sphere(Sphere { pose: pose(-0.22), radius: 0.22, face }), 0.075),
        ("saddle", ply, saddle([0.5, 0.5]), 0.097),
        ("parabola", strip, saddle([-0.6, f64::INFINITY]), 0.097),
        (
            "trough",
            strip,
            Mold::Cylinder(Cylinder { pose: across, radius: 0.4, face: Face::Inside }),
            0.09,
        ),
    ]
}

/// On a curved mold the ply is colored by its gap, the mold is there, and heights are true.
#[test]
fn a_drape_on_a_curved_mold_has_a_picture_with_gaps() {
    for (name, grid, mold, spacing) in molds() {
        let target = above(grid, &mold, spacing);
        let result = lowered(grid, mold, &target, 0.05, 16);
        let steps = figure::default_steps(&result);
        let svg = figure::svg(&result, &steps).expect("a picture");
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}.svg"));
        std::fs::write(path, &svg).expect("room for a picture");
        assert_eq!(svg.contains("gap (mm)"), grid.cells() > 0, "{name}");
        assert!(!svg.contains("exaggerated") && !svg.contains("NaN"), "{name}");
        assert!(svg.contains("target outline"), "{name}");
        assert!(svg.len() < 4_000_000, "{name}: {} bytes", svg.len());
        assert_eq!(svg, figure::svg(&result, &steps).expect("a picture"));
    }
}

/// The map says what the net reports; same net, same bytes; even a fine net stays a page's size.
#[test]
fn a_shear_map_says_what_its_net_reports() {
    let ball = |face| {
        let pose = Pose::new([0.0; 3], [0.0; 3]);
        Mold::Sphere(Sphere { pose, radius: 0.1, face })
    };
    let (dome, bowl) = (ball(Face::Outside), ball(Face::Inside));
    let flat = Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
    let saddle = Mold::Graph(Graph {
        pose: Pose::new([0.0; 3], [0.0; 3]),
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
        let findings = Findings::of(&net, &mold, None, None);
        write_all(&net, &mold, &findings, name, &folder).expect("files");
        let svg = figure::shear_map::svg(&net, &mold, name).expect("a map");
        let (largest, _) = net.report.largest_shear.expect("whole cells");
        let said = match name {
            "flat" => "shear 20.0° everywhere".into(),
            _ => format!("largest shear {:.1}°", largest.to_degrees()),
        };
        assert!(svg.contains(&said), "{name}");
        assert!(svg.contains("shear (deg)") && !svg.contains("NaN"), "{name}");
        assert_eq!(svg.contains("no place on the mold"), !net.missing.is_empty(), "{name}");
        assert!(svg.len() < 3_000_000, "{name}: {} bytes", svg.len());
        assert_eq!(svg, figure::shear_map::svg(&net, &mold, name).expect("a map"));
    }
}
