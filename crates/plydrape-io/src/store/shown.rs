//! Text for a terminal: control characters, which would move the cursor or change its colors, are shown by their number.

use plydrape::planner::PlanRecord;
use plydrape::ply::{Direction, Grid, Ply};
use std::fmt::Write;
use std::path::Path;

/// The first control character of a text, if it has one; a line feed is one.
#[must_use]
pub fn control(text: &str) -> Option<char> {
    text.chars().find(|c| c.is_control())
}

/// A text whose control characters, but line feeds and tabs, are written as in `\\u{1b}`.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\n' | '\t' => out.push(c),
            c if c.is_control() => {
                let _ = write!(out, "{}", c.escape_unicode());
            }
            c => out.push(c),
        }
    }
    out
}

/// A name on one line: also line feeds and tabs are escaped.
#[must_use]
pub fn name(text: &str) -> String {
    escaped(text).replace('\n', "\\n").replace('\t', "\\t")
}

/// A path on one line.
#[must_use]
pub fn path(path: &Path) -> String {
    name(&path.to_string_lossy())
}

/// A text of the same length in bytes without control characters but line feeds and tabs, for a source that is shown with
/// places in it.
#[must_use]
pub fn blanked(text: &str) -> String {
    let plain = |c: char| match c {
        '\n' | '\t' => c,
        c if c.is_control() && c.len_utf8() == 1 => '?',
        // the other control characters take two bytes, as this sign does
        c if c.is_control() => '¿',
        c => c,
    };
    text.replace("\r\n", " \n").chars().map(plain).collect()
}

/// A value in this many digits.
#[must_use]
pub fn rounded(value: f64, digits: usize) -> f64 {
    format!("{value:.*e}", digits - 1).parse().unwrap_or(value)
}

/// A value in this many digits at most, without trailing zeros; below 0.001, and from `large`, by powers of ten.
#[must_use]
pub fn short(value: f64, digits: usize, large: f64) -> String {
    let rounded = rounded(value, digits);
    let plain = rounded == 0.0 || (1e-3..large).contains(&rounded.abs());
    if plain { rounded.to_string() } else { format!("{rounded:e}") }
}

/// A length (m) in millimeters, with three digits after the point at most.
#[must_use]
pub fn millimeters(length: f64) -> String {
    // a zero without a sign
    ((1e6 * length).round() / 1e3 + 0.0).to_string()
}

/// Words in a sentence, as in `a, b and c`.
pub(crate) fn listed(words: &[impl AsRef<str>]) -> String {
    let words: Vec<&str> = words.iter().map(AsRef::as_ref).collect();
    match words.as_slice() {
        [most @ .., last] if !most.is_empty() => format!("{} and {last}", most.join(", ")),
        _ => words.concat(),
    }
}

/// The first line of a text, at most this many characters of it, with an ellipsis where more follows.
#[must_use]
pub fn excerpt(text: &str, characters: usize) -> String {
    let line = text.lines().next().unwrap_or_default();
    let mut short: String = line.chars().take(characters).collect();
    if short.len() < text.trim_end().len() {
        short.push('…');
    }
    short
}

/// How far the ply lay from where it was planned, of a plan that was corrected for that.
#[must_use]
pub fn picked_up(plan: &PlanRecord) -> Option<String> {
    let offset = plan.picked_up.as_ref()?.offset;
    let [x, y] = offset.shift.map(millimeters);
    // six digits, and a zero without a sign
    let yaw = (1e6 * offset.yaw.to_degrees()).round() / 1e6 + 0.0;
    Some(format!("replanned for a ply that lay off by x {x} mm, y {y} mm, yaw {yaw} deg"))
}

/// What a ply is and how it is held, in a line.
#[must_use]
pub fn ply(ply: &Ply) -> String {
    let [a, b] = ply.cell.map(millimeters);
    let Some(cut) = &ply.cut else {
        let warp = match ply.warp {
            Direction::U => "u",
            Direction::V => "v",
        };
        let Grid { nu, nv } = ply.grid;
        return format!("{nu} × {nv} grippers, cells of {a} × {b} mm, warp along {warp}");
    };
    let drawn = cut.outline.moved(|uv| cut.drawn(uv));
    let [low, high] = drawn.bounds();
    let [width, height] = [0, 1].map(|n| millimeters(high[n] - low[n]));
    let holes = match drawn.holes().len() {
        0 => String::new(),
        1 => " with a hole".into(),
        holes => format!(" with {holes} holes"),
    };
    let across = if ply.warp == Direction::V { 90.0 } else { 0.0 };
    let warp = (cut.angle.to_degrees() + across).rem_euclid(180.0);
    let held = match ply.grid {
        Grid::NONE => format!("{} cups, {a} × {b} mm apart", ply.grippers()),
        Grid { nu, nv } => format!("{nu} × {nv} cups, {a} × {b} mm apart"),
    };
    let warp = (1e3 * warp).round() / 1e3;
    format!("cut to {width} × {height} mm{holes}, held by {held}, warp at {warp}° in the drawing")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A carriage return alone would let the next words write over those before it.
    #[test]
    fn a_blanked_text_keeps_its_length_and_no_control_character_but_line_feeds_and_tabs() {
        let text = "a\r\nb\rc\td\u{1b}e\u{85}f\n";
        assert_eq!(blanked(text), "a \nb?c\td?e¿f\n");
        assert_eq!(blanked(text).len(), text.len());
    }

    /// A length that is nearly zero has no sign.
    #[test]
    fn millimeters_have_three_digits_behind_the_point_at_most() {
        let shown = [0.1, 0.0123456, -0.002, -1e-8, 0.0].map(millimeters);
        assert_eq!(shown, ["100", "12.346", "-2", "0", "0"]);
    }

    #[test]
    fn the_last_of_several_words_follows_an_and() {
        let words = ["a", "b", "c"];
        assert_eq!([0, 1, 2, 3].map(|n| listed(&words[..n])), ["", "a", "a and b", "a, b and c"]);
    }

    /// Counted in characters, not in bytes.
    #[test]
    fn an_excerpt_ends_with_an_ellipsis_where_something_is_left_out() {
        assert_eq!(excerpt("µµµ\n", 3), "µµµ");
        assert_eq!(excerpt("µµµ", 2), "µµ…");
        assert_eq!(excerpt("µµ\nµ", 2), "µµ…");
    }
}
