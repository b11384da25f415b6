//! Where grippers may be: the smallest distance between them and their workspace, over all steps.

use crate::common::{drape, parse};
use plydrape::measure::{Name, Verdict};
use plydrape_io::result::ResultFile;

/// Two grippers of a strip that come together from 98 mm to 80 mm at the height of 50 mm, in 10 steps.
fn closing(limits: &str) -> ResultFile {
    let text = format!(
        "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 1]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n[grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n[target]\npositions = [[[0, 0, 0.05], [0.08, 0, 0.05]]]\n[motion]\nkind = \"straight\"\nsteps = 10\n[limits]\ntilt = \"89 deg\"\n{limits}\n"
    );
    drape(&parse(&text))
}

fn verdict<'a>(result: &'a ResultFile, name: &str) -> Option<&'a Verdict> {
    result.summary.limits.iter().find(|verdict| verdict.name.measure().name() == name)
}

/// A least value: its worst is the smallest of all steps, and less than the limit fails.
#[test]
fn the_distance_of_grippers_counts_where_it_is_smallest() {
    for (limit, ok) in [("79 mm", true), ("80 mm", true), ("81 mm", false)] {
        let result = closing(&format!("gripper_distance = \"{limit}\""));
        let verdict = verdict(&result, "gripper_distance").unwrap();
        assert!((verdict.value - 80.0).abs() < 1e-9, "{verdict:?}");
        assert_eq!((verdict.ok, verdict.step), (ok, Some(10)), "{verdict:?}");
        assert_eq!(verdict.at, "grippers g0_0 and g1_0");
        assert_eq!(result.summary.accepted(), ok);
    }
}

/// The second gripper starts 8 mm beyond x = 90 mm and is inside at the end; without a box there is no verdict.
#[test]
fn the_workspace_counts_in_every_step() {
    let result = closing("workspace = [[-1, \"90 mm\"], [-1, 1], [0, 1]]");
    let outside = verdict(&result, "workspace").unwrap();
    assert!((outside.value - 8.0).abs() < 1e-9, "{outside:?}");
    assert_eq!((outside.ok, outside.limit, outside.step), (false, 0.0, Some(1)));
    assert_eq!(outside.at, "gripper g1_0");
    let last = result.steps[9].measures.get(Name::Workspace).unwrap();
    assert_eq!((last.value, last.at.as_str()), (0.0, "nowhere"));

    let result = closing("");
    assert!(verdict(&result, "workspace").is_none());
    assert!(result.steps[0].measures.value(Name::Workspace).is_none());
}

/// A limit that is added later takes part in the verdict as those before do.
#[test]
fn a_limit_that_is_added_later_takes_part_in_the_verdict() {
    let mut summary = closing("").summary;
    assert!(summary.accepted());
    let (count, kept) = (summary.limits.len(), summary.limits[0].clone());
    let duration = |ok| Verdict { name: Name::Duration, ok, ..kept.clone() };
    summary.judge_also([duration(true)]);
    assert!(summary.accepted() && summary.limits.len() == count + 1);
    // of one limit the worse verdict stays, whichever comes first
    summary.judge_also([duration(false), duration(true)]);
    assert!(!summary.accepted());
    assert_eq!(summary.limits.len(), count + 1);
}
