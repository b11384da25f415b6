//! What the engine does, as one program.

mod examples;
mod folders;
mod limits_table;
mod places;
mod verdicts;
