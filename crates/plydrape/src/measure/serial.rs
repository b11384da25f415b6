//! How measures are written by serde: a [`Name`] as itself, values by the measure's key.

use super::{ByName, Limits, Name, Preset};
use serde::de::{Error, MapAccess, Visitor};
use serde::ser::SerializeMap;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeMap;
use std::fmt;

impl Serialize for Name {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.measure().name())
    }
}

impl<'de> Deserialize<'de> for Name {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        let text = String::deserialize(from)?;
        let named = |name: &&Name| name.measure().name() == text;
        Name::ALL
            .iter()
            .find(named)
            .copied()
            .or_else(|| Name::renamed(&text))
            .ok_or_else(|| serde::de::Error::custom(format!("there is no limit called `{text}`")))
    }
}

impl<T: Serialize> Serialize for ByName<T> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(Some(self.iter().count()))?;
        for (name, value) in self.iter() {
            map.serialize_entry(name.measure().key(), value)?;
        }
        map.end()
    }
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for ByName<T> {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        struct Keys<T>(std::marker::PhantomData<T>);
        impl<'de, T: Deserialize<'de>> Visitor<'de> for Keys<T> {
            type Value = ByName<T>;

            fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
                f.write_str("measures by their keys")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Self::Value, A::Error> {
                let mut out = ByName::default();
                while let Some(key) = map.next_key::<String>()? {
                    let own = |name: &&Name| name.measure().key() == key;
                    let old = || Name::renamed(key.strip_suffix("_deg")?);
                    let name =
                        Name::ALL.iter().find(own).copied().or_else(old).ok_or_else(|| {
                            A::Error::custom(format!("there is no measure called `{key}`"))
                        })?;
                    out.set(name, Some(map.next_value()?));
                }
                Ok(out)
            }
        }
        from.deserialize_map(Keys(std::marker::PhantomData))
    }
}

impl Serialize for Limits {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        let mut map = to.serialize_map(None)?;
        map.serialize_entry("preset", &self.preset)?;
        map.serialize_entry("workspace", &self.workspace)?;
        map.serialize_entry("grip_safety", &self.grip_safety)?;
        for (name, bound) in self.iter() {
            map.serialize_entry(&name, &bound)?;
        }
        map.end()
    }
}

impl<'de> Deserialize<'de> for Limits {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        #[derive(Deserialize)]
        struct Written {
            preset: Option<Preset>,
            workspace: Option<[[f64; 2]; 3]>,
            grip_safety: f64,
            #[serde(flatten)]
            bounds: BTreeMap<Name, f64>,
        }
        let Written { preset, workspace, grip_safety, bounds } = Written::deserialize(from)?;
        if let Some(name) = bounds.keys().find(|name| name.measure().bound().is_none()) {
            let name = name.measure().name();
            return Err(D::Error::custom(format!(
                "the limit `{name}` follows from other settings"
            )));
        }
        Ok(Limits { preset, bounds: bounds.into_iter().collect(), workspace, grip_safety })
    }
}
