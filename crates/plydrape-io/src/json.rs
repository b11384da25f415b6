//! The result as JSON text.
//!
//! JSON has no NaN and no infinity, and `serde_json` writes either as `null`, which a reader takes for
//! "not known". So every number is looked at before the text is made; a value that is infinite by
//! meaning, such as the axial stiffness of an inextensible ply, is turned into `null` by its own type.

use super::finite;
use crate::result::ResultFile;
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

/// The whole result file as one line of JSON with a line feed; numbers in their shortest exact form.
///
/// Its check sum is that of the same text with no check sum in it.
///
/// # Errors
/// [`JsonError::NotFinite`] if any number is NaN or infinite.
pub fn text(result: &ResultFile) -> Result<String, JsonError> {
    let text = of(result)?;
    let written = format!("{CHECKSUM}\"{}\"", result.checksum);
    let Some((head, tail)) = text.split_once(&written) else { return Ok(text) };
    let sum = checksum(head, tail);
    Ok([head, CHECKSUM, "\"", &sum, "\"", tail].concat())
}

/// The key of the check sum, as it is written.
pub(super) const CHECKSUM: &str = "\"checksum\":";

/// The check sum of a result file, from the text before its key and the text behind its value.
pub(super) fn checksum(head: &str, tail: &str) -> String {
    let mut sum = crc32fast::Hasher::new();
    for part in [head, CHECKSUM, "\"\"", tail.trim_end()] {
        sum.update(part.as_bytes());
    }
    format!("crc32:{:08x}", sum.finalize())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    fn refused_key(result: &ResultFile) -> Option<String> {
        match text(result) {
            Err(JsonError::NotFinite { key, .. }) => Some(key),
            _ => None,
        }
    }

    /// The key in the error is the path that a reader of the JSON would follow.
    #[test]
    fn a_number_that_is_not_finite_is_refused_by_its_key() {
        let mut result = sample::draped(4, 2, 3);
        result.steps[1].catenaries[1].spans[0].slopes[1] = f64::NAN;
        assert_eq!(
            refused_key(&result).as_deref(),
            Some("steps[1].catenaries[1].spans[0].slopes[1]")
        );
        let mut result = sample::draped(4, 2, 3);
        result.steps[1].catenaries[0].spans[0].force = Some(f64::INFINITY);
        assert_eq!(refused_key(&result).as_deref(), Some("steps[1].catenaries[0].spans[0].H_N"));
        let mut result = sample::draped(4, 2, 3);
        result.scene.settings.axial_stiffness = f64::NAN;
        assert_eq!(refused_key(&result).as_deref(), Some("scene.settings.axial_stiffness"));
    }

    /// An inextensible ply has EA = ∞, which the file says as null.
    #[test]
    fn infinite_axial_stiffness_is_null() {
        let mut result = sample::draped(4, 2, 2);
        result.scene.settings.axial_stiffness = f64::INFINITY;
        let read: serde_json::Value = serde_json::from_str(&text(&result).unwrap()).unwrap();
        assert!(read["scene"]["settings"]["axial_stiffness"].is_null());
        assert_eq!(read["format"], "plydrape-result");
    }

    /// Shortest exact form: what is read back is the number that was written, to the last bit.
    #[test]
    fn numbers_survive_to_the_last_bit() {
        let mut result = sample::draped(2, 1, 1);
        result.steps[0].time = 0.1 + 0.2;
        let read: serde_json::Value = serde_json::from_str(&text(&result).unwrap()).unwrap();
        assert_eq!(read["steps"][0]["time"].as_f64(), Some(0.1 + 0.2));
    }
}
