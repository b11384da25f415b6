//! Texts in UTF-16, and with the line ends of old Macintoshes, as those of today.

use std::borrow::Cow;

/// Bytes of a beginning that tell a text from a file that begins with zeros.
const HEAD: usize = 64;

/// The text of bytes that are UTF-16, by their mark or because every other byte of their beginning is zero; within, `None` where it is damaged.
pub(crate) fn wide(bytes: &[u8]) -> Option<Option<String>> {
    let zeros = |odd: usize| {
        let head = &bytes[..bytes.len().min(HEAD)];
        bytes.len() >= 4
            && bytes.len().is_multiple_of(2)
            && head.iter().enumerate().all(|(n, byte)| (*byte == 0) == (n % 2 == odd))
    };
    let (body, little) = match bytes {
        // UTF-32
        [0xff, 0xfe, 0, 0, ..] => return Some(None),
        [0xff, 0xfe, body @ ..] => (body, true),
        [0xfe, 0xff, body @ ..] => (body, false),
        _ if zeros(1) => (bytes, true),
        _ if zeros(0) => (bytes, false),
        _ => return None,
    };
    let (pairs, rest) = body.as_chunks::<2>();
    let units: Vec<u16> = pairs
        .iter()
        .map(|pair| if little { u16::from_le_bytes(*pair) } else { u16::from_be_bytes(*pair) })
        .collect();
    let text = String::from_utf16(&units).ok();
    Some(text.filter(|text| rest.is_empty() && !text.contains('\0')))
}

/// A text of the same length in which every line ends in a line feed.
pub(crate) fn line_feeds(text: String) -> String {
    let mut ends = text.char_indices().filter(|(_, c)| *c == '\r').map(|(at, _)| at);
    if ends.all(|at| text.as_bytes().get(at + 1) == Some(&b'\n')) {
        return text;
    }
    let mut rest = text.chars().peekable();
    let mut ended = String::with_capacity(text.len());
    while let Some(c) = rest.next() {
        let alone = c == '\r' && rest.peek() != Some(&'\n');
        ended.push(if alone { '\n' } else { c });
    }
    ended
}

/// The bytes of a text file as UTF-8 whose lines end in line feeds; what is no such text stays as it is.
pub(crate) fn unicode(bytes: &[u8]) -> Cow<'_, [u8]> {
    if let Some(text) = wide(bytes) {
        return text.map_or(Cow::Borrowed(bytes), |text| line_feeds(text).into_bytes().into());
    }
    // no line of a file of today is so long, and no binary mesh without a zero
    let old = bytes.contains(&b'\r') && !bytes.contains(&b'\n') && !bytes.contains(&0);
    match std::str::from_utf8(bytes) {
        Ok(text) if old => line_feeds(text.to_owned()).into_bytes().into(),
        _ => bytes.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_reads_the_same_in_every_encoding() {
        let text = "v 0 0 0\nv 1 0 0\n";
        let wide: Vec<u8> =
            format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        for bytes in [text.as_bytes(), &wide, text.replace('\n', "\r").as_bytes()] {
            assert_eq!(&*unicode(bytes), text.as_bytes());
        }
        let binary = [0_u8, 13, 255, 254, 13, 1];
        assert_eq!(&*unicode(&binary), &binary);
        assert_eq!(line_feeds("a\r\nb\r".into()), "a\r\nb\n");
    }
}
