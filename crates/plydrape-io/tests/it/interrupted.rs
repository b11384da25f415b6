//! Searches that are ended from outside: there is a plan all the same, and its drape is complete.

use crate::common::examples;
use plydrape::layup::Model;
use plydrape::measure::Name;
use plydrape::planner::{self, Planned, Progress};
use plydrape_io::scene::{self, SceneFile};
use std::ops::ControlFlow;

/// The dome with a coarse sheet, and a search that only somebody ends.
fn dome() -> SceneFile {
    let mut scene = scene::read(&examples().join("04_dome/scene.toml")).unwrap();
    scene.layup.settings.model = Model::Sheet;
    scene.layup.settings.sheet.mesh = Some(0.05);
    scene.limits.set(Name::Height, Some(1e-6));
    (scene.plan.steps, scene.plan.evaluations) = (20, 1_000_000);
    scene
}

/// A search that ends as soon as `end` holds.
fn ended(scene: &SceneFile, mut end: impl FnMut(&Progress) -> bool + Send) -> Planned {
    let watcher = &mut |progress: &Progress| match end(progress) {
        true => ControlFlow::Break(()),
        false => ControlFlow::Continue(()),
    };
    planner::plan(scene, None, watcher).unwrap()
}

/// At once, within the first drapes, or within the first that decides: the drape that decides is done all the same.
#[test]
fn a_search_that_is_ended_finishes_its_best_plan() {
    let scene = dome();
    let mut reports = 0;
    let at_once = |progress: &Progress| !progress.finishing;
    let early = |progress: &Progress| {
        reports += 1;
        !progress.finishing && reports > 20
    };
    let deciding = |progress: &Progress| !progress.finishing && progress.stage == "deciding";
    let plans = [ended(&scene, at_once), ended(&scene, early)];
    for planned in plans {
        assert!(planned.interrupted);
        let summary = planned.outcome.drape.summary;
        assert_eq!(summary.steps, planned.motion.times().len());
        assert!(!summary.interrupted());
        assert_eq!(planned.decisions, 1);
    }
    // a limit that is kept, so that the search decides
    let mut easy = scene;
    easy.limits.set(Name::Height, Some(1.0));
    easy.limits.set(Name::OutOfPlane, Some(1.0));
    easy.plan.improve = true;
    let planned = ended(&easy, deciding);
    assert!(planned.interrupted && planned.decisions == 1);
    assert!(!planned.outcome.drape.summary.interrupted());
}

/// Who ends even that has the states so far.
#[test]
fn a_plan_that_is_finished_can_be_ended_too() {
    let planned = ended(&dome(), |progress| progress.candidates > 0 || progress.finishing);
    let summary = planned.outcome.drape.summary;
    assert!(summary.interrupted() && summary.steps < planned.motion.times().len());
    assert_eq!(planned.decisions, 0);
}

/// Evolution may find lower scores that miss a limit; they do not replace a plan that keeps all.
#[test]
fn an_accepted_plan_is_only_replaced_by_an_accepted_one() {
    let mut scene = scene::read(&examples().join("04_dome/scene.toml")).unwrap();
    scene.layup.settings.sheet.mesh = Some(0.02);
    scene.plan.evaluations = 40;
    scene.plan.improve = true;
    let mut accepted = Vec::new();
    let watcher = &mut |progress: &Progress| {
        accepted.push(progress.accepted);
        ControlFlow::Continue(())
    };
    let planned = planner::plan(&scene, None, watcher).unwrap();
    assert!(accepted.is_sorted() && accepted.last() == Some(&true));
    assert_eq!(planned.outcome.drape.summary.model, Model::Sheet);
    assert!(planned.accepted() && !planned.interrupted);
    let ranked = planned.record.evaluations - planned.decisions;
    assert!((32..=40).contains(&ranked), "{ranked}");
}
