//! STL files, binary and text.
//!
//! A binary file is 80 bytes of anything, the number n of triangles and n records of 50 bytes; it is known
//! by its length, as its first bytes may well read `solid`. Normals in the file are not used.

use super::text::{CORRECT, INCOMPLETE, Lines};
use crate::Error;
use plydrape::mold::mesh::Soup;

/// Bytes before the first triangle of a binary file, and of each triangle.
const HEADER: usize = 84;
const RECORD: usize = 50;

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Soup, Error> {
    let triangles = bytes.get(80..HEADER).map(|n| u32::from_le_bytes([n[0], n[1], n[2], n[3]]));
    let expected = triangles.map(|n| HEADER as u64 + RECORD as u64 * u64::from(n));
    let start = bytes.trim_ascii_start();
    let solid = start.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"));
    match (triangles, expected) {
        (_, Some(expected)) if expected == bytes.len() as u64 => binary(file, bytes),
        _ if (solid || triangles.is_none()) && !bytes.contains(&0) => text(file, bytes),
        _ => {
            let (triangles, bytes) = (triangles.unwrap_or(0), bytes.len());
            let expected = expected.unwrap_or(HEADER as u64);
            let message = format!(
                "{file}: a binary STL file of {triangles} triangles has {expected} bytes, this one has {bytes}"
            );
            Err(Error::file(file, message, INCOMPLETE))
        }
    }
}

fn binary(file: &str, bytes: &[u8]) -> Result<Soup, Error> {
    let mut soup = Soup::new("triangle");
    let records = bytes[HEADER..].chunks_exact(RECORD);
    soup.points.reserve(3 * records.len());
    soup.triangles.reserve(records.len());
    for (record, number) in records.zip(1..) {
        let corner = |n: usize| {
            [0, 4, 8].map(|offset| {
                let at = 12 + 12 * n + offset;
                f64::from(f32::from_le_bytes([
                    record[at],
                    record[at + 1],
                    record[at + 2],
                    record[at + 3],
                ]))
            })
        };
        let corners = [0, 1, 2].map(corner);
        if let Some(&value) = corners.as_flattened().iter().find(|x| !x.is_finite()) {
            let message = format!(
                "{file}: a coordinate of triangle {number} is {value}, expected a finite number"
            );
            return Err(Error::file(file, message, CORRECT));
        }
        add(&mut soup, corners, number);
    }
    Ok(soup)
}

fn add(soup: &mut Soup, corners: [[f64; 3]; 3], number: u64) {
    let first = soup.points.len() as u32;
    soup.points.extend(corners);
    soup.push(&[first, first + 1, first + 2], number);
}

fn text(file: &str, bytes: &[u8]) -> Result<Soup, Error> {
    let mut lines = Lines::new(file, bytes)?;
    let mut soup = Soup::new("triangle");
    let mut inside = false;
    let mut corners: Vec<[f64; 3]> = Vec::with_capacity(3);
    // what must come next, when a facet is open
    let mut expected: Option<&str> = None;
    while let Some(line) = lines.next() {
        let mut words = line.split_ascii_whitespace();
        let Some(word) = words.next().map(str::to_ascii_lowercase) else { continue };
        match (expected, word.as_str()) {
            (None, "solid") if !inside => inside = true,
            (None, "endsolid") if inside => inside = false,
            (None, "facet") if inside => expected = Some("outer loop"),
            (Some("outer loop"), "outer") => expected = Some("vertex"),
            (Some("vertex"), "vertex") => {
                let mut point = [0.0; 3];
                for coordinate in &mut point {
                    let word = words.next().ok_or_else(|| lines.fault(line, "`vertex x y z`"))?;
                    *coordinate = lines.number(word)?;
                }
                if words.next().is_some() {
                    return Err(lines.fault(line, "`vertex x y z`"));
                }
                corners.push(point);
                if corners.len() == 3 {
                    expected = Some("endloop");
                }
            }
            (Some("endloop"), "endloop") => expected = Some("endfacet"),
            (Some("endfacet"), "endfacet") => {
                let number = soup.triangles.len() as u64 + 1;
                add(&mut soup, [corners[0], corners[1], corners[2]], number);
                corners.clear();
                expected = None;
            }
            (Some(expected), _) => return Err(lines.fault(line, format!("`{expected}`"))),
            (None, _) if inside => return Err(lines.fault(line, "`facet` or `endsolid`")),
            (None, _) => return Err(lines.fault(line, "`solid`")),
        }
    }
    match expected {
        Some(expected) => Err(lines.ends(format!("`{expected}`"))),
        None if inside => Err(lines.ends("`endsolid`")),
        None if lines.number == 0 => Err(lines.ends("`solid`")),
        None => Ok(soup),
    }
}
