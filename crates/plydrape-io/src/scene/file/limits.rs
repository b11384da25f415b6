//! The keys of the table `[limits]`: one of each measure that a scene may bound, and three of their own.

use crate::scene::bound::{self, Kind};
use crate::scene::located::{Fixed, Located, LocatedSeed};
use crate::scene::quantity::{Length, Quantity, Ratio, Raw, RawSeed};
use plydrape::measure::{Name, Preset};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::Deserialize;
use serde::de::{Deserializer, Error, MapAccess, Visitor};
use std::borrow::Cow;
use std::fmt;
use std::sync::LazyLock;

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
enum Key {
    Preset,
    Workspace,
    GripSafety,
    Bound(Name),
}

const PRESET: &str = "preset";
const WORKSPACE: &str = "workspace";
const GRIP_SAFETY: &str = "grip_safety";

/// All keys, those of measures in the order of tables.
static KEYS: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let bounds = Name::bounded().map(|(name, _)| name.measure().name());
    [PRESET].into_iter().chain(bounds).chain([WORKSPACE, GRIP_SAFETY]).collect()
});

impl<'de> Deserialize<'de> for Key {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Word;
        impl Visitor<'_> for Word {
            type Value = Key;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a key")
            }
            fn visit_str<E: Error>(self, word: &str) -> Result<Key, E> {
                match word {
                    PRESET => Ok(Key::Preset),
                    WORKSPACE => Ok(Key::Workspace),
                    GRIP_SAFETY => Ok(Key::GripSafety),
                    word => Name::bounded()
                        .find(|(name, _)| name.measure().name() == word)
                        .map(|(name, _)| Key::Bound(name))
                        .ok_or_else(|| E::unknown_field(word, &KEYS)),
                }
            }
        }
        deserializer.deserialize_str(Word)
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
            PRESET,
            json_schema!({ "oneOf": words.collect::<Vec<_>>() }),
            "A named set of limits, none unless given; the other keys here stand over it. `plydrape limits` lists them with the source of \
             each figure.",
        );
        own(
            WORKSPACE,
            generator.subschema_for::<Fixed<Fixed<Quantity<Length>, 2>, 3>>(),
            "Box that the grippers must stay in: [from, to] in x, y and z (m); none unless given.",
        );
        own(
            GRIP_SAFETY,
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
