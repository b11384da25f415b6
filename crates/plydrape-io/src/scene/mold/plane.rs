//! A flat mold: by a point and a normal, or by its tilt.

use super::UPWARD;
use crate::Error;
use crate::scene::file::MoldTable;
use crate::scene::quantity::{Quantity, Ratio, Read, read_or};
use crate::scene::source::Document;
use plydrape::mold::{Mold, Plane};

/// Checks the keys of a plane.
pub(super) fn plane(table: &MoldTable, document: &Document) -> Result<Mold, Error> {
    let point = read_or(&table.point, [0.0; 3], document)?;

    // the normal is given, or follows from a tilt and its direction; a plane without both is level
    let normal = match (&table.normal, &table.tilt) {
        (Some(normal), None) => {
            if let Some(direction) = &table.tilt_direction {
                return Err(document.error(
                    direction.span.clone(),
                    "`tilt_direction` goes with `tilt`, not with `normal`",
                    "keep `normal`, or give `tilt` and `tilt_direction`",
                ));
            }
            let components = &normal.value.0;
            unit_normal(components, document)?.ok_or_else(|| {
                document.error(
                    normal.span.clone(),
                    "the normal of the mold does not point upwards",
                    "the ply comes from above: give a normal with z > 0, tilted less than 89.9 deg, as in [0, 0, 1]",
                )
            })?
        }
        (None, Some(tilt)) => {
            let angle = tilt.read(document)?;
            if angle.cos() < UPWARD {
                return Err(document.error(
                    tilt.span.clone(),
                    "the mold is (all but) a wall",
                    "expected a tilt below 89.9 deg",
                ));
            }
            // the plane rises in the direction of the tilt
            let climb = read_or(&table.tilt_direction, 0.0, document)?;
            [-angle.sin() * climb.cos(), -angle.sin() * climb.sin(), angle.cos()]
        }
        (Some(_), Some(tilt)) => {
            return Err(document.error(
                tilt.span.clone(),
                "the mold has a `normal` and a `tilt`",
                "keep one of the two",
            ));
        }
        (None, None) => match &table.tilt_direction {
            Some(direction) => {
                return Err(document.error(
                    direction.span.clone(),
                    "the mold has a `tilt_direction` but no `tilt`",
                    "add tilt = \"10 deg\"",
                ));
            }
            None => [0.0, 0.0, 1.0],
        },
    };
    Ok(Mold::Plane(Plane { point, normal }))
}

/// The unit vector, `None` if it does not point upwards.
fn unit_normal(
    [x, y, z]: &[Quantity<Ratio>; 3],
    document: &Document,
) -> Result<Option<[f64; 3]>, Error> {
    let [x, y, z] = [x, y, z].map(|n| n.read(document));
    let [x, y, z] = [x?, y?, z?];
    // Scaled by the largest component first, so that no square overflows.
    let largest = x.abs().max(y.abs()).max(z.abs());
    if largest < f64::MIN_POSITIVE {
        return Ok(None);
    }
    let [x, y, z] = [x / largest, y / largest, z / largest];
    let norm = x.hypot(y).hypot(z);
    let unit = [x / norm, y / norm, z / norm];
    Ok((unit[2] >= UPWARD).then_some(unit))
}
