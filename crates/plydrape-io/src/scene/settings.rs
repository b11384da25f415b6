//! Rules of the model, of contact, of the sheet and of the pads.

use super::choice::FrictionChoice;
use super::file::{
    EndKey, GrippersTable, SceneKeys, SheetTable, Slopes, SteppingKey, TheoryKey, TimeKey,
};
use super::located::{Located, Whole};
use super::quantity::{Force, Quantity, Stiffness};
use super::source::Document;
use super::usual;
use crate::Error;
use plydrape::layup::{
    ContactEnd, ContactSettings, Friction, PadSettings, Settings, SheetSettings, SheetTime,
    SlopeRule, Stepping,
};
use plydrape::ply::Ply;
use plydrape::scene::Cell;

/// Smallest and largest finite axial stiffness (N).
const AXIAL_STIFFNESS: [f64; 2] = [1.0, 1e12];
/// Smallest and largest gravity (m/s²).
const GRAVITY: [f64; 2] = [1e-3, 1e3];
/// Smallest and largest stiffness of a gripper's mount (N/m).
const MOUNTS: [f64; 2] = [1e-3, 1e9];
/// Smallest and largest force that a pad holds (N).
const PAD_FORCES: [f64; 2] = [1e-6, 1e9];
/// Fewest and most states that a sheet keeps.
const KEPT: [usize; 2] = [2, 100_000];

/// Checks `[model]`, `[contact]`, `[sheet]`, and what `[ply]` and `[grippers]` say of sheet and pads; what these do not say is that of a
/// cell.
pub(super) fn settings(
    file: &SceneKeys,
    cell: &Cell,
    ply: &Ply,
    document: &Document,
) -> Result<Settings, Error> {
    let (model, usual) = (&file.model, Settings::default());
    let axial_stiffness = match &model.axial_stiffness {
        Some(stiffness) if stiffness.si_or_infinite(document, &usual::AXIAL)? == f64::INFINITY => {
            f64::INFINITY
        }
        Some(stiffness) => stiffness.within(document, AXIAL_STIFFNESS, &usual::AXIAL)?,
        None => usual.axial_stiffness,
    };
    let gravity = match &model.gravity {
        Some(gravity) => gravity.within(document, GRAVITY, &usual::GRAVITY)?,
        None => usual.gravity,
    };
    if let Some(Located { value: TheoryKey::Exact, span }) = &model.theory {
        return Err(document.error(
            span.clone(),
            "a net hangs by the theory of small sag: its equilibrium needs the length of every span with exact derivatives to forces and slopes thousands of times a drape, which the closed form gives and the elastica does not",
            "leave `theory` out; `plydrape span --theory exact` solves one span, and the sheet (kind = \"sheet\") bends by the curvature that it has, also with a measured moment",
        ));
    }
    let held = match &file.grippers {
        Some(table) => held(&table.value, cell, document)?,
        None => *cell,
    };
    let overhang = match &file.ply.value.overhang {
        Some(overhang) => overhang.size_or_zero(document, &usual::OVERHANG)?,
        None => usual.sheet.overhang,
    };
    Ok(Settings {
        slopes: match model.slopes {
            Some(Slopes::MinForce) => SlopeRule::MinForce,
            Some(Slopes::MomentBalance) | None => SlopeRule::MomentBalance,
        },
        axial_stiffness,
        gravity,
        max_tilt: held.max_tilt,
        contact: contact(file, ply, document)?,
        model: model.kind.as_ref().map_or(usual.model, |kind| kind.value.into()),
        sheet: sheet(&file.sheet, overhang, document)?,
        pad: held.pad,
    })
}

/// Checks the table `[contact]`.
pub(super) fn contact(
    file: &SceneKeys,
    ply: &Ply,
    document: &Document,
) -> Result<ContactSettings, Error> {
    let (contact, usual) = (&file.contact, ContactSettings::default());
    let tolerance = match &contact.tolerance {
        Some(tolerance) => {
            let value = tolerance.size(document, &usual::TOLERANCE)?;
            let cell = ply.cell[0].min(ply.cell[1]);
            if value > 0.1 * cell {
                return Err(document.error(
                    tolerance.span.clone(),
                    format!("{} is more than a tenth of a cell", document.quoted(&tolerance.span)),
                    format!("the contact tolerance is a small distance, e.g. \"0.2 mm\"; a cell is {:.2} mm here", cell * 1e3),
                ));
            }
            value
        }
        None => usual.tolerance,
    };
    Ok(ContactSettings {
        tolerance,
        stepping: match contact.stepping {
            Some(SteppingKey::Once) => Stepping::Once,
            Some(SteppingKey::Cut) | None => Stepping::Cut,
        },
        end: match contact.end {
            Some(EndKey::Tangent) => ContactEnd::Tangent,
            Some(EndKey::Free) | None => ContactEnd::Free,
        },
        friction: match &contact.friction {
            Some(Located { value: FrictionChoice::Stick, .. }) => Friction::Stick,
            Some(Located { value: FrictionChoice::StickForEver, .. }) => Friction::StickForEver,
            Some(Located { value: FrictionChoice::Coefficient(coefficient), span }) => {
                let coefficient = Located { value: coefficient.clone(), span: span.clone() };
                Friction::Coulomb(coefficient.not_negative(document, &usual::FRICTION)?)
            }
            None => usual.friction,
        },
        tack: match &contact.tack {
            Some(tack) => tack.not_negative(document, &usual::TACK)?,
            None => usual.tack,
        },
    })
}

fn sheet(table: &SheetTable, overhang: f64, document: &Document) -> Result<SheetSettings, Error> {
    let usual = SheetSettings::default();
    Ok(SheetSettings {
        mesh: table.mesh.as_ref().map(|mesh| mesh.size(document, &usual::MESH)).transpose()?,
        overhang,
        time: match table.time {
            Some(TimeKey::Real) => SheetTime::Real,
            Some(TimeKey::QuasiStatic) => SheetTime::QuasiStatic,
            None => usual.time,
        },
        keep: match &table.keep {
            None => usual.keep,
            Some(keep) => {
                let [least, most] = KEPT;
                let Whole(count) = keep.value;
                match usize::try_from(count) {
                    Ok(count) if (least..=most).contains(&count) => count,
                    _ => {
                        return Err(document.error(
                            keep.span.clone(),
                            format!("{count} states cannot be kept"),
                            format!("{least} to {most} states are possible, the first and the last among them"),
                        ));
                    }
                }
            }
        },
    })
}

/// A cell as the table `[grippers]` changes it.
pub(super) fn held(table: &GrippersTable, cell: &Cell, document: &Document) -> Result<Cell, Error> {
    let usual = &cell.pad;
    let mount = |key: Option<&Quantity<Stiffness>>| {
        key.map(|key| key.within_for(document, MOUNTS, "a gripper's mount", &usual::MOUNT))
            .transpose()
    };
    let force = |key: &Option<Quantity<Force>>, other: Option<f64>| match key {
        Some(key) => key.within_for(document, PAD_FORCES, "a pad", &usual::PAD_FORCE).map(Some),
        None => Ok(other),
    };
    let [lateral_stiffness, axial_stiffness] = match &table.stiffness {
        Some(keys) => [mount(keys.value.lateral.as_ref())?, mount(keys.value.axial.as_ref())?],
        None => [usual.lateral_stiffness, usual.axial_stiffness],
    };
    let pad = PadSettings {
        radius: match &table.pad_radius {
            Some(radius) => radius.size_or_zero(document, &usual::PAD)?,
            None => usual.radius,
        },
        lateral_stiffness,
        axial_stiffness,
        slip_force: force(&table.slip_force, usual.slip_force)?,
        holding_force: force(&table.holding_force, usual.holding_force)?,
    };
    let max_tilt = match &table.max_tilt {
        Some(tilt) => tilt.acute(document)?,
        None => cell.max_tilt,
    };
    Ok(Cell { pad, max_tilt, ..*cell })
}
