//! A ply for the tests of planners.

use crate::material::{Material, Section};
use crate::ply::{Grid, Ply};

/// A ply of no matter what between the grippers of an array, 100 mm apart.
pub fn cloth(grid: Grid) -> Ply {
    let section = Section::Line { mass: 0.3, flexural_rigidity: 1e-5 };
    let material = Material { section, ..Material::woven("cloth", 0.3, 1e-5, 1e6, 0.0) };
    Ply::of_array(grid, [0.1; 2], Material { tension: None, shear_curve: None, ..material })
}
