//! The format of result files: name and version, and what a file of it is called.

/// The file of a result in its folder.
pub(crate) const FILE: &str = "result.json";

/// Name of the format, the first key of every result file.
pub const FORMAT: &str = "plydrape-result";
/// Version of the format; it grows when a key changes its meaning.
pub const VERSION: u32 = 10;
