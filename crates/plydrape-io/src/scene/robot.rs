//! The arm of a robot, from a shipped file, a URDF file or a table, and the bodies of its links.

use super::file::{DhTable, RobotTable, SceneKeys};
use super::located::Located;
use super::mold::{Purpose, mesh_file};
use super::quantity::{Read, read_given, read_or};
use super::read;
use super::source::{Document, excerpt};
use crate::Error;
use crate::read::urdf::{self, UrdfBody, UrdfShape};
use plydrape::arm::{Arm, JOINTS, Joint, LEAST_MARGIN, LEAST_SINGULAR};
use plydrape::bodies::{Body, Mount, Shape};
use plydrape::geometry::Pose;
use std::path::{Path, PathBuf};

/// The arms that plydrape comes with, each as a URDF file with its source.
const SHIPPED: [(&str, &str); 3] = [
    ("abb_irb4600_60_205", include_str!("../../robots/abb_irb4600_60_205.urdf")),
    ("kuka_kr16_2", include_str!("../../robots/kuka_kr16_2.urdf")),
    ("ur20", include_str!("../../robots/ur20.urdf")),
];
/// Sides of the prism around a round link.
const SIDES: u32 = 24;

/// Checks the table `[robot]`, if the scene has one.
pub(super) fn robot(
    file: &SceneKeys,
    document: &Document,
) -> Result<(Option<Arm>, Vec<Body>), Error> {
    let Some(table) = &file.robot else { return Ok((None, Vec::new())) };

    // an arm needs a tool that it carries
    if file.tool.is_none() {
        return Err(document.error(
            table.span.clone(),
            "an arm carries the frame of a tool, and each gripper of this scene moves by itself",
            "say in [tool] how the frame carries the grippers",
        ));
    }

    // the arm comes from a URDF file or from a table of Denavit and Hartenberg
    let RobotTable { arm, dh, start, joint_margin, singularity, joint_acceleration, .. } =
        &table.value;
    let (name, joints, flange, bodies) = match (arm, dh) {
        (Some(_), Some(dh)) => {
            return Err(document.error(
                dh.span.clone(),
                "this robot has two arms",
                "keep one of `arm` and `dh`",
            ));
        }
        (None, None) => {
            return Err(document.error(
                table.span.clone(),
                "[robot] does not say which arm it is",
                format!(
                    "add arm = \"{}\", or name a URDF file: arm = \"robot.urdf\"",
                    SHIPPED[0].0
                ),
            ));
        }
        (Some(name), None) => from_file(name, &table.value, document)?,
        (None, Some(dh)) => {
            let (joints, flange) = from_table(&dh.value.0, document)?;
            ("arm".into(), joints, flange, Vec::new())
        }
    };

    // where its joints begin, and how near they may come to their limits and to a singularity
    let start = read_given(start, document)?;
    let margin = read_or(joint_margin, LEAST_MARGIN, document)?;
    let singular = read_or(singularity, LEAST_SINGULAR, document)?;
    let acceleration = read_given(joint_acceleration, document)?;
    Ok((Some(Arm { name, joints, flange, start, acceleration, margin, singular }), bodies))
}

/// Name, joints, flange in the frame of the last joint, and bodies of an arm.
type Parts = (String, [Joint; JOINTS], Pose, Vec<Body>);

/// The arm of a shipped file, or of one beside the scene.
fn from_file(
    name: &Located<String>,
    table: &RobotTable,
    document: &Document,
) -> Result<Parts, Error> {
    // an arm that comes with plydrape, or a URDF file beside the scene
    let file = &name.value;
    let shipped = SHIPPED.iter().find(|(shipped, _)| shipped == file);
    let text = match shipped {
        Some((_, text)) => (*text).into(),
        None if !file.ends_with(".urdf") => {
            let names: Vec<String> =
                SHIPPED.iter().map(|(name, _)| format!("\"{name}\"")).collect();
            return Err(document.error(
                name.span.clone(),
                format!("there is no arm \"{}\"", excerpt(file)),
                format!("plydrape comes with {}; a file of your own is named with its ending, as in \"robot.urdf\"", names.join(", ")),
            ));
        }
        None => {
            read::text(&document.path(file), file, urdf::LARGEST)
                .map_err(|error| document.error_of_named(&name.span, error, "scene"))?
                .text
        }
    };

    // the chain of joints from foot to flange
    let [foot, flange] =
        [&table.foot, &table.flange].map(|key| key.as_ref().map(|key| &*key.value));
    let read = urdf::parse(file, &text, foot, flange)
        .map_err(|error| document.error(name.span.clone(), error.to_string(), error.help()))?;

    // the shapes of its links are bodies, numbered where a link has several
    let mut bodies = Vec::new();
    if table.bodies.unwrap_or(true) {
        let path = document.path(file);
        let folder = path.parent().unwrap_or(&document.folder);
        let count = |name: &str| read.bodies.iter().filter(|body| body.name == name).count();
        for (n, body) in read.bodies.iter().enumerate() {
            let before = read.bodies[..n].iter().filter(|other| other.name == body.name).count();
            let label = match count(&body.name) {
                1 => body.name.clone(),
                _ => format!("{} {}", body.name, before + 1),
            };
            bodies.push(Body {
                name: format!("arm's {label}"),
                on: Mount::Link(body.link),
                shape: link_shape(body, name, document, folder)?,
            });
        }
    }

    Ok((read.name, read.joints, read.flange, bodies))
}

/// The shape of a link as triangles in the frame of its joint; a cylinder becomes a prism around it.
fn link_shape(
    body: &UrdfBody,
    file: &Located<String>,
    document: &Document,
    folder: &Path,
) -> Result<Shape, Error> {
    let (vertices, triangles) = match &body.shape {
        UrdfShape::Cylinder { radius, length } => {
            let radius = radius / (std::f64::consts::PI / f64::from(SIDES)).cos();
            Shape::Cylinder { radius, from: -0.5 * length, to: 0.5 * length }.triangles(SIDES)
        }
        UrdfShape::Box(size) => Shape::Box { size: *size, at: [0.0; 3] }.triangles(SIDES),
        UrdfShape::Mesh(name, scale) => {
            let path = mesh_path(name, folder).ok_or_else(|| {
                document.error(
                    file.span.clone(),
                    format!("the mesh {} of {} is not beside {}", excerpt(name), body.name, excerpt(&file.value)),
                    "copy the meshes of the robot's package to where its file stands, or leave the links out: bodies = false in [robot]",
                )
            })?;
            let named = |value: String| Located { span: file.span.clone(), value };
            let purpose = Purpose { what: "link", tolerance: 0.0 };
            let whole = named(path.to_string_lossy().into_owned());
            let meters = named("m".into());
            let (mesh, _) =
                mesh_file(&whole, Some(&meters), &purpose, &Pose::ORIGIN, document, Path::new(""))?;
            let scaled = |p: &[f64; 3]| [0, 1, 2].map(|n| scale[n] * p[n]);
            // a mirrored mesh is turned inside out
            let turned = |[a, b, c]: &[u32; 3]| match scale.iter().product::<f64>() < 0.0 {
                true => [*a, *c, *b],
                false => [*a, *b, *c],
            };
            let triangles = mesh.triangles().iter().map(turned).collect();
            (mesh.vertices().iter().map(scaled).collect(), triangles)
        }
    };
    let vertices = vertices.iter().map(|p| body.pose.place(*p)).collect();
    Ok(Shape::Mesh { vertices, triangles })
}

/// The file that a robot names, as in `package://robot/meshes/link.stl`: below the folder of the robot's file or one of those around it.
fn mesh_path(name: &str, folder: &Path) -> Option<PathBuf> {
    let (package, rest) = match name.strip_prefix("package://") {
        Some(rest) => (Some(rest), rest.split_once('/').map_or(rest, |(_, path)| path)),
        None => (None, name.strip_prefix("file://").unwrap_or(name)),
    };
    let candidates = |folder: &Path| {
        [package, Some(rest)]
            .into_iter()
            .flatten()
            .map(|path| folder.join(path))
            .collect::<Vec<_>>()
    };
    folder.ancestors().flat_map(candidates).find(|path| path.is_file())
}

/// The joints of a table, and the flange in the frame of the last one.
fn from_table(
    table: &[DhTable; JOINTS],
    document: &Document,
) -> Result<([Joint; JOINTS], Pose), Error> {
    let mut joints = Vec::with_capacity(JOINTS);
    let mut before = Pose::ORIGIN;
    for (n, row) in table.iter().enumerate() {
        let range = row.range.read(document)?;
        if range[0] >= range[1] {
            return Err(document.error(
                row.range.span.clone(),
                "the joint ends before it begins",
                "give its smallest angle first, as in range = [\"-180 deg\", \"180 deg\"]",
            ));
        }
        let speed = row.speed.read(document)?;
        joints.push(Joint {
            name: format!("joint_{}", n + 1),
            pose: before,
            axis: [0.0, 0.0, 1.0],
            range,
            speed,
        });
        // what comes behind the turn of the joint
        let turn = Pose::new(
            [0.0, 0.0, read_or(&row.d, 0.0, document)?],
            [0.0, 0.0, read_or(&row.theta, 0.0, document)?],
        );
        let along = Pose::new(
            [read_or(&row.a, 0.0, document)?, 0.0, 0.0],
            [read_or(&row.alpha, 0.0, document)?, 0.0, 0.0],
        );
        before = turn.compose(&along);
    }
    let joints = <[Joint; JOINTS]>::try_from(joints);
    let none = || Error::not_possible("an arm has six joints", "give six rows to dh");
    Ok((joints.map_err(|_| none())?, before))
}
