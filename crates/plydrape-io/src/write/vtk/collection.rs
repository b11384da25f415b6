//! ParaView's collection, `.pvd`: which file holds which part at which time.

use std::fmt::Write;

/// A series of files over time.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Collection {
    pub parts: Vec<Part>,
}

/// A file of a series.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Part {
    /// Time (s).
    pub time: f64,
    /// Number of the part, of those that share a time.
    pub part: usize,
    /// Name, as ParaView lists it.
    pub name: &'static str,
    /// Name of the file, beside the collection.
    pub file: String,
}

impl Collection {
    /// The whole file; times in the shortest form that reads back to the same double.
    pub fn text(&self) -> String {
        let mut text = String::from(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" \
             byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for Part { time, part, name, file } in &self.parts {
            let _ = writeln!(
                text,
                "<DataSet timestep=\"{time:?}\" group=\"\" part=\"{part}\" name=\"{name}\" file=\"{file}\"/>"
            );
        }
        text.push_str("</Collection>\n</VTKFile>\n");
        text
    }
}
