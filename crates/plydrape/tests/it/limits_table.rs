//! The table of limits in `docs/theory/measures.md` is made from the measures.

use plydrape::layup::Model;
use plydrape::measure::{Measure, Name, Scope, Sense, Unit, Usual, UsualLimit};
use std::fmt::Write;

const PAGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/theory/measures.md");
const HEAD: &str = "| in `[limits]` | in results | unit | judged | model | limit unless set |\n|---|---|---|---|---|---|\n";

/// A limit (SI) as it is shown.
fn shown(value: f64, unit: Unit) -> String {
    let number = (value / unit.si * unit.factor * 1e9).round() / 1e9;
    match unit.shown {
        unit if unit.starts_with('°') => format!("{number}{unit}"),
        unit => format!("{number} {unit}"),
    }
}

/// The limit of a measure unless a scene sets another, and why it is that one.
fn usual(measure: &dyn Measure) -> String {
    let Some(bound) = measure.bound() else { return "–".into() };
    let least = if measure.sense() == Sense::AtLeast { "*at least* " } else { "" };
    match bound.usual {
        Usual::Always(UsualLimit { value, reason }) => {
            format!("{least}{} ({reason})", shown(value, measure.unit()))
        }
        Usual::OfLayup(words) => format!("{least}{words}"),
        Usual::Never => "none".into(),
    }
}

fn table() -> String {
    let mut text = HEAD.to_string();
    for name in Name::ALL {
        let measure = name.measure();
        let (judged, key) = (measure.bound().is_some(), measure.key());
        let limit = if judged { format!("`{}`", measure.name()) } else { "–".into() };
        let when = match measure.scope() {
            Scope::EveryStep => "every step",
            Scope::End => "end",
            Scope::Time => "every step of a motion with times",
            Scope::Motion | Scope::Whole => "whole motion",
        };
        let model = match measure.description().model {
            Some(Model::Sheet) => "sheet",
            Some(Model::Catenaries) => "catenaries",
            None => "both",
        };
        let (unit, usual) = (measure.unit().recorded, usual(measure));
        let _ = writeln!(text, "| {limit} | `{key}` | {unit} | {when} | {model} | {usual} |");
    }
    text
}

#[test]
fn the_theory_has_the_table_of_all_measures() {
    let page = std::fs::read_to_string(PAGE).unwrap();
    assert!(page.contains(&table()), "put this into {PAGE}:\n{}", table());
}
