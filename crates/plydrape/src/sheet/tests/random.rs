//! Random sheets: whatever is asked of it, a sheet answers with numbers and an honest status.

use super::*;
use crate::Error;
use crate::layup::{Layup, Lip, Model, PadSettings, Release, ReleaseOrder, Settings, SheetTime};
use crate::material::{Material, Section};
use crate::measure::{Judge, Limits, Name};
use crate::mold::{Cylinder, Face, Pose, Sphere};
use crate::motion::Motion;
use crate::outcome::{self, simulate};
use crate::ply::{Grid, Ply};
use crate::scene::Scene;
use crate::sheet::{ClothState, HandOver, Status, drape};
use crate::tool::Tool;
use std::ops::ControlFlow;

/// Numbers between 0 and 1 from a seed.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) as f64) / (1_u64 << 31) as f64
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.next()
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.next() * count as f64) as usize).min(count - 1)
    }

    fn choice<T: Clone>(&mut self, values: &[T]) -> T {
        values[self.below(values.len())].clone()
    }
}

/// A seed of a layup that is not refused.
const WHOLE: u64 = 186;

/// A layup of a few grippers that is as wild as a user can make it.
fn layup(seed: u64) -> Layup {
    let mut r = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) + 1);
    let grid = Grid { nu: 2 + r.below(2), nv: 1 + r.below(3) };
    let cell = [r.between(0.05, 0.15), r.between(0.05, 0.15)];
    let slope = r.choice(&[0.0, 0.1, 5.0, 1e4]);
    let table = TensionLaw::Table { strain: vec![0.0, 0.002, 0.01], force: vec![0.0, 5.0, 2e3] };
    let material = Material {
        section: Section::Areal {
            mass: r.choice(&[0.05, 0.5, 3.0]),
            warp_rigidity: r.choice(&[0.0, 1e-5, 1e-2]),
            weft_rigidity: r.choice(&[1e-6, 1e-4]),
        },
        tension: Some(r.choice(&[TensionLaw::Linear { stiffness: 1e6 }, table])),
        ..Material::woven("random", 3.0, 1e-5, 1e6, slope)
    };
    let ply = Ply::of_array(grid, cell, material);
    let side = cell[0].min(cell[1]);
    let mut settings = Settings { model: Model::Sheet, ..Settings::default() };
    settings.sheet.mesh = Some(side / r.between(2.0, 3.0));
    settings.sheet.overhang = r.choice(&[0.0, 0.02]);
    settings.sheet.time =
        r.choice(&[SheetTime::QuasiStatic, SheetTime::QuasiStatic, SheetTime::Real]);
    settings.max_tilt = r.choice(&[0.05, 0.7]);
    settings.pad = PadSettings {
        radius: r.choice(&[0.0, 0.0, 0.01, 0.04]),
        lateral_stiffness: r.choice(&[None, Some(2e3)]),
        axial_stiffness: r.choice(&[None, Some(5e3), Some(1.0)]),
        lip: (seed % 3 == 1).then_some(Lip { radius: 0.3 * side, rigidity: 1e-3 }),
        ..PadSettings::default()
    };
    let mu = r.between(0.0, 1.5);
    settings.contact.friction =
        r.choice(&[Friction::Stick, Friction::StickForEver, Friction::Coulomb(mu)]);
    settings.contact.tack = r.choice(&[0.0, 90.0]);
    let pose = Pose::new([0.1, 0.05, -0.3], [0.0; 3]);
    let mold = r.choice(&[
        None,
        Some(plane(0.0)),
        Some(plane(0.4)),
        Some(Mold::Sphere(Sphere { pose, radius: 0.3, face: Face::Outside })),
        Some(Mold::Cylinder(Cylinder { pose, radius: 0.3, face: Face::Outside })),
    ]);

    let nearer = r.between(0.9, 1.01);
    let wild = r.choice(&[0.0, 0.02, 0.1, 0.5]);
    let mut at: Vec<[f64; 3]> = (0..grid.grippers())
        .map(|n| {
            let [i, j] = grid.id(n);
            [nearer * cell[0] * i as f64, nearer * cell[1] * j as f64, 0.08]
        })
        .collect();
    let mut positions = vec![at.clone()];
    for _ in 0..2 {
        for p in &mut at {
            for c in p.iter_mut() {
                *c += wild * r.between(-1.0, 1.0);
            }
            p[2] -= 0.03;
        }
        positions.push(at.clone());
    }
    let times = (0..positions.len()).map(|k| 0.1 * k as f64).collect();
    // pads that are no points may have no joints
    let fixed = settings.pad.radius > 0.0 && r.choice(&[true, false]);
    let fixed_pads = Some(ply.flat_axes(&positions[0]));
    let tool = fixed.then(|| Tool { fixed_pads, ..Tool::new(&positions[0], vec![]) });
    let motion = Motion { times, positions };
    Layup { mold, tool, ..Layup::new(ply, settings, motion) }
}

/// Folds, flung grippers, no shear and stiff shear, springs, pads that overlap, any friction: every drape ends with finite
/// numbers and a status, and one that is solved has done all steps.
#[test]
fn random_sheets_answer_with_numbers_and_an_honest_status() {
    // what is hard is given up early: its status is looked at here, and not how far it comes
    let tuning = SheetTuning { iterations: 12, ..SheetTuning::default() };
    let (mut solved, mut refused) = (0, 0);
    for seed in 0..200 {
        let mut layup = layup(seed);
        layup.release = match seed % 3 {
            0 => None,
            1 => Some(Release::new(ReleaseOrder::End, 0.0)),
            _ => Some(Release::new(ReleaseOrder::HollowsFirst, 0.05)),
        };
        let left = std::cell::Cell::new(100);
        let stop = || {
            left.set(left.get() - 1);
            left.get() < 0
        };
        let limits = Limits::usual(&layup);
        let (mut judge, mut hand_over) = (Judge::new(&layup, &limits, true), HandOver::default());
        let mut strain = 0.0_f64;
        let see = |sheet: &Sheet, state: &ClothState, last: bool| {
            let measures = judge.see_all(&hand_over.state(&layup, sheet, state, last));
            strain += measures.value(Name::Strain).expect("segments");
            ControlFlow::Continue(())
        };
        let drape = match drape(&layup, tuning, &stop, see) {
            Ok(drape) => drape,
            Err(
                Error::SheetCoarse { .. }
                | Error::SheetPadsOverlap { .. }
                | Error::SheetPadsOverhang { .. },
            ) => {
                assert!(layup.settings.pad.radius > 0.0);
                refused += 1;
                continue;
            }
            Err(error) => panic!("{seed}: {error}"),
        };
        let last = &drape.last;
        let numbers = last.positions.iter().chain(&last.forces).flatten().copied();
        let numbers =
            numbers.chain(last.heights.iter().copied()).chain(last.tension.iter().copied());
        let numbers = numbers.chain([last.energy, last.kinetic_energy, strain]);
        assert!(numbers.clone().all(f64::is_finite), "{seed}: {:?}", drape.status);
        if drape.status == Status::Converged {
            solved += 1;
            assert_eq!(drape.steps, layup.motion.positions.len());
        }
    }
    // what grippers fling apart cannot be solved; the others are
    assert!(solved > 15 && refused > 10, "{solved} solved, {refused} refused");
}

/// A mesh as wide as half of the fabric between two pads has a line of nodes there; a wider one is refused with that width.
#[test]
fn a_mesh_is_refused_from_half_of_the_free_fabric_between_pads_on() {
    let mut layup = layup(WHOLE);
    let [a, b] = layup.ply.cell;
    let pitch = if layup.ply.grid.nv > 1 { a.min(b) } else { a };
    layup.settings.pad.radius = 0.2 * pitch;
    layup.settings.sheet.overhang = 0.2 * pitch;
    let mut with_mesh = |mesh: f64| {
        layup.settings.sheet.mesh = Some(mesh);
        Sheet::new(&layup)
    };
    assert!(with_mesh(0.3 * pitch).is_ok());
    let Err(Error::SheetCoarse { most_mm, .. }) = with_mesh(0.31 * pitch) else {
        panic!("a mesh without a line between the pads");
    };
    assert!((most_mm - 300.0 * pitch).abs() < 1e-9, "{most_mm}");
}

/// A layup gives the same bytes each time, whatever else ran before or beside it.
#[test]
fn the_same_layup_gives_the_same_bytes() {
    let run = || {
        let layup = layup(WHOLE);
        let go_on = |_: &Sheet, _: &ClothState, _: bool| ControlFlow::Continue(());
        drape(&layup, SheetTuning::default(), &|| false, go_on).expect("a sheet")
    };
    let first = run();
    let beside: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (0..3).map(|_| scope.spawn(run)).collect();
        threads.into_iter().map(|thread| thread.join().expect("no panic")).collect()
    });
    for other in beside {
        assert_eq!(other.last, first.last);
        assert_eq!((other.status, other.steps), (first.status, first.steps));
        assert_eq!((other.report, &other.events), (first.report.clone(), &first.events));
    }
}

/// A drape that is stopped says so, and is not accepted.
#[test]
fn a_stopped_drape_is_interrupted() {
    let layup = layup(WHOLE);
    let go_on = |_: &Sheet, _: &ClothState, _: bool| ControlFlow::Continue(());
    let stopped = drape(&layup, SheetTuning::default(), &|| true, go_on).expect("a sheet");
    assert_eq!(stopped.status, Status::Interrupted);
    let scene =
        Scene { layup: layup.clone(), ..Scene::new(layup.ply, layup.settings, layup.motion) };
    let broken = simulate(&scene, |_| ControlFlow::Break(())).expect("a sheet");
    assert_eq!(broken.drape.summary.status, outcome::Status::Interrupted);
    assert!(!broken.accepted());
}
