//! Rules of the model, of contact, of the sheet and of the pads.

use super::choice::FrictionChoice;
use super::file::{
    EndKey, GrippersTable, LipTable, MountTable, SceneKeys, SheetTable, Slopes, SteppingKey,
    TheoryKey, TimeKey,
};
use super::located::{Located, Whole};
use super::quantity::{Read, read_given, read_or};
use super::source::Document;
use crate::Error;
use plydrape::layup::{
    ContactEnd, ContactSettings, Friction, Lip, PadSettings, Settings, SheetSettings, SheetTime,
    SlopeRule, Stepping,
};
use plydrape::ply::Ply;
use plydrape::scene::Cell;

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
    // constants of the model; a net knows the theory of small sag alone
    let (model, usual) = (&file.model, Settings::default());
    let axial_stiffness = read_or(&model.axial_stiffness, usual.axial_stiffness, document)?;
    let gravity = read_or(&model.gravity, usual.gravity, document)?;
    if let Some(Located { value: TheoryKey::Exact, span }) = &model.theory {
        return Err(document.error(
            span.clone(),
            "a net hangs by the theory of small sag: its equilibrium needs the length of every span with exact derivatives to forces and slopes thousands of times a drape, which the closed form gives and the elastica does not",
            "leave `theory` out; `plydrape span --theory exact` solves one span, and the sheet (kind = \"sheet\") bends by the curvature that it has, also with a measured moment",
        ));
    }

    // how grippers hold the ply: as the scene says, or else as in the cell
    let held = match &file.grippers {
        Some(table) => held(&table.value, cell, document)?,
        None => *cell,
    };
    let overhang = read_or(&file.ply.value.overhang, usual.sheet.overhang, document)?;
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
    // the tolerance is small against a cell of the ply
    let (contact, usual) = (&file.contact, ContactSettings::default());
    let tolerance = match &contact.tolerance {
        Some(tolerance) => {
            let value = tolerance.read(document)?;
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

    // how contact is followed, how spans leave the mold, and how the ply sticks to it
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
                Friction::Coulomb(coefficient.read(document)?)
            }
            None => usual.friction,
        },
        tack: read_or(&contact.tack, usual.tack, document)?,
    })
}

fn sheet(table: &SheetTable, overhang: f64, document: &Document) -> Result<SheetSettings, Error> {
    let usual = SheetSettings::default();
    Ok(SheetSettings {
        mesh: read_given(&table.mesh, document)?,
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

/// The lip of a cup as a scene changes that of its cell.
fn lip(
    table: Option<&Located<LipTable>>,
    usual: Option<Lip>,
    document: &Document,
) -> Result<Option<Lip>, Error> {
    let Some(Located { value: table, span }) = table else { return Ok(usual) };
    let radius = read_given(&table.radius, document)?.or(usual.map(|lip| lip.radius));
    let rigidity = read_given(&table.rigidity, document)?.or(usual.map(|lip| lip.rigidity));
    match (radius, rigidity) {
        (Some(0.0), _) => Ok(None),
        (Some(radius), Some(rigidity)) => Ok(Some(Lip { radius, rigidity })),
        _ => Err(document.error(
            span.clone(),
            "a lip needs a radius and a rigidity",
            "write lip = { radius = \"15 mm\", rigidity = \"0.0003 N m\" }, or take those of a cell by preset = \"usual\" in [cell]",
        )),
    }
}

/// A cell as the table `[grippers]` changes it.
pub(super) fn held(table: &GrippersTable, cell: &Cell, document: &Document) -> Result<Cell, Error> {
    let usual = &cell.pad;
    let [lateral_stiffness, axial_stiffness] = match &table.stiffness {
        Some(Located { value: MountTable { lateral, axial }, .. }) => {
            [read_given(lateral, document)?, read_given(axial, document)?]
        }
        None => [usual.lateral_stiffness, usual.axial_stiffness],
    };
    let pad = PadSettings {
        radius: read_or(&table.pad_radius, usual.radius, document)?,
        lip: lip(table.lip.as_ref(), usual.lip, document)?,
        lateral_stiffness,
        axial_stiffness,
        slip_force: read_given(&table.slip_force, document)?.or(usual.slip_force),
        holding_force: read_given(&table.holding_force, document)?.or(usual.holding_force),
    };
    let max_tilt = read_or(&table.max_tilt, cell.max_tilt, document)?;
    Ok(Cell { pad, max_tilt, ..*cell })
}
