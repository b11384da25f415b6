//! The command as a user runs it, as one program.

mod book;
mod broken_scenes;
mod check;
mod commands;
mod common;
mod compare;
mod drawing;
mod errors;
mod export;
#[cfg(unix)]
mod inputs;
mod limits;
mod net;
mod output_streams;
mod plan;
mod replan;
mod sheet;
mod simulate;
mod span;
mod study;
mod verdict;
