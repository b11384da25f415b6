//! Every limit of a scene is judged by the model that decides, along a motion that is given and along one that is planned.

use plydrape::bodies::{Bodies, Body, Mount, Obstacle, Shape};
use plydrape::layup::{Layup, Model};
use plydrape::material::Material;
use plydrape::measure::{Name, Scope, Verdict};
use plydrape::mold::{Face, Mold, Pose, Sphere};
use plydrape::outcome::{Status, Summary, judge};
use plydrape::ply::{Grid, Ply};
use plydrape::scene::PlanMethod;
use plydrape::tool::{Axis, Tool};
use plydrape::{Error, Limits, Motion, Scene, Settings, plan, simulate};
use std::collections::BTreeSet;
use std::ops::ControlFlow;

fn ply(nu: usize, nv: usize) -> Ply {
    let material = Material::woven("paper", 3.143, 9e-5, 1e6, 5.0);
    Ply::of_array(Grid { nu, nv }, [0.1; 2], material)
}

/// Cups and a frame with axes that lay a ply on a dome beside a post, and a limit of everything that a scene may bound. The mounts of the
/// cups give, or are rigid; cups on rigid mounts do not slip.
fn scene(model: Model, gives: bool) -> Scene {
    let sphere = Sphere { pose: Pose::upright([0.0, 0.0, -1.0]), radius: 1.0, face: Face::Outside };
    let mut scene = Scene::above(ply(2, 2), Mold::Sphere(sphere), [0.0; 2]).unwrap();
    let Layup { motion, settings, target, tool, bodies, .. } = &mut scene.layup;
    settings.model = model;
    (settings.sheet.mesh, settings.sheet.overhang) = (Some(0.03), 0.02);
    settings.pad.radius = 0.01;
    settings.pad.holding_force = Some(50.0);
    if gives {
        (settings.pad.lateral_stiffness, settings.pad.axial_stiffness) = (Some(2e3), Some(5e3));
        settings.pad.slip_force = Some(50.0);
    }
    let start = motion.positions[0].clone();
    let end = &target.as_ref().unwrap().grippers;
    let between = |share: f64| {
        let pairs = start.iter().zip(end);
        pairs.map(|(a, b)| [0, 1, 2].map(|c| a[c] + share * (b[c] - a[c]))).collect()
    };
    let positions = (0..=8).map(|k| between(f64::from(k) / 8.0)).collect();
    *motion = Motion { times: (0..=8).map(|k| 0.2 * f64::from(k)).collect(), positions };
    let direction = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let axis = |n: usize| Axis {
        name: ["x", "y", "z"][n].into(),
        direction: direction[n],
        stroke: [-0.1, 0.1],
        speed: 0.5,
    };
    *tool = Some(Tool { residual: Some(1e-3), ..Tool::new(&start, (0..3).map(axis).collect()) });
    let cylinder = Shape::Cylinder { radius: 0.01, from: 0.0, to: 0.03 };
    let cup = Body { name: "cup".into(), on: Mount::Pad, shape: cylinder };
    let pose = Pose::upright([0.5, 0.0, 0.0]);
    let shape = Shape::Box { size: [0.1; 3], at: [0.0; 3] };
    *bodies = Bodies::new(vec![cup], vec![Obstacle { name: "post".into(), pose, shape }]);

    scene.limits = Limits::usual(&scene.layup);
    scene.limits.workspace = Some([[-2.0, 2.0]; 3]);
    for name in Name::ALL {
        let measure = name.measure();
        if let (Some(bound), None) = (measure.bound(), measure.refusal(&scene.layup)) {
            scene.limits.set(*name, Some(bound.example));
        }
    }
    scene
}

/// The limits that apply to a scene, of measures that count at these times and that its model follows.
fn applying(scene: &Scene, scopes: &[Scope]) -> BTreeSet<Name> {
    let Scene { layup, limits, .. } = scene;
    let applies = |name: &Name| {
        let measure = name.measure();
        let follows = measure.description().model.is_none_or(|own| own == layup.settings.model);
        follows && scopes.contains(&measure.scope()) && name.limit(layup, limits).is_some()
    };
    Name::ALL.iter().copied().filter(applies).collect()
}

/// What was judged; what was not is a limit of the model that does not decide, which somebody has set.
fn names(limits: &[Verdict], model: Model) -> BTreeSet<Name> {
    let names: BTreeSet<Name> = limits.iter().map(|verdict| verdict.name).collect();
    assert_eq!(names.len(), limits.len(), "judged twice: {limits:?}");
    for verdict in limits.iter().filter(|verdict| !verdict.judged) {
        assert_eq!(verdict.name.measure().description().model, Some(model.other()), "{verdict:?}");
        assert!(!verdict.ok && verdict.at.contains("not judged"), "{verdict:?}");
    }
    limits.iter().filter(|verdict| verdict.judged).map(|verdict| verdict.name).collect()
}

/// Whatever decides, what the pads and the joints bear counts.
fn assert_cups_are_judged(summary: &Summary) {
    let names = names(&summary.limits, summary.model);
    for name in [Name::Tilt, Name::TiltRate, Name::GripperLoad, Name::GripperPull, Name::Strain] {
        assert!(names.contains(&name), "{:?} {name:?}", summary.model);
    }
}

const SCENES: [(Model, bool); 3] =
    [(Model::Sheet, false), (Model::Sheet, true), (Model::Catenaries, false)];

/// A limit that applies has a verdict, and no other one has: none is left out, and none is of what the model does not follow.
#[test]
fn every_limit_is_judged_along_a_given_motion() {
    for (model, gives) in SCENES {
        let scene = scene(model, gives);
        let mut expected = applying(&scene, &[Scope::EveryStep, Scope::End]);
        let go_on = || false;
        let found = judge(&scene.layup, &scene.limits, usize::MAX, &go_on).unwrap();
        assert_eq!(names(&found.limits, model), expected, "{model:?} {gives}, as a search judges");

        let summary = summary(&scene);
        assert_eq!(summary.status, Status::Converged);
        expected.extend(applying(&scene, &[Scope::Time, Scope::Motion]));
        expected.insert(Name::ToolResidual);
        assert_eq!(names(&summary.limits, model), expected, "{model:?} {gives}");
        assert_cups_are_judged(&summary);
    }
}

/// Catenaries hold their grippers rigidly: wherever they would follow mounts that give, the scene is refused with the stiffness.
#[test]
fn catenaries_refuse_mounts_that_give() {
    let refused = Error::CatenariesMounts { lateral: Some(2e3), axial: Some(5e3) };
    assert!(refused.to_string().ends_with("give: 2 N/mm along the ply, 5 N/mm across it"));
    let mut mounted = scene(Model::Catenaries, true);
    let Scene { layup, limits, .. } = &mounted;
    assert_eq!(judge(layup, limits, usize::MAX, &|| false).unwrap_err(), refused);
    let simulated = simulate(&mounted, |_| ControlFlow::Continue(()));
    assert_eq!(simulated.unwrap_err(), refused);
    let planned = |scene: &Scene| plan(scene, None, &mut |_| ControlFlow::Continue(()));
    assert_eq!(planned(&mounted).unwrap_err(), refused);

    mounted.layup.settings.model = Model::Sheet;
    mounted.also = true;
    let simulated = simulate(&mounted, |_| ControlFlow::Continue(()));
    assert_eq!(simulated.unwrap_err(), refused, "beside the sheet");
    (mounted.also, mounted.plan.method) = (false, PlanMethod::Stepwise);
    assert_eq!(planned(&mounted).unwrap_err(), refused, "step by step");
}

/// Of a planned motion every limit is judged, those of the motion in time too.
#[test]
fn every_limit_is_judged_along_a_planned_motion() {
    for (model, gives) in [(Model::Sheet, true), (Model::Catenaries, false)] {
        let mut scene = scene(model, gives);
        scene.layup.motion.positions.truncate(1);
        scene.layup.motion.times.truncate(1);
        // one candidate is enough: a plan is judged whether it is good or not
        (scene.plan.steps, scene.plan.evaluations) = (8, 1);
        let planned = plan(&scene, None, &mut |_| ControlFlow::Continue(())).unwrap();
        let summary = &planned.outcome.drape.summary;
        let all = [Scope::EveryStep, Scope::End, Scope::Time, Scope::Motion, Scope::Whole];
        let mut expected = applying(&scene, &all);
        // asked of what all other limits accept
        assert!(!summary.accepted());
        expected.remove(&Name::Sensitivity);
        assert_eq!(names(&summary.limits, model), expected, "{model:?} {gives}");
        assert_cups_are_judged(summary);
    }
}

/// 100 mm of fabric on 80 mm hang from four grippers as steep as a catenary does: tan α = sinh x with sinh x / x = 1.25, so 56° at the grippers, and
/// more than 45° over the cup around them.
fn steep(max_tilt_deg: f64, radius: f64) -> Scene {
    let mut settings = Settings { max_tilt: max_tilt_deg.to_radians(), ..Settings::default() };
    (settings.sheet.mesh, settings.sheet.overhang) = (Some(0.01), radius);
    settings.pad.radius = radius;
    let ply = ply(2, 2);
    let place = |n: usize| {
        let [u, v] = ply.place(n);
        [0.8 * u, v, 0.2]
    };
    let positions = vec![(0..4).map(place).collect()];
    Scene::new(ply.clone(), settings, Motion { times: vec![0.0], positions })
}

fn summary(scene: &Scene) -> Summary {
    simulate(scene, |_| ControlFlow::Continue(())).unwrap().drape.summary
}

/// Ball joints that tilt by 40° do not hold a ply that hangs by 45°, those that tilt by 70° do.
#[test]
fn a_sheet_that_tilts_its_grippers_too_far_is_refused() {
    for (max_tilt_deg, holds) in [(40.0, false), (70.0, true)] {
        let summary = summary(&steep(max_tilt_deg, 0.0));
        let tilt = summary.limits.iter().find(|verdict| verdict.name == Name::Tilt).unwrap();
        assert!(tilt.value > 45.0 && tilt.value < 56.0 && tilt.limit == max_tilt_deg, "{tilt:?}");
        assert_eq!(tilt.ok, holds);
        assert!(holds || !summary.accepted());
    }
}

/// A pad that holds its fabric flat tilts with it up to the end of its joint, and no farther.
#[test]
fn a_pad_stops_at_the_end_of_its_joint() {
    let tilt = |max_tilt_deg: f64| summary(&steep(max_tilt_deg, 0.01)).worst.value(Name::Tilt);
    let [free, stopped] = [70.0, 20.0].map(|most| tilt(most).unwrap());
    assert!(free > 25.0 && free < 70.0, "{free}");
    assert!((stopped - 20.0).abs() < 0.5, "{stopped}");
}
