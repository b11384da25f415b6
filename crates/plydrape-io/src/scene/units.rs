//! Numbers with a unit: `"98 mm"`, `"314 g/m^2"`, `"9e-6 N·m²"`, and as data sheets write them: `"314 gsm"`, `"9.2 oz/yd2"`,
//! `"2e-4 Nm"`, `"4 N.m"`.
//!
//! A unit is a product and quotient of symbols with whole powers, read from left to right; a slash
//! divides by the next symbol or bracket only, so that `N/m/s` is N/(m·s), which may be written so too. Values come out in SI base units.
//! An angle counts as a dimension of its own: a length in degrees is a mistake worth catching.

use super::source::excerpt;
use crate::error::Fault;
use std::borrow::Cow;
use std::fmt;

/// Powers of meter, kilogram, second, radian, kelvin, and of the degree Celsius, which counts from another zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Dimension(pub [i32; 6]);

impl Dimension {
    pub const NONE: Self = Dimension([0, 0, 0, 0, 0, 0]);
    pub const LENGTH: Self = Dimension([1, 0, 0, 0, 0, 0]);
    pub const MASS: Self = Dimension([0, 1, 0, 0, 0, 0]);
    pub const TIME: Self = Dimension([0, 0, 1, 0, 0, 0]);
    pub const ANGLE: Self = Dimension([0, 0, 0, 1, 0, 0]);
    pub const FORCE: Self = Dimension([1, 1, -2, 0, 0, 0]);
    pub const PRESSURE: Self = Dimension([-1, 1, -2, 0, 0, 0]);
    pub const SPEED: Self = Dimension([1, 0, -1, 0, 0, 0]);
    pub const ACCELERATION: Self = Dimension([1, 0, -2, 0, 0, 0]);
    pub const JERK: Self = Dimension([1, 0, -3, 0, 0, 0]);
    pub const ANGULAR_RATE: Self = Dimension([0, 0, -1, 1, 0, 0]);
    pub const ANGULAR_ACCELERATION: Self = Dimension([0, 0, -2, 1, 0, 0]);
    pub const FREQUENCY: Self = Dimension([0, 0, -1, 0, 0, 0]);
    pub const LINE_MASS: Self = Dimension([-1, 1, 0, 0, 0, 0]);
    pub const AREAL_MASS: Self = Dimension([-2, 1, 0, 0, 0, 0]);
    pub const FLEXURAL_RIGIDITY: Self = Dimension([3, 1, -2, 0, 0, 0]);
    pub const MOMENT: Self = Dimension([2, 1, -2, 0, 0, 0]);
    pub const FORCE_PER_LENGTH: Self = Dimension([0, 1, -2, 0, 0, 0]);
    pub const CURVATURE: Self = Dimension([-1, 0, 0, 0, 0, 0]);
    pub const SHEAR_SLOPE: Self = Dimension([0, 1, -2, -1, 0, 0]);

    pub const TEMPERATURE: Self = Dimension([0, 0, 0, 0, 1, 0]);
    pub const CELSIUS: Self = Dimension([0, 0, 0, 0, 0, 1]);

    /// Mass in place of weight: of a bending rigidity per width, and of a flexural rigidity.
    pub const WEIGHED_MOMENT: Self = Dimension([1, 1, 0, 0, 0, 0]);
    pub const WEIGHED_RIGIDITY: Self = Dimension([2, 1, 0, 0, 0, 0]);

    /// Multiplies by another dimension's power.
    pub fn times(self, other: Dimension, power: i32) -> Self {
        let mut sum = self.0;
        for (s, o) in sum.iter_mut().zip(other.0) {
            *s = s.saturating_add(o.saturating_mul(power));
        }
        Dimension(sum)
    }
}

/// The dimensions with a name of their own.
const NAMES: [(Dimension, &str); 24] = [
    (Dimension::NONE, "a number without a unit"),
    (Dimension::LENGTH, "a length"),
    (Dimension::MASS, "a mass"),
    (Dimension::TIME, "a time"),
    (Dimension::ANGLE, "an angle"),
    (Dimension::FORCE, "a force"),
    (Dimension::PRESSURE, "a pressure"),
    (Dimension::SPEED, "a speed"),
    (Dimension::ACCELERATION, "an acceleration"),
    (Dimension::JERK, "a jerk"),
    (Dimension::ANGULAR_RATE, "an angular rate"),
    (Dimension::ANGULAR_ACCELERATION, "an angular acceleration"),
    (Dimension::FREQUENCY, "a frequency"),
    (Dimension::LINE_MASS, "a mass per length"),
    (Dimension::AREAL_MASS, "a mass per area"),
    (Dimension::FLEXURAL_RIGIDITY, "a flexural rigidity"),
    (Dimension::MOMENT, "a moment"),
    (Dimension::FORCE_PER_LENGTH, "a force per length"),
    (Dimension::SHEAR_SLOPE, "a force per length and angle"),
    (Dimension::CURVATURE, "a curvature"),
    (Dimension::TEMPERATURE, "a temperature"),
    (Dimension::CELSIUS, "a temperature"),
    (Dimension([2, 0, 0, 0, 0, 0]), "an area"),
    (Dimension([-3, 1, 0, 0, 0, 0]), "a density"),
];

impl fmt::Display for Dimension {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((_, name)) = NAMES.iter().find(|(dimension, _)| dimension == self) {
            return f.write_str(name);
        }
        f.write_str("a quantity in")?;
        for (symbol, power) in ["m", "kg", "s", "rad", "K", "degC"].into_iter().zip(self.0) {
            match power {
                0 => {}
                1 => write!(f, " {symbol}")?,
                _ => write!(f, " {symbol}^{power}")?,
            }
        }
        Ok(())
    }
}

/// Standard gravity (m/s²): what makes a weight of a mass.
pub(super) const STANDARD_GRAVITY: f64 = 9.806_65;

/// What 0 °C is (K).
pub(super) const FREEZING: f64 = 273.15;

/// The pound (kg) and the foot (m) of the international agreement of 1959.
const POUND: f64 = 0.453_592_37;
const FOOT: f64 = 0.3048;

/// Symbols of units, their size in SI base units and their dimension.
const UNITS: [(&str, f64, Dimension); 45] = [
    ("m", 1.0, Dimension::LENGTH),
    ("cm", 1e-2, Dimension::LENGTH),
    ("mm", 1e-3, Dimension::LENGTH),
    ("um", 1e-6, Dimension::LENGTH),
    ("µm", 1e-6, Dimension::LENGTH),
    ("μm", 1e-6, Dimension::LENGTH),
    ("in", FOOT / 12.0, Dimension::LENGTH),
    ("ft", FOOT, Dimension::LENGTH),
    ("yd", 3.0 * FOOT, Dimension::LENGTH),
    ("rad", 1.0, Dimension::ANGLE),
    ("deg", std::f64::consts::PI / 180.0, Dimension::ANGLE),
    ("°", std::f64::consts::PI / 180.0, Dimension::ANGLE),
    ("K", 1.0, Dimension::TEMPERATURE),
    ("degC", 1.0, Dimension::CELSIUS),
    ("°C", 1.0, Dimension::CELSIUS),
    ("kg", 1.0, Dimension::MASS),
    ("g", 1e-3, Dimension::MASS),
    ("mg", 1e-6, Dimension::MASS),
    ("lb", POUND, Dimension::MASS),
    ("oz", POUND / 16.0, Dimension::MASS),
    ("sqm", 1.0, Dimension([2, 0, 0, 0, 0, 0])),
    ("gsm", 1e-3, Dimension::AREAL_MASS),
    ("osy", POUND / 16.0 / (9.0 * FOOT * FOOT), Dimension::AREAL_MASS),
    ("s", 1.0, Dimension::TIME),
    ("ms", 1e-3, Dimension::TIME),
    ("min", 60.0, Dimension::TIME),
    ("h", 3600.0, Dimension::TIME),
    ("Hz", 1.0, Dimension::FREQUENCY),
    ("kHz", 1e3, Dimension::FREQUENCY),
    ("N", 1.0, Dimension::FORCE),
    ("uN", 1e-6, Dimension::FORCE),
    ("µN", 1e-6, Dimension::FORCE),
    ("μN", 1e-6, Dimension::FORCE),
    ("mN", 1e-3, Dimension::FORCE),
    ("cN", 1e-2, Dimension::FORCE),
    ("kN", 1e3, Dimension::FORCE),
    ("MN", 1e6, Dimension::FORCE),
    ("gf", 1e-3 * STANDARD_GRAVITY, Dimension::FORCE),
    ("kgf", STANDARD_GRAVITY, Dimension::FORCE),
    ("lbf", POUND * STANDARD_GRAVITY, Dimension::FORCE),
    ("Pa", 1.0, Dimension::PRESSURE),
    ("kPa", 1e3, Dimension::PRESSURE),
    ("MPa", 1e6, Dimension::PRESSURE),
    ("GPa", 1e9, Dimension::PRESSURE),
    ("%", 1e-2, Dimension::NONE),
];

/// What is wrong with the number before a unit, where it has a decimal comma.
pub(super) const DECIMAL_COMMA: &str = "its number has a decimal comma";

/// A symbol that is no unit.
fn unknown(symbol: &str) -> Fault {
    let help = match nearest_unit(symbol) {
        Some(unit) => format!("did you mean `{unit}`?"),
        None => known_units(),
    };
    Fault::new(format!("`{}` is no unit known here", excerpt(symbol)), help)
}

/// An operator that no unit follows.
fn dangling(operator: char) -> Fault {
    let help = "write units as products and quotients, as in \"N m^2\" or \"kg/m\"";
    Fault::new(format!("a unit is missing after `{operator}`"), help)
}

/// The symbols, each once: without those that are another way to type µ.
fn known_units() -> String {
    let symbols = UNITS.iter().map(|(symbol, ..)| *symbol);
    let once = |symbol: &&str| !symbol.starts_with(['u', 'μ']);
    let symbols: Vec<&str> = symbols.filter(once).collect();
    format!("the units known here, and their products, are {}", symbols.join(" "))
}

/// The unit that differs from a symbol in its letters' case only, or by a usual long name.
fn nearest_unit(symbol: &str) -> Option<&'static str> {
    // usual names in place of symbols
    let small = symbol.to_lowercase();
    let long = match small.as_str() {
        "millimeter" | "millimetre" | "millimeters" | "millimetres" => "mm",
        "centimeter" | "centimetre" | "centimeters" | "centimetres" => "cm",
        "micron" | "microns" | "micrometer" | "micrometre" => "um",
        "foot" | "feet" | "'" => "ft",
        "yard" | "yards" => "yd",
        "pound" | "pounds" | "lbs" => "lb",
        "ounce" | "ounces" => "oz",
        "p" | "pond" | "gramforce" => "gf",
        "kp" | "kilopond" => "kgf",
        "meter" | "metre" | "meters" | "metres" => "m",
        "inch" | "inches" | "\"" => "in",
        "degree" | "degrees" | "grad" => "deg",
        "radian" | "radians" => "rad",
        "c" | "celsius" | "oc" => "degC",
        "kelvin" => "K",
        "sec" | "second" | "seconds" => "s",
        "minute" | "minutes" => "min",
        "hr" | "hour" | "hours" => "h",
        "hertz" => "Hz",
        "newton" | "newtons" => "N",
        "gram" | "grams" | "gramm" | "gr" | "gm" | "gms" => "g",
        "qm" => "sqm",
        "percent" => "%",
        _ => "",
    };

    // moments are known too, as two symbols without a space between them
    let same = |unit: &str| unit == long || unit.to_lowercase() == small;
    UNITS.iter().map(|(unit, ..)| *unit).chain(["Nm", "Nmm"]).find(|u| same(u))
}

/// Quotes that text processors write in place of straight ones.
pub(super) const CURLY: &str = "“”„‟‘’‚‛«»‹›″′＂";

/// What is between curly quotes at both ends of a text, or after one at its beginning; `None` without them.
pub(super) fn without_curly_quotes(text: &str) -> Option<&str> {
    let inner = text.strip_prefix(|c| CURLY.contains(c))?;
    Some(inner.trim_matches(|c| CURLY.contains(c)).trim())
}

/// Reads a number with or without a unit: its value in SI base units, and its dimension.
///
/// `None` as the dimension means that no unit was written.
pub(super) fn quantity(text: &str) -> Result<(f64, Option<Dimension>), Fault> {
    let text = text.trim();
    if let Some(inner) = without_curly_quotes(text) {
        let help = format!("write \"{inner}\"");
        return Err(Fault::new("it is in curly quotes", help));
    }
    let (number, rest) = text.split_at(number_length(text));
    let value: f64 =
        number.parse().map_err(|_| Fault::new("it does not start with a number", ""))?;
    if rest.starts_with(',') {
        return Err(Fault::new(DECIMAL_COMMA, "write a decimal point, as in \"98.5 mm\""));
    }
    if rest.trim_start().strip_prefix(TIMES).is_some_and(|tail| tail.trim_start().starts_with("10"))
    {
        let help = "write powers of ten by an e, as in \"9e-5 N m\"";
        return Err(Fault::new("its number has a power of ten written out", help));
    }
    if rest.trim().is_empty() {
        return Ok((value, None));
    }
    let (size, dimension) = unit(rest)?;
    Ok((value * size, Some(dimension)))
}

/// The size of a unit in SI base units, and its dimension.
type Unit = (f64, Dimension);

/// Reads a unit alone: its size in SI base units, and its dimension.
pub(super) fn unit(text: &str) -> Result<Unit, Fault> {
    let spelled = spelled(text);
    match product(&spelled, 0)? {
        (Some(unit), "") => Ok(unit),
        (None, "") => Ok((1.0, Dimension::NONE)),
        (_, rest) => Err(unknown(rest.get(..1).unwrap_or(rest))),
    }
}

/// The products and quotients up to the end of a text, or up to the bracket that ends them; and what follows.
fn product(text: &str, depth: usize) -> Result<(Option<Unit>, &str), Fault> {
    let mut total = None;
    let mut rest = text.trim();
    let mut sign = 1;
    let mut operator = None;
    if let Some(tail) = rest.strip_prefix("1/") {
        (rest, sign, operator) = (tail.trim_start(), -1, Some('/'));
    }
    while !rest.is_empty() && !rest.starts_with(')') {
        // one symbol, up to an operator, a power, a bracket or a space; or what is in brackets
        let ([before, last], tail) = match rest.strip_prefix('(') {
            Some(inner) => {
                let (group, tail) = bracket(inner, depth + 1)?;
                ([None, Some(group)], tail)
            }
            None => {
                let end = rest.find(|c: char| is_separator(c) || is_power(c));
                let (symbol, tail) = rest.split_at(end.unwrap_or(rest.len()));
                if symbol.is_empty() {
                    let character = rest.chars().next().unwrap_or(' ');
                    return Err(match operator {
                        Some(operator) => dangling(operator),
                        None => unknown(&character.to_string()),
                    });
                }
                (joined(symbol).ok_or_else(|| unknown(symbol))?, tail)
            }
        };
        let (power, tail) = power(tail)?;

        // Into the product, or under the slash before it. A power belongs to the factor beside it: Nm² is N·m².
        let (value, of) = total.get_or_insert((1.0, Dimension::NONE));
        for ((size, dimension), power) in
            before.map(|unit| (unit, 1)).into_iter().chain(last.map(|unit| (unit, power)))
        {
            *value *= f64::powi(size, sign * power);
            *of = of.times(dimension, sign * power);
        }
        rest = tail.trim_start();
        (sign, operator) = (1, None);
        if let Some(c) = rest.chars().next().filter(|c| OPERATORS.contains(*c)) {
            sign = if c == '/' { -1 } else { 1 };
            operator = Some(c);
            rest = rest[c.len_utf8()..].trim_start();
        }
    }
    match operator {
        Some(operator) => Err(dangling(operator)),
        None => Ok((total, rest)),
    }
}

/// What is between a bracket that was opened and the one that closes it; and what follows.
fn bracket(inner: &str, depth: usize) -> Result<(Unit, &str), Fault> {
    let refused = |message: &str| Fault::new(message, "write brackets as in \"N/(m rad)\"");
    if depth > MOST_BRACKETS {
        return Err(refused("its unit has too many brackets within one another"));
    }
    match product(inner, depth)? {
        (Some(group), rest) => match rest.strip_prefix(')') {
            Some(tail) => Ok((group, tail)),
            None => Err(refused("a bracket of its unit is not closed")),
        },
        (None, _) => Err(refused("there is no unit in its brackets")),
    }
}

/// Most brackets within one another.
const MOST_BRACKETS: usize = 8;

/// Units that are one sign, as East Asian texts have them, and signs that are wider than others, written out.
const SIGNS: [(char, &str); 27] = [
    ('㎎', "mg"),
    ('㎏', "kg"),
    ('㎐', "Hz"),
    ('㎑', "kHz"),
    ('㎛', "um"),
    ('㎜', "mm"),
    ('㎝', "cm"),
    ('㎟', "mm^2"),
    ('㎠', "cm^2"),
    ('㎡', "m^2"),
    ('㎣', "mm^3"),
    ('㎤', "cm^3"),
    ('㎥', "m^3"),
    ('㎧', "m/s"),
    ('㎨', "m/s^2"),
    ('㎩', "Pa"),
    ('㎪', "kPa"),
    ('㎫', "MPa"),
    ('㎬', "GPa"),
    ('㎭', "rad"),
    ('㎮', "rad/s"),
    ('㎯', "rad/s^2"),
    ('㎳', "ms"),
    ('（', "("),
    ('）', ")"),
    ('／', "/"),
    ('％', "%"),
];

/// A text with units that are one sign written out, in brackets so that a power or a slash is of all of it.
fn spelled(text: &str) -> Cow<'_, str> {
    let long = |letter: char| SIGNS.iter().find(|(sign, _)| *sign == letter).map(|(_, long)| *long);
    if !text.contains(|letter| long(letter).is_some()) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(2 * text.len());
    for letter in text.chars() {
        match long(letter) {
            Some(long) if long.starts_with(char::is_alphabetic) => {
                out.extend(["(", long, ")"]);
            }
            Some(long) => out.push_str(long),
            None => out.push(letter),
        }
    }
    Cow::Owned(out)
}

/// A symbol, or two that are written without a space: a force or a weighed mass and the length it acts over, as in `Nm` and
/// `mgcm`. The pair is the first of two units, `None` for a single one, and the last.
fn joined(symbol: &str) -> Option<[Option<Unit>; 2]> {
    let known_unit = |symbol: &str| {
        let found = UNITS.iter().find(|(known, ..)| *known == symbol);
        found.map(|(_, size, dimension)| (*size, *dimension))
    };
    if let Some(unit) = known_unit(symbol) {
        return Some([None, Some(unit)]);
    }
    ["mm", "cm", "m"].into_iter().find_map(|length| {
        let first = known_unit(symbol.strip_suffix(length)?)?;
        // `gm` is another way to write a gram
        let weighs = first.1 == Dimension::MASS && length == "cm";
        (first.1 == Dimension::FORCE || weighs).then_some([Some(first), known_unit(length)])
    })
}

/// What precedes a power of ten that is written out.
const TIMES: [char; 7] = ['*', '·', '⋅', '∙', '×', 'x', 'X'];
/// Operators between symbols: products, and the quotient.
const OPERATORS: &str = "*·⋅∙×./";
/// Digits of a power above the line, by value, and its sign.
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
const RAISED_MINUS: char = '⁻';

fn is_separator(c: char) -> bool {
    c.is_whitespace() || OPERATORS.contains(c) || matches!(c, '(' | ')')
}

fn is_power(c: char) -> bool {
    matches!(c, '^' | '-' | RAISED_MINUS) || RAISED.contains(&c) || c.is_ascii_digit()
}

/// The power at the head of a text, 1 if there is none, and what follows it.
fn power(text: &str) -> Result<(i32, &str), Fault> {
    let end = text.find(is_separator).unwrap_or(text.len());
    let (written, tail) = text.split_at(end);
    if written.is_empty() {
        return Ok((1, tail));
    }
    let lowered = |c: char| match RAISED.iter().zip('0'..).find(|(raised, _)| **raised == c) {
        Some((_, digit)) => digit,
        None if c == RAISED_MINUS => '-',
        None => c,
    };
    let digits: String =
        written.strip_prefix('^').unwrap_or(written).chars().map(lowered).collect();
    match digits.parse::<i32>() {
        Ok(value) if value.abs() <= 9 => Ok((value, tail)),
        _ => Err(Fault::new(
            format!("`{}` is no whole power from -9 to 9", excerpt(written)),
            "write powers as in m^2, m², or s^-2",
        )),
    }
}

/// Bytes of the number at the head of a text; an `e` counts only with digits behind it.
fn number_length(text: &str) -> usize {
    let unsigned = text.trim_start_matches(['+', '-']);
    for word in ["inf", "nan"] {
        let found = unsigned.strip_prefix(word);
        if found.is_some_and(|tail| !tail.starts_with(char::is_alphanumeric)) {
            return text.len() - unsigned.len() + word.len();
        }
    }
    let bytes = text.as_bytes();
    let digits = |from: usize| {
        let tail = bytes.get(from..).unwrap_or_default();
        from + tail.iter().take_while(|b| b.is_ascii_digit()).count()
    };
    let sign_at = |at: usize| usize::from(matches!(bytes.get(at), Some(b'+' | b'-')));

    let mut end = digits(sign_at(0));
    if bytes.get(end) == Some(&b'.') {
        end = digits(end + 1);
    }
    if matches!(bytes.get(end), Some(b'e' | b'E')) {
        let exponent = end + 1 + sign_at(end + 1);
        if digits(exponent) > exponent {
            end = digits(exponent);
        }
    }
    end
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The dimensions are worked out by hand from N = kg·m/s².
    #[test]
    fn products_quotients_and_powers_are_read_from_left_to_right() {
        let cases = [
            ("9e-6 N·m²", 9e-6, Dimension::FLEXURAL_RIGIDITY),
            ("9e-6 N m^2", 9e-6, Dimension::FLEXURAL_RIGIDITY),
            ("314 g/m^2", 0.314, Dimension::AREAL_MASS),
            ("9.81 m/s/s", 9.81, Dimension::ACCELERATION),
            ("9.81 m s^-2", 9.81, Dimension::ACCELERATION),
            ("1in", 0.0254, Dimension::LENGTH),
            ("-2.5e1 mm", -0.025, Dimension::LENGTH),
            ("5 mN*m", 5e-3, Dimension::MOMENT),
            ("0.25 m/s", 0.25, Dimension::SPEED),
            ("10 m/s^3", 10.0, Dimension::JERK),
            ("1 kHz", 1e3, Dimension::FREQUENCY),
            ("100 s^-1", 100.0, Dimension::FREQUENCY),
            ("180°", std::f64::consts::PI, Dimension::ANGLE),
            ("0.05 %", 0.0005, Dimension::NONE),
            ("9.81 m s⁻²", 9.81, Dimension::ACCELERATION),
            ("20 1/m", 20.0, Dimension::CURVATURE),
            ("0.02 1/mm", 20.0, Dimension::CURVATURE),
            ("0.02 N m/m", 0.02, Dimension::FORCE),
        ];
        for (text, value, dimension) in cases {
            let (v, d) = quantity(text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
            assert!((v - value).abs() <= 1e-15 * value.abs(), "{text}: {v}");
            assert_eq!(d, Some(dimension), "{text}");
        }
        assert_eq!(quantity("98"), Ok((98.0, None)));
        assert_eq!(quantity("inf"), Ok((f64::INFINITY, None)));
    }

    /// The ounce has 28.349523125 g and the yard 0.9144 m, by the agreement of 1959; a gram-force is a gram under
    /// 9.80665 m/s².
    #[test]
    fn units_of_data_sheets_are_read() {
        let osy = 0.028_349_523_125 / (0.9144 * 0.9144);
        let cases = [
            ("314 gsm", 0.314, Dimension::AREAL_MASS),
            ("314 g/m2", 0.314, Dimension::AREAL_MASS),
            ("314 g/m²", 0.314, Dimension::AREAL_MASS),
            ("314 g/sqm", 0.314, Dimension::AREAL_MASS),
            ("9.3 oz/yd2", 9.3 * osy, Dimension::AREAL_MASS),
            ("9.3 osy", 9.3 * osy, Dimension::AREAL_MASS),
            ("2e-4 Nm", 2e-4, Dimension::MOMENT),
            ("2e-4 N*m", 2e-4, Dimension::MOMENT),
            ("2e-4 N.m", 2e-4, Dimension::MOMENT),
            ("2e-4 Nm2/m", 2e-4, Dimension::MOMENT),
            ("0.2 Nmm", 2e-4, Dimension::MOMENT),
            ("200 mNmm", 2e-4, Dimension::MOMENT),
            ("2 cNcm", 2e-4, Dimension::MOMENT),
            ("9e-6 Nm2", 9e-6, Dimension::FLEXURAL_RIGIDITY),
            ("9e-6 Nm²", 9e-6, Dimension::FLEXURAL_RIGIDITY),
            ("9 Nmm^2", 9e-6, Dimension::FLEXURAL_RIGIDITY),
            ("2000 mgcm", 2e-5, Dimension::WEIGHED_MOMENT),
            ("200 µN·m", 2e-4, Dimension::MOMENT),
            ("200 µNm", 2e-4, Dimension::MOMENT),
            ("0.2 mNm", 2e-4, Dimension::MOMENT),
            ("20 mN cm", 2e-4, Dimension::MOMENT),
            ("2000 mg cm", 2e-5, Dimension::WEIGHED_MOMENT),
            ("2000 mg·cm", 2e-5, Dimension::WEIGHED_MOMENT),
            ("2 gf cm^2/cm", 2.0 * 9.806_65e-5, Dimension::MOMENT),
            ("2 lbf", 8.896_443_230_521, Dimension::FORCE),
            ("45°", std::f64::consts::FRAC_PI_4, Dimension::ANGLE),
            ("90 °/s", std::f64::consts::FRAC_PI_2, Dimension::ANGULAR_RATE),
            ("314 g/㎡", 0.314, Dimension::AREAL_MASS),
            ("314 g/(m²)", 0.314, Dimension::AREAL_MASS),
            ("0.3 ㎏/㎡", 0.3, Dimension::AREAL_MASS),
            ("0.2 N㎜", 2e-4, Dimension::MOMENT),
            ("9.81㎨", 9.81, Dimension::ACCELERATION),
            ("5 N/(m rad)", 5.0, Dimension::SHEAR_SLOPE),
            ("5 N/(m*rad)", 5.0, Dimension::SHEAR_SLOPE),
            ("5 N （m·rad）^-1", 5.0, Dimension::SHEAR_SLOPE),
            ("0.5 N/(m (deg))", 90.0 / std::f64::consts::PI, Dimension::SHEAR_SLOPE),
            ("9.81 (m/s)/s", 9.81, Dimension::ACCELERATION),
            ("3 (m/s)²/m", 3.0, Dimension::ACCELERATION),
            ("20 1/(m)", 20.0, Dimension::CURVATURE),
            // a gram-force over a centimeter is 0.980665 N/m, and a radian has 180/π degrees
            (
                "0.8 gf/(cm deg)",
                0.8 * 0.980_665 * 180.0 / std::f64::consts::PI,
                Dimension::SHEAR_SLOPE,
            ),
            (
                "0.8 gf/cm/deg",
                0.8 * 0.980_665 * 180.0 / std::f64::consts::PI,
                Dimension::SHEAR_SLOPE,
            ),
        ];
        for (text, value, dimension) in cases {
            let (v, d) = quantity(text).unwrap_or_else(|e| panic!("{text}: {e:?}"));
            assert!((v - value).abs() <= 1e-14 * value.abs(), "{text}: {v}");
            assert_eq!(d, Some(dimension), "{text}");
        }
    }

    #[test]
    fn what_is_no_quantity_is_refused_by_its_fault() {
        let refused = |text: &str, message: &str, help: &str| {
            let fault = quantity(text).unwrap_err();
            assert!(
                fault.message.contains(message) && fault.help.contains(help),
                "{text}: {fault:?}"
            );
        };
        refused("mm", "does not start with a number", "");
        refused("98,5 mm", DECIMAL_COMMA, "\"98.5 mm\"");
        for text in ["9×10^-5 N m", "9 x 10-5 N m", "9*10^-5 N m", "9·10⁻⁵ N m"] {
            refused(text, "a power of ten written out", "9e-5");
        }
        for (symbol, unit) in [("MM", "mm"), ("gm/m2", "g"), ("NM", "Nm"), ("hours", "h")] {
            let written = symbol.trim_end_matches("/m2");
            refused(
                &format!("9 {symbol}"),
                &format!("`{written}` is no unit known here"),
                &format!("did you mean `{unit}`?"),
            );
        }
        refused("9 kg/", "a unit is missing after `/`", "products and quotients");
        refused("9 kg//m", "a unit is missing after `/`", "products and quotients");
        refused("9 m^x", "`^x` is no whole power from -9 to 9", "m^2");
        refused("9 N/(m rad", "a bracket of its unit is not closed", "N/(m rad)");
        refused("9 N/()", "there is no unit in its brackets", "N/(m rad)");
        refused("9 N/m)", "`)` is no unit known here", "");
        refused("9 N/(m/)", "a unit is missing after `/`", "");
        refused(&format!("9 {}m", "(".repeat(1000)), "too many brackets", "");
        for text in ["“75 mm”", "„75 mm“", "«75 mm»", "‘75 mm’"] {
            refused(text, "curly quotes", "write \"75 mm\"");
        }
    }

    proptest! {
        /// Written with a unit and read back, a value differs by rounding only.
        #[test]
        fn a_value_with_its_unit_reads_back(
            value in -1e6..1e6f64, k in 0..UNITS.len(), power in 1..4i32,
        ) {
            let (symbol, size, dimension) = UNITS[k];
            let (read, found) = quantity(&format!("{value:e} {symbol}^{power}")).unwrap();
            let expected = value * size.powi(power);
            prop_assert!((read - expected).abs() <= 1e-14 * expected.abs());
            prop_assert_eq!(found, Some(Dimension::NONE.times(dimension, power)));
        }

        /// No text makes the reader panic, be it random or nearly right.
        #[test]
        fn any_text_is_read_or_refused(text in "\\PC*", near in "[0-9.e+\\-]{0,6} ?[a-zµ°%㎡(]{0,4}[\\^/²·*( )]{0,2}[\\-0-9a-z)]{0,4}") {
            let _ = quantity(&text);
            let _ = quantity(&near);
            let _ = unit(&text);
        }
    }
}
