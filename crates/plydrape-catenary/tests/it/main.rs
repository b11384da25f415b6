//! What catenaries are, as one program.

mod span;
