//! The straight paths of the examples with the sheet: the headline numbers of `docs/guide/sheet.md`.

use crate::common::{drape_sheet, examples};
use plydrape::outcome::Status;
use plydrape_io::scene;

/// The sheet refuses the straight paths for their ridges, and touches the mold before the catenaries do. The chapter
/// has 2.4 to 6, 6 to 10 and 7.7 mm from two other cloth programs, and contact in steps 22, 20 and 25. Where slack folds is
/// a matter of rounding: the ridge of the saddle is 7.3 to 9.2 mm with other meshes and time steps. Contact is a step
/// apart.
#[test]
fn straight_paths_end_with_ridges_of_millimeters() {
    let expected = [
        ("01_flat_sheared_mold", [2.4, 8.0], 23, 26),
        ("ideal_dome", [6.0, 10.0], 21, 24),
        ("06_saddle", [6.0, 10.0], 25, 28),
    ];
    for (name, ridge, contact, catenaries) in expected {
        let path = examples().join(name);
        let text = std::fs::read_to_string(path.join("scene.toml")).unwrap();
        let text = text + "\n[sheet]\nmesh = \"20 mm\"\n";
        let scene = scene::parse(&text, &path, name).unwrap().scene;
        let summary = drape_sheet(&scene).summary;
        assert_eq!((summary.status, summary.accepted()), (Status::Converged, false), "{name}");
        let highest = summary.sheet.as_ref().and_then(|report| report.ridge_max_mm).unwrap();
        assert!(highest > ridge[0] && highest < ridge[1], "{name}: {highest}");
        let first = summary.first_contact_step().unwrap();
        assert!(first.abs_diff(contact) <= 1 && first < catenaries, "{name}: {first}");
    }
}
