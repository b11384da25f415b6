//! Where a camera saw the ply: the file of `plydrape replan --picked`.

use super::located::{Fixed, Located};
use super::quantity::{Measure, Quantity, Read};
use super::read;
use super::source::Document;
use super::usual::{Landed, Place, Shift, Yaw};
use crate::Error;
use plydrape::pick_up::Offset;
use serde::de::{Error as _, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use std::fmt;
use std::path::Path;

/// An offset as it was seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SeenOffset {
    /// How far the ply lies from where it was planned.
    pub offset: Offset,
    /// The largest distance of a seen point from where the offset puts it (m); `None` where the offset is given.
    pub residual: Option<f64>,
    /// Whether somebody said that the ply does lie as far off as this is.
    pub far: bool,
}

impl SeenOffset {
    /// This offset, confirmed as far as it is if somebody has confirmed it.
    #[must_use]
    pub fn also_far(self, far: bool) -> Self {
        SeenOffset { far: self.far || far, ..self }
    }
}

/// The keys of the file.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
struct OffsetFile {
    /// The offset itself.
    offset: Option<Located<OffsetTable>>,
    /// Points that were seen.
    #[serde(default)]
    point: Vec<Located<PointTable>>,
    /// How far a point may be from where the others put it.
    tolerance: Option<Quantity<Landed>>,
    /// Whether the ply does lie more than 50 mm or 10° off.
    #[serde(default)]
    far: bool,
}

/// The table `[offset]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
struct OffsetTable {
    /// Shift along x (m), 0 unless given.
    x: Option<Quantity<Shift>>,
    /// Shift along y (m), 0 unless given.
    y: Option<Quantity<Shift>>,
    /// Turn about the upright axis (rad), 0 unless given.
    yaw: Option<Quantity<Yaw>>,
    /// Where this axis is; the middle of the grippers at the start unless given.
    about: Option<Fixed<Quantity<Place>, 2>>,
}

/// A table `[[point]]`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table of keys and values")]
struct PointTable {
    /// Where it is in the plan (m).
    planned: Fixed<Quantity<Place>, 2>,
    /// Where it was seen (m).
    seen: Fixed<Quantity<Place>, 2>,
}

/// Reads the file; points may be `tolerance` (m) from where the others put them, unless the file says otherwise.
///
/// # Errors
/// The first fault found, with its place and a remedy.
pub fn read_offset(path: &Path, tolerance: f64) -> Result<SeenOffset, Error> {
    let document = read::text(path, &path.to_string_lossy(), read::LARGEST_TOML)?;
    offset(&document, tolerance)
}

/// Reads the text of such a file, named `name` in messages.
///
/// # Errors
/// As [`read_offset`].
pub fn parse_offset(text: &str, name: &str, tolerance: f64) -> Result<SeenOffset, Error> {
    offset(&Document::new(name, text), tolerance)
}

/// A line of a program: where it says the ply was seen, and the `id` that its answer repeats.
#[derive(Debug)]
pub struct Request {
    /// A text or a number, if there is one, though the rest is refused.
    pub id: Option<serde_json::Value>,
    /// The offset, or what is wrong with the line.
    pub seen: Result<SeenOffset, Error>,
}

/// Reads a JSON object with the keys of such a file, and an `id`: numbers are in SI units, texts have a unit. A fault is that of [`read_offset`], without a
/// place, since a message of one line has no lines; a key that is there twice is one.
#[must_use]
pub fn json_offset(text: &str, tolerance: f64) -> Request {
    let document = Document::new("standard input", "");
    let help = "expected an object, as in {\"offset\": {\"x\": 0.003, \"y\": \"-1.5 mm\", \"yaw\": \"0.8 deg\"}}";
    let refused =
        |message: String| Request { id: None, seen: Err(document.error_anywhere(message, help)) };
    let mut object = match serde_json::from_str(text) {
        Ok(Unique(serde_json::Value::Object(object))) => object,
        Ok(_) => return refused("this is no JSON object".into()),
        Err(fault) if fault.is_data() => return refused(fault.to_string()),
        Err(fault) => return refused(format!("this is not JSON: {fault}")),
    };
    let id = object.remove("id");
    if id.as_ref().is_some_and(|id| !(id.is_string() || id.is_number())) {
        return refused("an id is a text or a number".into());
    }
    let keys =
        object.iter().map(|(key, value)| Some(format!("{} = {}\n", quoted(key), toml_of(value)?)));
    let Some(text) = keys.collect::<Option<String>>() else {
        return Request { id, ..refused("a value is null, which means nothing here".into()) };
    };
    let seen = parse_offset(&text, "standard input", tolerance).map_err(|error| match error {
        Error::Scene(fault) => document.error_anywhere(fault.message, fault.help),
        other => other,
    });
    Request { id, seen }
}

/// A JSON value in which no object has a key twice.
struct Unique(serde_json::Value);

impl<'de> Deserialize<'de> for Unique {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Self, D::Error> {
        from.deserialize_any(UniqueVisitor)
    }
}

struct UniqueVisitor;

/// Values without keys.
macro_rules! plain {
    ($($name:ident: $type:ty),+) => {
        $(fn $name<E>(self, value: $type) -> Result<Unique, E> { Ok(Unique(value.into())) })+
    };
}

impl<'de> Visitor<'de> for UniqueVisitor {
    type Value = Unique;

    fn expecting(&self, to: &mut fmt::Formatter<'_>) -> fmt::Result {
        to.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Unique, E> {
        Ok(Unique(serde_json::Value::Null))
    }

    plain!(visit_bool: bool, visit_i64: i64, visit_u64: u64, visit_f64: f64, visit_str: &str);

    fn visit_seq<A: SeqAccess<'de>>(self, mut from: A) -> Result<Unique, A::Error> {
        let mut values = Vec::new();
        while let Some(Unique(value)) = from.next_element()? {
            values.push(value);
        }
        Ok(Unique(values.into()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut from: A) -> Result<Unique, A::Error> {
        let mut object = serde_json::Map::new();
        while let Some((key, Unique(value))) = from.next_entry::<String, Unique>()? {
            if object.contains_key(&key) {
                return Err(A::Error::custom(format!("the key `{key}` is there twice")));
            }
            object.insert(key, value);
        }
        Ok(Unique(object.into()))
    }
}

/// A JSON value as TOML; `None` for null.
fn toml_of(value: &serde_json::Value) -> Option<String> {
    use serde_json::Value;
    Some(match value {
        Value::Null => return None,
        Value::Bool(_) => value.to_string(),
        // a whole number beyond those of TOML is a number all the same
        Value::Number(number) if number.is_i64() => number.to_string(),
        Value::Number(number) => format!("{:?}", number.as_f64()?),
        Value::String(text) => quoted(text),
        Value::Array(values) => {
            let values: Option<Vec<String>> = values.iter().map(toml_of).collect();
            format!("[{}]", values?.join(", "))
        }
        Value::Object(keys) => {
            let keys = keys
                .iter()
                .map(|(key, value)| Some(format!("{} = {}", quoted(key), toml_of(value)?)));
            format!("{{ {} }}", keys.collect::<Option<Vec<String>>>()?.join(", "))
        }
    })
}

/// A text in quotes: the escapes of JSON are escapes of TOML.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn offset(document: &Document, tolerance: f64) -> Result<SeenOffset, Error> {
    let OffsetFile { offset, point, tolerance: own, far } = read::keys(document)?;
    let pair = |fixed: &Fixed<Quantity<Place>, 2>| -> Result<[f64; 2], Error> {
        let [x, y] = fixed.0.each_ref().map(|given| place(given, document));
        Ok([x?, y?])
    };
    match (offset, point.as_slice()) {
        (Some(table), []) => {
            // a shift and a turn that are given as numbers
            let OffsetTable { x, y, yaw, about } = &table.value;
            if x.is_none() && y.is_none() && yaw.is_none() {
                return Err(document.error(
                    table.span,
                    "the offset has none of x, y and yaw",
                    "write x = 0 if the ply does lie where it was planned; a camera that found nothing has no offset",
                ));
            }
            let shift = |given: &Option<Quantity<Shift>>| {
                given.as_ref().map_or(Ok(0.0), |given| place(given, document))
            };
            let yaw = match yaw {
                Some(yaw) => angle(yaw, document)?,
                None => 0.0,
            };
            let about = about.as_ref().map(pair).transpose()?;
            let offset = Offset { shift: [shift(x)?, shift(y)?], yaw, about };
            // a tolerance says how well seen points must fit together
            if let Some(own) = own {
                return Err(document.error(
                    own.span,
                    "a tolerance has no meaning for an offset",
                    "it is for seen points: leave it out",
                ));
            }
            Ok(SeenOffset { offset, residual: None, far })
        }
        (None, [first, ..]) => {
            // the offset that brings planned points to where they were seen
            let pairs = point
                .iter()
                .map(|point| Ok((pair(&point.value.planned)?, pair(&point.value.seen)?)));
            let pairs: Vec<_> = pairs.collect::<Result<_, Error>>()?;
            let tolerance = match own {
                Some(own) => own.read(document)?,
                None => tolerance,
            };
            // a point that does not fit is named, other faults are shown at the first one
            let (offset, residual) = Offset::of_points(&pairs, tolerance).map_err(|fault| {
                let span = match fault {
                    plydrape::Error::OffsetDistorted { point: n, .. } => point[n].span.clone(),
                    _ => first.span.clone(),
                };
                document.error(span, fault.to_string(), fault.remedy())
            })?;
            Ok(SeenOffset { offset, residual: Some(residual), far })
        }
        (Some(table), _) => Err(document.error(
            table.span,
            "there are both an offset and points",
            "give one of both",
        )),
        (None, []) => Err(document.error_anywhere(
            format!("`{}` has neither an offset nor points", document.file),
            "add [offset] with x, y and yaw, or [[point]] with planned and seen, two at least",
        )),
    }
}

/// A coordinate or a shift (m).
fn place<M: Measure>(given: &Quantity<M>, document: &Document) -> Result<f64, Error> {
    let value = given.si(document, &M::usual().within([0.0, plydrape::ply::FARTHEST]))?;
    match value.abs() <= plydrape::ply::FARTHEST {
        true => Ok(value),
        false => Err(document.error(
            given.span.clone(),
            format!("{} is beyond all cells", document.quoted(&given.span)),
            "expected a length up to 1e6 m, e.g. \"3 mm\"",
        )),
    }
}

/// A yaw (rad).
fn angle(given: &Quantity<Yaw>, document: &Document) -> Result<f64, Error> {
    let value = given.si(document, &Yaw::USUAL.within([0.0, std::f64::consts::PI]))?;
    match value.abs() <= std::f64::consts::PI {
        true => Ok(value),
        false => Err(document.error(
            given.span.clone(),
            format!("{} is more than half a turn", document.quoted(&given.span)),
            "expected an angle from -180 deg to 180 deg, e.g. \"0.8 deg\"; a plain number, without quotes, is in rad",
        )),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<SeenOffset, Error> {
        parse_offset(text, "offset.toml", 2e-3)
    }

    /// Units as scenes have them; what is left out is zero, and the same keys as JSON say the same.
    #[test]
    fn an_offset_is_read_with_its_units() {
        let text =
            "[offset]\nx = \"3 mm\"\ny = -0.0015\nyaw = \"0.8 deg\"\nabout = [\"1 m\", 0.2]\n";
        let SeenOffset { offset, residual, .. } = parse(text).unwrap();
        assert_eq!(offset.shift, [0.003, -0.0015]);
        assert!((offset.yaw - 0.8_f64.to_radians()).abs() < 1e-15);
        assert_eq!((offset.about, residual), (Some([1.0, 0.2]), None));
        let json = "{\"offset\": {\"x\": \"3 mm\", \"y\": -0.0015, \"yaw\": \"0.8 deg\", \"about\": [1, \"0.2 m\"]}}";
        assert_eq!(json_offset(json, 2e-3).seen.unwrap().offset, offset);
        assert_eq!(parse("[offset]\nx = 0\n").unwrap().offset.shift, [0.0; 2]);
    }

    /// Three corners turned by 1° about the first one and shifted by 3 mm along x.
    #[test]
    fn points_give_their_offset() {
        let (s, c) = 1_f64.to_radians().sin_cos();
        let text = format!(
            "[[point]]\nplanned = [0, 0]\nseen = [\"3 mm\", 0]\n\
             [[point]]\nplanned = [\"0.5 m\", 0]\nseen = [{}, {}]\n\
             [[point]]\nplanned = [0, \"0.4 m\"]\nseen = [{}, {}]\n",
            0.5 * c + 0.003,
            0.5 * s,
            -0.4 * s + 0.003,
            0.4 * c
        );
        let SeenOffset { offset, residual, .. } = parse(&text).unwrap();
        assert!((offset.yaw - 1_f64.to_radians()).abs() < 1e-14 && residual.unwrap() < 1e-14);
        let shift = offset.about([0.0, 0.0]).shift;
        assert!((shift[0] - 0.003).abs() < 1e-15 && shift[1].abs() < 1e-15);
    }

    /// Every fault names what is wrong and what would be right; those of a file have a place.
    #[test]
    fn broken_offsets_are_refused_with_place_and_remedy() {
        // points whose x and y are swapped: a mirrored ply, which no turn brings into place
        let point = |p: &str, q: &str| format!("[[point]]\nplanned = {p}\nseen = {q}\n");
        let swapped =
            point("[0, 0]", "[0, 0]") + &point("[1, 0]", "[0, 1]") + &point("[0, 1]", "[1, 0]");

        // files, with what the message must say
        let cases: [(&str, &str); 15] = [
            ("", "neither an offset nor points"),
            ("[offset]\n", "none of x, y and yaw"),
            ("[offset]\nabout = [0, 0]\n", "none of x, y and yaw"),
            ("[offset]\nx = \"3\"\n", "has no unit"),
            ("[offset]\nx = \"3 deg\"\n", "is an angle"),
            ("[offset]\nx = nan\n", "is no"),
            ("[offset]\nyaw = 57\n", "would make a yaw of 57 rad"),
            ("[offset]\nyaw = \"270 deg\"\n", "more than half a turn"),
            ("[offset]\nx = 3\n", "would make a shift of 3 m"),
            ("[offset]\nx = \"1e9 m\"\n", "beyond all cells"),
            ("[offset]\nz = 1\n", "is no key here"),
            ("[offset]\nabout = [1]\n", "one value is given here"),
            ("tolerance = 1e-3\n[offset]\nx = 0\n", "no meaning for an offset"),
            (&swapped, "mm from where the others put it"),
            ("[offset]\n[[point]]\nplanned = [0, 0]\nseen = [0, 0]\n", "both an offset and points"),
        ];

        for (text, expected) in cases {
            let fault = parse(text).unwrap_err();
            assert!(fault.message().contains(expected), "{text}: {fault}");
            assert!(
                !fault.help().is_empty()
                    && (text.is_empty() || fault.diagnostic().unwrap().span.is_some()),
                "{fault:?}"
            );
        }

        // lines of JSON, as a cell sends them; they have no place to show
        for (text, expected) in [
            ("", "not JSON"),
            ("[1]", "no JSON object"),
            ("{\"offset\": null}", "null"),
            ("{\"offset\": {\"x\": \"3\"}}", "has no unit"),
            ("{\"offset\": {\"x\": 1e400}}", "not JSON"),
            ("{\"offset\": {\"x\": 3}}", "would make a shift of 3 m"),
            ("{\"offset\": {\"x\": 900000}}", "would make a shift of 900000 m"),
            ("{\"offset\": {\"yaw\": 0.8}}", "would make a yaw of 0.8 rad"),
            ("{}", "neither"),
            ("{\"offset\": {}}", "none of x, y and yaw"),
            ("{\"offset\": {\"x\": 0.1, \"x\": 0.001}}", "the key `x` is there twice"),
            ("{\"id\": 1, \"offset\": {\"x\": 0}, \"id\": 2}", "the key `id` is there twice"),
            ("{\"id\": [1], \"offset\": {\"x\": 0}}", "an id is a text or a number"),
        ] {
            let fault = json_offset(text, 2e-3).seen.unwrap_err();
            assert!(fault.message().contains(expected), "{text}: {fault}");
        }
    }

    /// The id is known though the rest of the line is refused.
    #[test]
    fn a_request_keeps_its_id() {
        for (text, id, is_read) in [
            ("{\"id\": 7, \"offset\": {\"x\": 0}}", Some(7.into()), true),
            ("{\"id\": \"a\", \"offset\": {}}", Some("a".into()), false),
            ("{\"offset\": {\"x\": 0}}", None, true),
        ] {
            let request = json_offset(text, 2e-3);
            assert_eq!((request.id, request.seen.is_ok()), (id, is_read), "{text}");
        }
    }
}
