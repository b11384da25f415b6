//! Triangles as a file gives them: not yet joined, in the unit of the file.

use super::triangle::double_area;
use crate::geometry::vector::{distance, dot};

/// The triangles of a file before they are joined into a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Soup {
    /// Vertices, in the unit of the file until the mesh is placed.
    pub points: Vec<[f64; 3]>,
    /// Corners of each triangle: indices of vertices.
    pub triangles: Vec<[u32; 3]>,
    /// The triangle, face or element of the file that each triangle comes from, as the file numbers it.
    pub numbers: Vec<u64>,
    /// What the file calls these.
    pub noun: &'static str,
    /// What the file holds beside the surface.
    pub skipped: Vec<Skipped>,
}

/// Elements of a file that were left out, of one type.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Skipped {
    /// Their type, as the file has it.
    pub kind: String,
    /// What is known of the type.
    pub role: Role,
    /// How many there are.
    pub count: usize,
    /// How many of them share an edge with the surface, so that it has a hole in their place.
    pub beside: usize,
    /// The middle of the first one beside the surface, or else of the first one: in the unit of the file until the mesh is
    /// placed, then in m. None of a type that is no surface.
    pub place: Option<[f64; 3]>,
}

/// What elements that were left out are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
pub enum Role {
    /// Solids, lines and points: no surface.
    NoSurface,
    /// Shells with a thickness of their own, and so with two surfaces.
    Thick,
    /// Nothing is known of them.
    Unknown,
}

impl Soup {
    /// Nothing yet; `noun` is what messages call one of the triangles.
    #[must_use]
    pub fn new(noun: &'static str) -> Self {
        Soup {
            points: Vec::new(),
            triangles: Vec::new(),
            numbers: Vec::new(),
            noun,
            skipped: Vec::new(),
        }
    }

    /// Adds one polygon, cut into triangles.
    pub fn push(&mut self, corners: &[u32], number: u64) {
        match *corners {
            [a, b, c] => self.triangles.push([a, b, c]),
            _ => cut(&self.points, corners, &mut self.triangles),
        }
        self.numbers.resize(self.triangles.len(), number);
    }
}

/// Cuts a polygon into triangles: one corner after the other is cut off, where its diagonal runs inside,
/// the one with the shortest diagonal first. A quadrilateral is thus split along its shorter diagonal, or
/// along the only one that is inside.
fn cut(points: &[[f64; 3]], corners: &[u32], triangles: &mut Vec<[u32; 3]>) {
    let point = |corner: u32| points[corner as usize];
    // twice the vector area of the polygon
    let mut normal = [0.0; 3];
    for n in 1..corners.len().saturating_sub(1) {
        let part = double_area([point(corners[0]), point(corners[n]), point(corners[n + 1])]);
        normal = [0, 1, 2].map(|c| normal[c] + part[c]);
    }
    let mut left = corners.to_vec();
    while left.len() > 3 {
        let count = left.len();
        let ear = |n: usize| [left[(n + count - 1) % count], left[n], left[(n + 1) % count]];
        let mut best: Option<(f64, usize)> = None;
        for n in 0..count {
            let [a, b, c] = ear(n).map(point);
            let convex = dot(double_area([a, b, c]), normal) > 0.0;
            let length = distance(a, c);
            if !convex || best.is_some_and(|(shortest, _)| length >= shortest) {
                continue;
            }
            let free = left
                .iter()
                .filter(|corner| !ear(n).contains(corner))
                .all(|&corner| !covers([a, b, c], point(corner), normal));
            if free {
                best = Some((length, n));
            }
        }
        // a polygon that crosses itself has no such corner: any one will do
        let n = best.map_or(1, |(_, n)| n);
        triangles.push(ear(n));
        left.remove(n);
    }
    if let [a, b, c] = left[..] {
        triangles.push([a, b, c]);
    }
}

/// Whether a triangle covers a point, seen along `normal`, strictly.
fn covers([a, b, c]: [[f64; 3]; 3], p: [f64; 3], normal: [f64; 3]) -> bool {
    [[a, b], [b, c], [c, a]].iter().all(|&[s, t]| dot(double_area([s, t, p]), normal) > 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn split(points: Vec<[f64; 3]>) -> Vec<[u32; 3]> {
        let corners: Vec<u32> = (0..points.len() as u32).collect();
        let mut soup = Soup { points, ..Soup::new("face") };
        soup.push(&corners, 1);
        assert_eq!(soup.numbers.len(), soup.triangles.len());
        soup.triangles
    }

    #[test]
    fn a_quadrilateral_is_split_along_its_shorter_diagonal() {
        let long = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [3.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        for triangle in split(long) {
            assert!(triangle.contains(&1) && triangle.contains(&3), "{triangle:?}");
        }
    }

    /// An arrow head: the shorter diagonal runs outside of it.
    #[test]
    fn an_arrow_head_is_split_along_the_diagonal_inside() {
        let arrow = vec![[0.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.0]];
        for triangle in split(arrow) {
            assert!(triangle.contains(&1) && triangle.contains(&3), "{triangle:?}");
        }
    }

    /// The areas of the parts add up only if no part lies outside.
    #[test]
    fn a_star_keeps_its_area() {
        let star: Vec<[f64; 3]> = (0..14)
            .map(|n| {
                let angle = n as f64 * std::f64::consts::PI / 7.0;
                let radius = if n % 2 == 0 { 1.0 } else { 0.3 };
                [radius * angle.cos(), radius * angle.sin(), 0.1 * radius]
            })
            .collect();
        let area = |corners: [[f64; 3]; 3]| 0.5 * double_area(corners)[2];
        let expected: f64 = (0..14).map(|n| area([[0.0; 3], star[n], star[(n + 1) % 14]])).sum();
        let parts = split(star.clone());
        let found: f64 = parts.iter().map(|t| area(t.map(|n| star[n as usize]))).sum();
        let unsigned: f64 = parts.iter().map(|t| area(t.map(|n| star[n as usize])).abs()).sum();
        assert_eq!(parts.len(), 12);
        assert!((found - expected).abs() < 1e-12 && (unsigned - expected).abs() < 1e-12);
    }
}
