//! Titles of columns: names and units.
//!
//! Names are compared in small letters, without accents, bars and numbers behind them, so that `Deplacement`, `Déplacement_` and
//! `DEPLACEMENT 1` are one. A unit follows the name, as in `Force (N)`, `Kraft [N]`, `force / N`, `Kraft in N`, `Weg, mm` and
//! `force_N`.

use super::Column;
use crate::scene::units;

impl Column {
    /// Whether a title, as [`title`] has it, is one of this column.
    pub(super) fn is_called(&self, title: &str) -> bool {
        let bare = title.trim_end_matches(|c: char| c.is_ascii_digit() || c == ' ');
        let ends = |word: &&str| {
            bare.strip_suffix(*word).is_some_and(|rest| rest.is_empty() || rest.ends_with(' '))
        };
        self.names.iter().any(|name| *name == title || (name.len() > 1 && *name == bare))
            || self.last_words.iter().any(ends)
            || self.endings.iter().any(|ending| bare.ends_with(ending))
    }
}

/// Most bytes of a unit behind a name: a line without titles may be long, and each of its words is tried.
const LONGEST_UNIT: usize = 64;

/// The name of a column, and its unit where the title says one.
pub(in crate::scene) fn title(text: &str) -> (String, Option<&str>) {
    let text = text.trim();
    let known = |unit: &&str| {
        unit.len() <= LONGEST_UNIT && !unit.trim().is_empty() && units::unit(unit).is_ok()
    };
    let brackets = last_group(text).map(|(name, unit, rest)| (format!("{name} {rest}"), unit));
    let after = |mark: &str| {
        let (name, unit) = text.split_once(mark)?;
        Some((name.to_owned(), unit))
    };
    // the longest end that is a unit
    let behind = |mark: char| {
        let mut pairs = text.match_indices(mark).map(|(at, _)| (&text[..at], &text[at + 1..]));
        let (name, unit) = pairs.find(|(_, unit)| known(unit))?;
        Some((name.to_owned(), unit))
    };
    let found = brackets
        .or_else(|| after(" / "))
        .or_else(|| after(" in "))
        .or_else(|| behind('_'))
        .or_else(|| behind(','))
        .or_else(|| behind(' '))
        .or_else(|| after("/"));
    match found {
        Some((name, unit)) => (words(&name), Some(bare(unit))),
        None => (words(text), None),
    }
}

/// The words of a name in small letters, between single spaces.
pub(in crate::scene) fn words(name: &str) -> String {
    let mut found = String::new();
    let mut before = ' ';
    for c in name.chars().filter(|c| !COMBINING.contains(c)) {
        // `TensileExtension` has two words
        if !c.is_alphanumeric() || (c.is_uppercase() && before.is_lowercase()) {
            found.push(' ');
        }
        if c.is_alphanumeric() {
            found.extend(c.to_lowercase().map(plain));
        }
        before = c;
    }
    let words: Vec<&str> = found.split_whitespace().collect();
    words.join(" ")
}

/// Accents that are characters of their own.
const COMBINING: std::ops::RangeInclusive<char> = '\u{300}'..='\u{36f}';

/// A small letter without its accent.
fn plain(c: char) -> char {
    match c {
        'à'..='å' => 'a',
        'ç' => 'c',
        'è'..='ë' => 'e',
        'ì'..='ï' => 'i',
        'ñ' => 'n',
        'ò'..='ö' | 'ø' => 'o',
        'ù'..='ü' => 'u',
        'ý' | 'ÿ' => 'y',
        other => other,
    }
}

/// What is before, in and behind the last brackets that are in no others, as `N/(m rad)` is in `Shear [N/(m rad)]`.
fn last_group(text: &str) -> Option<(&str, &str, &str)> {
    let (mut depth, mut start, mut found) = (0_usize, 0, None);
    for (at, c) in text.char_indices() {
        match c {
            '(' | '[' => {
                if depth == 0 {
                    start = at;
                }
                depth += 1;
            }
            ')' | ']' if depth > 0 => {
                depth -= 1;
                if depth == 0 {
                    found = Some((&text[..start], &text[start + 1..at], &text[at + 1..]));
                }
            }
            _ => {}
        }
    }
    found
}

/// A unit without brackets around it.
pub(super) fn bare(text: &str) -> &str {
    let mut text = text.trim();
    while let Some(("", inner, "")) = last_group(text) {
        text = inner.trim();
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Units have brackets of their own, within those around them, and lose only the latter.
    #[test]
    fn a_unit_keeps_its_own_brackets() {
        for (text, name, unit) in [
            ("Shear slope (N/(m rad))", "shear slope", "N/(m rad)"),
            ("Force [kN]", "force", "kN"),
            ("Force (Channel 1) (N)", "force channel 1", "N"),
            ("Bending [gf/(cm deg)]", "bending", "gf/(cm deg)"),
        ] {
            assert_eq!(title(text), (name.to_string(), Some(unit)), "{text}");
        }
        assert_eq!(
            [bare("(N/(m rad))"), bare("N/(m rad)"), bare("[mm]")],
            ["N/(m rad)", "N/(m rad)", "mm"]
        );
    }
}
