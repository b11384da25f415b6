//! What molds are, as one program.

mod mold;
