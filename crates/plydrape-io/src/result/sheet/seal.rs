//! What `result.json` says of the file, so that no other one is taken for it.

use super::NAME;
use crate::store::manifest::Stamp;
use serde::{Deserialize, Serialize};
use std::io::{self, Read};

/// Name, length and check sum of a file beside the result.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SheetSeal {
    /// Name of the file.
    pub file: String,
    /// Length (bytes).
    pub length: u64,
    /// CRC-32 of all its bytes, as in `crc32:0123abcd`.
    pub checksum: String,
}

impl SheetSeal {
    /// The seal of all that is left to read.
    pub(super) fn read(content: impl Read) -> io::Result<Self> {
        let Stamp { crc32, length } = Stamp::read(content)?;
        Ok(SheetSeal { file: NAME.into(), length, checksum: format!("crc32:{crc32:08x}") })
    }
}
