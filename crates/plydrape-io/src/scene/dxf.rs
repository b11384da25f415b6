//! The outline of a ply from a drawing.

use super::drawing::OutlineChoice;
use super::error::{Document, SceneError};
use super::located::Located;
use plydrape::ply::Outline;
use std::path::Path;

/// Reads the file that an outline names.
pub(super) fn outline(
    key: &Located<OutlineChoice>,
    document: &Document,
    _base: &Path,
) -> Result<Outline, SceneError> {
    Err(document.error(key.span.clone(), "drawings are not read yet", "give points"))
}
