//! The bodies that move with grippers and robot, and the obstacles of the cell.

use super::check::line;
use super::file::{BodyTable, BoxTable, CylinderTable, MountKey, ObstacleTable, SceneKeys};
use super::located::Located;
use super::mold::{Purpose, mesh_file};
use super::pose::pose;
use super::quantity::{Read, read_or};
use super::source::Document;
use crate::Error;
use plydrape::bodies::{Bodies, Body, Obstacle, Shape};
use plydrape::geometry::Pose;
use std::ops::Range;

/// Checks the tables `[[bodies]]` and `[[obstacles]]`, beside the links of an arm.
pub(super) fn bodies(
    file: &SceneKeys,
    links: Vec<Body>,
    document: &Document,
) -> Result<Bodies, Error> {
    let reader = Reader { document, carried: file.tool.is_some() };
    let mut names: Vec<&Located<String>> = Vec::new();
    let mut bodies = Vec::with_capacity(file.bodies.len());
    for table in &file.bodies {
        names.push(&table.value.name);
        bodies.push(reader.body(table)?);
    }
    let mut obstacles = Vec::with_capacity(file.obstacles.len());
    for table in &file.obstacles {
        names.push(&table.value.name);
        obstacles.push(reader.obstacle(table)?);
    }
    for (n, name) in names.iter().enumerate() {
        if names[..n].iter().any(|other| other.value == name.value) {
            return Err(document.error(
                name.span.clone(),
                format!("two bodies or obstacles have the name {}", document.quoted(&name.span)),
                "give each a name of its own: reports say by name who is near whom",
            ));
        }
    }
    bodies.extend(links);
    Ok(Bodies::new(bodies, obstacles))
}

struct Reader<'a> {
    document: &'a Document,
    /// Whether a robot carries the grippers by its flange.
    carried: bool,
}

/// The keys of a shape, of which a body takes one.
struct ShapeKeys<'a> {
    /// Where the table is.
    table: Range<usize>,
    cylinder: &'a Option<Located<CylinderTable>>,
    cuboid: &'a Option<Located<BoxTable>>,
    mesh: &'a Option<Located<String>>,
    unit: &'a Option<Located<String>>,
}

impl Reader<'_> {
    fn body(&self, table: &Located<BodyTable>) -> Result<Body, Error> {
        let BodyTable { name, on, cylinder, cuboid, mesh, unit } = &table.value;
        self.check_carried(on)?;
        let keys = ShapeKeys { table: name.span.clone(), cylinder, cuboid, mesh, unit };
        Ok(Body { name: self.name(name)?, on: on.value.into(), shape: self.shape(&keys)? })
    }

    fn obstacle(&self, table: &Located<ObstacleTable>) -> Result<Obstacle, Error> {
        let ObstacleTable { name, cylinder, cuboid, mesh, unit, position, rotation } = &table.value;
        let keys = ShapeKeys { table: name.span.clone(), cylinder, cuboid, mesh, unit };
        Ok(Obstacle {
            name: self.name(name)?,
            pose: pose(position.as_ref(), rotation.as_ref(), self.document)?,
            shape: self.shape(&keys)?,
        })
    }

    /// Refuses a body of the flange where no robot carries the grippers by a flange.
    fn check_carried(&self, on: &Located<MountKey>) -> Result<(), Error> {
        match on.value {
            MountKey::Pad | MountKey::Stem => Ok(()),
            MountKey::Flange if self.carried => Ok(()),
            MountKey::Flange => Err(self.document.error(
                on.span.clone(),
                "no robot carries the grippers of this scene by its flange: each gripper moves by itself",
                "say in [tool] how a robot carries them, or mount the body on = \"stem\" or on = \"pad\" of every gripper",
            )),
        }
    }

    fn name(&self, name: &Located<String>) -> Result<String, Error> {
        match line(name, self.document)? {
            text if text.trim().is_empty() => Err(self.document.error(
                name.span.clone(),
                "this name is empty",
                "reports say by name who is near whom: name = \"clamp\"",
            )),
            text => Ok(text),
        }
    }

    fn shape(&self, keys: &ShapeKeys) -> Result<Shape, Error> {
        // a body has one shape
        let document = self.document;
        let given: Vec<&Range<usize>> = [
            keys.cylinder.as_ref().map(|key| &key.span),
            keys.cuboid.as_ref().map(|key| &key.span),
            keys.mesh.as_ref().map(|key| &key.span),
        ]
        .into_iter()
        .flatten()
        .collect();
        if let [_, second, ..] = given[..] {
            return Err(document.error(
                second.clone(),
                format!("{} has two shapes", document.quoted(&keys.table)),
                "keep one of `cylinder`, `box` and `mesh`, and make another body of the other one",
            ));
        }

        // only the numbers of a mesh file have no unit of their own
        if let (Some(unit), None) = (keys.unit, keys.mesh) {
            return Err(document.error(
                unit.span.clone(),
                "`unit` belongs to a `mesh`",
                "remove it: other sizes carry their own unit, as in \"30 mm\"",
            ));
        }
        match (keys.cylinder, keys.cuboid, keys.mesh) {
            (Some(table), ..) => self.cylinder(&table.value),
            (_, Some(table), _) => self.cuboid(&table.value),
            (.., Some(file)) => {
                // a mesh keeps the coordinates of its file
                let own = Pose::upright([0.0; 3]);
                let purpose = Purpose { what: "body", tolerance: 0.0 };
                let unit = keys.unit.as_ref();
                let (mesh, _) = mesh_file(file, unit, &purpose, &own, document, &document.folder)?;
                let (vertices, triangles) = (mesh.vertices().to_vec(), mesh.triangles().to_vec());
                Ok(Shape::Mesh { vertices, triangles })
            }
            _ => Err(document.error(
                keys.table.clone(),
                format!("{} has no shape", document.quoted(&keys.table)),
                "add cylinder = { radius = \"15 mm\", to = \"40 mm\" }, box = { size = [\"1 m\", \"0.5 m\", \"20 mm\"] } or mesh = \"frame.stl\"",
            )),
        }
    }

    fn cylinder(&self, table: &CylinderTable) -> Result<Shape, Error> {
        let radius = table.radius.read(self.document)?;
        let from = read_or(&table.from, 0.0, self.document)?;
        let to = table.to.read(self.document)?;
        if to <= from {
            return Err(self.document.error(
                table.to.span.clone(),
                format!(
                    "the cylinder ends at {}, not above where it begins",
                    self.document.quoted(&table.to.span)
                ),
                "its axis is z: give a `to` above `from`, which is 0 unless given",
            ));
        }
        Ok(Shape::Cylinder { radius, from, to })
    }

    fn cuboid(&self, table: &BoxTable) -> Result<Shape, Error> {
        let size = table.size.read(self.document)?;
        Ok(Shape::Box { size, at: read_or(&table.at, [0.0; 3], self.document)? })
    }
}
