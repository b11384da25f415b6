//! Why triangles are no mold.

/// Why a mesh cannot serve as a mold. Numbers count from 1, places are in meters.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// The file is in order and has no surface.
    #[error("no {noun}s{others}")]
    Empty {
        /// What its surface would be made of.
        noun: &'static str,
        /// What there is instead.
        others: String,
    },
    /// All triangles have no area.
    #[error("none of the {triangles} triangles has an area; the mesh spans {size:.4} m")]
    NoArea {
        /// How many triangles there are.
        triangles: usize,
        /// Diagonal of the box around all vertices (m).
        size: f64,
    },
    /// The mesh is no size for a mold.
    #[error("the mesh spans {size:.3e} m at {scale} m per unit, expected 1e-4 to 1e5 m")]
    Size {
        /// Diagonal of the box around all vertices (m).
        size: f64,
        /// Meters per unit of the file.
        scale: f64,
    },
    /// The scale is no positive number.
    #[error("a scale of {scale} m per unit, expected a positive number such as 0.001 for mm")]
    Scale {
        /// Meters per unit of the file.
        scale: f64,
    },
    /// Three or more triangles share an edge.
    #[error(
        "{noun}s {}, {} and {} share an edge near ({:.4}, {:.4}, {:.4}) m",
        .numbers[0], .numbers[1], .numbers[2], .place[0], .place[1], .place[2]
    )]
    Branching {
        /// What the surface is made of in this format.
        noun: &'static str,
        /// Three that share the edge, as numbered in the file.
        numbers: [u64; 3],
        /// Middle of the edge (m).
        place: [f64; 3],
    },
    /// The surface has one side only, like a Möbius strip.
    #[error(
        "the surface has one side only, as a Möbius strip: it meets itself upside down at {} near ({:.4}, {:.4}, {:.4}) m",
        pair(.noun, .numbers), .place[0], .place[1], .place[2]
    )]
    OneSided {
        /// What the surface is made of in this format.
        noun: &'static str,
        /// Two that contradict each other, as numbered in the file.
        numbers: [u64; 2],
        /// Middle of their common edge (m).
        place: [f64; 3],
    },
    /// An open surface faces neither up nor down, so its side for the ply is unknown.
    #[error(
        "the open surface of {triangles} triangles at {noun} {number} faces sideways (mean of its normals: z = {upwards:.4}), the ply comes from above"
    )]
    Sideways {
        /// What the surface is made of in this format.
        noun: &'static str,
        /// Its first one, as numbered in the file.
        number: u64,
        /// How many triangles it has.
        triangles: usize,
        /// Vertical component of the mean of its normals, weighted by area.
        upwards: f64,
    },
}

impl MeshError {
    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            MeshError::Empty { .. } => "export the mold as a surface mesh".into(),
            MeshError::NoArea { .. } => "check the coordinates".into(),
            MeshError::Size { .. } => "state the unit that the file is written in".into(),
            MeshError::Scale { .. } => "give the meters of one unit of the file".into(),
            MeshError::Branching { noun, .. } => {
                format!("a mold is one skin: two {noun}s at an edge, or one at its boundary")
            }
            MeshError::OneSided { .. } => "cut it there".into(),
            MeshError::Sideways { .. } => {
                "turn the mold, or close its holes if it is meant to be a solid".into()
            }
        }
    }
}

/// Two triangles may come from one face.
fn pair(noun: &str, [a, b]: &[u64; 2]) -> String {
    if a == b { format!("{noun} {a}") } else { format!("{noun}s {a} and {b}") }
}
