//! What a plan leaves of slack, bridges and errors beside straight paths, how long it takes, and how that grows with
//! the number of grippers: the tables of README.md and benches/README.md, in markdown.
//!
//! Each is made once, not a hundred times. `cargo bench --bench plan -- molds` or `-- grippers` prints one table
//! alone.

use plydrape::draping::simulate;
use plydrape::measure::Name;
use plydrape::planner;
use plydrape::scene::{PlanMethod, Scene, Stepping};
use plydrape_io::ResultFile;
use plydrape_io::scene;
use plydrape_io::table;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

/// Examples that a plan solves, and the heights that they start from (mm).
const SOLVED: [(&str, usize); 6] = [
    ("01_flat_sheared_mold", 75),
    ("04_dome", 50),
    ("05_cylinder", 50),
    ("06_saddle", 80),
    ("08_stl_mold", 50),
    ("10_shallow", 50),
];
/// Grippers along u and v.
const ARRAYS: [[usize; 2]; 5] = [[4, 2], [4, 4], [6, 6], [8, 8], [10, 10]];
const METHODS: [(&str, PlanMethod); 2] =
    [("stepwise", PlanMethod::Stepwise), ("path", PlanMethod::Path)];

fn main() {
    let asked: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let wanted = |table: &str| asked.is_empty() || asked.iter().any(|a| a == table);
    if wanted("molds") {
        molds();
    }
    if wanted("grippers") {
        grippers();
    }
}

/// An example from a height (mm) instead of its own.
fn example(name: &str, own: usize, height: usize) -> Scene {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples")).join(name);
    let text = std::fs::read_to_string(folder.join("scene.toml")).expect("a shipped scene");
    let key = |height| format!("height = \"{height} mm\"");
    assert!(text.contains(&key(own)), "{name} starts from another height");
    let text = text.replace(&key(own), &key(height));
    scene::parse(&text, &folder, name).unwrap_or_else(|error| panic!("{error}")).scene
}

/// Grippers in cells of 100 mm on a flat mold, or on a dome of R = 2 m.
fn array([nu, nv]: [usize; 2], dome: bool) -> Scene {
    let mold = match dome {
        true => "kind = \"sphere\"\nradius = 2.0\nposition = [0, 0, -2.0]",
        false => "kind = \"plane\"",
    };
    // the rim of the largest dome is 0.2 m below its top
    let text = format!(
        "[model]\nkind = \"catenaries\"\n[ply]\ngrippers = [{nu}, {nv}]\ncell = [0.1, 0.1]\nmaterial = \"krogh2018\"\n[mold]\n{mold}\n\
         [grippers]\nspacing = [0.098, 0.098]\nheight = 0.06\norigin = \"centred\"\n[target]\nseed = \"middle\"\n"
    );
    scene::parse(&text, Path::new(""), "array").unwrap_or_else(|error| panic!("{error}")).scene
}

/// A drape or a plan, and the seconds that it took.
fn timed<T>(make: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let made = make();
    (made, start.elapsed().as_secs_f64())
}

fn straight(scene: &Scene) -> ResultFile {
    let mut scene = scene.clone();
    scene.settings.contact.stepping = Stepping::Cut;
    ResultFile::new(&scene, None, simulate(&scene, |_| ControlFlow::Continue(())))
}

/// The finished drape of a plan, and how many drapes or steps were tried for it.
fn plan(scene: &Scene, method: PlanMethod) -> (ResultFile, usize) {
    let mut scene = scene.clone();
    scene.plan.method = method;
    let planned = planner::plan(&scene, None, &mut |_| ControlFlow::Continue(()));
    let planned = planned.expect("mold and target");
    (ResultFile::planned(&scene, None, &planned), planned.record.evaluations)
}

fn molds() {
    println!(
        "| mold | start | paths | slack (mm) | slack (%) | bridging (mm) | landing (mm) | overstretch (%) | accepted | time (s) |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    for (name, own) in SOLVED {
        for height in [own, 2 * own] {
            let scene = example(name, own, height);
            let start = format!("{} | {height} mm", scene.title);
            let (result, time) = timed(|| straight(&scene));
            println!("| {start} | straight | {}", row(&result, time));
            for (word, method) in METHODS {
                let ((result, _), time) = timed(|| plan(&scene, method));
                println!("| {start} | {word} | {}", row(&result, time));
            }
        }
    }
}

/// What is left at the end, the largest overstretch of any step, and whether every limit is kept.
fn row(result: &ResultFile, time: f64) -> String {
    let end = &result.summary.last;
    let three = |value: Option<f64>| format!("{:.3}", value.unwrap_or(0.0));
    let verdict = match table::limiting(&result.summary.limits) {
        None => "yes".into(),
        Some(worst) => {
            format!("no: {} {}", worst.name.title(), amount(worst.value, &worst.unit))
        }
    };
    format!(
        "{} | {} | {} | {} | {} | {verdict} | {time:.1} |",
        three(end.value(Name::Slack)),
        three(end.value(Name::SlackRatio).map(|ratio| 100.0 * ratio)),
        three(end.value(Name::Bridging)),
        three(end.value(Name::LandingError)),
        three(result.summary.worst.value(Name::Overstretch).map(|ratio| 100.0 * ratio)),
    )
}

fn amount(value: f64, unit: &str) -> String {
    format!("{value:.3} {unit}")
}

fn grippers() {
    println!(
        "\n| grippers | mold | paths | tried | accepted | time (s) |\n|---|---|---|---|---|---|"
    );
    for size in ARRAYS {
        for (mold, dome) in [("flat", false), ("dome, R = 2 m", true)] {
            let scene = array(size, dome);
            let [nu, nv] = size;
            let (result, time) = timed(|| straight(&scene));
            let yes = |result: &ResultFile| if result.summary.accepted { "yes" } else { "no" };
            println!(
                "| {nu} × {nv} | {mold} | straight | 1 drape | {} | {time:.2} |",
                yes(&result)
            );
            for (word, method) in METHODS {
                let ((result, tried), time) = timed(|| plan(&scene, method));
                let unit = if method == PlanMethod::Path { "drapes" } else { "steps" };
                let yes = yes(&result);
                println!("| {nu} × {nv} | {mold} | {word} | {tried} {unit} | {yes} | {time:.2} |");
            }
        }
    }
}
