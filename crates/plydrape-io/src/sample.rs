//! Made-up results for the tests of this crate: parabolas between grippers that move to a sheared
//! target, cut off where they meet the mold. They look like a drape and solve nothing.

use crate::result::sheet::{SheetKept, SheetSeal};
use crate::result::{Also, ResultFile, SceneEcho};
use plydrape::draping::ContactStatus;
use plydrape::draping::record::*;
use plydrape::equilibrium::Status;
use plydrape::errors::Errors;
use plydrape::geometry::distance;
use plydrape::layup::{ContactEnd, ContactSettings, Model, Settings, SlopeRule, Stepping, Target};
use plydrape::material::{Material, Section};
use plydrape::measure::{Measures, Name, Numbers, Verdict, Worst};
use plydrape::mold::{Mold, Plane};
use plydrape::motion::Motion;
use plydrape::outcome::{
    CatenaryReport, CellVerdict, Gripper, Highest, SampleVerdict, Status as Ended, Step, Summary,
};
use plydrape::ply::{Catenary, Grid, Kind, Lines, Ply};
use plydrape::scene::{Scene, World};
use plydrape::sheet;
use std::sync::OnceLock;

const CELL: f64 = 0.1;
const SPACING: f64 = 0.098;
const SHEAR: f64 = 20.0;
const HEIGHT: f64 = 0.075;
const STATIONS: usize = 25;

/// A drape onto the flat mold z = 0, like the paper's example.
pub(crate) fn draped(nu: usize, nv: usize, steps: usize) -> ResultFile {
    let grid = Grid { nu, nv };
    let target = positions(grid, CELL, SHEAR.to_radians(), 0.0);
    let start = positions(grid, SPACING, 0.0, HEIGHT);
    let mut result = frame(grid);
    result.scene.mold = Some(Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] }));
    for k in 0..steps {
        let t = k as f64 / (steps.max(2) - 1) as f64;
        let mix = |a: &[f64; 3], b: &[f64; 3]| [0, 1, 2].map(|c| a[c] + t * (b[c] - a[c]));
        let grippers: Vec<_> = start.iter().zip(&target).map(|(a, b)| mix(a, b)).collect();
        result.steps.push(step(grid, k + 1, t, &grippers, Some(0.0)));
    }
    result.scene.target = Some(Target { grippers: target, drape: None });
    summarize(&mut result);
    result
}

/// A ply that just hangs, one step, no mold.
pub(crate) fn hanging(nu: usize, nv: usize) -> ResultFile {
    let grid = Grid { nu, nv };
    let mut result = frame(grid);
    let grippers = positions(grid, SPACING, 0.0, HEIGHT);
    result.steps.push(step(grid, 1, 0.0, &grippers, None));
    summarize(&mut result);
    result
}

fn positions(grid: Grid, spacing: f64, shear: f64, z: f64) -> Vec<[f64; 3]> {
    let place = |k| {
        let [i, j] = grid.id(k).map(|n| n as f64 * spacing);
        [i + j * shear.sin(), j * shear.cos(), z]
    };
    (0..grid.grippers()).map(place).collect()
}

fn step(grid: Grid, step: usize, time: f64, at: &[[f64; 3]], mold: Option<f64>) -> Step {
    // a parabola for each catenary, and one crossing point for the two diagonals of a cell
    let mut shapes: Vec<Vec<[f64; 3]>> = Vec::new();
    let mut lengths = Vec::new();
    let graph = Lines::array(grid, [CELL; 2]);
    for k in 0..graph.catenaries() {
        let line = graph.catenary(k);
        let ends = [line.from, line.to].map(|id| at[grid.index(id)]);
        lengths.push(length(grid, line, at));
        shapes.push(parabola(ends, lengths[k]));
    }
    lift_crossings(&graph, &mut shapes);

    // the state of catenaries, grippers, solver and cells
    let catenaries = (0..graph.catenaries())
        .map(|k| catenary(graph.catenary(k), lengths[k], &shapes[k], mold))
        .collect();
    let grippers = (0..at.len()).map(|k| gripper(grid, k, at)).collect();
    let solver = Solver {
        status: Status::Converged,
        iterations: 3,
        residual: 1e-12,
        equilibria: 1,
        contact: ContactStatus::Followed,
    };
    let slopes = (0..at.len()).map(|k| slopes(grid, k).map(Some)).collect();
    let cells = (graph.cells().iter())
        .map(|cell| cell.id)
        .map(|cell| Cell { cell, shear_deg: 0.0, shearing: None, landed_deg: [None; 2] })
        .collect();

    // made-up measures that grow or fall with time; landing errors are known near the end only
    let measured = [
        (Name::Overstretch, 0.01 * time),
        (Name::Tilt, 19.0 - 3.0 * time),
        (Name::Shear, SHEAR * time),
        (Name::Force, 0.37 + time),
        (Name::Slack, 2.0 - time),
        (Name::LandingError, 4.2 * time),
        (Name::ContactShare, (time - 0.85).max(0.0)),
    ];
    let known = |(name, _): &(Name, f64)| *name != Name::LandingError || time > 0.8;
    Step {
        step,
        time,
        grippers,
        measures: measures(measured.into_iter().filter(known)),
        catenaries: Some(CatenaryStep { solver, slopes, catenaries, cells }),
    }
}

fn measures(values: impl IntoIterator<Item = (Name, f64)>) -> Measures {
    let worst = |value| Worst { value, at: "edge g0_0–g1_0".into(), place: Some([0.0; 3]) };
    let mut measures = Measures::default();
    values.into_iter().for_each(|(name, value)| measures.set(name, Some(worst(value))));
    measures
}

/// Set length: of the cell, and of a diagonal by the shear of its cell.
fn length(grid: Grid, line: Catenary, at: &[[f64; 3]]) -> f64 {
    let p = |id| at[grid.index(id)];
    let square = |d: f64| d * d;
    let flat = CELL * std::f64::consts::SQRT_2;
    let ([i, j], [k, l]) = (line.from, line.to);
    match line.kind {
        Kind::EdgeU | Kind::EdgeV => CELL,
        Kind::Rising | Kind::Falling => {
            let other = distance(p([k, j]), p([i, l]));
            if other > flat { (4.0 * square(CELL) - square(other)).max(0.0).sqrt() } else { flat }
        }
    }
}

/// A parabola between two ends with the slack of a given length; straight where there is none.
fn parabola(ends: [[f64; 3]; 2], length: f64) -> Vec<[f64; 3]> {
    let chord = distance(ends[0], ends[1]);
    let sag = (0.375 * chord * (length - chord).max(0.0)).sqrt();
    let point = |k| {
        let t = k as f64 / (STATIONS - 1) as f64;
        let [x, y, z] = [0, 1, 2].map(|c| ends[0][c] + t * (ends[1][c] - ends[0][c]));
        [x, y, z - 4.0 * sag * t * (1.0 - t)]
    };
    (0..STATIONS).map(point).collect()
}

/// The lower diagonal of each cell is drawn through the point of the higher, by a tent.
fn lift_crossings(graph: &Lines, shapes: &mut [Vec<[f64; 3]>]) {
    for cell in graph.cells() {
        let pair = cell.bias.map(|bias| bias.list()[0]);
        let middle = STATIONS / 2;
        let height = pair.map(|c| shapes[c][middle][2]);
        let top = height[0].max(height[1]);
        for (c, own) in pair.into_iter().zip(height) {
            for (n, point) in shapes[c].iter_mut().enumerate() {
                let share = 1.0 - (n as f64 - middle as f64).abs() / middle as f64;
                point[2] += share * (top - own);
            }
        }
    }
}

fn catenary(line: Catenary, length: f64, shape: &[[f64; 3]], mold: Option<f64>) -> CatenaryState {
    // the first and the last station that touch the mold
    let arc = |k: usize| length * k as f64 / (STATIONS - 1) as f64;
    let touches = |k: &usize| mold.is_some_and(|z| shape[*k][2] < z + 0.001);
    let low = (0..STATIONS).find(touches);
    let high = (0..STATIONS).rev().find(touches);
    let span = |segment: usize, a: usize, b: usize| SpanState {
        segment,
        hold: Hold::Hanging,
        length: arc(b) - arc(a),
        path: 0.98 * (arc(b) - arc(a)),
        force: Some(0.37),
        slopes: [-0.3, 0.3],
        prescribed: [false; 2],
    };

    // between them the catenary lies on the mold, and on both sides a span hangs
    let (spans, contact) = match low.zip(high) {
        None => (vec![span(0, 0, STATIONS - 1)], None),
        Some((a, b)) => {
            let free = [(0, 0, a), (1, b, STATIONS - 1)].into_iter().filter(|(_, a, b)| b > a);
            let segment = ContactState {
                arc: (a..=b).map(arc).collect(),
                points: shape[a..=b].iter().map(|p| [p[0], p[1], mold.unwrap_or(p[2])]).collect(),
                landing_error_mm: None,
                fiber_angle_deg: None,
            };
            (free.map(|(segment, a, b)| span(segment, a, b)).collect(), Some(segment))
        }
    };
    CatenaryState {
        kind: line.kind,
        from: line.from,
        to: line.to,
        length,
        shearing: false,
        shear_force_n: None,
        spans,
        contact,
        bridging: None,
    }
}

/// Slopes of the ply at a gripper: down from the edges of the ply to its middle.
fn slopes(grid: Grid, k: usize) -> [f64; 2] {
    let [i, j] = grid.id(k);
    let outer = |n: usize, count: usize| match n {
        _ if count == 1 => 0.0,
        0 => -0.3_f64,
        n if n + 1 == count => 0.3,
        _ => 0.0,
    };
    [outer(i, grid.nu), outer(j, grid.nv)]
}

/// A gripper tilted towards the middle of the ply, as the edge slopes would have it.
fn gripper(grid: Grid, k: usize, at: &[[f64; 3]]) -> Gripper {
    let [u, v] = slopes(grid, k);
    // Half the rotation vector of the tilt, small enough to stand for the whole rotation.
    let q = [v / 2.0, -u / 2.0, 0.0, 1.0];
    let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    Gripper {
        id: grid.id(k),
        position: at[k],
        commanded: at[k],
        quaternion: q.map(|c| c / norm),
        tilt_deg: u.hypot(v).atan().to_degrees(),
        force: [0.3, -0.2, -0.5],
        slide_mm: 0.0,
        holds: true,
        target_distance_mm: None,
    }
}

fn summarize(result: &mut ResultFile) {
    let touching = |c: &&CatenaryState| c.contact.is_some();
    let lines = |step: &Step| step.catenaries.clone().map_or_else(Vec::new, |s| s.catenaries);
    let first = result.steps.iter().find(|step| lines(step).iter().any(|c| touching(&c)));
    let id = |c: &CatenaryState| CatenaryId { kind: c.kind, from: c.from, to: c.to };
    let report = CatenaryReport {
        first_contact_step: first.map(|step| step.step),
        first_contact: first
            .map(|step| lines(step).iter().filter(touching).map(id).collect())
            .unwrap_or_default(),
        equilibria: 30,
        ..CatenaryReport::default()
    };
    result.summary.catenaries = Some(report);
    result.summary.steps = result.steps.len();
    result.summary.steps_planned = result.steps.len();
}

fn frame(grid: Grid) -> ResultFile {
    let material = Material {
        name: "fabric".into(),
        source: "made up".into(),
        section: Section::Line { mass: 0.3143, flexural_rigidity: 9e-6 },
        shear_curve: None,
        tension: None,
        locking_angle: None,
        shear_rate: None,
        moment: Default::default(),
        scatter: Default::default(),
    };
    let settings = Settings {
        model: Model::Catenaries,
        slopes: SlopeRule::MinForce,
        axial_stiffness: 1e5,
        gravity: 9.8,
        max_tilt: 0.7,
        contact: ContactSettings {
            tolerance: 0.001,
            stepping: Stepping::Once,
            end: ContactEnd::Free,
            ..ContactSettings::default()
        },
        ..Settings::default()
    };
    let motion = Motion { times: Vec::new(), positions: Vec::new() };
    let mut scene = Scene::new(Ply::of_array(grid, [CELL, CELL], material), settings, motion);
    // the tilt alone is judged
    Name::ALL.iter().for_each(|name| scene.limits.set(*name, None));
    scene.limits.set(Name::Tilt, Some(40_f64.to_radians()));
    ResultFile {
        program: "test".into(),
        scene: SceneEcho { title: "Flat sheared mold".into(), ..SceneEcho::new(&scene, None) },
        plan: None,
        sheet_states: None,
        steps: Vec::new(),
        also: None,
        files: Vec::new(),
        motion: OnceLock::new(),
        summary: Summary {
            model: Model::Catenaries,
            world: World::Ideal,
            status: Ended::Converged,
            steps: 0,
            steps_planned: 0,
            stopped: None,
            worst: Numbers::default(),
            last: Numbers::default(),
            height_rms_mm: None,
            height_share: None,
            position_rms_mm: None,
            limits: vec![Verdict {
                name: Name::Tilt,
                value: 19.2,
                limit: 40.0,
                unit: "°".into(),
                ok: true,
                step: Some(1),
                at: "gripper g0_0".into(),
                place: None,
                judged: true,
            }],
            events: Vec::new(),
            sheet: None,
            catenaries: None,
            sample: None,
            tolerance: None,
            rate_tolerance: None,
            tool: None,
        },
    }
}

/// The catenaries of a step of a result, by its place.
pub(crate) fn lines(result: &mut ResultFile, step: usize) -> &mut Vec<CatenaryState> {
    &mut result.steps[step].catenaries.as_mut().expect("catenaries drape").catenaries
}

/// A drape onto a tilted plane, the whole motion tilted with it.
pub(crate) fn tilted(nu: usize, nv: usize) -> ResultFile {
    let mut result = draped(nu, nv, 30);
    let lean = |p: &mut [f64; 3]| p[2] += 0.25 * p[0] + 0.1 * p[1];
    for step in &mut result.steps {
        for gripper in &mut step.grippers {
            lean(&mut gripper.position);
            lean(&mut gripper.commanded);
        }
        for catenary in step.catenaries.iter_mut().flat_map(|step| &mut step.catenaries) {
            catenary.contact.iter_mut().flat_map(|c| &mut c.points).for_each(lean);
        }
    }
    result.scene.target.iter_mut().flat_map(|target| &mut target.grippers).for_each(lean);
    let norm = (1.0_f64 + 0.25 * 0.25 + 0.1 * 0.1).sqrt();
    result.scene.mold = Some(Mold::Plane(Plane {
        point: [0.0; 3],
        normal: [-0.25 / norm, -0.1 / norm, 1.0 / norm],
    }));
    result
}

/// A drape by a sheet of nine nodes with the grippers of [`draped`]; its states are in no file.
pub(crate) fn sheet(nu: usize, nv: usize, steps: usize) -> ResultFile {
    // the drape by catenaries, with the measures of a sheet in their place
    let mut result = draped(nu, nv, steps);
    result.scene.settings.model = Model::Sheet;
    for step in &mut result.steps {
        step.catenaries = None;
        step.measures = measures([
            (Name::Gap, 75.0 * (1.0 - step.time)),
            (Name::Shear, SHEAR * step.time),
            (Name::Tilt, 19.0 - 3.0 * step.time),
            (Name::GripperLoad, 0.5),
            (Name::GripperPull, 0.4),
            (Name::Strain, 1e-4),
        ]);
    }

    // what the summary says of a sheet
    let summary = &mut result.summary;
    summary.model = Model::Sheet;
    summary.catenaries = None;
    summary.sheet = Some(sheet::Report {
        nodes: 9,
        ridge_max_mm: Some(0.2),
        bridge_max_mm: Some(0.0),
        fold_max_deg: 5.0,
        first_contact_step: Some(1),
        first_contact_uv_mm: Some([50.0, 50.0]),
        energy_j: 0.1,
        kinetic_energy_j: 0.0,
        time_steps: 10,
        solves: 30,
        smallest_step: 0.5,
    });
    let worst = [(Name::GripperLoad, Some(0.5)), (Name::GripperPull, Some(0.4))];
    summary.worst = worst.into_iter().collect();
    summary.last = [(Name::Height, Some(0.2))].into_iter().collect();
    result.sheet_states = Some(states());
    result
}

/// States of a sheet in a file that is not there.
pub(crate) fn states() -> SheetKept {
    let checksum = "crc32:0123abcd".to_string();
    let seal = SheetSeal { file: "sheet.npz".into(), length: 17, checksum };
    SheetKept::read(seal, "no/such/folder".into())
}

/// A result as the drape by the model that does not decide.
pub(crate) fn also(result: ResultFile) -> Also {
    Also { summary: result.summary.unjudged(), steps: result.steps }
}

/// A sample of four cells, two of which are accepted and three needed.
pub(crate) fn sample_verdict() -> SampleVerdict {
    let cell = |height: f64| CellVerdict {
        accepted: height <= 0.5,
        height_mm: Some(height),
        ratio: 2.0 * height,
    };
    let [from, to] = ["gripper g0_1", "gripper g3_1"];
    let errors = Errors { samples: 4, share: 0.75, ..errors() };
    SampleVerdict {
        errors,
        needed: 3,
        ok: false,
        confidence: errors.confidence(2, 4, false),
        limits: Vec::new(),
        cells: [0.3, 0.7, 0.4, 0.6].map(cell).to_vec(),
        highest: Some(Highest {
            height_mm: 0.6,
            uv_mm: [300.0, 90.0],
            line: format!("{from} to {to}"),
            gripper: to.into(),
        }),
        spread_mm: vec![0.1; 9],
    }
}

/// Errors of the grippers' positions.
fn errors() -> Errors {
    let mut errors = Errors::default();
    errors.gripper.position = plydrape::errors::Term::Deviation(1e-4);
    errors
}
