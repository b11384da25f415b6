//! Readers of formats that other programs write: meshes, drawings, formulas.

pub mod formula;
pub mod mesh;
pub mod outline;
pub mod urdf;
