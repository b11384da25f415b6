//! When the pads let go of the ply.

use super::file::{OrderKey, ReleaseTable, SceneKeys};
use super::located::Located;
use super::quantity::read_or;
use super::source::Document;
use crate::Error;
use plydrape::layup::{Model, Release, ReleaseOrder};
use plydrape::scene::Cell;

/// Checks the table `[release]` of a scene that this model drapes; `on_mold` says whether it has a mold. What it does not say is that of the
/// cell. Pads that pick a ply up let go of it at the end, with the table or without it.
pub(super) fn release(
    file: &SceneKeys,
    cell: &Cell,
    model: Model,
    on_mold: bool,
    document: &Document,
) -> Result<Option<Release>, Error> {
    // without the table, pads let go as in the cell, or at the end if they picked the ply up
    let Some(Located { value: ReleaseTable { order, dwell }, span }) = &file.release else {
        let picked_up = file.pick_up.is_some().then_some(ReleaseOrder::End);
        let order = cell.release.or(picked_up).filter(|_| on_mold);
        return Ok(order.map(|order| Release::new(order, cell.dwell)));
    };

    // pads can let go of a sheet, and where there is a mold on which it lies
    if model == Model::Catenaries {
        return Err(document.error(
            span.clone(),
            "catenaries hang from grippers that hold them: they cannot follow a ply that pads let go of",
            "drape it with the sheet, as kind = \"sheet\" in [model] does, or leave out [release]",
        ));
    }
    if !on_mold {
        return Err(document.error(
            span.clone(),
            "the scene has no mold on which the ply could lie when the pads let go of it",
            "say what the mold is in [mold], or leave out [release]",
        ));
    }

    // the order of the scene, or else that of the cell, or else at the end
    let dwell = read_or(dwell, cell.dwell, document)?;
    let order = order.map(OrderKey::into).or(cell.release).unwrap_or(ReleaseOrder::End);
    Ok(Some(Release::new(order, dwell)))
}
