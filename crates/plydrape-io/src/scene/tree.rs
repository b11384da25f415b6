//! From the tree of a TOML text to the types that say what its keys are.
//!
//! The crate `toml` parses a text to a tree whose values know their places. This walks the tree by reference and gives serde what it
//! meets. There is one reader for tables and one for arrays, because the compiler makes a copy of each for every type of a scene.

use serde::de::value::{StrDeserializer, U64Deserializer};
use serde::de::{
    DeserializeOwned, DeserializeSeed, Deserializer, Error, IntoDeserializer, MapAccess, SeqAccess,
    Unexpected, Visitor,
};
use serde::forward_to_deserialize_any;
use std::fmt;
use std::ops::Range;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Asks [`Tree`] for a value with its place: a sequence of its first byte, the byte behind its last one, and the value.
pub(super) const LOCATED: &str = "a value and its place";

/// Why a text does not have the expected keys, as serde or the TOML parser says it, and the bytes of the text it is about.
#[derive(Debug)]
pub(super) struct Fault {
    pub message: String,
    pub span: Option<Range<usize>>,
}

impl Fault {
    /// This fault, about these bytes unless it has a place already.
    fn placed(mut self, span: Range<usize>) -> Self {
        self.span.get_or_insert(span);
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Fault {}

impl Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Fault { message: message.to_string(), span: None }
    }
}

impl From<toml::de::Error> for Fault {
    fn from(error: toml::de::Error) -> Self {
        Fault { message: error.message().into(), span: error.span() }
    }
}

/// Reads the keys of a TOML text.
///
/// # Errors
/// The text is no TOML, or has other keys or values than `T`.
pub(super) fn read<T: DeserializeOwned>(text: &str) -> Result<T, Fault> {
    let root = DeTable::parse(text)?;
    let span = root.span();
    read_table(root.into_inner(), span)
}

/// Reads the keys of a table, which is written at `span`.
///
/// # Errors
/// The table has other keys or values than `T`.
pub(super) fn read_table<T: DeserializeOwned>(
    table: DeTable<'_>,
    span: Range<usize>,
) -> Result<T, Fault> {
    T::deserialize(Tree(&Spanned::new(span, DeValue::Table(table))))
}

/// A value of the tree.
#[derive(Clone, Copy)]
struct Tree<'t, 'i>(&'t Spanned<DeValue<'i>>);

impl<'de> Deserializer<'de> for Tree<'_, '_> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        let read = match self.0.get_ref() {
            DeValue::String(text) => visitor.visit_str(text),
            DeValue::Integer(number) => {
                let (digits, radix) = (number.as_str(), number.radix());
                if let Ok(number) = i64::from_str_radix(digits, radix) {
                    visitor.visit_i64(number)
                } else if let Ok(number) = u64::from_str_radix(digits, radix) {
                    visitor.visit_u64(number)
                } else {
                    Err(Fault::invalid_type(Unexpected::Other("large integer"), &visitor))
                }
            }
            DeValue::Float(number) => match number.as_str().parse::<f64>() {
                Ok(value) if value.is_finite() || number.as_str().contains(['i', 'n']) => {
                    visitor.visit_f64(value)
                }
                _ => Err(Fault::custom("floating-point number overflowed")),
            },
            DeValue::Boolean(value) => visitor.visit_bool(*value),
            DeValue::Datetime(_) => {
                Err(Fault::invalid_type(Unexpected::Other("date or time"), &visitor))
            }
            DeValue::Array(values) => visitor.visit_seq(Values(values.iter())),
            DeValue::Table(table) => visitor.visit_map(Keys { entries: table.iter(), value: None }),
        };
        read.map_err(|fault| fault.placed(self.0.span()))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_tuple_struct<V: Visitor<'de>>(
        self,
        name: &'static str,
        _: usize,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        if name == LOCATED {
            return visitor.visit_seq(PlacedValue { value: self, given: 0 });
        }
        self.deserialize_any(visitor)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let read = match self.0.get_ref() {
            DeValue::String(word) => {
                let word: StrDeserializer<'_, Fault> = (**word).into_deserializer();
                visitor.visit_enum(word)
            }
            _ => Err(Fault::custom(CHOICE_EXPECTED)),
        };
        read.map_err(|fault| fault.placed(self.0.span()))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple map struct
        identifier ignored_any
    }
}

/// Message for a value that is no text where a choice is expected.
pub(super) const CHOICE_EXPECTED: &str = "expected a choice";

/// The values of an array, one after the other.
struct Values<'t, 'i>(std::slice::Iter<'t, Spanned<DeValue<'i>>>);

impl<'de> SeqAccess<'de> for Values<'_, '_> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Fault> {
        self.0.next().map(|value| seed.deserialize(Tree(value))).transpose()
    }
}

/// The keys of a table with their values, one after the other.
struct Keys<'t, 'i, I> {
    entries: I,
    value: Option<&'t Spanned<DeValue<'i>>>,
}

type Key<'i> = Spanned<std::borrow::Cow<'i, str>>;

impl<'de, 't, 'i, I> MapAccess<'de> for Keys<'t, 'i, I>
where
    I: Iterator<Item = (&'t Key<'i>, &'t Spanned<DeValue<'i>>)>,
{
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Fault> {
        let Some((key, value)) = self.entries.next() else { return Ok(None) };
        self.value = Some(value);
        let name: StrDeserializer<'_, Fault> = (**key.get_ref()).into_deserializer();
        seed.deserialize(name).map(Some).map_err(|fault| fault.placed(key.span()))
    }

    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        let value = self.value.take().ok_or_else(|| Fault::custom("a value before its key"))?;
        seed.deserialize(Tree(value)).map_err(|fault| fault.placed(value.span()))
    }
}

/// The place of a value, and the value.
struct PlacedValue<'t, 'i> {
    value: Tree<'t, 'i>,
    given: u8,
}

impl<'de> SeqAccess<'de> for PlacedValue<'_, '_> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Fault> {
        let Range { start, end } = self.value.0.span();
        self.given += 1;
        let byte = |at: usize| U64Deserializer::new(at as u64);
        let read = match self.given {
            1 => seed.deserialize(byte(start)),
            2 => seed.deserialize(byte(end)),
            _ => seed.deserialize(self.value),
        };
        read.map(Some)
    }
}
