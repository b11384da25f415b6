//! What would help where a search has found no plan: a few changes of the scene, each of them tried.
//!
//! A changed scene is draped along the fronts that race first and along the best one of the search, with the mesh of the scene, and the best of
//! these in a few cells with errors too. That is far less than a search: a change may do more than is seen here, and few cells may keep what others break.

use super::evaluation::{Bias, Drapes, Mesh};
use super::path::{Fronts, Strategy, bilinear};
use super::search_state::SearchState;
use crate::layup::{Friction, Layup, Model, Target};
use crate::measure::{Name, Verdict};
use crate::motion::Motion;
use crate::ply::{Grid, Ply};
use crate::scene::Scene;
use rayon::prelude::*;
use std::fmt;

/// The stage of a search in which changes are tried: nobody waits for it who has asked for the end.
pub const TRYING: &str = "trying changes of the scene";

/// Shares of its shear stiffness with which a ply is tried.
const LIMPER: [f64; 2] = [0.5, 0.25];
/// Friction that is tried in place of a mold that the ply sticks to: that of a ply without tack.
const SLIDING: f64 = 0.3;
/// Share of the errors of its grippers with which a cell is tried.
const MORE_EXACT: f64 = 0.3;
/// How much farther grippers may tilt (rad), and how far at most.
const TILT: [f64; 2] = [0.25, 1.2];
/// Cells with errors in which the best front of a change is draped.
const CELLS: [usize; 8] = [0, 1, 2, 3, 4, 5, 6, 7];
/// Ratio of scores from which on a change helps.
const GAIN: f64 = 0.8;

/// A change of a scene.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Change {
    /// Another number of grippers along u and along v, which hold as much of the ply.
    Grippers([usize; 2]),
    /// A ply with so many times its shear stiffness.
    ShearStiffness(f64),
    /// A mold on which the ply slides with this friction.
    Friction(f64),
    /// A mold that the ply sticks to.
    Stick,
    /// Grippers whose positions are off by so many times their errors.
    GripperErrors(f64),
    /// Grippers that may tilt so far (rad).
    Tilt(f64),
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Change::Grippers([u, v]) => write!(f, "{u} × {v} grippers"),
            Change::ShearStiffness(share) => write!(f, "{share} times the shear stiffness"),
            Change::Friction(friction) => write!(f, "a mold with a friction of {friction}"),
            Change::Stick => write!(f, "a mold that the ply sticks to"),
            Change::GripperErrors(share) => write!(f, "{share} times the errors of the grippers"),
            Change::Tilt(angle) => write!(f, "a tilt of up to {:.0}°", angle.to_degrees()),
        }
    }
}

/// How near a scene comes to a plan along the best of a few fronts.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Near {
    /// The limit that is exceeded farthest, or nearest to it, without errors.
    pub limit: Verdict,
    /// Cells with errors that keep every limit; 0 where the drape without errors does not.
    pub kept: usize,
    /// Cells with errors that were draped.
    pub cells: usize,
}

/// A change that was tried.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Tried {
    /// What is changed.
    pub change: Change,
    /// How near the changed scene comes to a plan.
    pub near: Near,
    /// Whether that is clearly nearer than the scene comes as it is.
    pub helps: bool,
}

/// The changes of a scene that were tried, what helps most first; in a few cells with errors too if the plan is `sampled`. They take no more
/// drapes than the search did that found no plan.
pub(super) fn tried(
    scene: &Scene,
    best: Option<Strategy>,
    sampled: bool,
    state: &SearchState,
) -> Vec<Tried> {
    // tools and tables are planned for in another way, and catenaries have no cells
    let Layup { settings, tool, pick_up, .. } = &scene.layup;
    if settings.model != Model::Sheet || tool.is_some() || pick_up.is_some() {
        return Vec::new();
    }
    let cells: &[usize] = if sampled { &CELLS } else { &[] };
    let mut left = state.candidates();
    let mut near = |scene: &Scene| near(scene, best, cells, &mut left, state);
    // less is nearer, and what keeps its limits without errors is nearer than all that does not
    let rank = |(near, score): &(Near, f64)| (!near.limit.ok, *score);
    let before = near(scene);
    let errors_refuse = before.as_ref().is_some_and(|(near, _)| near.cells > 0);
    let (refused, score) = before.as_ref().map_or((true, f64::INFINITY), rank);
    let mut found: Vec<(Change, (Near, f64))> = Vec::new();
    for (change, changed) in changes(scene, errors_refuse) {
        found.extend(near(&changed).map(|near| (change, near)));
    }
    found.sort_by(|a, b| {
        let [a, b] = [&a.1, &b.1].map(rank);
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    });
    let tried = |(change, near): (Change, (Near, f64))| {
        let helps = rank(&near) < (refused, GAIN * score);
        Tried { change, near: near.0, helps }
    };
    found.into_iter().map(tried).collect()
}

/// The changed scenes; grippers are more exact where errors are what refuses a plan.
fn changes(scene: &Scene, errors_refuse: bool) -> Vec<(Change, Scene)> {
    let mut changes = Vec::new();
    let Layup { settings, .. } = &scene.layup;
    if let Some(more) = with_more_grippers(scene) {
        let Grid { nu, nv } = more.layup.ply.grid;
        changes.push((Change::Grippers([nu, nv]), more));
    }
    for share in LIMPER {
        let mut limper = scene.clone();
        limper.layup.ply.material = limper.layup.ply.material.with_shear(share);
        changes.push((Change::ShearStiffness(share), limper));
    }
    let mut other = scene.clone();
    let (change, friction) = match settings.contact.friction {
        Friction::Coulomb(_) => (Change::Stick, Friction::Stick),
        Friction::Stick | Friction::StickForEver => {
            (Change::Friction(SLIDING), Friction::Coulomb(SLIDING))
        }
    };
    other.layup.settings.contact.friction = friction;
    changes.push((change, other));
    if errors_refuse && let Some(errors) = scene.errors {
        let mut exact = errors;
        exact.gripper.position = errors.gripper.position.scaled(MORE_EXACT);
        let exact = Scene { errors: Some(exact), ..scene.clone() };
        changes.push((Change::GripperErrors(MORE_EXACT), exact));
    }
    let tilt = scene.limits.most(Name::Tilt) + TILT[0];
    if tilt < TILT[1] {
        let limits = scene.limits.clone().with(Name::Tilt, tilt);
        changes.push((Change::Tilt(tilt), Scene { limits, ..scene.clone() }));
    }
    changes
}

/// The scene with a gripper more along u and v over the same fabric, which starts as it did; `None` of a ply that is cut, whose cups are no
/// whole array, or that has no ideal drape.
fn with_more_grippers(scene: &Scene) -> Option<Scene> {
    let Layup { ply, mold, target, .. } = &scene.layup;
    let (mold, net) = (mold.as_ref()?, target.as_ref()?.drape.as_ref()?);
    let Grid { nu, nv } = ply.grid;
    if ply.cut.is_some() || ply.grid == Grid::NONE {
        return None;
    }
    // a strip has one line of them
    let grid = Grid { nu: nu + 1, nv: if nv > 1 { nv + 1 } else { 1 } };
    let share =
        [(nu - 1) as f64 / nu as f64, if nv > 1 { (nv - 1) as f64 / nv as f64 } else { 1.0 }];
    let cell = [0, 1].map(|n| ply.cell[n] * share[n]);
    let ply = Ply { warp: ply.warp, ..Ply::of_array(grid, cell, ply.material.clone()) };
    let grippers = || 0..ply.grippers();
    let start = scene.layup.start();
    let starts = grippers().map(|n| {
        let id = grid.id(n);
        bilinear(scene.layup.ply.grid, start, [0, 1].map(|n| id[n] as f64 * share[n]))
    });
    let motion = Motion { times: vec![0.0], positions: vec![starts.collect()] };
    let grippers: Option<Vec<_>> =
        grippers().map(|n| net.place_or_node(mold, ply.place(n))).collect();
    let target = Some(Target { grippers: grippers?, drape: Some(net.clone()) });
    let mut more = scene.clone();
    more.layup = Layup { ply, motion, target, ..more.layup };
    Some(more)
}

/// How near a scene comes to a plan, and the mean score of what was draped; `None` where no front is draped to its end, fewer drapes are `left`
/// than that takes, or somebody asked for the end.
fn near(
    scene: &Scene,
    best: Option<Strategy>,
    cells: &[usize],
    left: &mut usize,
    state: &SearchState,
) -> Option<(Near, f64)> {
    if state.report().is_break() {
        return None;
    }
    let fronts = Fronts::new(scene)?;
    let first = Strategy::racing_first(scene, |shape| fronts.steepest(shape));
    let all: Vec<Strategy> = first.into_iter().chain(best).collect();
    *left = left.checked_sub(all.len() + cells.len())?;

    // the nearest front without errors, and that in cells
    let draped = |front: &Strategy| {
        let positions = fronts.positions(*front)?;
        let is_possible = fronts.too_far(&positions).is_none();
        let draped = is_possible.then(|| fronts.draped(&positions, Mesh::Own, state))?.ok()?;
        let drapes = draped.in_cells(&[], 0, state);
        drapes.worst.complete.then_some((drapes, draped))
    };
    let draped: Vec<_> = all.par_iter().filter_map(draped).collect();
    let score = |drapes: &Drapes| drapes.score(&Bias::default());
    let nearest = draped.into_iter().min_by(|a, b| score(&a.0).total_cmp(&score(&b.0)));
    let (mut drapes, nearest) = nearest?;
    if drapes.worst.accepted() {
        drapes = nearest.in_cells(cells, cells.len(), state);
    }

    let (without, with_errors) = drapes.each.split_first()?;
    let limit = without.limits.iter().max_by(|a, b| a.ratio().total_cmp(&b.ratio()))?.clone();
    let kept = with_errors.iter().filter(|judged| judged.accepted()).count();
    let near = Near { limit, kept, cells: with_errors.len() };
    (!state.is_stopped()).then(|| (near, score(&drapes)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::errors::{Errors, Term};
    use crate::geometry::vector::distance;
    use crate::material::Material;
    use crate::mold::{Face, Mold, Pose, Sphere};

    /// 3 × 2 cups over 200 × 100 mm on a sphere of radius 0.5 m, with errors of 0.1 mm.
    fn dome() -> Scene {
        let pose = Pose::upright([0.0, 0.0, -0.5]);
        let sphere = Sphere { pose, radius: 0.5, face: Face::Outside };
        let woven = Material::woven("cloth", 0.3, 2e-5, 1e6, 20.0);
        let ply = Ply::of_array(Grid { nu: 3, nv: 2 }, [0.1, 0.1], woven);
        let mut scene = Scene::above(ply, Mold::Sphere(sphere), [0.0; 2]).expect("a dome");
        let mut errors = Errors::default();
        errors.gripper.position = Term::Deviation(1e-4);
        scene.errors = Some(errors);
        scene
    }

    /// The corners of the ply stay where they are, on the fabric and on the mold; all others lie on the mold too.
    #[test]
    fn more_grippers_hold_the_same_ply_at_the_same_place() {
        let scene = dome();
        let more = with_more_grippers(&scene).expect("a whole array");
        let [before, after] = [&scene, &more].map(|scene| &scene.layup);
        assert_eq!(after.ply.grid, Grid { nu: 4, nv: 3 });
        let place = |layup: &Layup, n: usize| layup.target.as_ref().expect("a target").grippers[n];
        for (a, b) in [(0, 0), (2, 3), (3, 8), (5, 11)] {
            let fabric = [before.ply.place(a), after.ply.place(b)].map(|[u, v]| [u, v, 0.0]);
            assert!(distance(fabric[0], fabric[1]) < 1e-12, "{fabric:?}");
            assert!(distance(place(before, a), place(after, b)) < 1e-5, "gripper {a}");
        }
        for n in 0..12 {
            let [x, y, z] = place(after, n);
            assert!((distance([x, y, z], [0.0, 0.0, -0.5]) - 0.5).abs() < 1e-9);
        }
        // a level rectangle is one, between the same corners
        let [old, new] = [before, after].map(Layup::start);
        assert!(distance(old[0], new[0]) < 1e-12 && distance(old[5], new[11]) < 1e-12);
        let third = [0, 1, 2].map(|c| old[0][c] + (old[2][c] - old[0][c]) / 3.0);
        assert!(distance(third, new[1]) < 1e-12, "{new:?}");
    }

    /// Grippers are more exact only where errors refuse a plan; on a mold that slides a sticky one is tried, and no tilt beyond what any joint does.
    #[test]
    fn only_changes_that_may_help_are_tried() {
        let mut scene = dome();
        let named = |scene: &Scene, errors_refuse: bool| -> Vec<Change> {
            changes(scene, errors_refuse).into_iter().map(|(change, _)| change).collect()
        };
        scene.layup.settings.contact.friction = Friction::Stick;
        let sticking = named(&scene, false);
        assert!(sticking.contains(&Change::Friction(SLIDING)), "{sticking:?}");
        assert!(!sticking.contains(&Change::GripperErrors(MORE_EXACT)), "{sticking:?}");
        assert!(named(&scene, true).contains(&Change::GripperErrors(MORE_EXACT)));
        let exact = changes(&scene, true).into_iter().find_map(|(change, changed)| {
            matches!(change, Change::GripperErrors(_)).then_some(changed.errors?.gripper.position)
        });
        assert_eq!(exact, Some(Term::Deviation(0.3e-4)));

        scene.layup.settings.contact.friction = Friction::Coulomb(0.4);
        assert!(named(&scene, false).contains(&Change::Stick));
        let is_tilt = |change: &Change| matches!(change, Change::Tilt(_));
        assert!(named(&scene, false).iter().any(is_tilt));
        scene.limits.set(Name::Tilt, Some(1.0));
        assert!(!named(&scene, false).iter().any(is_tilt));
    }
}
