//! What draws and the layups of real cells must agree with: laws of chance, rigid motions, closed forms.

use super::*;
use crate::catenary::{EndCondition, Span};
use crate::clearance::Poses;
use crate::equilibrium::Solver;
use crate::geometry::vector::{along, sub, turned};
use crate::layup::{Layup, Model, Settings, Target};
use crate::material::{Material, Section, ShearCurve};
use crate::mold::{Relief, distance};
use crate::motion::Motion;
use crate::ply::{Grid, Ply};
use crate::sheet::Sheet;
use crate::tool::{Axis, Tool};
use rayon::prelude::*;

/// Every term has an error.
pub(crate) fn budget() -> Errors {
    let (deviation, bound) = (Term::Deviation, Term::Bound);
    Errors {
        seed: 11,
        frame: FrameErrors { position: deviation(5e-4), angle: bound(2e-3) },
        gripper: GripperErrors { position: bound(1e-4), stroke: deviation(1e-4) },
        pick_up: PickUpErrors { offset: bound(1e-3), yaw: deviation(2e-3) },
        material: MaterialErrors {
            areal_mass: deviation(0.05),
            bending: bound(0.2),
            shear: deviation(0.1),
            length: bound(1e-3),
        },
        mold: MoldErrors {
            offset: deviation(3e-4),
            tilt: bound(1e-3),
            waviness: deviation(2e-4),
            wavelength: 0.15,
        },
        ..Errors::default()
    }
}

/// `nu` × `nv` grippers over a level array that comes down in three steps, each turned and shrunk a little.
pub(crate) fn layup(nu: usize, nv: usize) -> Layup {
    let grid = Grid { nu, nv };
    let material = Material {
        section: Section::Areal { mass: 3.143, warp_rigidity: 9e-5, weft_rigidity: 8e-5 },
        shear_curve: Some(ShearCurve::Polynomial { coefficients: vec![5.0, 2.0] }),
        ..Material::woven("paper", 3.143, 9e-5, 1e6, 5.0)
    };
    let ply = Ply::of_array(grid, [0.1, 0.08], material);
    let settings = Settings { model: Model::Catenaries, ..Settings::default() };
    let step = |k: usize| {
        let near = 0.97 + 0.005 * k as f64;
        let place = |n: usize| {
            let [i, j] = grid.id(n).map(|k| k as f64);
            let flat = [0.1 * near * i, 0.08 * near * j, 0.2 - 0.05 * k as f64];
            turned([0.0, 0.0, 0.1 * k as f64], flat)
        };
        (0..grid.grippers()).map(place).collect::<Vec<_>>()
    };
    let positions: Vec<_> = (0..3).map(step).collect();
    let target = Target { grippers: positions[2].clone(), drape: None };
    let motion = Motion { times: vec![0.0, 1.0, 2.0], positions };
    Layup { target: Some(target), ..Layup::new(ply, settings, motion) }
}

/// No error.
fn none(grippers: usize) -> Draw {
    Errors::default().draw(0, grippers)
}

/// The largest distance of the positions of two motions (m).
fn apart(a: &Motion, b: &Motion) -> f64 {
    let pairs = a.positions.iter().flatten().zip(b.positions.iter().flatten());
    pairs.map(|(p, q)| distance(*p, *q)).fold(0.0, f64::max)
}

/// A sample is the same cell with more grippers, drawn after others, by many threads, and with other terms left out.
#[test]
fn a_draw_does_not_depend_on_what_else_is_drawn() {
    let errors = budget();
    let (few, many) = (errors.draw(5, 3), errors.draw(5, 9));
    assert_eq!(few.grippers[..], many.grippers[..3]);
    assert_eq!(Draw { grippers: Vec::new(), ..few }, Draw { grippers: Vec::new(), ..many.clone() });

    let wider = Errors { samples: 1000, share: 0.5, ..errors };
    assert_eq!(wider.draw(5, 9), many);
    let one_by_one: Vec<Draw> = (0..40).map(|n| errors.draw(n, 9)).collect();
    let mut at_once: Vec<Draw> = (0..40).into_par_iter().rev().map(|n| errors.draw(n, 9)).collect();
    at_once.reverse();
    assert_eq!(one_by_one, at_once);

    let alone = Errors { seed: 11, gripper: errors.gripper, ..Errors::default() };
    assert_eq!(alone.draw(5, 9).grippers, many.grippers);
    let mold = Errors { seed: 11, mold: errors.mold, ..Errors::default() };
    assert_eq!(mold.draw(5, 9).mold, many.mold);
}

/// Samples, seeds, grippers, axes and quantities of the same law all have numbers of their own.
#[test]
fn no_number_is_drawn_twice() {
    let term = Term::Bound(1.0);
    let frame = FrameErrors { position: term, angle: term };
    let gripper = GripperErrors { position: term, stroke: term };
    let pick_up = PickUpErrors { offset: term, yaw: term };
    let material = MaterialErrors { areal_mass: term, bending: term, shear: term, length: term };
    let mold = MoldErrors { offset: term, tilt: term, ..MoldErrors::default() };
    let errors = Errors { frame, gripper, pick_up, material, mold, ..Errors::default() };
    let mut numbers = Vec::new();
    for seed in 0..3 {
        for sample in 0..3 {
            let draw = Errors { seed, ..errors }.draw(sample, 4);
            numbers.extend(draw.frame.shift.into_iter().chain(draw.frame.turn));
            for gripper in &draw.grippers {
                numbers.extend(gripper.position.into_iter().chain(gripper.stroke));
            }
            numbers.extend(draw.pick_up.offset.into_iter().chain([draw.pick_up.yaw]));
            let MaterialError { areal_mass, bending, shear, length } = draw.material;
            numbers.extend([areal_mass, bending, shear].map(f64::from).into_iter().chain([length]));
            numbers.extend(draw.mold.motion.shift);
            numbers.extend(&draw.mold.motion.turn[..2]);
        }
    }
    let drawn = numbers.len();
    assert_eq!(drawn, 9 * (6 + 4 * 6 + 3 + 4 + 5));
    numbers.sort_by(f64::total_cmp);
    numbers.dedup();
    assert_eq!(numbers.len(), drawn);
}

/// Twice the draw is the draw of twice the terms; none of it leaves the layup as it is, to the last bit.
#[test]
fn a_draw_is_linear_in_a_common_factor() {
    let errors = budget();
    let double = Errors {
        frame: FrameErrors {
            position: errors.frame.position.scaled(2.0),
            angle: errors.frame.angle.scaled(2.0),
        },
        gripper: GripperErrors {
            position: errors.gripper.position.scaled(2.0),
            stroke: errors.gripper.stroke.scaled(2.0),
        },
        pick_up: PickUpErrors {
            offset: errors.pick_up.offset.scaled(2.0),
            yaw: errors.pick_up.yaw.scaled(2.0),
        },
        material: MaterialErrors {
            areal_mass: errors.material.areal_mass.scaled(2.0),
            bending: errors.material.bending.scaled(2.0),
            shear: errors.material.shear.scaled(2.0),
            length: errors.material.length.scaled(2.0),
        },
        mold: MoldErrors {
            offset: errors.mold.offset.scaled(2.0),
            tilt: errors.mold.tilt.scaled(2.0),
            waviness: errors.mold.waviness.scaled(2.0),
            wavelength: errors.mold.wavelength,
        },
        ..errors
    };
    // a factor of two rounds nothing
    assert_eq!(errors.draw(3, 4).scaled(2.0), double.draw(3, 4));

    let layup = layup(4, 2);
    let nominal = errors.draw(3, 8).scaled(0.0).apply(&layup);
    assert_eq!((&nominal.motion, &nominal.ply), (&layup.motion, &layup.ply));
    assert!(Errors::default().is_zero() && !errors.is_zero());
}

/// Over many cells the root of the mean square of a term is its deviation, or its bound over √3, within four standard errors;
/// a bound is nearly reached and never exceeded.
#[test]
fn errors_are_as_large_as_their_terms_say() {
    let errors = budget();
    let cells: Vec<Draw> = (0..20_000).map(|n| errors.draw(n, 1)).collect();
    let check = |term: Term, value: &dyn Fn(&Draw) -> f64| {
        let values: Vec<f64> = cells.iter().map(value).collect();
        let count = values.len() as f64;
        let mean = values.iter().sum::<f64>() / count;
        let root = (values.iter().map(|x| x * x).sum::<f64>() / count).sqrt();
        let most = values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let expected = match term {
            Term::Deviation(deviation) => deviation,
            Term::Bound(bound) => {
                assert!(most <= bound && most > 0.999 * bound, "{most} {bound}");
                bound / 3_f64.sqrt()
            }
            Term::Factor(_) => unreachable!("the budget has none"),
        };
        // of a normal law the root of n squares is off by 1/√2n of itself, of an even one by less
        assert!((root / expected - 1.0).abs() < 4.0 / (2.0 * count).sqrt(), "{root} {expected}");
        assert!(mean.abs() < 4.0 * expected / count.sqrt(), "{mean} {expected}");
    };
    check(errors.frame.position, &|draw| draw.frame.shift[1]);
    check(errors.frame.angle, &|draw| draw.frame.turn[2]);
    check(errors.gripper.position, &|draw| draw.grippers[0].position[0]);
    check(errors.gripper.stroke, &|draw| draw.grippers[0].stroke[2]);
    check(errors.pick_up.offset, &|draw| draw.pick_up.offset[0]);
    check(errors.pick_up.yaw, &|draw| draw.pick_up.yaw);
    check(errors.material.areal_mass, &|draw| draw.material.areal_mass.into());
    check(errors.material.bending, &|draw| draw.material.bending.into());
    check(errors.material.shear, &|draw| draw.material.shear.into());
    check(errors.material.length, &|draw| draw.material.length);
    check(errors.mold.offset, &|draw| draw.mold.motion.shift[0]);
    check(errors.mold.tilt, &|draw| draw.mold.motion.turn[1]);
    let height =
        |draw: &Draw| draw.mold.waves.map_or(0.0, |waves| waves.at([0.3, 0.1, 0.0]).height);
    check(errors.mold.waviness, &height);
}

/// Of a factor of 2 the ratios of true to nominal values lie between a half and double, and nearly reach both; their logarithms are even,
/// so that half of the ratios are below 1, which is their median, and a quarter below √½. Of n cells a share p is off by √(p (1 − p)/n).
#[test]
fn half_and_double_are_as_likely_of_a_factor_of_two() {
    let shear = Term::Factor(2.0);
    let material = MaterialErrors { shear, ..MaterialErrors::default() };
    let errors = Errors { material, ..Errors::default() };
    let mut ratios: Vec<f64> =
        (0..20_000).map(|n| errors.draw(n, 1).material.shear.ratio()).collect();
    ratios.sort_by(f64::total_cmp);
    let below = |most: f64| ratios.partition_point(|ratio| *ratio < most) as f64 / 20_000.0;
    assert!((below(1.0) - 0.5).abs() < 4.0 * (0.25 / 2e4_f64).sqrt(), "{}", below(1.0));
    assert!((below(0.5_f64.sqrt()) - 0.25).abs() < 4.0 * (0.1875 / 2e4_f64).sqrt());
    let [least, most] = [ratios[0], ratios[19_999]];
    assert!((0.5..0.501).contains(&least) && (1.998..=2.0).contains(&most), "{least} {most}");
    // the deviation of an even logarithm from −ln 2 to ln 2
    assert!((shear.deviation() - 2_f64.ln() / 3_f64.sqrt()).abs() < 1e-15);
    assert!(Term::Factor(1.0).is_zero() && !shear.is_zero());
}

/// Twice a factor of 2 is a factor of 4, of the term and of each cell, and none of it leaves the ply as it is, to the last bit.
#[test]
fn a_scaled_factor_is_its_power() {
    let layup = layup(2, 2);
    let errors_with = |shear: Term| {
        let material = MaterialErrors { shear, ..MaterialErrors::default() };
        Errors { material, ..Errors::default() }
    };
    assert_eq!(Term::Factor(2.0).scaled(2.0), Term::Factor(4.0));
    let (two, four) = (errors_with(Term::Factor(2.0)), errors_with(Term::Factor(4.0)));
    let force = |draw: &Draw| {
        let ply = draw.apply(&layup).ply;
        ply.material.shear_curve.expect("a curve").force(0.4).0
    };
    let nominal = force(&none(4));
    for sample in 0..20 {
        let draw = two.draw(sample, 4);
        let ratio = force(&draw) / nominal;
        let [doubled, squared] =
            [draw.scaled(2.0), four.draw(sample, 4)].map(|d| force(&d) / nominal);
        assert!(
            (doubled / squared - 1.0).abs() < 1e-14
                && (doubled / (ratio * ratio) - 1.0).abs() < 1e-14
        );
        assert_eq!(draw.scaled(0.0).apply(&layup).ply, layup.ply);
    }
}

/// Where all numbers of a term are the same size, their mean square is: the waves of one mold have the deviation over all of it.
#[test]
fn waves_have_their_deviation_over_one_mold_and_keep_their_bound() {
    let over = |waviness: Term| {
        let mold = MoldErrors { waviness, wavelength: 0.05, ..MoldErrors::default() };
        let waves = Errors { mold, ..Errors::default() }.draw(2, 1).mold.waves.expect("waves");
        let places =
            (0..160_000).map(|n| [0.0123 * (n % 400) as f64, 0.0123 * (n / 400) as f64, 0.0]);
        let heights: Vec<f64> = places.map(|p| waves.at(p).height).collect();
        let square = heights.iter().map(|h| h * h).sum::<f64>() / heights.len() as f64;
        (square.sqrt(), heights.into_iter().fold(0.0_f64, |most, h| most.max(h.abs())))
    };
    // 100 waves along each side: what is cut off of the last ones is a few thousandths
    let (root, _) = over(Term::Deviation(2e-4));
    assert!((root / 2e-4 - 1.0).abs() < 0.01, "{root}");
    let (_, most) = over(Term::Bound(2e-4));
    assert!(most <= 2e-4 && most > 1e-4, "{most}");
}

/// A tool frame that is off moves all grippers of a step as one body: their distances stay, their mean moves by the shift.
#[test]
fn a_frame_error_is_a_rigid_motion() {
    let layup = layup(4, 3);
    let turn = [0.02, -0.01, 0.03];
    let shift = [1e-3, -2e-3, 5e-4];
    let draw = Draw { frame: RigidError { shift, turn }, ..none(12) };
    let real = draw.apply(&layup);
    let mean = |step: &[[f64; 3]]| [0, 1, 2].map(|n| step.iter().map(|p| p[n]).sum::<f64>() / 12.0);
    for (before, after) in layup.motion.positions.iter().zip(&real.motion.positions) {
        for a in 0..12 {
            for b in 0..a {
                let [was, is] = [before, after].map(|step| distance(step[a], step[b]));
                assert!((was - is).abs() < 1e-15 && distance(before[a], after[a]) > 1e-4);
            }
        }
        assert!(distance(mean(after), along(mean(before), 1.0, shift)) < 1e-15);
        // the turn is that of the rotation vector
        let [was, is] = [before, after].map(|step| sub(step[3], step[0]));
        assert!(distance(turned(turn, was), is) < 1e-15);
    }
}

/// A cell keeps the tool of its layup: stems and flange are turned as the frame is, with the error of its angle, and no errors are taken
/// back, those of single grippers that axes along z cannot make either.
#[test]
fn a_cell_stands_as_its_tool_does_with_the_errors_of_its_frame() {
    let plain = layup(4, 3);
    let lean = |step: &Vec<[f64; 3]>| step.iter().map(|p| turned([0.3, 0.0, 0.0], *p)).collect();
    let mut positions = plain.motion.positions.clone();
    positions[2] = lean(&positions[1]);
    let (name, direction, stroke) = ("z".into(), [0.0, 0.0, 1.0], [-0.1, 0.1]);
    let axis = Axis { name, direction, stroke, speed: 1.0 };
    let tool = Some(Tool::new(&positions[0], vec![axis]));
    let layup = Layup { tool, motion: Motion { positions, ..plain.motion.clone() }, ..plain };
    let (made, _) = layup.carried();
    let turn = [0.02, -0.01, 0.03];
    let frame = RigidError { turn, ..RigidError::default() };
    let mut draw = Draw { frame, ..none(12) };
    let poses = |layup: &Layup, step: usize| {
        let places = &layup.motion.positions[step];
        let level = vec![[0.0, 0.0, 0.0, 1.0]; places.len()];
        Poses::new(layup, places, &level, places)
    };
    let real = draw.apply(&layup);
    for step in 0..3 {
        let [was, is] = [&*made, &real].map(|layup| poses(layup, step).flange.expect("a flange"));
        for (a, b) in was.axes.iter().zip(is.axes) {
            assert!(distance(turned(turn, *a), b) < 1e-9, "{step}: {a:?} {b:?}");
        }
        let stem = poses(&real, step).stems[5];
        assert!(distance(stem.axes[2], real.stems(&real.motion.positions[step])) < 1e-12);
        assert!(stem.axes[2][2] < 0.9999, "{stem:?}");
    }
    draw.grippers[4].position = [1e-3, -1e-3, 1e-3];
    let real = draw.apply(&layup);
    assert_eq!(real.carried().0.motion, real.motion);
}

/// A mold that is moved one way is a motion that is moved the other way; turned about the middle of the target, where the
/// motion ends, it is the frame turned back.
#[test]
fn a_mold_error_is_the_inverse_of_a_frame_error() {
    let layup = layup(3, 3);
    let [shift, turn] = [[1e-3, 2e-3, -3e-3], [0.01, -0.02, 0.0]];
    let back = |v: [f64; 3]| v.map(|x| -x);
    let mold = |motion| {
        let draw = none(9);
        Draw { mold: MoldError { motion, ..draw.mold }, ..draw }.apply(&layup).motion
    };
    let frame = |frame| Draw { frame, ..none(9) }.apply(&layup).motion;
    let still = [0.0; 3];
    let [offset, other] = [
        mold(RigidError { shift, turn: still }),
        frame(RigidError { shift: back(shift), turn: still }),
    ];
    assert!(apart(&offset, &other) < 1e-15);
    let [tilted, other] = [
        mold(RigidError { shift: still, turn }),
        frame(RigidError { shift: still, turn: back(turn) }),
    ];
    for (p, q) in tilted.positions[2].iter().zip(&other.positions[2]) {
        assert!(distance(*p, *q) < 1e-15);
    }
    // of a tilted and shifted mold, the place of a gripper over the mold is what it would be over the real one
    let moved = mold(RigidError { shift, turn });
    let middle = [0, 1, 2].map(|n| {
        let target = &layup.target.as_ref().expect("a target").grippers;
        target.iter().map(|p| p[n]).sum::<f64>() / 9.0
    });
    for (p, q) in moved.positions[0].iter().zip(&layup.motion.positions[0]) {
        let real = along(along(middle, 1.0, turned(turn, sub(*p, middle))), 1.0, shift);
        assert!(distance(real, *q) < 1e-15);
    }
}

/// An array that holds the ply δ aside moves as it would have, and has the fabric δ aside under each gripper; an array that is turned on the
/// ply about its middle has the fabric turned back under it, as far as an angle is its sine.
#[test]
fn a_pick_up_error_moves_no_gripper_but_the_fabric_under_it() {
    for (nu, nv) in [(4, 3), (3, 1)] {
        let (layup, yaw) = (layup(nu, nv), 1e-3);
        let pick_up = PickUpError { offset: [2e-3, -1e-3], yaw };
        let real = Draw { pick_up, ..none(nu * nv) }.apply(&layup);
        assert_eq!(real.motion, layup.motion);
        let middle = [0.05 * (nu - 1) as f64, 0.04 * (nv - 1) as f64];
        for n in 0..nu * nv {
            let place = layup.ply.place(n);
            let [u, v] = [0, 1].map(|c| place[c] - middle[c]);
            let off = real.ply.held_off(place);
            let expected = [2e-3 - yaw * v, -1e-3 + yaw * u];
            assert!((0..2).all(|c| (off[c] - expected[c]).abs() < 1e-15), "{off:?} {expected:?}");
            assert_eq!(layup.ply.held_off(place), [0.0; 2]);
        }
    }
}

/// A gripper whose way is too long by a share is where it should be at the start, and past its end by that share of the way.
#[test]
fn a_stroke_error_grows_with_the_way() {
    let layup = layup(2, 2);
    let mut draw = none(4);
    draw.grippers[1] = GripperError { position: [0.0; 3], stroke: [0.01, 0.02, -0.03] };
    let real = draw.apply(&layup);
    let [start, end] = [0, 2].map(|k| layup.motion.positions[k][1]);
    assert_eq!(real.motion.positions[0], layup.motion.positions[0]);
    for (axis, share) in [0.01, 0.02, -0.03].into_iter().enumerate() {
        let past = real.motion.positions[2][1][axis] - end[axis];
        assert!((past - share * (end[axis] - start[axis])).abs() < 1e-15);
    }
    for other in [0, 2, 3] {
        assert_eq!(real.motion.positions[2][other], layup.motion.positions[2][other]);
    }
}

/// Mass, bending and shear are scaled each by its own share, and never below a tenth.
#[test]
fn material_errors_scale_what_they_are_of() {
    let layup = layup(2, 2);
    let errors = |areal_mass, bending, shear| {
        let [areal_mass, bending, shear] = [areal_mass, bending, shear].map(RelativeError::Share);
        let material = MaterialError { areal_mass, bending, shear, length: 0.0 };
        Draw { material, ..none(4) }.apply(&layup).ply.material
    };
    let real = errors(0.1, -0.2, 0.5);
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-15, "{a} {b}");
    let Section::Areal { mass, warp_rigidity, weft_rigidity } = real.section else {
        panic!("a section by area")
    };
    near(mass, 1.1 * 3.143);
    near(warp_rigidity, 0.8 * 9e-5);
    near(weft_rigidity, 0.8 * 8e-5);
    let force = |material: &Material| material.shear_curve.as_ref().expect("a curve").force(0.4).0;
    near(force(&real), 1.5 * force(&layup.ply.material));
    let Section::Areal { mass, .. } = errors(-3.0, 0.0, 0.0).section else {
        panic!("a section by area")
    };
    near(mass, 0.1 * 3.143);
}

/// A ply without an error of its length is what it was, to the last bit.
#[test]
fn a_length_factor_of_one_changes_nothing() {
    let layup = layup(3, 2);
    let plain = crate::sheet::Fabric::rectangle([vec![0.0, 0.1, 0.25], vec![0.0, 0.07]], 0.1);
    assert_eq!(plain.clone().enlarged(1.0), plain);
    assert_eq!(layup.ply.fabric_cell(), layup.ply.cell);
    let longer = Ply { length_factor: 1.01, ..layup.ply.clone() };
    for n in 0..layup.ply.lines().catenaries() {
        let share = longer.flat_length(n) / layup.ply.flat_length(n);
        assert!((share - 1.01).abs() < 1e-15);
    }
    #[cfg(feature = "serde")]
    {
        let text = serde_json::to_string(&layup.ply).expect("JSON");
        assert!(!text.contains("length_factor"));
        let text = serde_json::to_string(&longer).expect("JSON");
        assert_eq!(serde_json::from_str::<Ply>(&text).expect("a ply"), longer);
    }
}

/// 1 % more fabric between two grippers hangs with the force of a catenary of that length, in the model of catenaries by its closed form.
#[test]
fn a_longer_fabric_pulls_as_a_catenary_of_its_length() {
    let mut layup = layup(2, 1);
    layup.motion.positions = vec![vec![[0.0; 3], [0.098, 0.0, 0.0]]];
    layup.motion.times = vec![0.0];
    layup.target = None;
    let material = MaterialError { length: 0.01, ..MaterialError::default() };
    let real = Draw { material, ..none(2) }.apply(&layup);
    let line = real.ply.line(crate::ply::Kind::EdgeU);
    let span = Span {
        run: 0.098,
        rise: 0.0,
        length: 0.101,
        ends: [EndCondition::Free; 2],
        weight: line.mass * layup.settings.gravity,
        flexural_rigidity: line.flexural_rigidity,
        axial_stiffness: layup.settings.axial_stiffness,
    };
    let expected = span.solve(None).force.expect("it hangs");
    let mut solver = Solver::new(&real.ply, &real.settings);
    let contacts = vec![None; real.ply.lines().catenaries()];
    let _ = solver.solve(&real.motion.positions[0], &contacts);
    let found = solver.force(0).expect("a force");
    assert!((found / expected - 1.0).abs() < 1e-9, "{found} {expected}");
}

/// The sheet of a longer ply is that of a ply whose cells are as much longer: its fabric coordinates alone are the nominal ones.
#[test]
fn a_longer_sheet_is_the_sheet_of_longer_cells() {
    let mut layup = layup(3, 2);
    layup.settings.pad.radius = 0.01;
    layup.settings.sheet.overhang = 0.02;
    layup.settings.sheet.mesh = Some(0.02);
    let factor = 1.25;
    let longer = Sheet::new(&Layup {
        ply: Ply { length_factor: factor, ..layup.ply.clone() },
        ..layup.clone()
    });
    let mut large = layup.clone();
    large.ply.cell = large.ply.cell.map(|side| factor * side);
    large.settings.pad.radius *= factor;
    large.settings.sheet.overhang *= factor;
    large.settings.sheet.mesh = Some(0.02 * factor);
    let [longer, large, nominal] =
        [longer, Sheet::new(&large), Sheet::new(&layup)].map(|sheet| sheet.expect("a sheet"));
    assert_eq!(longer.fabric.places, nominal.fabric.places);
    let near = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-12, "{a} {b}");
    for (a, b) in longer.fabric.segments.iter().zip(&large.fabric.segments) {
        near(a.length, b.length);
        near(a.width, b.width);
    }
    for (a, b) in longer.fabric.bends.iter().zip(&large.fabric.bends) {
        near(a.spacing[0], b.spacing[0]);
        near(a.width, b.width);
    }
    for (a, b) in longer.fabric.cells.iter().zip(&large.fabric.cells) {
        near(a.area, b.area);
    }
    for (a, b) in longer.fabric.areas.iter().zip(&large.fabric.areas) {
        near(*a, *b);
    }
    for (a, b) in longer.held().iter().flatten().zip(large.held().iter().flatten()) {
        assert_eq!(a.0, b.0);
        assert!((0..2).all(|n| (a.1[n] - b.1[n]).abs() < 1e-12));
    }
}
