//! What can be wrong with a mesh file or its surface.

use crate::store::size::SizeError;
use plydrape::mold::MeshError;

/// Why a mesh file cannot serve as a mold. Lines and numbers count from 1, places are in meters.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileError {
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
    /// A face has so many corners that cutting it into triangles would take too long.
    #[error("{file}, line {line}: face {number} has {corners} corners; {most} are the most")]
    Corners {
        /// The file.
        file: String,
        /// The line.
        line: usize,
        /// The face.
        number: u64,
        /// Its corners.
        corners: usize,
        /// Most corners of a face.
        most: usize,
    },
    /// All faces together would take too long to cut.
    #[error(
        "{file}: its faces of up to {corners} corners would take too long to cut into triangles"
    )]
    Cutting {
        /// The file.
        file: String,
        /// Corners of its largest face.
        corners: usize,
    },
    /// The mesh would not fit the memory that is allowed.
    #[error("{file}: {source}")]
    Size {
        /// The file.
        file: String,
        /// What is too large.
        source: SizeError,
    },
    /// What the file holds is no mold.
    #[error("{file}: {source}")]
    Mesh {
        /// The file.
        file: String,
        /// What is wrong with its surface.
        source: MeshError,
    },
}

impl MeshFileError {
    /// What to do about it.
    #[must_use]
    pub fn remedy(&self) -> String {
        match self {
            MeshFileError::Unreadable { .. } => "check its name and its permissions".into(),
            MeshFileError::Format { .. } => "the name of a mesh ends in .stl, .obj or .inp".into(),
            MeshFileError::NotText { .. } => "save the file as plain text (UTF-8)".into(),
            MeshFileError::Ends { .. } | MeshFileError::Length { .. } => {
                "is the file complete? copy or export it once more".into()
            }
            MeshFileError::Vertex { vertices, .. } => format!("the file has {vertices} vertices"),
            MeshFileError::NodeTwice { .. } => "give it a number of its own".into(),
            MeshFileError::Keyword { remedy, .. } => (*remedy).into(),
            MeshFileError::Part { known, .. } => format!("parts are {known}"),
            MeshFileError::Corners { .. } | MeshFileError::Cutting { .. } => {
                "export the surface as triangles or quadrilaterals".into()
            }
            MeshFileError::Size { source, .. } => source.remedy().into(),
            MeshFileError::Mesh { source, .. } => source.remedy(),
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
