//! Values of options, with their units.

use crate::failure::Failure;
use plydrape_io::scene::usual::Usual;
use plydrape_io::scene::{Measured, quantity};

/// A value of an option in SI units, a plain number near what is usual, and within a range.
pub fn value(
    option: &str,
    text: &str,
    measured: Measured,
    usual: &Usual,
    [low, high]: [f64; 2],
    help: &str,
) -> Result<f64, Failure> {
    let value = quantity(text, measured, usual).map_err(|error| Failure::Refused {
        message: format!("{option} {}", error.message()),
        help: error.help().into(),
    })?;
    let fault = if value == 0.0 && low > 0.0 {
        "is zero"
    } else if value < 0.0 && low >= 0.0 {
        "is negative"
    } else if value < low {
        "is too small"
    } else if value > high {
        "is too large"
    } else {
        return Ok(value);
    };
    Err(refused(option, text, fault, help))
}

/// An option whose value is refused.
pub fn refused(option: &str, text: &str, fault: &str, help: &str) -> Failure {
    Failure::Refused { message: format!("{option} \"{text}\" {fault}"), help: help.into() }
}
