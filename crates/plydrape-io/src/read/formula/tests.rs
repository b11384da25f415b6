//! What a formula says, and its derivatives against central differences.

use super::fault::{self, Misread};
use super::formula as parse;
use crate::error::Fault;
use plydrape::mold::formula::Formula;
use std::ops::Range;

fn read(text: &str) -> Formula {
    parse(text).unwrap_or_else(|e| panic!("{text}: {e:?}"))
}

fn refusal(text: &str) -> (Range<usize>, Fault) {
    let Misread { at, fault } = parse(text).unwrap_err();
    (at, fault)
}

/// By the rules of algebra; a minus before a power does not belong to its base.
#[test]
fn powers_come_before_signs_and_signs_before_products() {
    for (text, value) in [
        ("-x^2", -9.0),
        ("(-x)^2", 9.0),
        ("2^-2", 0.25),
        ("-2^-2", -0.25),
        ("2^3^2", 512.0),
        ("2*-x^2", -18.0),
        ("8/2/2", 2.0),
        ("10-3-2", 5.0),
        ("2-x*y/3+1", -2.0),
        ("--x", 3.0),
        ("+x", 3.0),
        ("x**2 · y − 1", 44.0),
        ("1e-3*x + 2.5E2*y", 1250.003),
        (".5*x", 1.5),
        ("sin(pi/6)^2", 0.25),
        ("sqrt(x^2 + (y-1)^2)", 5.0),
        ("(x)^0.5", 3f64.sqrt()),
        ("x^y", 243.0),
        ("0.05", 0.05),
    ] {
        let found = read(text).at(3.0, 5.0).z;
        assert!((found - value).abs() < 1e-12 * value.abs().max(1.0), "{text}: {found}");
    }
}

/// Every operation and function once, at a point that is not special.
#[test]
fn derivatives_are_those_of_central_differences() {
    let formulas = [
        "1.004*x + 1.089*y - 3.667*x^2 - 4.4*x*y - 3.75*y^2 + 3.086*x^3 + 8.889*x^2*y + 4.321*y^3",
        "sqrt(1 + x*y) - exp(-x^2/(1+y)) / (2 + y^3)",
        "ln(2 + x)*log10(3 + y*x) + sin(3*x)*cos(2*y) - tan(x*y)",
        "asin(x*y) + acos(x - y) + atan(5*x*y) + sinh(x)*cosh(y) + tanh(x + 2*y)",
        "(1 + x)^2.5 + (1 + x)^(1 + y) - (2 + x)^-3 + (x + y)^1 * (x - y)^0",
    ];
    let (x, y) = (0.317, 0.219);
    for text in formulas {
        let formula = read(text);
        let height = formula.at(x, y);
        let h = 1e-5;
        let [right, left] = [formula.at(x + h, y), formula.at(x - h, y)];
        let [up, down] = [formula.at(x, y + h), formula.at(x, y - h)];
        let rate = |a: f64, b: f64| (a - b) / (2.0 * h);
        let expected = [
            (height.gradient[0], rate(right.z, left.z)),
            (height.gradient[1], rate(up.z, down.z)),
            (height.hessian[0], rate(right.gradient[0], left.gradient[0])),
            (height.hessian[1], rate(right.gradient[1], left.gradient[1])),
            (height.hessian[1], rate(up.gradient[0], down.gradient[0])),
            (height.hessian[2], rate(up.gradient[1], down.gradient[1])),
        ];
        for (found, difference) in expected {
            // truncation of the difference h² f‴ and rounding 1e-16/h
            assert!(
                (found - difference).abs() < 1e-8 * (1.0 + found.abs()),
                "{text}: {found} {difference}"
            );
        }
    }
}

#[test]
fn powers_and_products_are_smooth_at_the_origin() {
    for text in ["x^2 - y^2", "x*y", "x^3 + y^4", "0.1 - x^2*y^2", "(x + y)^3", "(x + y)^2.5"] {
        assert!(read(text).at(0.0, 0.0).is_finite(), "{text}");
    }
}

/// The hyperbolic tangent is 1 long before sinh and cosh are too large for a number.
#[test]
fn the_hyperbolic_tangent_levels_off() {
    let height = read("tanh(x)").at(1e3, 0.0);
    assert_eq!((height.z, height.gradient[0], height.hessian[0]), (1.0, 0.0, 0.0));
}

#[test]
fn where_a_formula_has_no_slope_is_found() {
    let square = [[-1.0, 1.0], [-1.0, 1.0]];
    assert_eq!(read("sqrt(x^2 + y^2)").undefined_within(square), Some([0.0, 0.0]));
    assert_eq!(read("1/(y - 1)").undefined_within(square), Some([-1.0, 1.0]));
    assert!(read("sqrt(0.5 - x)").undefined_within(square).is_some());
    assert_eq!(read("x^2 + y").undefined_within(square), None);
}

#[test]
fn a_fault_is_found_at_its_place() {
    assert_eq!(refusal("0.1*z"), (4..5, fault::name("z")));
    assert_eq!(refusal("x + u^2"), (4..5, fault::name("u")));
    assert_eq!(refusal("xy"), (0..2, fault::name("xy")));
    assert_eq!(refusal("2x"), (1..2, fault::operator("x")));
    assert_eq!(refusal("x (y)"), (2..3, fault::operator("(")));
    assert_eq!(refusal("x + "), (2..3, fault::value("after `+`")));
    assert_eq!(refusal("x + * y"), (2..3, fault::value("after `+`")));
    assert_eq!(refusal("* y"), (0..1, fault::value("before `*`")));
    assert_eq!(refusal("()"), (0..1, fault::value("after `(`")));
    assert_eq!(refusal("2*(x + y"), (2..3, fault::bracket()));
    assert_eq!(refusal("x + y)"), (5..6, fault::bracket()));
    assert_eq!(refusal("sin x"), (0..3, fault::argument("sin")));
    assert_eq!(refusal("0,1*x"), (1..2, fault::character(',')));
    assert_eq!(refusal("z = x"), (0..1, fault::name("z")));
    assert_eq!(refusal("1e999"), (0..5, fault::number("1e999")));
    assert_eq!(refusal("."), (0..1, fault::number(".")));
    assert_eq!(refusal("1.2.3*x"), (0..5, fault::number("1.2.3")));
    assert_eq!(refusal("  "), (0..2, fault::empty()));
    for deep in ["(", "-", "x^", "1 + 2*sin("] {
        assert_eq!(refusal(&deep.repeat(900)).1, fault::depth(), "{deep}");
    }
}

#[test]
fn deep_brackets_have_room_on_the_stack() {
    let nested = format!("{}x{}", "1 + 2*(".repeat(30), ")".repeat(30));
    let value = read(&nested).at(1.0, 0.0).z;
    // every bracket takes v to 1 + 2 v
    assert_eq!(value, 2f64.powi(31) - 1.0);
    let too_deep = format!("{}x{}", "1 + 2*(".repeat(60), ")".repeat(60));
    assert_eq!(refusal(&too_deep).1, fault::depth());
}

proptest::proptest! {
    /// No text makes the reader panic, be it random or nearly a formula.
    #[test]
    fn any_text_is_read_or_refused(text in "\\PC*", near in "([0-9.e]{1,3}|x|y|pi|sin|ln|[-+*/^() ,²−]){0,12}") {
        for text in [text, near] {
            match parse(&text) {
                Ok(formula) => {
                    let _ = formula.at(0.3, -0.2);
                }
                Err(error) => {
                    proptest::prop_assert!(text.get(error.at.clone()).is_some());
                    proptest::prop_assert!(!error.fault.help.is_empty());
                }
            }
        }
    }
}
