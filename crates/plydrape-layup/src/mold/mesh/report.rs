//! What was found and repaired while a mesh was read.

use super::boundary::Boundary;
use super::soup::{Role, Skipped};
use std::fmt;

/// What was found and repaired while a mesh was read.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeshReport {
    /// Vertices of the mold.
    pub vertices: usize,
    /// Triangles of the mold.
    pub triangles: usize,
    /// Its connected surfaces.
    pub surfaces: usize,
    /// Those of them without a boundary.
    pub closed: usize,
    /// Corners of the box around the mold (m): lowest and highest coordinates.
    pub bounds: [[f64; 3]; 2],
    /// Vertices that all but coincide with another and were merged; numbered in the order of the file.
    pub merged: Finding,
    /// Boundaries that were stitched because they all but meet.
    pub stitched: Stitches,
    /// Triangles without area, left out.
    pub degenerate: Finding,
    /// Triangles with the same corners as another, left out.
    pub duplicate: Finding,
    /// Triangles whose corners ran the wrong way round, turned over.
    pub flipped: Finding,
    /// Boundaries inside the outer one of their surface.
    pub holes: Vec<Boundary>,
    /// Elements that were left out, by their type.
    pub skipped: Vec<Skipped>,
}

/// Where boundaries of faces were stitched.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stitches {
    /// At how many vertices.
    pub count: usize,
    /// Where they were farthest apart: by how much (m), and the place (m).
    pub widest: Option<(f64, [f64; 3])>,
}

impl Stitches {
    pub(super) fn note(&mut self, width: f64, place: [f64; 3]) {
        self.count += 1;
        if self.widest.is_none_or(|(widest, _)| width > widest) {
            self.widest = Some((width, place));
        }
    }
}

/// How often something was found, and where first.
#[derive(Debug, Clone, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Finding {
    /// How often.
    pub count: usize,
    /// The first few: number in the file and place (m).
    pub first: Vec<(u64, [f64; 3])>,
}

impl Finding {
    /// How many are kept with their place.
    const KEPT: usize = 5;

    pub(super) fn note(&mut self, number: u64, place: [f64; 3]) {
        self.count += 1;
        if self.first.len() < Self::KEPT {
            self.first.push((number, place));
        }
    }
}

impl MeshReport {
    /// What of the mold is hardly meant, each in a sentence with its place and a remedy.
    #[must_use]
    pub fn warnings(&self) -> Vec<String> {
        self.skipped.iter().filter_map(Skipped::warning).collect()
    }
}

impl Skipped {
    /// What the surface misses without these elements, and what to do; none where they are no part of a surface.
    fn warning(&self) -> Option<String> {
        let Skipped { kind, role, count, beside, place } = self;
        let what = match role {
            Role::NoSurface => return None,
            Role::Thick => "which have a thickness and so two surfaces",
            Role::Unknown => "a type that is not known here",
        };
        let (are, they) = if *count == 1 { ("is", "it") } else { ("are", "they") };
        let first =
            place.map_or_else(String::new, |place| format!(", the first near {}", mm(place)));
        let remedy = "write the face that the ply touches as shells, such as S3 and S4";
        Some(if *beside > 0 {
            format!(
                "{count} of the mold's elements {are} of type {kind}, {what}, and left out; {beside} of these share an edge with its surface, so the mold has a hole in their place{first}; {remedy}"
            )
        } else {
            format!(
                "{count} of the mold's elements {are} of type {kind}, {what}, and left out{first}; if {they} belong{} to the surface, {remedy}",
                if *count == 1 { "s" } else { "" }
            )
        })
    }
}

/// A place in millimeters.
fn mm(place: [f64; 3]) -> String {
    let [x, y, z] = place.map(millimeters);
    format!("({x}, {y}, {z}) mm")
}

/// A number to two digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// A length in millimeters, to a tenth; without a minus before zero.
fn millimeters(length: f64) -> f64 {
    (1e4 * length).round() / 10.0 + 0.0
}

/// One line for the mold and one for each kind of finding.
impl fmt::Display for MeshReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [low, high] = self.bounds;
        let [x, y, z] = [0, 1, 2].map(|n| high[n] - low[n]);
        write!(
            f,
            "{} triangles, {} vertices, {} surface(s), {} of them closed; {x:.4} x {y:.4} x {z:.4} m",
            self.triangles, self.vertices, self.surfaces, self.closed
        )?;
        if let Some((width, place)) = self.stitched.widest {
            let Stitches { count, .. } = self.stitched;
            write!(
                f,
                "\nboundaries of faces that all but meet, stitched at {count} vertices, the widest gap "
            )?;
            write!(f, "{} mm near {}", rounded(1e3 * width), mm(place))?;
        }
        let kinds = [
            (&self.merged, "vertices that all but coincide, merged"),
            (&self.degenerate, "triangles without area, left out"),
            (&self.duplicate, "triangles that repeat another, left out"),
            (&self.flipped, "triangles that faced the wrong way, turned over"),
        ];
        for (finding, what) in kinds {
            if let Some((number, [x, y, z])) = finding.first.first() {
                write!(f, "\n{what}: {}, the first is number {number}", finding.count)?;
                write!(f, " near ({x:.4}, {y:.4}, {z:.4}) m")?;
            }
        }
        for hole in &self.holes {
            let [low, high] = hole.bounds;
            let [x, y, z] = [0, 1, 2].map(|n| 0.5 * (low[n] + high[n]));
            write!(f, "\na hole of {:.4} m around, near ({x:.4}, {y:.4}, {z:.4}) m", hole.length)?;
        }
        for Skipped { kind, role, count, .. } in &self.skipped {
            let what = match role {
                Role::NoSurface => "which are no surface",
                Role::Thick => "which have two surfaces",
                Role::Unknown => "a type that is not known here",
            };
            write!(f, "\nelements of type {kind}, {what}, left out: {count}")?;
        }
        Ok(())
    }
}
