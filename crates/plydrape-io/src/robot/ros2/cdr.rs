//! A message as bytes: plain CDR, little endian, every number aligned to its own size.
//!
//! The four bytes before it name that encoding (RTPS 2.5, 10.2.1); alignment is counted after them.

use crate::Error;
use serde::Serialize;

/// `CDR_LE`, no options.
const ENCAPSULATION: [u8; 4] = [0, 1, 0, 0];

/// The bytes of a message.
pub(super) fn bytes<T: Serialize>(message: &T) -> Result<Vec<u8>, Error> {
    let mut bytes = ENCAPSULATION.to_vec();
    let encoded = cdr_encoding::to_vec::<T, byteorder::LittleEndian>(message)
        .map_err(|fault| Error::Internal(format!("cannot encode a ROS 2 message: {fault}")))?;
    bytes.extend(encoded);
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::message::{Header, Time};
    use super::*;

    /// Text has its length with the closing zero; a double then starts at the next multiple of eight.
    #[test]
    fn text_ends_in_zero_and_doubles_are_aligned() {
        #[derive(Serialize)]
        struct Message {
            header: Header,
            value: f64,
        }
        let header = Header { stamp: Time { sec: 1, nanosec: 2 }, frame_id: "mold".into() };
        let bytes = bytes(&Message { header, value: 0.1 }).unwrap();
        let mut expected = vec![0, 1, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 5, 0, 0, 0];
        expected.extend(b"mold\0");
        // 4 + 4 + 4 + 5 = 17 bytes stand before the double
        expected.extend([0; 7]);
        expected.extend(0.1_f64.to_le_bytes());
        assert_eq!(bytes, expected);
    }
}
