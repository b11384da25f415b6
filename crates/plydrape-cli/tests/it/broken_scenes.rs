//! Every scene under `plydrape-io/tests/it/broken` is refused with exit code 2, and its message, as a user
//! sees it on a terminal of 80 columns without colour, stands in the snapshot: read it aloud.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../plydrape-io/tests/it/broken")
}

fn check(scene: &Path) -> Output {
    Command::new(env!("CARGO_BIN_EXE_plydrape"))
        .arg("check")
        .arg(scene)
        .current_dir(folder())
        .env("NO_COLOR", "1")
        .env_remove("FORCE_COLOR")
        .env_remove("NO_GRAPHICS")
        .env("LC_ALL", "C.UTF-8")
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

/// The message of a refused scene.
fn refusal(scene: &Path) -> String {
    let output = check(scene);
    assert_eq!(output.status.code(), Some(2), "{}", scene.display());
    assert!(output.stdout.is_empty(), "{}", scene.display());
    let text = String::from_utf8(output.stderr).unwrap();
    // Where the repository lies differs from machine to machine.
    let here = std::path::absolute(folder()).unwrap();
    text.replace(here.to_str().unwrap(), "FOLDER")
}

#[test]
fn every_broken_scene_is_refused_with_place_and_remedy() {
    let mut scenes: Vec<PathBuf> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.is_file() && path.extension().is_some_and(|e| e == "toml"))
        .collect();
    scenes.sort();
    assert!(scenes.len() >= 200, "{}", scenes.len());

    let mut messages = String::new();
    for scene in scenes {
        let name = Path::new(scene.file_name().unwrap());
        let message = refusal(name);
        assert!(message.contains("help:"), "{message}");
        writeln!(messages, "{}\n{message}", name.display()).unwrap();
    }
    insta::assert_snapshot!(messages);
}

#[test]
fn a_folder_and_a_missing_file_are_refused() {
    assert!(refusal(Path::new("tables")).contains("`tables` is a folder, not a file"));
    assert!(refusal(Path::new("nowhere.toml")).contains("there is no such file"));
}

#[test]
fn a_huge_file_is_refused_before_it_is_read_whole() {
    let file = std::env::temp_dir().join(format!("plydrape-huge-{}.toml", std::process::id()));
    std::fs::write(&file, vec![b'#'; (16 << 20) + 1]).unwrap();
    let message = refusal(&file);
    std::fs::remove_file(&file).unwrap();
    // The path's length is the machine's: it may break the line anywhere.
    let words: Vec<&str> = message.split_whitespace().collect();
    assert!(words.join(" ").contains("larger than 16 MiB"), "{message}");
}

/// A fault far out in a long line is shown with its surroundings, not with the whole line.
#[test]
fn a_long_line_is_cut_around_the_fault() {
    let file = std::env::temp_dir().join(format!("plydrape-long-{}.toml", std::process::id()));
    let row = vec!["[0, 0, 0]"; 5000].join(", ");
    let text = format!(
        "[ply]\ngrippers = [5001, 1]\n[grippers]\npositions = [[{row}, [0, \"µµ 1 kg\", 0]]]\n"
    );
    std::fs::write(&file, text).unwrap();
    let output = check(&file);
    let with_ply = std::fs::read_to_string(&file).unwrap().replace(
        "grippers = [5001, 1]",
        "grippers = [2, 1]\ncell = [1, 1, \"µ\"]\nmaterial = \"krogh2018\"",
    );
    std::fs::write(&file, with_ply.replace('\n', " \n")).unwrap();
    let second = check(&file);
    std::fs::remove_file(&file).unwrap();
    for output in [output, second] {
        assert_eq!(output.status.code(), Some(2));
        assert!(output.stderr.len() < 2000, "{}", output.stderr.len());
    }
}
