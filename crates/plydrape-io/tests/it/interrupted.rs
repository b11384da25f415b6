//! Searches that are ended from outside: there is a plan all the same, and its drape is complete.

use crate::common::{examples, parse};
use plydrape::layup::Model;
use plydrape::measure::Name;
use plydrape::outcome::{Robustness, Watch};
use plydrape::planner::{self, Checkpoint, Planned, Progress};
use plydrape::scene::Scene;
use plydrape_io::plan;
use plydrape_io::result::SceneEcho;
use plydrape_io::scene::{self, SceneFile};
use std::ops::ControlFlow;

/// The dome with a coarse sheet, and a search that only somebody ends.
fn dome() -> SceneFile {
    let mut scene = scene::read(&examples().join("ideal_dome/scene.toml")).unwrap();
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
    let mut scene = scene::read(&examples().join("ideal_dome/scene.toml")).unwrap();
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

/// From any state that was written on the way, read back, the search goes on to the plan that it finds undisturbed, with the same counts, and
/// from a state on the way of that one too. For another scene only the best plan of a state counts.
#[test]
fn a_search_that_was_cut_off_goes_on_to_the_same_plan() {
    let mut scene = dome();
    for name in [Name::Height, Name::OutOfPlane] {
        scene.limits.set(name, Some(6e-3));
    }
    (scene.plan.evaluations, scene.plan.improve) = (70, true);
    let echo = SceneEcho::new(&scene, None);
    let search = |from: Option<&Checkpoint>| {
        let mut kept: Vec<(usize, String)> = Vec::new();
        let watcher = &mut |progress: &Progress| {
            let drapes = progress.candidates + progress.decisions;
            if kept.last().is_none_or(|(before, _)| drapes >= before + 15) {
                let state = (progress.checkpoint)();
                kept.extend(state.map(|state| (drapes, plan::text(&state, &echo).unwrap())));
            }
            ControlFlow::Continue(())
        };
        let planned = planner::plan_without_errors(&scene, from, watcher).unwrap();
        (planned, kept)
    };
    let (whole, states) = search(None);
    assert!(states.len() > 2 && whole.decisions > 1, "{} {}", states.len(), whole.decisions);
    let same = |planned: &Planned| {
        assert_eq!(planned.record, whole.record);
        assert_eq!(planned.decisions, whole.decisions);
        assert_eq!(planned.outcome.drape.summary, whole.outcome.drape.summary);
        assert_eq!(planned.outcome.drape.steps, whole.outcome.drape.steps);
        assert_eq!(planned.checkpoint, whole.checkpoint);
    };
    let last = states.last().unwrap();
    for (drapes, text) in [&states[0], &states[states.len() / 2], last] {
        let state = plan::read(text, &echo).unwrap();
        assert!(state.is_unfinished());
        let (again, on_the_way) = search(Some(&state));
        same(&again);
        // what was judged before is not draped again: no progress is reported, but for the generation in which it was cut off
        assert!(on_the_way.first().is_none_or(|(first, _)| first + 8 >= *drapes), "{drapes}");
        if let Some((_, text)) = on_the_way.last() {
            same(&search(Some(&plan::read(text, &echo).unwrap())).0);
        }
    }
    let mut other = scene.clone();
    other.limits.set(Name::Height, Some(7e-3));
    let state = plan::read(&last.1, &SceneEcho::new(&other, None)).unwrap();
    assert!(!state.is_unfinished() && !whole.checkpoint.is_unfinished());
}

/// 2 × 2 cups on mounts over a cylinder, each off by a deviation.
fn off_by(deviation: &str) -> Scene {
    parse(&format!(
        "cell.preset = \"usual\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"prepreg_warm\"\n\
         [mold]\nkind = \"cylinder\"\nradius = \"0.8 m\"\nposition = [0, 0, \"-0.8 m\"]\n[target]\nseed = \"middle\"\n\
         [grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"60 mm\"\norigin = \"centered\"\n[sheet]\nmesh = \"20 mm\"\n\
         [errors]\nseed = 1\ngripper.position = {{ deviation = \"{deviation}\" }}\n"
    ))
}

/// A plan that the cells of the planner have proven, and that the sample of the scene refuses, does not end the search: it ends with one that
/// the sample accepts. From a state behind a refusal it goes on to the same plan.
#[test]
fn a_search_goes_on_behind_a_sample_that_refuses() {
    let mut scene = off_by("0.72 mm");
    scene.errors.as_mut().unwrap().seed = 17;
    let (mut behind, mut judged) = (None, false);
    let watcher = &mut |progress: &Progress| {
        if progress.sample.is_none() && judged {
            behind = behind.take().or_else(|| (progress.checkpoint)());
        }
        judged |= progress.sample.is_some();
        ControlFlow::Continue(())
    };
    let planned = planner::plan(&scene, None, watcher).unwrap();
    assert!(planned.record.refused.is_some_and(|refused| refused > 0), "it shows nothing");
    let sample = planned.outcome.drape.summary.sample.as_ref().unwrap();
    assert!(planned.accepted() && sample.ok, "{} of {}", sample.accepted(), sample.cells.len());

    assert!(behind.is_some(), "it shows nothing");
    let go = &mut |_: &Progress| ControlFlow::Continue(());
    let again = planner::plan(&scene, behind.as_ref(), go).unwrap();
    assert_eq!(again.record, planned.record);

    // the plan that is refused is the one that a search without the sample ends with
    let proven = planner::plan_without_errors(&scene, None, go).unwrap();
    assert!(proven.accepted() && proven.record.path != planned.record.path);
    let mut summary = proven.outcome.drape.summary;
    let robustness = Robustness::of_planned(&scene, proven.motion.steps());
    robustness.judge_sample(&mut summary, &Watch { stop: &|| false, done: &|_, _| {} });
    assert!(!summary.accepted() && summary.sample.is_some_and(|sample| !sample.ok));
}

/// What the sample refuses is not asked again without end: of errors that no plan keeps it judges five plans at most.
#[test]
fn a_sample_judges_few_plans_of_a_search() {
    let mut scene = off_by("0.72 mm");
    scene.errors.as_mut().unwrap().seed = 6;
    scene.plan.evaluations = 40;
    let planned = planner::plan(&scene, None, &mut |_| ControlFlow::Continue(())).unwrap();
    let refused = planned.record.refused.unwrap_or(0);
    assert!((1..=5).contains(&refused), "{refused}");
    assert!(!planned.accepted() && planned.outcome.drape.summary.sample.is_some());
}
