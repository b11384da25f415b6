//! The whole ply as a sheet of yarn segments and cells, between and beyond the grippers.

pub mod cholesky;
