//! Plans that were judged with errors, judged anew as they are written.

use crate::common::parse;
use plydrape::measure::Name;
use plydrape::outcome::{SampleVerdict, Watch};
use plydrape::planner::{self, Planned, Progress};
use plydrape::scene::Scene;
use std::ops::ControlFlow;

/// A shallow dome under 2 × 2 cups of a usual cell, above which the ply hangs. The tilt rate limits the motion.
const DOME: &str = "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [2, 2]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"prepreg_warm\"\n\
    [mold]\nkind = \"sphere\"\nradius = \"0.8 m\"\nposition = [0, 0, \"-0.8 m\"]\n\
    [grippers]\nspacing = [\"98 mm\", \"98 mm\"]\nheight = \"60 mm\"\norigin = \"centered\"\n[target]\nseed = \"middle\"\n\
    [limits]\ntilt_rate = \"30 deg/s\"\n[errors]\nsamples = 20\n";

/// The same, picked up from a table beside it.
fn beside() -> String {
    DOME.replace("origin = \"centered\"", "middle = [\"-0.5 m\", 0]")
        + "[pick_up]\ntable = \"table\"\nclearance = \"50 mm\"\ngrip = \"0.5 s\"\n\
           [[obstacles]]\nname = \"table\"\nbox = { size = [\"300 mm\", \"300 mm\", \"40 mm\"] }\nposition = [\"-0.5 m\", 0, 0]\n"
}

/// The sample of a plan, draped along the motion that is written in its time, has the verdict of the plan, the tilt rate among its limits.
#[test]
fn a_plan_is_accepted_with_errors_as_it_is_written() {
    for text in [DOME.to_owned(), beside()] {
        let scene = parse(&text);
        let go_on = &mut |_: &Progress| ControlFlow::Continue(());
        let planned = planner::plan(&scene, None, go_on).expect("a plan");
        assert!(planned.accepted(), "{:?}", planned.outcome.drape.summary.limits);
        is_accepted_as_it_is_written(&scene, &planned);
    }
}

fn is_accepted_as_it_is_written(scene: &Scene, planned: &Planned) {
    let watch = Watch { stop: &|| false, done: &|_, _| {} };
    let along = planner::along(scene, &planned.motion);
    let again = scene.errors.unwrap().judge(&along, &watch).unwrap();
    let sample = planned.outcome.drape.summary.sample.as_ref().unwrap();
    let accepted = |sample: &SampleVerdict| -> Vec<bool> {
        sample.cells.iter().map(|cell| cell.accepted).collect()
    };
    assert_eq!(accepted(&again), accepted(sample));
    for (limit, before) in again.limits.iter().zip(&sample.limits) {
        assert!(
            limit.name == before.name && (limit.value - before.value).abs() <= 1e-6 * before.value
        );
    }
    let turning = again.limits.iter().find(|limit| limit.name == Name::TiltRate).unwrap();
    assert!(turning.ok, "{turning:?}");
}
