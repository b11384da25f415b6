//! What an accepted drape keeps to.

use super::bound;
use super::error::{Document, SceneError};
use super::file::LimitsTable;
use super::heading::coordinates;
use super::located::Fixed;
use super::quantity::{Length, Quantity};
use plydrape::layup::Layup;
use plydrape::measure::{Limits, Name};
use std::cmp::Reverse;

/// Smallest and largest safety of the pads.
const GRIP_SAFETIES: [f64; 2] = [1.0, 100.0];

/// Checks the table `[limits]` of a layup; what it does not say is that of its preset, or else as in [`Limits::of`].
pub(super) fn limits(
    table: &LimitsTable,
    layup: &Layup,
    document: &Document,
) -> Result<Limits, SceneError> {
    let mut limits = Limits::of(layup);
    if let Some(preset) = &table.preset {
        limits = limits.with_preset(preset.value);
    }

    // bounds as they are written; a slack angle sets the slack ratio, and a ratio that is given stands over that one
    let mut bounds = Vec::with_capacity(table.bounds.len());
    for (name, written) in &table.bounds {
        bounds.push((*name, bound::read(*name, written, document)?));
    }
    bounds.sort_by_key(|(name, _)| Reverse(*name));
    for (name, bound) in bounds {
        limits.set(name, bound);
    }
    refuse(table, layup, document)?;

    if let Some(safety) = &table.grip_safety {
        limits.grip_safety = safety.within_for(document, GRIP_SAFETIES, "the safety of a pad")?;
    }
    if let Some(sides) = &table.workspace {
        limits.workspace = Some(workspace(sides, document)?);
    }
    Ok(limits)
}

/// Refuses limits that the layup cannot have, whether the scene gives them or its preset.
fn refuse(table: &LimitsTable, layup: &Layup, document: &Document) -> Result<(), SceneError> {
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
    sides: &Fixed<Fixed<Quantity<Length>, 2>, 3>,
    document: &Document,
) -> Result<[[f64; 2]; 3], SceneError> {
    let mut out = [[0.0; 2]; 3];
    for (n, side) in sides.0.iter().enumerate() {
        let [from, to] = coordinates(side, document)?;
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
