//! What the command does where nothing can be written, and what it shows of names and texts.

use crate::common::{command, example, one_line, text};
use std::fs::File;
use std::process::{Command, Output, Stdio};

fn full() -> Stdio {
    File::options().write(true).open("/dev/full").unwrap().into()
}

/// Results are not lost with standard output: the message says where they are, and the exit code is its own.
#[cfg(target_os = "linux")]
#[test]
fn standard_output_that_is_full_is_exit_four_with_the_files_that_are_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("drape");
    let run = |more: &[&str]| {
        let mut command = command();
        command.arg("simulate").arg(example("02_hanging_strip")).arg("-o").arg(&out).args(more);
        command.stdout(full()).output().unwrap()
    };
    for more in [&[][..], &["--json"]] {
        let output = run(more);
        assert_eq!(output.status.code(), Some(4), "{}", text(&output.stderr));
        let message = one_line(&output.stderr);
        assert!(message.contains("standard output cannot be written"), "{message}");
        assert!(message.contains("are written and complete: result.json"), "{message}");
        assert!(message.replace(' ', "").contains(&out.display().to_string()), "{message}");
        assert!(out.join("report.html").exists());
    }
    assert_eq!(run(&["--quiet"]).status.code(), Some(0));
    let result = out.join("result.json");
    let output = command().arg("report").arg(&result).stdout(full()).output().unwrap();
    assert_eq!(output.status.code(), Some(4));
    assert!(one_line(&output.stderr).contains("is written and complete"));
    for arguments in [&["schema"][..], &["man"], &["completions", "bash"]] {
        let output = command().args(arguments).stdout(full()).output().unwrap();
        assert_eq!(output.status.code(), Some(4), "{arguments:?}");
        assert!(one_line(&output.stderr).contains("no file was written"));
    }
}

/// The exit code stands, whatever becomes of the message.
#[cfg(target_os = "linux")]
#[test]
fn standard_error_that_is_full_is_no_panic() {
    let output = command().args(["check", "no_such_file.toml"]).stderr(full()).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    // a warning, which `check` prints on standard error, is no fault
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    let written = std::fs::read_to_string(example("02_hanging_strip")).unwrap();
    std::fs::write(
        &scene,
        written
            .replace("\"krogh2018\"", "{ mass = \"1000 kg/m\", flexural_rigidity = \"1 N m^2\" }"),
    )
    .unwrap();
    let check = |stderr| command().arg("check").arg(&scene).stderr(stderr).output().unwrap();
    let shown = check(Stdio::piped());
    assert!(text(&shown.stderr).contains("warning"), "{}", text(&shown.stderr));
    assert_eq!(check(full()).status.code(), Some(0));
}

/// A disk without room leaves nothing that the next `new` would refuse.
#[cfg(unix)]
#[test]
fn a_scene_that_cannot_be_written_whole_is_not_there_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let new = |limit: &str| -> Output {
        let script = format!("{limit} exec \"$0\" new one.toml");
        Command::new("sh")
            .args(["-c", &script, env!("CARGO_BIN_EXE_plydrape")])
            .current_dir(folder.path())
            .output()
            .unwrap()
    };
    let output = new("trap '' XFSZ; ulimit -f 0;");
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stderr));
    assert!(one_line(&output.stderr).contains("`one.toml` cannot be written"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    assert_eq!(new("").status.code(), Some(0));
    let again = new("");
    assert_eq!(again.status.code(), Some(2));
    assert!(one_line(&again.stderr).contains("it exists"));
}

/// A terminal is never sent what a file or its name says to it.
#[cfg(unix)]
#[test]
fn no_escape_sequence_reaches_the_terminal() {
    let folder = tempfile::tempdir().unwrap();
    let plain = |output: &Output| {
        for bytes in [&output.stdout, &output.stderr] {
            assert!(!text(bytes).chars().any(|c| c.is_control() && c != '\n'), "{}", text(bytes));
        }
    };
    let scene = folder.path().join("a\u{1b}[31mred\nline.toml");
    let run = |arguments: &[&str]| {
        command().args(arguments).arg(&scene).current_dir(folder.path()).output().unwrap()
    };
    let missing = run(&["check"]);
    plain(&missing);
    assert!(one_line(&missing.stderr).contains("\\u{1b}[31mred"));
    let written = std::fs::read_to_string(example("02_hanging_strip")).unwrap();
    let untitled: String =
        written.lines().filter(|l| !l.starts_with("title")).map(|l| l.to_owned() + "\n").collect();
    std::fs::write(&scene, &untitled).unwrap();
    let checked = run(&["check"]);
    assert_eq!(checked.status.code(), Some(0), "{}", text(&checked.stderr));
    assert!(text(&checked.stdout).contains("a\\u{1b}[31mred\\nline"), "{}", text(&checked.stdout));
    plain(&checked);
    plain(&run(&["simulate"]));
    // a raw escape in the text, in the line that the message shows
    std::fs::write(
        &scene,
        untitled.replace("material = \"krogh2018\"", "material = \"\u{1b}[31m\u{9b}31m\""),
    )
    .unwrap();
    let refused = run(&["check"]);
    assert_eq!(refused.status.code(), Some(2));
    plain(&refused);
}

/// Neither a pipe nor a device is read, by any command.
#[cfg(unix)]
#[test]
fn pipes_and_devices_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("plan.json");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    let refused = |arguments: &[&str]| {
        let output = command().args(arguments).current_dir(folder.path()).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let message = one_line(&output.stderr);
        assert!(message.contains("not a regular file"), "{message}");
    };
    refused(&["check", "plan.json"]);
    refused(&["net", "plan.json"]);
    refused(&["report", "plan.json"]);
    refused(&["report", "/dev/zero"]);
    refused(&["export", "--to", "csv", "plan.json"]);
    let scene = example("01_flat_sheared_mold");
    refused(&["plan", scene.to_str().unwrap(), "--continue", "."]);
}

/// A budget that is set is kept, and one that is no size is refused.
#[test]
fn the_memory_that_is_allowed_can_be_set() {
    let scene = example("01_flat_sheared_mold");
    let check = |memory: &str| {
        let output =
            command().env("PLYDRAPE_MEMORY", memory).arg("check").arg(&scene).output().unwrap();
        (output.status.code(), one_line(&output.stderr))
    };
    assert_eq!(check("16 GB").0, Some(0));
    let (code, message) = check("1 MB");
    assert_eq!(code, Some(2));
    assert!(
        message.contains("1.0 MB are allowed") && message.contains("PLYDRAPE_MEMORY"),
        "{message}"
    );
    let (code, message) = check("much");
    assert_eq!(code, Some(2));
    assert!(message.contains("\"much\", which is no size"), "{message}");
}
