//! Every scene under `plydrape-io/tests/it/broken` is refused with exit code 2, and its message, as a user
//! sees it on a terminal of 80 columns without color, is in the snapshot: read it aloud.

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
    let folder = refusal(Path::new("tables"));
    assert!(folder.contains("`tables` is a folder, not a file"), "{folder}");
    assert!(folder.contains("give the .toml file of a scene"), "{folder}");
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

/// A value of more bytes than are shown is cut between characters, however many bytes each of these has and wherever the value begins.
#[test]
fn a_long_value_is_cut_between_characters() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("long.toml");
    for letter in ["é", "€", "𝄞"] {
        for before in ["", "a", "ab", "abc"] {
            let value = letter.repeat(150);
            std::fs::write(&file, format!("[ply]\ngrippers = \"{before}{value}\"\n")).unwrap();
            let output = check(&file);
            let message = String::from_utf8(output.stderr).unwrap();
            assert_eq!(output.status.code(), Some(2), "{before}{letter}: {message}");
            assert!(message.contains("is a text") && message.len() < 3000, "{message}");
        }
    }
}

/// Runs the command in a folder, and gives its exit code, what it prints and its messages on one line.
fn run(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_plydrape"))
        .args(arguments)
        .current_dir(folder)
        .env("NO_COLOR", "1")
        .env("LC_ALL", "C.UTF-8")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    // lines are broken anywhere, behind a bar on the left
    let message = text(output.stderr).replace('│', " ");
    let message = message.split_whitespace().collect::<Vec<_>>().join(" ");
    (output.status.code(), text(output.stdout), message)
}

/// A folder with one of each file that is taken for a scene or a result.
fn desk() -> tempfile::TempDir {
    let desk = tempfile::tempdir().unwrap();
    let mut binary = vec![0; 84 + 50];
    binary[80] = 1;
    let files: [(&str, &[u8]); 12] = [
        ("binary.stl", &binary),
        ("text.stl", b"solid x\nfacet normal 0 0 1\nouter loop\n"),
        ("mold.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ("part.step", b"ISO-10303-21;\nHEADER;\n"),
        ("start.csv", b"i,j,x,y,z\n0,0,0,0,0\n"),
        ("photo.png", b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"),
        ("ply.dxf", b"  0\nSECTION\n  2\nHEADER\n"),
        ("wide.toml", b"\xff\xfe[\0p\0l\0y\0]\0\x00\xd8"),
        ("zeros.toml", b"[ply]\ncell = \0\0\0\n"),
        ("empty.json", b""),
        ("other.json", b"{\"a\": 1}"),
        (
            "old.json",
            b"{\"format\":\"plydrape-result\",\"version\":1,\"program\":\"plydrape 0.0.1\"}",
        ),
    ];
    for (name, bytes) in files {
        std::fs::write(desk.path().join(name), bytes).unwrap();
    }
    desk
}

#[test]
fn another_file_given_as_a_scene_is_called_by_its_name() {
    let desk = desk();
    for (file, name, remedy) in [
        ("binary.stl", "a mesh (STL)", "kind = \"mesh\", file = \"binary.stl\""),
        ("text.stl", "a mesh (STL)", "file = \"text.stl\", unit = \"mm\""),
        ("mold.obj", "a mesh (OBJ)", "file = \"mold.obj\""),
        ("part.step", "a CAD model (STEP)", "as an STL or OBJ file"),
        ("start.csv", "a table (CSV)", "as `positions` in [grippers]"),
        ("photo.png", "a picture", "`plydrape new NAME`"),
        ("ply.dxf", "a drawing (DXF)", "[ply] outline = \"ply.dxf\""),
        ("old.json", "a result of plydrape", "`plydrape report old.json`"),
    ] {
        let (code, printed, message) = run(desk.path(), &["check", file]);
        assert_eq!((code, printed.as_str()), (Some(2), ""), "{file}");
        assert!(message.contains(&format!("`{file}` is {name}, not a scene")), "{message}");
        assert!(message.contains(remedy), "{message}");
        assert!(!message.contains("TOML:"), "{message}");
    }
    let (_, _, message) = run(desk.path(), &["check", "wide.toml"]);
    assert!(message.contains("`wide.toml` is UTF-16 text, and damaged"), "{message}");
    let (_, _, message) = run(desk.path(), &["check", "zeros.toml"]);
    assert!(message.contains("byte 13 is a NUL byte"), "{message}");
}

#[test]
fn a_name_that_is_nearly_right_is_answered_with_the_right_one() {
    let desk = desk();
    assert_eq!(run(desk.path(), &["new", "part"]).0, Some(0));
    let (_, _, message) = run(desk.path(), &["check", "part/scene.tml"]);
    assert!(message.contains("did you mean `part/scene.toml`?"), "{message}");
    let (_, _, message) = run(desk.path(), &["plan", "part"]);
    assert!(message.contains("`part` is a folder, not a file"), "{message}");
    assert!(message.contains("did you mean `part/scene.toml`?"), "{message}");
    let (_, _, message) = run(desk.path(), &["report", "othr.json"]);
    assert!(message.contains("did you mean `other.json`?"), "{message}");
}

#[test]
fn another_file_given_as_a_result_is_called_by_its_name() {
    let desk = desk();
    assert_eq!(run(desk.path(), &["new", "part"]).0, Some(0));
    for (file, said) in [
        ("part/scene.toml", "is a scene or another TOML file, not a result of plydrape"),
        ("text.stl", "is a mesh (STL), not a result of plydrape"),
        ("empty.json", "is empty, not a result of plydrape"),
        ("other.json", "is not a result of plydrape: it has no `format`"),
        ("part", "`part` is a folder without a result.json help: give the result.json"),
    ] {
        for command in [&["export", file, "--to", "vtk"][..], &["report", file]] {
            let (code, printed, message) = run(desk.path(), command);
            assert_eq!((code, printed.as_str()), (Some(2), ""), "{file}");
            assert!(message.contains(said), "{message}");
            assert!(message.contains("give the result.json of `plydrape simulate`"), "{message}");
        }
    }
}

/// The folder of a run says which scene it was made from, and how.
#[test]
fn a_result_of_an_old_version_says_how_to_make_it_anew() {
    let desk = desk();
    let old = std::fs::read(desk.path().join("old.json")).unwrap();
    for (folder, scene, command) in [
        ("a.plan", Some("a.toml"), "run `plydrape plan a.toml` again with this version"),
        ("b.results", None, "run `plydrape simulate` again with its scene with this version"),
        ("c", None, "run `plydrape simulate` or `plydrape plan` again with this version"),
    ] {
        let folder = desk.path().join(folder);
        std::fs::create_dir(&folder).unwrap();
        std::fs::write(folder.join("result.json"), &old).unwrap();
        if let Some(scene) = scene {
            std::fs::write(desk.path().join(scene), "").unwrap();
        }
        let name = folder.file_name().unwrap().to_str().unwrap();
        // the folder stands for the result in it
        let (code, _, message) = run(desk.path(), &["report", name]);
        assert_eq!(code, Some(2));
        assert!(message.contains("written by plydrape 0.0.1"), "{message}");
        assert!(message.contains(command), "{message}");
    }
}

/// The help of a message tells what to do, and neither repeats the message nor itself.
#[test]
fn nothing_is_said_twice() {
    let snapshot = include_str!(
        "snapshots/it__broken_scenes__every_broken_scene_is_refused_with_place_and_remedy.snap"
    );
    let mut seen = 0;
    for block in snapshot.split("\n\n") {
        let Some((message, help)) = block.split_once("\n  help: ") else { continue };
        let words =
            |text: &str| text.replace('│', " ").split_whitespace().collect::<Vec<_>>().join(" ");
        let (message, help) = (words(message), words(help));
        seen += 1;
        let mut parts: Vec<&str> = help.split(['?', ';', ':']).map(str::trim).collect();
        parts.retain(|part| part.split(' ').count() > 3);
        for (n, part) in parts.iter().enumerate() {
            assert!(!message.contains(part), "{message}\n{help}");
            assert!(!parts[..n].contains(part), "{help}");
        }
    }
    assert!(seen >= 200, "{seen}");
}
