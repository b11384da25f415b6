//! The graph of lines against counts by hand, closed forms and the array's own indices.

use super::*;
use crate::ply::{Cut, Held, cloth, shear};

/// A cut ply with cups of a square array of 100 mm, its rows turned by this many degrees from u, that hold where asked; 40 mm of
/// fabric around them.
fn held(size: [usize; 2], degrees: f64, holds: impl Fn(GripperId) -> bool) -> Ply {
    with_holes(size, degrees, holds, Vec::new())
}

fn with_holes(
    [nu, nv]: [usize; 2],
    degrees: f64,
    holds: impl Fn(GripperId) -> bool,
    holes: Vec<Vec<[f64; 2]>>,
) -> Ply {
    let turn = degrees.to_radians();
    let (sin, cos) = turn.sin_cos();
    let turned = |[x, y]: [f64; 2]| [0.1 * (cos * x - sin * y), 0.1 * (sin * x + cos * y)];
    let [right, top] = [nu, nv].map(|count| count as f64 - 0.6);
    let boundary = [[-0.4, -0.4], [right, -0.4], [right, top], [-0.4, top]].map(turned).to_vec();
    let holes = holes.iter().map(|hole| hole.iter().copied().map(turned).collect()).collect();
    let ids = (0..nv).flat_map(|j| (0..nu).map(move |i| [i, j])).filter(|id| holds(*id));
    let held = ids.map(|id| Held { id, place: turned(id.map(|k| k as f64)) }).collect();
    let outline = Outline::new(boundary, holes).unwrap();
    let cut = Cut { outline, held, angle: 0.0, turn, origin: [0.0; 2] };
    Ply { cut: Some(cut), ..cloth(Grid::NONE) }
}

fn counts(lines: &Lines) -> [usize; 3] {
    [lines.edges(), lines.catenaries() - lines.edges(), lines.cells().len()]
}

/// Of a whole array geometry finds the lines that its indices give, in their order.
#[test]
fn the_lines_of_a_whole_array_are_those_of_its_indices() {
    for size in [[4, 2], [2, 5], [3, 3], [5, 1]] {
        let (found, grid) = (held(size, 0.0, |_| true).lines(), Grid { nu: size[0], nv: size[1] });
        let array = Lines::array(grid, [0.1; 2]);
        assert_eq!(counts(&found), counts(&array));
        for n in 0..array.catenaries() {
            assert_eq!(found.catenary(n), array.catenary(n));
            assert_eq!(found.ends(n), array.ends(n));
            assert!((found.flat_length(n, 1.0) - array.flat_length(n, 1.0)).abs() < 1e-15);
            for share in [0.0, 0.3, 1.0] {
                let ([u, v], [p, q]) = (found.point(n, share), array.point(n, share));
                assert!((u - p).hypot(v - q) < 1e-15);
            }
        }
        for n in 0..array.edges() {
            assert!((found.tributary(n) - array.tributary(n)).abs() < 1e-12, "{size:?} {n}");
        }
        let names = |lines: &Lines| lines.cells().iter().map(|cell| cell.id).collect::<Vec<_>>();
        assert_eq!(names(&found), names(&array));
        assert!(found.chains().eq(array.chains().filter(|(_, chain)| chain.len() > 1)));
    }
}

/// Without the cup in the middle its row and its column go on over two pitches, and the four cells around it are none.
#[test]
fn a_missing_cup_leaves_lines_of_two_pitches_and_no_cells() {
    let three = held([3, 3], 0.0, |id| id != [1, 1]).lines();
    assert_eq!(counts(&three), [10, 0, 0]);
    let long: Vec<usize> = (0..10).filter(|n| three.flat_length(*n, 1.0) > 0.15).collect();
    let ends: Vec<_> =
        long.iter().map(|n| (three.catenary(*n).from, three.catenary(*n).to)).collect();
    assert_eq!(ends, [([0, 1], [2, 1]), ([1, 0], [1, 2])]);
    assert!(long.iter().all(|n| (three.flat_length(*n, 1.0) - 0.2).abs() < 1e-15));

    // 4 rows of 4 edges and one of 3, in both directions; 16 cells without 4
    let five = held([5, 5], 0.0, |id| id != [2, 2]).lines();
    assert_eq!(counts(&five), [38, 24, 12]);
    // two cups off beside each other leave no line over three pitches, and a cell of one pitch by two
    let gap = held([5, 3], 0.0, |id| ![[2, 1], [3, 1]].contains(&id)).lines();
    assert_eq!(counts(&gap), [8 + 1 + 6 + 2, 6, 3]);
    // a whole column off: one cell of two pitches by one
    let wide = held([3, 2], 0.0, |id| id[0] != 1).lines();
    assert_eq!(counts(&wide), [4, 2, 1]);
    let [a, b] = wide.cells()[0].trellis;
    assert!((a - 0.2).abs() < 1e-15 && (b - 0.1).abs() < 1e-15);
    assert!((wide.flat_length(4, 1.0) - f64::hypot(0.2, 0.1)).abs() < 1e-15);
}

/// The strips of each family of fiber lines cover the ply between its cups once, whether cups are missing or not.
#[test]
fn the_strips_of_the_lines_cover_the_ply_between_its_cups() {
    for holds in [|_: GripperId| true, |id: GripperId| id != [1, 1], |id: GripperId| id != [1, 0]] {
        let ply = held([4, 3], 0.0, holds);
        let lines = ply.lines();
        for (kind, width) in [(Kind::EdgeU, 0), (Kind::EdgeV, 1)] {
            let of = (0..lines.edges()).filter(|n| lines.catenary(*n).kind == kind);
            let strip = |n| 2.0 * lines.tributary(n) * ply.line_widths()[width];
            let area: f64 = of.map(|n| strip(n) * lines.flat_length(n, 1.0)).sum();
            assert!((area - 0.06).abs() < 1e-12, "{kind:?}: {area} m²");
        }
    }
}

/// No line crosses a hole or leaves the ply; a cell with a hole on one of its diagonals is none.
#[test]
fn lines_run_where_the_fabric_is() {
    let square = |x: f64, y: f64, half: f64| {
        vec![[x - half, y - half], [x - half, y + half], [x + half, y + half], [x + half, y - half]]
    };
    let lines = |hole| with_holes([3, 3], 0.0, |_| true, vec![hole]).lines();
    // in the middle of a cell, on the middle of an edge, and on none of them
    assert_eq!(counts(&lines(square(0.5, 0.5, 0.2))), [12, 6, 3]);
    assert_eq!(counts(&lines(square(0.5, 1.0, 0.2))), [11, 4, 2]);
    assert_eq!(counts(&lines(square(0.5, 0.2, 0.1))), [12, 8, 4]);
}

/// At 45° each cell has two fibers from corner to corner, which cross in its middle, and four bias lines as its sides; a side
/// inside the array belongs to two cells.
#[test]
fn rows_at_45_degrees_are_bias_lines() {
    for degrees in [45.0, -45.0, 135.0] {
        let lines = held([4, 3], degrees, |_| true).lines();
        assert_eq!(counts(&lines), [12, 9 + 8, 6]);
        let diagonal = 0.1 * std::f64::consts::SQRT_2;
        for n in 0..lines.edges() {
            assert!((lines.flat_length(n, 1.0) - diagonal).abs() < 1e-12);
        }
        for n in lines.edges()..lines.catenaries() {
            assert!((lines.flat_length(n, 1.0) - 0.1).abs() < 1e-12);
        }
        let shared =
            (lines.edges()..lines.catenaries()).filter(|n| lines.cells_of(*n).count() == 2);
        assert_eq!(shared.count(), 3 + 4);
        for cell in lines.cells() {
            assert_eq!(cell.fibers, Fibers::Diagonals);
            assert!(cell.bias.iter().all(|bias| bias.list().len() == 2));
            assert!(cell.trellis.iter().all(|half| (half - 0.5 * diagonal).abs() < 1e-12));
        }
        // the name of a cell is its lowest cup in the array
        assert_eq!(lines.cells()[4].id, [1, 1]);
    }
    // where a cup is off, its four cells are none, and its two fibers go on to the next cup; its four neighbors along the rows and
    // columns are joined by fibers, which are the sides of a cell
    let lines = held([5, 5], 45.0, |id| id != [2, 2]).lines();
    let cells_with = |fibers| lines.cells().iter().filter(|cell| cell.fibers == fibers).count();
    assert_eq!([cells_with(Fibers::Diagonals), cells_with(Fibers::Sides)], [12, 1]);
    let long = |n: &usize| lines.flat_length(*n, 1.0) > 0.2;
    assert_eq!((0..lines.edges()).filter(long).count(), 2);
}

/// Neither along the yarns nor at 45° to them, no line runs from cup to cup.
#[test]
fn rows_at_other_angles_have_no_lines() {
    // at atan 1/2 cups lie on one yarn too, but more than two pitches apart
    for degrees in [30.0, 44.0, 10.0, 0.5_f64.atan().to_degrees()] {
        assert!(held([5, 4], degrees, |_| true).lines().is_empty(), "{degrees}");
    }
}

/// The rectangle whose diagonals are two fibers that cross at 90° + γ: its sides keep s₁² + s₂² = d², and the formulas of the
/// trellis of half fibers give back γ and the other side.
#[test]
fn sides_of_a_cell_of_fiber_diagonals_obey_the_trellis_rule() {
    let d: f64 = 0.14;
    let trellis = [0.5 * d; 2];
    for degrees in [1.0_f64, 12.0, 40.0] {
        let gamma = degrees.to_radians();
        // half the angle between the fibers, seen from the middle of the longer side
        let half = 0.5 * (std::f64::consts::FRAC_PI_2 + gamma);
        let [long, short] = [d * half.sin(), d * half.cos()];
        assert!((long * long + short * short - d * d).abs() < 1e-15);
        assert!((shear::angle(trellis, long) - gamma).abs() < 1e-12);
        assert!((shear::partner_length(trellis, long) - short).abs() < 1e-15);
    }
}
