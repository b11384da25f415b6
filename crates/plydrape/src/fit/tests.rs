//! Against synthetic specimens of known laws, published figures and the statistics of many of them.

use super::*;
use crate::Error;
use crate::elastica::{Bending, Cantilever};
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use rand_distr::{Distribution, Normal};

/// Points of a strip that hangs as the elastica, every one off by noise of a standard deviation (m).
fn seen(rigidity: f64, noise: f64, seed: u64) -> Hang {
    let (length, weight) = (0.12, 3.08);
    let bending = Bending::Rigidity(rigidity);
    let strip = Cantilever { length, angle: 0.03, weight, bending };
    let shape = strip.solve().expect("a cantilever");
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let normal = Normal::new(0.0, noise).expect("a deviation");
    let point = |n: usize| {
        let mut off = || normal.sample(&mut random);
        let [x, z] = shape.at(length * (n as f64 + 0.5) / 24.0);
        [x + off(), z + off()]
    };
    let points = (0..24).map(point).collect();
    Hang { points, length, weight }
}

#[test]
fn points_without_noise_give_the_rigidity_back() {
    for rigidity in [3e-4, 2e-3, 2e-2] {
        let (found, each) = fit_hang(&[("strip".into(), seen(rigidity, 0.0, 1))]).expect("a fit");
        // the strip is compared by straight pieces
        assert!((found.value / rigidity - 1.0).abs() < 1e-4, "{rigidity}: {}", found.value);
        assert!((each[0][1].value - 0.03).abs() < 1e-4);
    }
}

/// The interval of 95 % of a strip with noise of 0.3 mm holds the true rigidity in about 95 of 100: of 80 the number is
/// binomial, 76 ± 1.9.
#[test]
fn the_interval_of_95_percent_holds_the_truth_in_95_of_100() {
    let rigidity = 1.5e-3;
    let holds = |seed: u64| {
        let (found, _) = fit_hang(&[("strip".into(), seen(rigidity, 3e-4, seed))]).expect("a fit");
        let [low, high] = found.interval().expect("an interval");
        (low..=high).contains(&rigidity)
    };
    let count = (0..80).filter(|seed| holds(*seed)).count();
    assert!((70..=80).contains(&count), "{count}");
}

/// The chord of a strip of twice its bending length is at 41.5°, so that B = w c³ = w L³/8: by the elastica 0.12493 w L³ (SciPy's
/// `solve_bvp`).
#[test]
fn the_standard_overhang_is_two_bending_lengths() {
    let rigidity = rigidity_of_overhang(0.06, 3.0, 41.5_f64.to_radians()).expect("a rigidity");
    let factor = rigidity / (3.0 * 0.06_f64.powi(3));
    assert!((factor - 0.124934456).abs() < 1e-8, "{factor}");
    let test = Overhang { weight: 3.0, angle: 41.5_f64.to_radians() };
    let found = test.fit(&[0.060, 0.062, 0.061]).expect("a fit");
    assert_eq!(found.sure, Sure::Specimens(3));
    // L counts with its third power: 1.64 % of deviation in L are 4.9 % in B
    assert!((found.scatter.expect("scatter") - 0.0492).abs() < 5e-4, "{found:?}");
    assert!(test.fit(&[0.06]).expect("a value").interval().is_none());
}

/// Forces made from a law by the power of the machine, F = Σ area τ γ'/δ', give the law back.
#[test]
fn a_bias_extension_gives_its_law_back() {
    let law = |gamma: f64| 8.0 * gamma + 60.0 * gamma.powi(3);
    let (width, length) = (0.1, 0.25);
    let specimen = |points| ShearSpecimen {
        name: "strip".into(),
        test: ShearTest::Bias(BiasExtension { width, length }),
        points,
    };
    let d = length - width;
    let points = |factor: f64| -> Vec<[f64; 2]> {
        let point = |n: usize| {
            let gamma = (0.25 * (n as f64 + 1.0)).to_radians();
            let delta =
                d * (2.0_f64.sqrt() * (std::f64::consts::FRAC_PI_4 - gamma / 2.0).cos() - 1.0);
            let rate = d / 2.0 * ((gamma / 2.0).cos() - (gamma / 2.0).sin());
            let middle = width * (2.0 * length - 3.0 * width) / 2.0;
            let power = middle * law(gamma) + width * width * law(gamma / 2.0) / 2.0;
            [delta, factor * power / rate]
        };
        (0..200).map(point).collect()
    };
    let fit = fit_shear(&[points(0.9), points(1.1)].map(specimen)).expect("a law");
    for (angle, force) in fit.angle.iter().zip(&fit.force) {
        assert!((force - law(*angle)).abs() < 0.01 * (1.0 + law(*angle)), "{angle} {force}");
    }
    // two specimens 10 % to either side: a deviation of 14.1 %
    assert!((fit.scatter.expect("scatter") - 0.1414).abs() < 1e-3, "{:?}", fit.scatter);
    let [linear, _, cubic] = fit.polynomial.expect("many points").map(|[c, _]| c);
    assert!((linear - 8.0).abs() < 0.5 && (cubic - 60.0).abs() < 2.0);
    assert!(fit.locking.is_some());
}

/// A picture frame gives its law back, F = L² τ γ'/δ' with δ = 2 L cos φ.
#[test]
fn a_picture_frame_gives_its_law_back() {
    let law = |gamma: f64| 20.0 * gamma;
    let side = 0.2;
    let test = ShearTest::Frame(PictureFrame { side, fabric: side });
    let point = |n: usize| {
        let gamma = (0.5 * (n as f64 + 1.0)).to_radians();
        let half = (std::f64::consts::FRAC_PI_2 - gamma) / 2.0;
        let delta = 2.0 * side * (half.cos() - std::f64::consts::FRAC_1_SQRT_2);
        [delta, side * side * law(gamma) / (side * half.sin())]
    };
    let points = (0..100).map(point).collect();
    let fit = fit_shear(&[ShearSpecimen { name: "frame".into(), test, points }]).expect("a law");
    for (angle, force) in fit.angle.iter().zip(&fit.force) {
        assert!((force - law(*angle)).abs() < 1e-9, "{angle} {force}");
    }
    assert!(fit.scatter.is_none() && fit.locking.is_none());
}

/// Two points have no polynomial of three coefficients, and three points have one.
#[test]
fn two_points_have_no_polynomial() {
    let points = [[0.1, 1.0], [0.2, 2.0], [0.3, 4.0]];
    assert_eq!(shear::polynomial(&points[..2]), None);
    assert!(shear::polynomial(&points).is_some());
}

/// With the normalized force τ/cos γ the result is that of the formula of Cao et al. 2008 for bias extension.
#[test]
fn the_normalization_is_the_published_one() {
    let (width, length) = (0.115, 0.23);
    let test = ShearTest::Bias(BiasExtension { width, length });
    let points: Vec<[f64; 2]> = (1..80).map(|n| [0.0005 * n as f64, 0.3 * n as f64]).collect();
    let specimen = ShearSpecimen { name: "strip".into(), test, points: points.clone() };
    let ([angles, forces], _) = specimen.curve().expect("a curve");
    let normalized: Vec<f64> = angles.iter().zip(&forces).map(|(a, f)| f / a.cos()).collect();
    for n in 40..angles.len() {
        let (gamma, half) = (angles[n], 0.5 * angles[n]);
        let force = points[n - 1][1];
        let at_half = statistics::between(&angles, &forces, half) / half.cos();
        let published = ((length / width - 1.0) * force * (half.cos() - half.sin())
            - width * at_half * half.cos())
            / ((2.0 * length - 3.0 * width) * gamma.cos());
        assert!((normalized[n] - published).abs() < 1e-10 * published);
    }
}

/// A loop with a moment of friction to either side of a softening law: the law is its middle.
#[test]
fn a_loop_with_hysteresis_gives_the_law_in_its_middle() {
    let law = |kappa: f64| 0.02 * (kappa / 20.0).tanh();
    let mut points = Vec::new();
    for n in -100..=100 {
        let kappa = 0.5 * f64::from(n);
        points.extend([[kappa, law(kappa) + 2e-3], [kappa, law(kappa) - 2e-3]]);
    }
    let MomentFit { curve, scatter, .. } = fit_moments(&[("loop".into(), points)]).expect("a law");
    for (kappa, moment) in curve.curvature.iter().zip(&curve.moment) {
        assert!((moment - law(*kappa)).abs() < 2e-4, "{kappa} {moment}");
    }
    assert!(scatter.is_none() && curve.curvature.len() > 8);
}

/// A load cell with coarse digits shows nothing at the first curvatures of any specimen; the scatter is that of what follows.
#[test]
fn a_moment_of_zero_has_no_scatter() {
    let specimen = |factor: f64| {
        let moment = |k: f64| if k < 10.0 { 0.0 } else { factor * 1e-3 * k };
        let points = (1..=100).map(|n| 0.5 * f64::from(n)).map(|k| [k, moment(k)]).collect();
        ("a".to_string(), points)
    };
    let fit = fit_moments(&[specimen(0.9), specimen(1.1)]).expect("a law");
    // two specimens 10 % to either side: a deviation of 14.1 %
    assert!((fit.scatter.expect("two specimens") - 0.1414).abs() < 1e-3, "{:?}", fit.scatter);
}

#[test]
fn tests_that_say_nothing_are_refused() {
    let short = ShearTest::Bias(BiasExtension { width: 0.1, length: 0.15 });
    assert!(matches!(short.check(), Err(Error::FitRange { what: "the length", .. })));
    let test = ShearTest::Frame(PictureFrame { side: 0.2, fabric: 0.2 });
    let specimen = ShearSpecimen { name: "a".into(), test, points: vec![[0.001, 1.0]] };
    assert!(matches!(fit_shear(&[specimen]), Err(Error::FitTooFew { .. })));
    assert!(matches!(fit_shear(&[]), Err(Error::FitTooFew { found: 0, .. })));
    // three times 1e-4 have a variance of 1.7e-24 by their squares
    assert_eq!(statistics::line(&[[1e-4, 0.0], [1e-4, 5.0], [1e-4, 10.0]]), None);
    let mut strip = seen(1e-3, 0.0, 1);
    strip.points.truncate(3);
    assert!(matches!(fit_hang(&[("a".into(), strip)]), Err(Error::FitTooFew { .. })));
    let mut strip = seen(1e-3, 0.0, 1);
    strip.length = 0.05;
    assert!(matches!(fit_hang(&[("a".into(), strip)]), Err(Error::FitNoStrip { .. })));
    let falling = (1..20).map(|n| [f64::from(n), -f64::from(n)]).collect();
    let found = fit_moments(&[("a".into(), falling)]);
    assert!(matches!(found, Err(Error::FitPoint { fault: PointFault::BelowZero, .. })));
    let found = fit_moments(&[("a".into(), Vec::new())]);
    assert!(matches!(found, Err(Error::FitTooFew { found: 0, .. })));
}

/// Displacement (m) and force (N) of a bias specimen of the law τ = 10 γ + 40 γ³ N/m, a point every two degrees from 2 deg on.
fn pulled([width, length]: [f64; 2], last: usize) -> Vec<[f64; 2]> {
    let law = |gamma: f64| 10.0 * gamma + 40.0 * gamma.powi(3);
    let d = length - width;
    let point = |n: usize| {
        let gamma = (2.0 * n as f64).to_radians();
        let way = d * (2.0_f64.sqrt() * (std::f64::consts::FRAC_PI_4 - gamma / 2.0).cos() - 1.0);
        let rate = d / 2.0 * ((gamma / 2.0).cos() - (gamma / 2.0).sin());
        let middle = width * (2.0 * length - 3.0 * width) / 2.0;
        let power = middle * law(gamma) + width * width * law(gamma / 2.0) / 2.0;
        [way, power / rate]
    };
    (1..=last).map(point).collect()
}

fn bias([width, length]: [f64; 2], points: Vec<[f64; 2]>) -> ShearSpecimen {
    let test = ShearTest::Bias(BiasExtension { width, length });
    ShearSpecimen { name: "strip".into(), test, points }
}

const SIZES: [[f64; 2]; 2] = [[0.1, 0.25], [0.05, 0.15]];

/// The law of one material does not depend on the size of its specimens: 10 γ + 40 γ³ is 7.69 N/m at 25 deg and 25.8 N/m at 44 deg.
#[test]
fn specimens_of_two_sizes_say_one_law() {
    for sizes in [SIZES, [SIZES[1], SIZES[0]]] {
        let fit = fit_shear(&sizes.map(|size| bias(size, pulled(size, 22)))).expect("a law");
        for (degrees, expected) in [(25.0_f64, 7.69), (44.0, 25.8)] {
            let found = statistics::between(&fit.angle, &fit.force, degrees.to_radians());
            assert!((found / expected - 1.0).abs() < 0.015, "{degrees}: {found}");
        }
        assert!(fit.scatter.expect("scatter") < 5e-3, "{:?}", fit.scatter);
    }
}

/// A force that stays as it is while the strip gets longer: the shear force falls by the kinematics, and the law ends before.
#[test]
fn a_strip_that_slips_at_a_constant_force_ends_its_law() {
    let mut points = pulled(SIZES[0], 22);
    let [way, force] = points[21];
    points.extend((1..15).map(|n| [way + 8e-4 * f64::from(n), force]));
    let fit = fit_shear(&[bias(SIZES[0], points)]).expect("a law");
    assert!(matches!(fit.remarks[0][..], [Remark::BeyondShear { points: [22, 35], .. }]));
    assert!((fit.force.last().expect("a force") - 25.8).abs() < 0.3, "{:?}", fit.force);
}

/// What a machine records beside the loading changes nothing, and is said.
#[test]
fn a_law_comes_from_the_loading_alone() {
    let loaded = pulled(SIZES[0], 22);
    let alone = fit_shear(&[bias(SIZES[0], loaded.clone())]).expect("a law");
    assert_eq!(alone.remarks, [[]]);
    let (way, force) = (loaded[21][0], loaded[21][1]);
    let slipped = (1..8).map(|n| [way + 8e-4 * f64::from(n), 0.05]).collect::<Vec<_>>();
    let back = (1..22).rev().map(|n| [loaded[n - 1][0], 0.3 * loaded[n - 1][1]]).collect();
    // a partial slip after which the force rises to a higher peak
    let mut later: Vec<_> = (1..4).map(|n| [way + 8e-4 * f64::from(n), 0.5 * force]).collect();
    later.push([way + 4e-3, 1.5 * force]);
    let after = |last| Remark::AfterPeak { points: [22, last], peak: force };
    for (rest, remark) in
        [(slipped, after(28)), (later, after(25)), (back, Remark::Unloading { points: [22, 42] })]
    {
        let points = [loaded.clone(), rest].concat();
        let fit = fit_shear(&[bias(SIZES[0], points)]).expect("a law");
        assert_eq!((&fit.force, &fit.angle), (&alone.force, &alone.angle));
        assert_eq!(fit.remarks, [[remark]]);
    }
}

/// Each is refused at its point: a wrong sign, a wrong zero, two specimens in one record, a place in place of a displacement.
#[test]
fn what_no_specimen_does_is_refused_at_its_point() {
    let loaded = pulled(SIZES[0], 22);
    let changed = |change: fn(f64, f64) -> [f64; 2]| -> Vec<[f64; 2]> {
        loaded.iter().map(|[x, f]| change(*x, *f)).collect()
    };
    let twice = [loaded.clone(), loaded.clone()].concat();
    let mut jump = loaded.clone();
    jump[1][1] = 3.0;
    let preloaded = [vec![[0.0, 2.0]], changed(|x, f| [x, f + 2.0])].concat();
    for (points, point, fault) in [
        (changed(|x, f| [x, -f]), 0, PointFault::BelowZero),
        (changed(|x, f| [x, f - 2.0]), 0, PointFault::BelowZero),
        (changed(|x, f| [x, f - 0.3]), 0, PointFault::BelowZero),
        (preloaded, 0, PointFault::NotZero),
        (jump, 2, PointFault::FallsEarly),
        (twice, 22, PointFault::Returns),
        (changed(|x, f| [x - 0.02, f]), 0, PointFault::Backwards),
    ] {
        let found = fit_shear(&[bias(SIZES[0], points)]).unwrap_err();
        let what = "strip".to_string();
        assert_eq!(found, Error::FitPoint { what, point, fault });
    }
    let away = fit_shear(&[bias(SIZES[0], changed(|x, f| [x + 0.12, f]))]).unwrap_err();
    let message = "the displacements of strip are from 122.6 to 165.3 mm, and its specimen shears between 0 and 62.1 mm";
    assert_eq!(away.to_string(), message);
    // a load that was not set to zero, without a point at no displacement
    let fit = fit_shear(&[bias(SIZES[0], changed(|x, f| [x, f + 2.0]))]).expect("a law");
    assert!(
        matches!(fit.remarks[0][..], [Remark::LoadAtRest { load }] if (load - 2.0).abs() < 0.02)
    );
}

/// Noise of a load cell of 0.3 % to 3 % of the largest force, below zero at the start, is no fault, in few points and in many.
#[test]
fn noise_of_a_load_cell_is_no_fault() {
    let mut random = ChaCha8Rng::seed_from_u64(3);
    let loaded = pulled(SIZES[0], 22);
    let [way, force]: [Vec<f64>; 2] = [0, 1].map(|n| loaded.iter().map(|p| p[n]).collect());
    for (count, deviation) in [(40, 0.02), (300, 0.02), (300, 0.2), (3000, 0.02), (3000, 0.2)] {
        let normal = Normal::new(0.0, deviation).expect("a deviation");
        let mut point = |n: usize| {
            // slack first
            let x = way[21] * (n as f64 / count as f64 - 0.1) / 0.9;
            let pulled = if x < way[0] {
                force[0] * (x / way[0]).max(0.0)
            } else {
                statistics::between(&way, &force, x)
            };
            [x + 0.1 * way[21], pulled + normal.sample(&mut random)]
        };
        let points = (0..=count).map(&mut point).collect();
        let fit = fit_shear(&[bias(SIZES[0], points)]).expect("a law");
        assert_eq!(fit.remarks, [[]], "{count} {deviation}");
    }
}

/// A ply that creases at 40 1/m: of one way and of a loop the law ends there, and says so.
#[test]
fn a_moment_ends_at_its_peak() {
    let law = |kappa: f64| if kappa.abs() <= 40.0 { 2e-3 * kappa } else { 2e-2 * kappa.signum() };
    let forth: Vec<[f64; 2]> = (0..=100).map(|n| 0.5 * f64::from(n)).map(|k| [k, law(k)]).collect();
    let both: Vec<[f64; 2]> = (-100..=100)
        .chain((-100..=100).rev())
        .map(|n| 0.5 * f64::from(n))
        .map(|k| [k, law(k)])
        .collect();
    for points in [forth.clone(), both] {
        let fit = fit_moments(&[("a".into(), points)]).expect("a law");
        for (kappa, moment) in fit.curve.curvature.iter().zip(&fit.curve.moment) {
            assert!((moment - 2e-3 * kappa).abs() < 1e-4, "{kappa} {moment}");
        }
        assert_eq!(fit.remarks[0].len(), 1, "{:?}", fit.remarks);
    }
    let off = forth.iter().map(|[k, m]| [*k, m - 0.02]).collect();
    let error = fit_moments(&[("a".into(), off)]).unwrap_err();
    assert!(matches!(error, Error::FitPoint { fault: PointFault::BelowZero, point: 0, .. }));
}

#[test]
fn a_strip_whose_axes_are_turned_over_is_refused() {
    for (change, fault) in
        [((1.0, -1.0), PointFault::Upwards), ((-1.0, 1.0), PointFault::BehindEdge)]
    {
        let mut strip = seen(1e-3, 0.0, 1);
        for point in &mut strip.points {
            *point = [change.0 * point[0], change.1 * point[1]];
        }
        let error = fit_hang(&[("a".into(), strip)]).unwrap_err();
        assert!(matches!(error, Error::FitPoint { fault: found, .. } if found == fault), "{error}");
    }
    // two strips in one table
    let mut strip = seen(1e-3, 0.0, 1);
    strip.points.extend(seen(3e-4, 0.0, 1).points);
    let error = fit_hang(&[("a".into(), strip)]).unwrap_err();
    let returns = PointFault::Returns;
    assert!(
        matches!(error, Error::FitPoint { point: 24, fault, .. } if fault == returns),
        "{error}"
    );
}
