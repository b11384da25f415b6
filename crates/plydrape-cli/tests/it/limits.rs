//! Limits of a motion that a file gives: judged at every door, so that nothing drives a machine which they refuse.

use crate::common::{command, one_line, text};
use serde_json::Value;
use std::path::{Path, PathBuf};
use std::process::Output;

const SCENE: &str = "\
[ply]
grippers = [2, 2]
cell = [\"100 mm\", \"100 mm\"]
material = \"prepreg_warm\"

[mold]
kind = \"plane\"

[motion]
kind = \"file\"
file = \"motion.csv\"

[sheet]
mesh = \"25 mm\"
";

/// A scene with more tables along a motion of some rows: a time in the file, and where the first gripper is (m); the others are beside it,
/// turned (°) about it.
fn scene(folder: &Path, more: &str, time: &str, rows: &[(f64, [f64; 3], f64)]) -> PathBuf {
    let mut csv = format!("{time},gripper,x (m),y (m),z (m)\n");
    for (t, [x, y, z], turn) in rows {
        let (s, c) = turn.to_radians().sin_cos();
        for (i, j) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
            let [u, v] = [0.098 * f64::from(i), 0.098 * f64::from(j)];
            csv += &format!("{t},g{i}_{j},{},{},{z}\n", x + c * u - s * v, y + s * u + c * v);
        }
    }
    std::fs::write(folder.join("motion.csv"), csv).unwrap();
    let file = folder.join("scene.toml");
    std::fs::write(&file, format!("{SCENE}{more}")).unwrap();
    file
}

fn simulate(scene: &Path, model: &str) -> (Output, PathBuf) {
    let out = scene.with_file_name(model);
    let output =
        command().arg("simulate").arg(scene).args(["--model", model, "-o"]).arg(&out).output();
    (output.unwrap(), out)
}

fn verdict(out: &Path, name: &str) -> Value {
    let result = std::fs::read(out.join("result.json")).unwrap();
    let result: Value = serde_json::from_slice(&result).unwrap();
    let limits = result["summary"]["limits"].as_array().unwrap();
    limits.iter().find(|verdict| verdict["name"] == name).unwrap_or(&Value::Null).clone()
}

/// 1 m aside within 0.5 s and back is 2 m/s, by every model, and no program, table or bag is written of it.
#[test]
fn a_motion_from_a_file_is_refused_by_its_speed() {
    let home = tempfile::tempdir().unwrap();
    let rows =
        [(0.0, [0.0, 0.0, 0.05], 0.0), (0.5, [1.0, 0.0, 0.05], 0.0), (1.0, [0.0, 0.0, 0.05], 0.0)];
    let scene = scene(home.path(), "[limits]\nspeed = \"0.1 m/s\"\n", "t (s)", &rows);
    for model in ["sheet", "catenaries"] {
        let (output, out) = simulate(&scene, model);
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        let speed = verdict(&out, "speed");
        assert_eq!(
            (&speed["value"], &speed["ok"], &speed["step"]),
            (&2.0.into(), &false.into(), &2.into())
        );
        for (name, value) in [("acceleration", 8.0), ("jerk", 48.0)] {
            let found = verdict(&out, name)["value"].as_f64().unwrap();
            assert!((found - value).abs() < 1e-9, "{name} {found}");
        }
        for format in ["rapid", "krl", "urscript", "csv", "ros2"] {
            let export = command().args(["export", "--to", format]).arg(&out).output().unwrap();
            assert_eq!(export.status.code(), Some(2), "{format}");
            let said = one_line(&export.stderr);
            assert!(
                said.contains("speed 2 m/s against 0.1 m/s") && said.contains("help:"),
                "{said}"
            );
            assert!(!out.join(format).exists());
        }
    }
}

/// A ply that never touches the mold is in transport all the time: the limits of the transport count, those of the drape do not, and a limit that the transport has not
/// is that of the whole motion.
#[test]
fn the_transport_is_judged_by_its_own_limits() {
    let home = tempfile::tempdir().unwrap();
    let rows =
        [(0.0, [0.0, 0.0, 0.05], 0.0), (0.5, [1.0, 0.0, 0.05], 0.0), (1.0, [0.0, 0.0, 0.05], 0.0)];
    for (limit, ok) in [(3, true), (1, false)] {
        let limits = format!("[limits]\nspeed = \"0.1 m/s\"\ntransport_speed = \"{limit} m/s\"\n");
        let (_, out) = simulate(&scene(home.path(), &limits, "t (s)", &rows), "sheet");
        let found = ["speed", "transport_speed", "acceleration"].map(|name| {
            let found = verdict(&out, name);
            (found["value"].as_f64().unwrap(), found["ok"].as_bool().unwrap())
        });
        assert_eq!(found, [(0.0, true), (2.0, ok), (8.0, false)]);
    }
}

/// 60° within 0.5 s are 120 °/s. In 5 s they are 12 °/s, and from rest to rest over three steps they need 2·12/2.5 °/s² at least.
#[test]
fn a_tool_turns_as_fast_as_its_motion_from_a_file() {
    let home = tempfile::tempdir().unwrap();
    let tool = "[tool]\nturn_rate = \"30 deg/s\"\nturn_acceleration = \"40 deg/s^2\"\n";
    for (step, rate, acceleration, ok) in [(0.5, 120.0, 480.0, false), (5.0, 12.0, 4.8, true)] {
        let rows =
            [0.0, 1.0, 2.0].map(|k| (k * step, [0.0, 0.0, 0.05], 60.0 * f64::from(k == 1.0)));
        let (_, out) = simulate(&scene(home.path(), tool, "t (s)", &rows), "catenaries");
        let found = verdict(&out, "tool_turn_rate");
        assert!(
            (found["value"].as_f64().unwrap() - rate).abs() < 1e-6 && found["ok"] == ok,
            "{found}"
        );
        let found = verdict(&out, "tool_turn_acceleration");
        let value = found["value"].as_f64().unwrap();
        assert!((value - acceleration).abs() < 1e-6 && found["ok"] == ok, "{found}");
    }
}

/// A ply that is lifted by 10 mm a step from rest; in milliseconds, whole numbers.
fn lifted(step: f64) -> Vec<(f64, [f64; 3], f64)> {
    [0.0, 1.0, 2.0].map(|k| (k * step, [0.0, 0.0, 0.05 + 0.01 * k], 0.0)).to_vec()
}

/// A robot's program would have a time of 0.000000 s.
#[test]
fn steps_that_no_program_can_tell_apart_are_refused() {
    let home = tempfile::tempdir().unwrap();
    let mut rows = lifted(1.0);
    rows[1].0 = 1e-12;
    let (output, _) = simulate(&scene(home.path(), "", "t (s)", &rows), "catenaries");
    assert_eq!(output.status.code(), Some(2));
    let said = one_line(&output.stderr);
    assert!(
        said.contains("the time rises by 1.0e-12 s") && said.contains("1e-6 s at least"),
        "{said}"
    );
    rows[1].0 = 1e-6;
    let (output, out) = simulate(&scene(home.path(), "", "t (s)", &rows), "catenaries");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(verdict(&out, "speed")["ok"], false);
}

/// 10 mm in 1000 is 10 mm/s in milliseconds and 0.01 mm/s in seconds. Whoever names one of both is believed.
#[test]
fn times_that_look_like_milliseconds_are_asked_about() {
    let home = tempfile::tempdir().unwrap();
    let rows = lifted(1000.0);
    let (output, _) = simulate(&scene(home.path(), "", "t", &rows), "catenaries");
    assert_eq!(output.status.code(), Some(2));
    let said = one_line(&output.stderr);
    assert!(said.contains("no gripper would be faster than 1e-2 mm/s"), "{said}");
    assert!(said.contains("did you mean ms?") && said.contains("`t (ms)` or `t (s)`"), "{said}");
    for (header, speed) in [("t (ms)", 1e-2), ("t (s)", 1e-5)] {
        let (_, out) = simulate(&scene(home.path(), "", header, &rows), "catenaries");
        let found = verdict(&out, "speed")["value"].as_f64().unwrap();
        assert!((found / speed - 1.0).abs() < 1e-9, "{header} {found}");
    }
    // who gives seconds is not asked
    let (output, _) = simulate(&scene(home.path(), "", "t", &lifted(1.0)), "catenaries");
    assert_ne!(output.status.code(), Some(2), "{}", text(&output.stderr));
}

/// Catenaries know no height: a scene that limits it is not accepted by them, whatever else holds, and the verdict says why.
#[test]
fn a_limit_that_was_not_judged_accepts_nothing() {
    let home = tempfile::tempdir().unwrap();
    let limits = "[limits]\nheight = \"80 mm\"\n";
    let file = scene(home.path(), limits, "t (s)", &lifted(1.0));
    let (output, out) = simulate(&file, "catenaries");
    assert_eq!(output.status.code(), Some(1));
    let height = verdict(&out, "height");
    assert_eq!((&height["judged"], &height["ok"]), (&false.into(), &false.into()));
    let said = text(&output.stdout);
    assert!(said.contains("not judged: the sheet alone measures it"), "{said}");
    // without that limit nothing else refuses it
    let (output, out) = simulate(&scene(home.path(), "", "t (s)", &lifted(1.0)), "catenaries");
    assert_eq!(
        (output.status.code(), verdict(&out, "height")),
        (Some(0), Value::Null),
        "{}",
        text(&output.stdout)
    );
}
