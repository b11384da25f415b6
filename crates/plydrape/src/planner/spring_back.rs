//! Whether a ply stays where it is laid: what is sheared springs back once its cups have let go, where neither weight nor friction holds it.
//!
//! The ply is laid on its ideal drape, without any motion, and let go of. What rises then rises behind every motion, because a motion can do no
//! better than to lay each point of the fabric at its place.

use super::evaluation::{Mesh, as_ranked};
use crate::errors::{Errors, RelativeError};
use crate::layup::{Friction, Layup, Model};
use crate::measure::{Judge, Limits, Name, Verdict};
use crate::motion::Motion;
use crate::scene::Scene;
use crate::sheet::{Beginning, Fabric, HandOver, SheetTuning, Status, drape_from};
use std::cell::Cell;
use std::ops::ControlFlow;

/// Nodes up to which a ply is laid.
const MOST_NODES: usize = 1500;
/// Time steps after which it is not looked at any longer: up to 54 were seen.
const MOST_STEPS: usize = 80;
/// Ratio to its limit from which on the height of a ply that sprang back is one that no motion mends: searches ended up to 13 % lower.
const CERTAIN: f64 = 1.5;
/// Shares of its shear stiffness with which a ply is tried that springs back; errors leave a tenth of it at least.
const LIMPER: [f64; 3] = [0.5, 0.25, 0.1];

/// The verdict on the height of the ply of a scene if it springs back, so far that no motion mends it, with what would make it stay.
pub(super) fn spring_back(scene: &Scene, stop: &dyn Fn() -> bool) -> Option<Verdict> {
    if scene.layup.settings.model != Model::Sheet || scene.layup.release.is_none() {
        return None;
    }
    let laid = |layup: &Layup| laid(layup, &scene.limits, stop);
    // the mesh of the scene, or the coarse one, where that is soon done
    let of_mesh = |mesh: Mesh| as_ranked(scene.layup.clone(), mesh);
    let is_small = |layup: &Layup| {
        let fabric = Fabric::new(&layup.ply, &layup.settings);
        fabric.is_ok_and(|fabric| fabric.places.len() <= MOST_NODES)
    };
    let layup = [Mesh::Own, Mesh::Coarse].map(of_mesh).into_iter().find(is_small)?;
    let found = laid(&layup).filter(|verdict| verdict.ratio() > CERTAIN)?;

    // what would make it stay is tried
    let stays = |layup: &Layup| laid(layup).is_some_and(|verdict| verdict.ok);
    let limper = |share: &f64| {
        let mut draw = Errors::default().draw(0, layup.ply.grippers());
        draw.material.shear = RelativeError::Share(share - 1.0);
        stays(&draw.apply(&layup))
    };
    let limp = LIMPER.into_iter().find(limper);
    let limp = limp.map(|share| format!("with {share} times its shear stiffness"));
    let slides = matches!(layup.settings.contact.friction, Friction::Coulomb(_));
    let mut sticking = layup.clone();
    sticking.settings.contact.friction = Friction::Stick;
    let tacky = (slides && stays(&sticking)).then(|| "if it stuck to the mold".to_string());
    let remedies: Vec<String> = limp.into_iter().chain(tacky).collect();
    let remedy = match remedies.is_empty() {
        true => String::new(),
        false => format!(", and would stay {}", remedies.join(", or ")),
    };
    let at =
        format!("{}, laid without a motion and let go of: the ply springs back{remedy}", found.at);
    Some(Verdict { at, step: None, ..found })
}

/// The verdict on the height of the ply of a layup that was laid on its ideal drape, after its cups have let go of it; `None` where that is
/// not known: without a mold or an ideal drape of all of the ply, or if it does not come to rest soon.
fn laid(layup: &Layup, limits: &Limits, stop: &dyn Fn() -> bool) -> Option<Verdict> {
    let (mold, target) = (layup.mold.as_ref()?, layup.target.as_ref()?);
    let drape = target.drape.as_ref()?;
    let fabric = Fabric::new(&layup.ply, &layup.settings).ok()?;
    let places: Option<Vec<[f64; 3]>> =
        fabric.places.iter().map(|uv| drape.place(mold, *uv)).collect();
    let places = places?;

    let motion = Motion { times: vec![0.0], positions: vec![target.grippers.clone()] };
    let layup = Layup { motion, tool: None, pick_up: None, ..layup.clone() };
    let (mut judge, mut hand_over) = (Judge::new(&layup, limits, false), HandOver::default());
    let see = |sheet: &_, state: &_, last| {
        judge.see(&hand_over.state(&layup, sheet, state, last), last);
        ControlFlow::Continue(())
    };
    let steps = Cell::new(0);
    let stop = || stop() || steps.replace(steps.get() + 1) >= MOST_STEPS;
    let beginning = Beginning::Laid(&places);
    let ended = drape_from(&layup, SheetTuning::default(), beginning, &stop, see).ok()?;
    let height = || judge.verdicts().into_iter().find(|verdict| verdict.name == Name::Height);
    (ended.status == Status::Converged).then(height)?
}
