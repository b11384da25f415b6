//! The commands around a scene, as a new user calls them.

use crate::common::{command, text};
use std::process::{Output, Stdio};

fn plydrape(arguments: &[&str]) -> Output {
    command().args(arguments).output().unwrap()
}

#[test]
fn a_new_scene_passes_the_check_and_is_never_overwritten() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    for (name, file) in [("first", "first/scene.toml"), ("second.toml", "second.toml")] {
        let (name, file) = (path(name), path(file));
        let new = plydrape(&["new", &name]);
        assert_eq!(new.status.code(), Some(0));
        assert!(text(&new.stdout).contains("plydrape check"));

        let check = plydrape(&["check", &file]);
        assert_eq!(check.status.code(), Some(0));
        assert!(text(&check.stdout).contains("4 × 3 grippers"));
        assert!(plydrape(&["check", "--quiet", &file]).stdout.is_empty());

        std::fs::write(&file, "mine").unwrap();
        let again = plydrape(&["new", &name]);
        assert_eq!(again.status.code(), Some(2));
        assert!(text(&again.stderr).contains("it exists"));
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    }
}

#[test]
fn schema_completions_and_manual_go_to_standard_output() {
    let schema = plydrape(&["schema"]).stdout;
    // not printed where it differs: it is long
    assert!(
        schema == include_bytes!("../../../../docs/scene.schema.json"),
        "the schema is another"
    );
    for shell in ["bash", "zsh", "fish"] {
        let completions = plydrape(&["completions", shell]).stdout;
        assert!(text(&completions).contains("check"), "{shell}");
    }
    let manual = text(&plydrape(&["man"]).stdout);
    assert!(manual.contains("a limit of the scene is exceeded"));
}

/// Every figure with a source below it, in the words in which a scene says it: read back, it is the preset's own.
#[test]
fn presets_are_listed_with_a_source_for_each_figure() {
    use plydrape::measure::Preset;
    let listed = text(&plydrape(&["limits"]).stdout);
    assert!(listed.lines().all(|line| line.chars().count() <= 100), "{listed}");
    for preset in Preset::ALL {
        let rest = listed.split_once(&format!("{}: ", preset.name())).unwrap().1;
        let part = rest.split("\n\n").next().unwrap();
        let lines: Vec<&str> = part.lines().collect();
        let figures: Vec<&str> =
            part.lines().filter(|line| line.contains(" = ")).map(str::trim).collect();
        assert_eq!(figures.len(), preset.figures().len(), "{part}");
        for (line, figure) in figures.iter().zip(preset.figures()) {
            let said = line.split('"').nth(1).unwrap();
            let (number, unit) = said.split_once(' ').unwrap();
            let factor = if unit == "mm" { 1e-3 } else { 1_f64.to_radians() };
            let value: f64 = number.parse().unwrap();
            assert!((value * factor / figure.value - 1.0).abs() < 1e-12, "{line}");
            assert!(line.starts_with(figure.name.measure().name()), "{line}");
            let below = lines.iter().position(|other| other.trim() == *line).unwrap() + 1;
            assert!(lines[below].starts_with("    "), "{part}");
        }
    }
}

/// The reader has seen enough: no panic, no message.
#[test]
fn a_closed_pipe_is_no_failure() {
    let mut schema = command();
    schema.arg("schema").stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut child = schema.spawn().unwrap();
    drop(child.stdout.take());
    let output = child.wait_with_output().unwrap();
    assert!(output.stderr.is_empty());
    assert_eq!(output.status.code(), Some(0));
}

#[test]
fn wrong_usage_exits_with_two() {
    for arguments in [&["drape"][..], &["check"], &[]] {
        assert_eq!(plydrape(arguments).status.code(), Some(2));
    }
}
