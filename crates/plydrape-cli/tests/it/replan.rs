//! `plydrape replan` as a user and as the program of a cell call it.

use crate::common::{command, files, one_line, text};
use serde_json::Value;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};

/// Four grippers that carry a ply a little way to a flat mold, and a short search.
const SCENE: &str = "\
[model]
kind = \"catenaries\"

[ply]
grippers = [2, 2]
cell = [\"100 mm\", \"100 mm\"]
material = \"krogh2018\"

[mold]
kind = \"plane\"

[grippers]
spacing = [\"98 mm\", \"98 mm\"]
height = \"75 mm\"
middle = [\"-0.2 m\", \"0.1 m\"]
direction = \"20 deg\"

[target]
origin = [\"0 mm\", \"0 mm\"]

[plan]
steps = 30
evaluations = 2
";

const OFFSET: &str = "[offset]\nx = \"3 mm\"\ny = \"-1.5 mm\"\nyaw = \"0.8 deg\"\n";

/// A plan in a folder, and its result.
fn planned(folder: &Path) -> PathBuf {
    let scene = folder.join("flat.toml");
    std::fs::write(&scene, SCENE).unwrap();
    let plan = folder.join("plan");
    let output = command()
        .args(["plan", "--without-errors", "--quiet", "-o"])
        .args([&plan, &scene])
        .output()
        .unwrap();
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    plan.join("result.json")
}

fn replan(result: &Path, offset: &str, flags: &[&str]) -> Output {
    let file = result.with_file_name("offset.toml");
    std::fs::write(&file, offset).unwrap();
    command().arg("replan").arg(result).arg("--picked").arg(file).args(flags).output().unwrap()
}

/// What is answered to lines of standard input.
fn answers(result: &Path, lines: &[u8], flags: &[&str]) -> (Output, Vec<Value>) {
    let mut child = command()
        .arg("replan")
        .arg(result)
        .arg("--json")
        .args(flags)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(lines).unwrap();
    let output = child.wait_with_output().unwrap();
    let answers = text(&output.stdout);
    let answers = answers.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    (output, answers)
}

fn json(file: &Path) -> Value {
    serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap()
}

/// The files are those of a plan without its checkpoint; the result says by how much the ply lay off, is read again by every other
/// command, and drives a robot.
#[test]
fn a_replanned_result_is_a_result() {
    let folder = tempfile::tempdir().unwrap();
    let result = planned(folder.path());
    let before = std::fs::read(&result).unwrap();
    let accepted = json(&result)["summary"]["accepted"].as_bool().unwrap();
    let output = replan(&result, OFFSET, &[]);
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    assert_eq!(output.status.code(), Some(i32::from(!accepted)));
    let said = one_line(&output.stdout);
    assert!(said.contains("the ply lies off by x 3 mm, y -1.5 mm, yaw 0.8°"), "{said}");

    let moved = result.with_file_name("replan");
    let names = ["motion.csv", "report.html", "result.json", "steps.csv", "trajectory.csv"];
    assert_eq!(files(&moved), names);
    let own = json(&moved.join("result.json"));
    let picked = &own["plan"]["picked_up"];
    assert_eq!(picked["offset"]["shift"], serde_json::json!([0.003, -0.0015]));
    let (old, new) = (&json(&result)["steps"], &own["steps"]);
    let last = old.as_array().unwrap().len() - 1;
    assert_eq!(old[last]["grippers"]["position"], new[last]["grippers"]["position"]);
    assert_ne!(old[0]["grippers"]["position"], new[0]["grippers"]["position"]);
    assert_eq!(std::fs::read(&result).unwrap(), before);
    let page = std::fs::read_to_string(moved.join("report.html")).unwrap();
    assert!(page.contains("replanned for a ply that lay off by x 3 mm, y -1.5 mm, yaw 0.8 deg"));

    for format in ["csv", "ros2", "vtk", "inp"] {
        let mut export = command();
        export.arg("export").arg(moved.join("result.json")).args([
            "--to",
            format,
            "--even-if-rejected",
        ]);
        let output = export.output().unwrap();
        assert!(output.status.success(), "{format}: {}", text(&output.stderr));
    }
    let mut again = command();
    again.arg("replan").arg(moved.join("result.json")).arg("--picked");
    let output = again.arg(result.with_file_name("offset.toml")).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(one_line(&output.stderr).contains("corrected for another pick-up already"));
}

/// The answer to a line has its id, though the line is refused.
#[test]
fn an_answer_repeats_the_id_of_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let result = planned(folder.path());
    let lines = "{\"id\": 7, \"offset\": {\"x\": 0.003}}\n{\"id\": \"b\", \"offset\": {}}\n{\"offset\": {\"x\": 0, \"x\": 1}}\n";
    let (output, found) = answers(&result, lines.as_bytes(), &[]);
    assert_eq!((output.status.code(), found.len()), (Some(2), 3));
    assert_eq!((&found[0]["id"], found[0]["duration_s"].is_number()), (&7.into(), true));
    assert_eq!(found[1]["id"], "b");
    assert!(found[1]["error"].as_str().unwrap().contains("none of x, y and yaw"));
    assert!(found[2].get("id").is_none());
    assert!(found[2]["error"].as_str().unwrap().contains("the key `x` is there twice"));
}

/// A bad line has one answer with what is wrong and what would be right, and the next line is read; the exit code is the worst one.
#[test]
fn a_stream_answers_every_line_and_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let result = planned(folder.path());
    let accepted = json(&result)["summary"]["accepted"].as_bool().unwrap();
    let good = b"{\"offset\": {\"x\": 0.003, \"y\": \"-1.5 mm\", \"yaw\": \"0.8 deg\"}}\n";
    let (output, found) = answers(&result, good, &[]);
    assert_eq!((output.status.code(), found.len()), (Some(i32::from(!accepted)), 1));
    let steps = json(&result)["steps"].as_array().unwrap().len();
    assert_eq!(found[0]["accepted"], accepted);
    assert_eq!(found[0]["times"].as_array().unwrap().len(), steps);
    assert_eq!(found[0]["positions"][0].as_array().unwrap().len(), 4);
    assert_eq!(found[0]["weights"][0], 1.0);
    // a plan takes the least time under its limits, so an offset may need a little more
    let longer = found[0]["longer"].as_f64().unwrap();
    assert!((1.0..1.05).contains(&longer), "{longer}");

    let mut lines = good.to_vec();
    lines.extend(
        b"not json\n\n[1]\n{\"offset\": {\"x\": \"3\"}}\n{\"offset\": {\"z\": 1}}\n\xff\xfe\n",
    );
    lines.extend(
        b"{\"offset\": {\"x\": 1e308}}\n{\"offset\": {\"yaw\": \"200 deg\"}}\n{\"offset\": null}\n",
    );
    lines.extend(vec![b'x'; 3 << 20]);
    lines.extend(b"\n");
    lines.extend(&good[..good.len() - 1]);
    let (output, found) = answers(&result, &lines, &[]);
    assert!(output.stderr.is_empty(), "{}", text(&output.stderr));
    assert_eq!((output.status.code(), found.len()), (Some(2), 11));
    for refused in &found[1..10] {
        let [error, help] = ["error", "help"].map(|key| refused[key].as_str().unwrap());
        assert!(!error.is_empty() && !help.is_empty() && refused.get("accepted").is_none());
    }
    assert_eq!(found[0], found[10]);

    let (_, sampled) = answers(&result, good, &["--rate", "50"]);
    let times = sampled[0]["times"].as_array().unwrap();
    assert!((times[1].as_f64().unwrap() - 0.02).abs() < 1e-12);
    let (output, found) = answers(&result, b"", &[]);
    assert!(output.status.success() && found.is_empty());
}

/// Offsets that no motion takes out, files that are none and results of no plan: one message, no folder.
#[test]
fn what_cannot_be_replanned_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().unwrap();
    let result = planned(folder.path());
    let swapped = "[[point]]\nplanned = [0, 0]\nseen = [0, 0]\n[[point]]\nplanned = [1, 0]\nseen = [0, 1]\n[[point]]\nplanned = [0, 1]\nseen = [1, 0]\n";
    let alone = "[[point]]\nplanned = [0, 0]\nseen = [0, 0]\n";
    for (offset, expected) in [
        ("", "neither an offset nor points"),
        ("[offset]\nx = \"3\"\n", "has no unit"),
        ("[offset]\ny = \"3 deg\"\n", "is an angle"),
        ("[offset]\nz = 1\n", "is no key here"),
        ("[offset]\nx = nan\n", "is no"),
        ("[offset]\nx = 3\n", "did you mean \"3 mm\"?"),
        ("[offset]\nx = 900000\n", "would make a shift of 900000 m"),
        ("[offset]\nyaw = 0.8\n", "did you mean \"0.8 deg\"?"),
        (alone, "takes two points or more, and their number is 1"),
        ("[offset]\nx = 3,5\n", "not TOML"),
        (swapped, "from where the others put it"),
    ] {
        let output = replan(&result, offset, &[]);
        assert_eq!(output.status.code(), Some(2), "{offset}");
        let said = one_line(&output.stderr);
        assert!(said.contains(expected) && said.contains("help:"), "{offset}: {said}");
        // a fault of a line has its place
        assert!(offset.is_empty() || said.contains("offset.toml:"), "{offset}: {said}");
        assert!(!result.with_file_name("replan").exists());
    }

    let scene = folder.path().join("flat.toml");
    let simulated = folder.path().join("simulated");
    let hanging = SCENE.replace(
        "[plan]\nsteps = 30\nevaluations = 2\n",
        "[motion]\nkind = \"straight\"\nsteps = 5\n",
    );
    std::fs::write(&scene, hanging).unwrap();
    command().args(["simulate", "--quiet", "-o"]).args([&simulated, &scene]).output().unwrap();
    let output = replan(&simulated.join("result.json"), OFFSET, &[]);
    assert_eq!(output.status.code(), Some(2));
    assert!(one_line(&output.stderr).contains("not that of a plan"), "{}", text(&output.stderr));
    let output = command().arg("replan").arg(&result).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
}

/// More than 50 mm or 10° is no way to lay down a ply, but a wrong unit or frame: refused, from a file and from a line, unless somebody says that it
/// does lie there. A turn about a far point shifts the ply too.
#[test]
fn an_offset_that_is_far_is_believed_when_told() {
    let folder = tempfile::tempdir().unwrap();
    let result = planned(folder.path());
    for offset in ["x = \"60 mm\"", "yaw = \"12 deg\"", "yaw = \"2 deg\"\nabout = [\"2 m\", 0]"] {
        let file = format!("[offset]\n{offset}\n");
        let output = replan(&result, &file, &[]);
        let said = one_line(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{offset}");
        assert!(
            said.contains("50 mm or 10° is asked about") && said.contains("far = true"),
            "{said}"
        );
        for (file, flags) in [(format!("far = true\n{file}"), &[][..]), (file, &["--far"][..])] {
            let output = replan(&result, &file, flags);
            assert_ne!(output.status.code(), Some(2), "{offset}: {}", text(&output.stderr));
        }
    }
    let line = |more: &str| format!("{{\"offset\": {{\"x\": \"60 mm\"}}{more}}}\n");
    let lines = [line(""), line(", \"far\": true"), "{\"offset\": {\"x\": 3}}\n".into()].concat();
    let (_, found) = answers(&result, lines.as_bytes(), &[]);
    assert!(found[0]["help"].as_str().unwrap().contains("far = true"), "{}", found[0]);
    assert!(found[1]["error"].is_null() && found[1]["offset"]["x"] == 0.06, "{}", found[1]);
    assert!(found[2]["help"].as_str().unwrap().contains("did you mean \"3 mm\"?"), "{}", found[2]);
}

/// A motion of more than ten minutes is planned, but its samples are only written on request, by the plan and by the export.
#[test]
fn a_motion_of_more_than_ten_minutes_is_written_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, plan) = (folder.path().join("slow.toml"), folder.path().join("plan"));
    let slow = SCENE.replace("steps = 30", "steps = 30\nrate = 1");
    std::fs::write(&scene, slow + "\n[limits]\nspeed = \"0.3 mm/s\"\n").unwrap();
    let run = |arguments: &[&str], file: &Path| {
        let output = command().args(arguments).arg(file).output().unwrap();
        (output.status.code(), one_line(&output.stderr))
    };
    let to = plan.to_str().unwrap();
    let (_, said) = run(&["plan", "--without-errors", "--quiet", "-o", to], &scene);
    assert!(said.contains("motion.csv is not written: the motion takes"), "{said}");
    assert!(!plan.join("motion.csv").exists() && plan.join("result.json").exists());
    let export = ["export", "--to", "csv", "--even-if-rejected"];
    let (code, said) = run(&export, &plan);
    assert!(code == Some(2) && said.contains("write them with --large"), "{said}");
    let (code, said) = run(&[&export[..], &["--large"]].concat(), &plan);
    assert!(code == Some(0) && plan.join("csv/motion.csv").exists(), "{said}");
}
