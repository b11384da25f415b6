//! Pads that let go of the ply.

use super::hanging::cantilever;
use super::*;
use crate::errors::{Errors, Term};
use crate::layup::{Layup, Model, Release, ReleaseOrder, Settings};
use crate::material::Material;
use crate::measure::{Judge, Limits, Name};
use crate::mold::{Cylinder, Face, Mold, Pose, distance};
use crate::motion::Motion;
use crate::ply::{Grid, GripperId, Ply};
use crate::sheet::configuration::Configuration;
use crate::sheet::energy::Energy;
use crate::sheet::event::holds;
use crate::sheet::release::times;
use crate::sheet::{ClothState, EventKind, HandOver, SheetDrape, Status, drape};
use crate::state::PlyState;
use std::f64::consts::FRAC_PI_2;
use std::ops::ControlFlow;

/// 4 × 2 grippers above a floor, which hold cells of 100 mm of the paper's ply.
pub(super) const GRID: Grid = Grid { nu: 4, nv: 2 };

/// The ply of [`GRID`] where its grippers take the places (m) of each step, a second apart.
pub(super) fn layup(positions: Vec<Vec<[f64; 3]>>, release: Option<Release>) -> Layup {
    let material = Material::woven("paper", 3.143, 9e-5, 1e6, 5.0);
    let ply = Ply::of_array(GRID, [0.1; 2], material);
    let mut settings = Settings { model: Model::Sheet, ..Settings::default() };
    settings.sheet.mesh = Some(0.02);
    let times = (0..positions.len()).map(|step| step as f64).collect();
    let motion = Motion { times, positions };
    Layup { mold: Some(plane(0.0)), release, ..Layup::new(ply, settings, motion) }
}

/// Grippers that roll the ply on the floor along u: behind the front it lies, ahead of it it rises by 0.6 along 0.8. The front
/// is at every gripper in one of the 34 steps, so that no step cuts the corner of a path.
fn rolled() -> Vec<Vec<[f64; 3]>> {
    let place = |n: usize, front: f64| {
        let [u, v] = GRID.id(n).map(|k| 0.1 * k as f64);
        let ahead = (u - front).max(0.0);
        [u.min(front) + 0.8 * ahead, v, 0.6 * ahead]
    };
    let front = |step: usize| 0.01 * (step as f64 - 3.0);
    (0..34).map(|step| (0..8).map(|n| place(n, front(step))).collect()).collect()
}

/// A trough across u of radius 10 m, which the places on the floor are up to 1.2 mm above; lines along u span 0.1 mm and more of it, others nothing.
fn trough() -> Mold {
    let radius = 10.0;
    let pose = Pose::new([0.15, 0.05, radius - 1.2e-3], [0.0, 0.0, FRAC_PI_2]);
    Mold::Cylinder(Cylinder { pose, radius, face: Face::Inside })
}

/// The layup of [`rolled`] over the trough, with pads that let go over hollows first, after a dwell (s).
fn over_a_trough(dwell: f64) -> Layup {
    let layup = layup(rolled(), release(ReleaseOrder::HollowsFirst, dwell));
    Layup { mold: Some(trough()), ..layup }
}

fn release(order: ReleaseOrder, dwell: f64) -> Option<Release> {
    Some(Release::new(order, dwell))
}

/// The drape of a layup and all of its states.
pub(super) fn draped(layup: &Layup) -> (SheetDrape, Vec<ClothState>) {
    let mut states = Vec::new();
    let keep = |_: &Sheet, state: &ClothState, _: bool| {
        states.push(state.clone());
        ControlFlow::Continue(())
    };
    let drape = drape(layup, SheetTuning::default(), &|| false, keep).expect("a sheet");
    (drape, states)
}

/// The states of a drape as measures see them.
pub(super) fn handed_over(
    layup: &Layup,
    drape: &SheetDrape,
    states: &[ClothState],
) -> Vec<PlyState> {
    let mut hand_over = HandOver::default();
    let last = states.len() - 1;
    let states = states.iter().enumerate();
    states.map(|(n, state)| hand_over.state(layup, &drape.sheet, state, n == last)).collect()
}

/// When each gripper lets go (s).
fn released(drape: &SheetDrape) -> Vec<(GripperId, f64)> {
    let events = drape.events.iter().filter(|event| event.kind == EventKind::Release);
    events.flat_map(|event| event.grippers.iter().map(|id| (*id, event.time))).collect()
}

/// A ply that sticks to the mold where its pads have put it stays there when all of them let go, to the contact tolerance; the
/// states before are those of a drape without a release, to the last bit.
#[test]
fn a_ply_that_sticks_stays_where_it_was_laid() {
    let with = |release| layup(rolled(), release);
    let (held, before) = draped(&with(None));
    assert!(held.events.is_empty() && held.status == Status::Converged);
    let (drape, states) = draped(&with(release(ReleaseOrder::End, 2.0)));
    assert_eq!(drape.status, Status::Converged);
    let (last, states) = states.split_last().expect("states");
    assert_eq!(states, before);
    assert_eq!((last.step, last.time), (34, 35.0));
    assert!(last.holds.iter().all(|holds| !holds) && last.forces.iter().all(|f| *f == [0.0; 3]));
    let tolerance = with(None).settings.contact.tolerance;
    for (now, then) in last.positions.iter().zip(&held.last.positions) {
        let off = distance(*now, *then);
        assert!(off < tolerance, "{then:?} moves by {off} m");
    }
    // what decides is the ply at rest without pads
    assert_eq!(drape.last, *last);
}

/// The first event is the pick-up of all; at the end all press for the dwell and let go together. A dwell delays the release by
/// exactly itself and changes nothing else.
#[test]
fn a_dwell_delays_the_release_by_itself() {
    let drape_with = |dwell: f64| draped(&layup(rolled(), release(ReleaseOrder::End, dwell)));
    let ((none, without), (some, with)) = (drape_with(0.0), drape_with(1.25));
    let kinds = |drape: &SheetDrape| {
        let events = drape.events.iter();
        events.map(|event| (event.time, event.kind, event.grippers.len())).collect::<Vec<_>>()
    };
    use EventKind::{Grip, Press, Release};
    assert_eq!(kinds(&none), [(0.0, Grip, 8), (33.0, Release, 8)]);
    assert_eq!(kinds(&some), [(0.0, Grip, 8), (33.0, Press, 8), (34.25, Release, 8)]);
    assert_eq!(without.len(), with.len());
    for (a, b) in without.iter().zip(&with) {
        assert_eq!(a.positions, b.positions);
        let later = if a.holds[0] { 0.0 } else { 1.25 };
        assert_eq!(a.time + later, b.time);
    }

    let first = |dwell: f64| released(&draped(&over_a_trough(dwell)).0)[0];
    let ((gripper, time), (same, later)) = (first(0.0), first(0.75));
    assert!(time < 30.0, "{time}");
    assert_eq!((gripper, time + 0.75), (same, later));
}

/// Over a hollow the pads of a row let go when the front has come to it and they have stood for the dwell; the last row does at the end, and on a
/// floor all do. No pad holds after it has let go.
#[test]
fn over_a_hollow_a_pad_lets_go_when_its_gripper_is_placed() {
    let dwell = 1.5;
    let (drape, states) = draped(&over_a_trough(dwell));
    assert_eq!(drape.status, Status::Converged);
    // the front comes to the rows in steps 3, 13, 23 and 33, a second each
    let by_row = |id: GripperId| [4.5, 14.5, 24.5, 34.5][id[0]];
    let found = released(&drape);
    assert_eq!(found.len(), 8);
    for (id, time) in found {
        assert!((time - by_row(id)).abs() < 1e-9, "{id:?}: {time}");
    }
    for state in states.iter().filter(|state| state.time < 33.0) {
        for (n, held) in state.holds.iter().enumerate() {
            assert_eq!(*held, holds(&drape.events, GRID.id(n), state.time));
            assert!(*held || state.forces[n] == [0.0; 3]);
        }
    }
    let floor = layup(rolled(), release(ReleaseOrder::HollowsFirst, dwell));
    assert_eq!(times(&floor).as_deref(), Some(&[34.5; 8][..]));
}

/// Cells with errors let go when the program says, which is made for the motion without errors: also where strokes that are off bring no gripper to
/// its place in that step.
#[test]
fn a_cell_with_errors_lets_go_at_the_times_of_the_program() {
    let layup = over_a_trough(0.5);
    let mut errors = Errors { samples: 1, ..Errors::default() };
    errors.gripper.position = Term::Deviation(1e-3);
    errors.gripper.stroke = Term::Deviation(0.2);
    let cell = errors.draw(0, 8).apply(&layup);
    assert_ne!(cell.motion, layup.motion);
    let program = times(&layup);
    assert_eq!(cell.release.as_ref().and_then(|rule| rule.times.clone()), program);
    let program = program.expect("times");
    for (id, time) in released(&draped(&cell).0) {
        let n = GRID.index(id);
        assert!((time - program[n]).abs() < 1e-9, "{id:?}: {time}");
    }
}

/// Without friction a taut ply draws together when its pads are gone. It may come to rest there or not, but it is never taken for
/// the ply that the pads held.
#[test]
fn a_ply_that_slides_after_the_release_is_seen_to() {
    let mut layup = layup(rolled(), release(ReleaseOrder::End, 0.0));
    layup.mold = Some(plane(0.2));
    for p in layup.motion.positions.iter_mut().flatten() {
        let [x, y, z] = *p;
        let (c, s) = (0.2_f64.cos(), 0.2_f64.sin());
        *p = [c * x - s * z, y, s * x + c * z];
    }
    layup.settings.contact.friction = Friction::Coulomb(0.05);
    let (drape, states) = draped(&layup);
    assert_ne!(drape.status, Status::Converged);
    let [held, free] = [states.len() - 2, states.len() - 1].map(|n| states[n].positions[0]);
    assert!(distance(held, free) > 0.05, "it slides down the incline: {held:?} {free:?}");
}

/// A strip that is clamped level at one end and held level at the other hangs as the heavy cantilever when this pad lets go, and
/// has lost energy.
#[test]
fn a_strip_whose_end_is_let_go_hangs_as_a_cantilever() {
    let (length, spacings) = (0.03, 48);
    let h = length / spacings as f64;
    let lines = (0..=spacings + 1).map(|n| h * n as f64).collect();
    let end = length + h;
    let mut sheet = sheet([lines, vec![0.0]], &[[0.0, 0.0], [h, 0.0], [end, 0.0]]);
    sheet.mesh = h;
    for mount in [None, Some([2e3; 3])] {
        sheet.grippers[2].mount = mount;
        let mut cloth = flat(&sheet, 0.0);
        let held: Vec<[f64; 3]> = cloth.now.pads.iter().map(|pad| pad.position).collect();
        rest(&mut cloth, &held);
        let before = cloth.energy();
        cloth.release(&[2]);
        assert_eq!(cloth.pads.holds(), [true, true, false]);
        rest(&mut cloth, &held);
        assert!(cloth.energy() < before, "{} {before}", cloth.energy());
        let tip = cloth.now.x[spacings + 1];
        let free = length + 0.5 * h;
        let [x, z] = cantilever(free, 3.143 * G / 9e-5);
        let off = [tip[0] - 0.5 * h - x, tip[2] - z];
        assert!(off.iter().all(|c| c.abs() < 5e-3 * free), "{tip:?} {x} {z}");
        assert_eq!(cloth.forces()[2], [0.0; 3]);
        // the clamp bears what the pad bore too
        let borne: f64 = cloth.forces().iter().map(|force| -force[2]).sum();
        let weight = 3.143 * G * sheet.fabric.areas.iter().sum::<f64>();
        assert!((borne / weight - 1.0).abs() < 1e-6, "{borne} {weight}");
    }
}

/// Once all pads have let go the mold alone bears the ply: the derivative of the energy of contact and friction to a shift of the
/// whole ply is its weight, on an inclined plane too.
#[test]
fn the_mold_bears_the_weight_of_a_ply_without_pads() {
    // eight grippers, as points on a level and on an inclined mold, and as pads on mounts
    let held = pins();
    for (angle, radius) in [(0.0, 0.0), (0.15, 0.0), (0.15, 0.02)] {
        let mut sheet = sheet([even(0.34, 17), even(0.14, 7)], &[]);
        sheet.grippers = held
            .iter()
            .map(|[u, v]| Gripper {
                place: [u + 0.02, v + 0.02],
                radius,
                mount: (radius > 0.0).then_some([2e3; 3]),
                slip_force: None,
                max_tilt: 0.7,
                lip: Default::default(),
            })
            .collect();
        sheet.mesh = 0.02;

        // the flat ply is parallel to the mold and 0.1 mm over it
        let mold = plane(angle);
        let on = |[u, v]: [f64; 2], height: f64| {
            let (c, s) = (angle.cos(), angle.sin());
            [u * c - height * s, v, u * s + height * c]
        };
        sheet.mold = Some(mold);
        let pads_at = |height: f64| sheet.grippers.iter().map(move |g| on(g.place, height));
        let mut cloth = flat(&sheet, 0.0);
        for (x, place) in cloth.now.x.iter_mut().zip(&sheet.fabric.places) {
            *x = on(*place, 1e-4);
        }
        cloth.now.pads =
            pads_at(1e-4).map(|p| Pad { turn: turned(angle), ..Pad::new(p) }).collect();

        // the grippers bring it down
        let down: Vec<[f64; 3]> = pads_at(0.0).collect();
        bring(&mut cloth, &down, 4, 1.0);

        // upward force of the mold: the derivative of its energy to a shift of the ply
        let reaction = |cloth: &Cloth| {
            let contact = cloth.energies.contact.as_ref().expect("a mold");
            let shifted = |way: f64| {
                let x: Vec<[f64; 3]> =
                    cloth.now.x.iter().map(|[x, y, z]| [*x, *y, z + way]).collect();
                contact.value(&Configuration::at_rest(x, Vec::new()))
            };
            let way = 1e-11;
            -(shifted(way) - shifted(-way)) / (2.0 * way)
        };

        // pads and mold share the weight while the pads hold
        let weight = 3.143 * G * sheet.fabric.areas.iter().sum::<f64>();
        let pads: f64 = cloth.forces().iter().map(|force| -force[2]).sum();
        let shared = reaction(&cloth) + pads;
        assert!((shared / weight - 1.0).abs() < 1e-3, "{angle} {radius}: {shared} {weight}");

        // once the pads have let go, the mold bears all of it
        cloth.release(&(0..8).collect::<Vec<_>>());
        rest(&mut cloth, &down);
        let alone = reaction(&cloth);
        assert!((alone / weight - 1.0).abs() < 1e-3, "{angle} {radius}: {alone} {weight}");
        assert!(cloth.forces().iter().all(|force| *force == [0.0; 3]));
    }
}

/// The turn of a pad on an incline about y.
fn turned(angle: f64) -> [[f64; 3]; 3] {
    let (c, s) = (angle.cos(), angle.sin());
    [[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]]
}

/// Loads count only while a pad holds: the worst force is that of the pads that hold.
#[test]
fn a_pad_that_is_gone_has_no_loads() {
    let layup = over_a_trough(0.0);
    let (drape, states) = draped(&layup);
    let gone = states.iter().flat_map(|state| state.holds.iter().zip(&state.forces));
    let (gone, held): (Vec<_>, Vec<_>) = gone.partition(|(holds, _)| !**holds);
    assert!(gone.len() > 20 && gone.iter().all(|(_, force)| **force == [0.0; 3]));
    let most = held.iter().map(|(_, f)| crate::geometry::vector::norm(**f)).fold(0.0, f64::max);
    let limits = Limits::usual(&layup);
    let mut judge = Judge::new(&layup, &limits, true);
    let measured = handed_over(&layup, &drape, &states);
    let measured = measured.iter().map(|state| judge.see_all(state).value(Name::GripperForce));
    assert_eq!(measured.flatten().fold(0.0, f64::max), most);
}
