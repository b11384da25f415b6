//! `plydrape study` hands over to Python; here a script replaces it.
#![cfg(unix)]

use crate::common::{command, one_line, text};
use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};

/// A program in place of Python.
fn python(folder: &Path, script: &str) -> PathBuf {
    let path = folder.join("python");
    fs::write(&path, format!("#!/bin/sh\n{script}\n")).unwrap();
    fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    path
}

fn study(python: &Path, arguments: &[&str]) -> Output {
    command().arg("study").args(arguments).env("PLYDRAPE_PYTHON", python).output().unwrap()
}

#[test]
fn a_missing_package_is_one_message_with_the_remedy() {
    let home = tempfile::tempdir().unwrap();
    let output = study(&python(home.path(), "exit 97"), &["study.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let message = one_line(&output.stderr);
    for part in ["has no package plydrape", "pip install '.[study]'", "PLYDRAPE_PYTHON"] {
        assert!(message.contains(part), "{message}");
    }
    assert!(output.stdout.is_empty());
}

#[test]
fn a_missing_python_is_one_message_with_the_remedy() {
    let output = study(Path::new("/no/such/python"), &["study.toml"]);
    assert_eq!(output.status.code(), Some(2));
    let message = one_line(&output.stderr);
    assert!(message.contains("/no/such/python") && message.contains("install Python"), "{message}");
}

/// All options arrive, a value with a dash and a file with a space as one argument each; the code comes back.
#[test]
fn arguments_go_over_and_the_exit_code_comes_back() {
    let home = tempfile::tempdir().unwrap();
    let shown = "shift 2; for word in \"$@\"; do echo \"<$word>\"; done; exit 130";
    let python = python(home.path(), shown);
    let given =
        ["my study.toml", "--quiet", "--workers", "3", "-o=-out", "--scheduler", "tcp://a:1"];
    let output = study(&python, &given);
    assert_eq!(output.status.code(), Some(130));
    let expected = "<--output=-out>\n<--scheduler=tcp://a:1>\n<--workers=3>\n<--quiet>\n<-->\n<my study.toml>\n";
    assert_eq!(text(&output.stdout), expected);
}

/// A signal ends Python: no code of its own, so it counts as interrupted.
#[test]
fn a_killed_python_is_an_interruption() {
    let home = tempfile::tempdir().unwrap();
    let output = study(&python(home.path(), "kill -9 $$"), &["study.toml"]);
    assert_eq!(output.status.code(), Some(130));
}

#[test]
fn no_workers_are_refused_before_python_starts() {
    let output = study(Path::new("/no/such/python"), &["study.toml", "--workers", "0"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(!text(&output.stderr).contains("/no/such/python"));
}

/// SIGTERM to this process alone reaches Python, whose exit code is passed on.
#[test]
fn a_termination_is_passed_on_to_python() {
    let home = tempfile::tempdir().unwrap();
    let python = python(home.path(), "trap 'exit 130' TERM; while :; do sleep 0.05; done");
    let child = command()
        .args(["study", "study.toml"])
        .env("PLYDRAPE_PYTHON", python)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(std::time::Duration::from_millis(500));
    let kill = std::process::Command::new("kill").args(["-TERM", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    assert_eq!(child.wait_with_output().unwrap().status.code(), Some(130));
}

/// SIGKILL cannot be passed on. A study that went on would keep its folder, and nobody would see it; here a package stands in for the
/// real one.
#[test]
fn a_study_ends_with_the_command_that_was_killed() {
    let home = tempfile::tempdir().unwrap();
    let package = home.path().join("plydrape/study");
    fs::create_dir_all(&package).unwrap();
    let main = "import time\ndef main():\n    print('began', flush=True)\n    time.sleep(10)\n    print('went on')\n";
    for (name, text) in [("../__init__.py", ""), ("__init__.py", ""), ("__main__.py", main)] {
        fs::write(package.join(name), text).unwrap();
    }
    let mut child = command()
        .args(["study", "study.toml"])
        .env("PLYDRAPE_PYTHON", "python3")
        .env("PYTHONPATH", home.path())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut output = BufReader::new(child.stdout.take().unwrap());
    let mut said = String::new();
    output.read_line(&mut said).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    // until Python has ended too
    output.read_to_string(&mut said).unwrap();
    assert_eq!(said, "began\n");
}
