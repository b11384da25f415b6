//! Keys that may be written in more than one way: a material, a measured curve, friction, a table of positions, a place.

use super::file::MaterialTable;
use super::located::{Fixed, Located};
use super::quantity::{Angle, Coefficient, Length, Measure, Quantity, Unchecked};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, Error, IntoDeserializer, MapAccess, SeqAccess, Unexpected, Visitor};
use serde_json::Value;
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

/// A material by name or file, or in place.
#[derive(Debug)]
pub(super) enum MaterialChoice {
    Named(String),
    Table(Box<MaterialTable>),
}

impl<'de> Deserialize<'de> for MaterialChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = MaterialChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("the name of a material, e.g. \"krogh2018\", a .toml file, or a table")
            }
            fn visit_str<E>(self, name: &str) -> Result<Self::Value, E> {
                Ok(MaterialChoice::Named(name.to_string()))
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let table = MaterialTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(MaterialChoice::Table(Box::new(table)))
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for MaterialChoice {
    fn schema_name() -> Cow<'static, str> {
        "MaterialChoice".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let table = generator.subschema_for::<MaterialTable>();
        json_schema!({ "anyOf": [
            { "type": "string", "description": "a shipped name or a .toml file", "examples": ["krogh2018"] },
            table
        ]})
    }
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
            fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(Curve::Slope)
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(Curve::Slope)
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(Curve::Slope)
            }
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

/// What holds the sheet along the mold.
#[derive(Debug)]
pub(super) enum FrictionChoice {
    Stick,
    StickForEver,
    Coefficient(Unchecked<Coefficient>),
}

impl<'de> Deserialize<'de> for FrictionChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl Visitor<'_> for Choice {
            type Value = FrictionChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("\"stick\", \"stick-for-ever\" or a coefficient of friction, e.g. 0.3")
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
                self.visit_f64(value as f64)
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
                self.visit_f64(value as f64)
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(FrictionChoice::Coefficient)
            }
            fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
                match word {
                    "stick" => Ok(FrictionChoice::Stick),
                    "stick-for-ever" => Ok(FrictionChoice::StickForEver),
                    _ if word.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {
                        Unchecked::deserialize(word.into_deserializer())
                            .map(FrictionChoice::Coefficient)
                    }
                    _ => Err(E::invalid_value(Unexpected::Str(word), &self)),
                }
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for FrictionChoice {
    fn schema_name() -> Cow<'static, str> {
        "Friction".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [
            { "type": "string", "description": "\"stick\", \"stick-for-ever\", or a coefficient", "examples": ["stick", "stick-for-ever"] },
            { "type": "number", "minimum": 0, "description": "a coefficient of friction" }
        ]})
    }
}

/// One row of gripper positions along u, each `[x, y, z]` (m).
pub(super) type PositionsRow = Located<Vec<Located<Fixed<Quantity<Length>, 3>>>>;

/// Gripper positions: a CSV file or a table of rows along v.
#[derive(Debug)]
pub(super) enum Positions {
    File(String),
    Table(Vec<PositionsRow>),
}

impl<'de> Deserialize<'de> for Positions {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = Positions;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a CSV file, e.g. \"start.csv\", or a table [[[x, y, z], …], …]")
            }
            fn visit_str<E>(self, file: &str) -> Result<Self::Value, E> {
                Ok(Positions::File(file.to_string()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq)).map(Positions::Table)
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for Positions {
    fn schema_name() -> Cow<'static, str> {
        "Positions".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let rows = generator.subschema_for::<Vec<PositionsRow>>();
        json_schema!({ "anyOf": [
            { "type": "string", "description": "a CSV file", "examples": ["start.csv"] },
            rows
        ]})
    }
}

/// A keyword that may stand for a place.
pub(super) trait Keyword {
    /// The keyword.
    const KEYWORD: &'static str;
    /// Other words for it.
    const ALIASES: &'static [&'static str];
    /// The place by its coordinates.
    const PAIR: &'static str;
}

/// Words for the middle; a key takes all of them and documents one.
pub(super) const MIDDLE: &[&str] = &["middle", "center", "centre", "centered", "centred"];

/// Above the middle of the target.
#[derive(Debug, Clone, Copy)]
pub(super) struct Centered;
impl Keyword for Centered {
    const KEYWORD: &'static str = "centered";
    const ALIASES: &'static [&'static str] = &["centred", "center", "centre", "middle"];
    const PAIR: &'static str = "a place [x, y]";
}

/// Two coordinates (m), or a keyword.
#[derive(Debug)]
pub(super) enum PlaceChoice<W> {
    Keyword(PhantomData<W>),
    At(Fixed<Quantity<Length>, 2>),
}

impl<'de, W: Keyword> Deserialize<'de> for PlaceChoice<W> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice<W>(PhantomData<W>);
        impl<'de, W: Keyword> Visitor<'de> for Choice<W> {
            type Value = PlaceChoice<W>;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "{} or \"{}\"", W::PAIR, W::KEYWORD)
            }
            fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
                if word == W::KEYWORD || W::ALIASES.contains(&word) {
                    return Ok(PlaceChoice::Keyword(PhantomData));
                }
                Err(E::invalid_value(Unexpected::Str(word), &self))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
                Fixed::deserialize(SeqAccessDeserializer::new(seq)).map(PlaceChoice::At)
            }
        }
        deserializer.deserialize_any(Choice(PhantomData))
    }
}

impl<W: Keyword> JsonSchema for PlaceChoice<W> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        W::KEYWORD.into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let pair = generator.subschema_for::<Fixed<Quantity<Length>, 2>>();
        let words: Vec<&str> = [W::KEYWORD].iter().chain(W::ALIASES).copied().collect();
        json_schema!({ "anyOf": [{ "enum": words }, pair] })
    }
}

/// The word that has something searched for.
const BEST: &str = "best";

/// The fabric point that is laid first: a point, or a keyword.
#[derive(Debug)]
pub(super) enum SeedChoice {
    /// The middle of the ply.
    Middle,
    /// Where the ply shears least.
    Best,
    At(Fixed<Quantity<Length>, 2>),
}

impl<'de> Deserialize<'de> for SeedChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = SeedChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a fabric point [u, v], \"middle\" or \"best\"")
            }
            fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
                match word {
                    word if MIDDLE.contains(&word) => Ok(SeedChoice::Middle),
                    BEST => Ok(SeedChoice::Best),
                    _ => Err(E::invalid_value(Unexpected::Str(word), &self)),
                }
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
                Fixed::deserialize(SeqAccessDeserializer::new(seq)).map(SeedChoice::At)
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for SeedChoice {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "FabricPoint".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let pair = generator.subschema_for::<Fixed<Quantity<Length>, 2>>();
        let words: Vec<&str> = MIDDLE.iter().chain([&BEST]).copied().collect();
        json_schema!({ "anyOf": [{ "enum": words }, pair] })
    }
}

/// A heading, or a keyword.
#[derive(Debug)]
pub(super) enum HeadingChoice {
    /// Where the ply shears least.
    Best,
    Angle(Unchecked<Angle>),
}

impl<'de> Deserialize<'de> for HeadingChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl Visitor<'_> for Choice {
            type Value = HeadingChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an angle, e.g. \"45 deg\", or \"best\"")
            }
            fn visit_i64<E: Error>(self, value: i64) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(HeadingChoice::Angle)
            }
            fn visit_u64<E: Error>(self, value: u64) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(HeadingChoice::Angle)
            }
            fn visit_f64<E: Error>(self, value: f64) -> Result<Self::Value, E> {
                Unchecked::deserialize(value.into_deserializer()).map(HeadingChoice::Angle)
            }
            fn visit_str<E: Error>(self, word: &str) -> Result<Self::Value, E> {
                match word {
                    BEST => Ok(HeadingChoice::Best),
                    _ => Unchecked::deserialize(word.into_deserializer()).map(HeadingChoice::Angle),
                }
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for HeadingChoice {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Heading".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut schema = Unchecked::<Angle>::json_schema(generator);
        if let Some(Value::Array(choices)) = schema.get_mut("anyOf") {
            choices.push(json_schema!({ "const": BEST }).into());
        }
        schema
    }
}
