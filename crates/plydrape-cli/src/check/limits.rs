//! The limits of the model that decides, as text: those of the scene, of its preset, the usual ones, and those that follow from pads, tool
//! and workspace.

use super::SummaryLine;
use crate::numbers::{millimeters, shown};
use plydrape::measure::{Limits, Name, Sense};
use plydrape::scene::Scene;

/// Widest line of limits (characters).
const WIDTH: usize = 88;

/// Every limit that the model is judged by in this layup, several a line.
pub(super) fn limits(scene: &Scene) -> Vec<SummaryLine> {
    let (layup, limits) = (&scene.layup, &scene.limits);
    let usual = Limits::usual(layup);
    let preset = limits.preset.map(|preset| (preset, usual.clone().with_preset(preset)));
    let [mut own, mut of_preset, mut of_usual, mut following] = [const { Vec::new() }; 4];
    for name in Name::ALL {
        let measure = name.measure();
        let other = measure.description().model.is_some_and(|only| only != layup.settings.model);
        let Some(limit) = name.limit(layup, limits).filter(|_| !other) else { continue };
        let side = if measure.sense() == Sense::AtLeast { "at least " } else { "" };
        let text = match (name, limits.workspace) {
            (Name::Workspace, Some(sides)) => workspace(sides),
            _ => format!("{} {side}{}", name.title(), shown(limit, measure.unit())),
        };
        let same = |others: &Limits| others.get(*name) == limits.get(*name);
        let is_of_preset = preset.as_ref().is_some_and(|(preset, others)| {
            same(others) && (preset.value(*name).is_some() || !same(&usual))
        });
        let group = match () {
            () if measure.bound().is_none() => &mut following,
            () if is_of_preset => &mut of_preset,
            () if same(&usual) => &mut of_usual,
            () => &mut own,
        };
        group.push(text);
    }

    // each group under its name
    let of_the_preset =
        preset.map_or(String::new(), |(preset, _)| format!("of the preset {}", preset.name()));
    let groups = [
        ("of the scene", own),
        (of_the_preset.as_str(), of_preset),
        ("usual", of_usual),
        ("of pads, tool and workspace", following),
    ];
    let texts = groups.iter().filter(|(_, texts)| !texts.is_empty());
    let lines = texts.flat_map(|(name, texts)| packed(&format!("{name}: "), texts));
    let nouns = std::iter::once("limits").chain(std::iter::repeat(""));
    nouns.zip(lines).collect()
}

/// Texts behind a head, separated by commas, in lines.
pub(super) fn packed(head: &str, texts: &[String]) -> Vec<String> {
    let (mut lines, mut line) = (Vec::new(), head.to_string());
    for (n, text) in texts.iter().enumerate() {
        let comma = if n + 1 < texts.len() { ", " } else { "" };
        if n > 0 && line.chars().count() + text.chars().count() > WIDTH {
            lines.push(line.trim_end().to_string());
            line = "  ".to_string();
        }
        line += text;
        line += comma;
    }
    lines.push(line);
    lines
}

/// The box that grippers must stay in.
fn workspace(sides: [[f64; 2]; 3]) -> String {
    let [x, y, z] = sides.map(|ends| ends.map(millimeters).join(" to "));
    format!("grippers in x {x}, y {y}, z {z} mm")
}
