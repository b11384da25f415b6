//! Heights on a grid from a CSV file, one node a row in any order.

use crate::Error;
use crate::scene::located::Located;
use crate::scene::places::{X, Y, Z, csv_file, point};
use crate::scene::source::Document;
use crate::scene::table::Table;
use plydrape::LayupError;
use plydrape::mold::HeightGrid;
use std::ops::Range;

/// Places along an axis closer than this share of its length are one place.
const SAME: f64 = 1e-7;

/// Reads the file of a height grid.
pub(super) fn heights(file: &Located<String>, scene: &Document) -> Result<HeightGrid, Error> {
    // the points of the file, in any order
    let document = csv_file(&file.value, &file.span, scene)?;
    let columns = [X, Y, Z];
    let csv = Table::new(&document, &columns, &[])?;
    let (mut points, mut spans) = (Vec::new(), Vec::new());
    for row in csv.rows() {
        points.push(point(&row, [0, 1, 2])?);
        spans.push(row.span.clone());
    }
    csv.check_plain()?;
    if points.is_empty() {
        return Err(document.error(
            csv.header(),
            "there is no row below the header",
            "give every node of the grid one row with x, y and z",
        ));
    }

    // the grid: where its nodes are along x and along y, and how high the mold is at each
    let axes = [0, 1].map(|n| axis(&points, n));
    let z = in_order(&axes, &points, &spans, &document, &csv.header())?;
    let [x, y] = axes;
    HeightGrid::new(x, y, z).map_err(|error| {
        let help = match error {
            LayupError::HeightGridTooFew { .. } => {
                "measure the mold at 4 or more places along x and along y"
            }
            _ => "give every node of the grid one row with x, y and z",
        };
        document.error(csv.header(), error.to_string(), help)
    })
}

/// The places of the nodes along x or y (m), ascending.
fn axis(points: &[[f64; 3]], n: usize) -> Vec<f64> {
    let mut places: Vec<f64> = points.iter().map(|point| point[n]).collect();
    places.sort_by(f64::total_cmp);
    let length = match (places.first(), places.last()) {
        (Some(first), Some(last)) => last - first,
        _ => 0.0,
    };
    places.dedup_by(|next, before| *next - *before <= SAME * length);
    places
}

/// The heights in the order of the grid; refuses a node with two rows or none.
fn in_order(
    [x, y]: &[Vec<f64>; 2],
    points: &[[f64; 3]],
    spans: &[Range<usize>],
    document: &Document,
    header: &Range<usize>,
) -> Result<Vec<f64>, Error> {
    // each row belongs to the nearest node of the grid
    let nearest = |axis: &[f64], place: f64| {
        let k = axis.partition_point(|node| *node < place).min(axis.len() - 1);
        if k > 0 && place - axis[k - 1] < axis[k] - place { k - 1 } else { k }
    };
    let mut rows: Vec<(usize, usize)> = points
        .iter()
        .enumerate()
        .map(|(row, point)| (nearest(x, point[0]) + x.len() * nearest(y, point[1]), row))
        .collect();
    rows.sort_unstable();

    // rows are sorted by node, so two of one node follow each other
    let twice = rows.windows(2).filter(|pair| pair[0].0 == pair[1].0).map(|pair| pair[1].1).min();
    if let Some(row) = twice {
        let [px, py, _] = points[row];
        return Err(document.error(
            spans[row].clone(),
            format!("the node at x = {px} m, y = {py} m is listed for the second time"),
            "give every node of the grid one row",
        ));
    }

    // the first node without a row
    let missing = rows.iter().zip(0..).find(|((node, _), expected)| node != expected);
    let missing = missing.map(|(_, expected)| expected);
    let missing = missing.or((rows.len() < x.len() * y.len()).then_some(rows.len()));
    if let Some(node) = missing {
        let [px, py] = [x[node % x.len()], y[node / x.len()]];
        return Err(document.error(
            header.clone(),
            format!(
                "there is no height for x = {px} m, y = {py} m, and {} rows for {} × {} places",
                rows.len(),
                x.len(),
                y.len()
            ),
            "a grid has a height for every x at every y; give the missing rows, or bring scattered points onto a grid first",
        ));
    }
    Ok(rows.into_iter().map(|(_, row)| points[row][2]).collect())
}
