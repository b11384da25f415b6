//! How the sheet judges fronts on the dome and straight paths: figures of two independent cloth simulators.

use crate::common::{RING, drape_sheet, example, ideal, motion};
use plydrape::layup::Friction;
use plydrape::measure::Name;
use plydrape::outcome::Status;
use plydrape::planner::path::{MoldHeights, Strategy, trajectory};
use plydrape::scene::Scene;

/// The dome of the examples with lines every 20 mm, rolled on from its middle by a front of curvature `a` (1/m), whose lines
/// are not made taut: so are the fronts of the references.
fn front(a: f64, slope: f64) -> Scene {
    let mut scene = ideal("04_dome");
    scene.layup.settings.sheet.mesh = Some(0.02);
    let curvature = a * scene.layup.ply.cell[0];
    let strategy = Strategy { curvature, slope, pretension: 0.0, ..RING };
    let heights = MoldHeights::new(&scene).expect("the dome is a height").untightened();
    let positions = trajectory(&scene, &heights, strategy).expect("the front rolls over the dome");
    scene.layup.motion = motion(positions);
    scene
}

/// Largest height at the end of a drape, which comes to rest (mm).
fn height(mut scene: Scene, friction: Friction) -> f64 {
    scene.layup.settings.contact.friction = friction;
    let summary = drape_sheet(&scene).summary;
    assert_eq!(summary.status, Status::Converged);
    summary.last.value(Name::Height).expect("the scene has a mold")
}

/// Under stick a steep front leaves 0.11 mm on the dome and a shallow one ridges of 2.1 to 2.3 mm, of which the
/// catenaries see nothing; at this mesh the ranges are wide.
#[test]
fn a_steep_front_lays_the_dome_flat_and_a_shallow_one_leaves_ridges() {
    let steep = height(front(30.0, 0.6), Friction::Stick);
    let shallow = height(front(12.0, 0.25), Friction::Stick);
    assert!(steep < 0.5, "{steep} mm");
    assert!((1.5..3.5).contains(&shallow), "{shallow} mm");
}

/// With friction as low as 0.3 every path ends flat, whatever its order. On a dome of radius R the nodes of a chord of
/// 20 mm are h²/8R = 0.08 mm high.
#[test]
fn with_little_friction_every_path_ends_flat() {
    let friction = Friction::Coulomb(0.3);
    for (a, slope) in [(30.0, 0.6), (12.0, 0.25)] {
        let found = height(front(a, slope), friction);
        assert!(found < 0.12, "{a} {slope}: {found} mm");
    }
    let mut straight = ideal("04_dome");
    straight.layup.settings.sheet.mesh = Some(0.02);
    let found = height(straight, friction);
    assert!(found < 0.15, "{found} mm");
    let mut flat = example("01_flat_sheared_mold");
    flat.layup.settings.sheet.mesh = Some(0.02);
    let found = height(flat, friction);
    assert!(found < 0.01, "{found} mm");
}

/// On straight paths the paper's ply touches in step 22 of 30, in the middle of an outer cell, where the catenaries
/// touch in step 26.
#[test]
fn the_paper_s_straight_path_touches_first_in_the_middle_of_an_outer_cell() {
    let mut scene = example("01_flat_sheared_mold");
    scene.layup.settings.sheet.mesh = Some(0.01);
    // contact is all that is asked
    scene.layup.motion.positions.truncate(23);
    scene.layup.motion.times.truncate(23);
    let report = drape_sheet(&scene).summary.sheet.expect("the sheet reports");
    assert_eq!(report.first_contact_step, Some(22));
    let [u, v] = report.first_contact_uv_mm.expect("it touches");
    let outer = f64::min(u, 300.0 - u);
    assert!((outer - 50.0).abs() < 11.0 && (v - 50.0).abs() < 11.0, "{u} {v}");
}
