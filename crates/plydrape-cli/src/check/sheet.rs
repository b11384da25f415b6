//! How the ply is draped as a sheet, as text.

use super::SummaryLine;
use crate::numbers::{millimeters, short};
use plydrape::layup::{Friction, Lip, Model, Settings, SheetTime};
use plydrape::scene::Scene;
use plydrape_io::error;
use plydrape_io::result::sheet::SheetSize;

/// Mesh, size of pads and friction of the sheet; nothing where catenaries decide.
pub(super) fn sheet(scene: &Scene) -> Vec<SummaryLine> {
    let settings = &scene.layup.settings;
    if settings.model != Model::Sheet {
        return Vec::new();
    }
    vec![("sheet", mesh(scene)), ("", size(scene)), ("", pads(settings)), ("", friction(settings))]
}

fn mesh(scene: &Scene) -> String {
    let sheet = &scene.layup.settings.sheet;
    let lines = match sheet.mesh {
        Some(mesh) => format!("lines of nodes up to {} mm apart", millimeters(mesh)),
        None => "lines of nodes up to a tenth of a cell apart".into(),
    };
    let time = match sheet.time {
        SheetTime::QuasiStatic if scene.layup.ply.material.shear_rate.is_some() => {
            "quasi-static, so that the resin of the ply does not count"
        }
        SheetTime::QuasiStatic => "quasi-static",
        SheetTime::Real => "in real time",
    };
    format!(
        "{lines}, {} mm beyond the grippers; {time}; up to {} states kept",
        millimeters(sheet.overhang),
        sheet.keep
    )
}

/// How large it is; the scene was refused where it cannot be draped.
fn size(scene: &Scene) -> String {
    match SheetSize::new(scene) {
        Ok(SheetSize { nodes, mesh, memory }) => format!(
            "{nodes} nodes, at most {} mm apart; about {} of memory",
            millimeters(mesh),
            error::bytes(memory)
        ),
        Err(fault) => fault.to_string(),
    }
}

fn pads(settings: &Settings) -> String {
    let pad = &settings.pad;
    let held = match pad.radius {
        0.0 => "grippers hold a point".into(),
        radius => format!("pads of radius {} mm", millimeters(radius)),
    };
    match &pad.lip {
        Some(Lip { radius, rigidity }) => format!(
            "{held}, under a soft lip of radius {} mm and rigidity {} N·m",
            millimeters(*radius),
            short(*rigidity)
        ),
        None => held,
    }
}

fn friction(settings: &Settings) -> String {
    let contact = &settings.contact;
    match contact.friction {
        Friction::Stick => "sticks to the mold until it is lifted off".into(),
        Friction::StickForEver => "sticks to the mold for ever".into(),
        Friction::Coulomb(coefficient) => {
            format!("friction {}, tack {} Pa", short(coefficient), short(contact.tack))
        }
    }
}
