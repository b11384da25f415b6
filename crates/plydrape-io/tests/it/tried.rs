//! Changes of a scene that are tried where no plan is found.

use crate::common::parse;
use plydrape::planner::{Change, Planned, Progress, plan};
use plydrape::scene::Scene;
use std::ops::ControlFlow;

/// A bowl of radius 0.35 m under 2 × 2 cups of a usual cell, with a ply that is stiff in shear.
const BOWL: &str = "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"prepreg_cold\"\n\
    [mold]\nkind = \"sphere\"\nside = \"inside\"\nradius = \"0.35 m\"\nposition = [0, 0, \"0.35 m\"]\n\
    [grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"80 mm\"\norigin = \"centered\"\n\
    [target]\nseed = \"middle\"\n[plan]\nevaluations = 40\n";

fn planned(scene: &Scene) -> Planned {
    plan(scene, None, &mut |_: &Progress| ControlFlow::Continue(())).expect("a plan")
}

/// No short search finds a plan for a cold prepreg; with a quarter of its shear stiffness, which is said to help most, one does.
#[test]
fn what_is_said_to_help_most_leads_to_a_plan() {
    let scene = parse(BOWL);
    let refused = planned(&scene);
    assert!(!refused.accepted());
    let tried = &refused.record.tried;
    let most = tried.first().expect("changes were tried");
    assert!(most.helps && most.change == Change::ShearStiffness(0.25), "{tried:?}");
    let rank = |n: usize| (!tried[n].near.limit.ok, tried[n].near.cells - tried[n].near.kept);
    assert!((1..tried.len()).all(|n| rank(0) <= rank(n)), "{tried:?}");

    let mut limper = scene.clone();
    limper.layup.ply.material = scene.layup.ply.material.with_shear(0.25);
    let accepted = planned(&limper);
    assert!(accepted.accepted(), "{:?}", accepted.record.tried);
    assert_eq!(accepted.record.tried, []);
}
