//! How a limit of a measure is written and read, by its unit, and what the schema says of it.

use super::located::Located;
use super::quantity::{
    Acceleration, Angle, AngularRate, Force, Jerk, Length, Measure, Quantity, Ratio, Raw, Speed,
    Time, Unchecked, describe,
};
use super::source::Document;
use super::usual;
use crate::Error;
use plydrape::layup::Model;
use plydrape::measure::{Bound, Name, Range, Unit, Usual, UsualLimit};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde_json::Value;
use std::ops;

/// How the limits of measures in one unit are written and read.
pub(super) struct Kind {
    /// The name of the quantity with its article, as in `a length`.
    pub name: &'static str,
    /// A value with a unit, as a user would write it.
    pub example: &'static str,
    /// Unit of a plain number, empty for a ratio.
    si: &'static str,
    schema: fn(&mut SchemaGenerator) -> Schema,
    usual: fn(&Bound) -> usual::Usual,
    read: fn(Located<Raw>, &Bound, &Document) -> Result<f64, Error>,
}

impl Kind {
    /// Of the limits of a measure.
    pub fn of_measure(name: Name) -> Self {
        match name.measure().unit().recorded {
            "mm" => Kind::new::<Length>(length),
            "deg" => Kind::new::<Angle>(angle),
            "N" => Kind::new::<Force>(within::<Force>),
            "s" => Kind::new::<Time>(within::<Time>),
            "deg/s" => Kind::new::<AngularRate>(within::<AngularRate>),
            "m/s" => Kind::new::<Speed>(within::<Speed>),
            "m/s²" => Kind::new::<Acceleration>(within::<Acceleration>),
            "m/s³" => Kind::new::<Jerk>(within::<Jerk>),
            _ => Kind::new::<Ratio>(share),
        }
    }

    fn new<M: Measure + 'static>(
        read: fn(Located<Raw>, &Bound, &Document) -> Result<f64, Error>,
    ) -> Self {
        let schema = Unchecked::<M>::json_schema;
        Kind { name: M::NAME, example: M::EXAMPLE, si: M::UNIT, schema, usual: usual_of::<M>, read }
    }
}

/// Reads the limit of a measure (SI).
pub(super) fn read(
    name: Name,
    written: &Located<Raw>,
    document: &Document,
) -> Result<Option<f64>, Error> {
    let read = |bound| (Kind::of_measure(name).read)(written.clone(), &bound, document);
    name.measure().bound().map(read).transpose()
}

/// A value with the sign of its range, and a plain number near what is found in practice.
fn believed<M: Measure>(
    value: &Quantity<M>,
    bound: &Bound,
    document: &Document,
) -> Result<f64, Error> {
    let Range { least, open, .. } = bound.range;
    let usual = usual_of::<M>(bound);
    match least > 0.0 || open {
        true => value.positive(document, &usual),
        false => value.not_negative(document, &usual),
    }
}

/// What is usual of a limit.
fn usual_of<M: Measure>(bound: &Bound) -> usual::Usual {
    let Range { least, most, .. } = bound.range;
    let usual = bound.practice.as_ref().map_or(usual::ANY, usual::Usual::from_practice::<M>);
    usual.within([least, most])
}

fn within<M: Measure>(
    written: Located<Raw>,
    bound: &Bound,
    document: &Document,
) -> Result<f64, Error> {
    let value = Quantity::<M>::from(written);
    believed(&value, bound, document)?;
    let Range { least, most, of, .. } = bound.range;
    value.within_for(document, [least, most], of, &usual_of::<M>(bound))
}

fn length(written: Located<Raw>, bound: &Bound, document: &Document) -> Result<f64, Error> {
    let value = Quantity::<Length>::from(written);
    let si = believed(&value, bound, document)?;
    let Range { least, most, .. } = bound.range;
    if (least..=most).contains(&si) { Ok(si) } else { Err(value.out_of_scale(document, si)) }
}

fn angle(written: Located<Raw>, bound: &Bound, document: &Document) -> Result<f64, Error> {
    let value = Quantity::<Angle>::from(written);
    believed(&value, bound, document)?;
    value.below_right_angle(document)
}

/// A share from 0 to 1.
fn share(written: Located<Raw>, bound: &Bound, document: &Document) -> Result<f64, Error> {
    let value = Quantity::<Ratio>::from(written);
    let si = believed(&value, bound, document)?;
    if si <= bound.range.most {
        return Ok(si);
    }
    Err(document.error(
        value.span.clone(),
        format!("{} is more than the whole", document.quoted(&value.span)),
        format!("expected a share from 0 to 1; {si} of a hundred is \"{si} %\""),
    ))
}

/// The schema of the limit of a measure: its sentence, its range, and an example.
pub(super) fn schema(name: Name, bound: &Bound, generator: &mut SchemaGenerator) -> Value {
    let kind = Kind::of_measure(name);
    let mut schema = (kind.schema)(generator);
    if let Some(Value::Array(choices)) = schema.get_mut("anyOf")
        && let Some(Value::Object(number)) = choices.first_mut()
    {
        let Range { least, most, open, .. } = bound.range;
        let low = if open { ops::Bound::Excluded(least) } else { ops::Bound::Included(least) };
        let high = match most {
            f64::INFINITY => ops::Bound::Unbounded,
            _ if open => ops::Bound::Excluded(most),
            _ => ops::Bound::Included(most),
        };
        describe(number, [low, high], &(kind.usual)(bound));
    }
    let unit = name.measure().unit();
    let example = match kind.si {
        "" => bound.example.into(),
        _ => Value::from(text(bound.example, unit)),
    };
    schema.insert("examples".into(), Value::Array(vec![example]));
    schema.insert("description".into(), sentence(name, bound, &kind).into());
    schema.into()
}

/// What a limit bounds, its unit, what it is unless given, and the model that alone is judged by it.
fn sentence(name: Name, bound: &Bound, kind: &Kind) -> String {
    let measure = name.measure();
    let unit = match kind.si {
        "" => String::new(),
        unit => format!(" ({})", unit.replace("^2", "²").replace("^3", "³")),
    };
    let (what, more) = bound.about.split_at(bound.about.find(';').unwrap_or(bound.about.len()));
    let usual = match bound.usual {
        Usual::Always(UsualLimit { value, reason }) => {
            format!(", {} unless given ({reason}).", text(value, measure.unit()))
        }
        Usual::OfLayup(words) => format!("; {words} unless given."),
        Usual::Never => "; none unless given.".into(),
    };
    let model = match measure.description().model {
        Some(Model::Catenaries) => " It judges catenaries alone.",
        Some(Model::Sheet) => " It judges the sheet alone.",
        None => "",
    };
    format!("{what}{unit}{more}{usual}{model}")
}

/// A limit (SI) as one would write it, `0.5 mm`, without rounding.
pub(super) fn text(value: f64, unit: Unit) -> String {
    let number = (value / unit.si * 1e9).round() / 1e9;
    match unit.recorded {
        "1" | "" => number.to_string(),
        unit => format!("{number} {unit}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An example is a value that the limit may have, written as a scene has it.
    #[test]
    fn every_limit_takes_its_own_example_in_its_own_unit() {
        for (name, bound) in Name::bounded() {
            let unit = name.measure().unit();
            let written = text(bound.example, unit);
            let raw = match written.parse() {
                Ok(number) => Raw::Number(number),
                Err(_) => Raw::Text(written.clone()),
            };
            let document = Document::new("", &written);
            let located = Located { value: raw, span: 0..written.len() };
            let value = read(name, &located, &document).unwrap().unwrap();
            assert!((value / bound.example - 1.0).abs() < 1e-12, "{name:?} {written}");
            // a unit that is not known here would be taken for a share
            assert_eq!(
                Kind::of_measure(name).si.is_empty(),
                matches!(unit.recorded, "1" | ""),
                "{name:?}"
            );
        }
    }
}
