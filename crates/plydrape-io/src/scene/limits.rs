//! What an accepted drape keeps to.

use super::bound;
use super::file::LimitsTable;
use super::located::Fixed;
use super::quantity::{Quantity, Read, read_or};
use super::source::Document;
use super::usual::Coordinate;
use crate::Error;
use plydrape::layup::{Layup, Model};
use plydrape::measure::{Limits, Name};
use std::cmp::Reverse;

/// Checks the table `[limits]` of a layup; what it does not say is that of its preset, or else as in [`Limits::usual`].
pub(super) fn limits(
    table: &LimitsTable,
    layup: &Layup,
    document: &Document,
) -> Result<Limits, Error> {
    let mut limits = Limits::usual(layup);
    if let Some(preset) = &table.preset {
        limits = limits.with_preset(preset.value);
    }

    // bounds as they are written; a slack angle sets the slack ratio, and a given ratio overrides that one
    let mut bounds: Vec<(Name, Option<f64>)> = Vec::with_capacity(table.bounds.len());
    for (name, written) in &table.bounds {
        if bounds.iter().any(|(known, _)| known == name) {
            return Err(document.error(
                written.span.clone(),
                format!("`{}` is set twice, once by its old name", name.measure().name()),
                "leave out the old name",
            ));
        }
        bounds.push((*name, bound::read(*name, written, document)?));
    }
    bounds.sort_by_key(|(name, _)| Reverse(*name));
    for (name, bound) in bounds {
        limits.set(name, bound);
    }
    refuse(table, layup, document)?;

    limits.grip_safety = read_or(&table.grip_safety, limits.grip_safety, document)?;
    if let Some(sides) = &table.workspace {
        limits.workspace = Some(workspace(sides, document)?);
    }
    Ok(limits)
}

/// Refuses limits that the layup cannot have, whether the scene gives them or its preset.
fn refuse(table: &LimitsTable, layup: &Layup, document: &Document) -> Result<(), Error> {
    for (name, _) in Name::bounded() {
        let written = table.bounds.iter().find(|(own, _)| *own == name);
        let preset = table.preset.as_ref().filter(|preset| preset.value.value(name).is_some());
        let said = written.map(|(_, value)| &value.span).or(preset.map(|preset| &preset.span));
        if let (Some(span), Some(refusal)) = (said, name.measure().refusal(layup)) {
            return Err(document.error(span.clone(), refusal.why, refusal.remedy));
        }
    }
    Ok(())
}

/// A box (m); refuses sides that are empty or run backwards.
fn workspace(
    sides: &Fixed<Fixed<Quantity<Coordinate>, 2>, 3>,
    document: &Document,
) -> Result<[[f64; 2]; 3], Error> {
    let mut out = [[0.0; 2]; 3];
    for (n, side) in sides.0.iter().enumerate() {
        let [from, to] = side.read(document)?;
        if from >= to {
            let axis = ["x", "y", "z"][n];
            let fault = if from == to { "is empty" } else { "runs backwards" };
            return Err(document.error(
                side.0[0].span.start..side.0[1].span.end,
                format!("the workspace {fault} along {axis}"),
                "give [from, to] with from below to, as in [\"-500 mm\", \"500 mm\"]",
            ));
        }
        out[n] = [from, to];
    }
    Ok(out)
}

/// A notice for each limit that somebody has set and that the model which decides does not measure.
pub(super) fn not_measured(limits: &Limits, layup: &Layup) -> Vec<String> {
    let decides = layup.settings.model;
    let notice = |(name, _): (Name, f64)| {
        let measure = name.measure();
        let (why, kind) = match measure.description().model.filter(|model| *model != decides)? {
            Model::Sheet => ("the sheet alone measures it, and catenaries decide", "sheet"),
            Model::Catenaries => {
                ("catenaries alone measure it, and the sheet decides", "catenaries")
            }
        };
        Some(format!(
            "no drape is accepted with the limit `{}`: {why}; remove it, or let the other model decide, kind = \"{kind}\" in [model]",
            measure.name()
        ))
    };
    limits.unjudged(layup, &[]).into_iter().filter_map(notice).collect()
}

#[cfg(test)]
mod tests {
    use super::super::parse;
    use super::*;
    use plydrape::measure::{Preset, slack_of_angle};
    use std::path::Path;

    const SCENE: &str = "[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
        [mold]\nkind = \"plane\"\n[grippers]\nslip_force = 10\n[target]\n[limits]\n";

    fn limits(keys: &str) -> Limits {
        parse(&format!("{SCENE}{keys}\n"), Path::new(""), "scene.toml")
            .unwrap_or_else(|error| panic!("{error}"))
            .scene
            .limits
    }

    /// A name of before version 0.1.0 sets the limit, says what to write, and is refused beside the new one.
    #[test]
    fn an_old_name_is_read_with_a_notice() {
        let read = |keys: &str| parse(&format!("{SCENE}{keys}\n"), Path::new(""), "scene.toml");
        let old = read("fibre_angle = \"2 deg\"").unwrap();
        assert_eq!(old.limits, read("fiber_angle = \"2 deg\"").unwrap().limits);
        assert!(
            old.notices[0].starts_with("`fibre_angle` in [limits] is called `fiber_angle` now")
        );
        assert!(old.notices.len() == 1 && read("").unwrap().notices.is_empty());
        let both = read("fiber_angle = \"2 deg\"\nfibre_angle = \"2 deg\"").unwrap_err();
        assert_eq!(both.message(), "`fiber_angle` is set twice, once by its old name");
    }

    /// A limit of the other model is noticed before anything is searched for, where somebody has set it to another bound than the usual one.
    #[test]
    fn a_limit_that_the_deciding_model_does_not_measure_is_noticed() {
        let notices = |keys: &str, model: &str| {
            let text = format!("{SCENE}{keys}\n[model]\nkind = \"{model}\"\n");
            parse(&text, Path::new(""), "scene.toml").unwrap().notices
        };
        for (key, measured, other) in [
            ("contact_share = \"90 %\"", "catenaries", "sheet"),
            ("height = \"0.4 mm\"", "sheet", "catenaries"),
        ] {
            assert_eq!(notices(key, measured), [""; 0]);
            let found = notices(key, other);
            let name = key.split(' ').next().unwrap();
            assert!(found.len() == 1 && found[0].contains(&format!("`{name}`")), "{found:?}");
            assert!(found[0].ends_with(&format!("kind = \"{measured}\" in [model]")), "{found:?}");
        }
        assert_eq!(notices("contact_share = \"95 %\"", "sheet"), [""; 0]);
    }

    /// Each key sets its own limit and no other, but for the slack ratio, which follows a slack angle.
    #[test]
    fn every_limit_is_set_by_the_key_of_its_measure() {
        let usual = limits("");
        for (name, bound) in Name::bounded() {
            let example = 0.9 * bound.example;
            let value = bound::text(example, name.measure().unit());
            let quotes = if value.parse::<f64>().is_ok() { "" } else { "\"" };
            let set = limits(&format!("{} = {quotes}{value}{quotes}", name.measure().name()));
            for other in Name::ALL {
                let wanted = match (other, name) {
                    _ if *other == name => Some(example),
                    (Name::SlackRatio, Name::SlackAngle) => Some(slack_of_angle(example)),
                    _ => usual.get(*other),
                };
                let near = |found: f64| wanted.is_some_and(|w| (found / w - 1.0).abs() < 1e-9);
                assert!(
                    set.get(*other).map_or(wanted.is_none(), near),
                    "{name:?} {other:?} {:?} {wanted:?}",
                    set.get(*other)
                );
            }
        }
    }

    /// The slack ratio overrides that of an angle, in whichever order both are written, and other keys over a preset.
    #[test]
    fn what_is_given_stands_over_what_follows_from_it() {
        for keys in [
            ["slack_ratio = 0.01", "slack_angle = 0.1"],
            ["slack_angle = 0.1", "slack_ratio = 0.01"],
        ] {
            let set = limits(&keys.join("\n"));
            assert_eq!(
                [Name::SlackRatio, Name::SlackAngle].map(|name| set.most(name)),
                [0.01, 0.1]
            );
        }
        let set = limits("preset = \"drapebot\"\nposition = \"1 mm\"");
        assert_eq!(set.get(Name::Position), Some(1e-3));
        let preset = Preset::DrapeBot.value(Name::FiberAngle);
        assert_eq!((set.get(Name::FiberAngle), set.preset), (preset, Some(Preset::DrapeBot)));
    }
}
