//! The keys of the table `[limits]`: one of each measure that a scene may bound, and three of their own.

use crate::scene::bound::Kind;
use crate::scene::located::{Fixed, Located, LocatedSeed};
use crate::scene::quantity::{Quantity, Raw, RawSeed};
use crate::scene::usual::{Coordinate, GripSafety};
use plydrape::measure::{Limits, Name, Preset};
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
    pub workspace: Option<Fixed<Fixed<Quantity<Coordinate>, 2>, 3>>,
    /// By how much the grippers' `slip_force` and `holding_force` must exceed the loads.
    pub grip_safety: Option<Quantity<GripSafety>>,
    /// Bounds of measures as they are written.
    pub bounds: Vec<(Name, Located<Raw>)>,
    /// Measures that are bounded by a name of before version 0.1.0, and that name.
    pub renamed: Vec<(Name, String)>,
}

impl LimitsTable {
    /// What to change where a measure has an old name, each in a sentence.
    pub fn notices(&self) -> Vec<String> {
        let notice = |(name, old): &(Name, String)| {
            let now = name.measure().name();
            format!(
                "`{old}` in [limits] is called `{now}` now; rename it, because version 0.2.0 refuses the old name"
            )
        };
        self.renamed.iter().map(notice).collect()
    }
}

/// A key of the table.
#[derive(Deserialize)]
#[serde(try_from = "String")]
enum Key {
    Preset,
    Workspace,
    GripSafety,
    Bound(Name),
    Renamed(Name, String),
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
                    if let Some(name) = Name::renamed(word) {
                        return Ok(Key::Renamed(name, word.into()));
                    }
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
                        Key::Bound(name) => table.bounds.push((name, bound(&mut map, name)?)),
                        Key::Renamed(name, old) => {
                            table.bounds.push((name, bound(&mut map, name)?));
                            table.renamed.push((name, old));
                        }
                    }
                }
                Ok(table)
            }
        }
        deserializer.deserialize_map(Table)
    }
}

/// The value of a bound as it is written.
fn bound<'de, A: MapAccess<'de>>(map: &mut A, name: Name) -> Result<Located<Raw>, A::Error> {
    let Kind { name, example, .. } = Kind::of_measure(name);
    map.next_value_seed(LocatedSeed(RawSeed { name, example }))
}

impl JsonSchema for LimitsTable {
    fn schema_name() -> Cow<'static, str> {
        "Limits".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        // a key for each measure that has a bound
        let mut properties = serde_json::Map::new();
        for (name, bound) in Name::bounded() {
            properties.insert(
                name.measure().name().into(),
                crate::scene::bound::schema(name, &bound, generator),
            );
        }

        // the keys that are no bound of a measure: preset, workspace and safety of the grip
        let mut safety = generator.subschema_for::<Quantity<GripSafety>>();
        safety.insert("default".into(), Limits::GRIP_SAFETY.into());
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
            "A named set of limits, none unless given; the other keys here override it. `plydrape limits` lists them with the source of \
             each figure.",
        );
        own(
            "workspace",
            generator.subschema_for::<Fixed<Fixed<Quantity<Coordinate>, 2>, 3>>(),
            "Box that the grippers must stay in: [from, to] in x, y and z (m); none unless given.",
        );
        own(
            "grip_safety",
            safety,
            "By how much the grippers' `slip_force` and `holding_force` must exceed the loads.",
        );

        // no other keys are allowed
        json_schema!({
            "type": "object",
            "description": "What an accepted drape keeps to.",
            "properties": properties,
            "additionalProperties": false
        })
    }
}
