//! Measured values of a scene file, held against the dimension and the range that they must have.

use super::located::{Fixed, Located};
use super::source::Document;
use super::units::{self, Dimension};
use super::usual::{self, Usual};
use crate::Error;
use crate::error::Fault;
use crate::store::shown;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, DeserializeSeed, Deserializer, Visitor};
use serde_json::{Map, Value};
use std::borrow::Cow;
use std::f64::consts::{FRAC_PI_2, TAU};
use std::fmt;
use std::marker::PhantomData;
use std::ops::Bound;

/// What a key of the scene measures.
pub(super) trait Measure {
    /// The dimensions that fit.
    const DIMENSIONS: &'static [Dimension];
    /// Name with its article.
    const NAME: &'static str;
    /// Unit of a plain number, empty for a ratio.
    const UNIT: &'static str;
    /// A value with a unit, as a user would write it.
    const EXAMPLE: &'static str;
    /// Which values are not refused.
    const ALLOWED: Allowed = Allowed::Finite;

    /// What is found in practice.
    fn usual() -> Usual {
        usual::ANY
    }
}

/// Smallest and largest size of anything in a scene (m).
const SIZES: [f64; 2] = [1e-6, 1e4];

/// Which values a key may have (SI).
#[derive(Debug, Clone, Copy)]
pub(super) enum Allowed {
    /// All that are finite.
    Finite,
    /// Zero and more.
    NotNegative,
    /// More than zero.
    Positive,
    /// A size from 1 µm to 10 km.
    Size,
    /// A size from 1 µm to 10 km, or zero.
    SizeOrZero,
    /// Up to 10 km to either side.
    Coordinate,
    /// More than zero and no more than the whole, which the message names.
    PartOf(&'static str),
    /// From a smallest to a largest value, and of what these are.
    Within([f64; 2], &'static str),
    /// Zero, or from a smallest to a largest value, and of what these are.
    ZeroOrWithin([f64; 2], &'static str),
    /// Infinity, or from a smallest to a largest value, and of what these are.
    InfiniteOrWithin([f64; 2], &'static str),
    /// A turn to either side at most.
    Turn,
    /// From zero to below a right angle.
    BelowRightAngle,
    /// Above zero and below a right angle.
    Acute,
    /// Below a right angle to either side.
    ShearAngle,
}

impl Allowed {
    /// From where to where, of which the reader alone knows that infinity is allowed, too.
    fn range(self) -> [Bound<f64>; 2] {
        use Bound::{Excluded, Included, Unbounded};
        match self {
            Allowed::Finite => [Unbounded, Unbounded],
            Allowed::NotNegative => [Included(0.0), Unbounded],
            Allowed::Positive => [Excluded(0.0), Unbounded],
            Allowed::Size => SIZES.map(Included),
            Allowed::SizeOrZero => [Included(0.0), Included(SIZES[1])],
            Allowed::Coordinate => [-SIZES[1], SIZES[1]].map(Included),
            Allowed::PartOf(_) => [Excluded(0.0), Included(1.0)],
            Allowed::Within(bounds, _) => bounds.map(Included),
            Allowed::ZeroOrWithin([_, high], _) => [Included(0.0), Included(high)],
            Allowed::InfiniteOrWithin([low, _], _) => [Included(low), Unbounded],
            Allowed::Turn => [-TAU, TAU].map(Included),
            Allowed::BelowRightAngle => [Included(0.0), Excluded(FRAC_PI_2)],
            Allowed::Acute => [0.0, FRAC_PI_2].map(Excluded),
            Allowed::ShearAngle => [-FRAC_PI_2, FRAC_PI_2].map(Excluded),
        }
    }

    /// Smallest and largest size of a value that is possible at all.
    fn sizes(self) -> [f64; 2] {
        let [low, high] = self.range().map(|bound| match bound {
            Bound::Included(value) | Bound::Excluded(value) => Some(value),
            Bound::Unbounded => None,
        });
        [low.unwrap_or(0.0).max(0.0), high.unwrap_or(f64::INFINITY)]
    }
}

/// Says in the JSON Schema of a number from where to where it may be, and what of that is found in practice.
pub(super) fn describe(number: &mut Map<String, Value>, range: [Bound<f64>; 2], usual: &Usual) {
    for (bound, [closed, open]) in
        range.into_iter().zip([["minimum", "exclusiveMinimum"], ["maximum", "exclusiveMaximum"]])
    {
        match bound {
            Bound::Included(value) => number.insert(closed.into(), value.into()),
            Bound::Excluded(value) => number.insert(open.into(), value.into()),
            Bound::Unbounded => None,
        };
    }
    if usual.found[1].is_finite() {
        number.insert("x-usual".into(), usual.range.into());
    }
}

macro_rules! measures {
    ($($(#[$doc:meta])* $name:ident: [$($dimension:ident),+], $label:literal, $unit:literal, $example:literal;)+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        pub(super) struct $name;
        impl Measure for $name {
            const DIMENSIONS: &'static [Dimension] = &[$(Dimension::$dimension),+];
            const NAME: &'static str = $label;
            const UNIT: &'static str = $unit;
            const EXAMPLE: &'static str = $example;
        }
    )+};
}

measures! {
    /// Length (m).
    Length: [LENGTH], "a length", "m", "98 mm";
    /// Angle (rad).
    Angle: [ANGLE], "an angle", "rad", "20 deg";
    /// Time (s).
    Time: [TIME], "a time", "s", "29 s";
    /// Force (N).
    Force: [FORCE], "a force", "N", "100 kN";
    /// Speed (m/s).
    Speed: [SPEED], "a speed", "m/s", "0.25 m/s";
    /// Jerk (m/s³).
    Jerk: [JERK], "a jerk", "m/s^3", "10 m/s^3";
    /// Angular rate (rad/s).
    AngularRate: [ANGULAR_RATE], "an angular rate", "rad/s", "90 deg/s";
    /// Angular acceleration (rad/s²).
    AngularAcceleration: [ANGULAR_ACCELERATION], "an angular acceleration", "rad/s^2", "180 deg/s^2";
    /// Frequency (Hz).
    Frequency: [FREQUENCY], "a frequency", "Hz", "100 Hz";
    /// Acceleration (m/s²).
    Acceleration: [ACCELERATION], "an acceleration", "m/s^2", "9.81 m/s^2";
    /// Share of a whole, without a unit.
    Ratio: [NONE], "a ratio", "", "0.05 %";
    /// Coefficient of friction, without a unit.
    Coefficient: [NONE], "a coefficient of friction", "", "0.3";
    /// Mass per length (kg/m) or per area (kg/m²).
    Mass: [LINE_MASS, AREAL_MASS], "a mass per length or per area", "kg/m or kg/m^2", "314 g/m^2";
    /// Mass per length (kg/m).
    MassPerLength: [LINE_MASS], "a mass per length", "kg/m", "30 g/m";
    /// Mass per area (kg/m²).
    ArealMass: [AREAL_MASS], "a mass per area", "kg/m^2", "314 g/m^2";
    /// Flexural rigidity EI of a line of ply (N·m²).
    FlexuralRigidity: [FLEXURAL_RIGIDITY, WEIGHED_RIGIDITY], "a flexural rigidity", "N m^2", "9e-6 N m^2";
    /// Bending rigidity per width (N·m).
    BendingRigidity: [MOMENT, WEIGHED_MOMENT], "a bending rigidity per width", "N m", "2e-4 N m";
    /// Curvature (1/m).
    Curvature: [CURVATURE], "a curvature", "1/m", "20 1/m";
    /// Bending moment per width (N).
    MomentPerWidth: [FORCE], "a moment per width", "N", "0.02 N m/m";
    /// Shear force per length (N/m).
    ForcePerLength: [FORCE_PER_LENGTH], "a force per length", "N/m", "50 N/m";
    /// Tensile stiffness per width EA′ (N/m).
    TensileStiffness: [FORCE_PER_LENGTH], "a tensile stiffness per width", "N/m", "1e6 N/m";
    /// Slope of the shear force per length over the shear angle (N/m per rad).
    ShearSlope: [FORCE_PER_LENGTH, SHEAR_SLOPE], "a shear force per length and radian", "N/m per radian", "5 N/m";
    /// Stiffness of a gripper's mount (N/m).
    Stiffness: [FORCE_PER_LENGTH], "a stiffness", "N/m", "2 N/mm";
    /// Temperature (K).
    Temperature: [TEMPERATURE, CELSIUS], "a temperature", "K", "25 degC";
    /// Shear stress (Pa).
    Pressure: [PRESSURE], "a pressure", "Pa", "90 Pa";
}

/// A number in SI units, or a text with a unit, not yet held against its dimension.
#[derive(Debug, Clone)]
pub(super) enum Raw {
    Number(f64),
    Text(String),
}

/// A measured value as it is written in the file.
#[derive(Debug, Clone)]
pub(super) struct Unchecked<M> {
    raw: Raw,
    measure: PhantomData<M>,
}

impl<M> From<Located<Raw>> for Quantity<M> {
    fn from(Located { value: raw, span }: Located<Raw>) -> Self {
        Located { value: Unchecked { raw, measure: PhantomData }, span }
    }
}

impl<M> Unchecked<M> {
    /// A value from outside of a file, where no quotes tell a number from a text.
    pub fn of_argument(text: &str) -> Self {
        let raw = match units::quantity(text) {
            Ok((number, None)) => Raw::Number(number),
            _ => Raw::Text(text.to_string()),
        };
        Unchecked { raw, measure: PhantomData }
    }
}

/// A measured value with its place.
pub(super) type Quantity<M> = Located<Unchecked<M>>;

impl<M: Measure> Quantity<M> {
    /// The finite value in SI units; a plain number near what is usual.
    pub fn si(&self, document: &Document, usual: &Usual) -> Result<f64, Error> {
        let value = self.finite(document)?;
        self.believed(document, usual)?;
        Ok(value)
    }

    /// The finite value in SI units, whether it is usual or not.
    fn finite(&self, document: &Document) -> Result<f64, Error> {
        let (value, _) = self.with_dimension(document)?;
        if value.is_finite() {
            return Ok(value);
        }
        if value.is_nan() {
            return Err(self.not_a_number(document));
        }
        Err(document.error(
            self.span.clone(),
            format!("{} is no finite number", document.quoted(&self.span)),
            format!("expected {}, e.g. \"{}\"", M::NAME, M::EXAMPLE),
        ))
    }

    /// The value in SI units, a plain number near what is usual; infinity passes, a value that is not a number does not.
    pub fn si_or_infinite(&self, document: &Document, usual: &Usual) -> Result<f64, Error> {
        let (value, _) = self.with_dimension(document)?;
        if value.is_nan() {
            return Err(self.not_a_number(document));
        }
        self.believed(document, usual)?;
        Ok(value)
    }

    fn not_a_number(&self, document: &Document) -> Error {
        document.error(
            self.span.clone(),
            "`nan` is not a number",
            format!("expected {}, e.g. \"{}\"", M::NAME, M::EXAMPLE),
        )
    }

    /// The value in SI units and its dimension, `None` where a plain number leaves it open.
    pub fn with_dimension(&self, document: &Document) -> Result<(f64, Option<Dimension>), Error> {
        // a plain number has no dimension of its own
        let error =
            |message: String, help: String| document.error(self.span.clone(), message, help);
        let remedy = format!("expected {}, e.g. \"{}\"", M::NAME, M::EXAMPLE);
        let text = match &self.value.raw {
            Raw::Number(number) => return Ok((*number, None)),
            Raw::Text(text) => text,
        };

        // a text has a number and a unit
        let shown = document.excerpt(&self.span);
        let (value, dimension) = units::quantity(text).map_err(|fault| {
            let Fault { message, help } = fault;
            let help = match &*message {
                units::DECIMAL_COMMA => help,
                _ if help.is_empty() => remedy.clone(),
                _ => format!("{remedy}; {help}"),
            };
            error(format!("{shown} cannot be read: {message}"), help)
        })?;

        // the unit must fit what the key measures; shares and infinity may go without one
        match dimension {
            Some(found) if M::DIMENSIONS.contains(&found) => {
                Ok((si::<M>(value, found).unwrap_or(value), Some(found)))
            }
            Some(found) => Err(error(format!("{shown} is {found}"), remedy)),
            None if M::DIMENSIONS.contains(&Dimension::NONE) || value.is_infinite() => {
                Ok((value, None))
            }
            None => Err(error(
                format!("{shown} has no unit"),
                format!("{remedy}; a plain number, without quotes, is in {}", M::UNIT),
            )),
        }
    }

    /// A value above zero; a plain number near what is usual.
    pub fn positive(&self, document: &Document, usual: &Usual) -> Result<f64, Error> {
        let value = self.finite(document)?;
        if value > 0.0 {
            self.believed(document, usual)?;
            return Ok(value);
        }
        let zero = if value == 0.0 { "zero" } else { "negative" };
        Err(document.error(
            self.span.clone(),
            format!("{} is {zero}", document.quoted(&self.span)),
            format!("expected {} above zero, e.g. \"{}\"", M::NAME, M::EXAMPLE),
        ))
    }

    /// Refuses a plain number that is far from what is usual.
    fn believed(&self, document: &Document, usual: &Usual) -> Result<(), Error> {
        // a value with its unit is believed, and so is a plain number that is usual
        let number = match self.value.raw {
            Raw::Number(number) if number != 0.0 && number.is_finite() && !usual.holds(number) => {
                number
            }
            _ => return Ok(()),
        };

        // which units may have been meant, and what to write if the number is right
        let (written, unit) = (document.excerpt(&self.span), usual.unit);
        let written = written.trim_matches('"');
        let meant = usual.meant(number, si::<M>);
        let meant: Vec<String> = meant.iter().map(|unit| format!("\"{written} {unit}\"")).collect();
        let question = match meant.is_empty() {
            true => String::new(),
            false => format!("did you mean {}? ", meant.join(" or ")),
        };
        let insist = match units::unit(unit) {
            _ if !usual.allows(number) => String::new(),
            _ if unit.is_empty() => {
                format!("; write \"{} %\" if you mean that", plain(100.0 * number))
            }
            Ok(_) => format!("; write \"{written} {unit}\" if you mean that"),
            Err(_) => "; write it with its unit if you mean that".into(),
        };
        let plain_unit = match unit {
            "" => String::new(),
            unit => format!("plain numbers are in {unit}, and "),
        };
        Err(document.error(
            self.span.clone(),
            format!("`{written}` would make {} {} {unit}", usual.what, plain(number)).trim_end(),
            format!("{question}{plain_unit}{}{insist}", usual.range),
        ))
    }

    /// A value above zero and within bounds, both in SI units, of something else than the ply.
    pub fn within_for(
        &self,
        document: &Document,
        [low, high]: [f64; 2],
        what: &str,
        usual: &Usual,
    ) -> Result<f64, Error> {
        let value = self.positive(document, &usual.within([low, high]))?;
        if (low..=high).contains(&value) {
            return Ok(value);
        }
        let side = if value < low { "small" } else { "large" };
        Err(document.error(
            self.span.clone(),
            format!("{} is too {side} for {what}", document.quoted(&self.span)),
            format!("expected {} from {low:e} to {high:e} {}", M::NAME, M::UNIT),
        ))
    }

    /// A value of zero or more; a plain number near what is usual.
    pub fn not_negative(&self, document: &Document, usual: &Usual) -> Result<f64, Error> {
        let value = self.finite(document)?;
        if value >= 0.0 {
            self.believed(document, usual)?;
            return Ok(value);
        }
        Err(document.error(
            self.span.clone(),
            format!("{} is negative", document.quoted(&self.span)),
            format!("expected {} of zero or more", M::NAME),
        ))
    }
}

/// A value of a dimension that fits in SI units: a weight in place of a force is that on Earth.
fn si<M: Measure>(value: f64, dimension: Dimension) -> Option<f64> {
    let fits = |dimension| M::DIMENSIONS.contains(&dimension);
    if dimension == Dimension::CELSIUS && fits(Dimension::TEMPERATURE) {
        return Some(value + units::FREEZING);
    }
    if fits(dimension.times(Dimension::ACCELERATION, 1)) {
        return Some(value * units::STANDARD_GRAVITY);
    }
    fits(dimension).then_some(value)
}

/// A number as one writes it, without more digits than it needs.
fn plain(number: f64) -> String {
    match number.abs() {
        0.001..1e6 => format!("{number}"),
        _ => format!("{number:e}"),
    }
}

/// A default (SI) as one would write it in a scene, `"0.2 mm"`.
pub(super) fn written(value: f64, unit: &str) -> Value {
    let size = units::unit(unit).map_or(1.0, |(size, _)| size);
    match (value / size * 1e9).round() / 1e9 {
        0.0 => 0.into(),
        number => format!("{number} {unit}").into(),
    }
}

/// A key whose type says which values it may have.
pub(super) trait Read {
    /// What is read (SI).
    type Value;

    /// The value in SI units, of those that are allowed; a plain number near what is usual.
    fn read(&self, document: &Document) -> Result<Self::Value, Error>;
}

/// The value of a key, or another one where it is left out.
pub(super) fn read_or<K: Read>(
    key: &Option<K>,
    other: K::Value,
    document: &Document,
) -> Result<K::Value, Error> {
    key.as_ref().map_or(Ok(other), |key| key.read(document))
}

/// The value of a key, `None` where it is left out.
pub(super) fn read_given<K: Read>(
    key: &Option<K>,
    document: &Document,
) -> Result<Option<K::Value>, Error> {
    key.as_ref().map(|key| key.read(document)).transpose()
}

impl<K: Read, const N: usize> Read for Fixed<K, N>
where
    K::Value: Copy + Default,
{
    type Value = [K::Value; N];

    fn read(&self, document: &Document) -> Result<Self::Value, Error> {
        let mut values = [K::Value::default(); N];
        for (value, written) in values.iter_mut().zip(&self.0) {
            *value = written.read(document)?;
        }
        Ok(values)
    }
}

impl<K: Read, const N: usize> Read for Located<Fixed<K, N>>
where
    K::Value: Copy + Default,
{
    type Value = [K::Value; N];

    fn read(&self, document: &Document) -> Result<Self::Value, Error> {
        self.value.read(document)
    }
}

impl<M: Measure> Read for Quantity<M> {
    type Value = f64;

    fn read(&self, document: &Document) -> Result<f64, Error> {
        let usual = &M::usual().within(M::ALLOWED.sizes());

        // what is refused depends on the values that a key of this kind may have
        match M::ALLOWED {
            Allowed::Finite => self.si(document, usual),
            Allowed::NotNegative => self.not_negative(document, usual),
            Allowed::Positive => self.positive(document, usual),
            Allowed::Size => self.size(document, usual),
            Allowed::SizeOrZero => match self.not_negative(document, usual)? {
                0.0 => Ok(0.0),
                _ => self.size(document, usual),
            },
            Allowed::Coordinate => match self.si(document, usual)? {
                value if value.abs() <= SIZES[1] => Ok(value),
                value => Err(self.out_of_scale(document, value)),
            },
            Allowed::PartOf(whole) => match self.positive(document, usual)? {
                share if share <= 1.0 => Ok(share),
                _ => Err(document.error(
                    self.span.clone(),
                    format!("{} is more than {whole}", document.quoted(&self.span)),
                    "expected a share above 0, up to 1, e.g. \"95 %\"",
                )),
            },
            Allowed::Within(bounds, of) => self.within_for(document, bounds, of, usual),
            Allowed::ZeroOrWithin(bounds, of) => match self.not_negative(document, usual)? {
                0.0 => Ok(0.0),
                _ => self.within_for(document, bounds, of, usual),
            },
            Allowed::InfiniteOrWithin(bounds, of) => match self.si_or_infinite(document, usual)? {
                f64::INFINITY => Ok(f64::INFINITY),
                _ => self.within_for(document, bounds, of, usual),
            },
            Allowed::Turn => self.turn(document, usual),
            Allowed::BelowRightAngle => self.below_right_angle(document),
            Allowed::Acute => {
                self.below_right_angle(document)?;
                self.positive(document, usual)
            }
            Allowed::ShearAngle => self.shear_angle(document, usual),
        }
    }
}

impl<M: Measure> Quantity<M> {
    /// A size between 1 µm and 10 km (m).
    fn size(&self, document: &Document, usual: &Usual) -> Result<f64, Error> {
        let value = self.positive(document, usual)?;
        if (SIZES[0]..=SIZES[1]).contains(&value) {
            return Ok(value);
        }
        Err(self.out_of_scale(document, value))
    }

    /// Refuses a value (m) that nothing in a scene has.
    pub fn out_of_scale(&self, document: &Document, value: f64) -> Error {
        document.error(
            self.span.clone(),
            format!(
                "{} is {} m, out of all scale for a ply",
                document.quoted(&self.span),
                rounded(value)
            ),
            "sizes go from 1 um to 10 km: is the unit right?",
        )
    }

    /// A heading of at most one turn to either side (rad).
    fn turn(&self, document: &Document, usual: &Usual) -> Result<f64, Error> {
        let value = self.si(document, usual)?;
        if value.abs() <= TAU * (1.0 + 1e-9) {
            return Ok(value);
        }
        Err(document.error(
            self.span.clone(),
            format!("{} is more than a whole turn", document.quoted(&self.span)),
            "plain numbers are radians; write degrees as \"90 deg\"",
        ))
    }

    /// An angle from zero to below a right angle (rad): a plain number beyond is asked about as degrees.
    pub fn below_right_angle(&self, document: &Document) -> Result<f64, Error> {
        // what is usual is what is possible
        let value = self.not_negative(document, &usual::ANY)?;
        if value < FRAC_PI_2 * (1.0 - 1e-9) {
            return Ok(value);
        }
        let shown = document.quoted(&self.span);
        let (message, help) = match self.value.raw {
            Raw::Number(number) => (
                format!("{shown} is {:.1} deg, a right angle or more", value.to_degrees()),
                format!("plain numbers are radians: did you mean \"{number} deg\"?"),
            ),
            Raw::Text(_) => (
                format!("{shown} is a right angle or more"),
                "expected an angle from 0 to below 90 deg".into(),
            ),
        };
        Err(document.error(self.span.clone(), message, help))
    }

    /// A shear angle to either side, below a right angle (rad).
    fn shear_angle(&self, document: &Document, usual: &Usual) -> Result<f64, Error> {
        let value = self.si(document, usual)?;
        if value >= 0.0 {
            return self.below_right_angle(document);
        }
        if value > -FRAC_PI_2 * (1.0 - 1e-9) {
            return Ok(value);
        }
        Err(document.error(
            self.span.clone(),
            format!("{} shears the ply by a right angle or more", document.quoted(&self.span)),
            "expected an angle between -90 deg and 90 deg; write degrees as \"20 deg\"",
        ))
    }
}

/// Three digits, by powers of ten.
pub(super) fn rounded(value: f64) -> String {
    format!("{:e}", shown::rounded(value, 3))
}

/// Reads a number or a text of the quantity `name`, as in `example`.
pub(super) struct RawSeed {
    pub name: &'static str,
    pub example: &'static str,
}

impl<'de> DeserializeSeed<'de> for RawSeed {
    type Value = Raw;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Raw, D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl Visitor<'_> for RawSeed {
    type Value = Raw;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}, e.g. \"{}\"", self.name, self.example)
    }
    fn visit_i64<E>(self, value: i64) -> Result<Raw, E> {
        Ok(Raw::Number(value as f64))
    }
    fn visit_u64<E>(self, value: u64) -> Result<Raw, E> {
        Ok(Raw::Number(value as f64))
    }
    fn visit_f64<E>(self, value: f64) -> Result<Raw, E> {
        Ok(Raw::Number(value))
    }
    fn visit_str<E>(self, value: &str) -> Result<Raw, E> {
        Ok(Raw::Text(value.to_string()))
    }
}

impl<'de, M: Measure> Deserialize<'de> for Unchecked<M> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let seed = RawSeed { name: M::NAME, example: M::EXAMPLE };
        Ok(Unchecked { raw: seed.deserialize(deserializer)?, measure: PhantomData })
    }
}

impl<M: Measure> JsonSchema for Unchecked<M> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        M::NAME.into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let number = match M::UNIT {
            "" => M::NAME.to_string(),
            unit => format!("{} in {unit}", M::NAME),
        };
        let mut plain = json_schema!({ "type": "number", "description": number });
        describe(plain.ensure_object(), M::ALLOWED.range(), &M::usual());
        json_schema!({
            "anyOf": [
                plain,
                { "type": "string", "description": format!("{} with its unit", M::NAME), "examples": [M::EXAMPLE] }
            ]
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read<M: Measure>(text: &str) -> Result<f64, Error> {
        let document = Document::new("", text);
        Located { value: Unchecked::<M>::of_argument(text), span: 0..text.len() }
            .si(&document, &usual::ANY)
    }

    /// Peirce's flexural rigidity of a width is a mass per area in mg/cm² times the cube of a bending length in cm, so in
    /// mg·cm: the weight of it is 9.80665e-6 N/mg × 0.01 m/cm per mg·cm.
    #[test]
    fn a_rigidity_in_units_of_mass_is_that_of_the_weight_on_earth() {
        let rigidity = read::<BendingRigidity>("2000 mg cm").unwrap();
        assert!((rigidity - 2000.0 * 9.806_65e-8).abs() < 1e-18, "{rigidity}");
        let rigidity = read::<FlexuralRigidity>("500 g cm^2").unwrap();
        assert!((rigidity - 500.0 * 9.806_65e-7).abs() < 1e-15, "{rigidity}");
        assert_eq!(read::<BendingRigidity>("2e-4 N m").unwrap(), 2e-4);
        assert!(read::<Force>("2 kg").is_err());
        assert!(read::<Length>("2 g m").is_err());
    }
}
