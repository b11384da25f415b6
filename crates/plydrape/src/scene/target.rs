//! Where the ply shall end, and rectangles of grippers laid out on a plane.

use super::FlatDrape;
use super::Target;
use super::error::{Document, SceneError};
use super::file::TargetTable;
use super::located::Located;
use super::mold::{coordinates, heading};
use super::places::Places;
use super::quantity::{Angle, Quantity};
use crate::mold::{Mold, Plane};
use crate::ply::{Grid, Ply};
use std::path::Path;

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
        if keys.shear.is_some() || keys.origin.is_some() || keys.direction.is_some() {
            return Err(document.error(
                positions.span.clone(),
                "the target has `positions` and the keys of a parallelogram",
                "keep `positions`, or `shear`, `origin` and `direction`",
            ));
        }
        let places = Places::read(positions, ply.grid, document, base)?;
        places.check_run(ply, "at the target")?;
        return Ok(Target { grippers: places.points, drape: None });
    }
    let Some(Mold::Plane(plane)) = mold else {
        return Err(document.error(
            table.span.clone(),
            "the target is a drape on a mold, and the scene has no mold",
            "add [mold] with kind = \"plane\", or give the target's `positions`",
        ));
    };
    let shear = match &keys.shear {
        Some(shear) => shear_angle(shear, document)?,
        None => 0.0,
    };
    let origin = match &keys.origin {
        Some(origin) => coordinates(origin, document)?,
        None => [0.0; 2],
    };
    let direction = match &keys.direction {
        Some(direction) => heading(direction, document)?,
        None => 0.0,
    };
    let drape = FlatDrape::on(plane, origin, direction, shear);
    Ok(Target { grippers: drape.grippers(ply.grid, ply.cell), drape: Some(drape) })
}

/// A shear angle to either side, below a right angle (rad).
fn shear_angle(shear: &Quantity<Angle>, document: &Document) -> Result<f64, SceneError> {
    let value = shear.si(document)?;
    if value >= 0.0 {
        return shear.below_right_angle(document);
    }
    if value > -std::f64::consts::FRAC_PI_2 * (1.0 - 1e-9) {
        return Ok(value);
    }
    Err(document.error(
        shear.span.clone(),
        format!("{} shears the ply by a right angle or more", document.quoted(&shear.span)),
        "an angle between -90 deg and 90 deg is wanted; write degrees as \"20 deg\"",
    ))
}

impl FlatDrape {
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
