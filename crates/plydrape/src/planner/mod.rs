//! How the grippers must move so that the ply lies where the ideal drape has it, without wrinkles.

pub mod board;
pub mod judge;
pub mod obstacles;
pub mod path;
mod stand_in;

pub use stand_in::{Memory, PlanError, Planned, plan};

use crate::draping::record::Verdict;

/// How far a search has come.
#[derive(Debug)]
pub struct Progress<'a> {
    /// Complete drapes tried.
    pub evaluations: usize,
    /// Most that the search may try.
    pub most: usize,
    /// What is being done.
    pub stage: &'static str,
    /// Limits of the best plan so far; empty before there is one.
    pub best: &'a [Verdict],
    /// Whether the best plan so far keeps them all.
    pub accepted: bool,
}
