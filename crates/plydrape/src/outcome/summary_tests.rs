//! The verdict of a drape is a function of what its summary holds, and nothing else.

use super::*;
use crate::errors::Errors;
use crate::layup::Model;
use crate::measure::{Name, Numbers, Verdict, Worst};
use crate::scene::World;

/// The height and the error of position (mm) of a drape of this many steps, judged at the end by 0.5 mm and 2 mm.
fn limits(steps: usize, height: f64) -> Vec<Verdict> {
    let worst = Worst { value: height, at: "fabric point (1.0, 2.0) mm".into(), place: None };
    vec![
        Verdict::new(Name::Height, worst.clone(), 0.5, Some(steps)),
        Verdict::new(Name::Position, worst, 2.0, Some(steps)),
    ]
}

/// A converged drape of five steps whose height (mm) is judged.
fn summary(height: f64) -> Summary {
    let numbers: Numbers = [(Name::Height, Some(height))].into_iter().collect();
    Summary {
        model: Model::Sheet,
        world: World::Ideal,
        status: Status::Converged,
        steps: 5,
        steps_planned: 5,
        stopped: None,
        worst: numbers.clone(),
        last: numbers,
        height_rms_mm: Some(0.25),
        height_share: None,
        position_rms_mm: None,
        limits: limits(5, height),
        events: Vec::new(),
        sheet: None,
        catenaries: None,
        sample: None,
        tolerance: None,
        rate_tolerance: None,
        tool: None,
    }
}

/// A drape with steps between those of the other one, whose height (mm) is judged.
fn between(height: f64) -> Judged {
    let limits = limits(9, height);
    Judged { limits, complete: true, missing: 0.0, unsolved: 0, interrupted: false, effort: None }
}

/// A sample of which enough cells are accepted, or not.
fn sample(ok: bool) -> SampleVerdict {
    let errors = Errors { samples: 1, ..Errors::default() };
    let cell = CellVerdict { accepted: ok, height_mm: Some(0.5), ratio: 0.75 };
    let (limits, cells) = (limits(5, 0.375), vec![cell]);
    let confidence = errors.confidence(usize::from(ok), 1, ok);
    SampleVerdict {
        errors,
        needed: 1,
        ok,
        confidence,
        limits,
        cells,
        highest: None,
        spread_mm: vec![0.5],
    }
}

/// A drape is accepted if it was done to its end, keeps every limit, and so do the cells of its sample; one that is broken is enough.
#[test]
fn one_thing_that_is_broken_is_enough_to_refuse_a_drape() {
    assert!(summary(0.4).accepted());
    assert!(Summary { sample: Some(sample(true)), ..summary(0.4) }.accepted());
    for status in [Status::NotAtRest, Status::NotSolved, Status::Torn, Status::Interrupted] {
        let ended = Summary { status, ..summary(0.4) };
        assert!(!ended.accepted() && !ended.accepted_without_errors(), "{status:?}");
        assert_eq!(ended.interrupted(), status == Status::Interrupted);
    }
    let high = summary(0.6);
    assert!(!high.accepted() && !high.accepted_without_errors());
    let failed = Summary { sample: Some(sample(false)), ..summary(0.4) };
    assert!(!failed.accepted() && failed.accepted_without_errors());
}

/// What is refused with steps between the steps is not accepted, by that limit alone; what it measured stays.
#[test]
fn a_drape_that_depends_on_its_steps_is_refused_by_the_limit_that_it_breaks() {
    let mut refused = summary(0.4);
    refused.judge_between(&between(0.7));
    assert!(!refused.accepted() && refused.worst == summary(0.4).worst);
    let [height, position] = &refused.limits[..] else { panic!("two limits") };
    assert!(!height.ok && height.value == 0.7 && height.step == Some(5));
    assert!(height.at.ends_with("mm, with steps half-way between all steps"), "{}", height.at);
    assert!(position.ok && position.value == 0.4);

    let mut moves = summary(0.4);
    moves.judge_between(&Judged { complete: false, ..between(0.4) });
    assert!(!moves.accepted() && moves.status == Status::NotAtRest);

    let mut kept = summary(0.4);
    kept.judge_between(&between(0.45));
    assert_eq!(kept, summary(0.4));
}

/// Of a limit that a drape is judged by already, the worse verdict counts.
#[test]
fn a_second_verdict_counts_where_it_is_the_worse() {
    let judged = |height: f64, again: f64| {
        let mut summary = summary(height);
        summary.judge_also(limits(5, again));
        assert_eq!(summary.limits.len(), 2);
        summary.accepted()
    };
    assert!(judged(0.3, 0.4) && !judged(0.3, 0.6) && !judged(0.6, 0.3));
}

#[cfg(feature = "serde")]
/// A file begins with the verdict, for whoever looks into it; what it says comes back as it was.
#[test]
fn a_summary_survives_json_with_its_verdict_in_front() {
    let report = CatenaryReport { first_contact_step: Some(3), ..CatenaryReport::default() };
    let full = Summary {
        model: Model::Catenaries,
        catenaries: Some(report),
        sample: Some(sample(true)),
        world: World::Errors,
        stopped: Some("it tore".into()),
        ..summary(0.4)
    };
    for summary in [summary(0.4), summary(0.6), full] {
        let text = serde_json::to_string(&summary).unwrap();
        let front = format!("{{\"accepted\":{},\"world\":", summary.accepted());
        assert!(text.starts_with(&front), "{text}");
        assert_eq!(serde_json::from_str::<Summary>(&text).unwrap(), summary);
    }
}

#[cfg(feature = "serde")]
/// Nobody can write into a file that a drape is accepted which breaks a limit, nor that one is not which keeps them all.
#[test]
fn a_verdict_that_contradicts_its_limits_is_refused() {
    for (height, says, follows) in [(0.6, "true", "not accepted"), (0.4, "false", "accepted")] {
        let text = serde_json::to_string(&summary(height)).unwrap();
        let own = format!("\"accepted\":{}", height < 0.5);
        let forged = text.replacen(&own, &format!("\"accepted\":{says}"), 1);
        assert_ne!(forged, text);
        let refused = serde_json::from_str::<Summary>(&forged).unwrap_err().to_string();
        let expected = format!("`accepted` is {says}, and by its limits the drape is {follows}");
        assert!(refused.contains(&expected), "{refused}");
        // without a verdict it is no summary of this version
        let without = text.replacen(&format!("{own},"), "", 1);
        assert!(serde_json::from_str::<Summary>(&without).is_err());
    }
}
