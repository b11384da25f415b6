//! Limits in the currency of an engineer: slack as a fiber angle and as the height of a wrinkle, and presets of limits.

use crate::common::{drape, example, parse};
use plydrape::measure::{Limits, Name, Preset, Verdict};
use plydrape::scene::Scene;
use plydrape_io::result::ResultFile;

/// The paper's example with what is given in `[limits]`.
fn scene(limits: &str) -> Scene {
    let text = include_str!("../../../../examples/01_flat_sheared_mold/scene.toml");
    let text = format!("{text}\n[limits]\n{limits}\n");
    parse(&text)
}

fn judged(result: &ResultFile, name: Name) -> Option<&Verdict> {
    result.summary.limits.iter().find(|verdict| verdict.name == name)
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found / expected - 1.0).abs() < tolerance, "{found} {expected}");
}

/// Straight paths leave slack in single edges of 100 mm; its angle is 2√ε of the slack ratio, its height 1.3256 l^(3/7) s^(4/7) of the
/// slack in millimeters. Without a limit there is no verdict; with one it is that of the end alone, though there is more slack before.
#[test]
fn slack_as_an_angle_and_as_a_height_has_verdicts_of_its_own() {
    let mut scene = example("01_flat_sheared_mold");
    let plain = drape(&scene);
    assert!(judged(&plain, Name::SlackAngle).is_none() && judged(&plain, Name::Wrinkle).is_none());

    let last = |name: Name| plain.summary.last.value(name).expect("measured");
    let angle = 2.0 * last(Name::SlackRatio).sqrt().to_degrees();
    let length = (9e-6 / (0.3143 * 9.8_f64)).cbrt();
    let slack = last(Name::Slack) * 1e-3;
    let height = 1e3 * 1.3256 * length.powf(3.0 / 7.0) * slack.powf(4.0 / 7.0);
    for (factor, ok) in [(1.01, true), (0.99, false)] {
        scene.limits.set(Name::SlackAngle, Some(factor * angle.to_radians()));
        scene.limits.set(Name::Wrinkle, Some(factor * 1e-3 * height));
        let result = drape(&scene);
        for (name, value, unit) in [(Name::SlackAngle, angle, "°"), (Name::Wrinkle, height, "mm")]
        {
            let found = judged(&result, name).expect("a limit is set");
            near(found.value, value, 1e-4);
            near(found.limit, factor * value, 1e-12);
            assert_eq!((found.ok, found.unit.as_ref(), found.step), (ok, unit, Some(30)));
        }
        let worst = |name: Name| result.summary.worst.value(name).expect("measured");
        assert!(worst(Name::Wrinkle) > 1.3 * height && worst(Name::SlackAngle) > 1.3 * angle);
    }
}

/// 3° are a slack of (3°)²/4 = 0.0685 %. The default of 0.05 % gives way to it, a slack ratio of the scene does not.
#[test]
fn a_slack_angle_takes_the_place_of_the_default_slack_ratio() {
    let three = 3_f64.to_radians();
    let limits = scene("slack_angle = \"3 deg\"").limits;
    near(limits.most(Name::SlackRatio), 0.25 * three * three, 1e-12);
    near(limits.most(Name::SlackAngle), three, 1e-12);
    let limits = scene("slack_angle = \"3 deg\"\nslack_ratio = \"0.02 %\"").limits;
    near(limits.most(Name::SlackRatio), 2e-4, 1e-12);
    let limits = scene("wrinkle = \"0.3 mm\"").limits;
    assert_eq!([Name::SlackRatio, Name::SlackAngle].map(|n| limits.get(n)), [Some(5e-4), None]);
    near(limits.most(Name::Wrinkle), 3e-4, 1e-12);
}

/// By its name, with the figures that it lists, each the limit of its own measure; all others as without it.
#[test]
fn a_preset_sets_its_figures_and_no_other_limit() {
    let usual = scene("").limits;
    assert_eq!(usual.preset, None);
    for preset in Preset::ALL {
        let scene = scene(&format!("preset = \"{}\"", preset.name()));
        assert_eq!(scene.limits.preset, Some(*preset));
        for figure in preset.figures() {
            let unit = match figure.name.measure().unit().recorded {
                "mm" => 1e-3,
                "deg" => 1_f64.to_radians(),
                other => panic!("{other}"),
            };
            let limit = figure.name.limit(&scene.layup, &scene.limits).expect("a limit");
            near(limit, figure.value / unit, 1e-12);
            assert!(!figure.source.is_empty());
        }
        for name in Name::ALL.iter().filter(|name| preset.value(**name).is_none()) {
            // the slack ratio of a slack angle is the same limit in another unit
            if *name != Name::SlackRatio || preset.value(Name::SlackAngle).is_none() {
                let limit = |limits: &Limits| name.limit(&scene.layup, limits);
                assert_eq!(limit(&scene.limits), limit(&usual), "{preset:?} {name:?}");
            }
        }
    }
}

/// Keys of the scene override its preset, whichever is written first.
#[test]
fn single_keys_stand_over_a_preset() {
    for text in
        ["preset = \"drapebot\"\nposition = \"1 mm\"", "position = \"1 mm\"\npreset = \"drapebot\""]
    {
        let limits = scene(text).limits;
        near(limits.most(Name::Position), 1e-3, 1e-12);
        near(limits.most(Name::FiberAngle), 3_f64.to_radians(), 1e-12);
    }
    let limits: Limits = scene("preset = \"ply-angle\"\nslack_angle = \"2 deg\"").limits;
    near(limits.most(Name::SlackRatio), 0.25 * 2_f64.to_radians().powi(2), 1e-12);
    let limits = scene("preset = \"ply-angle\"\nslack_ratio = \"1 %\"").limits;
    near(limits.most(Name::SlackRatio), 0.01, 1e-12);
    near(limits.most(Name::SlackAngle), 3_f64.to_radians(), 1e-12);
}

/// A result keeps its limits and its preset.
#[test]
fn a_result_that_is_read_back_has_its_preset_and_its_limits_of_slack() {
    let mut scene = scene("preset = \"low-wrinkle\"\nslack_angle = \"3 deg\"");
    scene.layup.motion.times.truncate(2);
    scene.layup.motion.positions.truncate(2);
    let result = drape(&scene);
    let dir = tempfile::tempdir().expect("a folder");
    plydrape_io::write_all(&result, dir.path()).expect("written");
    let back = plydrape_io::result::read::read(&dir.path().join("result.json")).expect("read");
    assert_eq!(back.scene.limits, scene.limits);
    assert_eq!(back.scene.limits.preset, Some(Preset::LowWrinkle));
}
