//! A scene of another size in which everything that counts is as large beside the ply as before.
//!
//! Lengths, and limits that are lengths, are multiplied by s. The weight per length of a line stays, so that forces grow
//! with s: EI ~ s³ and EA ~ s. By area the mass is that of a line over the cell, ~ 1/s, and with it bending rigidity ~ s²,
//! while tension and shear force per width stay. Times stay: a motion's speeds and their limits grow with s.

use plydrape::layup::Target;
use plydrape::material::{Material, Section};
use plydrape::measure::Name;
use plydrape::mold::{Graph, HeightGrid, Mesh, Mold, Plane, Pose, Saddle, Surface};
use plydrape::motion::Motion;
use plydrape::net::{Net, Placement};
use plydrape::scene::Scene;
use std::sync::Arc;

type Point = [f64; 3];

/// A scene with lengths multiplied by `s`. A mold that is a formula has none.
pub fn scaled(scene: &Scene, s: f64) -> Scene {
    let mut out = scene.clone();
    let mold = scene.layup.mold.as_ref().map(|mold| scaled_mold(mold, s));
    out.layup.ply.cell = scene.layup.ply.cell.map(|side| s * side);
    out.layup.ply.material = scaled_material(&scene.layup.ply.material, s);
    out.layup.motion = Motion {
        times: scene.layup.motion.times.clone(),
        positions: scene.layup.motion.positions.iter().map(|places| points(places, s)).collect(),
    };
    out.layup.target = scene.layup.target.as_ref().map(|target| Target {
        grippers: points(&target.grippers, s),
        drape: target.drape.as_ref().zip(mold.as_ref()).map(|(net, mold)| {
            let Placement { mesh, place, .. } = net.placement;
            let layup =
                Placement { mesh: mesh.map(|d| s * d), place: point(place, s), ..net.placement };
            Arc::new(Net::drape(mold, layup).expect("the net of a scaled mold"))
        }),
    });
    out.layup.mold = mold;

    let settings = &mut out.layup.settings;
    settings.axial_stiffness *= s;
    settings.contact.tolerance *= s;
    settings.contact.tack /= s;
    settings.pad.radius *= s;
    settings.sheet.overhang *= s;
    settings.sheet.mesh = settings.sheet.mesh.map(|mesh| s * mesh);
    out.plan.move_limit = out.plan.move_limit.map(|length| s * length);

    let limits = &mut out.limits;
    for name in [
        Name::Bridging,
        Name::LandingGripper,
        Name::Penetration,
        Name::Height,
        Name::Position,
        Name::GripperDistance,
        Name::GripperLoad,
        Name::Speed,
        Name::Acceleration,
        Name::Jerk,
        Name::GripperForce,
        Name::Force,
        Name::GripperPull,
        Name::Wrinkle,
    ] {
        limits.set(name, limits.get(name).map(|bound| s * bound));
    }
    limits.workspace = limits.workspace.map(|sides| sides.map(|side| side.map(|x| s * x)));
    out
}

fn point(p: Point, s: f64) -> Point {
    p.map(|x| s * x)
}

fn points(places: &[Point], s: f64) -> Vec<Point> {
    places.iter().map(|p| point(*p, s)).collect()
}

fn scaled_material(material: &Material, s: f64) -> Material {
    let section = match material.section {
        Section::Line { mass, flexural_rigidity } => {
            Section::Line { mass, flexural_rigidity: s.powi(3) * flexural_rigidity }
        }
        Section::Areal { mass, warp_rigidity, weft_rigidity } => Section::Areal {
            mass: mass / s,
            warp_rigidity: s * s * warp_rigidity,
            weft_rigidity: s * s * weft_rigidity,
        },
    };
    Material { section, ..material.clone() }
}

fn scaled_mold(mold: &Mold, s: f64) -> Mold {
    let mut mold = mold.clone();
    let moved = |pose: &mut Pose| pose.position = point(pose.position, s);
    match &mut mold {
        Mold::Plane(plane) => *plane = Plane { point: point(plane.point, s), ..*plane },
        Mold::Cylinder(cylinder) => {
            moved(&mut cylinder.pose);
            cylinder.radius *= s;
        }
        Mold::Sphere(sphere) => {
            moved(&mut sphere.pose);
            sphere.radius *= s;
        }
        Mold::Torus(torus) => {
            moved(&mut torus.pose);
            torus.ring_radius *= s;
            torus.tube_radius *= s;
        }
        Mold::Graph(Graph { pose, surface, domain }) => {
            moved(pose);
            *domain = domain.map(|sides| sides.map(|side| side.map(|x| s * x)));
            *surface = match &*surface {
                Surface::Saddle(saddle) => {
                    Surface::Saddle(Saddle { radii: saddle.radii.map(|r| s * r) })
                }
                Surface::HeightGrid(heights) => {
                    let [x, y, z] =
                        heights.nodes().map(|nodes| nodes.iter().map(|x| s * x).collect());
                    Surface::HeightGrid(HeightGrid::new(x, y, z).expect("a scaled grid"))
                }
                other => panic!("{other:?} has no scaled one"),
            };
        }
        Mold::Mesh(mesh) => {
            let vertices = points(mesh.vertices(), s);
            let (mesh, _) = Mesh::of_triangles(vertices, mesh.triangles()).expect("a scaled mesh");
            return Mold::Mesh(Arc::new(mesh));
        }
        Mold::Wavy(_) => panic!("no scene file has a mold with waves"),
        Mold::Layered(_) => panic!("no scene file has a mold with plies on it"),
    }
    mold
}
