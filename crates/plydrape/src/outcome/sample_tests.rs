//! What samples must agree with: counts, the plain drape.

use super::*;
use crate::errors::tests::layup;
use crate::errors::{Draw, Errors, Term};
use crate::geometry::rotation::oriented;
use crate::layup::{Layup, Target};
use crate::measure::{Limits, Name, Verdict};
use crate::mold::{Mold, Plane};
use crate::outcome::turning::{Turning, Turns};
use crate::scene::Scene;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

pub(super) const NEVER: Watch<'static> = Watch { stop: &|| false, done: &|_, _| {} };

/// Four grippers by the catenaries that hold a ply in the air, without errors.
pub(super) fn lines() -> Scene {
    let Layup { ply, settings, motion, .. } = layup(2, 2);
    Scene::new(ply, settings, motion)
}

/// A coarse sheet in place of these catenaries, which comes down on a plane.
pub(super) fn sheet() -> Scene {
    let mut scene = lines();
    scene.layup.settings.model = Model::Sheet;
    scene.layup.settings.sheet.mesh = Some(0.04);
    let (point, normal) = ([0.0, 0.0, 0.09], [0.0, 0.0, 1.0]);
    scene.layup.mold = Some(Mold::Plane(Plane { point, normal }));
    scene
}

/// Errors of the grippers' positions along each axis (m).
fn of_grippers(samples: usize, bound: f64) -> Errors {
    let mut errors = Errors { samples, seed: 3, ..Errors::default() };
    errors.gripper.position = Term::Bound(bound);
    errors
}

/// The scene of one cell.
pub(super) fn cell(scene: &Scene, draw: Draw) -> Scene {
    Scene { layup: draw.apply(&scene.layup), ..scene.clone() }
}

/// The verdicts of a scene without errors.
pub(super) fn plain(scene: &Scene) -> Judged {
    judge(&scene.layup, &scene.limits, usize::MAX, &|| false).expect("a model")
}

/// 95 % of 64 are 60.8; of 20 they are 19, though 0.95 × 20 may be rounded up; of none it is none, of few at least one.
#[test]
fn so_many_cells_are_needed_as_the_share_says() {
    let needed = |share: f64, samples: usize| Errors { share, ..Errors::default() }.needed(samples);
    assert_eq!(
        [needed(0.95, 64), needed(0.95, 20), needed(1.0, 7), needed(0.95, 0), needed(0.01, 3)],
        [61, 19, 7, 0, 1]
    );
    for (percent, samples) in (1..=100).flat_map(|p| (1..=100).map(move |n| (p, n))) {
        let whole = usize::div_ceil(percent * samples, 100);
        assert_eq!(needed(percent as f64 / 100.0, samples), whole, "{percent} % of {samples}");
    }
}

/// Errors with a sample of this many cells, of which a share must keep the limits.
fn counted(samples: usize, share: f64) -> Errors {
    Errors { samples, share, ..Errors::default() }
}

/// Every row of up to ten cells that do or do not keep the limits: it is decided by as few cells as leave one verdict for whatever
/// comes after them, which is that of the whole sample, or by a run without a failure that has a chance of 5 % or less, multiplied out.
#[test]
fn a_sample_ends_with_the_first_cell_that_decides() {
    for share in [1e-9, 0.05, 0.3, 0.5, 0.75, 0.9, 1.0] {
        for (samples, row) in (1..=10).flat_map(|n| (0..1_u32 << n).map(move |row| (n, row))) {
            let needed = (share * samples as f64).ceil() as usize;
            let kept = |cells: usize| (row & ((1 << cells) - 1)).count_ones() as usize;
            let chance = |cells: usize| (0..cells).fold(1.0, |chance, _| chance * share);
            let expected = |cells: usize| {
                let (worst, best) = (kept(cells), kept(cells) + samples - cells);
                let sure = kept(cells) == cells && chance(cells) < 0.05 + 1e-12;
                (worst >= needed || best < needed || sure).then_some(best >= needed)
            };
            let errors = counted(samples, share);
            for cells in 0..=samples {
                let decided = errors.decided(kept(cells), cells);
                assert_eq!(decided, expected(cells), "{row:b}: {cells} of {samples}, {share}");
            }
            assert!(errors.decided(kept(samples), samples).is_some());
        }
    }
}

/// Of 64 cells of which 95 % must keep the limits 59 without a failure are enough, because 0.95^58 = 5.1 % and 0.95^59 = 4.9 %; with one
/// it takes 61 that do, and four failures are too many. That all cells do is shown by none but the last.
#[test]
fn fifty_nine_cells_without_a_failure_are_enough() {
    let errors = Errors::default();
    assert_eq!([58, 59].map(|cells| errors.decided(cells, cells)), [None, Some(true)]);
    assert_eq!([60, 61].map(|kept| errors.decided(kept, kept + 1)), [None, Some(true)]);
    assert_eq!([3, 4].map(|failed| errors.decided(8, 8 + failed)), [None, Some(false)]);
    assert_eq!([63, 64].map(|n| counted(64, 1.0).decided(n, n)), [None, Some(true)]);
    assert_eq!([28, 29].map(|n| counted(64, 0.9).decided(n, n)), [None, Some(true)]);
    assert_eq!(counted(1, 1e-300).decided(1, 1), Some(true));
}

/// The confidence is one minus the chance of a count at least as good, or at least as bad, summed over all rows of twelve cells; that of 59
/// of 59 is 1 − 0.95^59, and 61 of 64 say little. No count shows that all cells keep the limits, and one that fails shows that not all do.
#[test]
fn a_confidence_is_one_minus_the_chance_of_such_a_count() {
    for share in [0.05_f64, 0.6, 0.95] {
        for kept in 0..=12 {
            let chance = |rows: &dyn Fn(u32) -> bool| {
                let rows = (0..1_u32 << 12).map(u32::count_ones).filter(|count| rows(*count));
                let chances =
                    rows.map(|n| share.powi(n as i32) * (1.0 - share).powi(12 - n as i32));
                chances.sum::<f64>()
            };
            let errors = counted(12, share);
            let said = |ok: bool| errors.confidence(kept as usize, 12, ok);
            let exact = [chance(&|n| n >= kept), chance(&|n| n <= kept)].map(|chance| 1.0 - chance);
            assert!((said(true) - exact[0]).abs() < 1e-12, "{kept} {share}: {}", said(true));
            assert!((said(false) - exact[1]).abs() < 1e-12, "{kept} {share}: {}", said(false));
        }
    }
    let errors = Errors::default();
    assert!((errors.confidence(59, 59, true) - (1.0 - 0.95_f64.powi(59))).abs() < 1e-12);
    assert!((errors.confidence(61, 64, true) - 0.40).abs() < 0.005);
    assert!((errors.confidence(8, 12, false) - 0.998).abs() < 0.0005);
    let all = counted(64, 1.0);
    assert_eq!([all.confidence(64, 64, true), all.confidence(3, 4, false)], [0.0, 1.0]);
}

/// A limit is judged by a cell of so high a rank that as many or more keep every limit where the sample is accepted, and fewer do where
/// it is refused: of a limit that decides alone the value agrees with the verdict.
#[test]
fn the_value_that_is_judged_agrees_with_the_verdict() {
    for (samples, percent) in (1..=80).flat_map(|n| (1..=100).map(move |percent| (n, percent))) {
        let errors = counted(samples, f64::from(percent) / 100.0);
        for (cells, kept) in (1..=samples).flat_map(|n| (0..=n).map(move |kept| (n, kept))) {
            if let Some(ok) = errors.decided(kept, cells) {
                let rank = errors.needed(cells);
                assert_eq!(ok, rank <= kept, "{kept} of {cells}, {samples}, {percent} %");
            }
        }
    }
}

/// A tool frame that is shifted along x leaves a box where it is shifted farther than the box is wide. The sample ends as the shifts say,
/// with the drapes of its cells and with the same verdict by any number of threads; by one, no cell is begun after the last.
#[test]
fn no_cell_counts_after_the_one_that_decides() {
    // the box ends at a margin from the gripper that is farthest along x
    let mut errors = Errors { seed: 5, ..Errors::default() };
    errors.frame.position = Term::Deviation(1e-3);
    let mut scene = lines();
    let places = scene.layup.motion.positions.iter().flatten();
    let right = places.map(|place| place[0]).fold(f64::MIN, f64::max);
    let mut ends = Vec::new();
    for margin in [-0.9, 0.5e-3, 1.5e-3, 0.9] {
        scene.limits.workspace = Some([[-1.0, right + margin], [-1.0, 1.0], [-1.0, 1.0]]);
        // the sample, and how many cells were draped for it
        let drawn = |threads: usize| {
            let done = AtomicUsize::new(0);
            let count = |_: usize, of: usize| {
                assert_eq!(of, 64);
                done.fetch_add(1, Ordering::Relaxed);
            };
            let watch = Watch { stop: &|| false, done: &count };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let sample = pool.install(|| errors.judge(&scene, &watch)).unwrap();
            (sample, done.load(Ordering::Relaxed))
        };

        // one thread drapes only the cells that count, and more threads find the same sample
        let (one, done) = drawn(1);
        assert_eq!(done, one.cells.len());
        for threads in [2, 5] {
            assert_eq!(one, drawn(threads).0);
        }

        // by the shifts: which cells stay in the box, and after how many the verdict is clear
        let kept: Vec<bool> = (0..64).map(|n| errors.draw(n, 4).frame.shift[0] <= margin).collect();
        let failed = |cells: usize| kept[..cells].iter().filter(|kept| !**kept).count();
        let last = |cells: &usize| {
            failed(*cells) == 4 || cells - failed(*cells) == 61 || (*cells == 59 && failed(59) == 0)
        };
        let last = (1..=64).find(last).unwrap();

        // the sample agrees in its cells, its verdict and its confidence
        let cells: Vec<bool> = one.cells.iter().map(|cell| cell.accepted).collect();
        assert_eq!(cells, kept[..last], "{margin}");
        assert_eq!((one.ok, one.needed), (failed(last) < 4, 61));
        assert_eq!(one.confidence, errors.confidence(last - failed(last), last, one.ok));
        assert_eq!(one.limits.iter().all(|limit| limit.ok), one.ok);
        ends.push(last);
    }

    // all cells fail, all keep the box, and between these the larger margin takes more cells
    assert!(ends[0] == 4 && ends[3] == 59 && ends[1] > 4 && ends[2] > ends[1], "{ends:?}");
}

/// Cells are drawn and draped one by one, whichever thread does it: the same verdict, to the last bit, by both models.
#[test]
fn a_sample_does_not_depend_on_threads() {
    for scene in [lines(), sheet()] {
        let drawn = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| of_grippers(5, 5e-4).judge(&scene, &NEVER)).unwrap()
        };
        let one = drawn(1);
        assert_eq!(one, drawn(3));
        let ratio = |n: usize| one.cells[n].ratio;
        assert!((1..5).any(|n| ratio(n) != ratio(0)), "{:?}", one.cells);
    }
}

/// Cells without errors are the scene: all of them are accepted or none, with the limits of the plain drape.
#[test]
fn without_errors_every_cell_is_the_plain_drape() {
    let kept = lines();
    let mut broken = lines();
    broken.limits.set(Name::Tilt, Some(1e-6));
    for (scene, accepted) in [(kept, 3), (broken, 0)] {
        let sample = Errors { samples: 3, ..Errors::default() }.judge(&scene, &NEVER).unwrap();
        let judged = plain(&scene);
        assert_eq!(judged.accepted(), accepted == 3, "{:?}", judged.limits);
        assert_eq!((sample.accepted(), sample.ok), (accepted, accepted == 3));
        assert_eq!(sample.cells.len(), accepted.max(1));
        let timeless = sample.limits.iter().filter(|limit| limit.name != Name::TiltRate);
        assert!(timeless.eq(&judged.limits), "{:?}", sample.limits);
        let ratio = judged.limits.iter().map(Verdict::ratio).fold(0.0, f64::max);
        assert!(sample.cells.iter().all(|cell| cell.ratio == ratio && cell.height_mm.is_none()));
        assert!(sample.highest.is_none() && sample.spread_mm.is_empty());
    }
}

/// The limit of the tilt rate leaves a motion nothing without errors, so cells with errors refuse it in its time. A sample without that limit
/// says how much slower it must be: then no cell refuses it, with the verdict that is given, and a motion that is hardly quicker is refused.
#[test]
fn a_motion_is_as_slow_as_the_cell_that_turns_fastest_asks() {
    let errors = of_grippers(8, 1e-3);
    let mut scene = lines();
    let turning = |sample: &SampleVerdict| {
        let found = sample.limits.iter().find(|limit| limit.name == Name::TiltRate);
        found.expect("grippers tilt").value
    };
    let plain = Errors { samples: 8, ..Errors::default() }.judge(&scene, &NEVER).unwrap();
    scene.limits.set(Name::TiltRate, Some(turning(&plain).to_radians()));
    assert!(!errors.judge(&scene, &NEVER).unwrap().ok);

    let timeless = errors.judge_timeless(&scene, &NEVER).unwrap();
    let slower = timeless.fastest(&scene.layup, &scene.limits);
    assert!(timeless.ok() && slower > 1.01, "{slower}");
    let slowed = |slower: f64| {
        let mut scene = scene.clone();
        scene.layup.motion.times.iter_mut().for_each(|time| *time *= slower);
        scene
    };
    let in_time = slowed(slower);
    assert_eq!(timeless.fastest(&in_time.layup, &in_time.limits), 1.0);
    let again = errors.judge(&in_time, &NEVER).unwrap();
    assert_eq!(again.accepted(), 8);
    assert_eq!(timeless.in_time(&in_time.layup, &in_time.limits), again);
    assert!(errors.judge(&slowed(0.998 * slower), &NEVER).unwrap().accepted() < 8);
}

/// Of two drapes that turn in different steps, the most of both is known; a step that one of them has not seen counts by the other.
#[test]
fn the_most_of_some_drapes_is_the_most_of_each_step() {
    let scene = lines();
    let state = |step: usize, tilt: f64| {
        let mut state = crate::measure::sample::state(&scene.layup);
        let (s, c) = tilt.sin_cos();
        state.step = step;
        state.grippers[1].quaternion = oriented([s, 0.0, c], [c, 0.0, -s]);
        state
    };
    let drape = |tilts: &[(usize, f64)]| {
        let mut turning = Turning::default();
        tilts.iter().for_each(|(step, tilt)| turning.see(&state(*step, *tilt)));
        turning
    };
    let drapes = [drape(&[(1, 0.0), (2, 0.1), (3, 0.12)]), drape(&[(2, 0.0), (3, 0.3), (4, 0.2)])];
    let turns = Turns::most(&drapes);
    for (step, turn) in [(1, 0.1), (2, 0.3), (3, 0.1), (4, 0.0)] {
        assert!((turns.of(step, 1) - turn).abs() < 1e-12, "{step}: {turns:?}");
    }
    assert!((1..4).all(|step| turns.of(step, 0).abs() < 1e-12 && turns.of(step, 99) == 0.0));
}

/// The value of a limit is kept by the share of the cells that were draped, here seven, and no better one is.
#[test]
fn the_value_of_a_limit_is_kept_by_the_share() {
    let (scene, errors) = (lines(), Errors { share: 0.7, ..of_grippers(10, 1e-3) });
    let sample = errors.judge(&scene, &NEVER).unwrap();
    let (grippers, rank) = (scene.layup.ply.grippers(), errors.needed(sample.cells.len()));
    let cells: Vec<Judged> =
        (0..sample.cells.len()).map(|n| plain(&cell(&scene, errors.draw(n, grippers)))).collect();
    let timeless = sample.limits.iter().filter(|limit| limit.name != Name::TiltRate);
    assert!(timeless.clone().count() > 0);
    for limit in timeless {
        let ratio = |cell: &Judged| {
            let verdict = cell.limits.iter().find(|verdict| verdict.name == limit.name);
            verdict.map_or(f64::INFINITY, Verdict::ratio)
        };
        let as_good = cells.iter().filter(|cell| ratio(cell) <= limit.ratio()).count();
        let better = cells.iter().filter(|cell| ratio(cell) < limit.ratio()).count();
        assert!(as_good >= rank && better < rank, "{limit:?}: {as_good} {better}");
    }
}

/// The share of the cells keeps the height of the sample, and at no node is the sheet higher than that in this many cells.
#[test]
fn the_heights_of_a_sample_are_kept_by_the_share() {
    let scene = sheet();
    let errors = Errors { share: 0.6, ..of_grippers(5, 2e-3) };
    let sample = errors.judge(&scene, &NEVER).unwrap();
    let height = sample.height_mm().unwrap();
    let heights: Vec<f64> = sample.cells.iter().filter_map(|cell| cell.height_mm).collect();
    let rank = errors.needed(heights.len());
    assert_eq!(heights.len(), sample.cells.len());
    assert_eq!(heights.iter().filter(|other| **other <= height).count(), rank);
    let highest = sample.highest.as_ref().unwrap();
    let most = sample.spread_mm.iter().copied().fold(0.0, f64::max);
    assert!(most > 0.0 && (most / highest.height_mm - 1.0).abs() < 1e-3, "{most} {highest:?}");
    assert!(highest.height_mm <= height * (1.0 + 1e-12));
    // four grippers: whichever is nearest, it is on the line
    assert!(highest.line.contains(&highest.gripper), "{highest:?}");
}

/// Who breaks a sample off does not know whether enough of its cells are accepted; a drape that is not accepted without
/// errors tolerates none, and no cell is draped to find that.
#[test]
fn nothing_is_accepted_that_was_not_draped() {
    let mut scene = lines();
    let go = |_: usize| ControlFlow::Continue(());
    let mut summary = simulate(&scene, go).expect("catenaries").drape.summary;
    assert!(summary.accepted(), "{:?}", summary.limits);

    let plain = Robustness::of_simulated(&scene);
    assert!(
        plain.judge_sample(&mut summary, &NEVER) && plain.judge_tolerance(&mut summary, &NEVER)
    );
    assert!(summary.accepted() && summary.sample.is_none() && summary.tolerance.is_none());
    assert_eq!(summary.verdict(), "accepted in an ideal cell, without errors");

    scene.errors = Some(of_grippers(4, 1e-5));
    let with_errors = Robustness::of_simulated(&scene);
    assert!(with_errors.judge_sample(&mut summary, &NEVER));
    assert!(summary.accepted() && summary.sample.as_ref().is_some_and(|sample| sample.ok));
    assert_eq!(summary.verdict(), "accepted");
    let stop = Watch { stop: &|| true, done: &|_, _| {} };
    assert!(!with_errors.judge_tolerance(&mut summary, &stop) && summary.accepted());
    // what was judged is not judged again
    assert!(with_errors.judge_sample(&mut summary, &stop) && summary.accepted());
    let mut broken_off = Summary { sample: None, ..summary.clone() };
    assert!(!with_errors.judge_sample(&mut broken_off, &stop));
    assert!(!broken_off.accepted() && broken_off.sample.is_none() && broken_off.interrupted());

    scene.errors = Some(of_grippers(0, 1e-5));
    let off = Robustness::of_planned(&scene, scene.layup.motion.clone());
    assert!(off.judge_tolerance(&mut summary, &NEVER) && summary.tolerance.is_none());

    scene.errors = None;
    let planned = Robustness::of_planned(&scene, scene.layup.motion.clone());
    assert!(planned.sampled().is_none());
    assert!(planned.judge_tolerance(&mut summary, &NEVER));
    assert!(summary.tolerance.is_some_and(|tolerance| tolerance.tried > 0));
    scene.limits.set(Name::Tilt, Some(1e-6));
    let mut refused = simulate(&scene, go).expect("catenaries").drape.summary;
    assert!(planned.judge_tolerance(&mut refused, &stop));
    assert_eq!(refused.tolerance, Some(Tolerance::NOTHING));
}

/// The sensitivity of an accepted drape is the range of its height and of those of the four draws, found here one by one; it may be as
/// large as what is left to the limit of the height. Of a refused drape nothing is asked.
#[test]
fn sensitivity_is_the_range_of_heights_by_minute_changes() {
    // a target where the motion ends, and no limit but that of the height
    let mut scene = sheet();
    let last = scene.layup.motion.positions.last().expect("steps").clone();
    scene.layup.target = Some(Target { grippers: last, drape: None });
    scene.limits = Limits::usual(&scene.layup);
    for name in Name::ALL {
        scene.limits.set(*name, None);
    }
    // the sensitivity and the height of a drape, by a bound on the height
    let sensitivity = |bound: f64| {
        let limited =
            Scene { limits: scene.limits.clone().with(Name::Height, bound), ..scene.clone() };
        let summary = simulate(&limited, |_| ControlFlow::Continue(())).unwrap().drape.summary;
        let verdict = |name: Name| summary.limits.iter().find(|v| v.name == name).cloned();
        (verdict(Name::Sensitivity), verdict(Name::Height).expect("a target").value)
    };
    let (found, own) = sensitivity(1.0);
    let found = found.expect("an accepted sheet");

    // the height with the changes of one draw
    let changes = minute_changes(&scene.layup);
    assert_eq!(
        changes.gripper.position,
        Term::Deviation(1e-5 * crate::sheet::pitch(&scene.layup.ply))
    );
    let height = |n: usize| {
        let changed = cell(&scene, changes.draw(n, scene.layup.ply.grippers()));
        let limits = scene.limits.clone().with(Name::Height, 1.0);
        let judged = judge(&changed.layup, &limits, usize::MAX, &|| false).expect("a sheet");
        judged.limits.iter().find(|v| v.name == Name::Height).expect("a target").value
    };

    // the sensitivity is the range of all heights; its limit is what the highest leaves of the bound
    let heights: Vec<f64> = (0..4).map(height).chain([own]).collect();
    let highest = heights.iter().copied().fold(0.0, f64::max);
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(highest > lowest && (found.value - (highest - lowest)).abs() < 1e-12, "{found:?}");
    assert!((found.limit - (1e3 - highest)).abs() < 1e-9, "{found:?}");

    // half the height as the bound: the drape is refused
    let (refused, _) = sensitivity(0.5e-3 * own);
    assert_eq!(refused, None);
}
