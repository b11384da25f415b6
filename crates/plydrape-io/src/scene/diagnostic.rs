//! Diagnostics of the TOML reader and of serde, rewritten in the terms of a scene and with a remedy.

use super::choice::MIDDLE;
use super::read::BACKSLASHES;
use super::source::{Document, excerpt};
use super::tree::{CHOICE_EXPECTED, Fault};
use super::units::CURLY;
use crate::Error;
use crate::store::file_kind::edits;
use std::ops::Range;
use toml::de::DeTable;

/// A key by another name.
struct OtherName {
    /// What it is called elsewhere, in small letters.
    words: &'static [&'static str],
    /// Name in a scene, and what is to be known beside.
    name: &'static str,
    beside: &'static str,
    /// The table that is proposed where the key is written in a table that does not have it; none where it could be any.
    table: Option<&'static str>,
}

const fn other(
    words: &'static [&'static str],
    name: &'static str,
    beside: &'static str,
    table: Option<&'static str>,
) -> OtherName {
    OtherName { words, name, beside, table }
}

/// Names by which data sheets and other programs call keys. A key has one name in scenes, and these propose it.
const OTHER_NAMES: [OtherName; 11] = [
    other(
        &["pad_diameter", "cup_diameter"],
        "pad_radius",
        ", half of the diameter",
        Some("grippers"),
    ),
    other(&["cup_radius"], "pad_radius", "", Some("grippers")),
    other(&["pitch"], "cell", ", the fabric between neighbors", Some("ply")),
    other(&["pitch"], "spacing", ", the distance of neighbors at the start", None),
    other(&["center", "centre"], "middle", "", None),
    other(&["center", "centre"], "position", ", the place of the mold's origin", None),
    other(
        &["areal_mass", "areal_weight", "grammage"],
        "mass",
        ", as in \"380 g/m^2\"",
        Some("ply.material"),
    ),
    other(&["mass"], "areal_mass", "", None),
    other(&["sigma", "std"], "deviation", ", the standard deviation", None),
    other(&["diameter"], "radius", ", half of the diameter", None),
    other(&["shape", "type"], "kind", "", None),
];

/// Words by which other programs call a choice, and the choice.
const OTHER_WORDS: [(&[&str], &str, &str); 4] = [
    (&["stl", "obj", "inp", "triangles"], "mesh", ", with its `file` and its `unit`"),
    (&["csv", "heights", "grid"], "height-grid", ", with its `file`"),
    (&["flat"], "plane", ""),
    (&["dome", "hemisphere"], "sphere", ", with its `radius`"),
];

/// A diagnostic of the TOML reader or of serde as an [`Error`].
pub(super) fn scene_error(document: &Document, fault: impl Into<Fault>) -> Error {
    let Fault { message, span } = fault.into();
    let mut span = span.unwrap_or(0..0);
    let text = message.trim();
    let (head, expected) = match text.split_once(", expected ") {
        Some((head, expected)) => (head, expected),
        None => (text, ""),
    };
    let quoted = between_ticks(head);
    let (message, help) = if head.starts_with("unknown field") {
        unknown_key(quoted, &every_tick(expected))
    } else if head.starts_with("missing field") {
        span = header(document, span);
        let table = document.excerpt(&span);
        let place = if table.starts_with('[') { format!(" in {table}") } else { String::new() };
        (format!("the key `{quoted}` is missing{place}"), hint(quoted))
    } else if head.starts_with("unknown variant") {
        let known = every_tick(expected);
        let word = quoted.to_lowercase();
        let other = OTHER_WORDS
            .iter()
            .find(|(words, choice, _)| words.contains(&word.as_str()) && known.contains(choice));
        let suggestion = match other {
            Some((_, choice, beside)) => format!("write \"{choice}\"{beside}; "),
            None => suggestion(quoted, &known),
        };
        (
            format!("\"{}\" is no choice here", excerpt(quoted)),
            match known.as_slice() {
                [only] => format!("the only choice is \"{only}\""),
                _ => format!("{suggestion}the choices are {}", listed(&known, '"')),
            },
        )
    } else if let Some(found) = head.strip_prefix("invalid length ") {
        (
            match found {
                "1" => "one value is given here".into(),
                _ => format!("{found} values are given here"),
            },
            remedy(expected),
        )
    } else if head.starts_with("invalid value: string") {
        (format!("{} is no choice here", document.quoted(&span)), remedy(expected))
    } else if text == CHOICE_EXPECTED {
        let remedy = "expected a choice in double quotes, as in kind = \"plane\"";
        (format!("{} is {}", document.quoted(&span), kind_of(document, &span)), remedy.into())
    } else if head.starts_with("invalid type") || head.starts_with("invalid value") {
        let mut help = remedy(expected);
        if MIDDLE.contains(&document.excerpt(&span).trim_matches(['"', '\''])) {
            help += "; words for the middle belong to `origin` in [grippers], which puts them above the target, and to `seed` in [target]";
        }
        (format!("{} is {}", document.quoted(&span), kind_of(document, &span)), help)
    } else if text.starts_with("duplicate key") {
        (
            format!("the key `{}` is given twice", document.excerpt(&span)),
            "keep one of the two".into(),
        )
    } else if let Some(error) = curly(document, span.start) {
        return error;
    } else {
        let fault = document.text.get(span.start..).unwrap_or_default();
        let before = document.text.get(..span.start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        // `\U` and `\x` begin escapes of digits, as the folder `Users` and a file `x.stl` do
        let is_escape = ["escape", "unicode", "hexadecimal"].iter().any(|word| text.contains(word))
            && line.contains('"');
        let is_decimal_comma =
            fault.starts_with(',') && before.ends_with(|c: char| c.is_ascii_digit());
        let remedy = if is_decimal_comma {
            "write a decimal point, as in 0.098"
        } else if text.starts_with("string values must be quoted") {
            let value = unquoted(document, &span);
            return document.error(
                span,
                format!("{value} is no number, and a text needs quotes"),
                match value.contains(['\\', '"']) {
                    true => {
                        "write a path in single quotes, as in file = 'C:\\molds\\new.stl'".into()
                    }
                    false => format!("write \"{}\"", value.trim_matches('`')),
                },
            );
        } else if is_escape {
            return document.error(
                span,
                "this backslash begins no escape that TOML knows",
                format!("{BACKSLASHES} in single quotes, as in file = 'C:\\molds\\new.stl'"),
            );
        } else {
            "write `key = value` under a `[table]`, text in double quotes, arrays in square brackets"
        };
        (format!("this is not TOML: {}", text.replace('\n', ", ")), remedy.into())
    };
    document.error(span, message, help)
}

/// The refusal of a line whose text is in curly quotes; `None` for other lines.
fn curly(document: &Document, at: usize) -> Option<Error> {
    let before = document.text.get(..at)?;
    let start = before.rfind('\n').map_or(0, |end| end + 1);
    let line = document.text.get(start..)?.lines().next()?;
    let refused = |span: Range<usize>, right: &str| {
        let written = document.excerpt(&span);
        document.error(
            span,
            format!("`{written}` has curly quotes, as text processors make them"),
            format!("write {right}, with straight quotes"),
        )
    };
    // a value that begins with one, up to the one that fits
    let begins = |(at, letter): &(usize, char)| {
        let value = line[..*at].trim_end().chars().next_back();
        CURLY.contains(*letter) && value.is_none_or(|letter| "=,[{".contains(letter))
    };
    if let Some((open, letter)) = line.char_indices().find(begins) {
        let inner = &line[open + letter.len_utf8()..];
        let closes = |close: char| match letter {
            '‘' | '’' | '‚' | '‛' => "‘’'".contains(close),
            _ => close == '"' || CURLY.contains(close) && !"‘’‚‛".contains(close),
        };
        let (length, close) = inner.char_indices().find(|(_, close)| closes(*close))?;
        let text = inner[..length].trim();
        // a path with backslashes is copied as it is in single quotes
        let quote = if text.contains(['\\', '"']) { '\'' } else { '"' };
        let end = open + letter.len_utf8() + length + close.len_utf8();
        return Some(refused(start + open..start + end, &format!("{quote}{text}{quote}")));
    }
    let straight = |letter| match letter {
        _ if !CURLY.contains(letter) => letter,
        '‘' | '’' | '‚' | '‛' => '\'',
        _ => '"',
    };
    let right: String = line.chars().map(straight).collect();
    let is_right = right != line && DeTable::parse(&right).is_ok();
    is_right.then(|| refused(start..start + line.len(), right.trim()))
}

/// The value without its quotes at a span, in ticks: it ends with its line, its array or its table.
fn unquoted(document: &Document, span: &Range<usize>) -> String {
    let text = document.text.get(span.start..).unwrap_or_default();
    let end = text.find(['\n', ',', ']', '}', '#']).unwrap_or(text.len());
    let words = text.get(..end).unwrap_or_default();
    format!("`{}`", excerpt(words.trim()))
}

/// What a value is, in TOML's terms, from its first character.
fn kind_of(document: &Document, span: &Range<usize>) -> &'static str {
    let text = document.text.get(span.clone()).unwrap_or_default();
    match text.trim_start().chars().next() {
        Some('"' | '\'') => "a text",
        Some('[') if text.starts_with("[[") => "an array of arrays or tables",
        // A header `[name]` and an array look alike but for what precedes them.
        Some('[') if starts_a_line(document, span.start) => "a table",
        Some('[') => "an array",
        Some('{') => "a table",
        Some('t' | 'f') => "a switch, true or false",
        Some(c) if c.is_ascii_digit() && is_date(text) => "a date or a time",
        Some('0'..='9') if text.contains('.') => "a number with a fraction",
        Some('+' | '-' | '0'..='9' | 'i' | 'n') => "a number",
        _ => "of another kind",
    }
}

fn is_date(text: &str) -> bool {
    text.contains(':') || text.matches('-').count() == 2
}

fn starts_a_line(document: &Document, at: usize) -> bool {
    let before = document.text.get(..at).unwrap_or_default();
    before.rsplit('\n').next().is_none_or(|line| line.trim().is_empty())
}

/// `expected a length, e.g. "98 mm"` from `a length, e.g. "98 mm"`.
fn remedy(expected: &str) -> String {
    match expected.split_once(", e.g. ") {
        _ if expected == "a string" => "expected a text in double quotes".into(),
        _ if expected == "a sequence" => {
            "expected a list: write [[name]], with two brackets, over each of its tables".into()
        }
        Some((what, example)) => format!("expected {what}, e.g. {example}"),
        None => format!("expected {expected}"),
    }
}

/// The header of the table at a span: its first line.
fn header(document: &Document, span: Range<usize>) -> Range<usize> {
    let text = document.text.get(span.clone()).unwrap_or_default();
    let length = text.find('\n').unwrap_or(text.len());
    span.start..span.start + length
}

fn unknown_key(key: &str, known: &[&str]) -> (String, String) {
    let message = format!("`{}` is no key here", excerpt(key));
    if key == "material" && known.contains(&"flexural_rigidity") {
        let help = "a material file cannot name another material: give its mass and rigidity";
        return (message, help.into());
    }
    if key == "landing_contact" && known.contains(&"position") {
        return (message, "it is `position` now, which judges sheet and catenaries alike".into());
    }
    let word = key.to_lowercase();
    let others = OTHER_NAMES.iter().filter(|other| other.words.contains(&word.as_str()));
    let here = others.clone().find(|other| known.contains(&other.name));
    let elsewhere = others.clone().find_map(|other| Some((other, other.table?)));
    let suggestion = match (here, elsewhere) {
        (Some(other), _) => format!("write `{}`{}; ", other.name, other.beside),
        (None, Some((other, table))) => {
            format!("write `{}` in [{table}]{}; ", other.name, other.beside)
        }
        (None, None) => suggestion(key, known),
    };
    let help = format!("{suggestion}the keys here are {}", listed(known, '`'));
    (message, help)
}

/// What to write for a key that is missing.
pub(super) fn hint(key: &str) -> String {
    match key {
        "ply" => "add a table [ply] with grippers, cell and material".into(),
        "grippers" => "say how many grippers there are along u and v: grippers = [4, 2]".into(),
        "cell" => {
            "give the fabric length between grippers along u and v: cell = [\"100 mm\", \"100 mm\"]"
                .into()
        }
        "material" => {
            "name a shipped material, a .toml file, or give a table: material = \"krogh2018\""
                .into()
        }
        "mass" => "give the mass per length or per area: mass = \"314 g/m^2\"".into(),
        "kind" => "say which: kind = \"plane\", \"sphere\", \"mesh\" or another for a mold; kind = \"straight\", \"hold\" or \"file\" for a motion".into(),
        "name" => "give it a name that reports can call it by: name = \"clamp\"".into(),
        "preset" => "name a cell: preset = \"usual\" or \"ideal\", or a file of your own".into(),
        "on" => "say what it moves with: on = \"pad\", \"stem\" or \"flange\"".into(),
        "radius" => "give the radius of the cylinder: radius = \"15 mm\"".into(),
        "to" => "say where along z the cylinder ends: to = \"40 mm\"".into(),
        "size" => "give the sides of the box along x, y and z: size = [\"1 m\", \"0.5 m\", \"20 mm\"]".into(),
        _ => format!("add `{key} = …`"),
    }
}

/// `did you mean …? ` for the known word within a third of its letters, else nothing.
fn suggestion(word: &str, known: &[&str]) -> String {
    let nearest = known.iter().map(|candidate| (edits(word, candidate), *candidate)).min();
    match nearest {
        Some((distance, candidate)) if distance <= ((1 + word.chars().count()) / 3).max(1) => {
            format!("did you mean `{candidate}`? ")
        }
        _ => String::new(),
    }
}

fn listed(words: &[&str], quote: char) -> String {
    let quoted: Vec<String> = words.iter().map(|w| format!("{quote}{w}{quote}")).collect();
    quoted.join(", ")
}

fn between_ticks(text: &str) -> &str {
    text.split('`').nth(1).unwrap_or_default()
}

fn every_tick(text: &str) -> Vec<&str> {
    text.split('`').skip(1).step_by(2).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What a message proposes in place of curly quotes is TOML, and the text that was meant.
    #[test]
    fn a_text_in_curly_quotes_is_proposed_in_straight_ones() {
        for (line, right) in [
            ("height = “75 mm”", "write \"75 mm\", with"),
            ("height = „75 mm“", "write \"75 mm\", with"),
            ("height = «75 mm»", "write \"75 mm\", with"),
            ("height = “75 mm\"", "write \"75 mm\", with"),
            ("height = \"75 mm”", "write height = \"75 mm\", with"),
            ("height = '75 mm’", "write height = '75 mm', with"),
            ("kind = ‘plane’", "write \"plane\", with"),
            ("title = “A, B # c: Bob’s ply”", "write \"A, B # c: Bob’s ply\", with"),
            ("file = “C:\\molds\\new.stl”", "write 'C:\\molds\\new.stl', with"),
            ("cell = [“100 mm”, “90 mm”]", "write \"100 mm\", with"),
            ("cell = [\"100 mm”, \"90 mm”]", "write cell = [\"100 mm\", \"90 mm\"], with"),
            ("table = { a = “x” }", "write \"x\", with"),
            ("height = 75 mm # “this”", "write \"75 mm\""),
        ] {
            let text = format!("title = \"“this” is well\"\n{line}\n");
            let document = Document::new("scene", &text);
            let fault = DeTable::parse(&text).unwrap_err();
            let error = scene_error(&document, fault);
            assert!(error.help().starts_with(right), "{line}: {}", error.help());
        }
    }

    #[test]
    fn the_nearest_word_is_the_one_with_the_fewest_edits() {
        assert_eq!(suggestion("sped", &["spacing", "speed"]), "did you mean `speed`? ");
        assert_eq!(suggestion("colour", &["spacing", "speed"]), "");
    }
}
