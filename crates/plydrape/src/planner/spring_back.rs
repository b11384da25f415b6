//! Whether a ply stays where it is laid: once its cups have let go, what is sheared springs back, and what lies steep slides, where neither weight
//! nor friction holds it.
//!
//! The ply is laid on its ideal drape, without any motion, and let go of. What rises then rises behind every motion, because a motion can do no
//! better than to lay each point of the fabric at its place.

use super::evaluation::{Mesh, as_ranked};
use crate::errors::{Draw, Errors, MaterialError, RelativeError};
use crate::geometry::vector::distance;
use crate::layup::{Friction, Layup, Model};
use crate::measure::{Judge, Limits, Name, Verdict};
use crate::mold::Mold;
use crate::motion::Motion;
use crate::net::{Net, Placement};
use crate::scene::Scene;
use crate::sheet::{Beginning, Fabric, HandOver, SheetTuning, Status, drape_from};
use rayon::prelude::*;
use std::cell::Cell;
use std::ops::ControlFlow;

/// Nodes up to which a ply is laid.
const MOST_NODES: usize = 1500;
/// Time steps after which it is not looked at any longer: up to 86 were seen.
const MOST_STEPS: usize = 160;
/// Ratio to its limit from which on the height of a ply that sprang back is one that no motion mends: searches ended up to 13 % lower.
const CERTAIN: f64 = 1.5;
/// Shares of its shear stiffness with which a ply is tried that springs back; errors leave a tenth of it at least.
const LIMPER: [f64; 3] = [0.5, 0.25, 0.1];
/// Share of a mesh of a net that is a rounding error.
const ROUNDING: f64 = 1e-6;

/// The verdict on the ply of a scene if it springs back or slides, so far that no motion mends it, with what would make it stay: the
/// nominal ply, or where the plan is to be `sampled`, so many of the plies of its sample that this cannot be passed.
pub(super) fn spring_back(
    scene: &Scene,
    sampled: bool,
    stop: &(dyn Fn() -> bool + Sync),
) -> Option<Verdict> {
    if scene.layup.settings.model != Model::Sheet || scene.layup.release.is_none() {
        return None;
    }
    // the mesh of the scene, or the coarse one, where that is soon done
    let mut layup = scene.layup.clone();
    // it is about a ply that no cup bends
    layup.settings.pad.lip = None;
    let of_mesh = |mesh: Mesh| as_ranked(layup.clone(), mesh);
    let is_small = |layup: &Layup| {
        let fabric = Fabric::new(&layup.ply, &layup.settings);
        fabric.is_ok_and(|fabric| fabric.places.len() <= MOST_NODES)
    };
    let layup = [Mesh::Own, Mesh::Coarse].map(of_mesh).into_iter().find(is_small)?;
    let ply = LaidPly { scene, layup, stop };
    let nominal = ply.laid(MaterialError::default())?;
    if nominal.ratio() > CERTAIN {
        return Some(ply.remedied(nominal, MaterialError::default(), ""));
    }
    let errors = scene.errors.filter(|errors| sampled && errors.is_drawn())?;
    ply.in_sample(errors)
}

/// A ply that is laid and let go of.
struct LaidPly<'a> {
    scene: &'a Scene,
    /// With the mesh that is used.
    layup: Layup,
    stop: &'a (dyn Fn() -> bool + Sync),
}

impl LaidPly<'_> {
    /// The verdict on it with an error of its material; `None` where that is not known.
    fn laid(&self, material: MaterialError) -> Option<Verdict> {
        laid(&self.with(material), &self.scene.limits, self.stop)
    }

    /// The layup of the scene with an error of its material.
    fn with(&self, material: MaterialError) -> Layup {
        let nominal = Errors::default().draw(0, self.layup.ply.grippers());
        Draw { material, ..nominal }.apply(&self.layup)
    }

    /// The verdict where so many plies of a sample spring back that it refuses every plan. Those that are stiffest in shear for their
    /// weight are laid, because the shape depends on this ratio.
    fn in_sample(&self, errors: Errors) -> Option<Verdict> {
        let draw = |cell: usize| {
            let MaterialError { areal_mass, bending, shear, .. } =
                errors.draw(cell, self.layup.ply.grippers()).material;
            // a length that is another one is laid as it is
            (cell, MaterialError { areal_mass, bending, shear, length: 0.0 })
        };
        let stiffness = |error: &MaterialError| error.shear.ratio() / error.areal_mass.ratio();
        let mut plies: Vec<(usize, MaterialError)> = (0..errors.samples).map(draw).collect();
        plies.sort_by(|a, b| stiffness(&b.1).total_cmp(&stiffness(&a.1)));
        plies.truncate(2 * (errors.samples - errors.needed(errors.samples) + 1));

        let laid = |(cell, error): &(usize, MaterialError)| {
            let moved = self.laid(*error).filter(|verdict| verdict.ratio() > CERTAIN)?;
            Some((*cell, *error, moved))
        };
        // where the stiffest stays, the others do but for accidents
        let (stiffest, others) = plies.split_first()?;
        let mut failed: Vec<(usize, MaterialError, Verdict)> = vec![laid(stiffest)?];
        failed.par_extend(others.par_iter().filter_map(laid));
        let fails = |cell: usize| failed.iter().any(|(n, ..)| *n == cell);
        let mut kept = 0;
        let decided = |cell: usize| {
            kept += usize::from(!fails(cell));
            errors.decided(kept, cell + 1)
        };
        if (0..errors.samples).find_map(decided) != Some(false) {
            return None;
        }
        let count = failed.len();
        let (_, limpest, verdict) = failed.into_iter().last()?;
        let plies = format!(" in at least {count} of the {} cells of the sample", errors.samples);
        Some(self.remedied(verdict, limpest, &plies))
    }

    /// The verdict on a ply that springs back with what would make it stay, which is tried: less shear stiffness, or a mold that it sticks to.
    fn remedied(&self, found: Verdict, material: MaterialError, plies: &str) -> Verdict {
        let stays = |layup: &Layup| {
            laid(layup, &self.scene.limits, self.stop).is_some_and(|verdict| verdict.ok)
        };
        let limper = |share: &f64| {
            let shear = RelativeError::Share(share * material.shear.ratio() - 1.0);
            stays(&self.with(MaterialError { shear, ..material }))
        };
        // a limper ply slides as well
        let springs = found.name == Name::Height;
        let limp = springs.then(|| LIMPER.into_iter().find(limper)).flatten();
        let limp = limp.map(|share| format!("with {share} times its shear stiffness"));
        let slides = matches!(self.layup.settings.contact.friction, Friction::Coulomb(_));
        let mut sticking = self.with(material);
        sticking.settings.contact.friction = Friction::Stick;
        let tacky = (slides && stays(&sticking)).then(|| "if it stuck to the mold".to_string());
        let remedies: Vec<String> = limp.into_iter().chain(tacky).collect();
        let remedy = match remedies.is_empty() {
            true => String::new(),
            false => format!(", and would stay {}", remedies.join(", or ")),
        };
        let moves = if springs { "springs back" } else { "slides" };
        let at = format!(
            "{}, laid without a motion and let go of: the ply {moves}{plies}{remedy}",
            found.at
        );
        Verdict { at, step: None, ..found }
    }
}

/// The verdict on the height of the ply of a layup that was laid on its ideal drape, after its cups have let go of it, or on its position if it
/// lies flat and has slid, or is still sliding; `None` where that is not known: without a mold or an ideal drape of all of the ply, or if it does not
/// come to rest soon where it was laid. One that still slides is said to be no farther off than the ply is long.
fn laid(layup: &Layup, limits: &Limits, stop: &dyn Fn() -> bool) -> Option<Verdict> {
    let (mold, target) = (layup.mold.as_ref()?, layup.target.as_ref()?);
    let drape = target.drape.as_ref()?;
    let fabric = Fabric::new(&layup.ply, &layup.settings).ok()?;
    let place = |net: &Net| -> Option<Vec<[f64; 3]>> {
        fabric.places.iter().map(|uv| net.place(mold, *uv)).collect()
    };
    let places = place(drape).or_else(|| place(&around(drape, mold, &fabric.places)?));
    let places = places?;

    let motion = Motion { times: vec![0.0], positions: vec![target.grippers.clone()] };
    let layup = Layup { motion, tool: None, pick_up: None, ..layup.clone() };
    let (mut judge, mut hand_over) = (Judge::new(&layup, limits, false), HandOver::default());
    let see = |sheet: &_, state: &_, last| {
        judge.see(&hand_over.state(&layup, sheet, state, last), last);
        ControlFlow::Continue(())
    };
    let steps = Cell::new(0);
    let enough = || stop() || steps.replace(steps.get() + 1) >= MOST_STEPS;
    let beginning = Beginning::Laid(&places);
    let ended = drape_from(&layup, SheetTuning::default(), beginning, &enough, see).ok()?;
    let rests = match ended.status {
        Status::Converged => true,
        Status::NotAtRest | Status::Interrupted if !stop() => false,
        _ => return None,
    };
    let verdict = |name| judge.verdicts().into_iter().find(|verdict| verdict.name == name);
    let (height, position) = (verdict(Name::Height)?, verdict(Name::Position));
    if rests {
        let slid = position.filter(|slid| slid.ratio() > CERTAIN && height.ratio() <= CERTAIN);
        return Some(slid.unwrap_or(height));
    }
    // one that still slides comes no nearer to its place, and may be folded for a while; how far it goes says nothing
    let size = places.iter().map(|place| distance(*place, places[0])).fold(0.0, f64::max);
    let most = |slid: Verdict| Verdict { value: slid.value.min(1e3 * size), place: None, ..slid };
    position.filter(|slid| slid.ratio() > CERTAIN).map(most)
}

/// An ideal drape that goes on beyond its net as far as these fabric points (m), as under an overhang.
fn around(net: &Net, mold: &Mold, points: &[[f64; 2]]) -> Option<Net> {
    let mut placement = net.placement;
    for n in 0..2 {
        let Placement { mesh, origin, nodes, .. } = net.placement;
        let last = (nodes[n].max(1) - 1) as f64 * mesh[n];
        let places = || points.iter().map(|uv| uv[n] - origin[n]);
        // how many meshes the points are before the first node, and behind the last
        let meshes = |beyond: f64| (beyond / mesh[n] - ROUNDING).ceil().max(0.0) as usize;
        let before = meshes(-places().fold(0.0, f64::min));
        let behind = meshes(places().fold(last, f64::max) - last);
        placement.origin[n] -= before as f64 * mesh[n];
        placement.seed[n] += before;
        placement.nodes[n] += before + behind;
    }
    Net::drape(mold, placement).ok()
}
