//! Gap samples against brute force: no touch is missed by the bounds, with and without earlier observations.

use crate::common::{all_cases, meshed};
use plydrape::catenary::{EndCondition, Profile, Span, SpanState};
use plydrape::draping::gap::{GapSamples, Run};
use plydrape::draping::sampling::GapCache;
use plydrape::draping::spans::FreeSpan;
use plydrape::mold::{
    Cylinder, Face, Graph, HeightGrid, Mold, Plane, Pose, Saddle, Sphere, Surface,
};

/// Intervals between the stations of a span.
const INTERVALS: usize = 48;

/// A number between 0 and 1 from a sequence without gaps (Weyl), a different one for each prime's root.
fn scatter(n: usize, prime: f64) -> f64 {
    (n as f64 * prime.sqrt()).fract()
}

/// Curved like the molds of the examples, over half a meter square, `scale` times as large.
fn height(scale: f64, x: f64, y: f64) -> f64 {
    let (x, y) = (x / scale, y / scale);
    scale * (0.08 * (7.0 * x).sin() * (5.0 * y).cos() + 0.2 * x * y)
}

fn as_formula(scale: f64) -> Mold {
    let text = format!(
        "{scale:?}*(0.08*sin(7*x/{scale:?})*cos(5*y/{scale:?}) + 0.2*x*y/{:?})",
        scale * scale
    );
    let z = plydrape_io::read::formula::read(&text).expect("a formula");
    let domain = Some([[-0.3 * scale, 0.3 * scale]; 2]);
    Mold::Graph(Graph { pose: Pose::ORIGIN, surface: Surface::Formula { z }, domain })
}

/// `n` × `n` places over the square, along x first.
fn places(n: usize, scale: f64) -> Vec<f64> {
    (0..n).map(|k| scale * (-0.3 + 0.6 * k as f64 / (n - 1) as f64)).collect()
}

fn as_heights(scale: f64) -> Mold {
    let axis = places(41, scale);
    let z = axis.iter().flat_map(|y| axis.iter().map(|x| height(scale, *x, *y))).collect();
    let heights = HeightGrid::new(axis.clone(), axis, z).expect("a grid");
    let domain = Some(heights.range());
    Mold::Graph(Graph { pose: Pose::ORIGIN, surface: Surface::HeightGrid(heights), domain })
}

fn as_mesh(scale: f64) -> Mold {
    let place = |shares: [f64; 2]| {
        let [x, y] = shares.map(|share| scale * (-0.3 + 0.6 * share));
        [x, y, height(scale, x, y)]
    };
    meshed(40, place, |_, _| true)
}

fn molds(scale: f64) -> Vec<(&'static str, Mold)> {
    let radius = 0.6 * scale;
    let pose = Pose::new([0.05 * scale, 0.0, -radius], [0.05, -0.1, 0.7]);
    let aside = Pose::new([0.0, 0.02 * scale, radius], [0.05, 0.02, 0.3]);
    let surface = Surface::Saddle(Saddle { radii: [0.4 * scale, 0.6 * scale] });
    vec![
        ("sphere", Mold::Sphere(Sphere { pose, radius, face: Face::Outside })),
        ("cylinder", Mold::Cylinder(Cylinder { pose, radius, face: Face::Outside })),
        ("trough", Mold::Cylinder(Cylinder { pose: aside, radius, face: Face::Inside })),
        ("saddle", Mold::Graph(Graph { pose: Pose::ORIGIN, surface, domain: None })),
        ("formula", as_formula(scale)),
        ("height grid", as_heights(scale)),
        ("mesh", as_mesh(scale)),
        ("plane", Mold::Plane(Plane { point: [0.0; 3], normal: [-0.28, 0.0, 0.96] })),
    ]
}

/// A hanging span near a mold: its middle `above` it. Weight, stiffness and force are such that the shape scales.
fn span(mold: &Mold, n: usize, above: f64, scale: f64) -> FreeSpan {
    let run = 0.098 * scale;
    let angle = std::f64::consts::TAU * scatter(n, 2.0);
    let middle = [3.0, 5.0].map(|prime| 0.3 * scale * (scatter(n, prime) - 0.5));
    let heading = [angle.cos(), angle.sin()];
    let plan = [-0.5, 0.5].map(|side| [0, 1].map(|c| middle[c] + side * run * heading[c]));
    let on = |place: [f64; 2]| mold.highest_point(place).expect("the mold is there")[2];
    // from far below the ends of the chord to somewhat above, tilted
    let ends = [0, 1].map(|e| {
        let tilt = 0.02 * scale * (scatter(n, 7.0 + 4.0 * e as f64) - 0.3);
        [plan[e][0], plan[e][1], on(plan[e]) + above + tilt]
    });
    let weight = 3.0;
    let problem = Span {
        run,
        rise: ends[1][2] - ends[0][2],
        length: 0.0,
        ends: [EndCondition::Free, EndCondition::Slope(0.4 * (scatter(n, 13.0) - 0.5))],
        weight,
        flexural_rigidity: 1e-5 * scale.powi(3),
        axial_stiffness: f64::INFINITY,
    };
    let force = scale * weight * 0.1 * (0.1 + 2.0 * scatter(n, 17.0));
    let profile = Profile::new(&problem, force);
    let length = profile.length_to(run);
    FreeSpan {
        curve: std::sync::OnceLock::new(),
        catenary: 0,
        segment: 0,
        element: None,
        ends,
        length,
        start: 0.0,
        profile: Some(profile),
        state: SpanState::Hanging,
        shearing: false,
        force: Some(force),
        slopes: [0.0; 2],
        prescribed: [false; 2],
    }
}

/// Stations that touch, and the deepest of all, each by the exact distance.
fn by_search(span: &FreeSpan, mold: &Mold, tolerance: f64) -> (Vec<f64>, f64) {
    let at = (0..=INTERVALS).map(|n| n as f64 / INTERVALS as f64);
    let exact: Vec<(f64, f64)> = at.map(|t| (t, mold.signed_distance(span.point(t)))).collect();
    let deepest = exact.iter().map(|(_, d)| *d).fold(f64::INFINITY, f64::min);
    (exact.into_iter().filter(|(_, d)| *d < tolerance).map(|(t, _)| t).collect(), deepest)
}

/// Proves the runs of a span against the search.
fn check(name: &str, span: &FreeSpan, mold: &Mold, tolerance: f64, gaps: &GapSamples) -> Vec<Run> {
    let runs = gaps.runs(span, mold, tolerance);
    let (touching, deepest) = by_search(span, mold, tolerance);
    for t in &touching {
        assert!(runs.iter().any(|run| run.from <= *t && *t <= run.to), "{name}: {t} is missed");
    }
    for run in &runs {
        let distance = |t: f64| mold.signed_distance(span.point(t));
        assert_eq!(distance(run.deepest), run.depth, "{name}: the deepest point is exact");
        for t in [run.from, run.to] {
            let d = distance(t);
            let on_end = t == 0.0 || t == 1.0;
            assert!(d < tolerance * (1.0 + 1e-6), "{name}: a run ends {d} away");
            assert!(on_end || d > tolerance * (1.0 - 1e-6), "{name}: a run ends {d} away");
        }
    }
    if !touching.is_empty() {
        let depth = gaps.depth();
        assert!(-depth <= deepest, "{name}: {depth} is not as deep as a station, {deepest}");
        // a refined minimum is not far below the stations around it
        assert!(-depth > deepest - 0.02 * span.length, "{name}: {depth}, {deepest}");
    }
    runs
}

/// Spans that come down on every mold, step by step, each sampled with and without earlier observations: the same
/// samples that decide, and no station that touches is missed.
#[test]
fn every_station_that_touches_is_found_whatever_was_seen_before() {
    let tolerance = 2e-4;
    for (name, mold) in molds(1.0) {
        let (mut touched, mut free) = (0, 0);
        for n in 1..60 {
            let mut cache = GapCache::new(Some(&mold), 1);
            for step in 0..24 {
                // down, with a jump in the middle, and up again
                let above = 0.03 - 0.0025 * f64::from(step.min(30 - step)) - 5e-5 * n as f64;
                let span = span(&mold, n, above, 1.0);
                let gaps = cache.samples(&span, &mold, tolerance);
                let runs = check(name, &span, &mold, tolerance, &gaps);
                let fresh = GapSamples::new(&span, &mold, tolerance);
                assert_eq!(runs, fresh.runs(&span, &mold, tolerance), "{name} {n} {step}");
                assert_eq!(gaps.depth(), fresh.depth(), "{name} {n} {step}");
                if runs.is_empty() { free += 1 } else { touched += 1 }
            }
        }
        assert!(touched > 100 && free > 100, "{name}: {touched} touch, {free} do not");
    }
}

/// A touch between two stations, narrower than their distance, is found by the minimum between them: the same
/// touches as a search with a hundred times as many stations, where these are at least two of 48 intervals wide.
#[test]
fn no_touch_wider_than_the_stations_are_apart_is_missed() {
    let tolerance = 2e-4;
    for (name, mold) in molds(1.0) {
        for n in 60..if all_cases() { 160 } else { 80 } {
            let span = span(&mold, n, 0.004 * (scatter(n, 19.0) - 0.2), 1.0);
            let runs = GapSamples::new(&span, &mold, tolerance).runs(&span, &mold, tolerance);
            let fine = 100 * INTERVALS;
            let touches: Vec<bool> = (0..=fine)
                .map(|k| mold.signed_distance(span.point(k as f64 / fine as f64)) < tolerance)
                .collect();
            for (k, _) in touches.iter().enumerate().filter(|(_, touches)| **touches) {
                let wide = |step: isize| {
                    let along = |j: &isize| {
                        usize::try_from(k as isize + step * j)
                            .is_ok_and(|k| touches.get(k) == Some(&true))
                    };
                    (0..200).take_while(along).count()
                };
                if wide(1) + wide(-1) < 200 {
                    continue;
                }
                let t = k as f64 / fine as f64;
                let held = runs.iter().any(|run| run.from - 1e-9 <= t && t <= run.to + 1e-9);
                assert!(held, "{name} {n}: {t}");
            }
        }
    }
}

/// Everything a tenth and ten times as large: runs at the same fractions, depths in proportion. Rounding is relative
/// to the size, so the crossings agree to some 1e-9 of the run.
#[test]
fn samples_scale_with_the_scene() {
    for ((name, one), (tenth, ten)) in
        molds(1.0).into_iter().zip(molds(0.1).into_iter().zip(molds(10.0)))
    {
        for n in 1..40 {
            let runs = |mold: &Mold, scale: f64| {
                let span = span(mold, n, 0.003 * scale, scale);
                let tolerance = 2e-4 * scale;
                GapSamples::new(&span, mold, tolerance).runs(&span, mold, tolerance)
            };
            let expected = runs(&one, 1.0);
            for (mold, scale) in [(&tenth.1, 0.1), (&ten.1, 10.0)] {
                let found = runs(mold, scale);
                assert_eq!(found.len(), expected.len(), "{name} {n} × {scale}");
                for (a, b) in found.iter().zip(&expected) {
                    let off = [a.from - b.from, a.to - b.to, (a.depth / scale - b.depth) / 0.1];
                    assert!(off.iter().all(|x| x.abs() < 1e-6), "{name} {n} × {scale}: {off:?}");
                }
            }
        }
    }
}

/// A formula, a height grid and a plane that are the same plane give the same runs, to rounding.
#[test]
fn a_flat_formula_and_a_plane_have_the_same_samples() {
    let (slope, tolerance) = (0.3, 2e-4);
    let size = f64::hypot(slope, 1.0);
    let plane = Mold::Plane(Plane { point: [0.0; 3], normal: [-slope / size, 0.0, 1.0 / size] });
    let z = plydrape_io::read::formula::read("0.3*x").expect("a formula");
    let domain = Some([[-0.5, 0.5]; 2]);
    let formula = Graph { pose: Pose::ORIGIN, surface: Surface::Formula { z }, domain };
    let axis = places(5, 1.0);
    let heights = axis.iter().flat_map(|_| axis.iter().map(|x| slope * x)).collect();
    let heights = HeightGrid::new(axis.clone(), axis, heights).expect("a grid");
    let domain = Some(heights.range());
    let grid = Graph { pose: Pose::ORIGIN, surface: Surface::HeightGrid(heights), domain };
    for n in 1..100 {
        let span = span(&plane, n, 0.01 * scatter(n, 23.0) - 0.003, 1.0);
        let expected = GapSamples::new(&span, &plane, tolerance).runs(&span, &plane, tolerance);
        for mold in [Mold::Graph(formula.clone()), Mold::Graph(grid.clone())] {
            let found = GapSamples::new(&span, &mold, tolerance).runs(&span, &mold, tolerance);
            assert_eq!(found.len(), expected.len(), "{n}");
            for (a, b) in found.iter().zip(&expected) {
                let off = [a.from - b.from, a.to - b.to, a.depth - b.depth];
                assert!(off.iter().all(|x| x.abs() < 1e-9), "{n}: {off:?}");
            }
        }
    }
}

/// The points at equal stations are those of the closed form: stiff, taut, in compression and limp.
#[test]
fn equal_stations_are_points_of_the_span() {
    for (rigidity, force) in [(0.0, 0.4), (9e-6, 0.4), (9e-6, 30.0), (1e-2, -3.0), (1e-9, 2.0)] {
        let free = EndCondition::Free;
        let ends = [free, if rigidity > 0.0 { EndCondition::Slope(0.1) } else { free }];
        let problem = Span {
            run: 0.098,
            rise: 0.02,
            length: 0.1,
            ends,
            weight: 3.0,
            flexural_rigidity: rigidity,
            axial_stiffness: 1e5,
        };
        let mold = Mold::Plane(Plane { point: [0.0; 3], normal: [0.0, 0.0, 1.0] });
        let mut span = span(&mold, 1, 0.01, 1.0);
        span.ends = [[0.1, 0.2, 0.3], [0.1 + 0.098 * 0.6, 0.2 + 0.098 * 0.8, 0.32]];
        span.profile = Some(Profile::new(&problem, force));
        let stations: [[f64; 3]; INTERVALS + 1] = span.stations();
        for (n, place) in stations.iter().enumerate() {
            let point = span.point(n as f64 / INTERVALS as f64);
            let off = (0..3).map(|c| (place[c] - point[c]).abs()).fold(0.0, f64::max);
            assert!(off < 1e-15, "{rigidity} {force} {n}: {off:e}");
        }
    }
}

/// No slope and no second derivative within the domain is larger than its bound, and the bound is not idle.
#[test]
fn steepness_bounds_every_slope_and_bend() {
    let formulas = [
        "1.004*x + 1.089*y - 3.667*x^2 - 4.4*x*y - 3.75*y^2 + 3.086*x^3 + 8.889*x^2*y + 4.321*y^3",
        "0.08*sin(7*x)*cos(5*y) + 0.2*x*y",
        "sqrt(1 - x^2 - y^2)",
        "exp(-4*(x^2 + y^2))/(2 + x)",
        "0.1*ln(2 + x) + 0.1*log10(3 + y)^2 - (1.5 + x)^1.5 + (2 + y)^(x - 1)",
        "0.1*tan(x) + 0.2*sinh(x*y) + 0.1*cosh(3*y) - tanh(2*x - y)",
        "0.1*asin(x) + 0.1*acos(0.5*y) + atan(4*x*y) + (x + 2)^-2 + (y - 0.1)^3 + x^0*y",
    ];
    let domain = [[-0.3, 0.4], [-0.35, 0.3]];
    let mut surfaces: Vec<Surface> = (formulas.iter())
        .map(|text| Surface::Formula {
            z: plydrape_io::read::formula::read(text).expect("a formula"),
        })
        .collect();
    surfaces.push(Surface::Saddle(Saddle { radii: [0.3, 0.5] }));
    let axis = places(9, 1.4);
    let rough = |n: usize| 0.05 * scatter(n, 29.0);
    let heights = HeightGrid::new(axis.clone(), axis, (0..81).map(rough).collect());
    surfaces.push(Surface::HeightGrid(heights.expect("a grid")));
    for (n, surface) in surfaces.into_iter().enumerate() {
        let graph = Graph { pose: Pose::ORIGIN, surface, domain: Some(domain) };
        let bound = graph.steepness();
        let (mut slope, mut bend) = (0.0_f64, 0.0_f64);
        for k in 0..20_000 {
            let [x, y] = [(0, 2.0), (1, 3.0)].map(|(c, prime)| {
                let [low, high] = domain[c];
                low + (high - low) * scatter(k, prime)
            });
            let at = graph.surface.at(x, y);
            let [xx, xy, yy] = at.hessian;
            let (mean, radius) = (0.5 * (xx + yy), (0.5 * (xx - yy)).hypot(xy));
            slope = slope.max(at.gradient[0].hypot(at.gradient[1]));
            bend = bend.max(mean.abs() + radius);
        }
        let slack = 1.0 + 1e-12;
        assert!(slope <= bound.slope * slack && bend <= bound.bend * slack, "{n}: {bound:?}");
        assert!(
            bound.slope < 6.0 * slope && bound.bend < 8.0 * bend,
            "{n}: {slope} {bend} {bound:?}"
        );
    }
}

/// High above ridges on a slope the closest point that is found downhill is not the closest of all, and the ball that is
/// called clear must not reach the next ridge.
#[test]
fn a_ball_that_is_called_clear_holds_nothing_of_the_mold() {
    let z = plydrape_io::read::formula::read("0.03*cos(40*x) + 0.8*x").expect("a formula");
    let domain = Some([[-0.5, 0.5]; 2]);
    let surface = Surface::Formula { z };
    let ridges = Mold::Graph(Graph { pose: Pose::ORIGIN, surface, domain });
    for (name, mold) in molds(1.0).into_iter().chain([("ridges", ridges)]) {
        let bound = mold.steepness();
        for n in 1..300 {
            let [x, y] = [2.0, 3.0].map(|prime| 0.6 * (scatter(n, prime) - 0.5));
            let Some(on) = mold.highest_point([x, y]) else { continue };
            let p = [x, y, on[2] + 0.4 * scatter(n, 5.0).powi(2)];
            let clear = mold.clear(p, mold.separation(p, f64::INFINITY), bound);
            for k in 1..400 {
                let [u, v] = [7.0, 11.0].map(|prime| 0.6 * (scatter(k, prime) - 0.5));
                let Some(q) = mold.highest_point([u, v]) else { continue };
                let apart = (0..3).map(|c| (p[c] - q[c]).powi(2)).sum::<f64>().sqrt();
                assert!(apart >= clear * (1.0 - 1e-9), "{name} {n} {k}: {apart} in {clear}");
            }
        }
    }
}
