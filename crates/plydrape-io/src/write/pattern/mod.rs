//! A ply's flat pattern for the cutter and the workshop, and its boundary on the mold for a laser projector.
//!
//! [`dxf`] draws the pattern for a cutter, [`pdf`] at full size for people; [`boundary`] writes lines in space. What is the same
//! goes in as the same bytes: there are no dates in these files.

pub mod boundary;
pub mod dxf;
mod dxf_text;
pub mod pdf;
pub mod result;

use plydrape::ply::Outline;

/// A ply in the flat, as it is cut and gripped.
#[derive(Debug, Clone, Copy)]
pub struct Pattern<'a> {
    /// What it is called; one line of text.
    pub title: &'a str,
    /// Boundary and holes, in the coordinates of the drawing (m).
    pub outline: &'a Outline,
    /// Angle from the x axis of the drawing to the warp, counterclockwise (rad).
    pub warp: f64,
    /// Where it is gripped.
    pub grippers: &'a [Gripper],
}

/// A gripper's place on the ply in the flat.
#[derive(Debug, Clone, PartialEq)]
pub struct Gripper {
    /// What it is called, as in `g2_0`.
    pub name: String,
    /// Middle, in the coordinates of the drawing (m).
    pub place: [f64; 2],
    /// Radius of its pad (m).
    pub radius: f64,
}

/// A line in space, such as the boundary of a ply on the mold.
#[derive(Debug, Clone, PartialEq)]
pub struct PatternLine {
    /// What it is called.
    pub name: String,
    /// Points (m); of a closed one the first is not repeated.
    pub points: Vec<[f64; 3]>,
    /// Whether its end is its beginning.
    pub closed: bool,
}

/// Lowest and highest coordinates of the outline and of the pads of its grippers (m).
fn bounds(pattern: &Pattern) -> [[f64; 2]; 2] {
    let mut bounds = pattern.outline.bounds();
    for Gripper { place, radius, .. } in pattern.grippers {
        for n in 0..2 {
            bounds[0][n] = bounds[0][n].min(place[n] - radius);
            bounds[1][n] = bounds[1][n].max(place[n] + radius);
        }
    }
    bounds
}

/// The arrow of the warp, in the middle of the outline's bounds: its lines (m), and its point first.
fn arrow(pattern: &Pattern) -> [Vec<[f64; 2]>; 2] {
    let [low, high] = pattern.outline.bounds();
    let middle = [0, 1].map(|n| 0.5 * (low[n] + high[n]));
    let length = 0.25 * (high[0] - low[0]).min(high[1] - low[1]);
    let (sin, cos) = pattern.warp.sin_cos();
    let point = |along: f64, across: f64| {
        let [u, v] = [along * length, across * length];
        [middle[0] + u * cos - v * sin, middle[1] + u * sin + v * cos]
    };
    [
        vec![point(0.5, 0.0), point(-0.5, 0.0)],
        vec![point(0.35, 0.06), point(0.5, 0.0), point(0.35, -0.06)],
    ]
}

/// A text with spaces in place of control characters.
fn one_line(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
