//! What a plan must reach: every solved mold of the examples, from two heights, evaluated by draping the ply once more
//! along the files that were written. Limits are the defaults of `[limits]`, repeated here as numbers.

use crate::common::{distance, drape, examples};
use plydrape::draping::record::{CatenaryState, Step, Verdict};
use plydrape::equilibrium::Status;
use plydrape::measure::Name;
use plydrape::planner::{self, Planned};
use plydrape::ply::Kind;
use plydrape::scene::Scene;
use plydrape_io::result::ResultFile;
use plydrape_io::scene;
use plydrape_io::{csv, plan, read, table};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

/// Largest slack of a span at the end, as a share of its length.
const SLACK: f64 = 0.0005;
/// Largest bridging gap at the end (m).
const BRIDGING: f64 = 1e-3;
/// Largest overstretch of an edge at any time, as a share of it.
const OVERSTRETCH: f64 = 0.001;
/// Largest landing error of a contact point and of a gripper (mm).
const LANDING: [f64; 2] = [2.0, 0.5];
/// Difference of a cell's shear at the end and when it landed (°).
const LANDING_SHEAR: f64 = 3.0;
/// Largest angle between landed edges and the ideal drape (°).
const FIBRE_ANGLE: f64 = 3.0;
/// Least share of the edges' length that lies on the mold at the end.
const CONTACT_SHARE: f64 = 0.95;
/// Largest tilt of a gripper at any time (°).
const TILT: f64 = 40.0;
/// Largest speed (m/s), acceleration (m/s²) and jerk (m/s³) of a gripper.
const RATES: [f64; 3] = [0.25, 1.0, 10.0];

/// A mold of the examples, as a text that tests change.
struct Example {
    folder: PathBuf,
    text: String,
}

impl Example {
    fn of(name: &str) -> Self {
        let folder = examples().join(name);
        let text = std::fs::read_to_string(folder.join("scene.toml")).expect("a shipped scene");
        Example { folder, text }
    }

    /// With one piece of text for another.
    fn with(&self, from: &str, to: &str) -> Self {
        assert!(self.text.contains(from), "{from} is not in {}", self.text);
        Example { folder: self.folder.clone(), text: self.text.replacen(from, to, 1) }
    }

    /// With other lines in one table, or with that table besides.
    fn with_table(&self, name: &str, change: impl Fn(&str) -> Option<String>, more: &str) -> Self {
        let header = format!("[{name}]");
        let mut inside = false;
        let mut kept = Vec::new();
        let mut lines = Vec::new();
        for line in self.text.lines() {
            if line.starts_with('[') {
                inside = line.trim_end() == header;
            }
            match inside {
                true if line.starts_with('[') => {}
                true => lines.extend(change(line)),
                false => kept.push(line.to_owned()),
            }
        }
        let text = format!("{}\n{header}\n{}\n{more}\n", kept.join("\n"), lines.join("\n"));
        Example { folder: self.folder.clone(), text }
    }

    /// The same scene along a table of poses: no start of its own, steps cut.
    fn along(&self, table: &Path) -> Self {
        let not = |keys: &'static [&'static str]| {
            move |line: &str| {
                let key = line.split(['=', ' ']).next().unwrap_or("");
                (!keys.contains(&key)).then(|| line.to_owned())
            }
        };
        let placing = &["spacing", "height", "origin", "direction", "parallel_to_mold"];
        let file = format!("kind = \"file\"\nfile = \"{}\"", table.display());
        self.with_table("grippers", not(placing), "")
            .with_table("motion", |_| None, &file)
            .with_table("contact", not(&["stepping"]), "stepping = \"cut\"")
    }

    /// The folder with the plan that `scripts/examples` has made of this very scene, if `PLYDRAPE_EXAMPLES` names one.
    fn plan_made_before(&self) -> Option<PathBuf> {
        let name = self.folder.file_name()?.to_str()?;
        let made = Path::new(&std::env::var_os("PLYDRAPE_EXAMPLES")?).join(format!("{name}.plan"));
        (self.text == Example::of(name).text && made.exists()).then_some(made)
    }

    fn scene(&self) -> Scene {
        scene::parse(&self.text, &self.folder, "scene.toml").unwrap_or_else(|e| panic!("{e}")).scene
    }
}

fn planned(scene: &Scene) -> Planned {
    planner::plan(scene, None, &mut |_| ControlFlow::Continue(())).expect("mold and target")
}

fn verdict<'a>(result: &'a ResultFile, name: &str) -> &'a Verdict {
    let found = result.summary.limits.iter().find(|limit| limit.name.measure().name() == name);
    found.unwrap_or_else(|| panic!("{name} has no verdict"))
}

/// Each limit by itself, from the spans, contacts and grippers of the steps.
fn keeps_every_limit(result: &ResultFile, what: &str) {
    let summary = &result.summary;
    let limiting = table::limiting(&summary.limits);
    // samples of the motion are other steps than the plan's: a second contact may be two per cent deeper
    let most = if what.ends_with("motion.csv") { 1.02 } else { 1.0 };
    assert!(summary.limits.iter().all(|verdict| verdict.ratio() <= most), "{what}: {limiting:?}");
    assert_eq!(summary.steps, summary.steps_planned, "{what}");
    assert!(result.steps.iter().all(|step| step.solver.status == Status::Converged), "{what}");

    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    let edges = |step: usize| result.steps[step].catenaries.iter().filter(|c| c.kind.is_edge());
    let last = result.steps.last().expect("steps");
    let contacts = || last.catenaries.iter().filter_map(|line| line.contact.as_ref());

    // what all segments of an edge keep of slack, as a share of the edge; segments may be as short as one likes
    let share = |line: &CatenaryState| {
        1e-3 * line.spans.iter().map(|span| span.slack_mm(line.length)).sum::<f64>() / line.length
    };
    let slack = largest(&mut edges(result.steps.len() - 1).map(share));
    assert!(slack <= SLACK, "{what}: slack of {slack} of an edge's length");
    // a diagonal is no fibre: its cell landed with the shear that it ends with
    let shears = last.cells.iter().flat_map(|cell| {
        let sign = if cell.shearing == Some(Kind::Falling) { -1.0 } else { 1.0 };
        let end = sign * cell.shear_deg;
        cell.landed_deg.into_iter().flatten().map(move |landed| (landed - end).abs())
    });
    let shear = largest(&mut shears.into_iter());
    assert!(shear <= LANDING_SHEAR + 0.5, "{what}: landed {shear}° off in shear");

    let gap = |line: &CatenaryState| line.bridging.map(|b| b.gap);
    let gap = largest(&mut edges(result.steps.len() - 1).filter_map(gap));
    assert!(gap <= BRIDGING, "{what}: a bridge of {gap} m");

    let stretches = (0..result.steps.len())
        .flat_map(edges)
        .flat_map(|edge| edge.spans.iter().map(|span| edge.overstretch(span)));
    let stretch = largest(&mut stretches.into_iter());
    assert!(stretch <= OVERSTRETCH, "{what}: overstretch {stretch}");

    let laid = edges(result.steps.len() - 1).filter_map(|line| line.contact.as_ref());
    let errors = laid.flat_map(|contact| contact.landing_error_mm.iter().flatten());
    let errors: Vec<f64> = errors.map(|error| error.expect("an ideal place")).collect();
    let off = largest(&mut errors.iter().copied());
    assert!(!errors.is_empty() && off <= LANDING[0], "{what}: landed {off} mm off");
    let ideal = result.scene.target_grippers().expect("targets");
    let misses = last.grippers.iter().zip(ideal).map(|(g, there)| distance(g.position, *there));
    let miss = 1e3 * largest(&mut misses.into_iter());
    assert!(miss <= LANDING[1], "{what}: a gripper {miss} mm off");

    let angle = largest(&mut contacts().filter_map(|contact| contact.fibre_angle_deg));
    assert!(angle <= FIBRE_ANGLE, "{what}: {angle}° off the fibres");
    let tilts = result.steps.iter().flat_map(|step| &step.grippers).map(|g| g.tilt_deg);
    let tilt = largest(&mut tilts.into_iter());
    assert!(tilt <= TILT, "{what}: tilt {tilt}°");

    let share = last.measures.value(Name::ContactShare).expect("a mold");
    assert!(share >= CONTACT_SHARE, "{what}: contact {share}");
    let close = verdict(result, "gripper_distance");
    let least = |step: &Step| {
        let places: Vec<_> = step.grippers.iter().map(|g| g.position).collect();
        let pairs = (0..places.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        pairs.map(|(a, b)| distance(places[a], places[b])).fold(f64::INFINITY, f64::min)
    };
    let least = result.steps.iter().map(least).fold(f64::INFINITY, f64::min);
    assert!(1e3 * least >= close.limit, "{what}: grippers {least} m apart");
}

fn norm(a: [f64; 3]) -> f64 {
    a.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// A table of poses, time by time: position and quaternion of every gripper.
type Poses = Vec<(f64, Vec<([f64; 3], [f64; 4])>)>;

fn poses(table: &str) -> Poses {
    let mut out: Poses = Vec::new();
    for line in table.lines().skip(1) {
        let number = |text: &str| text.parse::<f64>().expect("a number");
        let cells: Vec<&str> = line.split(',').collect();
        let n: Vec<f64> =
            cells.iter().enumerate().map(|(k, c)| if k == 1 { 0.0 } else { number(c) }).collect();
        if out.last().is_none_or(|(time, _)| *time != n[0]) {
            out.push((n[0], Vec::new()));
        }
        let pose = ([n[2], n[3], n[4]], [n[5], n[6], n[7], n[8]]);
        out.last_mut().expect("a time").1.push(pose);
    }
    out
}

/// Speed, acceleration and jerk as divided differences of positions at 1 kHz: means of the true ones, so no
/// larger. Written numbers are exact to 1e-16 m, a third difference to 1e-6 m/s³. Quaternions are of unit length
/// and never jump to their negative.
fn moves_within_its_rates(table: &str, what: &str) {
    let poses = poses(table);
    // the last sample is that of the end, off the beat
    let beat = &poses[..poses.len() - 1];
    for gripper in 0..poses[0].1.len() {
        let mut differences: Vec<[f64; 3]> = beat.iter().map(|(_, p)| p[gripper].0).collect();
        for (order, limit) in RATES.iter().enumerate() {
            let rate = |pair: &[[f64; 3]]| [0, 1, 2].map(|n| 1e3 * (pair[1][n] - pair[0][n]));
            differences = differences.windows(2).map(rate).collect();
            let worst = differences.iter().map(|d| norm(*d)).fold(0.0, f64::max);
            assert!(worst <= limit + 1e-6, "{what}: derivative {} is {worst}", order + 1);
            assert!(worst > 0.0, "{what}: gripper {gripper} stands");
        }
        let turned: Vec<[f64; 4]> = poses.iter().map(|(_, p)| p[gripper].1).collect();
        for q in &turned {
            assert!((q.iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12, "{what}: {q:?}");
        }
        for pair in turned.windows(2) {
            let dot: f64 = (0..4).map(|n| pair[0][n] * pair[1][n]).sum();
            assert!(dot > 0.99, "{what}: {pair:?}");
        }
    }
}

/// From the first contact on no gripper rises off the mold by more than `rise` (m).
fn only_comes_down(scene: &Scene, result: &ResultFile, rise: f64, what: &str) {
    let mold = scene.mold.as_ref().expect("a mold");
    let first = result.summary.first_contact_step.expect("contact");
    let mut lowest = vec![f64::INFINITY; scene.ply.grid.grippers()];
    let mut worst = (0.0, 0, 0);
    for step in &result.steps[first - 1..] {
        for (n, gripper) in step.grippers.iter().enumerate() {
            let height = mold.signed_distance(gripper.position);
            if height - lowest[n] > worst.0 {
                worst = (height - lowest[n], step.step, n);
            }
            lowest[n] = lowest[n].min(height);
        }
    }
    println!("{what}: a gripper rises by {:.3} mm once contact began", 1e3 * worst.0);
    assert!(
        worst.0 <= rise,
        "{what}: gripper {} rises by {} m in step {}",
        worst.2,
        worst.0,
        worst.1
    );
}

/// Plans, writes the files, and drapes along what can be read from them.
fn is_draped(example: &Example, what: &str) {
    let scene = example.scene();
    // from high above, and looked at with a millimetre, a flat ply lands all at once in the last step
    let mut straight = scene.clone();
    straight.settings.contact.stepping = plydrape::scene::Stepping::Cut;
    straight.settings.contact.tolerance = 2e-4;
    assert!(!drape(&straight).summary.accepted, "{what}: straight paths will do");

    let made = tempfile::tempdir().unwrap();
    let folder = example.plan_made_before().unwrap_or_else(|| {
        let plan = planned(&scene);
        let result = ResultFile::planned(&scene, None, &plan);
        plan::write_all(&result, &plan.checkpoint, made.path()).unwrap();
        made.path().to_path_buf()
    });
    let result = read::read(&folder.join("result.json")).unwrap();
    keeps_every_limit(&result, what);
    let (motion, attitudes) = result.motion().unwrap().expect("a plan");
    let followed = example.along(&folder.join("trajectory.csv")).scene();
    let result = drape(&followed);
    keeps_every_limit(&result, &format!("{what}, trajectory.csv"));
    let tolerance = scene.settings.contact.tolerance;
    only_comes_down(&scene, &result, tolerance, what);

    // as it moves between the steps
    let followed = example.along(&folder.join("motion.csv")).scene();
    assert!(followed.motion.times != motion.times());
    keeps_every_limit(&drape(&followed), &format!("{what}, motion.csv"));
    let grid = scene.ply.grid;
    let dense = csv::motion(&motion, &attitudes, grid, 1000.0).unwrap();
    moves_within_its_rates(&dense, what);
}

/// From the height of the example and from twice as high (mm).
fn is_draped_from(example: &Example, height: usize) {
    let title = example.scene().title;
    for now in [height, 2 * height] {
        let key = |height| format!("height = \"{height} mm\"");
        let start = example.with(&key(height), &key(now));
        is_draped(&start, &format!("{title} from {now} mm"));
    }
}

/// The paper's example with the paper's own contact, of 1 mm and once a step where it is not planned.
#[test]
fn the_flat_mold_is_draped_from_two_heights() {
    is_draped_from(&Example::of("01_flat_sheared_mold"), 75);
}

/// Contact within 0.2 mm, steps cut.
#[test]
fn the_flat_mold_is_draped_with_the_default_contact_too() {
    let paper = Example::of("01_flat_sheared_mold");
    is_draped_from(&paper.with_table("contact", |_| None, ""), 75);
}

#[test]
fn a_dome_is_draped_from_two_heights() {
    is_draped_from(&Example::of("04_dome"), 50);
}

#[test]
fn a_cylinder_is_draped_askew_from_two_heights() {
    is_draped_from(&Example::of("05_cylinder"), 50);
}

#[test]
fn a_saddle_is_draped_from_two_heights() {
    is_draped_from(&Example::of("06_saddle"), 80);
}

#[test]
fn a_mold_of_triangles_is_draped_from_two_heights() {
    is_draped_from(&Example::of("08_stl_mold"), 50);
}

#[test]
fn a_shallow_doubly_curved_mold_is_draped_from_two_heights() {
    is_draped_from(&Example::of("10_shallow"), 50);
}

/// Through all stages of the search: the first look, evolution, refinement.
#[test]
fn one_thread_and_two_write_the_same_bytes() {
    let few = "seed = 7\nsteps = 30\nevaluations = 40";
    let scene = Example::of("06_saddle").with_table("plan", |_| None, few).scene();
    let [one, two] = [1, 2].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let plan = pool.install(|| planned(&scene));
        assert!(plan.record.evaluations > 10, "{} drapes: no evolution", plan.record.evaluations);
        let folder = tempfile::tempdir().unwrap();
        let result = ResultFile::planned(&scene, None, &plan);
        let files = plan::write_all(&result, &plan.checkpoint, folder.path()).unwrap();
        files.iter().map(|file| std::fs::read(file).unwrap()).collect::<Vec<_>>()
    });
    assert!(one.len() == 7 && one == two);
}

/// A plan that is not accepted: whole, written whole, and the measure that it fails by is named.
fn is_explained(scene: &Scene) -> (ResultFile, Verdict) {
    let plan = planned(scene);
    let result = ResultFile::planned(scene, None, &plan);
    assert!(!result.summary.accepted);
    assert_eq!(result.summary.steps, result.summary.steps_planned);
    let folder = tempfile::tempdir().unwrap();
    let files = plan::write_all(&result, &plan.checkpoint, folder.path()).unwrap();
    assert!(files.len() == 7 && files.iter().all(|f| f.metadata().unwrap().len() > 100));
    let limiting = table::limiting(&result.summary.limits).expect("a limit").clone();
    assert!(!limiting.at.is_empty() && limiting.value.is_finite());
    (result, limiting)
}

/// The ideal drape puts corners where the wall is steeper than a gripper may tilt. This is known before any
/// search, and every plan has it.
#[test]
fn a_hemisphere_too_steep_for_the_grippers_is_said_to_be() {
    let few = "steps = 30\nevaluations = 10";
    let scene = Example::of("11_hemisphere").with_table("plan", |_| None, few).scene();
    let known = planner::infeasible_limits::infeasible_limits(&scene);
    let [tilt] = &known[..] else { panic!("{known:?}") };
    assert!(tilt.name == Name::Tilt && (tilt.value - 57.08).abs() < 0.01, "{tilt:?}");
    let (result, _) = is_explained(&scene);
    let tilt = verdict(&result, "tilt");
    assert!(!tilt.ok && tilt.value >= 57.0, "{tilt:?}");
}

/// Slopes of up to 63°; a plan of few drapes.
#[test]
fn the_cubic_mold_gets_a_plan_that_says_what_it_fails_by() {
    let few = "steps = 20\nevaluations = 2";
    let scene = Example::of("07_cubic").with_table("plan", |_| None, few).scene();
    let (result, limiting) = is_explained(&scene);
    assert!(!verdict(&result, "tilt").ok, "{limiting:?}");
}

/// The paper's example with limits that no plan can keep, from plane geometry: a target sheared by 20°, its far
/// corner 100 mm · sin 20° beyond 300 mm, 75 mm down and a little across in 19 moves of 1 mm.
#[test]
fn what_cannot_be_kept_is_in_the_verdict_of_the_plan() {
    let (sin, cos) = 20f64.to_radians().sin_cos();
    let way = (6.0 + 100.0 * sin).hypot(100.0 * cos - 98.0).hypot(75.0);
    let workspace = "workspace = [[-1, \"330 mm\"], [-1, 1], [0, 1]]";
    let plan = "steps = 20\nevaluations = 2\n";
    for (limits, more, name, value, limit, at) in [
        ("shear = \"15 deg\"", "", "shear", 20.0, 15.0, ""),
        (workspace, "", "workspace", 100.0 * sin - 30.0, 0.0, "gripper [3,1]"),
        ("", "move_limit = \"1 mm\"", "move_limit", way, 19.0, "gripper [3,1] in 19 moves"),
    ] {
        let example = Example::of("01_flat_sheared_mold")
            .with_table("limits", |_| None, limits)
            .with_table("plan", |_| None, &format!("{plan}{more}"));
        let scene = example.scene();
        let known = planner::infeasible_limits::infeasible_limits(&scene);
        let [known] = &known[..] else { panic!("{known:?}") };
        assert!(known.name.measure().name() == name && known.at.contains(at), "{known:?}");
        assert!(
            (known.value - value).abs() < 0.05 && (known.limit - limit).abs() < 1e-9,
            "{known:?}"
        );
        // the drape may come to more on its way, never to less
        let (result, _) = is_explained(&scene);
        let found = verdict(&result, name);
        assert!(!found.ok && found.value > value - 0.05, "{found:?}");
    }
}

/// 101 mm apart with 100 mm of fabric between them.
#[test]
fn a_start_beyond_the_fabric_is_no_scene() {
    let wide = Example::of("01_flat_sheared_mold")
        .with("[\"98 mm\", \"98 mm\"]", "[\"101 mm\", \"98 mm\"]");
    let refused = scene::parse(&wide.text, &wide.folder, "scene.toml").expect_err("overstretched");
    assert!(refused.message.contains("101") && !refused.help.is_empty(), "{refused:?}");
}

/// A search that goes on begins with the plan as it was refined, not with the strategy behind it: with one drape
/// to spend it ends where the earlier one did.
#[test]
fn a_search_goes_on_from_the_refined_plan() {
    let few = "steps = 30\nevaluations = 8\n";
    let mut scene = Example::of("01_flat_sheared_mold").with_table("plan", |_| None, few).scene();
    let first = planned(&scene);
    scene.plan.evaluations = 1;
    let on =
        |checkpoint| planner::plan(&scene, checkpoint, &mut |_| ControlFlow::Continue(())).unwrap();
    let path = |plan: &Planned| plan.record.path.clone();
    let (next, anew) = (on(Some(&first.checkpoint)), on(None));
    assert_eq!(path(&next), path(&first));
    assert_ne!(path(&anew), path(&first), "the search found nothing: the test shows nothing");
}
