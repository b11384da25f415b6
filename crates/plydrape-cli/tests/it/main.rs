//! The command as a user runs it, as one program.

mod broken_scenes;
mod check;
mod commands;
mod common;
mod doors;
mod export;
mod net;
mod plan;
mod simulate;
mod span;
mod study;
