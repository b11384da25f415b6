//! What a drape leaves behind: the result file, tables and the figure.

pub mod result;
