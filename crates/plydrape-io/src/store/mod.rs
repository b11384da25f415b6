//! What keeps files whole: folders that are written at once, JSON without NaN, regular files alone, sizes that fit the memory.

pub(crate) mod encoding;
pub(crate) mod file_kind;
pub mod folder;
pub mod format;
pub mod input;
pub mod json;
pub(crate) mod manifest;
pub mod shown;
pub mod size;
