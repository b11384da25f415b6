//! `plydrape export` and `plydrape report` as a user calls them: from a result.json, with its sheet.npz, alone, or a refusal.

use crate::common::{command, example, files, one_line, text};
use std::path::{Path, PathBuf};
use std::process::Output;

/// A result in a folder of its own, far from its scene.
fn result(home: &Path, name: &str) -> PathBuf {
    let run = home.join("run");
    let mut simulate = command();
    simulate.arg("simulate").arg(example(name)).arg("-o").arg(&run).arg("--quiet");
    simulate.output().unwrap();
    let alone = home.join("alone");
    std::fs::create_dir(&alone).unwrap();
    for name in ["result.json", "sheet.npz"].iter().filter(|name| run.join(name).exists()) {
        std::fs::copy(run.join(name), alone.join(name)).unwrap();
    }
    alone.join("result.json")
}

fn plydrape(arguments: &[&str], result: &Path) -> Output {
    let (first, rest) = arguments.split_first().unwrap();
    command().arg(first).arg(result).args(rest).output().unwrap()
}

fn succeeds(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
}

/// Every format goes to a folder of its name beside the result, or to the one asked for, with the same bytes.
#[test]
fn every_format_is_made_from_the_result_alone() {
    let home = tempfile::tempdir().unwrap();
    let result = result(home.path(), "01_flat_sheared_mold");
    let asked = home.path().join("asked");
    for format in ["csv", "inp", "ngsolve", "ros2", "vtk"] {
        let output = plydrape(&["export", "--to", format, "--even-if-rejected"], &result);
        succeeds(&output);
        let beside = result.with_file_name(format);
        let names = files(&beside);
        let shown = text(&output.stdout);
        let listed = shown.split([',', ' ', '\n', '/']).filter(|word| word.contains('.'));
        let listed: Vec<&str> = listed.filter(|word| names.iter().any(|n| n == word)).collect();
        assert!(!names.is_empty() && listed.len() == names.len(), "{shown}");
        let folder = asked.to_str().unwrap();
        let again = ["export", "--to", format, "-o", folder, "--even-if-rejected"];
        succeeds(&plydrape(&again, &result));
        for name in names {
            let [one, two] = [&beside, &asked].map(|dir| std::fs::read(dir.join(&name)).unwrap());
            assert!(one == two && !one.is_empty(), "{name}");
        }
    }
    // all of them fit into one folder
    assert!(asked.join("steps.csv").exists() && asked.join("ply.inp").exists());
}

/// The maker of a controller stands for its language: the same answer, here that there is no tool.
#[test]
fn a_maker_names_the_language_of_its_controllers() {
    let home = tempfile::tempdir().unwrap();
    let result = result(home.path(), "01_flat_sheared_mold");
    for (maker, language) in [("abb", "rapid"), ("kuka", "krl"), ("ur", "urscript")] {
        let [one, two] = [maker, language]
            .map(|word| plydrape(&["export", "--to", word, "--even-if-rejected"], &result));
        assert!(text(&one.stderr).contains("say in [tool]"), "{maker}: {}", text(&one.stderr));
        assert_eq!((one.status.code(), one.stderr), (two.status.code(), two.stderr), "{maker}");
    }
}

/// Tables and page are those that the simulation wrote.
#[test]
fn exports_are_what_the_simulation_wrote() {
    let home = tempfile::tempdir().unwrap();
    let result = result(home.path(), "05_cylinder");
    let csv = &["export", "--to", "csv", "--even-if-rejected"][..];
    for arguments in [csv, &["report"]] {
        succeeds(&plydrape(arguments, &result));
    }
    for (dir, name) in [("csv", "steps.csv"), ("csv", "trajectory.csv"), ("", "report.html")] {
        let again = std::fs::read(result.parent().unwrap().join(dir).join(name)).unwrap();
        assert!(again == std::fs::read(home.path().join("run").join(name)).unwrap(), "{name}");
    }
}

/// What is not, to the last digit, what this version wrote is refused with 2, a reason and a remedy; nothing is
/// written.
#[test]
fn other_files_are_refused_with_a_remedy() {
    let home = tempfile::tempdir().unwrap();
    let good = result(home.path(), "02_hanging_strip");
    let sound = std::fs::read_to_string(&good).unwrap();
    let version = plydrape_io::store::format::VERSION;
    let versioned = |other: u32| {
        sound.replacen(&format!("\"version\":{version}"), &format!("\"version\":{other}"), 1)
    };
    let cases = [
        ("cut", sound[..sound.len() / 2].to_owned(), "ends in the middle", "copy it again"),
        ("edited", sound.replacen("0.098", "0.097", 1), "was changed", "put the file back"),
        ("newer", versioned(version + 1), "in version", "update plydrape"),
        (
            "older",
            versioned(version - 1),
            "in version",
            "run `plydrape simulate` or `plydrape plan` again",
        ),
        ("foreign", "{\"format\":\"mesh\",\"version\":1}".into(), "is not a result", "give the"),
        ("text", "step,t (s)\n".into(), "is a table (CSV), not a result", "give the"),
    ];
    for (name, content, reason, remedy) in cases {
        assert_ne!(content, sound, "{name}");
        let folder = home.path().join(name);
        std::fs::create_dir(&folder).unwrap();
        let file = folder.join("result.json");
        std::fs::write(&file, content).unwrap();
        for arguments in [&["export", "--to", "vtk"][..], &["report"]] {
            let output = plydrape(arguments, &file);
            let message = one_line(&output.stderr);
            assert_eq!(output.status.code(), Some(2), "{name}: {message}");
            assert!(message.contains(reason) && message.contains(remedy), "{name}: {message}");
            assert!(output.stdout.is_empty());
            assert_eq!(files(&folder), ["result.json"], "{name}");
        }
    }
    let output = plydrape(&["report"], &home.path().join("none.json"));
    assert_eq!(output.status.code(), Some(2));
    assert!(one_line(&output.stderr).contains("cannot be read"));
}

/// A file of the user's is never written over, and then none of the others is written either.
#[test]
fn a_file_in_the_way_keeps_all_others_away() {
    let home = tempfile::tempdir().unwrap();
    let result = result(home.path(), "02_hanging_strip");
    let folder = result.with_file_name("csv");
    std::fs::create_dir(&folder).unwrap();
    std::fs::write(folder.join("trajectory.csv"), "mine").unwrap();
    let output = plydrape(&["export", "--to", "csv", "--even-if-rejected"], &result);
    assert_eq!(output.status.code(), Some(2));
    assert!(one_line(&output.stderr).contains("trajectory.csv was not written by plydrape"));
    assert_eq!(files(&folder), ["trajectory.csv"]);
    assert_eq!(std::fs::read_to_string(folder.join("trajectory.csv")).unwrap(), "mine");
}

/// What drives a machine along a motion that is not accepted is refused with 2, the verdict and what to do; with the option
/// it says so in its head. Pictures and models are written without it.
#[test]
fn a_rejected_motion_drives_no_machine_unless_asked() {
    let home = tempfile::tempdir().unwrap();
    let result = result(home.path(), "01_flat_sheared_mold");
    for format in ["csv", "ros2", "rapid", "krl", "urscript"] {
        let output = plydrape(&["export", "--to", format], &result);
        let message = one_line(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{format}: {message}");
        assert!(message.contains("not accepted by the sheet: height 4."), "{format}: {message}");
        assert!(message.contains("--even-if-rejected"), "{format}: {message}");
        assert!(!result.with_file_name(format).exists());
    }
    for format in ["inp", "ngsolve", "vtk", "pattern"] {
        succeeds(&plydrape(&["export", "--to", format], &result));
    }
    for (format, name) in [("csv", "motion_wide.csv"), ("ros2", "trajectory.yaml")] {
        succeeds(&plydrape(&["export", "--to", format, "--even-if-rejected"], &result));
        let text = std::fs::read_to_string(result.with_file_name(format).join(name)).unwrap();
        let head = text.lines().next().unwrap();
        assert!(head.starts_with("# NOT ACCEPTED: by the sheet: height 4."), "{head}");
    }
}

/// A program for one arm needs an arm; options that mean nothing for a format, templates that cannot be read and errors that
/// cannot be kept are refused.
#[test]
fn options_of_programs_are_refused_where_they_mean_nothing() {
    let home = tempfile::tempdir().unwrap();
    let result = result(home.path(), "01_flat_sheared_mold");
    for (arguments, what) in [
        (&["--to", "rapid", "--even-if-rejected"][..], "say in [tool] how the array is carried"),
        (&["--to", "csv", "--position-error", "1 mm"], "has no meaning for csv"),
        (&["--to", "csv", "--least-way", "1 mm"], "has no meaning for csv"),
        (&["--to", "ros2", "--position-error", "1 mm"], "has no meaning for ros2"),
        (&["--to", "krl", "--tf"], "--tf has no meaning for krl"),
        (&["--to", "krl", "--least-time", "2 s"], "is too large"),
        (&["--to", "krl", "--position-error", "0 mm"], "is zero"),
        (&["--to", "krl", "--position-error", "1 kg"], "is a mass"),
        (&["--to", "vtk", "--template", "x.mod.j2"], "there are no templates for vtk"),
        (&["--to", "rapid", "--template", "none.mod.j2"], "`none.mod.j2` cannot be read"),
    ] {
        let output = plydrape(&[&["export"], arguments].concat(), &result);
        let message = one_line(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(what), "{arguments:?}: {message}");
    }
}

/// The shipped templates are printed as they are.
#[test]
fn templates_are_printed_for_copying() {
    for (name, begin) in [
        ("rapid", "{#- ABB RAPID"),
        ("krl-src", "{#- KUKA KRL, the program"),
        ("krl-dat", "{#- KUKA KRL, the data"),
        ("urscript", "{#- Universal Robots URScript"),
    ] {
        let output = command().args(["template", name]).output().unwrap();
        succeeds(&output);
        assert!(text(&output.stdout).starts_with(begin), "{name}");
    }
}
