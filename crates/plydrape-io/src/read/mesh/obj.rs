//! OBJ files: vertices and polygons. Texture, normals, groups and materials are passed over.

use super::text::{Lines, refused};
use crate::Error;
use plydrape::mold::mesh::Soup;

/// Most corners of a face: a cut looks at every corner from every other, so its time grows with their cube.
const MOST_CORNERS: usize = 1000;
/// Most looks of all cuts, cubes of corners summed; they take about a minute.
const MOST_CUTS: f64 = 2e10;
/// What to do about faces of too many corners.
const CUT: &str = "export the surface as triangles or quadrilaterals";
/// Statements that say nothing about the surface.
const IGNORED: [&str; 20] = [
    "vt",
    "vn",
    "vp",
    "o",
    "g",
    "s",
    "mg",
    "l",
    "p",
    "usemtl",
    "mtllib",
    "usemap",
    "maplib",
    "lod",
    "bevel",
    "c_interp",
    "d_interp",
    "shadow_obj",
    "trace_obj",
    "csh",
];

pub(super) fn read(file: &str, bytes: &[u8]) -> Result<Soup, Error> {
    let mut lines = Lines::new(file, bytes)?;
    let mut soup = Soup::new("face");
    // faces may come before their vertices: line, and corners in `corners`
    let mut faces: Vec<(usize, usize)> = Vec::new();
    let mut corners: Vec<i64> = Vec::new();
    let mut continued = String::new();
    while let Some(line) = lines.next() {
        if let Some(start) = line.strip_suffix('\\') {
            continued.push_str(start);
            continued.push(' ');
            continue;
        }
        let whole = std::mem::take(&mut continued) + line;
        let statement = whole.split('#').next().unwrap_or_default();
        let mut words = statement.split_ascii_whitespace();
        match words.next() {
            None => {}
            Some("v") => {
                let values = words.map(|word| lines.number(word)).collect::<Result<Vec<_>, _>>()?;
                let point = match values[..] {
                    [x, y, z] | [x, y, z, _, _, _] => [x, y, z],
                    [x, y, z, w] if w != 0.0 => [x / w, y / w, z / w],
                    _ => return Err(lines.fault(line, "`v x y z`")),
                };
                soup.points.push(point);
            }
            Some("f") => {
                for word in words {
                    let vertex = word.split('/').next().unwrap_or_default();
                    let vertex = match vertex.parse::<i64>() {
                        Ok(n) if n > 0 => n,
                        // counted back from the last vertex so far; what is too far back is kept
                        Ok(n) if n < 0 => {
                            let back = n + 1 + soup.points.len() as i64;
                            if back > 0 { back } else { n }
                        }
                        _ => return Err(lines.fault(word, "the number of a vertex")),
                    };
                    corners.push(vertex);
                }
                let before = faces.last().map_or(0, |(_, end)| *end);
                if corners.len() < before + 3 {
                    return Err(lines.fault(line, "a face of three vertices or more"));
                }
                faces.push((lines.number, corners.len()));
            }
            Some(word) if IGNORED.contains(&word) => {}
            Some(_) => {
                return Err(lines.fault(line, "`v`, `f` or another statement of a polygon mesh"));
            }
        }
    }
    if !continued.is_empty() {
        return Err(lines.ends("the line after `\\`"));
    }

    // how long the cutting takes is known before the first cut
    let (mut start, mut largest, mut cuts) = (0, 0, 0.0);
    for (&(line, end), number) in faces.iter().zip(1..) {
        let corners = end - start;
        if corners > MOST_CORNERS {
            let message =
                format!("face {number} has {corners} corners; {MOST_CORNERS} are the most");
            return Err(refused(file, line, message, CUT));
        }
        largest = largest.max(corners);
        if corners > 4 {
            cuts += (corners as f64).powi(3);
        }
        start = end;
    }
    if cuts > MOST_CUTS {
        let message = format!(
            "{file}: its faces of up to {largest} corners would take too long to cut into triangles"
        );
        return Err(Error::file(file, message, CUT));
    }

    let mut start = 0;
    let mut face = Vec::new();
    for ((line, end), number) in faces.into_iter().zip(1..) {
        face.clear();
        for &vertex in &corners[start..end] {
            let vertices = soup.points.len();
            let index = usize::try_from(vertex).ok().filter(|n| (1..=vertices).contains(n));
            let Some(index) = index else {
                let message = format!("face {number} uses vertex {vertex}");
                return Err(refused(
                    file,
                    line,
                    message,
                    format!("the file has {vertices} vertices"),
                ));
            };
            face.push(index as u32 - 1);
        }
        soup.push(&face, number);
        start = end;
    }
    Ok(soup)
}
