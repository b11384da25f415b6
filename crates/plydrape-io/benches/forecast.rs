//! Whether a plan takes as long as it says before it begins: the table of benches/README.md, in markdown, and the constants
//! of `plydrape::outcome::forecast` as they are measured here.
//!
//! Each scene is planned once, on all cores. What its decisions take in all, and what the sample of its cells takes, must be what was forecast, within a
//! factor of 1.5, or to the second that is shown; else the exit code is 1. `cargo bench -p plydrape-io --bench forecast -- dome` plans those whose name holds a text.

mod scenes;

use plydrape::errors::{Errors, Term};
use plydrape::layup::Layup;
use plydrape::motion::{Motion, TimedMotion};
use plydrape::outcome::forecast::CONSTANTS;
use plydrape::outcome::{Effort, Pace, Robustness, Watch};
use plydrape::planner::{self, Progress};
use plydrape::scene::Scene;
use plydrape::sheet::{self, SheetTuning, coarsest_mesh, pitch};
use plydrape_io::text::forecast::about;
use scenes::{array, dome, example, examples, is_asked};
use std::ops::ControlFlow;
use std::process::ExitCode;
use std::time::{Duration, Instant};

/// Largest factor between forecast and time taken.
const FACTOR: f64 = 1.5;
/// Examples with molds, mounts and a cell of other kinds; all are laid.
const EXAMPLES: [&str; 10] = [
    "01_flat_sheared_mold",
    "04_dome",
    "05_cylinder",
    "06_saddle",
    "08_stl_mold",
    "10_shallow",
    "12_real_cell",
    "13_cut_ply",
    "16_fixture",
    "ideal_dome",
];
/// Grippers along u and v, the radius (m) of the dome below them, and cells with errors.
const DOMES: [([usize; 2], f64, usize); 4] =
    [([3, 2], 0.5, 64), ([6, 4], 0.8, 0), ([6, 6], 1.0, 0), ([8, 8], 1.0, 0)];

fn main() -> ExitCode {
    println!(
        "| plan | nodes | decisions | forecast | taken | ratio | single ones | cells | forecast | taken | ratio |\n\
         |---|---|---|---|---|---|---|---|---|---|---|"
    );
    let examples_of = EXAMPLES.map(|name| (name.to_owned(), example(&examples().join(name))));
    let domes = DOMES.map(|([nu, nv], radius, samples)| {
        let mut scene = array([nu, nv], "material = \"krogh2018\"", &dome(radius), &examples());
        if samples > 0 {
            let mut errors = Errors { samples, ..Errors::default() };
            errors.gripper.position = Term::Deviation(1e-4);
            scene.errors = Some(errors);
        }
        (format!("{nu} × {nv} dome, R = {radius} m"), scene)
    });
    let (mut compared, mut measured) = (Vec::new(), Measured::default());
    for (name, scene) in examples_of.into_iter().chain(domes) {
        if is_asked(&name) {
            compared.extend(row(&name, &scene, &mut measured));
        }
    }
    measured.print();
    let right = compared.iter().filter(|compared| compared.is_right()).count();
    let all = compared.len();
    println!("\n{right} of {all} forecasts are right within a factor of {FACTOR}");
    ExitCode::from(u8::from(right < all))
}

/// A forecast (s) and the time that was taken (s).
#[derive(Debug, Clone, Copy)]
struct Compared {
    forecast: f64,
    taken: f64,
}

impl Compared {
    fn ratio(&self) -> f64 {
        self.taken / self.forecast
    }

    /// Whether it is right within the factor, or to what is shown of it: any time below a second is "less than 1 s".
    fn is_right(&self) -> bool {
        let shown = |seconds| about(Duration::from_secs_f64(seconds));
        (1.0 / FACTOR..=FACTOR).contains(&self.ratio()) || shown(self.forecast) == shown(self.taken)
    }

    fn columns(&self) -> String {
        format!("{:.2} s | {:.2} s | {:.2}", self.forecast, self.taken, self.ratio())
    }
}

/// Plans a scene and prints its row: all of its decisions together, and its sample if it has one.
fn row(name: &str, scene: &Scene, measured: &mut Measured) -> Vec<Compared> {
    // all decisions of the search, as its watcher sees them begin and end
    let (mut decisions, mut begun) = (Vec::new(), None);
    let mut nodes = 0;
    let watcher = &mut |progress: &Progress| {
        match (progress.forecast, begun) {
            (Some(forecast), None) => {
                nodes = forecast.nodes;
                begun = Some((forecast, Instant::now()));
            }
            (None, Some((forecast, began))) => {
                let taken = began.elapsed().as_secs_f64();
                let whole = forecast.decision().as_secs_f64();
                // one that refuses its plan may end with its first drape
                let first = forecast.drape.as_secs_f64();
                let forecast = if progress.accepted { whole } else { taken.clamp(first, whole) };
                decisions.push(Compared { forecast, taken });
                begun = None;
            }
            _ => {}
        }
        ControlFlow::Continue(())
    };
    let mut planned = planner::plan_without_errors(scene, None, watcher).expect("mold and target");
    let sum = |time: fn(&Compared) -> f64| decisions.iter().map(time).sum();
    let all = Compared { forecast: sum(|c| c.forecast), taken: sum(|c| c.taken) };
    let single: Vec<String> = decisions.iter().map(|c| format!("{:.2}", c.ratio())).collect();

    // the sample, by the drape without errors
    let drape = &mut planned.outcome.drape;
    let effort = drape.sheet.as_ref().map(|sheet| Effort::new(&sheet.drape)).expect("a sheet");
    let cells = scene.errors.map_or(0, |errors| errors.samples);
    let robustness = Robustness::of_planned(scene, planned.motion.steps());
    let began = Instant::now();
    robustness.judge_sample(&mut drape.summary, &Watch { stop: &|| false, done: &|_, _| {} });
    let taken = began.elapsed().as_secs_f64();
    let sample =
        Compared { forecast: robustness.forecast(effort).sample(cells).as_secs_f64(), taken };
    let sampled = if cells > 0 { sample.columns() } else { "| |".into() };

    println!(
        "| {name} | {nodes} | {} | {} | {} | {} | {sampled} |",
        decisions.len(),
        all.columns(),
        single.join(", "),
        if cells > 0 { cells.to_string() } else { String::new() },
    );
    measured.add(scene, &planned.motion, effort, (cells > 0).then(|| sample.ratio()));
    if cells > 0 { vec![all, sample] } else { vec![all] }
}

/// What the constants are here: a value of each scene.
#[derive(Debug, Default)]
struct Measured {
    growth: Vec<f64>,
    solves: Vec<f64>,
    between: Vec<f64>,
    cell: Vec<f64>,
    seconds: Vec<f64>,
}

impl Measured {
    /// Drapes once more along a plan, one drape at once: with the mesh of the search, with that of the scene, and with steps half-way.
    fn add(&mut self, scene: &Scene, motion: &TimedMotion, decided: Effort, sample: Option<f64>) {
        let drape = |layup: &Layup| {
            let go = |_: &sheet::Sheet, _: &sheet::ClothState, _| ControlFlow::Continue(());
            let drape = sheet::drape(layup, SheetTuning::default(), &|| false, go);
            Effort::new(&drape.expect("it was draped before"))
        };
        let own = planner::along(scene, motion).layup;
        let mut coarse = own.clone();
        let (pitch, radius) = (pitch(&own.ply), own.settings.pad.radius);
        coarse.settings.sheet.mesh = Some((0.2 * pitch).min(coarsest_mesh(pitch, radius)));
        let mut times = motion.times().to_vec();
        times.extend(motion.times().windows(2).map(|pair| 0.5 * (pair[0] + pair[1])));
        times.sort_by(f64::total_cmp);
        let positions = times.iter().map(|time| motion.at(*time)).collect();
        let between = Layup { motion: Motion { times, positions }, ..own.clone() };
        let [coarse, own, between] = [&coarse, &own, &between].map(drape);

        let ratio = |a: usize, b: usize| (a as f64 / b as f64).ln();
        self.growth.push(ratio(own.solves, coarse.solves) / ratio(own.nodes, coarse.nodes));
        self.solves.push(own.solves as f64 / motion.times().len() as f64);
        let time = |effort: Effort| effort.time.as_secs_f64();
        self.between.push((time(between) / time(own)).max(1.0));
        self.cell.extend(sample.map(|ratio| CONSTANTS.cell * ratio));
        let mut pace = Pace::default();
        pace.add(decided);
        self.seconds.push(pace.seconds());
        println!(
            "<!-- {} and {} nodes: {} and {} systems, {:.2} and {:.2} s; half-way {:.2} s -->",
            coarse.nodes,
            own.nodes,
            coarse.solves,
            own.solves,
            time(coarse),
            time(own),
            time(between),
        );
    }

    fn print(self) {
        println!("\n| constant | in use | median here | least | largest |\n|---|---|---|---|---|");
        let rows = [
            ("growth", CONSTANTS.growth, self.growth),
            ("solves", CONSTANTS.solves, self.solves),
            ("between", CONSTANTS.between, self.between),
            ("cell", CONSTANTS.cell, self.cell),
            ("seconds", CONSTANTS.seconds, self.seconds),
        ];
        for (name, used, mut found) in rows {
            found.sort_by(f64::total_cmp);
            if let (Some(least), Some(largest)) = (found.first(), found.last()) {
                let median = found[found.len() / 2];
                println!("| {name} | {used:.3e} | {median:.3e} | {least:.3e} | {largest:.3e} |");
            }
        }
    }
}
