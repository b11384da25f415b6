use super::*;
use crate::result::sheet;
use crate::scene;
use crate::write::csv;
use plydrape::layup::{Model, Release, ReleaseOrder};
use plydrape::motion::TimedMotion;
use plydrape::planner::PlanRecord;
use plydrape::scene::{PlanMethod, Scene};
use plydrape::sheet::{ClothState, SheetTuning};
use std::collections::HashMap;
use std::ops::ControlFlow;
use std::path::Path;

/// Stiffness of the mounts along x, y and z (N/m).
const STIFFNESS: [f64; 3] = [2e3, 2e3, 5e3];

/// A ply of 3 × 3 grippers over a dome, in six steps, with more keys of its grippers and its sheet.
fn dome(grippers: &str, keep: usize) -> Scene {
    let text = format!(
        "[ply]\ngrippers = [3, 3]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
        [mold]\nkind = \"sphere\"\nradius = 0.6\nposition = [0, 0, -0.6]\n\
        [grippers]\nspacing = [0.098, 0.098]\nheight = 0.04\norigin = \"centered\"\n{grippers}\n\
        [target]\nseed = \"middle\"\n[motion]\nkind = \"straight\"\nsteps = 6\n\
        [model]\nkind = \"sheet\"\n[sheet]\nmesh = 0.05\nkeep = {keep}\n"
    );
    scene::parse(&text, Path::new("."), "dome").unwrap_or_else(|fault| panic!("{fault}")).scene
}

const MOUNTS: &str = "stiffness = { lateral = \"2 N/mm\", axial = \"5 N/mm\" }";

/// The result of a scene by the model that it names, with its states in a folder that lives as long.
fn draped(scene: &Scene) -> (ResultFile, tempfile::TempDir) {
    let dir = tempfile::tempdir().unwrap();
    let model = scene.layup.settings.model;
    let drape = sheet::drape(scene, model, dir.path(), &|| false, |_| {}).unwrap();
    (ResultFile::new(scene, None, drape), dir)
}

/// All states of the sheet of a scene.
fn states(scene: &Scene) -> Vec<ClothState> {
    let mut seen = Vec::new();
    let see = |_: &_, state: &ClothState, _| {
        seen.push(state.clone());
        ControlFlow::Continue(())
    };
    plydrape::sheet::drape(&scene.layup, SheetTuning::default(), &|| false, see).unwrap();
    seen
}

/// The rows of a table, by the names of its columns; an empty field is none.
fn rows(text: &str) -> Vec<HashMap<String, Option<f64>>> {
    let mut reader = ::csv::Reader::from_reader(text.as_bytes());
    reader
        .deserialize()
        .map(|row| {
            let row: HashMap<String, String> = row.unwrap();
            row.into_iter().map(|(name, field)| (name, field.parse().ok())).collect()
        })
        .collect()
}

/// Three columns of a row.
fn vector(row: &HashMap<String, Option<f64>>, name: &str, unit: &str) -> [f64; 3] {
    ["x", "y", "z"].map(|c| row[&format!("{name} {c} ({unit})")].expect("a number"))
}

/// F = −k (p + s) with the stiffness of the same row; 1e-9 N is rounding of forces of newtons.
fn is_spring(row: &HashMap<String, Option<f64>>, slip: [f64; 3]) {
    let (load, preload) = (vector(row, "load", "N"), vector(row, "preload", "mm"));
    let [lateral, axial] =
        ["lateral", "axial"].map(|k| row[&format!("{k} stiffness (N/mm)")].unwrap());
    for (c, k) in [lateral, lateral, axial].into_iter().enumerate() {
        assert!((k * 1e3 - STIFFNESS[c]).abs() < 1e-9);
        let expected = -k * (preload[c] + 1e3 * slip[c]);
        assert!((load[c] - expected).abs() < 1e-9, "axis {c}: {} N, {expected} N", load[c]);
    }
}

/// Whether a vector is written as it is, but for components that are rounding beside the largest one, which are written as 0.
fn is_written_as(written: [f64; 3], vector: [f64; 3]) -> bool {
    let rounding = f64::EPSILON * vector.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    written.iter().zip(vector).all(|(a, b)| *a == b || *a == 0.0 && b.abs() <= rounding)
}

/// At every step the loads are the forces of the state, and the springs of the mounts give them, also where fabric has slid.
#[test]
fn loads_at_the_steps_are_the_forces_of_the_states_and_of_the_springs() {
    let scene = dome(&format!("{MOUNTS}\nslip_force = \"0.3 N\""), 60);
    let (result, _dir) = draped(&scene);
    let (states, rows) = (states(&scene), rows(&csv::trajectory(&result).unwrap()));
    assert_eq!((states.len(), rows.len()), (6, 54));
    for (n, row) in rows.iter().enumerate() {
        let (state, gripper) = (&states[n / 9], n % 9);
        assert_eq!(row["t (s)"], Some(state.time));
        assert!(is_written_as(vector(row, "load", "N"), state.forces[gripper]), "{row:?}");
        let pad = &state.pads[gripper];
        let place = ["x (m)", "y (m)", "z (m)"].map(|c| row[c].unwrap());
        assert!(is_written_as(place, pad.target), "{row:?}");
        is_spring(row, pad.slip);
    }
    let slid = states[5].pads.iter().filter(|pad| pad.slip != [0.0; 3]).count();
    assert!(slid > 0, "no fabric has slid, so that nothing was tried");
}

/// Between two steps, loads and preload lie on a line, however few states of the sheet were kept; after the last step nothing is known.
#[test]
fn loads_go_on_linearly_between_the_steps() {
    let (result, _dir) = draped(&dome(MOUNTS, 2));
    let loads = Loads::new(&result).unwrap();
    assert_eq!(loads.times.len(), 6);
    let [start, end] = [3, 4].map(|n| result.steps[n].time);
    let [first, last] = [start, end].map(|t| loads.interpolate(t).unwrap());
    assert!(first == loads.steps[3] && last == loads.steps[4] && first != last);
    let third = loads.interpolate(start + 0.3 * (end - start)).unwrap();
    for ((a, b), found) in first.iter().zip(&last).zip(&third) {
        for c in 0..3 {
            let line = |a: f64, b: f64| a + 0.3 * (b - a);
            assert!((found.force[c] - line(a.force[c], b.force[c])).abs() < 1e-12);
            assert!((found.preload[c] - line(a.preload[c], b.preload[c])).abs() < 1e-15);
        }
    }
    assert_eq!(loads.interpolate(result.steps[5].time + 1e-3), None);
}

/// A scene of the dome along a planned motion, and that plan.
fn planned() -> (Scene, TimedMotion, PlanRecord) {
    let mut scene = dome(MOUNTS, 60);
    let path = scene.layup.motion.positions.clone();
    let motion = TimedMotion::new(&path, &scene.limits.motion_bounds()).unwrap();
    let record = PlanRecord::new(PlanMethod::Path, 1, 20.0, path, &motion, Vec::new());
    scene.layup.motion.times = motion.times().to_vec();
    (scene, motion, record)
}

/// A plan's motion: at each of its samples the springs give the loads, the last ones are those of the last state, and a scene
/// follows the table as without these columns.
#[test]
fn motion_csv_has_the_loads_of_the_springs_at_every_sample() {
    let (scene, motion, record) = planned();
    let rate = record.rate;
    let (mut result, dir) = draped(&scene);
    result.plan = Some(record);
    let table = csv::planned_motion(&result).unwrap().expect("a plan");
    let rows = rows(&table);
    for row in &rows {
        is_spring(row, [0.0; 3]);
    }
    let mut file = result.sheet_states.as_ref().unwrap().open().unwrap();
    let last = file.state(5).unwrap().unwrap();
    for (row, force) in rows[rows.len() - 9..].iter().zip(last.pad_forces.iter()) {
        assert_eq!(vector(row, "load", "N"), csv::without_rounding(*force));
    }

    std::fs::write(dir.path().join("motion.csv"), &table).unwrap();
    let text = "[ply]\ngrippers = [3, 3]\ncell = [0.12, 0.12]\nmaterial = \"krogh2018\"\n\
        [motion]\nkind = \"file\"\nfile = \"motion.csv\"\n[model]\nkind = \"catenaries\"\n";
    let follows = scene::parse(text, dir.path(), "scene").unwrap_or_else(|e| panic!("{e}")).scene;
    let mut sampled = motion.sampled(rate).unwrap();
    for place in sampled.positions.iter_mut().flatten() {
        *place = csv::without_rounding(*place);
    }
    assert_eq!(follows.layup.motion, sampled);
}

/// Rigid grippers have loads by either model, and no preload.
#[test]
fn rigid_grippers_have_loads_and_no_preload() {
    let mut scene = dome("", 2);
    // at the start, where nothing lies, they carry the ply; catenaries spread its weight over their run of 98 mm instead of 100 mm
    let weight = 0.3143 / 0.1 * 0.2 * 0.2 * scene.layup.settings.gravity;
    for (model, share) in [(Model::Sheet, 1.0), (Model::Catenaries, 0.98)] {
        scene.layup.settings.model = model;
        let (result, _dir) = draped(&scene);
        let table = csv::trajectory(&result).unwrap();
        let header = "t (s),gripper,x (m),y (m),z (m),qx,qy,qz,qw,load x (N),load y (N),load z (N)";
        assert_eq!(table.lines().next(), Some(header), "{model:?}");
        let carried: f64 = rows(&table)[..9].iter().map(|row| -vector(row, "load", "N")[2]).sum();
        assert!((carried / (share * weight) - 1.0).abs() < 1e-3, "{model:?} {carried} {weight}");
    }
}

/// Where pads let go, both tables have a column for the vacuum and end with the release: loads stay as they are while pads press,
/// and are nothing from the release on. Without its column and the rows after the motion, the table is that of pads that hold.
#[test]
fn tables_switch_the_vacuum_at_the_release() {
    let (mut scene, motion, record) = planned();
    let (mut held, _kept) = draped(&scene);
    held.plan = Some(record.clone());
    let dwell = 0.31;
    scene.layup.release = Some(Release::new(ReleaseOrder::End, dwell));
    let (mut result, _dir) = draped(&scene);
    result.plan = Some(record);
    let end = motion.duration();
    let all = |table: fn(&ResultFile) -> String| [&held, &result].map(table);
    let tables = [
        (all(|result| csv::trajectory(result).unwrap()), 1),
        // twenty a second, and the release itself
        (all(|result| csv::planned_motion(result).unwrap().unwrap()), 7),
    ];
    for ([held, released], more) in tables {
        let (before, now) = (rows(&held), rows(&released));
        assert_eq!(now.len(), before.len() + 9 * more);
        let same: String = released
            .lines()
            .take(before.len() + 1)
            .map(|line| line.rsplit_once(',').unwrap().0.to_owned() + "\n")
            .collect();
        assert_eq!(same, held);
        for row in &now {
            let (time, load) = (row["t (s)"].unwrap(), vector(row, "load", "N"));
            let on = time < end + dwell;
            assert_eq!(row["vacuum"], Some(if on { 1.0 } else { 0.0 }), "{time}");
            assert!(on || load == [0.0; 3], "{time}: {load:?}");
        }
        assert!(now.is_sorted_by_key(|row| row["t (s)"]));
        let last: Vec<_> = now.iter().rev().take(9).collect();
        assert!(last.iter().all(|row| row["t (s)"] == Some(end + dwell)));
        // grippers stand, and bear what they bore, until they let go
        for row in now[before.len()..].iter().filter(|row| row["vacuum"] == Some(1.0)) {
            let twin = before
                .iter()
                .rev()
                .take(9)
                .find(|twin| ["x (m)", "y (m)"].iter().all(|name| twin[*name] == row[*name]));
            let twin = twin.expect("it stands where the motion ends");
            let [load, same] = [row, twin].map(|row| vector(row, "load", "N"));
            for c in 0..3 {
                assert!((load[c] - same[c]).abs() < 1e-12, "{load:?} {same:?}");
            }
        }
    }
}
