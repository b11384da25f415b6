//! Drawings are written here pair by pair, so that nothing that writes DXF files can hide a fault of what reads them. Files of
//! another program are in `tests/it/outlines`.

use super::entity::MOST_POINTS;
use super::*;
use proptest::prelude::*;
use std::f64::consts::PI;
use std::fmt::Write as _;

const TOLERANCE: f64 = 1e-5;

/// A drawing in a unit of the header, of entities.
fn drawing(unit: u8, entities: &str) -> String {
    format!(
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{entities}0\nENDSEC\n0\nEOF\n"
    )
}

fn millimeters(entities: &str) -> String {
    drawing(4, entities)
}

fn entity(kind: &str, layer: &str, pairs: &[(i32, f64)]) -> String {
    let mut text = format!("0\n{kind}\n8\n{layer}\n");
    for (code, value) in pairs {
        let whole = matches!(code, 60..=79 | 90..=99);
        let value = if whole { format!("{value:.0}") } else { format!("{value:?}") };
        let _ = write!(text, "{code}\n{value}\n");
    }
    text
}

fn line(layer: &str, a: [f64; 2], b: [f64; 2]) -> String {
    entity("LINE", layer, &[(10, a[0]), (20, a[1]), (11, b[0]), (21, b[1])])
}

fn arc(layer: &str, center: [f64; 2], radius: f64, from: f64, to: f64) -> String {
    let pairs = [(10, center[0]), (20, center[1]), (40, radius), (50, from), (51, to)];
    entity("ARC", layer, &pairs)
}

fn circle(layer: &str, center: [f64; 2], radius: f64) -> String {
    entity("CIRCLE", layer, &[(10, center[0]), (20, center[1]), (40, radius)])
}

/// A closed polyline of points and bulges.
fn bulged(layer: &str, vertices: &[[f64; 3]]) -> String {
    let mut pairs = vec![(90, vertices.len() as f64), (70, 1.0)];
    for [x, y, bulge] in vertices {
        pairs.extend([(10, *x), (20, *y), (42, *bulge)]);
    }
    entity("LWPOLYLINE", layer, &pairs)
}

fn polygon(layer: &str, points: &[[f64; 2]]) -> String {
    bulged(layer, &points.iter().map(|[x, y]| [*x, *y, 0.0]).collect::<Vec<_>>())
}

fn square(layer: &str, [x, y]: [f64; 2], side: f64) -> String {
    polygon(layer, &[[x, y], [x + side, y], [x + side, y + side], [x, y + side]])
}

fn spline(layer: &str, degree: f64, knots: &[f64], points: &[[f64; 3]]) -> String {
    let counts = [(72, knots.len() as f64), (73, points.len() as f64), (74, 0.0)];
    let mut pairs = vec![(70, 4.0), (71, degree)];
    pairs.extend(counts);
    pairs.extend(knots.iter().map(|k| (40, *k)));
    pairs.extend(points.iter().map(|p| (41, p[2])));
    pairs.extend(points.iter().flat_map(|p| [(10, p[0]), (20, p[1]), (30, 0.0)]));
    entity("SPLINE", layer, &pairs)
}

/// A quarter of a circle about the origin as a spline, from the x axis to the y axis, exact.
fn quarter(radius: f64) -> String {
    let weight = 0.5_f64.sqrt();
    let points = [[radius, 0.0, 1.0], [radius, radius, weight], [0.0, radius, 1.0]];
    spline("0", 2.0, &[0.0, 0.0, 0.0, 1.0, 1.0, 1.0], &points)
}

fn read_outline(text: &str) -> Result<Outline, Error> {
    of_layers(text, None)
}

fn of_layers(text: &str, layers: Option<&[&str]>) -> Result<Outline, Error> {
    let layers = layers.map(|names| names.iter().map(|name| (*name).to_owned()).collect());
    drawn(text, &Options { layers, ..Options::new(TOLERANCE) }).map(|drawn| drawn.outline)
}

fn drawn(text: &str, options: &Options) -> Result<Drawn, Error> {
    read_dxf("ply.dxf", text.as_bytes(), options)
}

/// What a drawing is refused with, and what to do about it.
fn refused(text: &str) -> (String, String) {
    let error = read_outline(text).unwrap_err();
    (error.to_string(), error.help().into())
}

/// Distances of the corners and of the middles of lines from a circle about the origin, least and largest.
fn off_circle(outline: &Outline, radius: f64) -> [f64; 2] {
    let middles = outline.lines().map(|[a, b]| [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])]);
    let corners = outline.lines().map(|[a, _]| a);
    let off = corners.chain(middles).map(|p| p[0].hypot(p[1]) - radius);
    off.fold([f64::INFINITY, f64::NEG_INFINITY], |b, d| [b[0].min(d), b[1].max(d)])
}

/// The area of a regular polygon of n corners on a circle is n/2 R² sin(2π/n); its lines are 1 − cos(π/n) of R from the circle.
#[test]
fn a_circle_is_the_polygon_with_the_fewest_lines_within_the_tolerance() {
    let outline = read_outline(&millimeters(&circle("0", [30.0, -20.0], 100.0))).unwrap();
    let lines = outline.boundary().len() as f64;
    assert!((outline.area() - 0.5 * lines * 0.01 * (2.0 * PI / lines).sin()).abs() < 1e-15);
    let off = |lines: f64| 0.1 * (1.0 - (PI / lines).cos());
    assert!(off(lines) <= TOLERANCE && off(lines - 1.0) > TOLERANCE);
}

/// A semicircle has the bulge 1; the two of a disc bulge outwards, or the one goes back inside the other.
#[test]
fn a_bulge_is_an_arc_to_the_side_of_its_sign() {
    let disc =
        read_outline(&millimeters(&bulged("0", &[[-50.0, 0.0, 1.0], [50.0, 0.0, 1.0]]))).unwrap();
    let [least, most] = off_circle(&disc, 0.05);
    assert!(least >= -TOLERANCE && most < 1e-15, "{least} {most}");
    // from the right to the left along the upper half is counterclockwise; back over a flatter arc below it
    let moon =
        read_outline(&millimeters(&bulged("0", &[[50.0, 0.0, 1.0], [-50.0, 0.0, -0.5]]))).unwrap();
    // circular segments by their angle θ = 4 atan(bulge) and radius c / (2 sin(θ/2))
    let segment = |bulge: f64| {
        let angle = 4.0 * bulge.atan();
        let radius = 0.05 / (0.5 * angle).sin();
        0.5 * radius * radius * (angle - angle.sin())
    };
    let expected = segment(1.0) - segment(0.5);
    // each line may be a tolerance away
    assert!((moon.area() - expected).abs() < 0.3 * TOLERANCE, "{} {expected}", moon.area());
    assert!(moon.bounds()[0][1] > -1e-12);
}

/// However flat a bulge is, it rises by half of its chord times the bulge: also where its center is a light year away.
#[test]
fn an_almost_straight_bulge_keeps_its_rise() {
    for bulge in [1e-3, 1e-6, 1e-10, 1e-15] {
        let limit = flatten::Limit { tolerance: 1e-4 * bulge, points: 1000 };
        let points = flatten::bulge([0.0, 0.0], [2.0, 0.0], bulge, limit).unwrap();
        let lowest = points.iter().map(|p| p[1]).fold(0.0, f64::min);
        assert!((lowest / -bulge - 1.0).abs() < 2e-4, "{bulge}: {lowest}");
    }
}

/// Three control points and the weight √½ are a quarter of a circle, exactly (Piegl and Tiller, The NURBS Book, 1997, ch. 7).
#[test]
fn a_rational_spline_lies_on_its_circle() {
    let text = quarter(100.0)
        + &line("0", [0.0, 100.0], [0.0, 0.0])
        + &line("0", [100.0, 0.0], [0.0, 0.0]);
    let outline = read_outline(&millimeters(&text)).unwrap();
    let arc: Vec<f64> = outline
        .boundary()
        .iter()
        .filter(|p| p[0].hypot(p[1]) > 1e-6)
        .map(|p| p[0].hypot(p[1]) - 0.1)
        .collect();
    assert!(arc.len() > 10 && arc.iter().all(|off| off.abs() < 1e-15));
    let expected = PI * 0.01 / 4.0;
    assert!((outline.area() - expected).abs() < 0.05 * PI * TOLERANCE);
}

/// A cubic with control points that a straight line of it has too: knots inside, none of them at an end of the curve.
#[test]
fn a_spline_without_knots_at_its_ends_covers_its_middle_spans_alone() {
    let knots: Vec<f64> = (0..9).map(f64::from).collect();
    let points = [[0.0, 0.0], [1.0, 1.0], [2.0, 4.0], [3.0, 9.0], [4.0, 16.0]];
    let spline = flatten::Nurbs::new(3, knots, &points, &[]).unwrap();
    let points = spline.flatten(flatten::Limit { tolerance: 1e-6, points: 100_000 }).unwrap();
    // the points (i, i²) at Greville abscissae make (t, t² + 1/3) of the uniform cubic, at t from 1 to 3
    let (first, last) = (points[0], points[points.len() - 1]);
    for (found, t) in [(first, 1.0), (last, 3.0)] {
        assert!((found[0] - t).abs() < 1e-12 && (found[1] - t * t - 1.0 / 3.0).abs() < 1e-12);
    }
    assert!(points.iter().all(|[x, y]| (y - x * x - 1.0 / 3.0).abs() < 1e-12));
}

/// π a b, and the same turned, mirrored and as a part of it.
#[test]
fn an_ellipse_has_its_area_whole_and_in_part() {
    let pairs = |start: f64, end: f64| {
        [(10, 5.0), (20, 7.0), (11, 60.0), (21, 80.0), (40, 0.3), (41, start), (42, end)]
    };
    let whole = read_outline(&millimeters(&entity("ELLIPSE", "0", &pairs(0.0, 2.0 * PI)))).unwrap();
    let expected = PI * 0.1 * 0.03;
    // an ellipse of this size is 0.45 m around
    assert!((whole.area() - expected).abs() < 0.45 * TOLERANCE);
    for (normal, side) in [(1.0, 1.0), (-1.0, -1.0)] {
        let mut half = pairs(0.0, PI).to_vec();
        half.push((230, normal));
        let chord = line("0", [65.0, 87.0], [-55.0, -73.0]);
        let half = read_outline(&millimeters(&(entity("ELLIPSE", "0", &half) + &chord))).unwrap();
        assert!((half.area() - 0.5 * expected).abs() < 0.45 * TOLERANCE);
        // the half to the left of the major axis, or to its right
        let left = |p: &[f64; 2]| (0.6 * (p[1] - 0.007) - 0.8 * (p[0] - 0.005)) * side;
        assert!(half.boundary().iter().all(|p| left(p) > -1e-9));
    }
}

/// A slot of width 40 and length 100 between the middles of its round ends (mm), in the ways it can be drawn.
fn slots() -> Vec<String> {
    let bulge = bulged(
        "0",
        &[[0.0, -20.0, 0.0], [100.0, -20.0, 1.0], [100.0, 20.0, 0.0], [0.0, 20.0, 1.0]],
    );
    let parts = [
        line("0", [100.0, 20.0], [0.0, 20.0]),
        arc("0", [0.0, 0.0], 20.0, 90.0, 270.0),
        line("0", [100.0, -20.0], [0.0, -20.0]),
        arc("0", [100.0, 0.0], 20.0, -90.0, 90.0),
    ];
    let w = 0.5_f64.sqrt();
    let end = |x: f64, out: f64| {
        let points = [
            [x, -20.0, 1.0],
            [x + out, -20.0, w],
            [x + out, 0.0, 1.0],
            [x + out, 20.0, w],
            [x, 20.0, 1.0],
        ];
        spline("0", 2.0, &[0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 2.0], &points)
    };
    let vertex =
        |x: f64, y: f64, bulge: f64| entity("VERTEX", "0", &[(10, x), (20, y), (42, bulge)]);
    let old = entity("POLYLINE", "0", &[(66, 1.0), (70, 1.0)])
        + &vertex(0.0, -20.0, 0.0)
        + &vertex(100.0, -20.0, 1.0)
        + &vertex(100.0, 20.0, 0.0)
        + &vertex(0.0, 20.0, 1.0)
        + &entity("SEQEND", "0", &[]);
    let mut all = vec![bulge, old, parts.concat()];
    all.push([3, 1, 0, 2].map(|n| parts[n].as_str()).concat());
    all.push(parts[2].clone() + &end(0.0, -20.0) + &end(100.0, 20.0) + &parts[0]);
    all
}

/// However it is drawn, its area is 100 × 40 + π 20² mm², and its bounds are the same.
#[test]
fn a_shape_is_the_same_however_it_is_drawn() {
    let expected = 0.1 * 0.04 + PI * 0.02 * 0.02;
    for (n, text) in slots().into_iter().enumerate() {
        let outline =
            read_outline(&millimeters(&text)).unwrap_or_else(|error| panic!("{n}: {error}"));
        let around = 0.2 + 0.04 * PI;
        assert!((outline.area() - expected).abs() < around * TOLERANCE, "{n}: {}", outline.area());
        for (found, due) in outline.bounds().iter().flatten().zip([-0.02, -0.02, 0.12, 0.02]) {
            assert!((found - due).abs() <= TOLERANCE, "{n}: {found} {due}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    /// A polygon that is cut into lines is put together again, whatever their order and senses.
    #[test]
    fn lines_in_any_order_and_sense_are_joined(
        radii in prop::collection::vec(50.0..100.0f64, 3..40), seed: u64,
    ) {
        let count = radii.len();
        let point = |n: usize| {
            let (sin, cos) = (2.0 * PI * (n % count) as f64 / count as f64).sin_cos();
            [radii[n % count] * cos, radii[n % count] * sin]
        };
        let points: Vec<[f64; 2]> = (0..count).map(point).collect();
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by_key(|n| (*n as u64 + 1).wrapping_mul(seed | 1));
        let lines = order.iter().map(|n| {
            let (a, b) = (point(*n), point(n + 1));
            if (seed >> (n % 64)) & 1 == 0 { line("0", a, b) } else { line("0", b, a) }
        });
        let joined = read_outline(&millimeters(&lines.collect::<String>())).unwrap();
        let whole = read_outline(&millimeters(&polygon("0", &points))).unwrap();
        prop_assert_eq!(joined.boundary().len(), count);
        prop_assert!((joined.area() - whole.area()).abs() < 1e-15);
    }

    /// Whatever a DXF text says of a few entities, it is an outline or refused.
    #[test]
    fn numbers_of_every_size_are_read_or_refused(
        values in prop::collection::vec(prop::num::f64::ANY, 12), bulge in prop::num::f64::ANY,
    ) {
        let v = &values;
        for text in [
            bulged("0", &[[v[0], v[1], bulge], [v[2], v[3], v[4]], [v[5], v[6], v[7]]]),
            circle("0", [v[0], v[1]], v[2]),
            arc("0", [v[0], v[1]], v[2], v[3], v[4]),
            spline("0", 2.0, &[0.0, 0.0, 0.0, v[9], v[10], v[11]], &[[v[0], v[1], v[2]], [v[3], v[4], v[5]], [v[6], v[7], v[8]]]),
            entity("ELLIPSE", "0", &[(10, v[0]), (11, v[1]), (21, v[2]), (40, v[3]), (41, v[4]), (42, v[5])]),
        ] {
            let _ = read_outline(&millimeters(&text));
        }
    }
}

/// Of the two rings inside, one is a circle; they are on layers of their own.
#[test]
fn closed_lines_inside_the_largest_are_holes() {
    let text = circle("HOLE", [30.0, 30.0], 10.0)
        + &square("CUT", [0.0, 0.0], 200.0)
        + &square("HOLE", [100.0, 100.0], 20.0);
    let outline = of_layers(&millimeters(&text), Some(&["CUT", "HOLE"])).unwrap();
    assert_eq!(outline.holes().len(), 2);
    let expected = 0.04 - 0.0004 - PI * 1e-4;
    assert!((outline.area() - expected).abs() < 0.07 * TOLERANCE);
    assert_eq!(of_layers(&millimeters(&text), Some(&["cut"])).unwrap().holes().len(), 0);
}

/// A hole of 0.02 mm is seen by a cutter, even if curves are followed to 1 mm.
#[test]
fn a_hole_smaller_than_the_tolerance_stays_a_hole() {
    let text = square("0", [0.0, 0.0], 200.0) + &circle("0", [30.0, 30.0], 0.01);
    let options = Options::new(1e-3);
    let outline = drawn(&millimeters(&text), &options).unwrap().outline;
    assert_eq!(outline.holes()[0].len(), 8);
}

#[test]
fn every_unit_of_the_header_is_that_length() {
    for (unit, meters) in
        [(1, 0.0254), (2, 0.3048), (4, 1e-3), (5, 1e-2), (6, 1.0), (10, 0.9144), (14, 0.1)]
    {
        let outline = read_outline(&drawing(unit, &square("0", [0.0, 0.0], 1.0))).unwrap();
        assert!((outline.area() - meters * meters).abs() < 1e-15, "{unit}");
    }
}

#[test]
fn a_drawing_without_a_unit_asks_for_one() {
    let text = drawing(0, &square("0", [0.0, 0.0], 1.0));
    let (message, remedy) = refused(&text);
    assert_eq!(message, "ply.dxf: its header gives no unit of length ($INSUNITS)");
    assert_eq!(remedy, "state the unit of the drawing, as in unit = \"mm\"");
    let options = Options { unit: Some(0.01), ..Options::new(TOLERANCE) };
    assert!((drawn(&text, &options).unwrap().outline.area() - 1e-4).abs() < 1e-15);
}

#[test]
fn an_open_line_is_refused_with_the_place_and_width_of_its_gap() {
    let text = line("CUT", [0.0, 0.0], [100.0, 0.0])
        + &line("CUT", [100.0, 0.3], [100.0, 80.0])
        + &line("CUT", [100.0, 80.0], [0.0, 0.0]);
    let (message, remedy) = refused(&millimeters(&text));
    assert_eq!(
        message,
        "ply.dxf: LINE on layer `CUT` at (100.000, 0.000) mm is not closed: it ends 0.300 mm from the nearest other open end, which is at (100.000, 0.300) mm"
    );
    assert!(remedy.contains("join the ends"));
    // rounding of the sixth digit is no gap
    let rounded = text.replace("0.3\n", "0.0003\n");
    assert!(read_outline(&millimeters(&rounded)).is_ok());
}

#[test]
fn a_line_that_is_drawn_twice_is_refused_with_its_place() {
    let sides = line("0", [0.0, 0.0], [100.0, 0.0])
        + &line("0", [100.0, 0.0], [100.0, 80.0])
        + &line("0", [100.0, 80.0], [0.0, 0.0]);
    let twice = sides + &line("0", [100.0, 0.0], [0.0, 0.0]);
    let (message, remedy) = refused(&millimeters(&twice));
    assert!(message.contains("3 curves end at (0.000, 0.000) mm"), "{message}");
    assert!(remedy.contains("drawn twice"));
}

#[test]
fn a_line_that_crosses_itself_is_refused_with_the_place() {
    let bow =
        polygon("0", &[[0.0, 0.0], [100.0, 100.0], [100.0, 0.0], [0.0, 100.0], [-50.0, 50.0]]);
    let (message, _) = refused(&millimeters(&bow));
    assert!(message.contains("(50.000, 50.000) mm"), "{message}");
}

/// A line to trim after the cure, inside the line to cut, is no hole: nobody but the one who has drawn it knows that.
#[test]
fn closed_lines_on_several_layers_ask_for_the_layers_of_the_ply() {
    let trim = polygon("EOP", &[[70.0, 70.0], [390.0, 70.0], [390.0, 290.0], [70.0, 290.0]]);
    let cut = polygon("MEOP", &[[0.0, 0.0], [460.0, 0.0], [460.0, 360.0], [0.0, 360.0]]);
    let text = trim + &cut + &square("EOP", [20.0, 20.0], 10.0);
    let (message, remedy) = refused(&millimeters(&text));
    assert_eq!(
        message,
        "ply.dxf: its closed lines are on several layers, and none is named: `MEOP` has one of 460 × 360 mm, `EOP` has 2 of 10 × 10 mm to 320 × 220 mm"
    );
    assert!(remedy.ends_with("outline = { file = \"ply.dxf\", layers = [\"MEOP\"] }"), "{remedy}");
    let options = |layers: &[&str]| {
        let layers = Some(layers.iter().map(ToString::to_string).collect());
        Options { layers, ..Options::new(TOLERANCE) }
    };
    let cut = drawn(&millimeters(&text), &options(&["MEOP"])).unwrap();
    assert_eq!((cut.boundary.layers, cut.holes.len()), (vec!["MEOP".to_owned()], 0));
    let both = drawn(&millimeters(&text), &options(&["MEOP", "EOP"])).unwrap();
    assert_eq!(both.holes.len(), 2);
    assert!(both.holes.iter().all(|hole| hole.layers == ["EOP"] && hole.block.is_none()));
    // of two plies on layers of their own it is the same question
    let two = square("PLY_1", [0.0, 0.0], 100.0) + &square("PLY_2", [200.0, 0.0], 50.0);
    assert!(refused(&millimeters(&two)).0.contains("`PLY_2` has one of 50 × 50 mm"));
    let chosen = of_layers(&millimeters(&two), Some(&["ply_2"])).unwrap();
    assert!((chosen.area() - 0.0025).abs() < 1e-15);
}

/// One closed line of curves on two layers is one line, and nothing is to be asked.
#[test]
fn a_closed_line_of_two_layers_is_one_line() {
    let text = line("A", [0.0, 0.0], [100.0, 0.0])
        + &line("B", [100.0, 0.0], [100.0, 80.0])
        + &line("A", [100.0, 80.0], [0.0, 0.0]);
    let found = drawn(&millimeters(&text), &Options::new(TOLERANCE)).unwrap();
    assert_eq!(found.boundary.layers, ["A", "B"]);
}

/// A closed line that is drawn twice would be a hole as large as its ply.
#[test]
fn a_closed_line_that_is_drawn_twice_is_refused() {
    let text = square("0", [0.0, 0.0], 100.0) + &square("0", [0.0, 0.0], 100.0);
    let (message, remedy) = refused(&millimeters(&text));
    assert!(message.contains("a closed line is drawn twice"), "{message}");
    assert!(remedy.contains("remove one of the two"), "{remedy}");
}

/// The four sides of a rectangle whose ends are so far apart (mm).
fn with_gaps(gaps: [f64; 4]) -> String {
    let [a, b, c, d] = gaps;
    let sides = line("0", [0.0, d], [300.0 - a, 0.0])
        + &line("0", [300.0, 0.0], [300.0, 200.0 - b])
        + &line("0", [300.0, 200.0], [c, 200.0])
        + &line("0", [0.0, 200.0], [0.0, 0.0]);
    millimeters(&sides)
}

#[test]
fn ends_join_over_gaps_up_to_the_tolerance_and_the_gaps_are_told() {
    let options = Options::new(1e-4);
    let found = drawn(&with_gaps([0.005, 0.09, 0.0, 0.0]), &options).unwrap();
    assert_eq!(found.gaps.len(), 2);
    for (gap, due) in found.gaps.iter().zip([9e-5, 5e-6]) {
        assert!((gap - due).abs() < 1e-12, "{gap} {due}");
    }
    assert_eq!(found.outline.boundary().len(), 4);
    // a gap of d at a corner takes half of a triangle of base d and height 300 or 200
    assert!((found.outline.area() - 0.06).abs() < 0.5 * 1e-4 * 0.3);
    assert!(drawn(&with_gaps([0.0; 4]), &options).unwrap().gaps.is_empty());
    // a wider one is refused, and the tolerance that is proposed closes it
    let wide = with_gaps([0.0, 0.0, 0.17, 0.0]);
    let refused = drawn(&wide, &options).unwrap_err();
    assert!(refused.to_string().contains("ends 0.170 mm from"), "{refused}");
    let proposed = "outline = { file = \"ply.dxf\", tolerance = \"0.18 mm\" }";
    assert!(refused.help().contains(proposed), "{}", refused.help());
    assert_eq!(drawn(&wide, &Options::new(1.8e-4)).unwrap().gaps.len(), 1);
    // one of some millimeters is another fault
    let far = drawn(&with_gaps([5.0, 0.0, 0.0, 0.0]), &options).unwrap_err();
    assert!(!far.help().contains("tolerance"), "{}", far.help());
}

/// Sides that go on beyond a corner, or that end before it, and short lines on the way: each end joins the nearest one.
#[test]
fn gaps_and_overlaps_close_without_crossings() {
    let sides = line("0", [0.0, 0.0], [300.05, 0.0])
        + &line("0", [300.0, -0.05], [300.0, 200.0])
        + &line("0", [300.0, 200.0], [150.0, 200.03])
        + &line("0", [149.98, 200.0], [149.9, 200.0])
        + &line("0", [149.88, 200.0], [0.0, 200.0])
        + &line("0", [0.0, 200.06], [0.0, 0.0]);
    let found = drawn(&millimeters(&sides), &Options::new(1e-4)).unwrap();
    assert_eq!(found.gaps.len(), 4);
    assert!((found.outline.area() - 0.06).abs() < 1e-4 * 0.5);
}

/// Sides of 0.02 mm, as exploded splines have them, are no gaps although they are shorter than the tolerance.
#[test]
fn lines_shorter_than_the_tolerance_are_joined_by_their_ends() {
    let count = 3000;
    let point = |n: usize| {
        let (sin, cos) = (2.0 * PI * (n % count) as f64 / count as f64).sin_cos();
        [10.0 * cos, 10.0 * sin]
    };
    let sides: String = (0..count).map(|n| line("0", point(n), point(n + 1))).collect();
    let found = drawn(&millimeters(&sides), &Options::new(1e-4)).unwrap();
    assert_eq!((found.outline.boundary().len(), found.gaps.len()), (count, 0));
}

/// A text at a place, on any layer.
fn text(kind: &str, words: &str, at: [f64; 2]) -> String {
    entity(kind, "NOTES", &[(10, at[0]), (20, at[1])]) + &format!("1\n{words}\n")
}

/// A drawing that places blocks of entities at some points.
fn blocks(places: &[(&str, &str, [f64; 2])]) -> String {
    let mut text = "0\nSECTION\n2\nBLOCKS\n".to_owned();
    let mut known: Vec<&str> = Vec::new();
    let mut inserts = String::new();
    for (name, entities, at) in places {
        if !known.contains(name) {
            known.push(name);
            let _ = write!(text, "0\nBLOCK\n8\n0\n2\n{name}\n{entities}0\nENDBLK\n");
        }
        let insert = entity("INSERT", "1", &[(10, at[0]), (20, at[1])]);
        inserts += &insert.replacen("8\n1\n", &format!("8\n1\n2\n{name}\n"), 1);
    }
    text += "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    millimeters(&inserts).replace("0\nSECTION\n2\nENTITIES\n", &text)
}

fn piece(text: &str, piece: Piece) -> Result<Drawn, Error> {
    let layers = Some(vec!["1".to_owned()]);
    drawn(text, &Options { layers, piece: Some(piece), ..Options::new(TOLERANCE) })
}

/// The pieces that a refusal lists, as a scene would have them.
fn listed_pieces(help: &str) -> Vec<Piece> {
    let chosen = |key: &str| -> Piece {
        let table: toml::Table = key.parse().unwrap_or_else(|error| panic!("{key}: {error}"));
        let (kind, value) = table["piece"].as_table().unwrap().iter().next().unwrap();
        match (kind.as_str(), value) {
            ("label", value) => Piece::Label(value.as_str().unwrap().into()),
            ("block", value) => Piece::Block(value.as_str().unwrap().into()),
            (_, value) => {
                let mm = |value: &toml::Value| {
                    value.as_str().unwrap().trim_end_matches(" mm").parse::<f64>().unwrap() * 1e-3
                };
                let [x, y] = &value.as_array().unwrap()[..] else { panic!("{value:?}") };
                Piece::Point([mm(x), mm(y)])
            }
        }
    };
    let keys = help.split("piece = ").skip(1);
    keys.map(|rest| {
        chosen(&format!("piece = {}", rest.split_once('}').unwrap().0.to_owned() + "}"))
    })
    .collect()
}

/// Two pieces on one layer with the line of the grain on another one, as cutters' files have them. Each key that the refusal
/// lists chooses a piece of its own.
#[test]
fn a_piece_of_a_nest_is_chosen_by_a_key_that_the_refusal_lists() {
    let small =
        |x: f64| polygon("1", &[[x, 0.0], [x + 300.0, 0.0], [x + 300.0, 200.0], [x, 100.0]]);
    let nest = |more: &str| {
        let grain = line("7", [50.0, 60.0], [250.0, 60.0]);
        millimeters(&(square("1", [0.0, 0.0], 300.0) + &small(400.0) + &grain + more))
    };
    let labels = text("TEXT", "Left", [10.0, 10.0])
        + &text("MTEXT", "{\\fArial|b0;Right}\\P2 pieces", [600.0, 20.0])
        + &circle("1", [500.0, 60.0], 10.0);
    for (more, label) in [("", None), (labels.as_str(), Some("right"))] {
        let text = nest(more);
        let options = Options { layers: Some(vec!["1".into()]), ..Options::new(TOLERANCE) };
        let refused = drawn(&text, &options).unwrap_err();
        assert!(refused.to_string().contains("two outlines"), "{refused}");
        let keys = listed_pieces(refused.help());
        assert_eq!(keys.len(), 2, "{}", refused.help());
        let sizes: Vec<f64> =
            keys.into_iter().map(|key| piece(&text, key).unwrap().outline.area()).collect();
        let hole = if label.is_some() { PI * 1e-4 } else { 0.0 };
        assert!((sizes[0] - 0.09).abs() < 1e-12);
        assert!((sizes[1] - (0.045 - hole)).abs() < 0.07 * TOLERANCE, "{sizes:?}");
        assert_eq!(refused.help().contains("label = \"Left\""), label.is_some());
        if let Some(label) = label {
            let chosen = piece(&text, Piece::Label(label.into())).unwrap();
            assert_eq!(chosen.outline.holes().len(), 1);
            assert!(piece(&text, Piece::Label("2  PIECES".into())).is_ok());
        }
        let off = piece(&text, Piece::Point([0.35, 0.1])).unwrap_err();
        assert!(off.to_string().contains("no closed line around the point (350, 100) mm"), "{off}");
        assert_eq!(listed_pieces(off.help()).len(), 2);
    }
}

/// Blocks at one place lie over one another; each is a piece with its own holes, and none is the hole of another one.
#[test]
fn blocks_are_pieces_of_their_own_wherever_they_are_placed() {
    let front = square("1", [0.0, 0.0], 300.0)
        + &circle("1", [250.0, 250.0], 10.0)
        + &line("7", [50.0, 60.0], [250.0, 60.0])
        + &text("TEXT", "Piece Name: FRONT", [400.0, 0.0]);
    let collar = square("1", [20.0, 20.0], 100.0) + &text("TEXT", "COLLAR", [30.0, 30.0]);
    for at in [[0.0, 0.0], [500.0, 0.0]] {
        let text = blocks(&[("P1", &front, [0.0, 0.0]), ("P2", &collar, at)]);
        let options = Options { layers: Some(vec!["1".into()]), ..Options::new(TOLERANCE) };
        let refused = drawn(&text, &options).unwrap_err();
        assert!(refused.help().contains("block = \"P1\""), "{}", refused.help());
        for key in listed_pieces(refused.help()) {
            assert!(piece(&text, key).is_ok());
        }
        for key in [Piece::Block("p1".into()), Piece::Label("piece name: front".into())] {
            let front = piece(&text, key).unwrap();
            assert_eq!(front.outline.holes().len(), 1);
            assert!((front.outline.area() - 0.09 + PI * 1e-4).abs() < 0.07 * TOLERANCE);
            assert_eq!(front.boundary.block.as_deref(), Some("P1"));
        }
        for key in [Piece::Block("P2".into()), Piece::Label("collar".into())] {
            assert!((piece(&text, key).unwrap().outline.area() - 0.01).abs() < 1e-12);
        }
    }
    // a block that is placed twice is two pieces, which points tell apart
    let text = blocks(&[("P2", &collar, [0.0, 0.0]), ("P2", &collar, [500.0, 0.0])]);
    let twice = piece(&text, Piece::Block("P2".into())).unwrap_err();
    assert!(twice.to_string().contains("2 pieces are of the block \"P2\""), "{twice}");
    let keys = listed_pieces(twice.help());
    assert!(keys.iter().all(|key| matches!(key, Piece::Point(_))) && keys.len() == 2);
    assert!(keys.into_iter().all(|key| piece(&text, key).is_ok()));
    let absent = piece(&text, Piece::Block("P3".into())).unwrap_err();
    assert!(absent.help().contains("`P2`"), "{}", absent.help());
}

/// An attribute follows its block in the drawing, so it is of that block wherever it lies.
#[test]
fn an_attribute_of_a_block_is_a_label() {
    let shape = square("1", [0.0, 0.0], 100.0);
    let placed = blocks(&[("P", &shape, [0.0, 0.0]), ("P", &shape, [200.0, 0.0])]);
    let named = |name: &str, x: f64| {
        let attribute = entity("ATTRIB", "0", &[(10, x), (20, 50.0)]) + &format!("1\n{name}\n");
        attribute + &entity("SEQEND", "0", &[])
    };
    let text = placed.replace(
        "0\nENDSEC\n0\nEOF\n",
        &format!("{}{}0\nENDSEC\n0\nEOF\n", named("A-1", 50.0), named("A-2", 250.0)),
    );
    let found = piece(&text, Piece::Label("a-2".into())).unwrap();
    assert!((found.outline.bounds()[0][0] - 0.2).abs() < 1e-12);
    // two blocks over one another, each with its attribute at the same place
    let small = square("1", [10.0, 10.0], 60.0);
    let both = blocks(&[("P", &shape, [0.0, 0.0]), ("Q", &small, [0.0, 0.0])]);
    let at = both.rfind("0\nINSERT").unwrap();
    let end = both.rfind("0\nENDSEC").unwrap();
    let text = both[..at].to_owned()
        + &named("A-1", 30.0)
        + &both[at..end]
        + &named("A-2", 30.0)
        + &both[end..];
    for (label, area) in [("A-1", 0.01), ("A-2", 0.0036)] {
        let found = piece(&text, Piece::Label(label.into())).unwrap();
        assert!((found.outline.area() - area).abs() < 1e-12, "{label}");
    }
}

/// A piece within a hole of another one is a piece, and a fault of another piece is no matter of the one that is chosen.
#[test]
fn a_piece_is_chosen_whatever_lies_beside_or_around_it() {
    let text = millimeters(
        &(square("1", [0.0, 0.0], 300.0)
            + &square("1", [50.0, 50.0], 200.0)
            + &square("1", [100.0, 100.0], 50.0)
            + &line("1", [400.0, 0.0], [500.0, 0.0])),
    );
    let small = piece(&text, Piece::Point([0.12, 0.12])).unwrap();
    assert!((small.outline.area() - 0.0025).abs() < 1e-12);
    let ring = piece(&text, Piece::Point([0.02, 0.02])).unwrap();
    assert!((ring.outline.area() - 0.05).abs() < 1e-12);
    let inside = text.replace("10\n400.0\n20\n0.0\n", "10\n110.0\n20\n110.0\n");
    assert!(piece(&inside, Piece::Point([0.14, 0.14])).is_err());
}

/// What is no curve may have been meant as a hole: the drawing says how much of it there is, on the layers that are read.
#[test]
fn entities_that_are_no_curves_are_counted_by_their_types() {
    let hatch = |layer: &str| format!("0\nHATCH\n8\n{layer}\n70\n1\n");
    let entities = square("CUT", [0.0, 0.0], 100.0)
        + &hatch("CUT")
        + &hatch("CUT")
        + &hatch("OTHER")
        + "0\nREGION\n8\nCUT\n1\nxyz\n"
        + &text("TEXT", "ply", [1.0, 1.0]).replace("NOTES", "CUT");
    let options = Options { layers: Some(vec!["CUT".into()]), ..Options::new(TOLERANCE) };
    let found = drawn(&millimeters(&entities), &options).unwrap().skipped;
    let found: Vec<(&str, usize)> = found.iter().map(|(kind, n)| (kind.as_str(), *n)).collect();
    assert_eq!(found, [("HATCH", 2), ("REGION", 1), ("TEXT", 1)]);
    let none = refused(&millimeters(&hatch("CUT"))).0;
    assert!(none.contains("1 HATCH"), "{none}");
}

#[test]
fn a_layer_that_is_absent_or_empty_is_refused_with_those_there_are() {
    let text = millimeters(&(square("CUT", [0.0, 0.0], 100.0) + &entity("TEXT", "NOTE", &[])));
    let absent = of_layers(&text, Some(&["CUTS"])).unwrap_err();
    assert_eq!(absent.to_string(), "ply.dxf: there is no layer `CUTS`");
    assert_eq!(absent.help(), "layers are `CUT`, `NOTE`");
    let inner = square("CUT", [0.0, 0.0], 100.0) + &entity("LWPOLYLINE", "NOTE", &[(90, 0.0)]);
    let empty = of_layers(&millimeters(&inner), Some(&["NOTE"])).unwrap_err();
    assert_eq!(empty.to_string(), "ply.dxf: it has no lines or curves on layer `NOTE`");
    assert_eq!(empty.help(), "layers with lines or curves are `CUT`");
}

/// A ply of 3 mm in a drawing whose unit was thought to be 1 µm.
#[test]
fn a_tiny_outline_is_refused_with_its_size() {
    let (message, remedy) = refused(&drawing(13, &square("0", [0.0, 0.0], 3.0)));
    assert!(message.contains("0.0030 mm by 0.0030 mm"), "{message}");
    assert_eq!(remedy, "is the unit of the drawing right?");
}

/// A table of layers, each with flags and color.
fn with_layers(layers: &[(&str, i32, i32)], entities: &str) -> String {
    let mut table = "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n70\n9\n".to_owned();
    for (name, flags, color) in layers {
        let _ = write!(table, "0\nLAYER\n2\n{name}\n70\n{flags}\n62\n{color}\n6\nCONTINUOUS\n");
    }
    table += "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
    millimeters(entities).replace("0\nSECTION\n2\nENTITIES\n", &table)
}

#[test]
fn layers_that_are_off_or_frozen_are_read_only_if_they_are_asked_for() {
    let entities = square("CUT", [0.0, 0.0], 100.0)
        + &square("OFF", [10.0, 10.0], 10.0)
        + &square("FROZEN", [40.0, 40.0], 10.0);
    let text = with_layers(&[("CUT", 0, 7), ("OFF", 0, -7), ("FROZEN", 1, 7)], &entities);
    assert_eq!(read_outline(&text).unwrap().holes().len(), 0);
    let asked = of_layers(&text, Some(&["CUT", "OFF", "FROZEN"])).unwrap();
    assert_eq!(asked.holes().len(), 2);
    let shown = with_layers(&[("CUT", 0, 7), ("OFF", 0, 7), ("FROZEN", 0, 7)], &entities);
    assert!(refused(&shown).0.contains("`OFF` has one of 10 × 10 mm"));
}

/// A block of a unit square about its base point, placed by an INSERT.
fn placed(insert: &[(i32, f64)]) -> String {
    let blocks = format!(
        "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n8\n0\n2\nply\n70\n0\n10\n5.0\n20\n5.0\n30\n0.0\n{}0\nENDBLK\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n",
        square("0", [4.5, 4.5], 1.0) + &circle("0", [5.0, 5.2], 0.1)
    );
    let insert = entity("INSERT", "CUT", insert).replace("8\nCUT\n", "8\nCUT\n2\nPLY\n");
    millimeters(&insert).replace("0\nSECTION\n2\nENTITIES\n", &blocks)
}

/// Scales of 100 and 50 make the block 100 mm by 50 mm and its hole an ellipse; the layer is that of the INSERT.
#[test]
fn a_block_is_drawn_where_it_is_placed() {
    let pairs = [(10, 300.0), (20, 200.0), (41, 100.0), (42, 50.0), (50, 90.0)];
    let text = placed(&pairs);
    let outline = of_layers(&text, Some(&["CUT"])).unwrap();
    for (found, due) in outline.bounds().iter().flatten().zip([0.275, 0.15, 0.325, 0.25]) {
        assert!((found - due).abs() < 1e-12, "{found} {due}");
    }
    let expected = 0.1 * 0.05 - PI * 0.01 * 0.005;
    assert!((outline.area() - expected).abs() < 0.05 * TOLERANCE);
    // the hole was above the middle, and a quarter turn to the left brings it to the left
    let hole =
        outline.holes()[0].iter().map(|p| p[0]).sum::<f64>() / outline.holes()[0].len() as f64;
    assert!((hole - 0.29).abs() < 1e-9);
    // seen from behind, x is −x
    let behind: Vec<(i32, f64)> = pairs.into_iter().chain([(230, -1.0)]).collect();
    let mirrored = read_outline(&placed(&behind)).unwrap();
    assert!((mirrored.bounds()[0][0] + 0.325).abs() < 1e-12);
    // two beside each other are two plies
    let two: Vec<(i32, f64)> = pairs.into_iter().chain([(70, 2.0), (44, 200.0)]).collect();
    assert!(refused(&placed(&two)).0.contains("two outlines"));
}

/// Each block places the next one a hundred times: a thousand bytes would be 10³² lines.
#[test]
fn blocks_within_blocks_are_refused_before_they_grow() {
    let mut blocks = String::new();
    for n in 0..16 {
        let inner = entity("INSERT", "0", &[(70, 10.0), (71, 10.0)]);
        let inner = inner.replace("8\n0\n", &format!("8\n0\n2\nb{}\n", n + 1));
        let _ = write!(blocks, "0\nBLOCK\n8\n0\n2\nb{n}\n{inner}0\nENDBLK\n");
    }
    let _ = write!(blocks, "0\nBLOCK\n8\n0\n2\nb16\n0\nENDBLK\n");
    let first = entity("INSERT", "0", &[]).replace("8\n0\n", "8\n0\n2\nb0\n");
    let blocks = format!("0\nSECTION\n2\nBLOCKS\n{blocks}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n");
    let text = millimeters(&first).replace("0\nSECTION\n2\nENTITIES\n", &blocks);
    let (message, remedy) = refused(&text);
    assert!(message.contains("places more than"), "{message}");
    assert!(remedy.contains("explode"));
    let loops = text.replace("2\nb1\n", "2\nb0\n");
    assert!(refused(&loops).0.contains("places more than"));
}

/// A text in a block of 30 000 rows and columns: a few bytes would be 10⁹ texts.
#[test]
fn a_block_of_texts_in_many_rows_is_refused_before_it_grows() {
    let label = text("TEXT", "A", [0.0, 0.0]);
    let drawing = blocks(&[("P", label.as_str(), [0.0, 0.0])]);
    let rows = drawing.replace("2\nP\n10\n", "2\nP\n70\n30000\n71\n30000\n10\n");
    let (message, remedy) = refused(&rows);
    assert!(message.contains("places more than"), "{message}");
    assert!(remedy.contains("explode"));
}

#[test]
fn curves_that_are_inclined_or_not_flat_are_refused() {
    let tilted = circle("0", [0.0, 0.0], 10.0).replace("40\n", "210\n0.6\n230\n0.8\n40\n");
    assert!(refused(&millimeters(&tilted)).0.contains("is inclined to the drawing"));
    let rising = line("CUT", [0.0, 0.0], [100.0, 0.0]) + "31\n2.5\n";
    let (message, remedy) = refused(&millimeters(&rising));
    assert_eq!(
        message,
        "ply.dxf: LINE on layer `CUT` at (0.000, 0.000) mm is not flat: its z goes from 0.000 to 2.500 mm"
    );
    assert!(remedy.contains("flat"));
}

#[test]
fn a_spline_with_fit_points_alone_is_refused_with_a_remedy() {
    let points: Vec<(i32, f64)> =
        [(71, 3.0), (74, 2.0), (11, 0.0), (21, 0.0), (31, 0.0), (11, 9.0), (21, 9.0), (31, 0.0)]
            .into();
    let (message, remedy) = refused(&millimeters(&entity("SPLINE", "0", &points)));
    assert!(message.contains("has fit points and no control points"), "{message}");
    assert!(remedy.contains("control points"));
}

#[test]
fn a_spline_whose_numbers_do_not_fit_is_refused_with_the_number() {
    let good = [[0.0, 0.0, 1.0], [1.0, 1.0, 1.0], [2.0, 0.0, 1.0]];
    let knots = [0.0, 0.0, 0.0, 1.0, 1.0, 1.0];
    for (degree, knots, points, says) in [
        (0.0, &knots[..], &good[..], "degree is 0"),
        (2.0, &knots[..5], &good[..], "5 knots, expected 6"),
        (2.0, &[0.0, 0.0, 1.0, 0.5, 1.0, 1.0][..], &good[..], "do not grow"),
        (2.0, &[1.0; 6][..], &good[..], "all the same"),
        (
            2.0,
            &knots[..],
            &[[0.0, 0.0, 1.0], [1.0, 1.0, -2.0], [2.0, 0.0, 1.0]][..],
            "weight of -2",
        ),
        (3.0, &knots[..], &good[..], "3 control points, expected 4"),
    ] {
        let (message, _) = refused(&millimeters(&spline("0", degree, knots, points)));
        assert!(message.contains(says), "{message}");
    }
}

#[test]
fn a_circle_that_would_have_too_many_points_is_refused() {
    let options = Options::new(1e-18);
    let text = millimeters(&circle("0", [0.0, 0.0], 1e6));
    let error = read_dxf("ply.dxf", text.as_bytes(), &options).unwrap_err();
    assert!(error.to_string().contains(&format!("more than {MOST_POINTS} points")), "{error}");
    assert_eq!(error.help(), "give a larger tolerance");
}

#[test]
fn what_is_no_dxf_text_is_refused_as_what_it_is() {
    for (bytes, says) in [
        (&b"AutoCAD Binary DXF\r\n\x1a\0"[..], "a binary DXF file, not a DXF text"),
        (b"AC1027\0\0\0", "a DWG file, not a DXF text"),
        (b"", "the file ends at line 1 without its mark EOF"),
        (b"solid ply\nfacet\n", "line 1: found `solid ply`, expected a group code"),
    ] {
        let error = read_dxf("ply.dxf", bytes, &Options::new(TOLERANCE)).unwrap_err();
        assert!(error.to_string().contains(says), "{error}");
    }
    let wrong = millimeters(&circle("0", [0.0, 0.0], 10.0)).replace("40\n10.0", "40\nten");
    let error = read_outline(&wrong).unwrap_err();
    // the line of the file, not of what was kept of it
    let line = wrong.lines().position(|line| line == "ten").unwrap() + 1;
    assert_eq!(error.to_string(), format!("ply.dxf: line {line}: group code 40 cannot be \"ten\""));
}

/// Comments, lines that end as on Windows, extended data, groups of applications and other sections change nothing.
#[test]
fn what_is_no_part_of_an_outline_changes_nothing() {
    let plain = millimeters(&square("0", [0.0, 0.0], 100.0));
    let more = plain
        .replace("90\n4\n", "102\n{ACAD_X\n360\nFF\n102\n}\n90\n4\n1001\nACAD\n1002\n{\n")
        .replace("9\n$INSUNITS", "9\n$TDCREATE\n40\n1e300\n9\n$INSUNITS")
        .replace("0\nENDSEC\n0\nEOF", "0\nHATCH\n70\nx\n0\nENDSEC\n0\nSECTION\n2\nTHUMBNAILIMAGE\n90\n9999999999999\n0\nENDSEC\n0\nEOF");
    let more = format!("999\na comment\n{more}").replace('\n', "\r\n");
    assert_eq!(read_outline(&more).unwrap(), read_outline(&plain).unwrap());
}

/// A group in a group a million deep would take all of the stack.
#[test]
fn groups_within_groups_without_end_are_left_out() {
    let deep = "102\n{A\n".repeat(1_000_000);
    let text = millimeters(&(square("0", [0.0, 0.0], 100.0) + &deep));
    assert!(read_outline(&text).is_ok());
}

/// A damaged drawing is refused or is another drawing; nothing of it is lost without a word.
#[test]
fn a_number_that_is_none_is_refused_with_its_line_wherever_it_is() {
    let text = slots().concat() + &quarter(10.0) + &circle("0", [0.0, 0.0], 3.0);
    let text = millimeters(&text);
    let lines: Vec<&str> = text.lines().collect();
    for n in (1..lines.len()).step_by(2) {
        let code: i32 = lines[n - 1].parse().unwrap();
        if matches!(code, 10..=79 | 90..=99) {
            let mut spoilt = lines.clone();
            spoilt[n] = "1.0.0";
            let error = read_outline(&spoilt.join("\n")).unwrap_err().to_string();
            assert!(
                error.contains(&format!("line {}: group code {code} cannot", n + 1)),
                "{error}"
            );
        }
    }
}

/// Cut after any byte: the mark of the end is missing.
#[test]
fn a_drawing_that_ends_early_is_refused() {
    let text = with_layers(&[("0", 0, 7)], &slots()[2]);
    let whole = text.trim_end().len();
    for end in 0..whole {
        let error = read_outline(&text[..end]).unwrap_err();
        assert!(
            ["without its mark EOF", "expected a group code", "cannot be"]
                .iter()
                .any(|says| error.to_string().contains(says)),
            "{end}: {error}"
        );
    }
    assert!(read_outline(&text[..whole]).is_ok());
}

/// From version 2007 on names are UTF-8; before, letters beyond ASCII are of the code page of Windows.
#[test]
fn layers_have_names_in_letters_of_every_version() {
    let text = millimeters(&square("Größe", [0.0, 0.0], 100.0));
    let text = |version: &str| {
        text.replace("9\n$INSUNITS", &format!("9\n$ACADVER\n1\n{version}\n9\n$INSUNITS"))
    };
    let layers = Some(vec!["GRÖßE".to_owned()]);
    let options = Options { layers, ..Options::new(TOLERANCE) };
    assert!(read_dxf("ply.dxf", text("AC1024").as_bytes(), &options).is_ok());
    let old: Vec<u8> = text("AC1015").chars().map(|c| c as u8).collect();
    assert!(read_dxf("ply.dxf", &old, &options).is_ok());
}

/// Layer 0 of a block is the layer of the INSERT; every other layer is itself.
#[test]
fn what_a_block_holds_on_other_layers_stays_there() {
    let text = placed(&[(41, 100.0), (42, 100.0)]).replacen(
        "LWPOLYLINE\n8\n0\n",
        "LWPOLYLINE\n8\nPLY\n",
        1,
    );
    assert_eq!(of_layers(&text, Some(&["PLY"])).unwrap().holes().len(), 0);
    // the circle alone, on the layer of the INSERT
    let hole = of_layers(&text, Some(&["CUT"])).unwrap();
    assert!((hole.area() - PI * 1e-4).abs() < 0.07 * TOLERANCE);
}
