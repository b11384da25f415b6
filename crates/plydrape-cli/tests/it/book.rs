//! `plydrape plan` and `plydrape check` of a plybook, and what other commands say of one.

use crate::common::{command, files, one_line, text};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Output;

/// Two plies that overlap and one beside them, quickly planned: catenaries, few steps.
const BOOK: &str = "\
title = \"Part\"

[model]
kind = \"catenaries\"

[mold]
kind = \"plane\"

[ply]
material = \"krogh2018\"
thickness = \"0.3 mm\"
grippers = [2, 2]
cell = [\"100 mm\", \"100 mm\"]

[grippers]
spacing = [\"98 mm\", \"98 mm\"]
height = \"75 mm\"
origin = \"centered\"

[target]
seed = \"middle\"

[plan]
steps = 12
evaluations = 2

[[plies]]
name = \"base\"

[[plies]]
name = \"beside\"
target = { origin = [\"400 mm\", 0] }

[[plies]]
name = \"on <base>\"
target = { origin = [\"50 mm\", 0] }
";

fn book(folder: &Path, text: &str) -> PathBuf {
    let book = folder.join("plies.toml");
    std::fs::write(&book, text).unwrap();
    book
}

fn plan(book: &Path, flags: &[&str]) -> Output {
    command().arg("plan").arg(book).args(flags).output().unwrap()
}

/// Every file of a folder and of the folders in it, hidden ones left out.
fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    for name in files(folder) {
        let path = folder.join(&name);
        if path.is_dir() {
            let inner = contents(&path);
            found.extend(inner.into_iter().map(|(file, bytes)| (format!("{name}/{file}"), bytes)));
        } else {
            found.insert(name, std::fs::read(path).unwrap());
        }
    }
    found
}

#[test]
fn a_book_has_a_folder_for_each_ply_and_one_report_over_all() {
    let folder = tempfile::tempdir().unwrap();
    let output = plan(&book(folder.path(), BOOK), &["--without-errors"]);
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    let results = folder.path().join("plies.plan");
    let plies = ["01_base", "02_beside", "03_on__base_"];
    assert_eq!(files(&results), [&plies[..], &["book.json", "report.html"]].concat());
    for ply in plies {
        let names = files(&results.join(ply));
        assert!(names.contains(&"result.json".into()) && names.contains(&"motion.csv".into()));
    }

    let read = |name: &str| std::fs::read_to_string(results.join(name)).unwrap();
    let json: Value = serde_json::from_str(&read("book.json")).unwrap();
    assert_eq!((&json["format"], &json["version"]), (&"plydrape-book".into(), &1.into()));
    let listed = json["plies"].as_array().unwrap();
    let lies_on: Vec<&Value> = listed.iter().map(|ply| &ply["lies_on"]).collect();
    assert_eq!(lies_on, [&Value::from(vec![0; 0]), &vec![0; 0].into(), &vec![1].into()]);
    let all = listed.iter().all(|ply| ply["accepted"] == true);
    assert_eq!(json["accepted"], all);
    assert_eq!(output.status.code(), Some(if all { 0 } else { 1 }));

    let report = read("report.html");
    for ply in plies {
        assert_eq!(report.matches(&format!("href=\"{ply}/report.html\"")).count(), 1);
    }
    assert!(report.contains("on &lt;base&gt;") && !report.contains("on <base>"));
    assert_eq!(report.matches("<svg class=\"one\"").count(), 3);
    assert!(!report.contains("http") && !report.contains("NaN"), "a page without a network");
    let shown = text(&output.stdout);
    for name in ["base", "beside", "on <base>"] {
        assert!(shown.contains(name), "{shown}");
    }

    // the ply's own result says what it lies on, and is read back with it
    let result = results.join("03_on__base_/result.json");
    let scene: Value = serde_json::from_str(&std::fs::read_to_string(&result).unwrap()).unwrap();
    assert_eq!(scene["scene"]["mold"]["kind"], "layered");
    assert_eq!(scene["scene"]["mold"]["layers"][0]["thickness"], 0.3e-3);
    let output = command()
        .args(["export", "--to", "vtk", "-o"])
        .arg(folder.path().join("vtk"))
        .arg(&result)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
}

/// A ply's plan depends on no other plan, and on no number of threads: all files but the times are the same bytes.
#[test]
#[ignore = "long; plans of one ply are compared over threads; scripts/soak runs it"]
fn results_do_not_depend_on_the_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let path = book(folder.path(), BOOK);
    let run = |threads: &str| {
        let out = folder.path().join(threads);
        let flags =
            ["--threads", threads, "--quiet", "--without-errors", "-o", out.to_str().unwrap()];
        let output = plan(&path, &flags);
        assert!(output.stdout.is_empty() && output.stderr.is_empty());
        contents(&out)
    };
    let (one, four) = (run("1"), run("4"));
    assert_eq!(one.keys().collect::<Vec<_>>(), four.keys().collect::<Vec<_>>());
    for (name, bytes) in &one {
        assert!(bytes == &four[name], "{name}");
    }
}

/// A file of someone else in the last ply's folder: nothing of any ply is written.
#[test]
fn a_book_is_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = book(folder.path(), BOOK);
    let foreign = folder.path().join("plies.plan/03_on__base_");
    std::fs::create_dir_all(&foreign).unwrap();
    std::fs::write(foreign.join("steps.csv"), "mine").unwrap();
    let output = plan(&path, &["--without-errors"]);
    assert_eq!(output.status.code(), Some(2));
    let said = one_line(&output.stderr);
    assert!(said.contains("ply on <base>") && said.contains("steps.csv"), "{said}");
    assert_eq!(contents(&folder.path().join("plies.plan")).len(), 1, "only the file in the way");
}

/// Every ply goes on from its own folder, and is planned anew where it has none there.
#[test]
fn a_book_goes_on_from_the_folder_of_an_earlier_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = book(folder.path(), BOOK);
    let out = folder.path().join("plies.plan");
    let go_on = ["--without-errors", "--quiet", "--time", "1ms", "--continue"];
    let quick = &go_on[..4];
    assert!(plan(&path, quick).stderr.is_empty());
    let missing = out.join("02_beside");
    std::fs::remove_dir_all(&missing).unwrap();
    let next = plan(&path, &[&go_on[..], &[out.to_str().unwrap()]].concat());
    assert!(next.stderr.is_empty(), "{}", text(&next.stderr));
    assert!(missing.join("plan.json").exists());
    // a plan of another ply is none to go on from
    let other = out.join("01_base/plan.json");
    let swapped = std::fs::read_to_string(&other).unwrap().replacen("0.1", "0.2", 1);
    std::fs::write(&other, swapped).unwrap();
    let refused = plan(&path, &[&go_on[..], &[out.to_str().unwrap()]].concat());
    assert_eq!(refused.status.code(), Some(2));
}

#[test]
fn check_says_what_lies_on_what() {
    let folder = tempfile::tempdir().unwrap();
    let path = book(folder.path(), BOOK);
    let output = command().arg("check").arg(&path).output().unwrap();
    assert!(output.status.success(), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    assert!(shown.starts_with("Part\n"), "{shown}");
    assert!(shown.contains("ply 3     on <base>"), "{shown}");
    assert!(shown.contains("0.3 mm thick, lies on ply 1\n"), "{shown}");
    assert_eq!(shown.matches("lies on the mold").count(), 2, "{shown}");
}

/// With the place of the fault in the book, the ply, and a remedy.
#[test]
fn a_wrong_book_is_refused_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = book(folder.path(), &BOOK.replace("\"400 mm\"", "\"400\""));
    for name in ["plan", "check"] {
        let output = command().arg(name).arg(&path).output().unwrap();
        assert_eq!(output.status.code(), Some(2));
        let said = one_line(&output.stderr);
        assert!(
            said.contains("ply beside: \"400\" has no unit") && said.contains("plies.toml:32"),
            "{said}"
        );
    }
    assert_eq!(files(folder.path()), ["plies.toml"]);
}

#[test]
fn commands_of_one_ply_say_that_this_is_a_book() {
    let folder = tempfile::tempdir().unwrap();
    let path = book(folder.path(), BOOK);
    for arguments in [&["simulate"][..], &["net"]] {
        let output = command().args(arguments).arg(&path).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let said = one_line(&output.stderr);
        assert!(said.contains("this is a plybook") && said.contains("`plydrape plan`"), "{said}");
    }
    for (option, fault) in [
        (&["--compare"][..], "--compare is for a single ply, and this is a plybook"),
        (&["--continue", "somewhere"], "there is no plan to go on from in `somewhere`"),
    ] {
        let output = plan(&path, option);
        assert_eq!(output.status.code(), Some(2), "{option:?}");
        let said = one_line(&output.stderr);
        assert!(said.contains(fault), "{said}");
    }
    assert_eq!(files(folder.path()), ["plies.toml"]);
}
