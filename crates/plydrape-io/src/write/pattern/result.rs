//! The flat pattern and the boundary of a result.

use super::{Gripper, Pattern, PatternLine, boundary, dxf, pdf};
use crate::Error;
use crate::result::ResultFile;
use crate::store::folder::Files;
use plydrape::ply::{Direction, Outline, gripper_name};
use plydrape::sheet::Fabric;

/// The ply in the flat: `pattern.dxf` and `pattern.pdf`, in the coordinates of its drawing. A ply that is not cut has those of
/// its fabric.
#[must_use]
pub fn flat(result: &ResultFile) -> Files {
    let scene = &result.scene;
    let ply = &scene.ply;
    let outline = outline(result);
    let drawn = |uv| ply.cut.as_ref().map_or(uv, |cut| cut.drawn(uv));
    let across = if ply.warp == Direction::V { std::f64::consts::FRAC_PI_2 } else { 0.0 };
    let gripper = |n: usize| Gripper {
        name: gripper_name(ply.id(n)),
        place: drawn(ply.place(n)),
        radius: scene.settings.pad.radius,
    };
    let grippers: Vec<Gripper> = (0..ply.grippers()).map(gripper).collect();
    let pattern = Pattern {
        title: &scene.title,
        outline: &outline.moved(drawn),
        warp: ply.cut.as_ref().map_or(0.0, |cut| cut.angle) + across,
        grippers: &grippers,
    };
    vec![
        ("pattern.dxf".into(), dxf::text(&pattern).into_bytes()),
        ("pattern.pdf".into(), pdf::bytes(&pattern)),
    ]
}

/// Where the boundary of the ply is at the end, by the sheet: `boundary.csv` and `boundary.dxf`.
///
/// # Errors
/// [`Error`] if the result has no sheet, or its states cannot be read.
pub fn boundary(result: &ResultFile) -> Result<Files, Error> {
    let lines = lines(result)?;
    Ok(vec![
        ("boundary.csv".into(), boundary::csv(&lines)?.into_bytes()),
        ("boundary.dxf".into(), boundary::dxf(&lines).into_bytes()),
    ])
}

/// The outline in fabric coordinates (m).
fn outline(result: &ResultFile) -> Outline {
    let scene = &result.scene;
    match &scene.ply.cut {
        Some(cut) => cut.outline.clone(),
        None => {
            let [low, mut high] = scene.ply.bounds(scene.settings.sheet.overhang);
            if high[1] <= low[1] {
                // a strip has the width of a cell
                high[1] = low[1] + scene.ply.cell[1].max(scene.ply.cell[0]);
            }
            Outline::rectangle(low, high).unwrap_or_else(|_| unreachable!("cells have a size"))
        }
    }
}

/// The rings of the boundary in space.
fn lines(result: &ResultFile) -> Result<Vec<PatternLine>, Error> {
    let none = || {
        let message = "the result has no sheet whose boundary could be written";
        Error::not_possible(message, "drape the scene with kind = \"sheet\" in [model]")
    };
    let mut states = result.sheet_states.as_ref().ok_or_else(none)?.open()?;
    let last = states.steps()?.last().copied().ok_or_else(none)?;
    let state = states.state(last.1)?.ok_or_else(none)?;
    let scene = &result.scene;
    let fabric = Fabric::new(&scene.ply, &scene.settings).map_err(|_| none())?;
    if fabric.places.len() != state.positions.len() {
        return Err(none());
    }
    let outline = outline(result);
    let rings = outline.rings().enumerate().map(|(n, ring)| {
        let boundary = fabric.boundary_along(ring);
        PatternLine {
            name: if n == 0 { "boundary".into() } else { format!("hole {n}") },
            points: boundary.iter().map(|point| point.interpolate(&state.positions)).collect(),
            closed: true,
        }
    });
    Ok(rings.filter(|line| line.points.len() > 1).collect())
}
