//! Keys that may be written in more than one way: a material, a measured curve, friction, a table of positions, a place, an outline, a hole.

use super::file::{CircleTable, DrawingTable, MaterialTable};
use super::located::{Fixed, Located};
use super::quantity::{Measure, Quantity, Unchecked};
use super::usual::{Coordinate, FabricPoint, Friction, Heading, Place};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, IntoDeserializer, MapAccess, SeqAccess, Unexpected, Visitor};
use serde_json::Value;
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// Words for the middle; a key takes all of them.
pub(super) const MIDDLE: &[&str] = &["middle", "center", "centre", "centered", "centred"];

/// How a type is read that may be written in more than one way: the type, what is expected, and how each way is read.
macro_rules! visited {
    ($name:ident, $expected:literal; $($visits:tt)+) => {
        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                struct Choice;
                impl<'de> Visitor<'de> for Choice {
                    type Value = $name;
                    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                        f.write_str($expected)
                    }
                    $($visits)+
                }
                deserializer.deserialize_any(Choice)
            }
        }
    };
}

/// Keys that are one of some words, or else a measured value or two coordinates: the type, what is expected, the words and the value.
macro_rules! choices {
    ($(
        $(#[$doc:meta])*
        $name:ident, $expected:literal: $($(#[$about:meta])* $word:ident = $words:expr),+;
        $kind:ident $value:ident($inner:ty);
    )+) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub(super) enum $name {
            $($(#[$about])* $word,)+
            $value($inner),
        }

        visited! { $name, $expected;
            fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
                $(if $words.contains(&word) {
                    return Ok($name::$word);
                })+
                choices!(@text $kind self word).map($name::$value)
            }
            choices!(@visit $kind $name::$value);
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }
            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                let value = <$inner>::json_schema(generator);
                let words: Vec<&str> = [$($words),+].concat();
                json_schema!({ "anyOf": [{ "enum": words }, value] })
            }
        }
    )+};
    (@text measured $visitor:ident $word:ident) => {
        match $word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) {
            true => Unchecked::deserialize($word.into_deserializer()),
            false => Err(E::invalid_value(Unexpected::Str($word), &$visitor)),
        }
    };
    (@text pair $visitor:ident $word:ident) => {
        Err(E::invalid_value(Unexpected::Str($word), &$visitor))
    };
    (@visit measured $value:path) => {
        fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
            Unchecked::deserialize(value.into_deserializer()).map($value)
        }
        fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
            Unchecked::deserialize(value.into_deserializer()).map($value)
        }
        fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
            Unchecked::deserialize(value.into_deserializer()).map($value)
        }
    };
    (@visit pair $value:path) => {
        fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
            Fixed::deserialize(SeqAccessDeserializer::new(seq)).map($value)
        }
    };
}

/// Keys that are a text, an array or a table: the type and its name in the schema, what is expected, and each form with its value; of a text
/// what it says and an example.
macro_rules! forms {
    ($(
        $(#[$doc:meta])*
        $name:ident $title:literal, $expected:literal:
            $($form:ident $value:ident($inner:ty $(, $about:literal, $example:literal)?)),+;
    )+) => {$(
        $(#[$doc])*
        #[derive(Debug)]
        pub(super) enum $name {
            $($value($inner),)+
        }

        visited! { $name, $expected; $(forms!(@visit $form $name::$value);)+ }

        impl JsonSchema for $name {
            fn schema_name() -> Cow<'static, str> {
                $title.into()
            }
            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                let forms = [$(forms!(@schema generator $inner $(, $about, $example)?)),+];
                json_schema!({ "anyOf": forms })
            }
        }
    )+};
    (@visit text $value:path) => {
        fn visit_str<E>(self, text: &str) -> Result<Self::Value, E> {
            Ok($value(text.into()))
        }
    };
    (@visit array $value:path) => {
        fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
            Vec::deserialize(SeqAccessDeserializer::new(seq)).map($value)
        }
    };
    (@visit table $value:path) => {
        fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
            Box::deserialize(MapAccessDeserializer::new(map)).map($value)
        }
    };
    (@schema $generator:ident $inner:ty) => {
        $generator.subschema_for::<$inner>()
    };
    (@schema $generator:ident $inner:ty, $about:literal, $example:literal) => {
        json_schema!({ "type": "string", "description": $about, "examples": [$example] })
    };
}

/// A curve of force by its slope alone, a scatter by its share alone; or a table that says more.
#[derive(Debug)]
pub(super) enum Curve<M, T> {
    Slope(Unchecked<M>),
    Table(T),
}

impl<'de, M: Measure, T: Deserialize<'de>> Deserialize<'de> for Curve<M, T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice<M, T>(PhantomData<(M, T)>);
        impl<'de, M: Measure, T: Deserialize<'de>> Visitor<'de> for Choice<M, T> {
            type Value = Curve<M, T>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{}, e.g. \"{}\", or a table", M::NAME, M::EXAMPLE)
            }
            choices!(@visit measured Curve::Slope);
            fn visit_str<E: Error>(self, value: &str) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(Curve::Slope)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                T::deserialize(MapAccessDeserializer::new(map)).map(Curve::Table)
            }
        }
        deserializer.deserialize_any(Choice(PhantomData))
    }
}

impl<M: Measure, T: JsonSchema> JsonSchema for Curve<M, T> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        format!("{} or {}", M::NAME, T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let table = generator.subschema_for::<T>();
        let mut schema = Unchecked::<M>::json_schema(generator);
        if let Some(Value::Array(choices)) = schema.get_mut("anyOf") {
            choices.push(table.into());
        }
        schema
    }
}

/// One row of gripper positions along u, each `[x, y, z]` (m).
pub(super) type PositionsRow = Located<Vec<Located<Fixed<Quantity<Coordinate>, 3>>>>;

/// Points of a drawing (m), end to end.
pub(super) type Polygon = Vec<Located<Fixed<Quantity<FabricPoint>, 2>>>;

forms! {
    /// A material by name or file, or in place.
    MaterialChoice "MaterialChoice", "the name of a material, e.g. \"krogh2018\", a .toml file, or a table":
        text Named(String, "a shipped name or a .toml file", "krogh2018"),
        table Table(Box<MaterialTable>);
    /// Gripper positions: a CSV file or a table of rows along v.
    Positions "Positions", "a CSV file, e.g. \"start.csv\", or a table [[[x, y, z], …], …]":
        text File(String, "a CSV file", "start.csv"),
        array Table(Vec<PositionsRow>);
    /// The boundary of a ply that is cut: points, a file, or a table that says more of a file.
    OutlineChoice "Outline", "points [[x, y], …], a DXF file, e.g. \"blank.dxf\", or a table":
        array Points(Polygon),
        text File(String, "a DXF file", "blank.dxf"),
        table Drawing(Box<DrawingTable>);
    /// A hole of a ply that is cut: points, or a circle.
    HoleChoice "Hole", "points [[x, y], …], or a circle { middle = [x, y], diameter = \"40 mm\" }":
        array Points(Polygon),
        table Circle(Box<CircleTable>);
}

choices! {
    /// What holds the sheet along the mold.
    FrictionChoice, "\"stick\", \"stick-for-ever\" or a coefficient of friction, e.g. 0.3":
        Stick = ["stick"].as_slice(), StickForEver = ["stick-for-ever"].as_slice();
        measured Coefficient(Unchecked<Friction>);
    /// The direction of the warp: an axis, or an angle.
    WarpChoice, "\"u\", \"v\" or an angle, e.g. \"45 deg\"":
        U = ["u"].as_slice(), V = ["v"].as_slice();
        measured Angle(Unchecked<Heading>);
    /// A heading, or a word.
    HeadingChoice, "an angle, e.g. \"45 deg\", or \"best\"":
        /// Where the ply shears least.
        Best = ["best"].as_slice();
        measured Angle(Unchecked<Heading>);
    /// Where gripper g0_0 starts.
    PlaceChoice, "a place [x, y] or \"centered\"":
        /// Above the middle of the target.
        Centered = MIDDLE;
        pair At(Fixed<Quantity<Place>, 2>);
    /// The fabric point that is laid first: a point, or a word.
    SeedChoice, "a fabric point [u, v], \"middle\" or \"best\"":
        /// The middle of the ply.
        Middle = MIDDLE,
        /// Where the ply shears least.
        Best = ["best"].as_slice();
        pair At(Fixed<Quantity<FabricPoint>, 2>);
}
