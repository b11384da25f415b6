//! Looks at every number of a serializable value and names the first that is NaN or infinite.
//!
//! A serializer that writes nothing: it follows the value through its keys and indices and keeps the
//! path, so that the error can say `steps[3].grippers[0].position[2]`.

use crate::Error;
use serde::ser::{self, Serialize, Serializer};
use std::fmt::{self, Display};

/// Refuses a value that holds a NaN or an infinity.
pub(crate) fn check<T: Serialize + ?Sized>(value: &T) -> Result<(), Error> {
    within(value, f64::MAX)
}

/// Refuses a value that holds a NaN, or a number beyond `most` in size.
pub(crate) fn within<T: Serialize + ?Sized>(value: &T, most: f64) -> Result<(), Error> {
    let mut walk = Walk { path: Vec::new(), most };
    value.serialize(&mut walk).map_err(|fault| match fault {
        Fault::Number(value) => Error::NotFinite { key: walk.key(), value },
        Fault::Other(what) => Error::json(what),
    })
}

/// One step of a path through a value.
enum Part {
    Key(&'static str),
    MapKey,
    Index(usize),
}

/// The path to where the serializer is; left standing at the first fault.
struct Walk {
    path: Vec<Part>,
    /// Largest number in size.
    most: f64,
}

impl Walk {
    fn key(&self) -> String {
        let mut key = String::new();
        for part in &self.path {
            match part {
                Part::Key(name) if key.is_empty() => key.push_str(name),
                Part::Key(name) => key.push_str(&format!(".{name}")),
                Part::MapKey => key.push_str(".*"),
                Part::Index(index) => key.push_str(&format!("[{index}]")),
            }
        }
        key
    }

    fn number(&self, value: f64) -> Result<(), Fault> {
        if value.abs() <= self.most { Ok(()) } else { Err(Fault::Number(value)) }
    }

    /// Looks at a value one step further on.
    fn enter<T: Serialize + ?Sized>(&mut self, part: Part, value: &T) -> Result<(), Fault> {
        self.path.push(part);
        value.serialize(&mut *self)?;
        self.path.pop();
        Ok(())
    }
}

#[derive(Debug)]
enum Fault {
    Number(f64),
    Other(String),
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Fault::Number(value) => write!(f, "{value} is not a finite number"),
            Fault::Other(what) => f.write_str(what),
        }
    }
}

impl std::error::Error for Fault {}

impl ser::Error for Fault {
    fn custom<T: Display>(what: T) -> Self {
        Fault::Other(what.to_string())
    }
}

/// A list in the middle of the walk.
struct Items<'a> {
    walk: &'a mut Walk,
    next: usize,
}

/// Values without numbers that could be at fault.
macro_rules! plain {
    ($($name:ident: $type:ty),*) => {
        $(fn $name(self, _: $type) -> Result<(), Fault> { Ok(()) })*
    };
}

impl<'a> Serializer for &'a mut Walk {
    type Ok = ();
    type Error = Fault;
    type SerializeSeq = Items<'a>;
    type SerializeTuple = Items<'a>;
    type SerializeTupleStruct = Items<'a>;
    type SerializeTupleVariant = Items<'a>;
    type SerializeMap = &'a mut Walk;
    type SerializeStruct = &'a mut Walk;
    type SerializeStructVariant = &'a mut Walk;

    plain!(serialize_bool: bool, serialize_i8: i8, serialize_i16: i16, serialize_i32: i32,
        serialize_i64: i64, serialize_u8: u8, serialize_u16: u16, serialize_u32: u32,
        serialize_u64: u64, serialize_char: char, serialize_str: &str, serialize_bytes: &[u8],
        serialize_unit_struct: &'static str);

    fn serialize_f32(self, value: f32) -> Result<(), Fault> {
        self.number(f64::from(value))
    }
    fn serialize_f64(self, value: f64) -> Result<(), Fault> {
        self.number(value)
    }
    fn serialize_none(self) -> Result<(), Fault> {
        Ok(())
    }
    fn serialize_unit(self) -> Result<(), Fault> {
        Ok(())
    }
    fn serialize_some<T: Serialize + ?Sized>(self, value: &T) -> Result<(), Fault> {
        value.serialize(self)
    }
    fn serialize_unit_variant(self, _: &'static str, _: u32, _: &'static str) -> Result<(), Fault> {
        Ok(())
    }
    fn serialize_newtype_struct<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        value: &T,
    ) -> Result<(), Fault> {
        value.serialize(self)
    }
    fn serialize_newtype_variant<T: Serialize + ?Sized>(
        self,
        _: &'static str,
        _: u32,
        variant: &'static str,
        value: &T,
    ) -> Result<(), Fault> {
        self.enter(Part::Key(variant), value)
    }
    fn serialize_seq(self, _: Option<usize>) -> Result<Items<'a>, Fault> {
        Ok(Items { walk: self, next: 0 })
    }
    fn serialize_tuple(self, length: usize) -> Result<Items<'a>, Fault> {
        self.serialize_seq(Some(length))
    }
    fn serialize_tuple_struct(self, _: &'static str, length: usize) -> Result<Items<'a>, Fault> {
        self.serialize_seq(Some(length))
    }
    fn serialize_tuple_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        length: usize,
    ) -> Result<Items<'a>, Fault> {
        self.serialize_seq(Some(length))
    }
    fn serialize_map(self, _: Option<usize>) -> Result<Self, Fault> {
        Ok(self)
    }
    fn serialize_struct(self, _: &'static str, _: usize) -> Result<Self, Fault> {
        Ok(self)
    }
    fn serialize_struct_variant(
        self,
        _: &'static str,
        _: u32,
        _: &'static str,
        _: usize,
    ) -> Result<Self, Fault> {
        Ok(self)
    }
}

/// The four kinds of lists walk alike.
macro_rules! list {
    ($($trait:ident: $item:ident),*) => {
        $(impl ser::$trait for Items<'_> {
            type Ok = ();
            type Error = Fault;
            fn $item<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Fault> {
                self.next += 1;
                self.walk.enter(Part::Index(self.next - 1), value)
            }
            fn end(self) -> Result<(), Fault> {
                Ok(())
            }
        })*
    };
}
list!(SerializeSeq: serialize_element, SerializeTuple: serialize_element,
    SerializeTupleStruct: serialize_field, SerializeTupleVariant: serialize_field);

/// Both kinds of records walk alike.
macro_rules! record {
    ($($trait:ident),*) => {
        $(impl ser::$trait for &mut Walk {
            type Ok = ();
            type Error = Fault;
            fn serialize_field<T: Serialize + ?Sized>(
                &mut self,
                key: &'static str,
                value: &T,
            ) -> Result<(), Fault> {
                self.enter(Part::Key(key), value)
            }
            fn end(self) -> Result<(), Fault> {
                Ok(())
            }
        })*
    };
}
record!(SerializeStruct, SerializeStructVariant);

impl ser::SerializeMap for &mut Walk {
    type Ok = ();
    type Error = Fault;
    fn serialize_key<T: Serialize + ?Sized>(&mut self, _: &T) -> Result<(), Fault> {
        Ok(())
    }
    fn serialize_value<T: Serialize + ?Sized>(&mut self, value: &T) -> Result<(), Fault> {
        self.enter(Part::MapKey, value)
    }
    fn end(self) -> Result<(), Fault> {
        Ok(())
    }
}
