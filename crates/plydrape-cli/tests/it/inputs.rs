//! What a run reads is never replaced by what it writes, and what a run before it has found is not replaced by something worse.

use crate::common::{command, one_line, text};
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Four grippers of a carried ply over a mesh; names in braces are those of the files that it reads.
const SCENE: &str = "\
[model]
kind = \"catenaries\"

[ply]
grippers = [2, 2]
cell = [\"100 mm\", \"100 mm\"]
material = \"{material}\"

[mold]
kind = \"mesh\"
file = \"{mold}\"
unit = \"m\"

[grippers]
positions = \"{positions}\"

[target]
origin = [0, 0]

[motion]
kind = \"straight\"
steps = 5

[plan]
steps = 12
evaluations = 1
";

const MATERIAL: &str =
    "source = \"mine\"\nmass = \"0.0314 kg/m\"\nflexural_rigidity = \"2e-4 N m^2\"\n";
const MOLD: &str = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n";
const POSITIONS: &str = "i,j,x (m),y (m),z (m)\n0,0,0,0,0.075\n1,0,0.098,0,0.075\n\
                         0,1,0,0.098,0.075\n1,1,0.098,0.098,0.075\n";
const OFFSET: &str = "[offset]\nx = \"3 mm\"\n";
const BOOK: &str = "\
title = \"Part\"

[mold]
kind = \"plane\"

[[plies]]
scene = \"{ply}\"
";
const PLY: &str = "\
[model]
kind = \"catenaries\"

[ply]
grippers = [2, 2]
cell = [\"100 mm\", \"100 mm\"]
material = \"krogh2018\"
thickness = \"0.3 mm\"

[grippers]
spacing = [\"98 mm\", \"98 mm\"]
height = \"75 mm\"

[target]
origin = [0, 0]
";

/// Every file of a folder, hidden ones too.
fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    entries.filter_map(|path| Some((path.clone(), fs::read(path).ok()?))).collect()
}

/// A folder `out` into which a command shall write, with one of its inputs under the name of a file that it writes.
struct Case {
    home: tempfile::TempDir,
    /// The command line, with `-o out` behind it.
    arguments: Vec<String>,
}

/// A scene in which the file of one `key` is called `name`.
fn scene(home: &Path, key: &str, name: &str) -> String {
    let files =
        [("material", MATERIAL, "m.toml"), ("mold", MOLD, "m.obj"), ("positions", POSITIONS, "p")];
    let mut scene = SCENE.to_owned();
    for (other, content, usual) in files {
        // by its ending it is known what a file is, so that one of another name is a link
        let path = home.join(usual);
        if other == key {
            std::os::unix::fs::symlink(home.join(name), &path).unwrap();
        }
        fs::write(if other == key { home.join(name) } else { path.clone() }, content).unwrap();
        scene = scene.replace(&format!("{{{other}}}"), path.to_str().unwrap());
    }
    let path = if key == "scene" { name } else { "scene.toml" };
    fs::write(home.join(path), scene).unwrap();
    path.into()
}

/// A drape in `run`, of an array on a robot with axes along z.
fn drape(home: &Path) {
    let more = "[mold]\nkind = \"plane\"\n\n[motion]\nkind = \"straight\"\nsteps = 5\n\n\
                [tool]\naxes = [{ direction = \"z\", stroke = [-0.1, 0.1] }]\n";
    fs::write(home.join("ply.toml"), format!("{PLY}\n{more}")).unwrap();
    let mut simulate = command();
    simulate.args(["simulate", "ply.toml", "--quiet", "-o", "run"]).current_dir(home);
    let draped = simulate.output().unwrap();
    assert!(draped.stderr.is_empty(), "{}", text(&draped.stderr));
}

/// A plan in `run`.
fn plan(home: &Path) {
    let more = "[mold]\nkind = \"plane\"\n\n[plan]\nsteps = 30\nevaluations = 1\n";
    fs::write(home.join("ply.toml"), format!("{PLY}\n{more}")).unwrap();
    let mut plan = command();
    plan.args(["plan", "ply.toml", "--without-errors", "--quiet", "-o", "run"]);
    let planned = plan.current_dir(home).output().unwrap();
    assert!(planned.stderr.is_empty(), "{}", text(&planned.stderr));
}

impl Case {
    /// `input` of `command` under the name of one of its outputs.
    fn new(command: &str, input: &str, output: &str) -> Case {
        let home = tempfile::tempdir().unwrap();
        let (path, place) = (home.path(), format!("out/{output}"));
        fs::create_dir(path.join("out")).unwrap();
        let line: String = match (command, input) {
            ("replan", "result") => {
                plan(path);
                fs::rename(path.join("run/result.json"), path.join(&place)).unwrap();
                fs::write(path.join("pick.toml"), OFFSET).unwrap();
                format!("replan {place} --picked pick.toml")
            }
            ("replan", _) => {
                plan(path);
                fs::write(path.join(&place), OFFSET).unwrap();
                format!("replan run --picked {place}")
            }
            ("plan book", "book") => {
                fs::write(path.join("out/ply.toml"), PLY).unwrap();
                fs::write(path.join(&place), BOOK.replace("{ply}", "ply.toml")).unwrap();
                format!("plan {place}")
            }
            ("plan book", _) => {
                fs::write(path.join(&place), PLY).unwrap();
                fs::write(
                    path.join("book.toml"),
                    BOOK.replace("{ply}", path.join(&place).to_str().unwrap()),
                )
                .unwrap();
                "plan book.toml".into()
            }
            ("report" | "export --even-if-rejected --to csv", _) => {
                drape(path);
                fs::rename(path.join("run/result.json"), path.join(&place)).unwrap();
                format!("{command} {place}")
            }
            (_, key) => format!("{command} {}", scene(path, key, &place)),
        };
        let arguments = line.split(' ').chain(["-o", "out"]).map(str::to_owned).collect();
        Case { home, arguments }
    }
}

/// Every command, every kind of file that it reads, and names of files that it writes.
#[test]
fn no_command_replaces_a_file_that_it_reads() {
    let scene = ["scene", "material", "mold", "positions"];
    let pairs: [(&str, &[&str], &[&str]); 9] = [
        ("simulate", &scene, &["result.json", "report.html"]),
        ("plan", &scene, &["plan.json", "motion.csv"]),
        ("plan --compare", &scene, &["comparison.csv"]),
        ("net", &["scene", "material", "mold"], &["nodes.csv"]),
        ("check --html", &scene, &["check.html"]),
        ("replan", &["result", "pick"], &["result.json", "steps.csv"]),
        ("plan book", &["book", "ply"], &["book.json", "report.html"]),
        ("report", &["result"], &["report.html"]),
        ("export --even-if-rejected --to csv", &["result"], &["steps.csv"]),
    ];
    for (name, inputs, outputs) in pairs {
        for (input, output) in
            inputs.iter().flat_map(|input| outputs.iter().map(move |output| (input, output)))
        {
            let Case { home, arguments } = Case::new(name, input, output);
            let before = contents(&home.path().join("out"));
            let run = command().args(&arguments).current_dir(home.path()).output().unwrap();
            let message = one_line(&run.stderr);
            assert_eq!(run.status.code(), Some(2), "{arguments:?}, {input}: {message}");
            let wanted = format!("out/{output} is read by this run");
            assert!(message.contains(&wanted), "{arguments:?}, {input}: {message}");
            assert_eq!(contents(&home.path().join("out")), before, "{arguments:?}, {input}");
        }
    }
}

/// A fit writes into a new file alone, and a template can be a link to a file that an export wrote.
#[test]
fn tables_of_tests_and_templates_are_not_replaced_either() {
    let home = tempfile::tempdir().unwrap();
    let table = home.path().join("hang.csv");
    fs::write(&table, "overhang (mm)\n100\n101\n99\n").unwrap();
    let fit = ["fit", "overhang", "--mass", "314 g/m^2", "--warp", "hang.csv", "-o", "hang.csv"];
    let run = command().args(fit).current_dir(home.path()).output().unwrap();
    assert_eq!(run.status.code(), Some(2), "{}", text(&run.stderr));
    assert!(one_line(&run.stderr).contains("it exists"), "{}", text(&run.stderr));
    assert_eq!(fs::read_to_string(&table).unwrap(), "overhang (mm)\n100\n101\n99\n");

    drape(home.path());
    let export = |more: &[&str]| {
        let mut export = command();
        export.args(["export", "run", "--to", "rapid", "--even-if-rejected", "-o", "out"]);
        export.args(more).current_dir(home.path()).output().unwrap()
    };
    let run = export(&[]);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    let before = contents(&home.path().join("out"));
    let module = before.keys().find(|path| path.extension().is_some_and(|e| e == "mod"));
    std::os::unix::fs::symlink(module.unwrap(), home.path().join("cell.mod.j2")).unwrap();
    let run = export(&["--template", "cell.mod.j2"]);
    assert_eq!(run.status.code(), Some(2));
    assert!(one_line(&run.stderr).contains("is read by this run"), "{}", text(&run.stderr));
    assert_eq!(contents(&home.path().join("out")), before);
}

/// By whatever path its folder is named.
#[test]
fn a_plan_is_not_replaced_by_its_own_correction() {
    let home = tempfile::tempdir().unwrap();
    plan(home.path());
    let run = home.path().join("run");
    fs::write(home.path().join("pick.toml"), OFFSET).unwrap();
    std::os::unix::fs::symlink(&run, home.path().join("link")).unwrap();
    let before = contents(&run);
    for (folder, result, output) in [
        (".", "run", "run"),
        (".", "run/result.json", "link"),
        (".", "link", "run/../run/"),
        ("run", ".", "."),
        ("run", "../link", run.to_str().unwrap()),
    ] {
        let pick = home.path().join("pick.toml");
        let mut replan = command();
        replan.args(["replan", result, "--picked", pick.to_str().unwrap(), "-o", output]);
        let refused = replan.current_dir(home.path().join(folder)).output().unwrap();
        let message = one_line(&refused.stderr);
        assert_eq!(refused.status.code(), Some(2), "{result} {output}: {message}");
        assert!(message.contains("result.json is read by this run"), "{message}");
        assert_eq!(contents(&run), before, "{result} {output}");
    }
}

/// A ply over a dome that is decided on at once, or improved without an end.
fn improved(home: &Path, position: &str) -> PathBuf {
    let dome = "\n[mold]\nkind = \"sphere\"\nradius = \"1 m\"\nposition = [0.05, 0.05, -1]\n";
    let path = home.join("dome.toml");
    let limits = format!("\n[limits]\nposition = \"{position}\"\n");
    let plan = "[plan]\nsteps = 12\nevaluations = 1000000\n";
    fs::write(&path, format!("{PLY}{dome}{limits}{plan}")).unwrap();
    path
}

/// An accepted plan, then a rerun that is ended in its first second: it writes beside, once more beside that, and says where.
#[test]
fn an_interrupted_rerun_leaves_an_accepted_plan_as_it_was() {
    let home = tempfile::tempdir().unwrap();
    let accepted = improved(home.path(), "50 mm");
    let first = command().arg("plan").arg(&accepted).arg("--quiet").output().unwrap();
    assert_eq!(first.status.code(), Some(0), "{}", text(&first.stderr));
    let out = home.path().join("dome.plan");
    let before = contents(&out);

    let hopeless = improved(home.path(), "1 um");
    for wanted in ["dome.plan.interrupted", "dome.plan.interrupted"] {
        let mut plan = command();
        plan.arg("plan").arg(&hopeless).args(["--improve", "--quiet"]);
        let child = plan.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        std::thread::sleep(std::time::Duration::from_millis(800));
        let kill = Command::new("kill").args(["-INT", &child.id().to_string()]).status();
        assert!(kill.unwrap().success());
        let ended = child.wait_with_output().unwrap();
        assert_eq!(ended.status.code(), Some(130), "{}", text(&ended.stderr));
        let said = one_line(&ended.stderr);
        assert!(said.contains("dome.plan holds is no worse and stays"), "{said}");
        assert!(said.contains(wanted), "{said}");
        assert_eq!(contents(&out), before);
        assert!(home.path().join(wanted).join("result.json").is_file());
    }
}
