use super::*;
use crate::Error;
use crate::store::folder::{Content, Folder};
use std::fs;
use std::path::Path;
use std::process::Command;

/// A sheet of this many nodes in a row along u and along v, flat, held by four grippers.
fn mesh(nu: usize, nv: usize) -> SheetMesh<'static> {
    let node = |i: usize, j: usize| (i + j * nu) as u32;
    let cells = || (0..nv - 1).flat_map(|j| (0..nu - 1).map(move |i| (i, j)));
    let along_u = (0..nv).flat_map(|j| (0..nu - 1).map(move |i| [node(i, j), node(i + 1, j)]));
    let along_v = (0..nv - 1).flat_map(|j| (0..nu).map(move |i| [node(i, j), node(i, j + 1)]));
    SheetMesh {
        places: (0..nv)
            .flat_map(|j| (0..nu).map(move |i| [0.01 * i as f64, 0.01 * j as f64]))
            .collect(),
        areas: vec![1e-4; nu * nv].into(),
        segments: along_u.chain(along_v).collect(),
        cells: cells()
            .map(|(i, j)| [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)])
            .collect(),
        grippers: 4,
        releases: false,
    }
}

/// State in a step, with numbers that differ from node to node.
fn state(mesh: &SheetMesh, step: u32) -> SheetState<'static> {
    let t = f64::from(step);
    let nodes = mesh.places.len();
    SheetState {
        step,
        time: 0.1 * t,
        positions: mesh.places.iter().map(|[u, v]| [*u, *v, (u * t).sin() + v]).collect(),
        height: (0..nodes).map(|n| if n % 3 == 0 { f64::NAN } else { 1e-3 / t }).collect(),
        contact: (0..nodes).map(|n| n % 2 == 0).collect(),
        shear: (0..mesh.cells.len()).map(|n| (n as f64 + t).cos()).collect(),
        tension: (0..mesh.segments.len()).map(|n| n as f64 - t).collect(),
        grippers: vec![[t, 2.0 * t, 3.0 * t]; mesh.grippers].into(),
        pad_forces: vec![[0.1, -0.2, t]; mesh.grippers].into(),
        pad_rotation: vec![[0.0, 0.6, 0.0, 0.8]; mesh.grippers].into(),
        pad_holds: mesh.releases.then(|| (0..mesh.grippers as u32).map(|n| n >= step).collect()),
    }
}

/// The finished file of this many states.
fn finished(dir: &Path, mesh: &SheetMesh<'static>, states: u32) -> SheetFile {
    let landed: Vec<u32> = (0..mesh.places.len() as u32).map(|n| n % (states + 1)).collect();
    let states: Vec<_> = (1..=states).map(|step| state(mesh, step)).collect();
    SheetFile::new(dir, mesh, &landed, &states).unwrap()
}

/// A file with any bytes, and the seal that fits them.
fn forged(dir: &Path, bytes: &[u8]) -> Result<SheetStates, Error> {
    fs::write(dir.join(NAME), bytes).unwrap();
    SheetStates::open(dir, &SheetSeal::read(bytes).unwrap())
}

/// Comparable with a NaN: the numbers as text.
fn shown(state: &SheetState) -> String {
    format!("{state:?}")
}

#[test]
fn states_that_are_read_are_those_that_were_written() {
    let dir = tempfile::tempdir().unwrap();
    let mesh = mesh(4, 3);
    let file = finished(dir.path(), &mesh, 5);
    let folder = dir.path().join("out");
    let claim = Folder::claim(&folder, "simulate", &[]).unwrap();
    claim.write(&[(NAME, &file as &dyn Content)]).unwrap();
    let mut states = SheetStates::open(&folder, file.seal()).unwrap();
    assert_eq!((states.states(), states.mesh()), (5, &mesh));
    assert_eq!(states.landing_step()[..7], [0, 1, 2, 3, 4, 5, 0]);
    for n in [4, 0, 2] {
        let found = states.state(n).unwrap().unwrap();
        assert_eq!(shown(&found), shown(&state(&mesh, n as u32 + 1)));
    }
    assert!(states.state(5).unwrap().is_none());
}

/// A sheet whose pads let go has one array more; states that do not say which pads hold are none of it, and the other way round.
#[test]
fn states_say_which_pads_hold_where_some_let_go() {
    let dir = tempfile::tempdir().unwrap();
    let (held, released) = (mesh(4, 3), SheetMesh { releases: true, ..mesh(4, 3) });
    let file = finished(dir.path(), &released, 3);
    let mut states = SheetStates::open(file.path().parent().unwrap(), file.seal()).unwrap();
    assert_eq!(states.mesh(), &released);
    for n in 0..3 {
        let found = states.state(n).unwrap().unwrap();
        assert_eq!(shown(&found), shown(&state(&released, n as u32 + 1)));
        let expected: Vec<bool> = (0..4).map(|pad| pad > n).collect();
        assert_eq!(found.pad_holds.as_deref(), Some(&expected[..]));
    }
    for (mesh, other) in [(&held, &released), (&released, &held)] {
        let refused = SheetFile::new(dir.path(), mesh, &[0; 12], &[state(other, 1)]).unwrap_err();
        assert!(refused.to_string().contains("pad_holds"), "{refused}");
    }
}

/// NumPy of the Python tests, where it is installed: names, types, shapes and numbers.
#[test]
fn numpy_reads_every_array() {
    const CHECK: &str = r#"
import sys
import numpy as np
found = np.load(sys.argv[1])
shapes = dict(
    places=(12, 2), areas=(12,), segments=(17, 2), cells=(6, 4), landing_step=(12,), step=(5,), time=(5,),
    positions=(5, 12, 3), height=(5, 12), contact=(5, 12), shear=(5, 6), tension=(5, 17), grippers=(5, 4, 3),
    pad_forces=(5, 4, 3), pad_rotation=(5, 4, 4),
)
assert {name: found[name].shape for name in found.files} == shapes
whole = {"segments", "cells", "landing_step", "step"}
for name in found.files:
    kind = np.int32 if name in whole else np.bool_ if name == "contact" else np.float64
    assert found[name].dtype == kind, name
t, (u, v) = found["step"][:, None], found["places"].T
assert (t[:, 0] == [1, 2, 3, 4, 5]).all() and np.allclose(found["time"], 0.1 * t[:, 0])
assert np.allclose(found["positions"][..., 2], np.sin(u * t) + v)
assert np.array_equal(np.isnan(found["height"]), np.tile(np.arange(12) % 3 == 0, (5, 1)))
assert np.array_equal(found["tension"], np.arange(17) - t)
"#;
    let Some(python) = std::env::var_os("PLYDRAPE_PYTHON") else {
        eprintln!("SKIPPED: PLYDRAPE_PYTHON names no Python with NumPy");
        return;
    };
    let dir = tempfile::tempdir().unwrap();
    let file = finished(dir.path(), &mesh(4, 3), 5);
    let run = Command::new(python).arg("-c").arg(CHECK).arg(file.path()).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
}

/// Also the archive's dates and the order of its arrays are always the same.
#[test]
fn the_same_states_are_the_same_bytes() {
    let dir = tempfile::tempdir().unwrap();
    let [one, other] = [0; 2].map(|_| finished(dir.path(), &mesh(4, 3), 3));
    assert_eq!(fs::read(one.path()).unwrap(), fs::read(other.path()).unwrap());
    assert_eq!(one.seal(), other.seal());
}

/// Counted by hand: 31 by 31 nodes, 900 cells, 1 860 segments and 16 grippers in 90 states are 4.86 MB.
#[test]
fn the_sheet_of_the_dome_takes_less_than_ten_megabytes() {
    let dir = tempfile::tempdir().unwrap();
    let mesh = SheetMesh { grippers: 16, ..mesh(31, 31) };
    let length = finished(dir.path(), &mesh, 90).seal().length;
    let state = 12 + 961 * (24 + 8 + 1) + 900 * 8 + 1860 * 8 + 16 * (24 + 24 + 32);
    let fixed = 961 * (16 + 8 + 4) + 1860 * 8 + 900 * 16;
    let arrays = 90 * state as u64 + fixed as u64;
    assert!((arrays..arrays + 6_000).contains(&length) && length < 10_000_000, "{length}");
}

/// A file is in a hidden folder of its own, which goes with it; states that are refused leave nothing.
#[test]
fn hidden_folders_are_gone_after_success_and_after_failure() {
    let dir = tempfile::tempdir().unwrap();
    let count = || fs::read_dir(dir.path()).unwrap().count();
    let mesh = mesh(3, 3);
    let spoilt = SheetState { time: f64::NAN, ..state(&mesh, 1) };
    assert!(SheetFile::new(dir.path(), &mesh, &[0; 9], &[spoilt]).is_err());
    assert_eq!(count(), 0);

    let file = finished(dir.path(), &mesh, 2);
    assert_eq!(count(), 1);
    assert_eq!(fs::read_dir(file.path().parent().unwrap()).unwrap().count(), 1);
    drop(file);
    assert_eq!(count(), 0);

    let folder = dir.path().join("out");
    let claim = Folder::claim(&folder, "simulate", &[]).unwrap();
    let file = finished(claim.stage(), &mesh, 2);
    drop(claim);
    assert!(!folder.exists(), "a claim that wrote nothing leaves nothing, states included");
    drop(file);
}

/// A folder that is not there stands for any disk that refuses.
#[test]
fn a_disk_that_refuses_is_an_error_with_a_remedy() {
    let dir = tempfile::tempdir().unwrap();
    let mesh = mesh(3, 3);
    let refused = SheetFile::new(&dir.path().join("no"), &mesh, &[0; 9], &[state(&mesh, 1)]);
    let refused = refused.unwrap_err();
    assert!(matches!(refused, Error::Io { .. }) && refused.help().contains("-o"), "{refused}");
}

#[test]
fn states_that_no_sheet_has_are_not_written() {
    let dir = tempfile::tempdir().unwrap();
    let mesh = mesh(3, 3);
    let refused = |mesh: &SheetMesh, landed: &[u32], states: &[SheetState], says: &str| {
        let error = SheetFile::new(dir.path(), mesh, landed, states).unwrap_err();
        assert!(matches!(&error, Error::Internal(text) if text.contains(says)), "{error}");
    };
    let sound = || state(&mesh, 3);
    for (spoilt, array) in [
        (SheetState { positions: vec![[0.0; 3]; 8].into(), ..sound() }, "`positions"),
        (SheetState { shear: vec![f64::INFINITY; 4].into(), ..sound() }, "`shear"),
        (SheetState { height: vec![f64::INFINITY; 9].into(), ..sound() }, "`height"),
        (SheetState { tension: vec![f64::NAN; 12].into(), ..sound() }, "`tension"),
        (SheetState { pad_rotation: vec![[0.0; 4]; 4].into(), ..sound() }, "`pad_rotation"),
        (SheetState { step: 1, ..sound() }, "`step"),
        (SheetState { time: 0.1, ..sound() }, "`time"),
    ] {
        refused(&mesh, &[0; 9], &[state(&mesh, 2), spoilt], array);
    }
    let twice = [state(&mesh, 2), SheetState { step: 2, time: 0.2, ..sound() }];
    SheetFile::new(dir.path(), &mesh, &[0; 9], &twice).unwrap();
    refused(&mesh, &[0; 8], &twice, "`landing_step` of the sheet has 8 numbers, not 9");
    refused(&mesh, &[0; 9], &[], "the sheet has no state");
    let far = SheetMesh { segments: vec![[0, 9]; 12].into(), ..mesh.clone() };
    refused(&far, &[0; 9], &twice, "there is no such node");
}

/// The result's check sum tells a file that was cut, replaced, or changed in one bit.
#[test]
fn a_file_that_is_not_the_results_own_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let file = finished(dir.path(), &mesh(3, 3), 2);
    let bytes = fs::read(file.path()).unwrap();
    let open = |bytes: &[u8]| {
        fs::write(dir.path().join(NAME), bytes).unwrap();
        SheetStates::open(dir.path(), file.seal())
    };
    assert!(open(&bytes).is_ok());
    for n in (0..bytes.len()).step_by(97) {
        let mut edited = bytes.clone();
        edited[n] ^= 1;
        assert!(matches!(open(&edited), Err(Error::File { .. })), "{n}");
    }
    assert!(matches!(open(&bytes[..bytes.len() - 1]), Err(Error::File { .. })));
    assert!(matches!(open(&[&bytes[..], b"\n"].concat()), Err(Error::File { .. })));
    fs::remove_file(dir.path().join(NAME)).unwrap();
    let missing = SheetStates::open(dir.path(), file.seal());
    assert!(matches!(missing, Err(Error::Io { .. })));
    let outside = SheetSeal { file: "../sheet.npz".into(), ..file.seal().clone() };
    assert!(matches!(SheetStates::open(dir.path(), &outside), Err(Error::File { .. })));
}

/// A seal that was made anew does not help: whatever the bytes are, they are read as a sheet or refused.
#[test]
fn a_forged_file_is_refused_or_read_as_a_sheet() {
    let dir = tempfile::tempdir().unwrap();
    let bytes = fs::read(finished(dir.path(), &mesh(3, 3), 2).path()).unwrap();
    let read = |bytes: &[u8]| -> Result<(), Error> {
        let mut states = forged(dir.path(), bytes)?;
        (0..states.states()).try_for_each(|n| states.state(n).map(drop))
    };
    assert!(read(&bytes).is_ok());
    for end in [0, 10, bytes.len() / 2, bytes.len() - 1] {
        assert!(read(&bytes[..end]).is_err(), "{end}");
    }
    let replaced = |from: &[u8], to: &[u8]| {
        let mut edited = bytes.clone();
        let places = edited.windows(from.len()).enumerate().filter(|(_, text)| *text == from);
        let places: Vec<usize> = places.map(|(n, _)| n).collect();
        assert!(!places.is_empty());
        for n in places {
            edited[n..n + to.len()].copy_from_slice(to);
        }
        edited
    };
    for (from, to) in [
        ("(2, 9, 3)", "(2, 3, 9)"),
        ("(2, 9, 3)", "(9, 9, 9)"),
        ("(9, 2), }", "(99, 2),}"),
        ("<f8", ">f8"),
        ("positions.npy", "positionS.npy"),
    ] {
        assert!(read(&replaced(from.as_bytes(), to.as_bytes())).is_err(), "{from} {to}");
    }
    // one and the same quaternion in all places, made NaN
    assert!(read(&replaced(&0.6_f64.to_le_bytes(), &f64::NAN.to_le_bytes())).is_err());
    for n in (0..bytes.len()).step_by(11) {
        let mut edited = bytes.clone();
        edited[n] ^= 0x81;
        let _ = read(&edited);
    }
}
