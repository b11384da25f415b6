//! The part of a DXF text that outlines are made of.
//!
//! A DXF text is a sequence of pairs of lines, a group code and its value. What has no part in an outline is left out before the
//! library sees it: dates, previews, objects, extended data, entities that are no curves. Some of these make the library panic
//! where a file is damaged, and groups within groups would take all of its stack. Where a number is none, the library leaves out
//! the entity and all that follow it without a word, so numbers are checked here and entities are counted.

use super::INCOMPLETE;
use crate::error::Fault;
use std::collections::BTreeMap;

/// The variables of the header that are kept.
const VARIABLES: [&[u8]; 3] = [b"$ACADVER", b"$DWGCODEPAGE", b"$INSUNITS"];
/// The sections that are kept.
const SECTIONS: [&[u8]; 4] = [b"HEADER", b"TABLES", b"BLOCKS", b"ENTITIES"];
/// Texts, which name the pieces of a nest. All are kept as `TEXT`, with their type as their style: what the library does for the
/// others is not needed.
const TEXTS: [&[u8]; 3] = [b"TEXT", b"MTEXT", b"ATTRIB"];
/// What is kept of blocks and entities beside texts.
const ENTITIES: [&[u8]; 12] = [
    b"BLOCK",
    b"ENDBLK",
    b"LINE",
    b"ARC",
    b"CIRCLE",
    b"ELLIPSE",
    b"SPLINE",
    b"LWPOLYLINE",
    b"POLYLINE",
    b"VERTEX",
    b"SEQEND",
    b"INSERT",
];
/// The first group code of extended data.
const EXTENDED: i32 = 1000;
/// The group code of a comment.
const COMMENT: i32 = 999;
/// The group code that opens and closes groups of an application.
const GROUP: i32 = 102;

/// What is kept of a DXF text.
pub struct Kept<'a> {
    /// As DXF text.
    pub text: Vec<u8>,
    /// How many entities and vertices of polylines it has.
    pub entities: usize,
    /// How many entities of each type and layer are no curves.
    pub skipped: BTreeMap<[String; 2], usize>,
    /// The lines of the values in the file, counted from 1, each with its code and value.
    lines: Vec<(usize, &'a [u8], &'a [u8])>,
}

impl<'a> Kept<'a> {
    /// The line of the file, the code and the value that a line of the kept text has, counted from 1.
    pub fn origin(&self, line: usize) -> Option<(usize, String, String)> {
        let (line, code, value) = self.lines.get(line.checked_sub(1)? / 2)?;
        Some((*line, shown(code), shown(value)))
    }

    fn push(&mut self, line: usize, code: &'a [u8], value: &'a [u8]) {
        for part in [code, value] {
            self.text.extend_from_slice(part);
            self.text.push(b'\n');
        }
        self.lines.push((line, code, value));
    }
}

/// State of the reading of a text.
enum ReadingState<'a> {
    /// Between two sections.
    Outside,
    /// In a section.
    In(&'a [u8]),
}

/// What outlines are made of in a DXF text.
///
/// # Errors
/// [`Fault`] for what is no DXF text, or ends before its end.
pub fn keep(bytes: &[u8]) -> Result<Kept<'_>, Fault> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    for (start, kind) in [
        (&b"AutoCAD Binary DXF"[..], "a binary DXF file"),
        (b"AutoCAD DXB", "a DXB file"),
        (b"AC10", "a DWG file"),
    ] {
        if bytes.starts_with(start) {
            let message = format!("it is {kind}, not a DXF text");
            return Err(Fault::new(message, "save the drawing as ASCII DXF"));
        }
    }
    let mut kept =
        Kept { text: Vec::new(), entities: 0, skipped: BTreeMap::new(), lines: Vec::new() };
    let mut lines = bytes.split(|byte| *byte == b'\n').map(<[u8]>::trim_ascii_end).enumerate();
    let mut last = 1;
    let mut state = ReadingState::Outside;
    // whether what is under way is kept: a variable, a table, an entity
    let mut keeps = false;
    let mut is_text = false;
    // the type of an entity that is no curve, until its layer is known
    let mut skipped = None;
    let mut groups = 0_usize;
    let mut frozen = false;
    loop {
        let (Some((at, code)), Some((_, value))) = (lines.next(), lines.next()) else {
            let message = format!("the file ends at line {last} without its mark EOF");
            return Err(Fault::new(message, INCOMPLETE));
        };
        let line = at + 2;
        last = line;
        let number = std::str::from_utf8(code).ok().and_then(|text| text.trim().parse().ok());
        let Some(number): Option<i32> = number else {
            let (line, found) = (at + 1, shown(code));
            let message = format!(
                "line {line}: found `{found}`, expected a group code, which is a whole number"
            );
            return Err(Fault::new(message, INCOMPLETE));
        };
        let (code, name) = (code.trim_ascii(), value.trim_ascii());
        if number == COMMENT || number >= EXTENDED {
            continue;
        }
        if number == 0 {
            groups = 0;
            if std::mem::take(&mut frozen) {
                // the library does not read the flag; a layer whose color is negative is off
                kept.push(line, b"62", b"-7");
            }
        }
        match (&state, number, name) {
            (_, 0, b"EOF") => {
                kept.push(line, code, value);
                return Ok(kept);
            }
            (ReadingState::Outside, 0, b"SECTION") => keeps = false,
            (ReadingState::Outside, 2, section) => {
                state = ReadingState::In(section);
                if SECTIONS.contains(&section) {
                    kept.push(line, b"0", b"SECTION");
                    kept.push(line, code, value);
                }
            }
            (ReadingState::Outside, ..) => {}
            (ReadingState::In(section), 0, b"ENDSEC") => {
                if SECTIONS.contains(section) {
                    kept.push(line, code, value);
                }
                state = ReadingState::Outside;
                keeps = false;
            }
            (ReadingState::In(b"HEADER"), 9, variable) => {
                keeps = VARIABLES.contains(&variable);
                if keeps {
                    kept.push(line, code, value);
                }
            }
            (ReadingState::In(b"HEADER"), ..) if keeps => {
                check(line, number, code, value)?;
                kept.push(line, code, value);
            }
            // the table of layers alone
            (ReadingState::In(b"TABLES"), 0, b"TABLE") => keeps = false,
            (ReadingState::In(b"TABLES"), 2, b"LAYER") if !keeps => {
                keeps = true;
                kept.push(line, b"0", b"TABLE");
                kept.push(line, code, value);
            }
            (ReadingState::In(b"TABLES"), 0, b"ENDTAB") => {
                if keeps {
                    kept.push(line, code, value);
                }
                keeps = false;
            }
            (ReadingState::In(b"TABLES"), ..) if keeps => {
                push_outside(&mut kept, &mut groups, (line, number, code, value))?;
                let flags = std::str::from_utf8(name).ok().and_then(|text| text.parse().ok());
                frozen |= number == 70 && flags.is_some_and(|flags: i64| flags & 1 == 1);
            }
            (ReadingState::In(b"BLOCKS" | b"ENTITIES"), 0, entity) => {
                is_text = TEXTS.contains(&entity);
                keeps = is_text || ENTITIES.contains(&entity);
                if is_text {
                    kept.push(line, code, TEXTS[0]);
                    // its own type is where the name of its style would be
                    kept.push(line, b"7", entity);
                } else if keeps {
                    kept.push(line, code, value);
                }
                if keeps {
                    kept.entities +=
                        usize::from(!matches!(entity, b"BLOCK" | b"ENDBLK" | b"SEQEND"));
                }
                skipped = (is_text || !keeps).then(|| shown(entity));
            }
            (ReadingState::In(b"BLOCKS" | b"ENTITIES"), 8, layer) if skipped.is_some() => {
                let kind = skipped.take().unwrap_or_default();
                let layer = String::from_utf8_lossy(layer).into_owned();
                *kept.skipped.entry([kind, layer]).or_default() += 1;
                if keeps {
                    kept.push(line, code, value);
                }
            }
            // of a text its words, its place, its plane and whether it is on the paper
            (ReadingState::In(b"BLOCKS" | b"ENTITIES"), ..) if is_text => match number {
                1 => kept.push(line, code, value),
                10 | 20 | 30 | 67 | 210 | 220 | 230 | GROUP => {
                    push_outside(&mut kept, &mut groups, (line, number, code, value))?;
                }
                _ => {}
            },
            (ReadingState::In(b"BLOCKS" | b"ENTITIES"), ..) if keeps => {
                push_outside(&mut kept, &mut groups, (line, number, code, value))?;
            }
            _ => {}
        }
    }
}

/// Keeps a pair of a layer, a block or an entity, if it says something of its shape and belongs to no group of an application.
fn push_outside<'a>(
    kept: &mut Kept<'a>,
    groups: &mut usize,
    (line, number, code, value): (usize, i32, &'a [u8], &'a [u8]),
) -> Result<(), Fault> {
    match (number, value.trim_ascii()) {
        (GROUP, b"}") => *groups = groups.saturating_sub(1),
        (GROUP, _) => *groups += 1,
        // names, lengths and angles, flags, counts, normals
        (0 | 2 | 8 | 10..=59 | 60..=79 | 90..=99 | 210..=239, _) if *groups == 0 => {
            check(line, number, code, value)?;
            kept.push(line, code, value);
        }
        _ => {}
    }
    Ok(())
}

/// Refuses a value that is no number where its group code asks for one.
fn check(line: usize, number: i32, code: &[u8], value: &[u8]) -> Result<(), Fault> {
    let text = std::str::from_utf8(value).unwrap_or_default().trim();
    let is_right = match number {
        // short numbers are written as lengths by some programs
        10..=79 | 210..=239 => text.parse().is_ok_and(|value: f64| value.is_finite()),
        90..=99 => text.parse::<i32>().is_ok(),
        _ => true,
    };
    if is_right {
        return Ok(());
    }
    Err(not_a_value(line, &shown(code), &shown(value)))
}

/// A value that is not what its group code asks for.
pub fn not_a_value(line: usize, code: &str, found: &str) -> Fault {
    Fault::new(format!("line {line}: group code {code} cannot be {found:?}"), INCOMPLETE)
}

/// A line as messages show it.
fn shown(line: &[u8]) -> String {
    const MOST: usize = 40;
    let text = String::from_utf8_lossy(&line[..line.len().min(4 * MOST)]);
    let text = text.trim();
    let mut shown: String = text.chars().take(MOST).collect();
    if shown.len() < text.len() {
        shown.push('…');
    }
    shown.escape_debug().to_string()
}
