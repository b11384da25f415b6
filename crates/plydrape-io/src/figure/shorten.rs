//! The same picture in half the bytes: what many shapes share is said once, and corners are written as steps.
//!
//! A curved mold takes ten thousand shapes of two to five corners each, so their attributes outweigh their places.

use std::collections::HashMap;
use std::fmt::Write;

/// Shapes that must share their attributes for a class of their own to be shorter.
const SHARED: usize = 3;

/// A line of the file that is a shape: whether it is closed, its attributes, its corners.
struct Shape<'a> {
    closed: bool,
    attributes: &'a str,
    corners: Vec<[i64; 2]>,
}

impl<'a> Shape<'a> {
    /// None of any other line, or of one that is not as `plotters` writes it.
    fn of(line: &'a str) -> Option<Self> {
        let (closed, rest) = match line.strip_prefix("<polygon ") {
            Some(rest) => (true, rest),
            None => (false, line.strip_prefix("<polyline ")?),
        };
        let (attributes, rest) = rest.split_once(" points=\"")?;
        let points = rest.strip_suffix("\"/>")?;
        let corner = |pair: &str| {
            let (x, y) = pair.split_once(',')?;
            Some([x.parse().ok()?, y.parse().ok()?])
        };
        let corners = points.split_whitespace().map(corner).collect::<Option<Vec<_>>>()?;
        (corners.len() > 1).then_some(Shape { closed, attributes, corners })
    }

    /// Its path: the first corner, then the steps to the others.
    fn path(&self) -> String {
        let mut path = String::from("M");
        let mut before = [0, 0];
        for (n, corner) in self.corners.iter().enumerate() {
            let [x, y] = [0, 1].map(|c| corner[c] - before[c]);
            // a minus parts two numbers as well as a space
            let gap = |value: i64| if value < 0 { "" } else { " " };
            let first = match n {
                0 => "",
                1 => "l",
                _ => gap(x),
            };
            let _ = write!(path, "{first}{x}{}{y}", gap(y));
            before = *corner;
        }
        if self.closed {
            path.push('z');
        }
        path
    }
}

/// The file with its polygons and polylines as paths, those that look alike in classes.
pub(super) fn shortened(text: &str) -> String {
    let shapes: Vec<Option<Shape>> = text.lines().map(Shape::of).collect();
    let mut count: HashMap<&str, usize> = HashMap::new();
    for shape in shapes.iter().flatten() {
        *count.entry(shape.attributes).or_default() += 1;
    }
    // in the order in which they come
    let mut classes: HashMap<&str, String> = HashMap::new();
    let mut style = String::new();
    for shape in shapes.iter().flatten() {
        if count[shape.attributes] >= SHARED && !classes.contains_key(shape.attributes) {
            let name = format!("c{}", classes.len());
            let _ = write!(style, ".{name}{{{}}}", declarations(shape.attributes));
            classes.insert(shape.attributes, name);
        }
    }

    let mut out = String::with_capacity(text.len() / 2);
    for (line, shape) in text.lines().zip(&shapes) {
        match shape {
            Some(shape) => {
                let path = shape.path();
                let _ = match classes.get(shape.attributes) {
                    Some(class) => writeln!(out, "<path class=\"{class}\" d=\"{path}\"/>"),
                    None => writeln!(out, "<path {} d=\"{path}\"/>", shape.attributes),
                };
            }
            None => {
                out.push_str(line);
                out.push('\n');
                if line.starts_with("<svg ") && !style.is_empty() {
                    let _ = writeln!(out, "<style>{style}</style>");
                }
            }
        }
    }
    out
}

/// Attributes as a style has them: `fill="none" stroke-width="5"` is `fill:none;stroke-width:5`.
fn declarations(attributes: &str) -> String {
    attributes.replace("=\"", ":").replace("\" ", ";").replace('"', "")
}

#[cfg(test)]
mod tests {
    use super::*;

    const LINE: &str = "<polyline fill=\"none\" stroke=\"#B0B7C1\" stroke-width=\"5\" points=\"30,10 20,15 20,5 \"/>";

    /// Steps lead through the corners, in their order, and a polygon back to its first.
    #[test]
    fn a_path_passes_the_same_corners() {
        let polygon = LINE.replace("polyline", "polygon");
        assert_eq!(Shape::of(LINE).unwrap().path(), "M30 10l-10 5 0-10");
        assert_eq!(Shape::of(&polygon).unwrap().path(), "M30 10l-10 5 0-10z");
    }

    /// What three shapes share stands once; what is no shape, and what one has alone, stays.
    #[test]
    fn what_shapes_share_is_said_once() {
        let alone = "<polygon fill=\"#FFFFFF\" points=\"0,0 9,0 9,9 \"/>";
        let text = format!(
            "<svg width=\"9\">\n{alone}\n{LINE}\n{LINE}\n<text>\n<polyline \n</text>\n{LINE}\n</svg>\n"
        );
        let path = "<path class=\"c0\" d=\"M30 10l-10 5 0-10\"/>";
        let style = "<style>.c0{fill:none;stroke:#B0B7C1;stroke-width:5}</style>";
        assert_eq!(
            shortened(&text),
            format!(
                "<svg width=\"9\">\n{style}\n<path fill=\"#FFFFFF\" d=\"M0 0l9 0 0 9z\"/>\n{path}\n{path}\n<text>\n<polyline \n</text>\n{path}\n</svg>\n"
            )
        );
    }
}
