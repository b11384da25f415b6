//! One span against closed forms, printed figures, an independent solver's numbers and its equation.

use plydrape_catenary::catenary::{EndCondition, Profile, Root, Span, SpanState, Variable};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

const FREE: EndCondition = EndCondition::Free;

fn slope(s: f64) -> EndCondition {
    EndCondition::Slope(s)
}

/// The paper's ply (Krogh et al. 2018, Table 1): 100 mm between ends 98 mm apart.
fn paper_span(run: f64, ends: [EndCondition; 2]) -> Span {
    Span {
        run,
        rise: 0.0,
        length: 0.1,
        ends,
        weight: 0.3143 * 9.8,
        flexural_rigidity: 9e-6,
        axial_stiffness: f64::INFINITY,
    }
}

fn solved(span: &Span) -> Profile {
    let root = span.solve(None);
    Profile::new(span, root.force.expect("the span hangs"))
}

/// Arc length by composite Simpson on the slope: independent of the panels under test.
fn length_by_simpson(profile: &Profile, run: f64, intervals: usize) -> f64 {
    // graded towards both ends, where the layers are: x = ℓ(1 − cos πs)/2
    let speed = |n: usize| {
        let s = n as f64 / intervals as f64;
        let x = run * (0.5 - 0.5 * (std::f64::consts::PI * s).cos());
        let dx = 0.5 * std::f64::consts::PI * run * (std::f64::consts::PI * s).sin();
        profile.station(x.clamp(0.0, run)).slope.hypot(1.0) * dx
    };
    let mut sum = speed(0) + speed(intervals);
    for n in 1..intervals {
        sum += if n % 2 == 1 { 4.0 } else { 2.0 } * speed(n);
    }
    sum / (3.0 * intervals as f64)
}

/// Neither does a number that is none, which every comparison says no to.
#[test]
fn a_root_that_misses_the_length_solves_no_span() {
    let span = paper_span(0.098, [FREE, FREE]);
    let root = span.solve(None);
    assert!(span.is_solved_by(&root));
    for residual in [2e-6, f64::INFINITY, f64::NAN] {
        assert!(!span.is_solved_by(&Root { residual, ..root }), "{residual}");
    }
    assert!(!span.is_solved_by(&Root { force: Some(f64::NAN), ..root }));
}

/// Figures of the small-sag theory for 100 mm of the paper's ply, worked out with a different program
/// (SciPy `solve_bvp`); the last digit printed is the tolerance.
#[test]
fn the_paper_ply_hangs_with_the_known_force_and_sag() {
    for (run, ends, force, sag_mm) in [
        (0.098, [FREE, FREE], 0.41728, 8.7022),
        (0.098, [slope(0.0), slope(0.0)], 0.32795, 8.8647),
        (0.090, [FREE, FREE], 0.15086, 19.4616),
    ] {
        let profile = solved(&paper_span(run, ends));
        assert!((profile.force() - force).abs() < 6e-6, "H {} for {force}", profile.force());
        assert!((profile.sag().0 * 1e3 - sag_mm).abs() < 6e-5, "{:?} for {sag_mm}", profile.sag());
    }
}

/// As EI → 0 the span tends to the parabola, whose length and force have a closed form:
/// L = ℓ/2 (√(1+u²) + asinh(u)/u), u = qℓ/2H, for level ends.
#[test]
fn a_limp_span_hangs_as_a_parabola() {
    for rigidity in [0.0, 1e-16] {
        let mut span = paper_span(0.098, [FREE, FREE]);
        span.flexural_rigidity = rigidity;
        let profile = solved(&span);
        let u = span.load() * span.run / (2.0 * profile.force());
        let length = 0.5 * span.run * (u.hypot(1.0) + u.asinh() / u);
        assert!((length / span.length - 1.0).abs() < 1e-9, "EI = {rigidity}: {length}");
        let sag = span.load() * span.run.powi(2) / (8.0 * profile.force());
        assert!((profile.sag().0 / sag - 1.0).abs() < 1e-9);
    }
}

/// Near H = 0 the span is a beam: a level one with free ends and no horizontal force sags 5qℓ⁴/384EI.
#[test]
fn a_span_without_horizontal_force_is_a_beam() {
    let mut span = paper_span(0.098, [FREE, FREE]);
    span.flexural_rigidity = 1e-3;
    for force in [-1e-9, 0.0, 1e-9] {
        let sag = Profile::new(&span, force).sag().0;
        let beam = 5.0 * span.load() * span.run.powi(4) / (384.0 * span.flexural_rigidity);
        assert!((sag / beam - 1.0).abs() < 1e-6, "{sag} {beam}");
        let held = Span { ends: [slope(0.0), slope(0.0)], ..span };
        let sag = Profile::new(&held, force).sag().0;
        assert!((sag / (beam / 5.0) - 1.0).abs() < 1e-6, "held ends: a fifth of it");
    }
}

/// A stiff strip with slack is pushed together, up to its first buckling load.
#[test]
fn a_stiff_span_with_slack_is_in_compression() {
    for (ends, number) in [
        ([FREE, FREE], std::f64::consts::PI.powi(2)),
        ([slope(0.0), slope(0.0)], 4.0 * std::f64::consts::PI.powi(2)),
        ([FREE, slope(0.0)], 20.190_728_556),
    ] {
        let mut span = paper_span(0.098, ends);
        span.flexural_rigidity = 10.0;
        let force = solved(&span).force();
        let buckling = -number * span.flexural_rigidity / span.run.powi(2);
        assert!(force > buckling && force < 0.999 * buckling, "{force} {buckling}");
        let length = length_by_simpson(&Profile::new(&span, force), span.run, 4000);
        assert!((length / span.length - 1.0).abs() < 1e-9, "{ends:?}: {length}");
    }
}

/// A chord longer than the fabric is carried by EA: H cos⁻¹θ ≈ EA·strain, whatever the slopes.
#[test]
fn an_overstretched_span_pulls_with_its_axial_stiffness() {
    for ends in [[FREE, FREE], [slope(0.3), slope(-0.2)]] {
        let mut span = paper_span(0.1005, ends);
        span.axial_stiffness = 1e5;
        let root = span.solve(None);
        assert_eq!(root.state, SpanState::Overstretched);
        let force = root.force.expect("EA is finite");
        // the layers of prescribed slopes use up fabric: 5e-5 m of it here
        assert!((force / 500.0 - 1.0).abs() < 0.15, "{ends:?}: {force}");
        span.axial_stiffness = f64::INFINITY;
        let root = span.solve(None);
        assert_eq!((root.force, root.state), (None, SpanState::Straight));
    }
}

/// A chord that equals the fabric length has a finite force: the parabola's excess q²ℓ³/24H² is the
/// stretch HL/EA.
#[test]
fn a_taut_span_has_a_finite_force() {
    let mut span = paper_span(0.1, [FREE, FREE]);
    span.axial_stiffness = 1e5;
    let force = solved(&span).force();
    let parabola = (span.load().powi(2) * span.run.powi(2) * 1e5 / 24.0).cbrt();
    assert!((force / parabola - 1.0).abs() < 1e-3, "{force} {parabola}");
}

/// Small-sag solutions of every case of the reference file, made with SciPy's `solve_bvp`.
#[test]
fn the_reference_strips_agree_to_1e_6() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data/strip_cases.json");
    let Ok(text) = std::fs::read_to_string(path) else {
        eprintln!("SKIPPED: {path} is not there; the reference strips were not compared");
        return;
    };
    let file: serde_json::Value = serde_json::from_str(&text).expect("valid JSON");
    let cases = file["cases"].as_array().expect("a list of cases");
    assert!(!cases.is_empty());
    for case in cases {
        let number = |key: &str| case[key].as_f64().expect("a number");
        let end = |n: usize| case["end_slopes"][n].as_f64().map_or(FREE, slope);
        let span = Span {
            run: number("span_mm") * 1e-3,
            rise: number("rise_mm") * 1e-3,
            length: number("length_mm") * 1e-3,
            ends: [end(0), end(1)],
            weight: number("w_N_per_m"),
            flexural_rigidity: number("EI"),
            axial_stiffness: f64::INFINITY,
        };
        let small = &case["small_sag"];
        let Some(force) = small["H_N"].as_f64() else {
            continue;
        };
        let profile = solved(&span);
        let id = &case["id"];
        assert!((profile.force() / force - 1.0).abs() < 1e-6, "{id}: H {}", profile.force());
        let sag = small["sag_vertical_mm"].as_f64().expect("a sag") * 1e-3;
        assert!((profile.sag().0 / sag - 1.0).abs() < 1e-6, "{id}: sag {:?}", profile.sag());
        for (n, z) in small["z_stations_mm"].as_array().expect("stations").iter().enumerate() {
            let z = z.as_f64().expect("a number") * 1e-3;
            let ours = profile.station(span.run * n as f64 / 10.0).z;
            assert!((ours - z).abs() < 1e-6 * sag, "{id}: z[{n}] {ours} for {z}");
        }
    }
}

/// Any span: weights of 1e-3 … 1e3 N/m, kℓ of the limp parabola from 1e-3 to 1e4, any slack up to a
/// half, inclined, each end free or held.
fn any_span() -> impl Strategy<Value = Span> {
    let end = prop_oneof![Just(FREE), (-0.8..0.8).prop_map(EndCondition::Slope)];
    let ends = (end.clone(), end);
    (-3.0..3.0, -3.0..4.0, -4.0..-0.3, -2.0..1.0, -0.5..0.5, ends).prop_map(
        |(weight, stiffness, slack, run, rise, ends)| {
            let [weight, kl, slack, run] =
                [weight, stiffness, slack, run].map(|p: f64| 10f64.powf(p));
            let chord = run * f64::hypot(1.0, rise);
            let length = chord * (1.0 + slack);
            let force = weight * (run.powi(3) / (24.0 * (length - chord))).sqrt();
            Span {
                run,
                rise: rise * run,
                length,
                ends: [ends.0, ends.1],
                weight,
                flexural_rigidity: force * run * run / (kl * kl),
                axial_stiffness: f64::INFINITY,
            }
        },
    )
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 2000,
        rng_seed: RngSeed::Fixed(2018),
        failure_persistence: None,
        ..Default::default()
    })]

    /// Equation (1), both end conditions, the ends and the length, to 1e-9.
    #[test]
    fn every_span_satisfies_its_equation(span in any_span()) {
        let root = span.solve(None);
        let force = root.force.expect("it hangs");
        let profile = Profile::new(&span, force);
        let (first, last) = (profile.station(0.0), profile.station(span.run));
        prop_assert!(first.z.abs() < 1e-9 * span.run);
        prop_assert!((last.z - span.rise).abs() < 1e-9 * span.run);
        let length = length_by_simpson(&profile, span.run, 20_000);
        // a force has 16 digits: close to buckling its last one already moves the length
        let last_digit = f64::EPSILON * force.abs() * profile.length_and_excess::<3>().0.gradient[0].abs();
        prop_assert!((length - span.length).abs() < 1e-9 * span.length + 4.0 * last_digit,
            "L {} for {}, H {} of buckling {}, {:?}",
            length, span.length, force, span.buckling_force(), root);

        // z' is the derivative of z, z'' of z', and V' = q: with V = H z' − EI z''' that is (1)
        let steepest = (0..=50).map(|n| profile.station(span.run * f64::from(n) / 50.0).slope.abs())
            .fold(0.0, f64::max);
        let h = 1e-5 * span.run;
        for n in 1..20 {
            let x = span.run * f64::from(n) / 20.0;
            let [a, m, b] = [x - h, x, x + h].map(|x| profile.station(x));
            let rise = (b.z - a.z) / (2.0 * h);
            prop_assert!((rise - m.slope).abs() < 1e-6 * steepest.max(1e-3));
            let shear = (b.moment - a.moment) / (2.0 * h);
            let vertical = force * m.slope - shear;
            let scale = force.abs() * steepest + span.load() * span.run + m.moment.abs() / span.run;
            prop_assert!((vertical - m.vertical_force).abs() < 1e-5 * scale, "{vertical} {:?}", m);
            let grown = m.vertical_force - first.vertical_force - span.load() * x;
            prop_assert!(grown.abs() < 1e-9 * scale, "V' = q: {grown}");
        }
        let largest = (0..=50).map(|n| profile.station(span.run * f64::from(n) / 50.0).moment.abs())
            .fold(0.0, f64::max);
        for (end, station) in [first, last].into_iter().enumerate() {
            match span.ends[end] {
                EndCondition::Free => prop_assert!(station.moment.abs() <= 1e-9 * largest),
                EndCondition::Slope(s) => prop_assert!((station.slope - s).abs() < 1e-9 * steepest.max(1.0)),
            }
        }
    }

    /// Mirrored, a span has the same force.
    #[test]
    fn a_mirrored_span_has_the_same_force(span in any_span()) {
        let flip = |e: EndCondition| match e {
            EndCondition::Free => FREE,
            EndCondition::Slope(s) => slope(-s),
        };
        let mirror = Span { rise: -span.rise, ends: [flip(span.ends[1]), flip(span.ends[0])], ..span };
        let (a, b) = (span.solve(None).force.expect("hangs"), mirror.solve(None).force.expect("hangs"));
        // near buckling the force is all but constant, so compare what is above it
        let pole = span.buckling_force();
        prop_assert!((a - b).abs() <= 1e-7 * (a - pole).abs() + 1e-12 * pole.abs(), "{a} {b} {pole}");
    }

    /// First and second derivatives of length, end slopes and end curvatures to all seven variables,
    /// against central differences of values and of gradients.
    #[test]
    fn derivatives_agree_with_central_differences(span in any_span(), above in 0.05..3.0_f64) {
        // a force anywhere on the branch, away from buckling and from the change of form at κ = 25
        let unit = span.flexural_rigidity / span.run.powi(2);
        let solution = span.solve(None).force.expect("it hangs");
        let force = span.buckling_force() + above * (solution - span.buckling_force());
        let kappa = force / unit;
        prop_assume!((kappa - 25.0).abs() > 0.1 && force - span.buckling_force() > 1e-3 * unit);

        let held = |end: usize| matches!(span.ends[end], EndCondition::Slope(_));
        let profile_with = |variable: usize, delta: f64| {
            let (mut s, mut h) = (span, force);
            let mut bend = |end: usize| if let EndCondition::Slope(v) = &mut s.ends[end] { *v += delta };
            match variable {
                0 => h += delta,
                1 => bend(0),
                2 => bend(1),
                3 => s.run += delta,
                4 => s.rise += delta,
                5 => s.weight += delta,
                _ => s.flexural_rigidity += delta,
            }
            Profile::new(&s, h)
        };
        type Read = fn(&Profile) -> plydrape_catenary::catenary::Jet<7>;
        let quantities: [(&str, Read); 5] = [
            ("length", |p| p.length_and_excess().0),
            ("first slope", |p| p.end_slope_jet(0)),
            ("second slope", |p| p.end_slope_jet(1)),
            ("first curvature", |p| p.end_curvature_jet(0)),
            ("second curvature", |p| p.end_curvature_jet(1)),
        ];
        let scale = [force.abs().max(unit), 1.0, 1.0, span.run, span.run, span.weight, span.flexural_rigidity];
        for (name, read) in quantities {
            // the curvature of a free end is zero whatever happens
            if (name == "first curvature" && !held(0)) || (name == "second curvature" && !held(1)) {
                continue;
            }
            let jet = read(&profile_with(0, 0.0));
            // sizes of the derivatives, per relative change of each variable
            let size = (0..7).map(|i| (jet.gradient[i] * scale[i]).abs()).fold(jet.value.abs(), f64::max);
            let bend = (0..49).map(|n| (jet.hessian[n / 7][n % 7] * scale[n / 7] * scale[n % 7]).abs())
                .fold(size, f64::max);
            for i in 0..7 {
                if (i == Variable::FirstSlope as usize && !held(0))
                    || (i == Variable::SecondSlope as usize && !held(1)) {
                    prop_assert_eq!(jet.gradient[i], 0.0);
                    continue;
                }
                // near buckling only a small part of the change of H, ℓ or EI may be spent
                let h = 2e-6 * scale[i] * ((force - span.buckling_force()) / (10.0 * unit)).min(1.0);
                let (low, high) = (read(&profile_with(i, -h)), read(&profile_with(i, h)));
                let slope = (high.value - low.value) / (2.0 * h);
                prop_assert!(((slope - jet.gradient[i]) * scale[i]).abs() < 2e-6 * bend,
                    "{name}, variable {i}: {slope} for {}", jet.gradient[i]);
                for j in 0..7 {
                    let slope = (high.gradient[j] - low.gradient[j]) / (2.0 * h);
                    prop_assert!(((slope - jet.hessian[i][j]) * scale[i] * scale[j]).abs() < 2e-4 * bend,
                        "{name}, variables {i} {j}: {slope} for {}", jet.hessian[i][j]);
                }
            }
        }
    }
}
