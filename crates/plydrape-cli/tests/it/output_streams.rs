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

/// A reader that has gone away changes neither the files nor the exit code, which is that of the verdict.
#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_changes_no_file_and_no_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let scene = example("01_flat_sheared_mold");
    let run = |arguments: &[&str], reader: Stdio| {
        let output = command().args(arguments).current_dir(folder.path()).stdout(reader).output();
        let output = output.unwrap();
        assert!(output.stderr.is_empty(), "{arguments:?}: {}", text(&output.stderr));
        output.status.code()
    };
    // a pipe without a reader
    let closed = || {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        Stdio::from(writer)
    };
    let planned = folder.path().join("flat.toml");
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\n\
                material = \"krogh2018\"\n[mold]\nkind = \"plane\"\n[grippers]\n\
                spacing = [0.098, 0.098]\nheight = 0.075\n[target]\norigin = [0, 0]\n\
                [plan]\nsteps = 30\nevaluations = 1\n";
    std::fs::write(&planned, text).unwrap();
    std::fs::write(folder.path().join("pick.toml"), "[offset]\nx = \"1 mm\"\n").unwrap();
    let scene = scene.to_str().unwrap();
    for (arguments, file) in [
        (&["simulate", scene, "-o", "out"][..], Some("out/result.json")),
        (&["simulate", scene, "-o", "out", "--json"], None),
        (&["plan", "flat.toml", "--without-errors"], Some("flat.plan/plan.json")),
        (&["replan", "flat.plan", "--picked", "pick.toml"], Some("flat.plan/replan/result.json")),
        (
            &["replan", "flat.plan", "--picked", "pick.toml", "--json", "-o", "r"],
            Some("r/steps.csv"),
        ),
        (&["export", "flat.plan", "--to", "vtk"], Some("flat.plan/vtk/drape.pvd")),
        (&["report", "out", "-o", "page"], Some("page/report.html")),
        (&["net", scene, "-o", "net"], Some("net/nodes.csv")),
        (&["check", scene], None),
        (&["schema"], None),
    ] {
        let code = run(arguments, closed());
        let written = file.is_none_or(|file| folder.path().join(file).is_file());
        assert!(written, "{arguments:?}: {file:?} is not written");
        assert_eq!(code, run(arguments, Stdio::null()), "{arguments:?}");
    }
    assert_eq!(run(&["simulate", scene, "-o", "out"], closed()), Some(1));
}

/// Signals end what keeps nothing of its work with 130, whenever they come: files are whole or not there, and no hidden folder is left.
#[cfg(unix)]
#[test]
fn a_signal_ends_exports_and_corrections_without_a_trace() {
    let folder = tempfile::tempdir().unwrap();
    let run = folder.path().join("run");
    let scene = example("01_flat_sheared_mold");
    command().arg("simulate").arg(scene).arg("-o").arg(&run).arg("--quiet").output().unwrap();
    let mut ends = [0, 0];
    for wait in [0, 2, 5, 10, 20, 30, 40, 60, 80, 120, 5000] {
        let out = folder.path().join(format!("out {wait}"));
        let mut export = command();
        export.args(["export", "--to", "vtk", "-o"]).args([&out, &run]);
        let child = export.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap();
        // it ends before the signal where that comes late
        let id = child.id().to_string();
        let signal = format!("sleep {}; kill -TERM {id}", f64::from(wait) * 1e-3);
        let mut killer = Command::new("sh").args(["-c", &signal]).stderr(Stdio::null()).spawn();
        let output = child.wait_with_output().unwrap();
        if let Ok(killer) = &mut killer {
            let _ = killer.kill();
            let _ = killer.wait();
        }
        let written = out.join("drape.pvd").is_file();
        match output.status.code() {
            Some(0) => assert!(written),
            Some(130) => ends[0] += 1,
            // before it listens
            None => ends[1] += 1,
            code => panic!("{code:?}: {}", text(&output.stderr)),
        }
        let left: Vec<String> = std::fs::read_dir(&out)
            .into_iter()
            .flatten()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .filter(|name| name.starts_with(".plydrape-"))
            .collect();
        assert!(left.is_empty(), "{wait}: {left:?}");
        assert!(written || !out.exists(), "{wait}: {:?}", crate::common::files(&out));
    }
    assert!(ends[0] > 0, "{ends:?}");

    // one that waits for offsets
    let scene = folder.path().join("flat.toml");
    std::fs::write(
        &scene,
        "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [0.1, 0.1]\n\
         material = \"krogh2018\"\n[mold]\nkind = \"plane\"\n[grippers]\n\
         spacing = [0.098, 0.098]\nheight = 0.075\n[target]\norigin = [0, 0]\n\
         [plan]\nsteps = 30\nevaluations = 1\n",
    )
    .unwrap();
    command().args(["plan", "--without-errors", "--quiet"]).arg(&scene).output().unwrap();
    let mut replan = command();
    replan.args(["replan", "--json"]).arg(scene.with_extension("plan"));
    let mut child = replan.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    std::io::Write::write_all(&mut input, b"{\"offset\": {\"x\": \"1 mm\"}}\n").unwrap();
    // it listens once it has answered
    let mut answer = String::new();
    let mut answers = std::io::BufReader::new(child.stdout.take().unwrap());
    std::io::BufRead::read_line(&mut answers, &mut answer).unwrap();
    assert!(answer.contains("\"accepted\""), "{answer}");
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    assert_eq!(child.wait().unwrap().code(), Some(130));
    drop(input);
}

/// The exit code is kept, whatever becomes of the message.
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
