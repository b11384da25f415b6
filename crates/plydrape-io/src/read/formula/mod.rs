//! A mold written as a formula: from its text to the operations that the engine evaluates.

mod fault;
mod parser;
#[cfg(test)]
mod tests;

use crate::Error;
use crate::error::Diagnostic;
use fault::{MOST_TEXT, Misread};
use plydrape::mold::formula::Formula;

/// Reads a height z = f(x, y), all in meters.
///
/// Known are numbers, `x`, `y`, `pi`, `+ - * / ^`, brackets and the functions `sqrt`, `exp`, `ln`, `log10`,
/// `sin`, `cos`, `tan`, `asin`, `acos`, `atan`, `sinh`, `cosh` and `tanh`. Powers come first and from the right:
/// `-x^2` is −(x²), `2^3^2` is 2⁹. `**` is another way to write `^`.
///
/// # Errors
/// [`Error::Scene`] with the place in the text, what is wrong there and what would be right.
pub fn read(text: &str) -> Result<Formula, Error> {
    formula(text).map_err(|Misread { at, fault }| {
        let whole = Diagnostic::new("formula", fault.message, fault.help);
        Diagnostic { text: text.into(), span: Some(at), ..whole }.into()
    })
}

fn formula(text: &str) -> Result<Formula, Misread> {
    let whole = |fault| Misread { at: 0..text.len(), fault };
    if text.len() > MOST_TEXT {
        return Err(whole(fault::long(text.len())));
    }
    Formula::new(text, parser::program(text)?).ok_or_else(|| whole(fault::depth()))
}
