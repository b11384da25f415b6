//! Values of a scene file that know their place, whole numbers and arrays of a fixed length.

use super::tree::LOCATED;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{Deserialize, DeserializeSeed, Deserializer, Error, SeqAccess, Visitor};
use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;
use std::ops::Range;

/// A value and the bytes of the file it came from.
#[derive(Debug, Clone)]
pub(super) struct Located<T> {
    pub value: T,
    pub span: Range<usize>,
}

impl<'de, T: Deserialize<'de>> Deserialize<'de> for Located<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        LocatedSeed(PhantomData::<T>).deserialize(deserializer)
    }
}

/// Reads a value as another seed does, and its place.
pub(super) struct LocatedSeed<S>(pub S);

impl<'de, S: DeserializeSeed<'de>> DeserializeSeed<'de> for LocatedSeed<S> {
    type Value = Located<S::Value>;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Self::Value, D::Error> {
        deserializer.deserialize_tuple_struct(LOCATED, 3, self)
    }
}

impl<'de, S: DeserializeSeed<'de>> Visitor<'de> for LocatedSeed<S> {
    type Value = Located<S::Value>;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(LOCATED)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Self::Value, A::Error> {
        let missing = || A::Error::custom(LOCATED);
        let start = seq.next_element()?.ok_or_else(missing)?;
        let end = seq.next_element()?.ok_or_else(missing)?;
        let value = seq.next_element_seed(self.0)?.ok_or_else(missing)?;
        Ok(Located { value, span: start..end })
    }
}

impl<T: JsonSchema> JsonSchema for Located<T> {
    fn inline_schema() -> bool {
        T::inline_schema()
    }
    fn schema_name() -> Cow<'static, str> {
        T::schema_name()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        T::json_schema(generator)
    }
}

/// A whole number; a schema allows `LEAST` or more.
#[derive(Debug, Clone, Copy)]
pub(super) struct Whole<const LEAST: u8>(pub i128);

/// How many there are of something.
pub(super) type Count = Whole<1>;
/// The seed of a random search.
pub(super) type Seed = Whole<0>;

/// How many there are of what may be missing.
pub(super) type CountOrNone = Whole<0>;

impl<'de, const LEAST: u8> Deserialize<'de> for Whole<LEAST> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Number;
        impl Visitor<'_> for Number {
            type Value = i128;
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a whole number, e.g. 4")
            }
            fn visit_i64<E>(self, value: i64) -> Result<i128, E> {
                Ok(value.into())
            }
            fn visit_u64<E>(self, value: u64) -> Result<i128, E> {
                Ok(value.into())
            }
        }
        deserializer.deserialize_any(Number).map(Whole)
    }
}

impl<const LEAST: u8> JsonSchema for Whole<LEAST> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        format!("whole number from {LEAST}").into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": LEAST })
    }
}

/// An array of exactly `N` values.
#[derive(Debug, Clone)]
pub(super) struct Fixed<T, const N: usize>(pub [T; N]);

impl<'de, T: Deserialize<'de>, const N: usize> Deserialize<'de> for Fixed<T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Values<T, const N: usize>(PhantomData<T>);
        impl<'de, T: Deserialize<'de>, const N: usize> Visitor<'de> for Values<T, N> {
            type Value = [T; N];
            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, "an array of {N} values in square brackets")
            }
            fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<[T; N], A::Error> {
                let mut values = Vec::with_capacity(N);
                while let Some(value) = seq.next_element()? {
                    values.push(value);
                }
                let length = values.len();
                <[T; N]>::try_from(values).map_err(|_| A::Error::invalid_length(length, &self))
            }
        }
        deserializer.deserialize_any(Values::<T, N>(PhantomData)).map(Fixed)
    }
}

impl<T: JsonSchema, const N: usize> JsonSchema for Fixed<T, N> {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        format!("{N} of {}", T::schema_name()).into()
    }
    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let items = generator.subschema_for::<T>();
        json_schema!({ "type": "array", "items": items, "minItems": N, "maxItems": N })
    }
}
