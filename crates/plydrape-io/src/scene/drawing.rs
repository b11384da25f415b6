//! Keys of a ply that is cut which may be written in more than one way: its outline, a hole, the direction of its warp.

use super::file::{CircleTable, DrawingTable};
use super::located::{Fixed, Located};
use super::quantity::Quantity;
use super::usual::FabricPoint;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Deserializer, MapAccess, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// Points of a drawing (m), end to end.
pub(super) type Polygon = Vec<Located<Fixed<Quantity<FabricPoint>, 2>>>;

/// A boundary: points, a file, or a table that says more of a file.
#[derive(Debug)]
pub(super) enum OutlineChoice {
    Points(Polygon),
    File(String),
    Drawing(Box<DrawingTable>),
}

impl<'de> Deserialize<'de> for OutlineChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = OutlineChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("points [[x, y], …], a DXF file, e.g. \"blank.dxf\", or a table")
            }
            fn visit_str<E>(self, file: &str) -> Result<Self::Value, E> {
                Ok(OutlineChoice::File(file.to_string()))
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq)).map(OutlineChoice::Points)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let table = DrawingTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(OutlineChoice::Drawing(Box::new(table)))
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for OutlineChoice {
    fn schema_name() -> Cow<'static, str> {
        "Outline".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let points = generator.subschema_for::<Polygon>();
        let table = generator.subschema_for::<DrawingTable>();
        json_schema!({ "anyOf": [
            points,
            { "type": "string", "description": "a DXF file", "examples": ["blank.dxf"] },
            table
        ]})
    }
}

/// A hole: points, or a circle.
#[derive(Debug)]
pub(super) enum HoleChoice {
    Points(Polygon),
    Circle(Box<CircleTable>),
}

impl<'de> Deserialize<'de> for HoleChoice {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Choice;
        impl<'de> Visitor<'de> for Choice {
            type Value = HoleChoice;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str(
                    "points [[x, y], …], or a circle { middle = [x, y], diameter = \"40 mm\" }",
                )
            }
            fn visit_seq<A: SeqAccess<'de>>(self, seq: A) -> Result<Self::Value, A::Error> {
                Vec::deserialize(SeqAccessDeserializer::new(seq)).map(HoleChoice::Points)
            }
            fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Self::Value, A::Error> {
                let table = CircleTable::deserialize(MapAccessDeserializer::new(map))?;
                Ok(HoleChoice::Circle(Box::new(table)))
            }
        }
        deserializer.deserialize_any(Choice)
    }
}

impl JsonSchema for HoleChoice {
    fn schema_name() -> Cow<'static, str> {
        "Hole".into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let points = generator.subschema_for::<Polygon>();
        let circle = generator.subschema_for::<CircleTable>();
        json_schema!({ "anyOf": [points, circle] })
    }
}
