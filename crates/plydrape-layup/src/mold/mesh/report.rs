//! What was found and repaired while a mesh was read.

use super::boundary::Boundary;
use super::detail::{Detail, DetailKind};
use super::gap::Gaps;
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
    /// Connected surfaces.
    pub surfaces: usize,
    /// Connected surfaces without a boundary.
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
    /// Pits, studs and holes that no ply follows; those that it spans are no [`MeshReport::holes`] any more.
    pub details: Vec<Detail>,
    /// Gaps between faces, which end the mold for the ply.
    pub gaps: Option<Gaps>,
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
        let lost = self.skipped.iter().filter_map(Skipped::warning);
        let gaps = self.gaps.iter().map(Gaps::warning);
        lost.chain(gaps).chain(self.details()).collect()
    }

    /// Details of one kind that are treated alike, in a sentence for each kind.
    fn details(&self) -> impl Iterator<Item = String> + '_ {
        // a sentence for what the ply spans and one for what it does not, of each kind
        let kinds = [DetailKind::Pit, DetailKind::Hole, DetailKind::Stud];
        kinds.into_iter().flat_map(|kind| [true, false].map(|spanned| (kind, spanned))).filter_map(
            |(kind, spanned)| {
                let own = |detail: &&Detail| detail.kind == kind && detail.spanned == spanned;
                let own: Vec<&Detail> = self.details.iter().filter(own).collect();
                if own.is_empty() {
                    return None;
                }

                // the first few with size and place, the others by their number
                let first: Vec<String> =
                    own.iter().take(Finding::KEPT).map(|detail| detail.text()).collect();
                let more = match own.len().saturating_sub(Finding::KEPT) {
                    0 => String::new(),
                    more => format!(", and {more} more"),
                };

                // what the ply or the ideal drape does there, and how to change the mold
                let what = match (kind, spanned) {
                    (DetailKind::Stud, _) => {
                        "no ply follows what is so narrow, but the ideal drape does; cut it off in the file of the mold"
                    }
                    (_, true) => {
                        "the ply spans what is narrower than `spanned` in [mold], so it is taken as filled"
                    }
                    (DetailKind::Hole, false) => {
                        "the ideal drape ends there or runs into it; fill it in the file of the mold"
                    }
                    (DetailKind::Pit, false) => {
                        "no ply follows what is so narrow, but the ideal drape does; fill it in the file of the mold"
                    }
                };
                Some(format!("the mold has {}{more}: {what}", first.join(", ")))
            },
        )
    }
}

impl Detail {
    /// What it is, how large and where, as in "a pit of 6 mm, 10 mm deep, at (0, 0, 0) mm".
    #[must_use]
    pub fn text(&self) -> String {
        let Detail { kind, width, length, depth, place, .. } = self;
        let [width, length, depth] = [width, length, depth].map(|x| millimeters(*x));
        let noun = match kind {
            DetailKind::Pit => "a pit",
            DetailKind::Stud => "a stud",
            DetailKind::Hole => "a hole",
        };
        let long = if length > width { format!(" by {length}") } else { String::new() };
        let deep = match kind {
            DetailKind::Pit => format!(", {depth} mm deep,"),
            DetailKind::Stud => format!(", {depth} mm high,"),
            DetailKind::Hole => String::new(),
        };
        format!("{noun} of {width}{long} mm{deep} at {}", mm(*place))
    }
}

impl Gaps {
    /// How wide, how long and where they are, and what to do, in a sentence.
    #[must_use]
    pub fn warning(&self) -> String {
        let [narrow, wide] = [self.narrowest, self.widest].map(|width| rounded(1e3 * width));
        let width = if narrow < wide { format!("{narrow} to {wide}") } else { wide.to_string() };
        format!(
            "between faces of the mold runs a gap or step of {width} mm, {} mm long, near {}; the ply ends there as at the boundary of the mold, because it is more than the tolerance of contact: stitch the faces or merge their vertices where the mesh is made",
            millimeters(self.length).round(),
            mm(self.place)
        )
    }
}

impl Skipped {
    /// What the surface misses without these elements, and what to do; `None` where they are no part of a surface.
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
        // the mold: its triangles, its surfaces, and the size of the box around it
        let [low, high] = self.bounds;
        let [x, y, z] = [0, 1, 2].map(|n| high[n] - low[n]);
        write!(
            f,
            "{} triangles, {} vertices, {} surface(s), {} of them closed; {x:.4} x {y:.4} x {z:.4} m",
            self.triangles, self.vertices, self.surfaces, self.closed
        )?;

        // what was repaired: boundaries of faces, then vertices and triangles
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

        // what the mold lacks: holes in its surfaces, and elements that were left out
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
