//! A mold written as a formula: from its text to the operations that the engine evaluates.

mod error;
mod parser;
#[cfg(test)]
mod tests;

use error::MOST_TEXT;
pub use error::{FormulaError, FormulaFault};

use plydrape::mold::formula::Formula;

/// Reads a height z = f(x, y), all in meters.
///
/// Known are numbers, `x`, `y`, `pi`, `+ - * / ^`, brackets and the functions `sqrt`, `exp`, `ln`, `log10`,
/// `sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `sinh`, `cosh` and `tanh`. Powers come first and from the right:
/// `-x^2` is −(x²), `2^3^2` is 2⁹. `**` is another way to write `^`.
///
/// # Errors
/// Where the text is no formula, and why.
pub fn read(text: &str) -> Result<Formula, FormulaError> {
    if text.len() > MOST_TEXT {
        return Err(FormulaError { at: 0..text.len(), fault: FormulaFault::Long(text.len()) });
    }
    let depth = || FormulaError { at: 0..text.len(), fault: FormulaFault::Depth };
    Formula::new(text, parser::program(text)?).ok_or_else(depth)
}
