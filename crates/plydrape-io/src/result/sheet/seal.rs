//! What `result.json` says of the file, so that no other one is taken for it.

use super::NAME;
use serde::{Deserialize, Serialize};
use std::io::{self, Read};

/// Name, length and check sum of a file beside the result.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SheetSeal {
    /// Name of the file.
    pub file: String,
    /// Its length (bytes).
    pub length: u64,
    /// CRC-32 of all its bytes, as in `crc32:0123abcd`.
    pub checksum: String,
}

impl SheetSeal {
    /// That of all that is left to read.
    pub(super) fn of(mut content: impl Read) -> io::Result<Self> {
        let mut sum = crc32fast::Hasher::new();
        let mut chunk = vec![0; 1 << 16];
        let mut length = 0;
        loop {
            match content.read(&mut chunk) {
                Ok(0) => break,
                Ok(count) => {
                    sum.update(&chunk[..count]);
                    length += count as u64;
                }
                Err(fault) if fault.kind() == io::ErrorKind::Interrupted => {}
                Err(fault) => return Err(fault),
            }
        }
        let checksum = format!("crc32:{:08x}", sum.finalize());
        Ok(SheetSeal { file: NAME.into(), length, checksum })
    }
}
