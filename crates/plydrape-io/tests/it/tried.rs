//! Changes of a scene that are tried where no plan is found.

use crate::common::parse;
use plydrape::planner::{Change, Planned, Progress, TRYING, plan, plan_without_errors};
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

/// The bowl with a radius of 0.3 m, in which no plan is found without errors either.
fn tighter() -> Scene {
    parse(&BOWL.replace("0.35 m", "0.3 m"))
}

/// A plan that was asked for without errors says nothing of cells with errors.
#[test]
fn without_errors_changes_are_tried_in_no_cell() {
    let go_on = &mut |_: &Progress| ControlFlow::Continue(());
    let refused = plan_without_errors(&tighter(), None, go_on).expect("a plan");
    assert!(!refused.accepted());
    let tried = &refused.record.tried;
    assert!(tried.iter().any(|tried| tried.helps && tried.near.limit.ok), "{tried:?}");
    assert!(tried.iter().all(|tried| tried.near.cells == 0), "{tried:?}");
}

/// Who asks for the end while changes are tried gets the plan without them, and that plan was not cut off.
#[test]
fn nobody_waits_for_changes_who_asks_for_the_end() {
    let end = &mut |progress: &Progress| match progress.stage {
        TRYING => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    };
    let refused = plan_without_errors(&tighter(), None, end).expect("a plan");
    assert!(!refused.accepted() && !refused.interrupted);
    assert_eq!(refused.record.tried, []);
}
