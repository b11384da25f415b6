use super::*;
use crate::sample;
use plydrape::layup::Friction;
use plydrape::material::TensionLaw;
use plydrape::measure::{Name, Verdict, Worst};
use plydrape::outcome::{CatenaryReport, CellVerdict, Tolerance};
use plydrape::scene::World;

fn read(text: &str) -> Result<ResultFile, Error> {
    parse(text.as_bytes(), Path::new("result.json"))
}

fn is_changed(error: &Error) -> bool {
    error.to_string().contains("was changed since plydrape wrote it")
}

/// Every one of some changes of a result is refused, even where the check sum was made anew.
fn assert_refused<const N: usize>(
    whole: impl Fn() -> ResultFile,
    changes: [fn(&mut ResultFile); N],
) {
    for (n, change) in changes.into_iter().enumerate() {
        let mut result = whole();
        change(&mut result);
        let refused = read(&result.text().unwrap()).unwrap_err();
        assert!(is_changed(&refused), "{n}: {refused}");
    }
}

fn written() -> String {
    ResultFile::text(&sample::draped(3, 2, 3)).unwrap()
}

/// What is read is what was written, to the last bit: written again it is the same text.
#[test]
fn a_result_that_is_read_writes_the_same_text() {
    let text = written();
    assert_eq!(ResultFile::text(&read(&text).unwrap()).unwrap(), text);
}

/// A file that was copied in part is distinguished from one that was never a result.
#[test]
fn a_cut_text_is_truncated_wherever_it_was_cut() {
    let text = written();
    for share in [0.01, 0.1, 0.5, 0.9, 0.999] {
        let end = (text.len() as f64 * share) as usize;
        let end = (end..).find(|n| text.is_char_boundary(*n)).unwrap();
        let refused = read(&text[..end]).unwrap_err();
        assert!(refused.to_string().contains("it was cut short"), "{share}: {refused}");
    }
}

/// A result says which states belong to it, and looks for them in its folder; one without a sheet names none.
#[test]
fn a_result_names_the_states_of_its_sheet() {
    assert!(read(&written()).unwrap().sheet_states.is_none());
    let result = sample::sheet(3, 2, 3);
    let states = read(&ResultFile::text(&result).unwrap()).unwrap().sheet_states.unwrap();
    assert_eq!(states.seal(), result.sheet_states.unwrap().seal());
    assert!(matches!(states.open(), Err(Error::Io { .. })));
}

/// An outcome of a sheet belongs to states and to steps that the result has, and has nothing of catenaries.
#[test]
fn the_outcome_of_a_sheet_fits_its_result() {
    let whole = || sample::sheet(3, 2, 3);
    assert!(read(&whole().text().unwrap()).is_ok());
    let changes: [fn(&mut ResultFile); 9] = [
        |r| r.summary.sheet = None,
        |r| r.sheet_states = None,
        |r| r.summary.steps = 4,
        |r| r.summary.steps = 2,
        |r| r.summary.sheet.as_mut().unwrap().nodes = 0,
        |r| r.summary.sheet.as_mut().unwrap().first_contact_step = Some(4),
        |r| r.summary.catenaries = Some(CatenaryReport::default()),
        |r| r.steps[1].catenaries = sample::draped(3, 2, 3).steps[1].catenaries.clone(),
        |r| r.scene.settings.model = Model::Catenaries,
    ];
    assert_refused(whole, changes);
}

/// The model beside is the other one, has steps of its own and was judged with no errors; what is read of it is what was written.
#[test]
fn the_drape_beside_is_of_the_other_model() {
    let both = || {
        let also = Some(sample::also(sample::draped(3, 2, 3)));
        ResultFile { also, ..sample::sheet(3, 2, 3) }
    };
    let text = both().text().unwrap();
    let found = read(&text).unwrap();
    assert_eq!(found.text().unwrap(), text);
    let also = found.also.unwrap();
    assert_eq!(also.summary.model, Model::Catenaries);
    assert_eq!(also.steps, sample::draped(3, 2, 3).steps);

    let changes: [fn(&mut ResultFile); 6] = [
        |r| r.also = Some(sample::also(sample::sheet(3, 2, 3))),
        |r| r.also.as_mut().unwrap().steps.truncate(2),
        |r| r.also.as_mut().unwrap().steps[1].catenaries = None,
        |r| r.also.as_mut().unwrap().steps[1].grippers.truncate(1),
        |r| r.also.as_mut().unwrap().summary.sample = Some(sample::sample_verdict()),
        |r| r.also.as_mut().unwrap().summary.limits = r.summary.limits.clone(),
    ];
    assert_refused(both, changes);
}

/// Whether a result is accepted follows from its verdicts: a file that says otherwise is refused.
#[test]
fn an_acceptance_that_its_limits_contradict_is_refused() {
    let text = written();
    let with_sum = |text: &str| {
        let start = text.rfind("\"crc32:").unwrap() + 1;
        let mut sum = crc32fast::Hasher::new();
        sum.update(&text.as_bytes()[..start - 1]);
        format!("{}{}\"}}\n", &text[..start], shown(sum))
    };
    assert_eq!(with_sum(&text), text);
    let forged = with_sum(&text.replacen("\"accepted\":true", "\"accepted\":false", 1));
    let refused = read(&forged).unwrap_err();
    assert!(is_changed(&refused), "{refused}");
    assert!(refused.to_string().contains("`accepted` is false"), "{refused}");
}

/// Nor do the words of its limits count: each holds by its value, against the limit of its scene, in every step, and none is left out.
#[test]
fn a_limit_is_kept_by_its_values_and_not_by_its_word() {
    let tilt = |value| Some(Worst { value, at: "gripper g0_0".into(), place: None });
    let exceeded = |r: &mut ResultFile| r.steps[1].measures.set(Name::Tilt, tilt(57.0));
    let forge = |n: usize, r: &mut ResultFile| match n {
        0 => r.summary.limits[0].value = 57.0,
        1 => (r.summary.limits[0].value, r.summary.limits[0].limit) = (57.0, 90.0),
        2 => exceeded(r),
        _ => {
            exceeded(r);
            r.summary.limits.clear();
        }
    };
    let reasons = [
        "is kept, which is 57 against 40",
        "that of its scene 40",
        "which a step has at 57 against 40",
        "its tilt is not judged",
    ];
    for (n, why) in reasons.into_iter().enumerate() {
        let mut result = sample::draped(3, 2, 3);
        forge(n, &mut result);
        assert!(result.summary.accepted());
        let refused = read(&result.text().unwrap()).unwrap_err();
        assert!(is_changed(&refused) && refused.to_string().contains(why), "{refused}");
    }
    // one that is kept at its limit, and one that is not kept whatever its value
    for (value, ok) in [(40.0, true), (12.0, false)] {
        let mut result = sample::draped(3, 2, 3);
        (result.summary.limits[0].value, result.summary.limits[0].ok) = (value, ok);
        assert_eq!(read(&result.text().unwrap()).unwrap().summary.accepted(), ok);
    }
}

/// A forged check sum does not help a material whose tension is no table, nor settings that no scene has.
#[test]
fn settings_of_the_sheet_must_be_those_of_a_scene() {
    let changes: [fn(&mut ResultFile); 3] = [
        |r| {
            let (strain, force) = (vec![0.0, 0.1], vec![0.0]);
            r.scene.ply.material.tension = Some(TensionLaw::Table { strain, force });
        },
        |r| r.scene.settings.sheet.mesh = Some(-0.01),
        |r| r.scene.settings.contact.friction = Friction::Coulomb(-0.3),
    ];
    assert_refused(|| sample::draped(3, 2, 3), changes);
}

/// No digit can be changed unseen; the file stays valid JSON all along.
#[test]
fn every_digit_stands_in_the_check_sum() {
    let text = written();
    // another version is refused before
    let version = text.find("\"version\":").unwrap() + 10..text.find("\"program\":").unwrap();
    let digits: Vec<usize> = (text.char_indices())
        .filter(|(n, c)| c.is_ascii_digit() && *n > 0 && !version.contains(n))
        .map(|(n, _)| n)
        .collect();
    for n in digits.iter().step_by(53) {
        let other = if &text[*n..=*n] == "7" { "8" } else { "7" };
        let edited = [&text[..*n], other, &text[n + 1..]].concat();
        assert!(is_changed(&read(&edited).unwrap_err()), "{}", &text[n - 9..n + 9]);
    }
}

/// White space at the end, as an editor leaves it, is no change; a key more is one.
#[test]
fn only_white_space_at_the_end_may_change() {
    let text = written();
    assert!(read(text.trim_end()).is_ok());
    assert!(read(&format!("{text}\r\n")).is_ok());
    let more = text.replacen("{\"format\"", "{\"note\":1,\"format\"", 1);
    assert!(is_changed(&read(&more).unwrap_err()));
    let without = text.replacen("\"checksum\":\"crc32:", "\"checksum\":\"crc32:0", 1);
    assert!(is_changed(&read(&without).unwrap_err()));
}

/// A forged check sum does not help a result that lacks a gripper, a cell or its grid.
#[test]
fn a_result_must_have_all_of_its_ply() {
    let changes: [fn(&mut ResultFile); 4] = [
        |r| r.steps[1].grippers.truncate(1),
        |r| r.steps[0].catenaries.as_mut().unwrap().cells.truncate(1),
        |r| sample::lines(r, 2).truncate(1),
        |r| r.scene.ply.grid.nu = 0,
    ];
    assert_refused(|| sample::draped(3, 2, 3), changes);
}

/// The version decides before anything else does: a later file may hold keys that are unknown today.
#[test]
fn other_versions_are_named() {
    let text = written();
    let other = |version: u32| {
        text.replacen(
            &format!("\"version\":{VERSION}"),
            &format!("\"version\":{version},\"new\":0"),
            1,
        )
    };
    let refused = read(&other(VERSION + 1)).unwrap_err();
    let says = format!("in version {} of the format", VERSION + 1);
    assert!(
        refused.to_string().contains(&says) && refused.help().starts_with("update"),
        "{refused}"
    );
    let refused = read(&other(VERSION - 1)).unwrap_err();
    assert!(refused.help().ends_with("with this version"), "{refused}");
}

/// A key of the file may be as long as it likes; the message is not, and has its place.
#[test]
fn a_long_key_is_not_repeated_whole() {
    let key = "k".repeat(30_000);
    let text = written().replacen("\"program\"", &format!("\"{key}\":0,\"program\""), 1);
    let refused = read(&text).unwrap_err().to_string();
    assert!(refused.len() < 1000 && refused.contains("at line 1 column"), "{refused}");
}

/// A plan that is interrupted has limits of its whole motion: those of steps that were not draped name none.
#[test]
fn an_interrupted_plan_is_read() {
    let mut result = sample::draped(3, 2, 3);
    result.summary.steps_planned = 5;
    let limit = result.summary.limits[0].clone();
    let judged = [(Name::Speed, 3), (Name::Jerk, 5)];
    let judged = judged.map(|(name, step)| Verdict { name, step: Some(step), ..limit.clone() });
    result.summary.judge_also(judged);
    let read = read(&result.text().unwrap()).unwrap();
    let steps: Vec<_> = read.summary.limits[1..].iter().map(|v| v.step).collect();
    assert_eq!(steps, [Some(3), None]);
}

/// JSON of another program, a list, text, bytes, nothing: none is a result.
#[test]
fn what_others_wrote_is_foreign() {
    for text in [
        "{\"format\":\"gltf\",\"version\":4}",
        "[1,2]",
        "3",
        "t (s),x\n0,1\n",
        "",
        "{}",
        "{\"version\":\"a\"}",
    ] {
        let refused = read(text).unwrap_err();
        assert!(refused.to_string().contains("not a result of plydrape"), "{text:?}: {refused}");
    }
    let refused = parse(&[0xff, 0xfe, 0x00], Path::new("x")).unwrap_err();
    assert!(refused.to_string().contains("not a result of plydrape"), "{refused}");
    assert!(matches!(super::read(Path::new("no/such.json")), Err(Error::Io { .. })));
}

/// Makes the cells of a sample keep the limits or not, with the confidence of their count.
fn with_cells(result: &mut ResultFile, kept: &[bool], ok: bool) {
    let sample = result.summary.sample.as_mut().unwrap();
    sample.ok = ok;
    sample.cells = kept
        .iter()
        .map(|kept| CellVerdict { accepted: *kept, height_mm: None, ratio: 1.0 })
        .collect();
    sample.confidence = sample.errors.confidence(sample.accepted(), kept.len(), ok);
}

/// What drapes with errors say of a sheet of nine nodes is read as it was written; what contradicts itself, the scene or the
/// sheet is refused even where the check sum was made anew.
#[test]
fn the_sample_of_a_result_fits_its_scene() {
    let whole = || {
        let mut result = sample::sheet(3, 2, 3);
        let verdict = sample::sample_verdict();
        result.scene.errors = Some(verdict.errors);
        let tolerance =
            Tolerance { gripper_mm: 0.5, shear: Some([0.2, 8.0]), tried: 4, ..Tolerance::NOTHING };
        (result.summary.sample, result.summary.tolerance) = (Some(verdict), Some(tolerance));
        result.summary.world = World::Errors;
        result
    };
    let (written, found) = (whole().summary, read(&whole().text().unwrap()).unwrap().summary);
    assert_eq!((found.sample, found.tolerance), (written.sample, written.tolerance));

    // three of four cells must keep the limits: it ends where they do, or where two have failed
    for (kept, ok) in [(&[true, true, true][..], true), (&[true, false, false], false)] {
        let mut ended = whole();
        with_cells(&mut ended, kept, ok);
        assert!(read(&ResultFile::text(&ended).unwrap()).is_ok());
    }

    let changes: [fn(&mut ResultFile); 14] = [
        |r| r.summary.world = World::Ideal,
        |r| r.scene.errors = None,
        |r| r.summary.sample.as_mut().unwrap().ok = true,
        |r| r.summary.sample.as_mut().unwrap().needed = 2,
        |r| r.summary.sample.as_mut().unwrap().confidence = 0.9,
        // not decided by its last cell, decided before it, more cells than the scene has, none
        |r| with_cells(r, &[true, false, true], false),
        |r| with_cells(r, &[true, false, false, true], false),
        |r| with_cells(r, &[true, false, true, true, true], true),
        |r| with_cells(r, &[], false),
        |r| r.summary.sample.as_mut().unwrap().spread_mm.truncate(8),
        |r| r.summary.tolerance.as_mut().unwrap().gripper_mm = -0.5,
        |r| r.summary.tolerance.as_mut().unwrap().mass = [1.0, 0.5],
        |r| r.summary.tolerance.as_mut().unwrap().shear = Some([0.0, 2.0]),
        |r| {
            let limits = &mut r.summary.sample.as_mut().unwrap().limits;
            limits.extend(r.summary.limits.first().cloned());
            limits[0].step = Some(4);
        },
    ];
    assert_refused(whole, changes);
}
