//! `plydrape span` as a user calls it: numbers, keys and refusals.

use crate::common::{command, one_line, text};
use std::process::Output;

/// The strip of the model's description: 100 mm of the paper's ply over 98 mm.
const STRIP: [(&str, &str); 4] =
    [("--run", "98 mm"), ("--length", "100 mm"), ("--weight", "3.08014"), ("--rigidity", "9e-6")];

/// `plydrape span` with the strip's options, some of them replaced or added, and flags.
fn span(changes: &[(&str, &str)], flags: &[&str]) -> Output {
    let mut options = STRIP.to_vec();
    for change in changes {
        options.retain(|(name, _)| *name != change.0);
        options.push(*change);
    }
    let options = options.iter().flat_map(|(name, value)| [*name, *value]);
    command().arg("span").args(options).args(flags).output().unwrap()
}

/// The object that `--json` prints.
fn json(changes: &[(&str, &str)]) -> serde_json::Value {
    let output = span(changes, &["--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(output.stderr.is_empty());
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &serde_json::Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} in {value}"))
}

fn numbers(value: &serde_json::Value, key: &str) -> Vec<f64> {
    let array = value[key].as_array().unwrap();
    array.iter().map(|v| v.as_f64().unwrap()).collect()
}

/// Small-sag values solved by others, printed to five digits: half a unit of the last one.
#[test]
fn forces_and_sags_are_those_of_the_reference_strips() {
    let zero = [("--slope-start", "0"), ("--slope-end", "0")];
    let cases = [
        (json(&[]), 0.41728, 8.7022),
        (json(&zero), 0.32795, 8.8647),
        (json(&[("--run", "90 mm")]), 0.15086, 19.4616),
    ];
    for (got, force, sag) in cases {
        assert!((number(&got, "H_N") - force).abs() <= 5e-6, "{got}");
        assert!((number(&got, "sag_mm") - sag).abs() <= 5e-5, "{got}");
    }
}

/// EI = 0: the parabola z = −q x (ℓ − x)/2H has sag qℓ²/8H, end slopes ∓s, s = qℓ/2H, and the arc
/// length ℓ(√(1+s²) + asinh(s)/s)/2.
#[test]
fn limp_span_is_the_parabola() {
    let got = json(&[("--rigidity", "0")]);
    let (force, run, load) = (number(&got, "H_N"), 0.098, 3.08014);
    let slope: f64 = load * run / (2.0 * force);
    let length = 0.5 * run * (slope.hypot(1.0) + slope.asinh() / slope);
    assert!((length - 0.1).abs() < 1e-12, "{length}");
    let sag = load * run * run / (8.0 * force) * 1e3;
    assert!((number(&got, "sag_mm") - sag).abs() < 1e-12 * sag);
    assert!((number(&got, "slope_start") + slope).abs() < 1e-12);
    assert!((number(&got, "slope_end") - slope).abs() < 1e-12);
    for (x, z) in numbers(&got, "x_mm").iter().zip(numbers(&got, "z_mm")) {
        let x = x * 1e-3;
        let parabola = -load * x * (run - x) / (2.0 * force) * 1e3;
        assert!((z - parabola).abs() < 1e-12 * sag, "{x} {z}");
    }
}

/// The documented command, units and all; its slope is exact to the last digit.
#[test]
fn json_has_the_documented_keys_and_eleven_stations() {
    let got = json(&[("--rise", "0"), ("--slope-start", "free"), ("--slope-end", "0.5")]);
    let mut keys: Vec<&String> = got.as_object().unwrap().keys().collect();
    keys.sort();
    assert_eq!(keys, ["H_N", "sag_mm", "slope_end", "slope_start", "state", "x_mm", "z_mm"]);
    assert!((number(&got, "slope_end") - 0.5).abs() < 1e-14);
    let (x, z) = (numbers(&got, "x_mm"), numbers(&got, "z_mm"));
    assert_eq!((x.len(), z.len()), (11, 11));
    for (n, x) in x.iter().enumerate() {
        assert!((x - 9.8 * n as f64).abs() < 1e-12);
    }
    assert_eq!([z[0], z[10]].map(|z| (z * 1e9).round()), [0.0, 0.0]);
    assert_eq!(got["state"], "hanging");
}

/// A mirror image: the span from its other end, with rise and slopes of the other sign.
#[test]
fn a_span_and_its_mirror_image_have_the_same_force() {
    let up = json(&[("--rise", "10mm"), ("--slope-start", "-0.3")]);
    let down = json(&[("--rise", "-10mm"), ("--slope-end", "0.3")]);
    let (a, b) = (number(&up, "H_N"), number(&down, "H_N"));
    assert!((a - b).abs() < 1e-9 * a, "{a} {b}");
    assert!((number(&up, "slope_end") + number(&down, "slope_start")).abs() < 1e-9);
}

#[test]
fn plain_numbers_are_si_and_units_convert() {
    let plain = [
        ("--run", "0.098"),
        ("--length", "0.1"),
        ("--weight", "3.08014 N/m"),
        ("--rigidity", "9 mN mm m"),
        ("--axial-stiffness", "inf"),
    ];
    assert_eq!(number(&json(&plain), "H_N").to_bits(), number(&json(&[]), "H_N").to_bits());
}

#[test]
fn a_stiff_span_is_in_compression() {
    let got = json(&[("--rigidity", "9e-2")]);
    assert_eq!(got["state"], "in compression");
    assert!(number(&got, "H_N") < 0.0);
    let shown = text(&span(&[("--rigidity", "9e-2")], &[]).stdout);
    assert!(shown.contains("compression"), "{shown}");
}

/// Chord = length with EA = ∞ is straight; beyond it the overstretch is reported, and nothing fails.
#[test]
fn a_taut_inextensible_span_is_straight_and_without_a_force() {
    let rise = ("--rise", "21 mm");
    for (run, state) in [("100 mm", "straight"), ("102 mm", "overstretched")] {
        let got = json(&[("--run", run), ("--slope-end", "0.1")]);
        assert!(got["H_N"].is_null(), "{got}");
        assert_eq!(got["state"], state);
        assert_eq!(number(&got, "sag_mm"), 0.0);
        let got = json(&[("--run", run), rise]);
        let chord = number(&got, "slope_end");
        assert_eq!(number(&got, "slope_start"), chord);
        assert!((numbers(&got, "z_mm")[10] - 21.0).abs() < 1e-12);
    }
    let shown = text(&span(&[("--run", "102 mm"), ("--slope-end", "0.1")], &[]).stdout);
    for part in [
        "overstretched",
        "none: a straight ply",
        "2 mm (2 %) longer than the ply",
        "cannot take the slopes asked for",
        "--axial-stiffness",
    ] {
        assert!(shown.contains(part), "{part} in\n{shown}");
    }
}

/// EA·strain = 100 kN · 2 % along the chord.
#[test]
fn an_overstretched_span_is_held_by_its_axial_stiffness() {
    let got = json(&[("--run", "102 mm"), ("--axial-stiffness", "100 kN")]);
    assert_eq!(got["state"], "overstretched");
    assert!((number(&got, "H_N") - 2000.0).abs() < 1e-3, "{got}");
}

#[test]
fn text_shows_force_sag_slopes_moments_a_table_and_the_shape() {
    let output = span(&[("--slope-end", "0.5")], &[]);
    assert_eq!(output.status.code(), Some(0));
    let shown = text(&output.stdout);
    for part in ["horizontal force", "sag", "slopes", "moments", "z mm", "(held)", "(free)"] {
        assert!(shown.contains(part), "{part} in\n{shown}");
    }
    let stations = shown.lines().filter(|l| l.split_whitespace().count() == 5);
    assert!(stations.count() >= 11, "{shown}");
    let drawn = |c: char| ('\u{2801}'..='\u{28ff}').contains(&c);
    assert!(shown.contains(drawn), "{shown}");
    assert!(shown.lines().all(|l| l.chars().count() <= 80), "{shown}");
}

/// Each refusal: exit 2, nothing on standard output, and the option, its value and a remedy.
#[test]
fn bad_values_are_refused_with_option_value_and_remedy() {
    let cases = [
        ("--run", "0", "is zero", "a length from"),
        ("--run", "-98mm", "is negative", "a length from"),
        ("--run", "nan", "is not a number", "expected a length"),
        ("--run", "inf", "is too large", "a length from"),
        ("--run", "98 kg", "is a mass", "expected a length"),
        ("--run", "98 MM", "is no unit known", "did you mean `mm`?"),
        ("--run", "98,5 mm", "decimal comma", "decimal point"),
        ("--run", "", "cannot be read", "expected a length"),
        ("--run", "1e-9 m", "is too small", "1 um"),
        ("--run", "98", "would make a span of 98 m", "did you mean \"98 mm\"?"),
        ("--length", "0", "is zero", "a length from"),
        ("--length", "-1", "is negative", "a length from"),
        ("--weight", "0", "is zero", "a weight per length"),
        ("--weight", "-3", "is negative", "a weight per length"),
        ("--weight", "314 g/m", "is a mass per length", "a force per length"),
        ("--rigidity", "-9e-6", "is negative", "a flexural rigidity"),
        ("--rigidity", "9e-6 N m", "is a moment", "a flexural rigidity"),
        ("--rigidity", "1e-30", "is too small", "or 0"),
        ("--rise", "1e9 m", "is too large", "1000 runs"),
        ("--rise", "-inf", "is too small", "1000 runs"),
        ("--slope-end", "20 deg", "is an angle", "write free"),
        ("--slope-start", "loose", "cannot be read", "write free"),
        ("--slope-end", "inf", "is too large", "write free"),
        ("--slope-end", "nan", "is not a number", "write free"),
        ("--axial-stiffness", "0", "is zero", "a force"),
        ("--axial-stiffness", "-1 kN", "is negative", "a force"),
        ("--axial-stiffness", "nan", "is not a number", "a force"),
    ];
    for (option, value, fault, remedy) in cases {
        let output = span(&[(option, value)], &[]);
        let shown = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{option} {value}\n{shown}");
        assert!(output.stdout.is_empty(), "{option} {value}");
        let words = one_line(&output.stderr);
        for part in [option, value, fault, remedy, "help:"] {
            assert!(words.contains(part), "{option} {value}: {part} in\n{shown}");
        }
    }
}

#[test]
fn a_slope_cannot_be_held_without_bending_stiffness() {
    for option in ["--slope-start", "--slope-end"] {
        let output = span(&[("--rigidity", "0"), (option, "0.2")], &["--json"]);
        assert_eq!(output.status.code(), Some(2));
        let shown = text(&output.stderr);
        assert!(shown.contains(option) && shown.contains("0.2"), "{shown}");
        assert!(shown.contains("rigidity above zero"), "{shown}");
    }
}

#[test]
fn what_has_no_solution_exits_with_three() {
    let output = span(&[("--run", "1 um"), ("--length", "10000 m")], &["--json"]);
    assert_eq!(output.status.code(), Some(3));
    assert!(output.stdout.is_empty());
    assert!(text(&output.stderr).contains("no horizontal force"));
}

#[test]
fn required_options_are_named() {
    let output = command().args(["span", "--run", "98 mm"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let shown = text(&output.stderr);
    for option in ["--length", "--weight", "--rigidity"] {
        assert!(shown.contains(option), "{shown}");
    }
}
