//! What is decided of a plan that is good at its own steps alone.

use super::along;
use super::decision::Decision;
use super::search_state::SearchState;
use crate::errors::tests::layup;
use crate::layup::Model;
use crate::measure::{Limits, Name, Verdict};
use crate::motion::TimedMotion;
use crate::outcome::simulate;
use crate::scene::Scene;
use std::ops::ControlFlow;

/// A coarse sheet between four grippers in the air, with no limits but those of their motion.
fn scene() -> Scene {
    let layup = layup(2, 2);
    let mut scene = Scene::new(layup.ply, layup.settings, layup.motion);
    scene.layup.settings.model = Model::Sheet;
    scene.layup.settings.sheet.mesh = Some(0.04);
    let moves = [Name::Speed, Name::Acceleration, Name::Jerk];
    for (name, _) in Limits::usual(&scene.layup).iter().filter(|(name, _)| !moves.contains(name)) {
        scene.limits.set(name, None);
    }
    scene
}

/// The path runs aside and back so that it is farthest aside half-way between two steps: by 46/48 of the way of its control points, and by
/// 5/6 at the steps. A workspace that ends between the two is kept at every step.
#[test]
fn a_plan_that_keeps_its_limits_at_its_steps_alone_is_refused() {
    let mut scene = scene();
    // control points that go 30 mm aside and back, and 5 mm forward with each step
    let start = scene.layup.motion.positions[0].clone();
    let aside = [0.0, 0.0, 0.03, 0.03, 0.0, 0.0].into_iter().enumerate();
    let step = |(k, x): (usize, f64)| {
        start.iter().map(|p| [p[0] + x, p[1] + 5e-3 * k as f64, p[2]]).collect::<Vec<_>>()
    };
    let positions: Vec<_> = aside.map(step).collect();
    let motion = TimedMotion::new(&positions, &scene.limits.motion_bounds()).unwrap();

    // the workspace ends between the farthest place at a step and that half-way between steps
    let farthest = |times: &[f64]| {
        let places = times.iter().flat_map(|t| motion.at(*t)).map(|place| place[0]);
        places.fold(f64::NEG_INFINITY, f64::max)
    };
    let times = motion.times();
    let middles: Vec<f64> = times.windows(2).map(|pair| 0.5 * (pair[0] + pair[1])).collect();
    let (at_steps, between) = (farthest(times), farthest(&middles));
    assert!(between > at_steps + 1e-3, "{at_steps} {between}");
    let side = 0.5 * (at_steps + between);
    scene.limits.workspace = Some([[-1.0, side], [-1.0, 1.0], [-1.0, 1.0]]);

    // at its own steps the motion keeps the workspace
    let own = simulate(&along(&scene, &motion), |_| ControlFlow::Continue(())).unwrap();
    assert!(own.accepted(), "{:?}", own.drape.summary);

    // the decision also looks half-way between the steps, and finds that it leaves the workspace
    let mut go_on = |_: &super::Progress| ControlFlow::Continue(());
    let state = SearchState::new(1, &mut go_on);
    let decided = Decision::uncounted(&scene, None, positions, &state).unwrap().decided;
    assert!(!decided.judged.accepted() && decided.score > 1.0, "{:?}", decided.judged);
    assert!(!decided.drape.summary.accepted());
    let limits = decided.drape.summary.limits.iter();
    let broken: Vec<&Verdict> = limits.filter(|verdict| !verdict.ok).collect();
    let [workspace] = broken[..] else { panic!("{broken:?}") };
    assert_eq!(workspace.name, Name::Workspace);
    assert!((workspace.value - 1e3 * (between - side)).abs() < 1e-6, "{workspace:?}");
    assert!(workspace.at.ends_with(", with steps half-way between all steps"), "{workspace:?}");
}

/// A motion that is longer than the scene allows is no accepted plan, though its drape keeps every limit: it is not reported as one, and its
/// score is that of a plan which misses a limit. Without that limit the same plan is accepted, in its least time.
#[test]
fn a_plan_is_called_accepted_once_its_motion_is_judged_too() {
    let mut scene = scene();
    let start = scene.layup.motion.positions[0].clone();
    let lift = |k: usize| start.iter().map(|p| [p[0], p[1], p[2] + 5e-3 * k as f64]).collect();
    let positions: Vec<Vec<_>> = (0..6).map(lift).collect();
    let mut decide = |longest: Option<f64>| {
        scene.limits.set(Name::Duration, longest);
        let mut reported = false;
        let mut go_on = |progress: &super::Progress| {
            reported |= progress.accepted;
            ControlFlow::Continue(())
        };
        let state = SearchState::new(1, &mut go_on);
        let decision = Decision::on(&scene, None, positions.clone(), None, &state).unwrap();
        drop(state);
        (decision, reported)
    };
    let (free, reported) = decide(None);
    assert!(free.decided.judged.accepted(), "{:?}", free.decided.judged);
    assert!(reported && free.limited_by.is_some() && free.decided.drape.summary.accepted());
    let duration = free.motion.duration();

    let (refused, reported) = decide(Some(0.5 * duration));
    assert!(!reported && !refused.decided.judged.accepted(), "{:?}", refused.decided.judged);
    assert!(refused.decided.score > 1.0 && !refused.decided.drape.summary.accepted());
    let (kept, reported) = decide(Some(2.0 * duration));
    assert!(reported && kept.decided.drape.summary.accepted());
    assert_eq!(kept.decided.score, free.decided.score, "a limit that is kept changes no ranking");
}
