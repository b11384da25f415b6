//! The mold of a scene: which keys its kind takes, its pose, and its shape.

mod graph;
mod heights;
mod mesh;
mod plane;
mod round;

use super::file::{MoldKind, MoldTable};
use super::located::Located;
use super::pose::pose;
use super::source::Document;
use crate::Error;
use crate::store::shown::listed;
use plydrape::mold::{MeshReport, Mold, Pose};
use plydrape::ply::Ply;
use std::ops::Range;

pub(super) use mesh::{Purpose, mesh_file, usual_width};

/// Least upward part of a unit normal: a mold this steep or steeper is a wall (89.9°).
const UPWARD: f64 = 1.7e-3;

/// A table `[mold]` under reading.
struct Keys<'a> {
    table: &'a MoldTable,
    document: &'a Document,
}

/// Checks the table `[mold]`. A mesh comes with what was found in it; boundaries
/// of its faces that are no farther apart than `tolerance` (m) are stitched.
pub(super) fn mold(
    table: &MoldTable,
    ply: &Ply,
    tolerance: f64,
    document: &Document,
) -> Result<(Mold, Option<MeshReport>), Error> {
    let keys = Keys { table, document };
    keys.check_belonging()?;
    let mold = match table.kind.value {
        MoldKind::Plane => plane::plane(table, document),
        MoldKind::Cylinder => round::cylinder(&keys),
        MoldKind::Sphere => round::sphere(&keys),
        MoldKind::Torus => round::torus(&keys),
        MoldKind::Saddle => graph::saddle(&keys),
        MoldKind::Formula => graph::formula(&keys, ply),
        MoldKind::HeightGrid => graph::height_grid(&keys),
        MoldKind::Mesh => {
            let (mesh, report) = mesh::mesh(&keys, ply, tolerance)?;
            return Ok((mesh, Some(report)));
        }
    };
    Ok((mold?, None))
}

impl Keys<'_> {
    /// Every key beside `kind`, with its place where it is given.
    fn places(&self) -> [(&'static str, Option<&Range<usize>>); 17] {
        fn place<T>(key: &Option<Located<T>>) -> Option<&Range<usize>> {
            key.as_ref().map(|located| &located.span)
        }
        let t = self.table;
        [
            ("point", place(&t.point)),
            ("normal", place(&t.normal)),
            ("tilt", place(&t.tilt)),
            ("tilt_direction", place(&t.tilt_direction)),
            ("position", place(&t.position)),
            ("rotation", place(&t.rotation)),
            ("radius", place(&t.radius)),
            ("ring_radius", place(&t.ring_radius)),
            ("tube_radius", place(&t.tube_radius)),
            ("side", place(&t.side)),
            ("radii", place(&t.radii)),
            ("z", place(&t.z)),
            ("x", place(&t.x)),
            ("y", place(&t.y)),
            ("file", place(&t.file)),
            ("unit", place(&t.unit)),
            ("spanned", place(&t.spanned)),
        ]
    }

    /// Refuses a key that belongs to molds of another kind.
    fn check_belonging(&self) -> Result<(), Error> {
        let kind = self.table.kind.value;
        let misplaced = self.places().into_iter().find_map(|(key, place)| {
            let place = place.filter(|_| !kind.keys().contains(&key))?;
            Some((key, place.clone()))
        });
        let Some((key, place)) = misplaced else {
            return Ok(());
        };
        let owners: Vec<String> = MoldKind::ALL
            .into_iter()
            .filter(|owner| owner.keys().contains(&key))
            .map(|owner| format!("\"{}\"", owner.name()))
            .collect();
        let own: Vec<String> = kind.keys().iter().map(|own| format!("`{own}`")).collect();
        Err(self.document.error(
            place,
            format!("a mold of kind \"{}\" has no `{key}`", kind.name()),
            format!(
                "`{key}` belongs to kind {}; \"{}\" takes {}",
                listed(&owners),
                kind.name(),
                listed(&own)
            ),
        ))
    }

    /// A key that its kind cannot do without.
    fn required<'k, T>(
        &self,
        key: &'k Option<T>,
        name: &str,
        example: &str,
    ) -> Result<&'k T, Error> {
        key.as_ref().ok_or_else(|| {
            let kind = &self.table.kind;
            self.document.error(
                kind.span.clone(),
                format!("a mold of kind \"{}\" needs `{name}`", kind.value.name()),
                format!("add {name} = {example}"),
            )
        })
    }

    /// Position and rotation of the mold.
    fn pose(&self) -> Result<Pose, Error> {
        let MoldTable { position, rotation, .. } = self.table;
        pose(position.as_ref(), rotation.as_ref(), self.document)
    }

    /// A pose that leaves the mold's z axis pointing upwards.
    fn upward_pose(&self) -> Result<Pose, Error> {
        let pose = self.pose()?;
        match &self.table.rotation {
            Some(rotation) if pose.axes[2][2] < UPWARD => Err(self.document.error(
                rotation.span.clone(),
                "this turns the mold on its side or upside down",
                "the ply comes from above: turn the mold's z axis by less than 89.9 deg from upright",
            )),
            _ => Ok(pose),
        }
    }
}
