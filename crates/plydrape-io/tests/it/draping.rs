//! The drape: the paper's example as printed, bookkeeping of fabric, convergence, rigid motions, and
//! scenes that nobody would write.

use crate::common::{RULES, cases, contact, drape, example, hung, lines, motion, straight};
use plydrape::draping::record::{CatenaryState, Hold};
use plydrape::layup::{ContactEnd, Stepping, Target};
use plydrape::material::Section;
use plydrape::measure::Name;
use plydrape::mold::{Mold, Plane};
use plydrape::net::{EdgeRule, Generators, Net, Placement};
use plydrape::outcome::Summary;
use plydrape::ply::Kind;
use plydrape::scene::Scene;
use plydrape_io::result::ResultFile;
use proptest::prelude::*;
use std::sync::Arc;

/// The example with its straight motion in another number of steps.
fn in_steps(scene: &Scene, steps: usize) -> Scene {
    let mut scene = scene.clone();
    let positions = &scene.layup.motion.positions;
    scene.layup.motion = motion(straight(&positions[0], &positions[29], 1.0, steps));
    scene
}

/// Krogh et al. 2018, section 4: iteration 26 "has just made initial contact", on the short diagonals of
/// the three cells, which all shear; wrinkles "remain in the draped configuration, i.e. iteration 30".
#[test]
fn the_paper_example_touches_first_in_iteration_26_on_its_short_diagonals() {
    let result = drape(&example("01_flat_sheared_mold"));
    let summary = &result.summary;
    assert_eq!(summary.steps, 30);
    assert_eq!(summary.first_contact_step(), Some(26));
    let report = summary.catenaries.as_ref().expect("they drape");
    let touched: Vec<_> = report.first_contact.iter().map(|c| (c.kind, c.from, c.to)).collect();
    let short = [([1, 0], [0, 1]), ([2, 0], [1, 1]), ([3, 0], [2, 1])];
    assert_eq!(touched, short.map(|(a, b)| (Kind::Falling, a, b)));
    assert_eq!(report.first_shear_step, Some(5));
    for step in &result.steps {
        let sheared =
            hung(step).cells.iter().filter(|cell| cell.shearing == Some(Kind::Rising)).count();
        assert_eq!(sheared, if step.step < 5 { 0 } else { 3 }, "step {}", step.step);
    }
    // 100 mm sides sheared by 20°
    let last = result.steps.last().expect("30 steps");
    for cell in &hung(last).cells {
        assert!((cell.shear_deg - 20.0).abs() < 1e-9);
    }
    assert!(!summary.accepted());
    let slack = last.measures.get(Name::DiagonalSlack).expect("diagonals with slack");
    assert!(slack.value > 0.3 && slack.at.starts_with("diagonal"), "{slack:?}");
    let slack = last.measures.get(Name::Slack).expect("edges with slack");
    assert!(slack.value > 1.0 && slack.at.starts_with("edge"), "{slack:?}");
    let stretched = last.measures.get(Name::Overstretch).expect("edges");
    assert!(stretched.value > 0.001 && stretched.value < 0.05, "{stretched:?}");
}

/// Any start height from 70 to 78 mm gives the printed first contact.
#[test]
fn the_first_contact_does_not_hang_on_the_start_height() {
    for height in [0.070, 0.072, 0.0735, 0.076, 0.078] {
        let mut scene = example("01_flat_sheared_mold");
        for p in &mut scene.layup.motion.positions[0] {
            p[2] = height;
        }
        let scene = in_steps(&scene, 30);
        let summary = drape(&scene).summary;
        assert_eq!(summary.first_contact_step(), Some(26), "{height}");
        let touched = &summary.catenaries.as_ref().expect("they drape").first_contact;
        assert!(touched.iter().all(|c| !c.kind.is_edge()));
        assert_eq!(touched.len(), 3, "{height}");
    }
}

/// Fabric of a catenary that is free, in contact or lying (m).
fn accounted(c: &CatenaryState) -> f64 {
    let spans: f64 = c.spans.iter().map(|span| span.length).sum();
    let whole = c.spans.iter().any(|span| span.hold == Hold::Lying && span.length == c.length);
    spans + c.contact.as_ref().filter(|_| !whole).map_or(0.0, |contact| contact.length())
}

/// Contact and free lengths add up to the set length, and no longer change once the catenary is in
/// contact; spans hang in one piece from end to end; a contact segment lies on the mold.
fn check_record(result: &ResultFile) {
    for step in &result.steps {
        for (n, c) in lines(step).iter().enumerate() {
            let place = format!("step {} {:?} {:?}", step.step, c.kind, c.from);
            assert!(
                (accounted(c) - c.length).abs() < 1e-9,
                "{place}: {} {}",
                accounted(c),
                c.length
            );
            if c.kind.is_edge() {
                assert_eq!(
                    c.length,
                    result.scene.ply.cell[usize::from(c.kind == Kind::EdgeV)],
                    "{place}"
                );
            }
            if let (Some(contact), Some(mold)) = (&c.contact, &result.scene.mold) {
                for p in &contact.points {
                    assert!(mold.signed_distance(*p).abs() < 1e-9, "{place}: {p:?}");
                }
                // as long on the mold as in the fabric
                let [a, b] = [contact.points[0], contact.points[1]];
                let length = (0..3).map(|k| (b[k] - a[k]).powi(2)).sum::<f64>().sqrt();
                let arc = contact.length();
                let whole =
                    c.spans.iter().any(|s| s.hold == Hold::Lying && c.arc(s) == [0.0, c.length]);
                // both ends of a run may have grown in planes of their own
                assert!(whole || length <= arc + 1e-9, "{place}: {length} {arc}");
            }
            if let Some(next) = result.steps.get(step.step).map(|s| &lines(s)[n])
                && let (Some(now), Some(then)) = (&c.contact, &next.contact)
            {
                assert!(
                    then.ends()[0] <= now.ends()[0] && then.ends()[1] >= now.ends()[1],
                    "{place}: it stays"
                );
                assert_eq!(c.length, next.length, "{place}: fixed from the first touch on");
            }
        }
    }
}

#[test]
fn contact_and_free_lengths_always_add_up() {
    for stepping in [Stepping::Once, Stepping::Cut] {
        for end in [ContactEnd::Free, ContactEnd::Tangent] {
            let mut scene = example("01_flat_sheared_mold");
            scene.layup.settings.contact = contact(5e-4, stepping, end);
            check_record(&drape(&scene));
        }
    }
}

/// A drape does not know where it is: moved, turned about the vertical and mirrored scenes give the
/// same measures.
#[test]
fn rigid_motion_changes_nothing() {
    let scene = example("01_flat_sheared_mold");
    let before = drape(&scene).summary;
    let turn = |p: [f64; 3]| {
        let (s, c) = 0.7_f64.sin_cos();
        [c * p[0] - s * p[1] + 0.4, s * p[0] + c * p[1] - 1.1, p[2]]
    };
    let mut moved = scene.clone();
    for p in moved.layup.motion.positions.iter_mut().flatten() {
        *p = turn(*p);
    }
    moved.layup.target = scene.layup.target.as_ref().map(|target| Target {
        grippers: target.grippers.iter().map(|p| turn(*p)).collect(),
        drape: None,
    });
    let after = drape(&moved).summary;
    let touched = |summary: &Summary| summary.catenaries.clone().expect("they drape").first_contact;
    assert_eq!(touched(&before), touched(&after));
    for (a, b) in [
        (before.worst.value(Name::Slack), after.worst.value(Name::Slack)),
        (before.last.value(Name::Overstretch), after.last.value(Name::Overstretch)),
        (before.worst.value(Name::Tilt), after.worst.value(Name::Tilt)),
        (before.last.value(Name::ContactShare), after.last.value(Name::ContactShare)),
    ] {
        let (a, b) = (a.expect("measured"), b.expect("measured"));
        assert!((a - b).abs() < 1e-6 * a.abs().max(1.0), "{a} {b}");
    }
}

/// A strip that is let down on a plane: in more steps and with a finer tolerance its contact tends to
/// one place, and a strip that is held still does not creep onto the mold.
#[test]
fn contact_converges_in_steps_and_tolerance() {
    let strip = |steps: usize, tolerance: f64, stepping: Stepping| {
        let mut scene = example("02_hanging_strip");
        scene.layup.mold = example("01_flat_sheared_mold").layup.mold;
        scene.layup.settings.contact = contact(tolerance, stepping, ContactEnd::Free);
        let (from, to) =
            ([[0.0, 0.0, 0.012], [0.098, 0.0, 0.012]], [[0.0, 0.0, 0.004], [0.098, 0.0, 0.006]]);
        scene.layup.motion = motion(straight(&from, &to, 1.0, steps));
        let result = drape(&scene);
        let last = lines(result.steps.last().expect("steps"))[0].clone();
        last.contact.expect("the strip touches").ends()
    };
    let close = |a: [f64; 2], b: [f64; 2], tolerance: f64| {
        assert!((a[0] - b[0]).abs() < tolerance && (a[1] - b[1]).abs() < tolerance, "{a:?} {b:?}");
    };
    let fine = strip(400, 1e-5, Stepping::Cut);
    close(strip(400, 1e-5, Stepping::Once), fine, 2e-3);
    close(strip(100, 5e-5, Stepping::Cut), fine, 4e-3);
    // coarse tolerances lay the ply a little farther: √tolerance, as two curves touch
    close(strip(20, 2e-4, Stepping::Cut), fine, 1e-2);

    let mut scene = example("02_hanging_strip");
    scene.layup.mold = example("01_flat_sheared_mold").layup.mold;
    scene.layup.settings.contact = contact(1e-3, Stepping::Once, ContactEnd::Free);
    let still = vec![[0.0, 0.0, 0.006], [0.098, 0.0, 0.006]];
    scene.layup.motion = motion(vec![still; 60]);
    let result = drape(&scene);
    let arc = |n: usize| lines(&result.steps[n])[0].contact.as_ref().expect("it touches").ends();
    close(arc(59), arc(5), 1e-6);
}

/// A ply that is let down in its target shape, taut, on a plane tilted by 12° lies down whole, in place
/// and without slack.
#[test]
fn a_ply_set_down_in_its_target_shape_lies_without_fault() {
    for tilt in [0.0_f64, 12.0] {
        let mut scene = example("01_flat_sheared_mold");
        let (s, c) = tilt.to_radians().sin_cos();
        let plane = Mold::Plane(Plane { point: [0.0; 3], normal: [-s, 0.0, c] });
        let layup = Placement {
            nodes: [4, 2],
            mesh: [0.1; 2],
            origin: [0.0; 2],
            seed: [0; 2],
            place: [0.0; 3],
            heading: 0.0,
            shear: 20_f64.to_radians(),
            generators: Generators::Geodesic,
            edges: EdgeRule::Along,
        };
        let ideal = Net::drape(&plane, layup).expect("a net on a plane");
        let goal: Vec<[f64; 3]> = ideal.nodes.iter().map(|node| node.expect("a node")).collect();
        scene.layup.mold = Some(plane);
        scene.layup.target = Some(Target { grippers: goal.clone(), drape: Some(Arc::new(ideal)) });
        scene.layup.settings.contact.tolerance = 2e-4;
        scene.layup.settings.contact.stepping = Stepping::Cut;
        let lifted: Vec<_> =
            goal.iter().map(|p| [p[0] - 0.03 * s, p[1], p[2] + 0.03 * c]).collect();
        scene.layup.motion = motion(straight(&lifted, &goal, 1.0, 40));
        let summary = drape(&scene).summary;
        assert!(summary.accepted(), "{tilt}: {:?}", summary.limits);
        assert_eq!(summary.last.value(Name::ContactShare), Some(1.0));
        // taut edges sag by 0.52 mm along the vertical, which an incline of 12° puts down 0.11 mm aside
        assert!(summary.last.value(Name::LandingError).expect("an ideal drape") < 0.15);
        assert!(summary.last.value(Name::SlackRatio).expect("spans") < 5e-4);
    }
}

proptest! {
    #![proptest_config(cases(300))]

    /// No finite scene makes the program panic, lose fabric or write a number that is none: grippers
    /// flung about, crossed, stacked, under the mold, pulled far beyond the ply.
    #[test]
    fn no_finite_scene_breaks_the_record(
        (nu, nv) in (2usize..5, 1usize..4),
        wild in prop::sample::select(vec![0.001, 0.02, 0.1, 0.5]),
        random in prop::collection::vec(-1.0..1.0, 3 * 12 * 3),
        ei in prop::sample::select(vec![0.0, 9e-6, 1e-3, 10.0]),
        ea in prop::sample::select(vec![1e3, 1e5, f64::INFINITY]),
        rule in prop::sample::select(RULES.as_slice()),
        stepping in prop::sample::select(vec![Stepping::Once, Stepping::Cut]),
        end in prop::sample::select(vec![ContactEnd::Free, ContactEnd::Tangent]),
        (tilt, has_mold) in (0.0..1.2_f64, any::<bool>()),
    ) {
        let mut scene = example("01_flat_sheared_mold");
        scene.layup.ply.grid.nu = nu;
        scene.layup.ply.grid.nv = nv;
        let grid = scene.layup.ply.grid;
        if let Section::Line { flexural_rigidity, .. } = &mut scene.layup.ply.material.section {
            *flexural_rigidity = ei;
        }
        scene.layup.settings.axial_stiffness = ea;
        scene.layup.settings.slopes = rule;
        scene.layup.settings.contact = contact(1e-3, stepping, end);
        let normal = [tilt.sin(), 0.0, tilt.cos()];
        scene.layup.mold = has_mold.then_some(Mold::Plane(Plane { point: [0.0; 3], normal }));
        let place = |step: usize| (0..grid.grippers()).map(|n| {
            let [i, j] = grid.id(n).map(|k| 0.099 * k as f64);
            let r = |k: usize| if step == 0 { 0.0 } else { wild * random[36 * (step - 1) + 3 * n + k] };
            // whole millimeters now and then: exactly stacked grippers, exactly taut spans
            let snap = |x: f64| if step == 2 { (x * 10.0).round() / 10.0 } else { x };
            [snap(i + r(0)), snap(j + r(1)), snap(0.05 - 0.02 * step as f64 + r(2))]
        }).collect::<Vec<_>>();
        scene.layup.motion = motion((0..4).map(place).collect());
        scene.layup.target = None;
        let result = drape(&scene);
        let text = result.text();
        prop_assert!(text.is_ok(), "{:?}", text.err());
        // a drape that no ply survives ends early
        let last = result.summary.steps;
        prop_assert!(last == 4 || result.summary.stopped.is_some());
        check_record(&result);
    }
}
