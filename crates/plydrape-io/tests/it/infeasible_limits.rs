//! What a scene rules out by itself, before any plan: each limit with its amount, from plane geometry.

use crate::common::parse;
use plydrape::errors::{Errors, RelativeError};
use plydrape::layup::Lip;
use plydrape::measure::{Name, Verdict};
use plydrape::planner::infeasible_limits::{infeasible_limits, with_spring_back};
use plydrape::scene::Scene;
use plydrape_io::scene;
use plydrape_io::text::foreseen::foreseen;
use std::path::Path;

const PLY: &str = "grippers = [4, 2]\ncell = [\"100 mm\", \"100 mm\"]\nmaterial = \"krogh2018\"\n";
const START: &str = "spacing = [\"98 mm\", \"98 mm\"]\nheight = \"75 mm\"\n";

fn found(base: &Path, text: &str) -> Vec<Verdict> {
    let scene = scene::parse(text, base, "scene.toml").unwrap_or_else(|e| panic!("{e}")).scene;
    infeasible_limits(&scene)
}

/// The infeasible limits of 4 × 2 grippers over a flat mold, sheared by 20° at the target.
fn flat(more: &str) -> Vec<Verdict> {
    let text = format!(
        "[model]\nkind = \"catenaries\"\n[ply]\n{PLY}[mold]\nkind = \"plane\"\n[grippers]\n{START}[target]\nshear = \"20 deg\"\n{more}\n"
    );
    found(Path::new(""), &text)
}

/// Infeasible limits of 2 × 2 grippers with targets at positions (m).
fn with_targets(targets: [[f64; 3]; 4], more: &str) -> Vec<Verdict> {
    let [a, b, c, d] = targets;
    let text = format!(
        "[model]\nkind = \"catenaries\"\n[ply]\n{}[mold]\nkind = \"plane\"\n[grippers]\n{START}[target]\npositions = [[{a:?}, {b:?}], [{c:?}, {d:?}]]\n{more}\n",
        PLY.replace("[4, 2]", "[2, 2]")
    );
    found(Path::new(""), &text)
}

/// The only infeasible limit, by name, value, limit and step; and its place.
fn only(found: &[Verdict], name: &str, value: f64, limit: f64, step: Option<usize>) -> String {
    let [verdict] = found else {
        panic!("{found:?}");
    };
    assert_eq!(
        (verdict.name.measure().name(), verdict.step, verdict.ok),
        (name, step, false),
        "{found:?}"
    );
    assert!((verdict.value - value).abs() < 1e-6 * value.max(1.0), "{found:?}");
    assert!((verdict.limit - limit).abs() < 1e-9 * limit.max(1.0), "{found:?}");
    verdict.at.clone()
}

/// A square of fabric laid flat.
const SQUARE: [[f64; 3]; 4] = [[0.0; 3], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0], [0.1, 0.1, 0.0]];

#[test]
fn a_scene_that_can_be_draped_has_no_obstacle() {
    assert!(found(Path::new(""), scene::TEMPLATE).is_empty());
    assert!(flat("").is_empty());
    assert!(with_targets(SQUARE, "").is_empty());
}

/// Cups of 15 mm that stand upright on a flat mold, and a clamp whose side is 3 mm from the nearest two.
#[test]
fn an_obstacle_too_near_to_the_target_is_named() {
    let bodies = |side: f64| {
        format!(
            "[[bodies]]\nname = \"cup\"\non = \"pad\"\ncylinder = {{ radius = 0.015, to = 0.03 }}\n\
             [[obstacles]]\nname = \"clamp\"\nbox = {{ size = [0.1, 1, 0.1], at = [{}, 0, 0] }}\n",
            side + 0.05
        )
    };
    let found = with_targets(SQUARE, &bodies(0.118));
    let at = only(&found, "clearance", 3.0, 5.0, None);
    assert!(at.starts_with("cup of g1_"), "{at}");
    assert!(at.ends_with(" and obstacle clamp at the target"), "{at}");
    assert!(with_targets(SQUARE, &bodies(0.1201)).is_empty());
}

/// A limit that is met exactly is none: the target is sheared by 20°.
#[test]
fn the_shear_of_the_ideal_drape_is_known_before_the_plan() {
    assert!(flat("[limits]\nshear = \"20 deg\"").is_empty());
    let at = only(&flat("[limits]\nshear = \"15 deg\""), "shear", 20.0, 15.0, None);
    assert!(at.starts_with("net cell [") && at.contains("ideal drape, at ("), "{at}");
}

/// A rhombus leaning by 30°.
#[test]
fn targets_given_by_position_have_the_shear_of_their_parallelogram() {
    let (sin, cos) = 30f64.to_radians().sin_cos();
    let (x, y) = (0.1 * sin, 0.1 * cos);
    let rhombus = [[0.0; 3], [0.1, 0.0, 0.0], [x, y, 0.0], [0.1 + x, y, 0.0]];
    let at =
        only(&with_targets(rhombus, "[limits]\nshear = \"20 deg\""), "shear", 30.0, 20.0, None);
    assert_eq!(at, "cell [0,0] of the target");
}

/// 101 mm between two targets, and 100 mm of fabric.
#[test]
fn targets_further_apart_than_the_fabric_are_named() {
    let mut targets = SQUARE;
    targets[1][0] = 0.101;
    let at = only(&with_targets(targets, ""), "overstretch", 1.0, 0.1, None);
    assert_eq!(at, "edge g0_0–g1_0 at the target");
}

#[test]
fn targets_inside_the_mold_are_named() {
    let at =
        only(&with_targets(SQUARE.map(|[x, y, _]| [x, y, -0.005]), ""), "off_mold", 5.0, 0.2, None);
    assert!(at.starts_with("target of gripper g0_0, inside"), "{at}");
}

/// The start is 15 mm above the box, the target on its floor.
#[test]
fn a_start_outside_the_workspace_is_named() {
    let limits = "[limits]\nworkspace = [[-1, 1], [-1, 1], [0, \"60 mm\"]]";
    let at = only(&flat(limits), "workspace", 15.0, 0.0, Some(1));
    assert_eq!(at, "gripper g0_0 at the start");
}

/// The far corner of the target is 300 mm + 100 mm · sin 20° off along x.
#[test]
fn a_target_outside_the_workspace_is_named() {
    let limits = "[limits]\nworkspace = [[-1, \"330 mm\"], [-1, 1], [0, 1]]";
    let value = 300.0 + 100.0 * 20f64.to_radians().sin() - 330.0;
    let at = only(&flat(limits), "workspace", value, 0.0, None);
    assert_eq!(at, "gripper g3_1 at the target");
}

/// 98 mm at the start, 100 mm at the target.
#[test]
fn grippers_too_close_at_the_start_are_named() {
    let limits = "[limits]\ngripper_distance = \"99 mm\"";
    let at = only(&flat(limits), "gripper_distance", 98.0, 99.0, Some(1));
    assert!(at.starts_with("grippers g") && at.ends_with("at the start"), "{at}");
}

/// Ten moves of 5 mm; the last gripper is the one that the shear carries furthest.
#[test]
fn moves_too_short_for_the_way_are_named() {
    assert!(flat("[plan]\nsteps = 19\nmove_limit = \"5 mm\"").is_empty());
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let way = (6.0 + 100.0 * sin).hypot(100.0 * cos - 98.0).hypot(75.0);
    let found = flat("[plan]\nsteps = 11\nmove_limit = \"5 mm\"");
    let at = only(&found, "move_limit", way, 50.0, None);
    assert_eq!(at, "straight way of gripper g3_1 in 10 moves");
}

/// A plane that climbs by 45° under joints that take 40°.
#[test]
fn a_mold_steeper_than_the_joints_is_named() {
    let text = format!(
        "[model]\nkind = \"catenaries\"\n[ply]\n{PLY}[mold]\nkind = \"plane\"\ntilt = \"45 deg\"\n[grippers]\n{START}parallel_to_mold = true\n[target]\n"
    );
    let at = only(&found(Path::new(""), &text), "tilt", 45.0, 40.0, None);
    assert!(at.starts_with("mold at the target of gripper g"), "{at}");
}

/// A flat mesh with a hole of 50 mm in its middle: 4 × 4 nodes of the 10 mm net lie inside it.
#[test]
fn a_hole_under_the_ply_is_named_though_every_gripper_has_a_place() {
    let folder = tempfile::tempdir().unwrap();
    let mut mesh = String::new();
    for j in 0..7 {
        for i in 0..7 {
            mesh += &format!("v {} {} 0\n", 50 * i - 45, 50 * j - 45);
        }
    }
    for (i, j) in (0..36).map(|n| (n % 6, n / 6)).filter(|cell| *cell != (3, 3)) {
        let first = 1 + 7 * j + i;
        mesh += &format!("f {} {} {} {}\n", first, first + 1, first + 8, first + 7);
    }
    std::fs::write(folder.path().join("mold.obj"), mesh).unwrap();
    let text = "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 2]\ncell = [0.2, 0.2]\nmaterial = \"krogh2018\"\n[mold]\nkind = \"mesh\"\nfile = \"mold.obj\"\nunit = \"mm\"\n[target]\nmesh = \"10 mm\"\n";
    let found = found(folder.path(), text);
    let at = only(&found, "missing_nodes", 25.0, 0.0, None);
    assert!(at.contains("beyond the boundary of the mold, at ("), "{at}");
}

/// A plan is warned of an edge that touches a mold that sticks before its cup. The fold is what the theory of a heavy
/// clamped edge and of a ruck make of its slack, and an edge of the length that the sentence proposes is not warned of; a
/// mold on which the ply slides, and a short edge, are not either.
#[test]
fn an_edge_that_folds_is_foreseen_and_the_length_that_is_proposed_is_not() {
    let warned = |overhang_mm: f64, friction: &str| {
        let scene = parse(&format!(
            r#"
            ply = {{ grippers = [3, 2], cell = [0.1, 0.1], overhang = {}, material = "prepreg_warm" }}
            mold = {{ kind = "plane" }}
            target = {{ seed = "middle" }}
            contact = {{ friction = {friction} }}
            grippers = {{ spacing = [0.099, 0.099], height = 0.2 }}
            "#,
            1e-3 * overhang_mm
        ));
        foreseen(&scene)
    };
    assert_eq!(warned(8.0, "\"stick\""), [""; 0]);
    assert_eq!(warned(25.0, "0.3"), [""; 0]);

    let [sentence] = &warned(25.0, "\"stick\"")[..] else { panic!("one warning") };
    let number_after = |words: &str| -> f64 {
        let after = sentence.split(words).nth(1).expect(words);
        after.split_whitespace().next().and_then(|word| word.parse().ok()).expect(words)
    };
    assert_eq!(number_after("reaches up to "), 25.0);
    // slack 9 θ² L/28 of a turn θ = q L³/6D, twice the height 1.3256 l^(3/7) s^(4/7) at a corner
    let (weight, rigidity, length) = (0.3143 * 9.80665, 2e-5, 0.025_f64);
    let turn: f64 = weight * length.powi(3) / (6.0 * rigidity);
    let slack = 9.0 / 28.0 * turn * turn * length;
    let height = 1.3256 * (rigidity / weight).powf(1.0 / 7.0) * slack.powf(4.0 / 7.0);
    let fold = number_after("folds of some ");
    assert!((fold / (2e3 * height) - 1.0).abs() < 0.01, "{fold} and {} mm", 2e3 * height);

    let proposed = number_after("what an edge of ");
    assert_eq!(warned(proposed, "\"stick\""), [""; 0]);
    assert_eq!(warned(1.02 * proposed, "\"stick\"").len(), 1);
}

/// A ply of 3 × 3 cups in a usual cell, on a mold that it slides on.
fn slippery(mold: &str, material: &str) -> Scene {
    beyond_cups(0.0, mold, material)
}

/// Such a ply with an edge beyond the cups (mm).
fn beyond_cups(overhang: f64, mold: &str, material: &str) -> Scene {
    parse(&format!(
        "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [3, 3]\ncell = [\"100 mm\", \"100 mm\"]\noverhang = \"{overhang} mm\"\nmaterial = {material}\n[mold]\n{mold}\n[grippers]\n{START}[target]\nseed = \"middle\"\n[contact]\nfriction = 0.3\n[sheet]\nmesh = \"20 mm\"\n"
    ))
}

const DOME: &str = "kind = \"sphere\"\nradius = \"0.6 m\"\nposition = [0, 0, \"-0.6 m\"]";
const CYLINDER: &str = "kind = \"cylinder\"\nradius = \"0.4 m\"\nposition = [0, 0, \"-0.4 m\"]";

/// A ply of a shear stiffness (N/m).
fn ply(shear: f64) -> String {
    format!(
        "{{ name = \"ply\", source = \"a test\", tension = \"1e6 N/m\", mass = \"0.3 kg/m^2\", bending_rigidity_warp = \"2e-5 N m\", bending_rigidity_weft = \"2e-5 N m\", shear_curve = \"{shear} N/m\" }}"
    )
}

/// The height of a nominal ply that springs back (mm); `None` of one that stays.
fn springs_back(scene: &Scene) -> Option<f64> {
    let found = with_spring_back(scene, false, &|| false);
    assert!(found.iter().all(|verdict| verdict.name == Name::Height), "{found:?}");
    found.first().map(|verdict| verdict.value)
}

/// What curves in one direction alone is bent and not sheared, so it stays where it is laid; on a dome a ply is sheared, and springs back.
#[test]
fn a_ply_springs_back_from_a_dome_and_stays_on_a_cylinder() {
    assert_eq!(springs_back(&slippery(CYLINDER, "\"prepreg_warm\"")), None);
    assert!(springs_back(&slippery(DOME, "\"prepreg_warm\"")).is_some());
}

/// An edge beyond the cups is laid like the rest: it lies on a cylinder without stretch, and on a dome it springs back farther.
#[test]
fn an_edge_beyond_the_cups_is_laid_too() {
    let height = |overhang, mold| springs_back(&beyond_cups(overhang, mold, "\"prepreg_warm\""));
    assert_eq!(height(30.0, CYLINDER), None);
    let [without, with] =
        [0.0, 30.0].map(|overhang| height(overhang, DOME).expect("it springs back"));
    assert!(with > without, "{with} and {without} mm");
}

/// A ply slides down a ramp of which too much is steeper than its friction holds, tan θ > μ, and stays on one that is nowhere so steep.
#[test]
fn a_ply_slides_on_a_slope_steeper_than_its_friction() {
    let found = |steepest: f64| {
        let ramp = format!(
            "kind = \"formula\"\nz = \"{} * tanh(x / 0.15)\"\nposition = [0, 0, -0.1]",
            0.15 * steepest
        );
        with_spring_back(&slippery(&ramp, "\"prepreg_warm\""), false, &|| false)
    };
    assert_eq!(found(0.28), []);
    let slid = found(0.6);
    let [verdict] = slid.as_slice() else { panic!("{slid:?}") };
    assert_eq!(verdict.name, Name::Position);
    let said = "let go of: the ply slides, and would stay if it stuck to the mold";
    assert!(verdict.at.ends_with(said), "{verdict:?}");
}

/// On a plane a ply that slides never stops, and is found all the same: where tan θ > μ, and not where it is less.
#[test]
fn a_ply_slides_down_a_plane_without_end() {
    let found = |tilt: f64| {
        let plane = format!("kind = \"plane\"\ntilt = \"{tilt} deg\"");
        with_spring_back(&slippery(&plane, "\"prepreg_warm\""), false, &|| false)
    };
    // atan 0.3 = 16.7°
    assert_eq!(found(15.5), []);
    let slid = found(18.0);
    let [verdict] = slid.as_slice() else { panic!("{slid:?}") };
    assert_eq!(verdict.name, Name::Position);
    assert!(verdict.at.contains("the ply slides, and would stay if it stuck"), "{verdict:?}");
    // no farther than the ply is long
    assert!(verdict.value <= 200.0 * f64::sqrt(2.0) + 1e-6, "{verdict:?}");
}

/// Where a ply lies exactly on its mold, rounding does not decide which of its nodes stick: at any place it would stay where it stuck.
#[test]
fn a_ply_that_sticks_to_a_plane_stays_wherever_the_plane_is() {
    for away in [0.0, 0.213_399, 0.721_305] {
        let plane = format!(
            "kind = \"plane\"\npoint = [{away}, 0.609629, -0.0686538]\ntilt = \"20.651 deg\"\ntilt_direction = \"-158.1 deg\""
        );
        let scene = parse(&format!(
            "[cell]\npreset = \"usual\"\n[ply]\ngrippers = [3, 3]\ncell = [\"115 mm\", \"117 mm\"]\noverhang = \"45 mm\"\nmaterial = \"prepreg_warm\"\n[mold]\n{plane}\n[target]\nseed = [\"0 mm\", \"175.5 mm\"]\norigin = [{}, 0.721641]\ndirection = \"-73.422 deg\"\nshear = \"14.823 deg\"\n[grippers]\nspacing = [\"111.576 mm\", \"115.268 mm\"]\nheight = \"66.0772 mm\"\norigin = \"centered\"\n",
            away + 0.02566
        ));
        assert_eq!(with_spring_back(&scene, false, &|| false), [], "{away}");
    }
}

/// What springs back is held by no cup: lips change nothing of it.
#[test]
fn a_ply_springs_back_whatever_cups_held_it() {
    let mut scene = slippery(DOME, "\"prepreg_warm\"");
    let bare = springs_back(&scene).expect("a ply that springs back");
    scene.layup.settings.pad.lip = Some(Lip { radius: 0.015, rigidity: 1e-3 });
    assert_eq!(springs_back(&scene), Some(bare));
}

/// The remedy that is said is one: a ply so limp stays, and the scene has no limit left that no plan can keep.
#[test]
fn a_ply_that_springs_back_stays_with_the_shear_stiffness_that_is_said() {
    let stiff = with_spring_back(&slippery(DOME, &ply(40.0)), false, &|| false);
    let share = said_share(&stiff);
    assert_eq!(springs_back(&slippery(DOME, &ply(40.0 * share))), None);
}

/// The share of its shear stiffness with which a ply is said to stay.
fn said_share(limits: &[Verdict]) -> f64 {
    let [verdict] = limits else { panic!("{limits:?}") };
    let said = verdict.at.split("would stay with ").nth(1).and_then(|rest| rest.split(' ').next());
    said.unwrap_or_else(|| panic!("{verdict:?}")).parse().expect("a share")
}

/// A ply that stays is refused if its stiffer cells do not, and is not with the share of its stiffness that is said; a plan without errors
/// does not ask for them.
#[test]
fn a_sample_is_refused_if_its_stiffest_plies_spring_back() {
    let scene = |shear: f64| slippery(DOME, &ply(shear));
    let limits = |shear: f64| with_spring_back(&scene(shear), true, &|| false);
    // the stiffest ply that is known to stay
    let stays = (1..=40).map(f64::from).rfind(|shear| springs_back(&scene(*shear)).is_none());
    let stays = stays.expect("one that stays");
    let refused = limits(stays);
    assert!(refused[0].at.contains("of the 64 cells of the sample"), "{refused:?}");
    assert_eq!(limits(stays * said_share(&refused)), []);
}

/// A ply that is as many times heavier as it is stiffer takes the same shape.
#[test]
fn a_ply_springs_back_by_its_stiffness_over_its_weight() {
    let mut scene = slippery(DOME, "\"prepreg_warm\"");
    let own = springs_back(&scene).expect("a ply that springs back");
    let mut twice = Errors::default().draw(0, 9);
    let material = &mut twice.material;
    for error in [&mut material.areal_mass, &mut material.bending, &mut material.shear] {
        *error = RelativeError::Share(1.0);
    }
    scene.layup = twice.apply(&scene.layup);
    let heavier = springs_back(&scene).expect("a heavier ply that springs back");
    assert!((heavier / own - 1.0).abs() < 0.02);
}
