//! What was found and repaired while a mesh was read.

use super::boundary::Boundary;
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
    /// Triangles without area, left out.
    pub degenerate: Finding,
    /// Triangles with the same corners as another, left out.
    pub duplicate: Finding,
    /// Triangles whose corners ran the wrong way round, turned over.
    pub flipped: Finding,
    /// Boundaries inside the outer one of their surface.
    pub holes: Vec<Boundary>,
    /// Elements that are no surface, left out: their type and how many lines of data they had.
    pub skipped: Vec<(String, usize)>,
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
        for (kind, count) in &self.skipped {
            write!(f, "\nlines of {kind} elements, which are no surface, left out: {count}")?;
        }
        Ok(())
    }
}
