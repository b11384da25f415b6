//! A measured value from outside of a file, as on the command line.

use super::located::Located;
use super::quantity::{
    Acceleration, Angle, ArealMass, FlexuralRigidity, Force, ForcePerLength, Length, Measure,
    Quantity, Ratio, Time, Unchecked,
};
use super::source::Document;
use crate::Error;

/// What a value measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measured {
    /// A length (m).
    Length,
    /// A force (N).
    Force,
    /// A force per length (N/m).
    ForcePerLength,
    /// A flexural rigidity (N·m²).
    FlexuralRigidity,
    /// A ratio without a unit, as a slope.
    Ratio,
    /// A time (s).
    Time,
    /// An angle (rad).
    Angle,
    /// A mass per area (kg/m²).
    ArealMass,
    /// An acceleration (m/s²).
    Acceleration,
}

/// Reads a value in SI units, written as in a scene but without quotes: a plain number is SI, a unit
/// behind it converts. Infinity passes.
///
/// # Errors
/// The value, what is wrong with it and what would be right.
pub fn quantity(text: &str, measured: Measured) -> Result<f64, Error> {
    match measured {
        Measured::Length => read::<Length>(text),
        Measured::Force => read::<Force>(text),
        Measured::ForcePerLength => read::<ForcePerLength>(text),
        Measured::FlexuralRigidity => read::<FlexuralRigidity>(text),
        Measured::Ratio => read::<Ratio>(text),
        Measured::Time => read::<Time>(text),
        Measured::Angle => read::<Angle>(text),
        Measured::ArealMass => read::<ArealMass>(text),
        Measured::Acceleration => read::<Acceleration>(text),
    }
}

fn read<M: Measure>(text: &str) -> Result<f64, Error> {
    // as a scene would hold it, so that the messages are the same
    let document = Document::new("", &format!("\"{text}\""));
    let argument: Quantity<M> =
        Located { value: Unchecked::of_argument(text), span: 0..document.text.len() };
    argument.si_or_infinite(&document)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By the definition of the units.
    #[test]
    fn a_plain_number_is_si_and_a_unit_converts() {
        let read = |text, measured| quantity(text, measured).unwrap();
        assert_eq!(read("0.098", Measured::Length), 0.098);
        assert_eq!(read("98 mm", Measured::Length), 0.098);
        assert_eq!(read("-10mm", Measured::Length), -0.01);
        assert_eq!(read("100 kN", Measured::Force), 1e5);
        assert_eq!(read("inf", Measured::Force), f64::INFINITY);
        assert_eq!(read("9e-6 N m^2", Measured::FlexuralRigidity), 9e-6);
        assert_eq!(read("3.08 N/m", Measured::ForcePerLength), 3.08);
        assert_eq!(read("-0.3", Measured::Ratio), -0.3);
        assert_eq!(read("1.5h", Measured::Time), 5400.0);
        assert_eq!(read("5 min", Measured::Time), 300.0);
    }

    #[test]
    fn a_wrong_unit_is_refused_as_in_a_scene() {
        let error = quantity("98 kg", Measured::Length).unwrap_err();
        assert_eq!(error.message(), "\"98 kg\" is a mass");
        assert!(error.help().contains("a length is wanted, e.g. \"98 mm\""));
        assert!(quantity("nan", Measured::Length).is_err());
        assert!(quantity("", Measured::Length).is_err());
        assert!(quantity("20 deg", Measured::Ratio).is_err());
    }
}
