//! How long a plan takes to the verdict of the fine sheet, and how the ply lies then: the table of benches/README.md, in
//! markdown. Beside each plan is the drape of the same sheet along straight paths.
//!
//! Each is made once, on all cores. `cargo bench -p plydrape-io --bench plan -- dome` makes those whose name holds a text.

mod scenes;

use plydrape::layup::Model;
use plydrape::measure::Name;
use plydrape::outcome::{DrapeWatch, Summary, drape};
use plydrape::planner;
use plydrape::scene::Scene;
use plydrape_io::text::table;
use scenes::{array, dome, example, is_asked};
use std::fmt::Write;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

/// The example that is planned though no plan solves it; those that one solves have a picture of it.
const UNSOLVED: &str = "07_cubic";
/// Grippers along u and v, and the radius (m) of the dome below them.
const DOMES: [([usize; 2], f64); 3] = [([6, 4], 0.8), ([8, 8], 1.0), ([12, 10], 1.5)];
/// The ply of all arrays.
const PLY: &str = "material = \"krogh2018\"";
/// Squares of the triangle mesh along each side: 20 000 triangles.
const SQUARES: usize = 100;

fn main() {
    let folder = tempfile::tempdir().expect("a folder");
    println!(
        "| plan | nodes | straight: height | time | plan: height | position | drapes | accepted | time |\n|---|---|---|---|---|---|---|---|---|"
    );
    for (name, scene) in scenes(folder.path()) {
        if is_asked(&name) {
            row(&name, &scene);
        }
    }
}

fn scenes(folder: &Path) -> Vec<(String, Scene)> {
    let entries = std::fs::read_dir(scenes::examples()).expect("the examples");
    let mut examples: Vec<_> = entries.map(|entry| entry.expect("an example").path()).collect();
    examples.retain(|path| path.join("planned.png").exists() || path.ends_with(UNSOLVED));
    examples.sort();
    let examples = examples.into_iter().map(|path| {
        let name = path.file_name().expect("its name").to_string_lossy().into_owned();
        (name, example(&path))
    });
    let domes = DOMES.map(|([nu, nv], radius)| {
        let scene = array([nu, nv], PLY, &dome(radius), folder);
        (format!("{nu} × {nv} dome, R = {radius} m"), scene)
    });
    std::fs::write(folder.join("mold.stl"), triangles()).expect("a file");
    let mold = "kind = \"mesh\"\nfile = \"mold.stl\"\nunit = \"m\"";
    let mesh = array([6, 4], PLY, mold, folder);
    let name = format!("6 × 4 on {} triangles", 2 * SQUARES * SQUARES);
    examples.chain(domes).chain([(name, mesh)]).collect()
}

/// A shallow doubly curved surface of 0.8 m by 0.6 m as an ASCII STL file.
fn triangles() -> String {
    let vertex = |node: [usize; 2]| {
        let [x, y] = node.map(|k| k as f64 / SQUARES as f64 - 0.5);
        let (x, y) = (0.8 * x, 0.6 * y);
        [x, y, -0.5 * x * x - 0.7 * y * y + 0.4 * x * y + 0.3 * x * x * x]
    };
    let mut text = String::from("solid mold\n");
    for i in 0..SQUARES {
        for j in 0..SQUARES {
            let [a, b, c, d] = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]].map(vertex);
            for corners in [[a, b, c], [a, c, d]] {
                text.push_str("facet normal 0 0 1\nouter loop\n");
                for [x, y, z] in corners {
                    let _ = writeln!(text, "vertex {x} {y} {z}");
                }
                text.push_str("endloop\nendfacet\n");
            }
        }
    }
    text + "endsolid mold\n"
}

/// A drape or a plan, and the seconds that it took.
fn timed<T>(make: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let made = make();
    (made, start.elapsed().as_secs_f64())
}

fn row(name: &str, scene: &Scene) {
    let mut scene = scene.clone();
    scene.layup.settings.model = Model::Sheet;
    let see = &mut |_: usize, _: Option<&_>| ControlFlow::Continue(());
    let watch = &mut DrapeWatch { stop: &|| false, see };
    let (straight, straight_time) = timed(|| drape(&scene, Model::Sheet, watch));
    let straight = straight.expect("a sheet").summary;
    let go = &mut |_: &planner::Progress| ControlFlow::Continue(());
    let (planned, time) = timed(|| planner::plan(&scene, None, go));
    let planned = planned.expect("mold and target");
    let summary = &planned.outcome.drape.summary;
    let end = |summary: &Summary, name: Name| {
        format!("{:.2} mm", summary.last.value(name).unwrap_or(f64::NAN))
    };
    let verdict = match table::limiting(&summary.limits) {
        None => "yes".into(),
        Some(worst) => format!("no: {} {:.3} {}", worst.name.title(), worst.value, worst.unit),
    };
    println!(
        "| {name} | {} | {} | {straight_time:.2} s | {} | {} | {} | {verdict} | {time:.1} s |",
        summary.sheet.as_ref().map_or(0, |report| report.nodes),
        end(&straight, Name::Height),
        end(summary, Name::Height),
        end(summary, Name::Position),
        planned.record.evaluations,
    );
}
