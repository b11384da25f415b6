//! The examples on curved molds: their targets and headline numbers against closed forms, symmetry and an
//! earlier trial of the model.

use crate::common::{distance, drape, drape_sheet, example, examples, ideal, lines};
use plydrape::draping::record::Hold;
use plydrape::errors::Errors;
use plydrape::layup::Target;
use plydrape::measure::Name;
use plydrape::mold::{Graph, Mold, Pose, Surface};
use plydrape::net::Net;
use plydrape::ply::Kind;
use plydrape::scene::Scene;
use plydrape_io::ResultFile;

fn target(scene: &Scene) -> (&Target, &Net, &Mold) {
    let target = scene.layup.target.as_ref().expect("a target");
    let net = target.drape.as_ref().expect("an ideal drape");
    (target, net, scene.layup.mold.as_ref().expect("a mold"))
}

/// Worst landing error of the edges at the end (mm).
fn edges_off(result: &ResultFile) -> f64 {
    let last = result.steps.last().expect("steps");
    let contacts =
        lines(last).iter().filter(|c| c.kind.is_edge()).filter_map(|c| c.contact.as_ref());
    let errors = contacts.flat_map(|c| c.landing_error_mm.iter().flatten().flatten());
    errors.copied().fold(0.0, f64::max)
}

/// What every drape by straight paths onto a curved mold has: every limit judged, wrinkles found and
/// reported, fabric neither made nor lost, contact on the mold within `off` (m), and an ideal place for
/// every gripper and landed point.
fn straight_paths_leave_wrinkles(scene: &Scene, off: f64) -> ResultFile {
    let result = drape(scene);
    let summary = &result.summary;
    assert!(!summary.accepted() && summary.steps == 30);
    let failed = |name: &str| {
        summary.limits.iter().any(|limit| limit.name.measure().name() == name && !limit.ok)
    };
    assert!(failed("slack_ratio") && failed("overstretch"));
    let judged =
        |name: &str| summary.limits.iter().any(|limit| limit.name.measure().name() == name);
    assert!(judged("position") && judged("landing_gripper") && judged("fiber_angle"));
    let (target, _, mold) = target(scene);
    let last = result.steps.last().expect("steps");
    for (gripper, ideal) in last.grippers.iter().zip(&target.grippers) {
        assert!(distance(gripper.position, *ideal) < 1e-12, "straight paths end at the targets");
    }
    for catenary in lines(last) {
        let lengths = catenary.spans.iter().map(|span| span.length);
        let whole = catenary
            .spans
            .iter()
            .any(|span| span.hold == Hold::Lying && catenary.arc(span) == [0.0, catenary.length]);
        let Some(contact) = &catenary.contact else { continue };
        let laid = if whole { 0.0 } else { contact.length() };
        let total = lengths.sum::<f64>() + laid;
        assert!((total - catenary.length).abs() < 1e-9, "{total} {}", catenary.length);
        for point in &contact.points {
            assert!(mold.signed_distance(*point).abs() < off, "{point:?}");
        }
        let errors = contact.landing_error_mm.as_ref().expect("an ideal drape");
        assert!(errors.len() == contact.points.len() && errors.iter().all(Option::is_some));
    }
    result
}

/// A trial of the model from 50 mm above a dome of R = 0.6 m, 4 × 4 grippers, 100 mm cells, left "up to 1.04 mm
/// between where edges landed and where they belong"; its first steps are not ours, hence the margin. A
/// quarter turn changes nothing.
#[test]
fn a_dome_by_straight_paths_leaves_a_millimeter_and_looks_the_same_from_four_sides() {
    let scene = ideal("04_dome");
    let (target, net, _) = target(&scene);
    assert!(net.missing.is_empty());
    let grid = scene.layup.ply.grid;
    for (n, place) in target.grippers.iter().enumerate() {
        let [i, j] = grid.id(n);
        let turned = target.grippers[grid.index([3 - j, i])];
        assert!(distance(turned, [-place[1], place[0], place[2]]) < 1e-9);
    }
    let result = straight_paths_leave_wrinkles(&scene, 1e-9);
    let off = edges_off(&result);
    assert!((off - 1.04).abs() < 0.15, "{off} mm");
    let first = &result.summary.catenaries.as_ref().expect("they drape").first_contact;
    assert!(first.len().is_multiple_of(4) || first.len() == 2, "{first:?}");
}

/// A cylinder unrolls: its net has no shear, and unrolled the targets are the flat grid, turned by 30°.
#[test]
fn on_a_cylinder_the_targets_are_the_flat_ply_rolled_up() {
    let scene = ideal("05_cylinder");
    let (target, net, _) = target(&scene);
    assert!(net.report.largest_shear.expect("cells").0 < 1e-9);
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    for (n, [x, y, z]) in target.grippers.iter().enumerate() {
        let [i, j] = scene.layup.ply.grid.id(n);
        let (u, v) = (0.1 * (i as f64 - 1.5), 0.1 * (j as f64 - 1.0));
        let unrolled = 0.5 * y.atan2(z + 0.5);
        assert!((x - (cos * u - sin * v)).abs() < 1e-9, "{x}");
        assert!((unrolled - (sin * u + cos * v)).abs() < 1e-9, "{unrolled}");
    }
    straight_paths_leave_wrinkles(&scene, 1e-9);
}

/// The trial left as much on a saddle. It is wrapped along one axis and bridged along the other: its
/// edges along the hollow do not lie.
#[test]
fn a_saddle_by_straight_paths_is_bridged_along_its_hollow() {
    let scene = example("06_saddle");
    let result = straight_paths_leave_wrinkles(&scene, 1e-9);
    let off = edges_off(&result);
    assert!((off - 1.04).abs() < 0.15, "{off} mm");
    let lies = |direction: Kind| -> f64 {
        let last = result.steps.last().expect("steps");
        let edges = lines(last).iter().filter(|c| c.kind == direction);
        edges.filter_map(|c| c.contact.as_ref()).map(|c| c.length()).sum()
    };
    assert!(
        lies(Kind::EdgeU) > 1.5 * lies(Kind::EdgeV),
        "{} {}",
        lies(Kind::EdgeU),
        lies(Kind::EdgeV)
    );
}

/// Krogh et al. 2021 give the mold as a cubic; every node of the net lies on it, as worked out here.
#[test]
fn the_net_on_the_cubic_lies_on_the_printed_polynomial() {
    let scene = example("07_cubic");
    let (_, net, mold) = target(&scene);
    assert!(net.missing.is_empty());
    for [x, y, z] in net.nodes.iter().flatten().copied() {
        let height = 1.004 * x + 1.089 * y - 3.667 * x * x - 4.4 * x * y - 3.75 * y * y
            + 3.086 * x.powi(3)
            + 8.889 * x * x * y
            + 4.321 * y.powi(3);
        assert!((z - height).abs() < 1e-12, "{z} {height}");
    }
    // "slopes up to 63 deg" are the mold's own, in its corner
    let steepest = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.5], [0.5, 0.5]].map(|place| {
        mold.normal(mold.highest_point(place).expect("on the mold"))[2].acos().to_degrees()
    });
    assert!(steepest.iter().any(|slope| (slope - 63.0).abs() < 0.5), "{steepest:?}");
    straight_paths_leave_wrinkles(&scene, 1e-9);
}

/// The STL is the surface of its script in triangles of 10 mm: its targets are those of the formula but for the
/// mesh's own error, h²κ/8 with κ ≤ 1.9 1/m.
#[test]
fn the_stl_has_the_targets_of_its_formula() {
    let scene = ideal("08_stl_mold");
    let (target, net, _) = target(&scene);
    let z = plydrape_io::read::formula::read("-x^2/2 + 3*x^3/5 - 9*y^2/10 + 4*x*y/5")
        .expect("a formula");
    let (pose, surface) = (Pose::ORIGIN, Surface::Formula { z });
    let smooth = Mold::Graph(Graph { pose, surface, domain: None });
    let mut layup = net.placement;
    layup.place = smooth.highest_point([layup.place[0], layup.place[1]]).expect("on the mold");
    let ideal = Net::drape(&smooth, layup).expect("a net");
    let divisions = [0, 1].map(|n| (scene.layup.ply.cell[n] / layup.mesh[n]).round() as usize);
    for (n, place) in target.grippers.iter().enumerate() {
        let [i, j] = scene.layup.ply.grid.id(n);
        let there = ideal.node([i * divisions[0], j * divisions[1]]).expect("a node");
        assert!(
            distance(*place, there) < 2.0 * 1.9 * 0.01_f64.powi(2) / 8.0,
            "{place:?} {there:?}"
        );
    }
    straight_paths_leave_wrinkles(&scene, 1e-12);
}

/// A ply of 1.2 × 1.0 m in a net of 20 mm lies on the blade mold whole; skipped, loudly, without the deck.
#[test]
fn the_blade_mold_takes_a_whole_ply() {
    let deck = examples().join("../../shared/data/molds/blade_like.inp");
    if !deck.exists() {
        eprintln!("SKIPPED the_blade_mold_takes_a_whole_ply: no {}", deck.display());
        return;
    }
    let scene = example("09_blade");
    let (_, net, _) = target(&scene);
    assert_eq!(net.placement.nodes, [61, 51]);
    assert!(net.missing.is_empty() && net.report.largest_edge_error < 1e-9);
    straight_paths_leave_wrinkles(&scene, 1e-12);
}

/// A ply that was picked up 0.5 mm off its place lies off by as much on a dome, and as high over it as one that was not.
#[test]
fn a_ply_that_was_picked_up_aside_lies_aside() {
    let mut scene = ideal("04_dome");
    scene.layup.settings.sheet.mesh = Some(0.02);
    let mut draw = Errors::default().draw(0, scene.layup.ply.grippers());
    draw.pick_up.offset = [3e-4, -4e-4];
    let aside = Scene { layup: draw.apply(&scene.layup), ..scene.clone() };
    // to the corners of the ply
    let (_, net, mold) = target(&scene);
    for corner in [[0.0, 0.0], [0.3, 0.0], [0.0, 0.3], [0.3, 0.3]] {
        let places = [&scene, &aside].map(|scene| net.held_place(mold, &scene.layup.ply, corner));
        let [place, off] = places.map(|place| place.expect("it is known"));
        let [u, v] = net.fibers(mold, corner).expect("it is known");
        let expected = [0, 1, 2].map(|n| place[n] + 3e-4 * u[n] - 4e-4 * v[n]);
        assert!(distance(off, expected) < 1e-15 && Some(place) == net.place(mold, corner));
    }
    let [as_planned, aside] = [scene, aside].map(|scene| drape_sheet(&scene).summary.last);
    assert_eq!(as_planned.value(Name::Height), aside.value(Name::Height));
    let [before, after] =
        [&as_planned, &aside].map(|last| last.value(Name::Position).expect("it is judged"));
    assert!(after > before + 0.1 && after <= before + 0.51, "{before} {after}");
}
