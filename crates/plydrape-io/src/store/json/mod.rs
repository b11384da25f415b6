//! Values as JSON text.
//!
//! JSON has no NaN and no infinity, and `serde_json` writes either as `null`, which a reader takes for
//! "not known". So every number is looked at before the text is made; a value that is infinite by
//! meaning, such as the axial stiffness of an inextensible ply, is turned into `null` by its own type.

pub(crate) mod finite;

use crate::Error;
use serde::Serialize;

/// JSON text of any value whose numbers are all finite, with a line feed.
///
/// # Errors
/// [`Error::NotFinite`] if any number is NaN or infinite.
pub fn to_text<T: Serialize>(value: &T) -> Result<String, Error> {
    finite::check(value)?;
    let mut text = serde_json::to_string(value).map_err(Error::json)?;
    text.push('\n');
    Ok(text)
}
