use super::*;
use crate::result::sheet::{SheetFile, SheetKept, SheetMesh, SheetState};
use crate::sample;
use serde_json::json;
use std::borrow::Cow;

/// Corners of a cell of 100 mm at a height (m), sheared by an angle (rad).
fn corners(z: f64, angle: f64) -> Vec<[f64; 3]> {
    let (across, up) = (0.1 * angle.sin(), 0.1 * angle.cos());
    vec![[0.0, 0.0, z], [0.1, 0.0, z], [across, up, z], [0.1 + across, up, z]]
}

/// A result with a sheet of one cell on its plane z = 0, in a file of its own: it comes down from 2 mm, and shears by 0.1 rad a step.
fn result(dir: &Path) -> ResultFile {
    let mut result = sample::sheet(2, 2, 3);
    let mesh = SheetMesh {
        places: Cow::from(vec![[0.0, 0.0], [0.1, 0.0], [0.0, 0.1], [0.1, 0.1]]),
        areas: Cow::from(vec![0.0025; 4]),
        segments: Cow::from(vec![[0, 1], [2, 3], [0, 2], [1, 3]]),
        cells: Cow::from(vec![[0, 1, 3, 2]]),
        grippers: 4,
        releases: false,
    };
    let states: Vec<SheetState> = (0..3)
        .map(|n| SheetState {
            step: n + 1,
            time: 0.5 * f64::from(n),
            positions: corners(0.002 - 0.001 * f64::from(n), 0.1 * f64::from(n)).into(),
            height: vec![0.002 - 0.001 * f64::from(n); 4].into(),
            contact: vec![n == 2, n == 2, false, false].into(),
            shear: vec![0.1 * f64::from(n)].into(),
            tension: vec![0.0; 4].into(),
            grippers: vec![[0.0; 3]; 4].into(),
            pad_forces: vec![[0.0, 0.3, -0.4]; 4].into(),
            pad_rotation: vec![[0.0, 0.0, 0.0, 1.0]; 4].into(),
            pad_holds: None,
        })
        .collect();
    let file = SheetFile::new(dir, &mesh, &[3, 3, 0, 0], &states).unwrap();
    result.sheet_states = Some(SheetKept::made(file));
    result
}

/// A drape that is 1 mm higher and sheared by 0.05 rad more in every step, and by nothing but the height at rest.
fn drape(result: &ResultFile) -> PeerDrape {
    let state = |places: Vec<[f64; 3]>| json!({"positions": places, "forces": vec![[0.0, 0.0, -0.2]; 4], "lies": 0.25});
    let in_steps = (0..3).map(|n| {
        let n = f64::from(n);
        state(corners(0.003 - 0.001 * n, 0.1 * n + 0.05))
    });
    let states: Vec<_> = in_steps.chain([state(corners(0.001, 0.2))]).collect();
    let file = json!({
        "format": FORMAT, "version": VERSION, "settings": {}, "states": states, "cpu_s": 9.0, "steps": 8, "solves": 7, "refused": 6,
        "result": result.sheet_states.as_ref().unwrap().seal().checksum,
        "first_touch": {"time": 0.75, "place": [0.05, 0.02]},
    });
    serde_json::from_value(file).unwrap()
}

/// Heights, shear, loads and distances are those by which the made-up drapes differ; the state at rest is compared with the end.
#[test]
fn what_differs_is_what_was_made_to_differ() {
    let dir = tempfile::tempdir().unwrap();
    let result = result(dir.path());
    let found = compare(&result, &drape(&result)).unwrap();
    let near = |a: Option<f64>, b: f64| (a.unwrap() - b).abs() < 1e-9;
    assert!(near(found.height_max_mm.plydrape, 0.0) && near(found.height_max_mm.peer, 1.0));
    assert!(near(found.height_rms_mm.peer, 1.0) && near(found.height_share.plydrape, 0.0));
    assert!(near(found.height_share.peer, 1.0), "no limit of the height is one of zero");

    let [first, _, last] = found.steps.as_slice() else { panic!("{:?}", found.steps) };
    assert!(near(first.lowest_mm.plydrape, 2.0) && near(first.lowest_mm.peer, 3.0));
    assert!(near(first.shear_deg.plydrape, 0.0));
    assert!(near(first.shear_deg.peer, 0.05_f64.to_degrees()));
    assert!(near(first.load_n.plydrape, 0.5) && near(first.load_n.peer, 0.2));
    assert!(near(last.shear_deg.peer, 0.2_f64.to_degrees()), "at rest it shears alike");
    assert!(near(last.lies.plydrape, 0.5) && near(last.lies.peer, 0.25));
    assert!(near(Some(last.apart_max_mm), 1.0) && near(Some(last.apart_rms_mm), 1.0));

    let touches = found.first_touch.each_ref().map(|touch| touch.as_ref().unwrap());
    assert!((touches[0].step, touches[1].step) == (1.0, 2.5), "{touches:?}");
    assert!(touches[1].uv_mm == [50.0, 20.0]);
    let text = table(&found);
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    assert!(text.contains("7 linear systems, 6 time steps"), "{text}");
}

/// A drape of another result, one that broke off, and a folder without one are refused with a remedy.
#[test]
fn what_cannot_be_compared_is_refused() {
    let dir = tempfile::tempdir().unwrap();
    let result = result(dir.path());
    let mut other = drape(&result);
    other.result = Some("crc32:00000000".into());
    let refused = compare(&result, &other).unwrap_err();
    assert!(refused.to_string().contains("is not of the result"), "{refused}");
    let mut short = drape(&result);
    short.states.pop();
    let mut elsewhere = drape(&result);
    elsewhere.states[1].positions.fill(None);
    for incomplete in [&short, &elsewhere] {
        let refused = compare(&result, incomplete).unwrap_err();
        assert!(refused.to_string().contains("has not all steps"), "{refused}");
        assert!(refused.help().contains("--to ngsolve"));
    }
    // states of a sheet in steps that neither the result nor the drape has
    let mut without_steps = self::result(dir.path());
    without_steps.steps.clear();
    let mut at_rest = drape(&without_steps);
    at_rest.states.truncate(1);
    assert!(compare(&without_steps, &at_rest).is_err());
    assert!(
        compare(&sample::draped(2, 2, 3), &short).unwrap_err().to_string().contains("no sheet")
    );
    assert!(read(dir.path()).unwrap_err().help().contains("drape.py"));
    std::fs::write(dir.path().join(FILE), "{}").unwrap();
    assert!(read(dir.path()).unwrap_err().to_string().contains("is no drape"));
}

/// The page that was asked for has the comparison, whose steps are those of the page; the page of the result alone has none.
#[test]
fn the_page_has_the_comparison_that_was_asked_for() {
    let dir = tempfile::tempdir().unwrap();
    let result = result(dir.path());
    let found = compare(&result, &drape(&result)).unwrap();
    let page = crate::page::compared_html(&result, &found).unwrap();
    let data = page.split_once(r#"id="plydrape-data">"#).unwrap().1;
    let data = data.split_once("</script>").unwrap().0;
    let data: serde_json::Value = serde_json::from_str(data).unwrap();
    assert_eq!(data["peer"]["name"], NAME);
    for course in data["peer"]["courses"].as_array().unwrap() {
        for line in ["first", "second"] {
            assert_eq!(
                course[line].as_array().unwrap().len(),
                data["steps"].as_array().unwrap().len()
            );
        }
    }
    assert!(!crate::page::html(&result).unwrap().contains(r#""peer":{"#));
}
