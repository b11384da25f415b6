//! The commands around a scene, as a new user calls them.

use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

fn plydrape(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plydrape"))
        .args(arguments)
        .env("NO_COLOR", "1")
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// A folder of this test's own, gone at the end.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let folder = std::env::temp_dir().join(format!("plydrape-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        Folder(folder)
    }

    fn file(&self, name: &str) -> String {
        self.0.join(name).to_str().unwrap().to_string()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn a_new_scene_passes_the_check_and_is_never_overwritten() {
    let folder = Folder::new("new");
    for (name, file) in [("first", "first/scene.toml"), ("second.toml", "second.toml")] {
        let (name, file) = (folder.file(name), folder.file(file));
        let new = plydrape(&["new", &name]);
        assert_eq!(new.status.code(), Some(0));
        assert!(String::from_utf8(new.stdout).unwrap().contains("plydrape check"));

        let check = plydrape(&["check", &file]);
        assert_eq!(check.status.code(), Some(0));
        assert!(String::from_utf8(check.stdout).unwrap().contains("4 × 3 grippers"));
        assert!(plydrape(&["check", "--quiet", &file]).stdout.is_empty());

        std::fs::write(&file, "mine").unwrap();
        let again = plydrape(&["new", &name]);
        assert_eq!(again.status.code(), Some(2));
        assert!(String::from_utf8(again.stderr).unwrap().contains("it exists"));
        assert_eq!(std::fs::read_to_string(&file).unwrap(), "mine");
    }
}

#[test]
fn schema_completions_and_manual_go_to_standard_output() {
    let schema = plydrape(&["schema"]).stdout;
    assert_eq!(schema, include_bytes!("../../../../docs/scene.schema.json"));
    for shell in ["bash", "zsh", "fish"] {
        let text = plydrape(&["completions", shell]).stdout;
        assert!(String::from_utf8(text).unwrap().contains("check"), "{shell}");
    }
    let manual = String::from_utf8(plydrape(&["man"]).stdout).unwrap();
    assert!(manual.contains("a limit of the scene is exceeded"));
}

/// The reader has seen enough: no panic, no message.
#[test]
fn a_closed_pipe_is_no_failure() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_plydrape"))
        .arg("schema")
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
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
