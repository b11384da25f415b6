//! What the engine does with scenes that are read from files, and what it writes, as one program.

mod common;
mod constraint;
mod curved;
mod damaged_files;
mod draping;
mod equilibrium;
mod examples;
mod figure;
mod front;
mod gap;
mod infeasible_limits;
mod mesh;
mod mesh_files;
mod molds_in_scenes;
mod motion;
mod net;
mod plans;
mod reach;
mod results;
mod scenes;
mod sheet_examples;
mod sheet_fronts;
mod sheet_shown;
mod solve_status;
mod stepwise;
mod verdict;
