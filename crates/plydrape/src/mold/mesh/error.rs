//! What can be wrong with a mesh file or its surface.

/// Why a mesh cannot serve as a mold. Lines and numbers count from 1, places are in metres.
#[derive(Debug, thiserror::Error)]
pub enum MeshError {
    /// The file cannot be opened or read.
    #[error("{file}: cannot be read: {source}")]
    Unreadable {
        /// The file.
        file: String,
        /// What the system says.
        source: std::io::Error,
    },
    /// The name of the file does not end as a mesh format.
    #[error("{file}: {}", ending(.extension))]
    Format {
        /// The file.
        file: String,
        /// How its name ends.
        extension: String,
    },
    /// A text file holds bytes that are no text.
    #[error("{file}, line {line}: bytes that are no text")]
    NotText {
        /// The file.
        file: String,
        /// The line of the first such byte.
        line: usize,
    },
    /// A line does not say what belongs there.
    #[error("{file}, line {line}: found `{found}`, expected {expected}")]
    Line {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// What stands there.
        found: String,
        /// What would be right.
        expected: String,
    },
    /// The file stops too early.
    #[error("{file}: the file ends at line {line}, expected {expected}")]
    Ends {
        /// The file.
        file: String,
        /// Its last line.
        line: usize,
        /// What is missing.
        expected: String,
    },
    /// A binary STL file is longer or shorter than its number of triangles asks.
    #[error(
        "{file}: a binary STL file of {triangles} triangles has {expected} bytes, this one has {bytes}"
    )]
    Length {
        /// The file.
        file: String,
        /// How many triangles its header announces.
        triangles: u32,
        /// How long it should be (bytes).
        expected: u64,
        /// How long it is (bytes).
        bytes: u64,
    },
    /// A coordinate is NaN or infinite.
    #[error("{file}: a coordinate of triangle {number} is {value}, expected a finite number")]
    NotFinite {
        /// The file.
        file: String,
        /// The triangle.
        number: u64,
        /// The coordinate.
        value: f64,
    },
    /// A face names a vertex that is not there.
    #[error("{file}, line {line}: face {number} uses vertex {vertex}")]
    Vertex {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The face.
        number: u64,
        /// The vertex it names.
        vertex: i64,
        /// How many vertices there are.
        vertices: usize,
    },
    /// An element names a node that is not there.
    #[error(
        "{file}, line {line}: element {element} uses node {node}, which {scope} does not define"
    )]
    Node {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The element.
        element: u64,
        /// The node it names.
        node: u64,
        /// Where the node should be defined.
        scope: String,
    },
    /// A node is defined twice, in two places.
    #[error(
        "{file}, line {line}: node {node} is defined again at another place; it stands in line {before} already"
    )]
    NodeTwice {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The node.
        node: u64,
        /// The line that defined it.
        before: usize,
    },
    /// A keyword that changes the geometry and is not understood.
    #[error("{file}, line {line}: {keyword} is not read")]
    Keyword {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The keyword.
        keyword: String,
        /// What to do about it.
        remedy: &'static str,
    },
    /// An instance of a part that is not there.
    #[error("{file}, line {line}: there is no part `{part}`")]
    Part {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The part that is named.
        part: String,
        /// The parts there are.
        known: String,
    },
    /// The file is in order and has no surface.
    #[error("{file}: no {noun}s{others}")]
    Empty {
        /// The file.
        file: String,
        /// What its surface would be made of.
        noun: &'static str,
        /// What there is instead.
        others: String,
    },
    /// All triangles have no area.
    #[error("{file}: none of the {triangles} triangles has an area; the mesh spans {size:.4} m")]
    NoArea {
        /// The file.
        file: String,
        /// How many triangles there are.
        triangles: usize,
        /// Diagonal of the box around all vertices (m).
        size: f64,
    },
    /// The mesh is no size for a mold.
    #[error("{file}: the mesh spans {size:.3e} m at {scale} m per unit, expected 1e-4 to 1e5 m")]
    Size {
        /// The file.
        file: String,
        /// Diagonal of the box around all vertices (m).
        size: f64,
        /// Metres per unit of the file.
        scale: f64,
    },
    /// The scale is no positive number.
    #[error(
        "{file}: a scale of {scale} m per unit, expected a positive number such as 0.001 for mm"
    )]
    Scale {
        /// The file.
        file: String,
        /// Metres per unit of the file.
        scale: f64,
    },
    /// Three or more triangles share an edge.
    #[error(
        "{file}: {noun}s {}, {} and {} share an edge near ({:.4}, {:.4}, {:.4}) m",
        .numbers[0], .numbers[1], .numbers[2], .place[0], .place[1], .place[2]
    )]
    Branching {
        /// The file.
        file: String,
        /// What the surface is made of in this format.
        noun: &'static str,
        /// Three that share the edge, as numbered in the file.
        numbers: [u64; 3],
        /// Middle of the edge (m).
        place: [f64; 3],
    },
    /// The surface has one side only, like a Möbius strip.
    #[error(
        "{file}: the surface has one side only, as a Möbius strip: it meets itself upside down at {} near ({:.4}, {:.4}, {:.4}) m",
        pair(.noun, .numbers), .place[0], .place[1], .place[2]
    )]
    OneSided {
        /// The file.
        file: String,
        /// What the surface is made of in this format.
        noun: &'static str,
        /// Two that contradict each other, as numbered in the file.
        numbers: [u64; 2],
        /// Middle of their common edge (m).
        place: [f64; 3],
    },
    /// An open surface faces neither up nor down, so its side for the ply is unknown.
    #[error(
        "{file}: the open surface of {triangles} triangles at {noun} {number} faces sideways (mean of its normals: z = {upwards:.4}), the ply comes from above"
    )]
    Sideways {
        /// The file.
        file: String,
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
            MeshError::Unreadable { .. } => "check its name and its permissions".into(),
            MeshError::Format { .. } => "the name of a mesh ends in .stl, .obj or .inp".into(),
            MeshError::NotText { .. } => "save the file as plain text (UTF-8)".into(),
            MeshError::Ends { .. } | MeshError::Length { .. } => {
                "is the file complete? copy or export it once more".into()
            }
            MeshError::Vertex { vertices, .. } => format!("the file has {vertices} vertices"),
            MeshError::NodeTwice { .. } => "give it a number of its own".into(),
            MeshError::Keyword { remedy, .. } => (*remedy).into(),
            MeshError::Part { known, .. } => format!("parts are {known}"),
            MeshError::Empty { .. } => "export the mold as a surface mesh".into(),
            MeshError::NoArea { .. } => "check the coordinates".into(),
            MeshError::Size { .. } => "state the unit that the file is written in".into(),
            MeshError::Scale { .. } => "give the metres of one unit of the file".into(),
            MeshError::Branching { noun, .. } => {
                format!("a mold is one skin: two {noun}s at an edge, or one at its border")
            }
            MeshError::OneSided { .. } => "cut it there".into(),
            MeshError::Sideways { .. } => {
                "turn the mold, or close its holes if it is meant to be a solid".into()
            }
            _ => "correct the file, or export the mold's surface anew".into(),
        }
    }
}

/// How a file name ends.
fn ending(extension: &str) -> String {
    match extension {
        "" => "the file name has no ending".to_owned(),
        _ => format!("the file name ends in .{extension}"),
    }
}

/// Two triangles may come from one face.
fn pair(noun: &str, [a, b]: &[u64; 2]) -> String {
    if a == b { format!("{noun} {a}") } else { format!("{noun}s {a} and {b}") }
}
