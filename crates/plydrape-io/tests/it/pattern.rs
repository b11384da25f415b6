//! A flat pattern and a boundary as files; `tests/python/test_pattern.py` reads the same files with other programs.

use insta::assert_binary_snapshot;
use plydrape::ply::Outline;
use plydrape_io::read::outline::{self, Options};
use plydrape_io::write::pattern::{Gripper, Pattern, PatternLine, boundary, dxf, pdf};

/// A ply of 300 mm by 200 mm without a corner, with a hole.
fn ply() -> Outline {
    let boundary = vec![[0.1, 0.0], [0.4, 0.0], [0.4, 0.15], [0.35, 0.2], [0.1, 0.2]];
    let hole = vec![[0.2, 0.1], [0.25, 0.1], [0.225, 0.14]];
    Outline::new(boundary, vec![hole]).unwrap()
}

fn grippers() -> Vec<Gripper> {
    let gripper = |i: usize, j: usize| Gripper {
        name: format!("g{i}_{j}"),
        place: [0.15 + 0.1 * i as f64, 0.05 + 0.1 * j as f64],
        radius: 0.012,
    };
    (0..3).flat_map(|i| (0..2).map(move |j| gripper(i, j))).collect()
}

const TITLE: &str = "Ply 3 – Größe 5 µm ^ (45°)";

/// A square on a slope and an open line.
fn lines() -> Vec<PatternLine> {
    let square = vec![[0.0, 0.0, 0.0], [0.3, 0.0, 0.1], [0.3, 0.3, 0.1], [0.0, 0.3, 1.0 / 3.0]];
    vec![
        PatternLine { name: "ply 3, boundary".into(), points: square, closed: true },
        PatternLine {
            name: "hole".into(),
            points: vec![[0.1, 0.1, 0.0], [0.2, 0.1, 0.0]],
            closed: false,
        },
    ]
}

/// The files that other programs read are what is written today.
#[test]
fn written_files_are_those_that_other_programs_read() {
    let (outline, grippers) = (ply(), grippers());
    let warp = 45_f64.to_radians();
    let pattern = Pattern { title: TITLE, outline: &outline, warp, grippers: &grippers };
    assert_binary_snapshot!("pattern_dxf.dxf", dxf::text(&pattern).into_bytes());
    assert_binary_snapshot!("pattern_pdf.pdf", pdf::bytes(&pattern));
    assert_binary_snapshot!("boundary_dxf.dxf", boundary::dxf(&lines()).into_bytes());
    assert_binary_snapshot!("boundary_csv.csv", boundary::csv(&lines()).unwrap().into_bytes());
    assert_eq!(pdf::bytes(&pattern), pdf::bytes(&pattern));
}

/// What is written for a cutter is the outline again, to a picometer.
#[test]
fn a_pattern_is_read_back_as_its_outline() {
    let (outline, grippers) = (ply(), grippers());
    let pattern = Pattern { title: TITLE, outline: &outline, warp: 0.3, grippers: &grippers };
    let text = dxf::text(&pattern);
    let layers = Some(vec!["CUT".to_owned(), "HOLES".to_owned()]);
    let options = Options { layers, ..Options::new(1e-6) };
    let read = outline::read_dxf("pattern.dxf", text.as_bytes(), &options).unwrap().outline;
    assert_eq!(read.holes().len(), 1);
    for (a, b) in read.lines().zip(outline.lines()) {
        for n in 0..2 {
            assert!((a[0][n] - b[0][n]).abs() < 1e-12);
        }
    }
}

/// The box of the page, in points, that its unit multiplies.
fn page(outline: &Outline) -> (Vec<f64>, f64) {
    let pattern = Pattern { title: "", outline, warp: 0.0, grippers: &[] };
    let bytes = pdf::bytes(&pattern);
    let text = String::from_utf8_lossy(&bytes);
    let after = |key: &str| text.split_once(key).map(|(_, rest)| rest.trim_start());
    let numbers = after("/MediaBox").unwrap().trim_start_matches('[').split_once(']').unwrap().0;
    let numbers = numbers.split_whitespace().map(|n| n.parse().unwrap()).collect();
    let unit = after("/UserUnit")
        .map_or(1.0, |rest| rest.split_whitespace().next().unwrap().parse().unwrap());
    (numbers, unit)
}

/// A ply of 12 m is larger than a page can be in points, and is drawn in a larger unit, at full size.
#[test]
fn a_page_is_as_large_as_its_ply_and_margins() {
    for (size, unit) in [([0.3, 0.2], 1.0), ([12.0, 2.0], 3.0), ([0.02, 0.02], 1.0)] {
        let (page, found) = page(&Outline::rectangle([0.0, 0.0], size).unwrap());
        assert_eq!(found, unit);
        let mm = |points: f64| points * unit * 25.4 / 72.0;
        // room for the bar of 100 mm at least
        for (found, due) in page[2..].iter().zip([(size[0] * 1e3).max(100.0), size[1] * 1e3]) {
            assert!((mm(*found) - due - 50.0).abs() < 1e-2, "{} {due}", mm(*found));
            assert!(*found <= 14_400.0);
        }
    }
}

/// A closed line ends with its first point; a name with a comma stays one column.
#[test]
fn the_table_of_a_boundary_has_units_and_closed_lines() {
    let text = boundary::csv(&lines()).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!(rows[0], "polyline,point,x (m),y (m),z (m)");
    assert_eq!(rows[1], "\"ply 3, boundary\",1,0.0,0.0,0.0");
    assert_eq!(rows[5], "\"ply 3, boundary\",5,0.0,0.0,0.0");
    assert_eq!(rows[6], "hole,1,0.1,0.1,0.0");
    assert_eq!(rows.len(), 8);
}
