//! The deck's lines: keywords, data of a few numbers a line, comments.

use crate::store::shown::rounded;
use std::fmt::Write;

/// Most entries of a data line.
const ENTRIES: usize = 16;

/// A deck under way.
#[derive(Debug, Default)]
pub(super) struct Deck {
    pub text: String,
}

impl Deck {
    /// A comment.
    pub fn comment(&mut self, text: &str) {
        self.line(format_args!("** {text}").to_string().trim_end());
    }

    /// A line as it is.
    pub fn line(&mut self, text: &str) {
        self.text.push_str(text);
        self.text.push('\n');
    }

    /// A data line of numbers.
    pub fn numbers(&mut self, values: impl IntoIterator<Item = f64>) {
        let values: Vec<String> = values.into_iter().map(number).collect();
        self.line(&values.join(", "));
    }

    /// A data line: a number that names something, then coordinates.
    pub fn node(&mut self, id: usize, place: [f64; 3]) {
        let [x, y, z] = place.map(number);
        // a String takes all that is written to it
        let _ = writeln!(self.text, "{id}, {x}, {y}, {z}");
    }

    /// Data of integers, up to 16 a line.
    pub fn list(&mut self, ids: &[usize]) {
        for part in ids.chunks(ENTRIES) {
            let part: Vec<String> = part.iter().map(usize::to_string).collect();
            self.line(&part.join(", "));
        }
    }

    /// A node set.
    pub fn node_set(&mut self, name: &str, nodes: &[usize]) {
        self.line(&format!("*NSET, NSET={name}"));
        self.list(nodes);
    }
}

/// A number in ten digits, which both programs read: a field may be 20 characters wide.
pub(super) fn number(value: f64) -> String {
    // −0 is 0
    format!("{:?}", rounded(value, 10) + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// What is written reads back to ten digits and fits a field of 20 characters.
        #[test]
        fn numbers_fit_their_field(value in -1e12..1e12_f64, shift in -30..5_i32) {
            let value = value * 10_f64.powi(shift);
            let text = number(value);
            let read: f64 = text.parse().unwrap();
            prop_assert!((read - value).abs() <= 1e-9 * value.abs());
            prop_assert!(text.len() <= 20, "{text}");
        }
    }
}
