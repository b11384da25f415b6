//! What several of these tests need: shipped scenes, their drapes, and the ply of the paper.

use plydrape::catenary::{EndCondition, Profile};
use plydrape::draping::record::{CatenaryState, CatenaryStep};
use plydrape::equilibrium::{End, SlopeSource, Solver};
pub use plydrape::geometry::distance;
use plydrape::layup::{ContactEnd, ContactSettings, Model, Settings, SlopeRule, Stepping};
use plydrape::material::{Material, Section};
use plydrape::mold::{Mold, Pose};
use plydrape::motion::Motion;
use plydrape::outcome::{self, Drape, DrapeWatch, Step};
use plydrape::planner::path::Strategy;
use plydrape::ply::{ContactSegment, Grid, Ply};
use plydrape::scene::Scene;
use plydrape_io::ResultFile;
use plydrape_io::read::mesh;
use plydrape_io::result::sheet;
use proptest::prelude::ProptestConfig;
use proptest::test_runner::RngSeed;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

pub type Point = [f64; 3];

pub const RULES: [SlopeRule; 2] = [SlopeRule::MinForce, SlopeRule::MomentBalance];

/// A front that spreads as a ring from the middle of the ply.
pub const RING: Strategy = Strategy {
    start: [0.5; 2],
    ratio: 1.0,
    angle: 0.0,
    squareness: 0.0,
    curvature: 0.4,
    slope: 0.4,
    pretension: 1e-4,
    press: 0.0,
    pull: 0.0,
};

/// Random cases, the same in every run.
pub fn cases(cases: u32) -> ProptestConfig {
    ProptestConfig {
        cases,
        rng_seed: RngSeed::Fixed(2018),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

/// The folder of the examples.
pub fn examples() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples")
}

/// Whether tests take all of their cases, as `scripts/soak` asks for by `PLYDRAPE_LONG`; otherwise some of each kind.
pub fn all_cases() -> bool {
    std::env::var_os("PLYDRAPE_LONG").is_some()
}

/// The scene of an example.
pub fn example(name: &str) -> Scene {
    let path = examples().join(name).join("scene.toml");
    plydrape_io::scene::read(&path).unwrap_or_else(|error| panic!("{error}")).scene
}

/// The scene of an example in an ideal cell, with the paper's ply where it has the warm prepreg: what catenaries can hold.
pub fn ideal(name: &str) -> Scene {
    let folder = examples().join(name);
    let text = std::fs::read_to_string(folder.join("scene.toml")).expect("a shipped scene");
    let text = text.replace("\"usual\"", "\"ideal\"").replace("\"prepreg_warm\"", "\"krogh2018\"");
    let scene = plydrape_io::scene::parse(&text, &folder, name);
    scene.unwrap_or_else(|error| panic!("{error}")).scene
}

/// The scene of a text that names no files.
pub fn parse(text: &str) -> Scene {
    let scene = plydrape_io::scene::parse(text, Path::new(""), "scene.toml");
    scene.unwrap_or_else(|error| panic!("{error}\n{text}")).scene
}

/// The mold of an OBJ text in meters.
pub fn mesh(text: &str) -> Mold {
    let (mesh, _) = mesh::parse("mold.obj", text.as_bytes(), 1.0, &Pose::ORIGIN, 0.0)
        .unwrap_or_else(|error| panic!("{error}"));
    Mold::Mesh(Arc::new(mesh))
}

/// A mold of n × n squares of two triangles each, those that are kept; `place` has their corners (m) by shares of the sides.
pub fn meshed(
    n: usize,
    place: impl Fn([f64; 2]) -> Point,
    keep: impl Fn(usize, usize) -> bool,
) -> Mold {
    let squares = |n: usize| (0..n).flat_map(move |j| (0..n).map(move |i| (i, j)));
    let mut text = String::new();
    for (i, j) in squares(n + 1) {
        let [x, y, z] = place([i, j].map(|k| k as f64 / n as f64));
        text += &format!("v {x:?} {y:?} {z:?}\n");
    }
    for (i, j) in squares(n).filter(|(i, j)| keep(*i, *j)) {
        let a = j * (n + 1) + i + 1;
        let (b, c, d) = (a + 1, a + n + 2, a + n + 1);
        text += &format!("f {a} {b} {c}\nf {a} {c} {d}\n");
    }
    mesh(&text)
}

/// A motion through positions, a second from each to the next.
pub fn motion(positions: Vec<Vec<Point>>) -> Motion {
    Motion { times: (0..positions.len()).map(|n| n as f64).collect(), positions }
}

/// Positions on straight ways, as far as a share of them, in equal steps.
pub fn straight(from: &[Point], to: &[Point], far: f64, steps: usize) -> Vec<Vec<Point>> {
    let step = |n: usize| {
        let t = far * n as f64 / (steps - 1) as f64;
        let mix = |(a, b): (&Point, &Point)| [0, 1, 2].map(|c| a[c] + t * (b[c] - a[c]));
        from.iter().zip(to).map(mix).collect()
    };
    (0..steps).map(step).collect()
}

/// How contact is found, at a tolerance (m).
pub fn contact(tolerance: f64, stepping: Stepping, end: ContactEnd) -> ContactSettings {
    ContactSettings { tolerance, stepping, end, ..ContactSettings::default() }
}

/// The result of a scene along its own motion, by the catenaries whichever model the scene chooses: from where a ply that is picked up
/// hangs in the air, since they know no table.
pub fn drape(scene: &Scene) -> ResultFile {
    let mut scene = scene.clone();
    scene.layup.settings.model = Model::Catenaries;
    if let Some(pick_up) = scene.layup.pick_up.take() {
        let motion = &mut scene.layup.motion;
        let last = motion.positions.len().saturating_sub(1);
        motion.positions.drain(..pick_up.lift_steps.min(last));
        motion.times.truncate(motion.positions.len());
    }
    drape_until(&scene, usize::MAX)
}

/// The result of a scene by the model that decides, broken off after a step; states of a sheet are kept in the folder of temporary files.
pub fn drape_until(scene: &Scene, last: usize) -> ResultFile {
    let mut see = |step: usize, _: Option<&_>| match step < last {
        true => ControlFlow::Continue(()),
        false => ControlFlow::Break(()),
    };
    let watch = &mut DrapeWatch { stop: &|| false, see: &mut see };
    let drape = outcome::drape(scene, scene.layup.settings.model, watch);
    let drape = drape.unwrap_or_else(|fault| panic!("{fault}"));
    ResultFile::new(scene, None, sheet::keep(drape, &std::env::temp_dir()).unwrap())
}

/// The drape of a scene by the sheet, whichever model the scene chooses.
pub fn drape_sheet(scene: &Scene) -> Drape {
    let go = &mut |_: usize, _: Option<&_>| ControlFlow::Continue(());
    let drape = outcome::drape(scene, Model::Sheet, &mut DrapeWatch { stop: &|| false, see: go });
    drape.unwrap_or_else(|fault| panic!("{fault}"))
}

/// The result of a scene by the model that decides, with the states of its sheet in a folder.
pub fn decided(scene: &Scene, folder: &Path) -> ResultFile {
    let model = scene.layup.settings.model;
    let drape = sheet::drape(scene, model, folder, &|| false, |_| {});
    ResultFile::new(scene, None, drape.unwrap_or_else(|fault| panic!("{fault}")))
}

/// What the catenaries of a step are.
pub fn hung(step: &Step) -> &CatenaryStep {
    step.catenaries.as_ref().expect("catenaries drape")
}

/// The catenaries of a step.
pub fn lines(step: &Step) -> &[CatenaryState] {
    &hung(step).catenaries
}

/// The ply of Krogh et al. 2018, Table 1, in cells of 100 mm.
pub fn paper_ply(nu: usize, nv: usize) -> Ply {
    Ply::of_array(
        Grid { nu, nv },
        [0.1; 2],
        Material {
            name: "krogh2018".into(),
            source: "Krogh et al. 2018, Table 1".into(),
            section: Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 },
            shear_curve: None,
            tension: None,
            locking_angle: None,
            shear_rate: None,
            moment: Default::default(),
            scatter: Default::default(),
        },
    )
}

/// Nothing of the ply is on a mold.
pub fn free(ply: &Ply) -> Vec<Option<ContactSegment>> {
    vec![None; ply.lines().catenaries()]
}

/// The paper's settings with an axial stiffness in place of a ply that does not stretch.
pub fn settings(slopes: SlopeRule) -> Settings {
    Settings {
        slopes,
        axial_stiffness: 1e5,
        gravity: 9.8,
        max_tilt: 40f64.to_radians(),
        contact: contact(1e-3, Stepping::Once, ContactEnd::Free),
        ..Settings::default()
    }
}

/// Settings of a ply that does not stretch.
pub fn inextensible(slopes: SlopeRule) -> Settings {
    Settings { axial_stiffness: f64::INFINITY, ..settings(slopes) }
}

/// Sum of the squares of all forces with the shared slopes put where the caller wants them.
pub fn squares_of_forces(solver: &Solver, slopes: &[f64]) -> f64 {
    let problem = solver.problem();
    let mut outcome = vec![[0.0; 2]; problem.elements.len()];
    let mut sum = 0.0;
    for (n, element) in problem.elements.iter().enumerate() {
        let mut span = solver.span(n);
        for end in 0..2 {
            let slope = match element.ends[end] {
                End::Shared(j) => slopes[j],
                End::Plane(plane) => {
                    let slope_from = |source| match source {
                        SlopeSource::Prescribed(s) => s,
                        SlopeSource::Shared(j) => slopes[j],
                        SlopeSource::Outcome(e, k) => {
                            let pair: [f64; 2] = outcome[e];
                            pair[k]
                        }
                    };
                    (0..2).map(|k| plane.share[k] * slope_from(plane.source[k])).sum()
                }
                _ => continue,
            };
            span.ends[end] = EndCondition::Slope(slope);
        }
        let Some(force) = span.solve(solver.force(n)).force else { continue };
        let profile = Profile::new(&span, force);
        outcome[n] = [profile.end_slope(0), profile.end_slope(1)];
        sum += force * force;
    }
    sum
}
