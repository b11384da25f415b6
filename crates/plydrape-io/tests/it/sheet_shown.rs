//! What shows the sheet of a result: files for VTK, the page.

use crate::common::examples;
use plydrape::outcome;
use plydrape_io::write::vtk;
use plydrape_io::{ResultFile, page, scene};
use std::ops::ControlFlow;

/// The dome with nine cells of 50 mm between grippers by both models, and the states of its sheet in a folder that lives as long.
fn dome() -> (ResultFile, tempfile::TempDir) {
    let path = examples().join("ideal_dome");
    let text = std::fs::read_to_string(path.join("scene.toml")).unwrap();
    let text = text.replace("steps = 30", "steps = 6") + "[sheet]\nmesh = \"50 mm\"\nkeep = 4\n";
    let mut scene = scene::parse(&text, &path, "dome").unwrap().scene;
    scene.also = true;
    let outcome = outcome::simulate(&scene, |_| ControlFlow::Continue(())).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let result = ResultFile::of_outcome(&scene, None, outcome, dir.path()).unwrap();
    (result, dir)
}

/// The doubles of an array of a `.vtp` file.
fn array(file: &[u8], name: &str) -> Vec<f64> {
    let mark = b"<AppendedData encoding=\"raw\">\n_";
    let start = file.windows(mark.len()).position(|w| w == mark).unwrap() + mark.len();
    let text = std::str::from_utf8(&file[..start]).unwrap();
    let (_, tail) = text.split_once(&format!("type=\"Float64\" Name=\"{name}\"")).expect(name);
    let (_, tail) = tail.split_once("offset=\"").unwrap();
    let from = start + tail.split_once('"').unwrap().0.parse::<usize>().unwrap();
    let length = u64::from_le_bytes(file[from..from + 8].try_into().unwrap()) as usize;
    file[from + 8..from + 8 + length].as_chunks().0.iter().map(|n| f64::from_le_bytes(*n)).collect()
}

/// Each state that was kept is a file of its cells and one of its pads, with the numbers of `sheet.npz`, in series whose times
/// are those of the steps.
#[test]
fn vtk_files_hold_the_states_that_were_kept() {
    let (result, _dir) = dome();
    let mut states = result.sheet_states.as_ref().unwrap().open().unwrap();
    let files = vtk::files(&result).unwrap();
    let file = |name: &str| &files.iter().find(|(known, _)| known == name).expect(name).1;
    assert_eq!(states.states(), 4);
    let last = states.state(3).unwrap().unwrap();
    assert_eq!(last.step, 6);

    let [sheet, pads] = ["sheet_0006.vtp", "pads_0006.vtp"].map(file);
    assert_eq!(array(sheet, "Points"), last.positions.as_flattened());
    let heights: Vec<f64> = last.height.iter().map(|h| 1e3 * h).collect();
    assert_eq!(array(sheet, "height_mm"), heights);
    let shear: Vec<f64> = last.shear.iter().map(|shear| shear.to_degrees()).collect();
    assert_eq!(array(sheet, "shear_deg"), shear);
    // EA' = 1e6 N/m, no crimp: tension is strain times that
    for (strain, tension) in array(sheet, "strain").iter().zip(array(sheet, "tension_N_per_m")) {
        assert!(
            (1e6 * strain - tension).abs() < 1e-3 * (1.0 + tension.abs()),
            "{strain} {tension}"
        );
    }
    assert_eq!(array(pads, "Points"), last.grippers.as_flattened());
    assert_eq!(array(pads, "force_N"), last.pad_forces.as_flattened());

    // both series name the kept steps, all parts together each time
    for name in ["sheet", "pads"] {
        let text = String::from_utf8(file(&format!("{name}.pvd")).clone()).unwrap();
        assert_eq!(text.matches("<DataSet ").count(), 4, "{text}");
        let time = format!("timestep=\"{:?}\"", result.steps[5].time);
        let found = text.lines().find(|line| line.contains(&time)).expect("the last step");
        assert!(found.contains(&format!("{name}_0006.vtp")), "{found}");
    }
    let all = String::from_utf8(file("drape.pvd").clone()).unwrap();
    assert_eq!(all.matches("name=\"sheet\"").count(), 4);
}

/// The page has every step with the grippers, and the ply in the states that were kept: the nearest one where there is none. Beside the sheet,
/// which judges, are the catenaries, which do not.
#[test]
fn the_page_shows_every_step_and_the_other_model_beside() {
    let (result, _dir) = dome();
    let html = page::html(&result).unwrap();
    let (_, tail) = html.split_once("id=\"plydrape-data\">").unwrap();
    let data: serde_json::Value =
        serde_json::from_str(tail.split_once("</script>").unwrap().0.trim()).unwrap();
    let (drape, also) = (&data["drape"], &data["also"]);
    assert_eq!(data["steps"], serde_json::json!([1, 2, 3, 4, 5, 6]));
    assert_eq!((&drape["model"], &also["model"]), (&"sheet".into(), &"catenaries".into()));
    let list = |value: &serde_json::Value| -> Vec<u64> {
        value.as_array().unwrap().iter().filter_map(serde_json::Value::as_u64).collect()
    };
    let (drawn, pictures) = (list(&drape["drawn"]), list(&drape["pictures"]));
    assert_eq!((drawn.len(), drawn[0], drawn[3]), (4, 1, 6));
    for (step, picture) in (1..).zip(pictures) {
        let away = |kept: u64| kept.abs_diff(step);
        assert_eq!(drawn.iter().copied().map(away).min(), Some(away(drawn[picture as usize])));
    }
    assert_eq!(drape["grippers"]["forces"]["steps"], 6);
    assert_eq!(drape["grippers"]["forces"]["count"], 16);
    assert_eq!(drape["sheet"]["positions"]["count"], 49);
    assert_eq!(drape["sheet"]["cells"].as_array().unwrap().len(), 4 * 36);
    assert_eq!(data["accepted"], result.summary.accepted());
    assert_eq!(data["limits"].as_array().unwrap().len(), result.summary.limits.len());
    assert!(also["measures"].as_array().unwrap().iter().all(|course| course["limit"].is_null()));
    assert_eq!(html, page::html(&result).unwrap());
}
