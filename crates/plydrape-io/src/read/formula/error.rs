//! What can be wrong with a formula, and what would be right.

use plydrape::mold::formula::FUNCTIONS;
use std::ops::Range;

/// Most bytes of a formula: its value is found anew at every point, with all of its operations.
pub(super) const MOST_TEXT: usize = 10_000;

/// Units that a formula might be taken to need.
const LENGTHS: [&str; 4] = ["mm", "cm", "m", "in"];

/// Why a text is no formula of x and y, and where in it.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{fault}")]
pub struct FormulaError {
    /// The bytes of the text at fault.
    pub at: Range<usize>,
    /// What is wrong there.
    pub fault: FormulaFault,
}

/// What is wrong with a formula.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum FormulaFault {
    /// There is nothing in it.
    #[error("the formula is empty")]
    Empty,
    /// A word that stands for nothing.
    #[error("`{0}` is neither x nor y, nor a function known here")]
    Name(String),
    /// A sign that has no meaning in a formula.
    #[error("`{0}` has no place in a formula")]
    Character(char),
    /// A number that is none.
    #[error("`{0}` is no number")]
    Number(String),
    /// Two values side by side.
    #[error("an operator is missing before `{0}`")]
    Operator(String),
    /// An operator without a value behind it.
    #[error("a value is missing after `{0}`")]
    Value(String),
    /// An operator without a value before it.
    #[error("a value is missing before `{0}`")]
    ValueBefore(char),
    /// A bracket without its partner.
    #[error("this bracket has no partner")]
    Bracket,
    /// A function without brackets behind it.
    #[error("`{0}` has no argument in brackets")]
    Argument(String),
    /// More text than any surface needs.
    #[error("the formula is {0} characters long; {MOST_TEXT} are the most")]
    Long(usize),
    /// Brackets in brackets in brackets.
    #[error("the formula is nested too deeply")]
    Depth,
}

impl FormulaFault {
    /// What would be right.
    #[must_use]
    pub fn help(&self) -> String {
        match self {
            FormulaFault::Empty | FormulaFault::Value(_) | FormulaFault::ValueBefore(_) => {
                "write a height over x and y in meters, as in 0.1*x^2 - y^2".into()
            }
            FormulaFault::Name(name) => {
                let names: Vec<&str> = FUNCTIONS.iter().map(|(name, _)| *name).collect();
                let hint = match name.as_str() {
                    "log" => "write `ln` or `log10`: ",
                    unit if LENGTHS.contains(&unit) => {
                        "a formula holds no units, all of it is in meters: "
                    }
                    "deg" => "a formula holds no units, angles are in radians: ",
                    "abs" | "min" | "max" => "a mold has no kinks: ",
                    "z" => "write only what z is equal to: ",
                    word if word.contains(['²', '³']) => "write powers as in x^2: ",
                    word if word.chars().all(|c| "xy0123456789.".contains(c)) => {
                        "write products with a star, as in x*y: "
                    }
                    _ => "",
                };
                format!("{hint}known are x, y, pi, {}", names.join(", "))
            }
            FormulaFault::Character(',') => "write a decimal point, as in 0.5*x".into(),
            FormulaFault::Character('=') => "write only what z is equal to".into(),
            FormulaFault::Character(_) => {
                "write + - * / ^, round brackets and numbers, as in 0.5*(x - y)^2".into()
            }
            FormulaFault::Number(_) => "write numbers as 0.05 or 5e-2".into(),
            FormulaFault::Operator(word) if LENGTHS.contains(&word.as_str()) => {
                "a formula holds no units: write all of it in meters, as in 0.01*x".into()
            }
            FormulaFault::Operator(_) => "write products with a star, as in 2*x".into(),
            FormulaFault::Bracket => "open and close as many round brackets".into(),
            FormulaFault::Argument(name) => format!("write {name}(…), as in {name}(x)"),
            FormulaFault::Long(_) => "give a height grid or a mesh instead".into(),
            FormulaFault::Depth => "write it with fewer brackets in brackets".into(),
        }
    }
}
