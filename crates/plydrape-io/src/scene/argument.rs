//! A measured value from outside of a file, as on the command line.

use super::located::Located;
use super::quantity::{
    Acceleration, Angle, ArealMass, FlexuralRigidity, Force, ForcePerLength, Length, Measure,
    Quantity, Ratio, Time, Unchecked,
};
use super::source::Document;
use super::usual::Usual;
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

/// Reads a value in SI units, written as in a scene but without quotes: a plain number is SI and near what is usual, a unit
/// behind it converts. Infinity passes.
///
/// # Errors
/// The value, what is wrong with it and what would be right.
pub fn quantity(text: &str, measured: Measured, usual: &Usual) -> Result<f64, Error> {
    match measured {
        Measured::Length => read::<Length>(text, usual),
        Measured::Force => read::<Force>(text, usual),
        Measured::ForcePerLength => read::<ForcePerLength>(text, usual),
        Measured::FlexuralRigidity => read::<FlexuralRigidity>(text, usual),
        Measured::Ratio => read::<Ratio>(text, usual),
        Measured::Time => read::<Time>(text, usual),
        Measured::Angle => read::<Angle>(text, usual),
        Measured::ArealMass => read::<ArealMass>(text, usual),
        Measured::Acceleration => read::<Acceleration>(text, usual),
    }
}

fn read<M: Measure>(text: &str, usual: &Usual) -> Result<f64, Error> {
    // as a scene would hold it, so that the messages are the same
    let document = Document::new("", &format!("\"{text}\""));
    let argument: Quantity<M> =
        Located { value: Unchecked::of_argument(text), span: 0..document.text.len() };
    argument.si_or_infinite(&document, usual)
}

#[cfg(test)]
mod tests {
    use super::super::usual::{ANY, Span};
    use super::*;

    /// By the definition of the units.
    #[test]
    fn a_plain_number_is_si_and_a_unit_converts() {
        let read = |text, measured| quantity(text, measured, &ANY).unwrap();
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

    /// What is far from what is usual without a unit is believed with one.
    #[test]
    fn a_plain_number_is_near_what_is_usual() {
        let error = quantity("98", Measured::Length, &Span::USUAL).unwrap_err();
        assert_eq!(error.message(), "`98` would make a span of 98 m");
        assert!(error.help().starts_with("did you mean \"98 mm\"?"), "{}", error.help());
        assert_eq!(quantity("98 m", Measured::Length, &Span::USUAL).unwrap(), 98.0);
        assert_eq!(quantity("-0.098", Measured::Length, &Span::USUAL).unwrap(), -0.098);
        assert!(quantity("-98", Measured::Length, &Span::USUAL).is_err());
    }

    #[test]
    fn a_wrong_unit_is_refused_as_in_a_scene() {
        let error = quantity("98 kg", Measured::Length, &ANY).unwrap_err();
        assert_eq!(error.message(), "\"98 kg\" is a mass");
        assert!(error.help().contains("expected a length, e.g. \"98 mm\""));
        assert!(quantity("nan", Measured::Length, &ANY).is_err());
        assert!(quantity("", Measured::Length, &ANY).is_err());
        assert!(quantity("20 deg", Measured::Ratio, &ANY).is_err());
    }
}
