//! When the pads let go of the ply.

use super::file::{OrderKey, ReleaseTable};
use super::located::Located;
use super::quantity::read_or;
use super::source::Document;
use crate::Error;
use plydrape::layup::{Model, Release, ReleaseOrder};

/// Checks the table `[release]` of a scene that this model drapes; `on_mold` says whether it has a mold.
pub(super) fn release(
    table: &Located<ReleaseTable>,
    model: Model,
    on_mold: bool,
    document: &Document,
) -> Result<Release, Error> {
    let Located { value: ReleaseTable { order, dwell }, span } = table;
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
    let dwell = read_or(dwell, 0.0, document)?;
    Ok(Release::new(order.map_or(ReleaseOrder::End, OrderKey::into), dwell))
}
