//! When pads let go: from the scene file to the result and its states.

use crate::common::{decided, parse};
use plydrape::layup::{Release, ReleaseOrder};
use plydrape::measure::Name;
use plydrape::outcome::Status;
use plydrape::scene::Scene;
use plydrape::sheet::{Event, EventKind};
use plydrape_io::result::read;
use plydrape_io::write::csv;
use plydrape_io::{ResultFile, write_all};
use std::path::Path;

/// A ply of 4 × 2 grippers that is lowered on a plane, sheared by 10°, with more tables.
fn flat(more: &str) -> Scene {
    let text = format!(
        "[ply]\ngrippers = [4, 2]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n[mold]\nkind = \"plane\"\n\
        [grippers]\nspacing = [0.098, 0.098]\nheight = 0.03\n[target]\nshear = \"10 deg\"\n\
        [motion]\nkind = \"straight\"\nsteps = 8\n[sheet]\nmesh = 0.025\nkeep = 3\n\
        [contact]\nfriction = 0.3\n{more}"
    );
    parse(&text)
}

/// The result of a scene, with its states in a folder that lives as long.
fn draped(scene: &Scene) -> (ResultFile, tempfile::TempDir) {
    let dir = tempfile::tempdir().unwrap();
    (decided(scene, dir.path()), dir)
}

/// What the table says, and what it does not say.
#[test]
fn the_table_release_says_order_and_dwell() {
    let read = |more: &str| flat(more).layup.release;
    assert_eq!(read(""), None);
    let end = ReleaseOrder::End;
    assert_eq!(read("[release]\n"), Some(Release::new(end, 0.0)));
    assert_eq!(read("[release]\ndwell = \"2 s\"\n"), Some(Release::new(end, 2.0)));
    let first = Release::new(ReleaseOrder::HollowsFirst, 0.5);
    assert_eq!(read("[release]\norder = \"hollows-first\"\ndwell = \"500 ms\"\n"), Some(first));
}

/// The result has the events, its sheet one state more, held before and at rest without pads, and the file reads back to the same
/// bytes.
#[test]
fn a_result_has_the_events_and_the_state_after_the_release() {
    let (result, dir) = draped(&flat("[release]\ndwell = \"2 s\"\n"));
    let end = result.steps.last().unwrap().time;
    let all: Vec<_> = (0..8).map(|n| result.scene.ply.id(n)).collect();
    let event = |time, kind| Event { time, kind, grippers: all.clone() };
    let expected = [
        event(0.0, EventKind::Grip),
        event(end, EventKind::Press),
        event(end + 2.0, EventKind::Release),
    ];
    assert_eq!(result.events(), expected);
    assert_eq!((result.summary.status, result.summary.steps), (Status::Converged, 8));

    let folder = dir.path().join("out");
    write_all(&result, &folder).unwrap();
    let back = read::read(&folder.join("result.json")).unwrap();
    assert_eq!(back.text().unwrap(), result.text().unwrap());
    assert_eq!(back.events(), expected);
    let mut states = back.sheet_states.as_ref().unwrap().open().unwrap();
    let kept: Vec<_> = (0..states.states()).map(|n| states.state(n).unwrap().unwrap()).collect();
    let of: Vec<_> = kept.iter().map(|state| (state.step, state.time)).collect();
    assert_eq!(of.len(), 4);
    assert_eq!(of[2..], [(8, end), (8, end + 2.0)]);
    for (n, state) in kept.iter().enumerate() {
        let holds = state.pad_holds.as_ref().unwrap();
        assert!(holds.iter().all(|holds| *holds == (n < 3)));
        let bears = state.pad_forces.iter().any(|force| *force != [0.0; 3]);
        assert_eq!(bears, n < 3);
    }
}

/// How long the motion takes counts to the release: a limit that the motion alone keeps is exceeded by the dwell, and the result says
/// the time at which its trajectory ends. The last step is measured after the release, and keeps its own time.
#[test]
fn the_duration_of_a_motion_ends_with_the_release() {
    let scene = |limit: &str| {
        flat(&format!("[limits]\nduration = \"{limit}\"\n[release]\ndwell = \"2 s\"\n"))
    };
    let (result, _dir) = draped(&scene("8 s"));
    let end = result.steps.last().unwrap().time;
    assert_eq!(end, 7.0);
    let verdict = |result: &ResultFile| {
        let mut limits = result.summary.limits.iter();
        let found = limits.find(|verdict| verdict.name == Name::Duration).expect("a verdict");
        (found.value, found.ok)
    };
    assert_eq!(verdict(&result), (9.0, false));
    assert!(!result.summary.accepted());
    let summary = &result.summary;
    let both = [&summary.worst, &summary.last].map(|numbers| numbers.value(Name::Duration));
    assert_eq!(both, [Some(9.0); 2]);
    assert_eq!(result.steps.last().unwrap().measures.value(Name::Duration), Some(9.0));
    assert!(csv::trajectory(&result).unwrap().lines().last().unwrap().starts_with("9.0,g3_1,"));
    let back = read::parse(result.text().unwrap().as_bytes(), Path::new("result.json")).unwrap();
    assert_eq!(verdict(&back), (9.0, false));
    let enough = scene("9 s");
    let (kept, _dir) = draped(&enough);
    assert_eq!(verdict(&kept), (9.0, true));
}

/// Without the table nothing says anything of it, and what was draped before the release is the same.
#[test]
fn a_scene_without_a_release_is_draped_as_before() {
    let ((held, _kept), (released, _dir)) = (draped(&flat("")), draped(&flat("[release]\n")));
    assert!(held.events().is_empty());
    let text = held.text().unwrap();
    assert!(!text.contains("\"release\"") && !text.contains("\"events\""));
    assert!(!csv::trajectory(&held).unwrap().contains("vacuum"));
    let [mut a, mut b] =
        [&held, &released].map(|result| result.sheet_states.as_ref().unwrap().open().unwrap());
    assert_eq!((a.states(), b.states()), (3, 4));
    for n in 0..3 {
        let [a, b] = [&mut a, &mut b].map(|states| states.state(n).unwrap().unwrap());
        assert_eq!(a.pad_holds, None);
        assert_eq!((a.positions, a.pad_forces, a.time), (b.positions, b.pad_forces, b.time));
    }
}

/// Events of a gripper that the ply has not, and events out of order, are no result.
#[test]
fn a_result_with_impossible_events_is_refused() {
    let (result, _dir) = draped(&flat("[release]\n"));
    for (change, what) in [
        ((|events| events[1].grippers[0] = [9, 9]) as fn(&mut Vec<Event>), "names gripper [9, 9]"),
        (|events| events.reverse(), "not in the order of time"),
    ] {
        let mut result = result.clone();
        change(&mut result.summary.events);
        let text = result.text().unwrap();
        let fault = read::parse(text.as_bytes(), Path::new("result.json")).unwrap_err();
        assert!(fault.to_string().contains(what), "{fault}");
    }
}
