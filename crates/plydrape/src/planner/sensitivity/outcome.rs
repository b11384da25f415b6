//! How a drape comes out, and how that changes with where its grippers end.

use super::{Quantity, Sensitivity};
use crate::draping::Draping;
use crate::draping::record::ResultFile;
use crate::scene::Scene;
use std::ops::ControlFlow;

/// The last step of a drape with its derivatives to where the grippers are in it.
///
/// What the mold has caught by then is held. So they are those of the drape's outcome to the grippers' targets as
/// long as a slightly different last step catches nothing more, and exact wherever the state is smooth: not where a
/// diagonal just begins to shear or a slope just reaches its limit.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The drape.
    pub result: ResultFile,
    /// Straight distance of the ends of each catenary's tightest free span beyond its fabric (m), negative where
    /// it is slack; none of a catenary that lies from end to end.
    pub overstretch: Vec<Option<Quantity>>,
    /// Horizontal force (N) of each catenary's span that pulls or pushes most; none where there is none.
    pub force: Vec<Option<Quantity>>,
    /// Shear angle of each cell (rad); none where it does not shear.
    pub shear: Vec<Option<Quantity>>,
    /// Angle between the ply's normal at each gripper and the vertical (rad).
    pub tilt: Vec<Quantity>,
}

/// Drapes the ply of a scene along its motion and differentiates where it has come to; none of a motion without
/// steps. `progress` is as that of [`crate::draping::simulate`].
pub fn outcome(
    scene: &Scene,
    mut progress: impl FnMut(usize) -> ControlFlow<()>,
) -> Option<Outcome> {
    let mut draping = Draping::new(scene);
    let (result, shape) = draping.run(&mut progress);
    let (shape, grid) = (shape?, scene.ply.grid);
    let Draping { solver, positions, laid, .. } = &mut draping;
    let look = Sensitivity::new(scene, solver, &shape, positions, laid);

    let mut overstretch: Vec<Option<Quantity>> = vec![None; grid.catenaries()];
    let mut force = overstretch.clone();
    for span in &shape.spans {
        let tighter = look.overstretch(span);
        let slot = &mut overstretch[span.catenary];
        if slot.as_ref().is_none_or(|old| tighter.value > old.value) {
            *slot = Some(tighter);
        }
        let slot = &mut force[span.catenary];
        if let Some(found) = look.force(span)
            && slot.as_ref().is_none_or(|old| found.value.abs() > old.value.abs())
        {
            *slot = Some(found);
        }
    }
    Some(Outcome {
        overstretch,
        force,
        shear: (0..grid.cells()).map(|cell| look.shear(cell)).collect(),
        tilt: (0..grid.grippers()).map(|gripper| look.tilt(gripper)).collect(),
        result,
    })
}
