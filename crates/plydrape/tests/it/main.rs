//! What the engine does, as one program.

mod mold;
mod places;
mod span;
