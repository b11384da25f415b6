//! Files for other programs, each made from a result alone.

pub mod book;
pub mod comparison;
pub mod csv;
pub mod figure;
pub mod inp;
pub(crate) mod loads;
pub mod mold_patch;
pub mod net;
pub(crate) mod ngsolve;
pub mod pattern;
pub(crate) mod pose;
pub mod surface;
pub mod vtk;
