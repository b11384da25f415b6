//! Values as JSON text.
//!
//! JSON has no NaN and no infinity, and `serde_json` writes either as `null`, which a reader takes for
//! "not known". So every number is looked at before the text is made; a value that is infinite by
//! meaning, such as the axial stiffness of an inextensible ply, is turned into `null` by its own type.

pub(crate) mod finite;

use serde::Serialize;

/// Why a value has no JSON text.
#[derive(Debug, thiserror::Error)]
pub enum JsonError {
    /// A number that is NaN or infinite.
    #[error(
        "`{key}` is {value}, which a result file cannot hold; this is a fault of plydrape, please report it"
    )]
    NotFinite {
        /// Where it is, as in `steps[3].measures.slack_mm.value`.
        key: String,
        /// The number.
        value: f64,
    },
    /// The value cannot be written for another reason.
    #[error("the result cannot be written as JSON: {0}")]
    Serde(#[from] serde_json::Error),
}

/// JSON text of any value whose numbers are all finite, with a line feed.
///
/// # Errors
/// [`JsonError::NotFinite`] if any number is NaN or infinite.
pub fn of<T: Serialize>(value: &T) -> Result<String, JsonError> {
    finite::check(value)?;
    let mut text = serde_json::to_string(value)?;
    text.push('\n');
    Ok(text)
}
