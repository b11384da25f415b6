//! The straight paths of the examples with the sheet: the headline numbers of `docs/guide/sheet.md`.

use crate::common::examples;
use plydrape::sheet::{Tuning, drape};
use plydrape_io::scene;
use std::ops::ControlFlow;

/// The sheet refuses the straight paths for their ridges, and touches the mold before the catenaries do. The chapter
/// has 4.5, 8.6 and 7.8 mm at a mesh of 10 mm and contact in steps 22, 20 and 25; at 20 mm, which is faster, it says
/// 6.8, 7.6 and 7.8 mm. Ridges are 15 % apart where rounding lets slack fold another way, and contact a step.
#[test]
fn straight_paths_end_with_ridges_of_millimetres() {
    let expected = [
        ("01_flat_sheared_mold", 6.8, 23, 26),
        ("04_dome", 7.6, 21, 24),
        ("06_saddle", 7.8, 25, 28),
    ];
    for (name, ridge, contact, catenaries) in expected {
        let path = examples().join(name);
        let text = std::fs::read_to_string(path.join("scene.toml")).unwrap();
        let text = text + "\n[sheet]\nmesh = \"20 mm\"\n";
        let scene = scene::parse(&text, &path, name).unwrap().scene;
        let draped =
            drape(&scene, Tuning::default(), &|| false, |_| ControlFlow::Continue(())).unwrap();
        let summary = draped.summary;
        assert!(summary.converged && !summary.accepted, "{name}: {:?}", summary.status);
        let highest = summary.ridge_max_mm.unwrap();
        assert!((highest / ridge - 1.0).abs() < 0.15, "{name}: {highest}");
        let first = summary.first_contact_step.unwrap();
        assert!(first.abs_diff(contact) <= 1 && first < catenaries, "{name}: {first}");
    }
}
