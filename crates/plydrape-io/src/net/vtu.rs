//! Net and mold as VTK's unstructured grids, `.vtu`: plain text in XML, version 1.0 of the format.
//!
//! Only nodes with a place and cells with all four are there. Numbers are in the shortest form that reads
//! back to the same double.

use super::nodal_shear;
use plydrape::mold::Mold;
use plydrape::net::Net;
use std::fmt::Write;

type Point = [f64; 3];

/// VTK's number for a triangle, and for a quadrilateral.
const TRIANGLE: u8 = 5;
const QUAD: u8 = 9;

/// An array of data: its name, numbers of one entry, and all numbers.
struct Array {
    name: &'static str,
    width: usize,
    values: Vec<f64>,
}

/// The net. At points: fabric coordinates `u`, `v` (m), grid indices `i`, `j`, `shear_deg` as in
/// `nodes.csv`. In cells: `shear_deg`, the magnitude; `signed_shear_deg`, positive where u and v stand at
/// less than 90°; `fibre_u`, `fibre_v`, unit vectors along the two fibre directions in the cell's middle.
#[must_use]
pub fn net(net: &Net) -> String {
    let ([nu, nv], mesh) = (net.layup.nodes, net.layup.mesh);
    let mut number = vec![None; nu * nv];
    let mut points = Vec::new();
    let names = ["u", "v", "i", "j", "shear_deg"];
    let mut at_points = names.map(|name| Array { name, width: 1, values: Vec::new() });
    for id in (0..nu * nv).map(|n| [n % nu, n / nu]) {
        let Some(place) = net.node(id) else { continue };
        number[id[1] * nu + id[0]] = Some(points.len());
        points.push(place);
        let [i, j] = id.map(|k| k as f64);
        // beside missing nodes only, VTK's own way to say "unknown"
        let shear = nodal_shear(net, id).map_or(f64::NAN, f64::to_degrees);
        for (array, value) in at_points.iter_mut().zip([i * mesh[0], j * mesh[1], i, j, shear]) {
            array.values.push(value);
        }
    }

    let mut cells = Vec::new();
    let widths = [("shear_deg", 1), ("signed_shear_deg", 1), ("fibre_u", 3), ("fibre_v", 3)];
    let mut in_cells = widths.map(|(name, width)| Array { name, width, values: Vec::new() });
    for [i, j] in (0..nv.saturating_sub(1)).flat_map(|j| (0..nu - 1).map(move |i| [i, j])) {
        let ring = [[i, j], [i + 1, j], [i + 1, j + 1], [i, j + 1]];
        let found = ring.map(|id| number[id[1] * nu + id[0]]);
        let (Some(shear), [Some(a), Some(b), Some(c), Some(d)]) = (net.cell_shear([i, j]), found)
        else {
            continue;
        };
        cells.push(vec![a, b, c, d]);
        let [p, q, r, s] = [a, b, c, d].map(|n| points[n]);
        in_cells[0].values.push(shear.magnitude.to_degrees());
        in_cells[1].values.push(shear.angle.to_degrees());
        in_cells[2].values.extend(middle([p, q], [s, r]));
        in_cells[3].values.extend(middle([p, s], [q, r]));
    }
    text(&points, &cells, QUAD, &at_points, &in_cells)
}

/// The patch of mold that the shear map shows, in triangles; none if the mold is not near the net.
#[must_use]
pub fn mold(net: &Net, mold: &Mold) -> Option<String> {
    let outlines = crate::figure::shear_map::patch(net, mold);
    let mut points: Vec<Point> = Vec::new();
    let mut known = std::collections::HashMap::new();
    let mut cells = Vec::new();
    for outline in outlines {
        let corners: Vec<usize> = outline
            .iter()
            .map(|p| {
                *known.entry(p.map(f64::to_bits)).or_insert_with(|| {
                    points.push(*p);
                    points.len() - 1
                })
            })
            .collect();
        cells.extend(corners[1..].windows(2).map(|pair| vec![corners[0], pair[0], pair[1]]));
    }
    (!cells.is_empty()).then(|| text(&points, &cells, TRIANGLE, &[], &[]))
}

/// Unit vector along the mean of two opposite sides.
fn middle(one: [Point; 2], other: [Point; 2]) -> Point {
    let sum = [0, 1, 2].map(|c| one[1][c] - one[0][c] + other[1][c] - other[0][c]);
    let size = sum.iter().map(|c| c * c).sum::<f64>().sqrt().max(f64::MIN_POSITIVE);
    sum.map(|c| c / size)
}

/// The whole file. All cells are of one kind.
fn text(
    points: &[Point],
    cells: &[Vec<usize>],
    kind: u8,
    at_points: &[Array],
    in_cells: &[Array],
) -> String {
    let mut out = String::from(
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" \
         byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n",
    );
    let (count, all) = (points.len(), cells.len());
    let _ = writeln!(out, "<Piece NumberOfPoints=\"{count}\" NumberOfCells=\"{all}\">");
    let places = points.iter().flatten().copied().collect();
    section(&mut out, "Points", &[Array { name: "Points", width: 3, values: places }]);

    out.push_str("<Cells>\n");
    let mut end = 0;
    let ends = cells.iter().map(|cell| {
        end += cell.len();
        end
    });
    integers(&mut out, "connectivity", "Int64", cells.iter().flatten().copied());
    integers(&mut out, "offsets", "Int64", ends);
    integers(&mut out, "types", "UInt8", cells.iter().map(|_| usize::from(kind)));
    out.push_str("</Cells>\n");

    section(&mut out, "PointData", at_points);
    section(&mut out, "CellData", in_cells);
    out.push_str("</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
    out
}

/// A part of the file with arrays of doubles, one entry a line.
fn section(out: &mut String, name: &str, arrays: &[Array]) {
    let _ = writeln!(out, "<{name}>");
    for Array { name, width, values } in arrays {
        let components = match width {
            1 => String::new(),
            more => format!(" NumberOfComponents=\"{more}\""),
        };
        let _ = writeln!(
            out,
            "<DataArray type=\"Float64\" Name=\"{name}\"{components} format=\"ascii\">"
        );
        for entry in values.chunks(*width) {
            let numbers: Vec<String> =
                entry.iter().map(|v| format!("{v:?}").to_lowercase()).collect();
            let _ = writeln!(out, "{}", numbers.join(" "));
        }
        out.push_str("</DataArray>\n");
    }
    let _ = writeln!(out, "</{name}>");
}

/// An array of whole numbers, one a line.
fn integers(out: &mut String, name: &str, kind: &str, values: impl Iterator<Item = usize>) {
    let _ = writeln!(out, "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">");
    for value in values {
        let _ = writeln!(out, "{value}");
    }
    out.push_str("</DataArray>\n");
}
