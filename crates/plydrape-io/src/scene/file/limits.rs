//! The keys of the table `[limits]`: one of each measure that a scene may bound, and three of their own.

use crate::scene::bound::{self, Kind};
use crate::scene::located::{Fixed, Located, LocatedSeed};
use crate::scene::quantity::{Length, Quantity, Ratio, Raw, RawSeed};
use plydrape::measure::{Name, Preset};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, MapAccess, Visitor};
use std::borrow::Cow;
use std::fmt;

/// What an accepted drape keeps to.
#[derive(Debug, Default)]
pub(in crate::scene) struct LimitsTable {
    /// A named set of limits.
    pub preset: Option<Located<Preset>>,
    /// Box that the grippers must stay in: [from, to] in x, y and z (m).
    pub workspace: Option<Fixed<Fixed<Quantity<Length>, 2>, 3>>,
    /// By how much the grippers' `slip_force` and `holding_force` must exceed the loads.
    pub grip_safety: Option<Quantity<Ratio>>,
    /// Bounds of measures as they are written.
    pub bounds: Vec<(Name, Located<Raw>)>,
}

/// A key of the table.
#[derive(Deserialize)]
#[serde(try_from = "String")]
enum Key {
    Preset,
    Workspace,
    GripSafety,
    Bound(Name),
}

impl TryFrom<String> for Key {
    type Error = String;

    fn try_from(word: String) -> Result<Key, String> {
        let bounded: Vec<Name> = Name::bounded().map(|(name, _)| name).collect();
        let called = |name: &Name| name.measure().name();
        match word.as_str() {
            "preset" => Ok(Key::Preset),
            "workspace" => Ok(Key::Workspace),
            "grip_safety" => Ok(Key::GripSafety),
            word => match bounded.iter().find(|name| called(name) == word) {
                Some(name) => Ok(Key::Bound(*name)),
                None => {
                    // in the words of serde
                    let bounds = bounded.iter().map(called).collect::<Vec<_>>().join("`, `");
                    let known = format!("`preset`, `{bounds}`, `workspace`, `grip_safety`");
                    Err(format!("unknown field `{word}`, expected one of {known}"))
                }
            },
        }
    }
}

impl<'de> Deserialize<'de> for LimitsTable {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Table;
        impl<'de> Visitor<'de> for Table {
            type Value = LimitsTable;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of keys and values")
            }
            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<LimitsTable, A::Error> {
                let mut table = LimitsTable::default();
                while let Some(key) = map.next_key()? {
                    match key {
                        Key::Preset => table.preset = Some(map.next_value()?),
                        Key::Workspace => table.workspace = Some(map.next_value()?),
                        Key::GripSafety => table.grip_safety = Some(map.next_value()?),
                        Key::Bound(name) => {
                            let Kind { name: wanted, example, .. } = Kind::of(name);
                            let seed = LocatedSeed(RawSeed { name: wanted, example });
                            table.bounds.push((name, map.next_value_seed(seed)?));
                        }
                    }
                }
                Ok(table)
            }
        }
        deserializer.deserialize_map(Table)
    }
}

impl JsonSchema for LimitsTable {
    fn schema_name() -> Cow<'static, str> {
        "Limits".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let mut properties = serde_json::Map::new();
        for (name, bound) in Name::bounded() {
            properties.insert(name.measure().name().into(), bound::schema(name, &bound, generator));
        }
        let mut own = |key: &str, mut schema: Schema, about: &str| {
            schema.insert("description".into(), about.into());
            properties.insert(key.into(), schema.into());
        };
        let words = Preset::ALL.iter().map(|preset| {
            let about = format!("{}.", preset.about());
            json_schema!({ "const": preset.name(), "type": "string", "description": about })
        });
        own(
            "preset",
            json_schema!({ "oneOf": words.collect::<Vec<_>>() }),
            "A named set of limits, none unless given; the other keys here stand over it. `plydrape limits` lists them with the source of \
             each figure.",
        );
        own(
            "workspace",
            generator.subschema_for::<Fixed<Fixed<Quantity<Length>, 2>, 3>>(),
            "Box that the grippers must stay in: [from, to] in x, y and z (m); none unless given.",
        );
        own(
            "grip_safety",
            generator.subschema_for::<Quantity<Ratio>>(),
            "By how much the grippers' `slip_force` and `holding_force` must exceed the loads, 1.5 unless given.",
        );
        json_schema!({
            "type": "object",
            "description": "What an accepted drape keeps to.",
            "properties": properties,
            "additionalProperties": false
        })
    }
}
