//! Where the ply shall end: the ideal drape on the mold, or positions as given.

use super::FlatDrape;
use super::Target;
use super::error::{Document, SceneError};
use super::file::TargetTable;
use super::layup::{layup, round};
use super::located::Located;
use super::places::Places;
use crate::mold::{Mold, Plane};
use crate::net::{Layup, LayupError, Net, Reason};
use crate::ply::{Grid, Ply};
use std::path::Path;
use std::sync::Arc;

/// Checks the table `[target]`.
pub(super) fn target(
    table: &Located<TargetTable>,
    ply: &Ply,
    mold: Option<&Mold>,
    document: &Document,
    base: &Path,
) -> Result<Target, SceneError> {
    let keys = &table.value;
    if let Some(positions) = &keys.positions {
        if let Some(key) = laying_key(keys) {
            return Err(document.error(
                positions.span.clone(),
                format!("the target has `positions` and `{key}`"),
                format!(
                    "keep `positions`, which say all, or `{key}` to have the ply laid on the mold"
                ),
            ));
        }
        let places = Places::read(positions, ply.grid, document, base)?;
        places.check_run(ply, "at the target")?;
        return Ok(Target { grippers: places.points, drape: None, net: None, layup: None });
    }
    let Some(mold) = mold else {
        return Err(document.error(
            table.span.clone(),
            "the target is a drape on a mold, and the scene has no mold",
            "add [mold] with kind = \"plane\", or give the target's `positions`",
        ));
    };
    let layup = layup(keys, &table.span, ply, mold, document)?;
    if let Mold::Plane(plane) = mold {
        let drape = FlatDrape::laid(plane, &layup);
        let grippers = drape.grippers(ply.grid, ply.cell);
        return Ok(Target { grippers, drape: Some(drape), net: None, layup: Some(layup) });
    }
    let net = Net::drape(mold, layup).map_err(|error| no_net(keys, table, &error, document))?;
    let grippers = at_grippers(&net, ply, table, document)?;
    // nodes that hang straight above each other have no span between them
    let places = Places {
        points: grippers,
        document: document.clone(),
        spans: vec![header(table, document)],
        height: None,
    };
    places.check_run(ply, "at the target")?;
    let net = Some(Arc::new(net));
    Ok(Target { grippers: places.points, drape: None, net, layup: Some(layup) })
}

/// A key that says how the ply is laid on the mold.
fn laying_key(keys: &TargetTable) -> Option<&'static str> {
    [
        ("shear", keys.shear.is_some()),
        ("origin", keys.origin.is_some()),
        ("direction", keys.direction.is_some()),
        ("seed", keys.seed.is_some()),
        ("mesh", keys.mesh.is_some()),
        ("generators", keys.generators.is_some()),
        ("edges", keys.edges.is_some()),
    ]
    .into_iter()
    .find_map(|(key, given)| given.then_some(key))
}

/// The bytes of `[target]` itself.
fn header(table: &Located<TargetTable>, document: &Document) -> std::ops::Range<usize> {
    let text = document.text.get(table.span.clone()).unwrap_or_default();
    let length = text.find('\n').unwrap_or(text.len());
    table.span.start..table.span.start + length
}

/// A net that cannot be begun, at the key that would begin it.
fn no_net(
    keys: &TargetTable,
    table: &Located<TargetTable>,
    error: &LayupError,
    document: &Document,
) -> SceneError {
    let shear = keys.shear.as_ref().map(|shear| &shear.span);
    let origin = keys.origin.as_ref().map(|origin| &origin.span);
    let (key, help) = match error {
        LayupError::Shear { .. } => (shear, "give a smaller `shear`; a ply locks long before"),
        _ => (origin, "give another `origin`, where the mold faces upwards"),
    };
    let place = key.cloned().unwrap_or_else(|| header(table, document));
    document.error(place, error.to_string(), help)
}

/// Places of the net at the grippers; refuses a ply that reaches beyond the mold or folds.
fn at_grippers(
    net: &Net,
    ply: &Ply,
    table: &Located<TargetTable>,
    document: &Document,
) -> Result<Vec<[f64; 3]>, SceneError> {
    let divisions = [0, 1].map(|n| (ply.cell[n] / net.layup.mesh[n]).round() as usize);
    let node = |index: usize| {
        let id = ply.grid.id(index);
        [id[0] * divisions[0], id[1] * divisions[1]]
    };
    let places: Vec<Option<[f64; 3]>> =
        (0..ply.grid.grippers()).map(|index| net.node(node(index))).collect();
    let missing = places.iter().filter(|place| place.is_none()).count();
    let Some(first) = places.iter().position(Option::is_none) else {
        return Ok(places.into_iter().flatten().collect());
    };
    let id = ply.grid.id(first);
    let reason = net.missing.iter().find(|missing| missing.node == node(first));
    let (reason, help) = match reason.map(|missing| (missing.reason, missing.beyond)) {
        Some((Reason::OffMold, beyond)) => (
            format!("lies {} mm beyond the border of the mold", round(beyond.unwrap_or(0.0) * 1e3)),
            "the ply reaches over the mold's border: move `origin` or turn `direction`, or take a larger mold or a smaller ply",
        ),
        Some((Reason::Folded, _)) => (
            "lies where the net folds".into(),
            "the ply cannot lie there without a fold: move `origin` or `seed` towards the middle of the ply, or take a smaller ply",
        ),
        _ => (
            "lies behind a fold of the net".into(),
            "the ply folds on its way there: move `origin` or `seed` towards the middle of the ply, or take a smaller ply",
        ),
    };
    let count = ply.grid.grippers();
    let have = if missing == 1 { "gripper has" } else { "grippers have" };
    Err(document.error(
        header(table, document),
        format!("{missing} of {count} {have} no place on the mold: gripper {id:?} {reason}"),
        help,
    ))
}

impl FlatDrape {
    /// The drape of a ply whose seed is laid on a plane.
    #[must_use]
    pub fn laid(plane: &Plane, layup: &Layup) -> Self {
        let [x, y, _] = layup.place;
        let mut drape = Self::on(plane, [x, y], layup.heading, layup.shear);
        let [u, v] = [0, 1].map(|n| layup.seed[n] as f64 * layup.mesh[n]);
        drape.origin =
            [0, 1, 2].map(|k| drape.origin[k] - u * drape.along_u[k] - v * drape.along_v[k]);
        drape
    }

    /// A drape on a plane: fabric point (0, 0) above or below `origin` (x, y in m), u along the
    /// heading `direction` (rad) as seen from above, v at 90° − `shear` (rad) from u, to its left.
    #[must_use]
    pub fn on(plane: &Plane, origin: [f64; 2], direction: f64, shear: f64) -> Self {
        let [nx, ny, nz] = plane.normal;
        // u: the heading, lifted into the plane.
        let (sin, cos) = direction.sin_cos();
        let climb = -(nx * cos + ny * sin) / nz;
        let length = climb.hypot(1.0);
        let along_u = [cos / length, sin / length, climb / length];
        // v: between u and the perpendicular n × u in the plane.
        let [ux, uy, uz] = along_u;
        let left = [ny * uz - nz * uy, nz * ux - nx * uz, nx * uy - ny * ux];
        let (sin, cos) = shear.sin_cos();
        let along_v = [0, 1, 2].map(|k| sin * along_u[k] + cos * left[k]);

        let [x, y] = origin;
        let [px, py, pz] = plane.point;
        let z = pz - (nx * (x - px) + ny * (y - py)) / nz;
        FlatDrape { origin: [x, y, z], along_u, along_v }
    }

    /// Place (m) of the fabric point (u, v) (m).
    #[must_use]
    pub fn place(&self, [u, v]: [f64; 2]) -> Option<[f64; 3]> {
        Some([0, 1, 2].map(|k| self.origin[k] + u * self.along_u[k] + v * self.along_v[k]))
    }

    /// Unit vectors along the fibres at the fabric point (u, v) (m).
    #[must_use]
    pub fn fibres(&self, _uv: [f64; 2]) -> Option<[[f64; 3]; 2]> {
        Some([self.along_u, self.along_v])
    }

    /// Places (m) of all grippers, `spacing` (m) apart along u and v, in the order of [`Grid::index`].
    #[must_use]
    pub fn grippers(&self, grid: Grid, spacing: [f64; 2]) -> Vec<[f64; 3]> {
        (0..grid.grippers())
            .map(|index| {
                let [i, j] = grid.id(index);
                let (u, v) = (i as f64 * spacing[0], j as f64 * spacing[1]);
                [0, 1, 2].map(|k| self.origin[k] + u * self.along_u[k] + v * self.along_v[k])
            })
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
        a.iter().zip(b).map(|(x, y)| x * y).sum()
    }

    proptest! {
        /// On any plane the sides keep their length, stand at 90° − γ, lie in the plane, and u
        /// keeps its heading in plan.
        #[test]
        fn a_flat_drape_is_a_parallelogram_in_the_plane(
            tilt in 0.0..1.5f64, climb in -3.0..3.0f64, direction in -6.0..6.0f64, shear in -1.5..1.5f64,
        ) {
            let normal = [-tilt.sin() * climb.cos(), -tilt.sin() * climb.sin(), tilt.cos()];
            let plane = Plane { point: [0.1, -0.2, 0.3], normal };
            let drape = FlatDrape::on(&plane, [0.4, 0.5], direction, shear);
            let (u, v) = (drape.along_u, drape.along_v);
            prop_assert!((dot(u, u) - 1.0).abs() < 1e-13 && (dot(v, v) - 1.0).abs() < 1e-13);
            prop_assert!((dot(u, v) - shear.sin()).abs() < 1e-13);
            prop_assert!(dot(u, normal).abs() < 1e-13 && dot(v, normal).abs() < 1e-13);
            prop_assert!((u[0] * direction.sin() - u[1] * direction.cos()).abs() < 1e-13);
            prop_assert!(u[0] * direction.cos() + u[1] * direction.sin() > 0.0);
            let off = [0, 1, 2].map(|k| drape.origin[k] - plane.point[k]);
            prop_assert!(dot(off, normal).abs() < 1e-13);
            prop_assert_eq!([drape.origin[0], drape.origin[1]], [0.4, 0.5]);
        }
    }
}
