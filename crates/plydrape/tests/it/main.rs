//! What the engine does, as one program.

mod folders;
mod mold;
mod places;
mod span;
mod verdicts;
