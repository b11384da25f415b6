//! Bodies and obstacles: what scenes say of them, how drapes and plans are judged by them, and what results keep.

use crate::common::{decided, drape, examples};
use plydrape::bodies::{Bodies, Body, Mount, Obstacle, Shape};
use plydrape::clearance::{self, Poses};
use plydrape::layup::Model;
use plydrape::measure::Name;
use plydrape::measure::Verdict;
use plydrape::mold::Pose;
use plydrape::planner;
use plydrape::scene::Scene;
use plydrape_io::Error;
use plydrape_io::result::ResultFile;
use plydrape_io::scene::{self};
use std::ops::ControlFlow;
use std::path::Path;

/// Two grippers of a strip that go straight from x = 0 to x = 0.5 m at the height of 50 mm, with a cup on each.
fn passing(more: &str) -> String {
    format!(
        "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [2, 1]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n\
         [grippers]\nspacing = [0.098, 0.098]\nheight = 0.05\n\
         [target]\npositions = [[[0.5, 0, 0.05], [0.598, 0, 0.05]]]\n\
         [motion]\nkind = \"straight\"\nsteps = 6\n{more}\n"
    )
}

const CUP: &str =
    "[[bodies]]\nname = \"cup\"\non = \"pad\"\ncylinder = { radius = \"15 mm\", to = \"30 mm\" }\n";

fn parse(text: &str) -> Result<Scene, Error> {
    let base = Path::new(env!("CARGO_MANIFEST_DIR"));
    scene::parse(text, base, "scene.toml").map(|file| file.scene)
}

fn read(text: &str) -> Scene {
    parse(text).unwrap_or_else(|e| panic!("{text}\n{e}"))
}

fn verdict(result: &ResultFile) -> Option<&Verdict> {
    result.summary.limits.iter().find(|verdict| verdict.name == Name::Clearance)
}

/// A wall of 2 mm between the steps 3 and 4: no step is near it, and the way between them goes through it. Who, what, when and where
/// stand in the verdict; at the first steps nothing is near but the other cup.
#[test]
fn an_obstacle_between_two_steps_is_met_and_named() {
    let wall =
        "[[obstacles]]\nname = \"wall\"\nbox = { size = [0.002, 1, 1] }\nposition = [0.36, 0, 0]\n";
    let result = drape(&read(&passing(&format!("{CUP}{wall}"))));
    let found = verdict(&result).unwrap();
    assert!(!found.ok && found.value <= 0.0 && found.limit == 5.0 && found.is_least(), "{found:?}");
    assert!(!result.summary.accepted());
    assert!(found.at.starts_with("cup of g"), "{found:?}");
    assert!(
        found.at.contains(" and obstacle wall at ") && found.at.contains(" s near ("),
        "{found:?}"
    );
    assert!((found.place.unwrap()[0] - 0.36).abs() < 0.02, "{found:?}");
    let values: Vec<f64> =
        result.steps.iter().map(|step| step.measures.value(Name::Clearance).unwrap()).collect();
    // the ply sags between the cups, which lean towards each other by its slope there
    let (sin, cos) = result.steps[0].grippers[0].tilt_deg.to_radians().sin_cos();
    let wanted = 98.0 - 2.0 * (15.0 * cos + 30.0 * sin);
    assert!((values[0] - wanted).abs() < 1e-3 && values[2] > 40.0, "{values:?} {wanted}");
    assert!(plydrape_io::text::table::details(&result).contains("and obstacle wall at"));
    // a wall beside the way is not met
    let beside = "[[obstacles]]\nname = \"wall\"\nbox = { size = [1, 0.002, 1] }\nposition = [0.36, 0.05, 0]\n";
    let result = drape(&read(&passing(&format!("{CUP}{beside}"))));
    let found = verdict(&result).unwrap();
    // 50 mm less the radius of the cup and half of the wall, but for the tilt of the cup
    assert!(found.ok && (found.value - 34.0).abs() < 1.0, "{found:?}");
}

/// A cube as a box, as a mesh and turned by a quarter, placed by `position` or by `at`.
#[test]
fn a_mesh_is_as_near_as_the_box_that_it_is() {
    let stl = cube_as_stl();
    let file = std::env::temp_dir().join(format!("plydrape-cube-{}.stl", std::process::id()));
    std::fs::write(&file, stl).unwrap();
    let shapes = [
        "box = { size = [0.04, 0.04, 0.04] }\nposition = [0.3, 0.06, 0.06]".to_owned(),
        "box = { size = [0.04, 0.04, 0.04], at = [0.3, 0.06, 0.06] }".into(),
        "box = { size = [0.04, 0.04, 0.04] }\nposition = [0.3, 0.06, 0.06]\nrotation = [0, 0, \"90 deg\"]".into(),
        format!("mesh = {:?}\nunit = \"mm\"\nposition = [0.3, 0.06, 0.06]", file.to_str().unwrap()),
    ];
    let near = |shape: &String| {
        let obstacle = format!("[[obstacles]]\nname = \"clamp\"\n{shape}\n");
        let result = drape(&read(&passing(&format!("{CUP}{obstacle}"))));
        let found = verdict(&result).unwrap().clone();
        assert!(found.at.contains("clamp"), "{found:?}");
        found.value
    };
    let values: Vec<f64> = shapes.iter().map(near).collect();
    std::fs::remove_file(&file).unwrap();
    // 60 mm less 20 mm and the radius, and a little less where the cup tilts
    assert!((values[0] - 25.0).abs() < 1.5, "{values:?}");
    // each is found to a hundredth
    assert!(values.iter().all(|value| (value / values[0] - 1.0).abs() < 0.02), "{values:?}");
}

/// A cube of 40 mm about the origin, as text.
fn cube_as_stl() -> String {
    let corner = |n: usize| [0, 1, 2].map(|c| if n >> c & 1 == 1 { 20.0 } else { -20.0 });
    let faces =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let mut text = "solid cube\n".to_owned();
    for [a, b, c, d] in faces {
        for triangle in [[a, b, c], [a, c, d]] {
            text += "facet normal 0 0 0\nouter loop\n";
            for n in triangle {
                let [x, y, z] = corner(n);
                text += &format!("vertex {x} {y} {z}\n");
            }
            text += "endloop\nendfacet\n";
        }
    }
    text + "endsolid cube\n"
}

/// Without bodies nothing is judged, and no file says anything of clearances, whatever stands in the cell.
#[test]
fn a_scene_without_bodies_says_nothing_of_clearances() {
    let result = drape(&read(&passing("")));
    assert!(verdict(&result).is_none());
    let mut file: serde_json::Value = serde_json::from_str(&result.text().unwrap()).unwrap();
    // limits are a map, of what is not there too
    file["scene"]["limits"].as_object_mut().unwrap().remove("clearance").expect("its usual limit");
    for text in [file.to_string(), plydrape_io::write::csv::steps(&result).unwrap()] {
        assert!(!text.contains("clearance") && !text.contains("bodies"), "{text}");
    }
    let wall =
        "[[obstacles]]\nname = \"wall\"\nbox = { size = [0.002, 1, 1] }\nposition = [0.36, 0, 0]\n";
    assert!(verdict(&drape(&read(&passing(wall)))).is_none());
}

/// What is read back is what was written, and its clearances are the same.
#[test]
fn a_result_keeps_bodies_and_obstacles() {
    let more = format!(
        "{CUP}[[bodies]]\nname = \"stem\"\non = \"stem\"\nbox = {{ size = [0.01, 0.02, 0.1], at = [0, 0, 0.09] }}\n\
         [[obstacles]]\nname = \"post\"\ncylinder = {{ radius = 0.01, from = -0.1, to = 0.2 }}\nposition = [0.2, 0.1, 0]\nrotation = [0.1, 0, 0]\n\
         [limits]\nclearance = \"12 mm\"\n"
    );
    let scene = read(&passing(&more));
    let result = drape(&scene);
    let read = plydrape_io::result::read::parse(
        result.text().unwrap().as_bytes(),
        Path::new("result.json"),
    )
    .unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(read.scene.bodies, scene.layup.bodies);
    assert_eq!(
        (read.scene.limits.most(Name::Clearance), read.summary.limits),
        (0.012, result.summary.limits)
    );
    let cup = Shape::Cylinder { radius: 0.015, from: 0.0, to: 0.03 };
    assert_eq!(
        scene.layup.bodies.bodies()[0],
        Body { name: "cup".into(), on: Mount::Pad, shape: cup }
    );
    let stem = Shape::Box { size: [0.01, 0.02, 0.1], at: [0.0, 0.0, 0.09] };
    assert_eq!(
        scene.layup.bodies.bodies()[1],
        Body { name: "stem".into(), on: Mount::Stem, shape: stem }
    );
    assert_eq!(scene.layup.bodies.obstacles()[0].pose, Pose::new([0.2, 0.1, 0.0], [0.1, 0.0, 0.0]));
}

/// A damaged result whose body has no shape, or whose obstacle is askew, is no result.
#[test]
fn an_impossible_body_in_a_result_is_refused() {
    let wall =
        "[[obstacles]]\nname = \"wall\"\nbox = { size = [0.002, 1, 1] }\nposition = [0.36, 0, 0]\n";
    let result = drape(&read(&passing(&format!("{CUP}{wall}"))));
    let refused = |change: &dyn Fn(&mut Vec<Body>, &mut Vec<Obstacle>)| {
        let mut result = result.clone();
        let bodies = &result.scene.bodies;
        let (mut moving, mut standing) = (bodies.bodies().to_vec(), bodies.obstacles().to_vec());
        change(&mut moving, &mut standing);
        result.scene.bodies = Bodies::new(moving, standing);
        let text = result.text().unwrap();
        plydrape_io::result::read::parse(text.as_bytes(), Path::new("result.json")).is_err()
    };
    assert!(!refused(&|_, _| {}));
    assert!(refused(&|bodies, _| {
        bodies[0].shape = Shape::Cylinder { radius: 0.0, from: 0.0, to: 0.1 };
    }));
    assert!(refused(&|bodies, _| {
        let (vertices, triangles) = (vec![[0.0; 3]; 3], vec![[0, 1, 3]]);
        bodies[0].shape = Shape::Mesh { vertices, triangles };
    }));
    assert!(refused(&|_, obstacles| obstacles[0].pose.axes[0] = [2.0, 0.0, 0.0]));
}

/// Where no catenaries hang, because the cups are an array across the yarns, the motion is judged by its bodies all the same.
#[test]
fn a_ply_without_catenaries_is_judged_too() {
    let text = format!(
        "[ply]\nsize = [0.4, 0.3]\ncell = [0.1, 0.1]\ngrippers = [3, 2]\nmaterial = \"krogh2018\"\n\
         array = {{ direction = \"20 deg\" }}\n[mold]\nkind = \"plane\"\n[grippers]\nheight = 0.1\nspacing = [0.098, 0.098]\n\
         [target]\nseed = \"middle\"\n[motion]\nkind = \"straight\"\nsteps = 8\n[sheet]\nmesh = 0.05\n{CUP}\
         [[obstacles]]\nname = \"beam\"\nbox = {{ size = [2, 2, 0.02] }}\nposition = [0, 0, 0.04]\n"
    );
    let scene = read(&text);
    assert!(!scene.layup.ply.has_lines());
    let folder = tempfile::tempdir().unwrap();
    let result = decided(&scene, folder.path());
    let found = verdict(&result).unwrap();
    assert!(!found.ok && found.at.contains("beam"), "{found:?}");
    assert!(!result.summary.accepted());
}

/// The example, in an ideal cell: straight paths run the cups into the fixture; the plan goes over it, and keeps the limit at any time.
#[test]
fn a_plan_goes_over_a_fixture_that_straight_paths_run_into() {
    // catenaries know no mounts
    let text = std::fs::read_to_string(examples().join("16_fixture/scene.toml")).unwrap();
    let text = text.replace("preset = \"usual\"", "preset = \"ideal\"");
    let mut scene = read(&text.replace("prepreg_warm", "krogh2018"));
    scene.layup.settings.model = Model::Catenaries;
    let straight = drape(&scene);
    let found = verdict(&straight).unwrap();
    assert!(!found.ok && found.at.contains("obstacle fixture"), "{found:?}");

    let planned = planner::plan(&scene, None, &mut |_| ControlFlow::Continue(())).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let result = ResultFile::planned(&scene, None, planned.clone(), folder.path()).unwrap();
    let found = verdict(&result).unwrap();
    assert!(found.ok && found.value >= 5.0, "{found:?}");
    // the search is to keep a tenth more, from where on a limit that is to be kept does not count
    let mut least = f64::INFINITY;
    for k in 0..=2000 {
        let t = planned.motion.duration() * f64::from(k) / 2000.0;
        let places = planned.motion.at(t);
        let poses = Poses::free(&places, &planned.attitudes.at(t), &places);
        least = least.min(clearance::at_poses(&scene.layup, 5e-3, &poses).unwrap().distance);
    }
    // what is reported may be wrong by a hundredth
    assert!(least * 1e3 >= found.value * 0.99 && least >= 4.95e-3, "{least} {found:?}");
    // it does go over the fixture
    let highest = planned.motion.positions().iter().flatten().map(|p| p[2]).fold(0.0, f64::max);
    assert!(highest > 0.12 && highest < 0.25, "{highest}");
}
