//! `plydrape simulate` as a user calls it: exit codes, what is printed, what is written and what not.

use crate::common::{command, example, files, one_line, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

/// The paper's example: it exceeds limits.
fn headline() -> PathBuf {
    example("01_flat_sheared_mold")
}

/// A strip between two grippers: it is accepted.
fn strip() -> PathBuf {
    example("02_hanging_strip")
}

/// `plydrape simulate SCENE -o FOLDER` and flags.
fn simulate(scene: &Path, folder: &Path, flags: &[&str]) -> Output {
    let mut command = command();
    command.arg("simulate").arg(scene).arg("-o").arg(folder);
    command.args(flags).output().unwrap()
}

fn result(folder: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(folder.join("result.json")).unwrap()).unwrap()
}

const FILES: [&str; 4] = ["report.html", "result.json", "steps.csv", "trajectory.csv"];
/// The scene, draped as a sheet.
const FILES_OF_SHEET: [&str; 5] =
    ["report.html", "result.json", "sheet.npz", "steps.csv", "trajectory.csv"];

#[test]
fn exit_code_is_the_verdict() {
    let folder = tempfile::tempdir().unwrap();
    for (name, code) in
        [("01_flat_sheared_mold", 1), ("02_hanging_strip", 0), ("03_tilted_plane", 0)]
    {
        let output = simulate(&example(name), &folder.path().join(name), &[]);
        assert_eq!(output.status.code(), Some(code), "{name}");
        let shown = text(&output.stdout);
        let word = if code == 0 { "accepted" } else { "not accepted" };
        // the one model that decides, and no word of the other one
        let [model, other] = match name {
            "01_flat_sheared_mold" => ["the sheet", "the catenaries"],
            _ => ["the catenaries", "the sheet"],
        };
        assert!(shown.contains(&format!("\n{word} by {model}")), "{shown}");
        assert!(!shown.contains(other) && shown.matches("accepted").count() == 1, "{shown}");
        assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    }
}

/// A grid without its middle cell, which faces down in its file: `simulate` says so as `check` does, and the catenaries that are accepted
/// above it name the hole and the overhang that they do not see.
#[test]
fn a_verdict_names_what_its_model_does_not_see() {
    let folder = tempfile::tempdir().unwrap();
    let mut grid = String::new();
    for n in 0..16 {
        grid += &format!("v {} {} 0\n", 100 * (n % 4), 100 * (n / 4));
    }
    for (i, j) in (0..9).map(|n| (n % 3, n / 3)).filter(|cell| *cell != (1, 1)) {
        let first = 4 * j + i + 1;
        grid += &format!("f {first} {} {} {}\n", first + 4, first + 5, first + 1);
    }
    std::fs::write(folder.path().join("grid.obj"), grid).unwrap();
    let scene = folder.path().join("scene.toml");
    let text_of = "[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\noverhang = 0.02\n\
        [mold]\nkind = \"mesh\"\nfile = \"grid.obj\"\nunit = \"mm\"\n\
        [grippers]\nspacing = [0.098, 0.098]\nheight = 0.2\norigin = [0.1, 0.15]\n\
        [motion]\nkind = \"hold\"\n[model]\nkind = \"catenaries\"\n";
    std::fs::write(&scene, text_of).unwrap();
    let output = simulate(&scene, &folder.path().join("out"), &[]);
    let (shown, warned) = (text(&output.stdout), text(&output.stderr));
    assert_eq!(output.status.code(), Some(0), "{shown}{warned}");
    assert!(
        shown.contains(
            "\nthe catenaries do not see fabric beyond the outer grippers and the hole of the mold\n"
        ),
        "{shown}"
    );
    assert!(warned.contains("warning: 16 of 16 triangles of the mold face down"), "{warned}");
}

/// One object with the documented keys on one line, and not a byte more.
#[test]
fn json_is_one_object_and_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    for scene in [headline(), strip()] {
        let output =
            simulate(&scene, &folder.path().join("out"), &["--json", "--model", "catenaries"]);
        assert!(output.stderr.is_empty());
        let shown = text(&output.stdout);
        assert_eq!(shown.matches('\n').count(), 1, "{shown}");
        assert!(shown.starts_with("{\"accepted\":") && shown.ends_with("}\n"), "{shown}");
        let printed: Value = serde_json::from_str(&shown).unwrap();
        for key in ["model", "status", "steps", "worst", "final", "limits", "time_s"] {
            assert!(printed.get(key).is_some(), "{key} in {shown}");
        }
        for key in ["first_contact_step", "first_contact", "first_shear_step", "equilibria"] {
            assert!(printed["catenaries"].get(key).is_some(), "{key} in {shown}");
        }
        for measures in ["worst", "final"] {
            for key in [
                "slack_mm",
                "slack_ratio",
                "overstretch",
                "bridging_mm",
                "shear_deg",
                "tilt_deg",
                "landing_error_mm",
            ] {
                // what is not measured is missing: a strip without a mold bridges and lands nowhere, and has no cell to shear
                let of_a_mold = ["bridging_mm", "shear_deg", "landing_error_mm"].contains(&key);
                let measured = scene == headline() || !of_a_mold;
                let found = printed[measures].get(key).is_some_and(Value::is_number);
                assert_eq!(found, measured, "{measures}.{key}");
            }
        }
        assert!(printed["mean_equilibrium_us"].as_f64().unwrap() > 0.0);
    }
}

/// What Krogh et al. 2018 print of their example, and what this program adds: wrinkles at the end,
/// with size and place.
#[test]
fn the_paper_s_example_has_its_printed_contacts_and_shear() {
    let folder = tempfile::tempdir().unwrap();
    let output = simulate(&headline(), folder.path(), &["--json", "--model", "catenaries"]);
    assert_eq!(output.status.code(), Some(1));
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(printed["accepted"], false);
    assert_eq!(printed["steps"], 30);
    let report = &printed["catenaries"];
    assert_eq!(report["first_contact_step"], 26);
    let falling = |from: [usize; 2], to: [usize; 2]| serde_json::json!({"kind": "falling", "from": from, "to": to});
    let contacts = report["first_contact"].as_array().unwrap();
    let expected = [falling([1, 0], [0, 1]), falling([2, 0], [1, 1]), falling([3, 0], [2, 1])];
    assert_eq!(contacts.as_slice(), expected);
    assert_eq!(report["first_shear_step"], 5);
    assert_eq!(report["all_shear_step"], 5);

    let last = &result(folder.path())["steps"][29]["measures"];
    for key in ["slack_mm", "wrinkle_mm", "overstretch"] {
        assert!(last[key]["value"].as_f64().unwrap() > 0.0, "{key}: {last}");
        let at = last[key]["where"].as_str().unwrap();
        assert!(at.starts_with("diagonal") || at.starts_with("edge"), "{at}");
        assert_eq!(last[key]["place"].as_array().unwrap().len(), 3);
    }
    assert_eq!(printed["final"]["slack_mm"], last["slack_mm"]["value"]);
}

#[test]
fn results_go_to_the_folder_asked_for_or_beside_the_scene() {
    let folder = tempfile::tempdir().unwrap();
    let asked = folder.path().join("a/b");
    assert_eq!(simulate(&strip(), &asked, &[]).status.code(), Some(0));
    assert_eq!(files(&asked), FILES);

    let scene = folder.path().join("strip.toml");
    std::fs::copy(strip(), &scene).unwrap();
    let output = command().arg("simulate").arg(&scene).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(files(&folder.path().join("strip.results")), FILES);
    let shown = text(&output.stdout);
    assert!(shown.contains("strip.results:\n  result.json, steps.csv, "), "{shown}");
}

#[test]
fn a_file_of_the_user_s_stays() {
    let folder = tempfile::tempdir().unwrap();
    for name in FILES {
        let out = folder.path().join(name);
        std::fs::create_dir(&out).unwrap();
        std::fs::write(out.join(name), "mine").unwrap();
        let output = simulate(&strip(), &out, &["--json"]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(output.stdout.is_empty());
        // a long path may break anywhere
        let message = one_line(&output.stderr).replace(' ', "");
        assert!(message.contains(name), "{message}");
        assert!(message.contains("chooseanotherfolderwith-o"), "{message}");
        assert_eq!(std::fs::read_to_string(out.join(name)).unwrap(), "mine");
        assert_eq!(files(&out), [name], "nothing else is written");
    }

    // results that were edited since are the user's as well
    let out = folder.path().join("edited");
    assert_eq!(simulate(&strip(), &out, &[]).status.code(), Some(0));
    assert_eq!(simulate(&strip(), &out, &[]).status.code(), Some(0));
    std::fs::write(out.join("steps.csv"), "edited").unwrap();
    assert_eq!(simulate(&strip(), &out, &[]).status.code(), Some(2));
    let kept = std::fs::read_to_string(out.join("steps.csv")).unwrap();
    assert_eq!(kept, "edited");
}

#[test]
fn quiet_prints_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let output = simulate(&headline(), folder.path(), &["--quiet"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stdout.is_empty() && output.stderr.is_empty());
    assert_eq!(files(folder.path()), FILES_OF_SHEET);
}

#[test]
fn a_broken_scene_exits_with_two_and_writes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    let good = std::fs::read_to_string(strip()).unwrap();
    for (from, to) in [
        ("height = 0", "height = nan"),
        ("height = 0", "height = inf"),
        ("height = 0", "height = \"0 kg\""),
        ("height = 0", "heigth = 0"),
        ("\"98 mm\", \"98 mm\"", "\"198 mm\", \"98 mm\""),
        ("krogh2018", "krog2018"),
    ] {
        assert!(good.contains(from));
        std::fs::write(&scene, good.replace(from, to)).unwrap();
        let out = folder.path().join("out");
        let output = simulate(&scene, &out, &["--json"]);
        let shown = text(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{to}\n{shown}");
        assert!(output.stdout.is_empty(), "{to}");
        assert!(shown.contains("scene.toml:") && shown.contains("help:"), "{shown}");
        assert!(!out.exists(), "{to}");
    }
}

#[test]
fn the_same_scene_gives_the_same_bytes() {
    let folder = tempfile::tempdir().unwrap();
    let (first, second) = (folder.path().join("first"), folder.path().join("second"));
    for out in [&first, &second] {
        simulate(&headline(), out, &["--quiet"]);
    }
    for name in FILES_OF_SHEET {
        let read = |out: &Path| std::fs::read(out.join(name)).unwrap();
        assert!(read(&first) == read(&second), "{name} differs");
    }
}

/// `plydrape … | head` ends silently.
#[test]
fn a_closed_pipe_is_no_failure() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (headline(), folder.path().join("out"));
    let (scene, out) = (scene.to_str().unwrap(), out.to_str().unwrap());
    for arguments in [
        vec!["simulate", scene, "-o", out],
        vec!["simulate", scene, "-o", out, "--json"],
        vec!["check", scene],
        vec!["schema"],
    ] {
        let mut command = command();
        command.args(&arguments);
        let mut child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
        let code = output.status.code();
        assert!(code == Some(0) || code == Some(1), "{arguments:?}: {code:?}");
    }
    assert_eq!(files(Path::new(out)), FILES_OF_SHEET);
}

/// A drape by catenaries of 1600 grippers and 3000 steps into the folder `out` of another one.
#[cfg(unix)]
fn long_run(folder: &Path) -> Command {
    let scene = folder.join("scene.toml");
    let large = std::fs::read_to_string(headline())
        .unwrap()
        .replace("grippers = [4, 2]", "grippers = [40, 40]")
        .replace("steps = 30", "steps = 3000");
    std::fs::write(&scene, large).unwrap();
    let mut command = command();
    command.env("PLYDRAPE_MEMORY", "200 GB");
    command.args(["simulate", "--model", "catenaries"]).arg(&scene);
    command.arg("-o").arg(folder.join("out"));
    command
}

/// A scene of 3000 steps, interrupted early: files that are whole, and hold the steps done alone.
#[cfg(unix)]
#[test]
fn an_interrupt_leaves_complete_files_of_the_steps_done() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut command = long_run(folder.path());
    let child =
        command.arg("--json").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(std::time::Duration::from_millis(700));
    let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
    assert!(kill.unwrap().success());
    let output = child.wait_with_output().unwrap();
    let code = output.status.code();
    assert_eq!(code, Some(130), "{}", text(&output.stderr));

    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    let steps = printed["steps"].as_u64().unwrap() as usize;
    assert!((1..3000).contains(&steps), "{steps}");
    assert_eq!(files(&out), FILES);
    let read = |name: &str| std::fs::read_to_string(out.join(name)).unwrap();
    let rows = |name: &str| {
        let text = read(name);
        assert!(text.ends_with('\n'), "{name}");
        text.lines().count()
    };
    assert_eq!(rows("steps.csv"), 1 + steps);
    assert_eq!(rows("trajectory.csv"), 1 + 1600 * steps);
    let json = read("result.json");
    assert!(json.ends_with("}\n"));
    assert!(json.contains(&format!("\"step\":{steps},\"time\"")));
    assert!(!json.contains(&format!("\"step\":{},\"time\"", steps + 1)));
}

/// A ply stiffer than any, inextensible and with slack: no force in floating point gives its spans their lengths. The step says so
/// as text, and the exit code is 3, not that of a limit.
#[test]
fn a_step_without_a_solution_exits_with_three() {
    let folder = tempfile::tempdir().unwrap();
    let mut codes = Vec::new();
    for turn in 0..12 {
        let place = |i: usize, j: usize| {
            let phase = 1.0 + 2.3 * ((4 * j + i) as f64 + 0.7 * f64::from(turn));
            format!("[{}, {}, {}]", 0.098 * i as f64, 0.098 * j as f64, 0.05 + 4e-3 * phase.sin())
        };
        let row = |j: usize| (0..4).map(|i| place(i, j)).collect::<Vec<_>>().join(", ");
        let written = format!(
            "[ply]\ngrippers = [4, 2]\ncell = [0.1, 0.1]\n[ply.material]\nname = \"stiff\"\nmass = 0.3143\n\
             flexural_rigidity = \"1e6 N m^2\"\n[grippers]\npositions = [[{}], [{}]]\n\
             [model]\nkind = \"catenaries\"\nslopes = \"min-force\"\naxial_stiffness = inf\n",
            row(0),
            row(1)
        );
        let scene = folder.path().join("stiff.toml");
        std::fs::write(&scene, written).unwrap();
        let output = simulate(&scene, &folder.path().join("out"), &["--verbose"]);
        codes.push(output.status.code());
        let shown = text(&output.stdout);
        match output.status.code() {
            Some(3) => {
                assert!(shown.contains("step 1 did not converge: "), "{shown}");
                assert!(shown.contains("\nnot accepted by the catenaries: "), "{shown}");
                let failed = |line: &str| line.starts_with("equilibrium ") && line.contains("FAIL");
                assert!(shown.lines().any(failed), "{shown}");
            }
            Some(0 | 1) => {}
            code => panic!("{code:?} {shown}{}", text(&output.stderr)),
        }
    }
    assert!(codes.contains(&Some(3)), "{codes:?}");
}

/// A plan's folder keeps plan.json and motion.csv when a simulation that follows motion.csv writes there.
#[test]
fn a_simulation_into_the_folder_of_its_plan_keeps_what_it_follows() {
    let home = tempfile::tempdir().unwrap();
    let (plan, scene) = (home.path().join("scene.toml"), home.path().join("follow.toml"));
    let few = std::fs::read_to_string(headline()).unwrap();
    std::fs::write(&plan, format!("{few}\n[plan]\nsteps = 8\nevaluations = 1\n")).unwrap();
    let out = home.path().join("out");
    let run = |arguments: &[&std::path::Path], name: &str| {
        let mut command = command();
        command.arg(name).args(arguments).arg("--quiet").arg("-o").arg(&out).output().unwrap()
    };
    assert!(run(&[&plan], "plan").status.code().is_some_and(|code| code < 2));
    let follow = |file: &str| {
        // the file says where the grippers start
        let (ply, rest) = few.split_once("[grippers]").unwrap();
        let target = rest.split_once("[target]").unwrap().1.split_once("[motion]").unwrap().0;
        format!("{ply}[target]{target}[motion]\nkind = \"file\"\nfile = \"out/{file}\"\n")
    };
    std::fs::write(&scene, follow("motion.csv")).unwrap();
    let before = std::fs::read(out.join("motion.csv")).unwrap();
    let output = run(&[&scene], "simulate");
    assert!(output.status.code().is_some_and(|code| code < 2), "{}", text(&output.stderr));
    assert_eq!(std::fs::read(out.join("motion.csv")).unwrap(), before);
    assert!(out.join("plan.json").exists());
    // results would take the place of the file that is followed
    std::fs::write(&scene, follow("trajectory.csv")).unwrap();
    let before = std::fs::read(out.join("trajectory.csv")).unwrap();
    let output = run(&[&scene], "simulate");
    assert_eq!(output.status.code(), Some(2));
    let message = one_line(&output.stderr);
    assert!(
        message.contains("trajectory.csv is read by this run") && message.contains("-o"),
        "{message}"
    );
    assert_eq!(std::fs::read(out.join("trajectory.csv")).unwrap(), before);
}

/// A long run holds its folder: a second one is refused with who holds it. SIGTERM ends it as Ctrl-C does.
#[cfg(unix)]
#[test]
fn a_second_run_into_a_folder_is_refused_and_a_termination_is_an_interrupt() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut first = long_run(folder.path());
    let first = first.arg("-q").stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
    // until it has claimed its folder
    let start = std::time::Instant::now();
    while !out.exists() && start.elapsed().as_secs() < 60 {
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    std::thread::sleep(std::time::Duration::from_millis(200));
    let mut second = command();
    let second = second.arg("simulate").arg(headline()).arg("-o").arg(&out).output().unwrap();
    assert_eq!(second.status.code(), Some(2));
    let message = one_line(&second.stderr);
    let owner = format!("`plydrape simulate`, process {}", first.id());
    assert!(message.contains("is being written by") && message.contains(&owner), "{message}");
    let kill = Command::new("kill").args(["-TERM", &first.id().to_string()]).status();
    assert!(kill.unwrap().success());
    assert_eq!(first.wait_with_output().unwrap().status.code(), Some(130));
    assert_eq!(files(&out), FILES);
}

/// A kill between two renames leaves files of two runs: what reads them says so.
#[test]
fn mixed_files_are_no_result() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let mut simulate = command();
    simulate.args(["simulate", "--quiet"]).arg(headline()).arg("-o").arg(&out).output().unwrap();
    let list = std::fs::read_to_string(out.join(".plydrape")).unwrap();
    assert!(list.contains("\"sealed\":true"), "{list}");
    let torn = list.replace("\"sealed\":true", "\"sealed\":false");
    std::fs::write(out.join(".plydrape"), torn).unwrap();
    let output = command().arg("report").arg(out.join("result.json")).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(one_line(&output.stderr).contains("are of two runs"), "{}", text(&output.stderr));
}
