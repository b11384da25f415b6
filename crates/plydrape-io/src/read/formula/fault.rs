//! What can be wrong with a formula, and what would be right.

use crate::error::Fault;
use plydrape::mold::formula::FUNCTIONS;
use std::ops::Range;

/// Most bytes of a formula: its value is found anew at every point, with all of its operations.
pub(super) const MOST_TEXT: usize = 10_000;

/// Units that a formula might be taken to need.
const LENGTHS: [&str; 4] = ["mm", "cm", "m", "in"];
/// What a formula is.
const HEIGHT: &str = "write a height over x and y in meters, as in 0.1*x^2 - y^2";

/// What is wrong with a formula, and the bytes of its text at fault.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Misread {
    pub at: Range<usize>,
    pub fault: Fault,
}

/// A formula without text.
pub(super) fn empty() -> Fault {
    Fault::new("the formula is empty", HEIGHT)
}

/// A name that is not known.
pub(super) fn name(name: &str) -> Fault {
    let names: Vec<&str> = FUNCTIONS.iter().map(|(name, _)| *name).collect();
    let hint = match name {
        "log" => "write `ln` or `log10`: ",
        unit if LENGTHS.contains(&unit) => "a formula holds no units, all of it is in meters: ",
        "deg" => "a formula holds no units, angles are in radians: ",
        "abs" | "min" | "max" => "a mold has no kinks: ",
        "z" => "write only what z is equal to: ",
        word if word.contains(['²', '³']) => "write powers as in x^2: ",
        word if word.chars().all(|c| "xy0123456789.".contains(c)) => {
            "write products with a star, as in x*y: "
        }
        _ => "",
    };
    Fault::new(
        format!("`{name}` is neither x nor y, nor a function known here"),
        format!("{hint}known are x, y, pi, {}", names.join(", ")),
    )
}

/// A sign that has no meaning in a formula.
pub(super) fn character(sign: char) -> Fault {
    let help = match sign {
        ',' => "write a decimal point, as in 0.5*x",
        '=' => "write only what z is equal to",
        _ => "write + - * / ^, round brackets and numbers, as in 0.5*(x - y)^2",
    };
    Fault::new(format!("`{sign}` has no place in a formula"), help)
}

/// A number that cannot be read.
pub(super) fn number(written: &str) -> Fault {
    Fault::new(format!("`{written}` is no number"), "write numbers as 0.05 or 5e-2")
}

/// Two values side by side.
pub(super) fn operator(word: &str) -> Fault {
    let help = match LENGTHS.contains(&word) {
        true => "a formula holds no units: write all of it in meters, as in 0.01*x",
        false => "write products with a star, as in 2*x",
    };
    Fault::new(format!("an operator is missing before `{word}`"), help)
}

/// An operator without a value behind or before it: `place` says which.
pub(super) fn value(place: &str) -> Fault {
    Fault::new(format!("a value is missing {place}"), HEIGHT)
}

/// A bracket without its partner.
pub(super) fn bracket() -> Fault {
    Fault::new("this bracket has no partner", "open and close as many round brackets")
}

/// A function without brackets behind it.
pub(super) fn argument(name: &str) -> Fault {
    let help = format!("write {name}(…), as in {name}(x)");
    Fault::new(format!("`{name}` has no argument in brackets"), help)
}

/// More text than any surface needs.
pub(super) fn long(length: usize) -> Fault {
    let message = format!("the formula is {length} characters long; {MOST_TEXT} are the most");
    Fault::new(message, "give a height grid or a mesh instead")
}

/// Too many brackets in brackets.
pub(super) fn depth() -> Fault {
    Fault::new("the formula is nested too deeply", "write it with fewer brackets in brackets")
}
