//! The table of limits in the theory is that of the measures.

use plydrape::layup::Model;
use plydrape::measure::{Measure, Name, Scope, Sense, Usual};
use std::fs;
use std::path::Path;

/// Lines around the table.
const MARKS: [&str; 2] = ["<!-- table of limits -->", "<!-- end of the table -->"];

fn row(measure: &dyn Measure) -> String {
    let description = measure.description();
    let bound = measure.bound();
    let counts = match description.scope {
        Scope::EveryStep => "every step",
        Scope::End => "end",
        Scope::Time => "every step of a motion in time",
        Scope::Whole => "the whole motion or plan",
    };
    let model = match description.model {
        None => "both",
        Some(Model::Sheet) => "sheet",
        Some(Model::Catenaries) => "catenaries",
    };
    let at_least = if description.sense == Sense::AtLeast { "*at least* " } else { "" };
    let limit = match bound.map(|bound| bound.usual) {
        None => "–".to_owned(),
        Some(Usual::Never) => "no limit".to_owned(),
        Some(Usual::OfLayup(words)) => format!("{at_least}{words}"),
        Some(Usual::Always(usual)) => {
            let unit = description.unit;
            let value = usual.value / unit.si * unit.factor;
            let digits = format!("{value:.6}");
            let digits = digits.trim_end_matches('0').trim_end_matches('.');
            format!("{at_least}{digits} {}: {}", unit.shown, usual.reason)
        }
    };
    let name = if bound.is_some() { format!("`{}`", description.name) } else { "–".into() };
    format!(
        "| {} | {name} | `{}` | {} | {counts} | {model} | {limit} |",
        description.label, description.key, description.unit.recorded
    )
}

/// The table in `docs/theory/measures.md` has a row for each measure as its file describes it. With UPDATE_DOCS set it is written anew.
#[test]
fn the_table_of_limits_is_that_of_the_measures() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/theory/measures.md");
    let page = fs::read_to_string(&file).unwrap();
    let mut table = String::from(
        "| measure | key in `[limits]` | key in `measures` | unit | counts | evaluated by | limit unless set |\n|---|---|---|---|---|---|---|\n",
    );
    for name in Name::ALL {
        table += &(row(name.measure()) + "\n");
    }
    let (before, rest) = page.split_once(MARKS[0]).expect("the mark of the table");
    let (found, after) = rest.split_once(MARKS[1]).unwrap_or(("", rest));
    if std::env::var_os("UPDATE_DOCS").is_some() {
        let page = format!("{before}{}\n\n{table}\n{}{after}", MARKS[0], MARKS[1]);
        fs::write(&file, page).unwrap();
        return;
    }
    assert_eq!(found.trim(), table.trim(), "UPDATE_DOCS=1 writes the table anew");
}
