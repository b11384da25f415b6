//! The Python package `plydrape`: the library's nouns as classes, its arrays as NumPy's.
//!
//! The binding converts and computes nothing. A file here is a noun of the library; what is plain Python, such as
//! plots and studies, is in `python/plydrape`.

mod arrays;
mod batch;
mod beside;
mod drape;
mod equilibrium;
mod error;
mod fit;
mod jacobian;
mod json;
mod limits;
mod measure;
mod model;
mod mold;
mod net;
mod outcome;
mod pickle;
mod ply;
mod quantity;
mod result;
mod sample;
mod scene;
mod sheet;
mod solver;
mod span;
mod stations;
mod surface;
mod table;
mod work;

use pyo3::prelude::*;

/// The compiled part of `plydrape`.
#[pymodule]
mod _plydrape {
    #[pymodule_export]
    use crate::batch::{Equilibria, equilibria, simulate_all};
    #[pymodule_export]
    use crate::beside::Drape;
    #[pymodule_export]
    use crate::drape::{Plan, plan, simulate};
    #[pymodule_export]
    use crate::equilibrium::Equilibrium;
    #[pymodule_export]
    use crate::fit::fit;
    #[pymodule_export]
    use crate::jacobian::Jacobian;
    #[pymodule_export]
    use crate::measure::{Measure, measures};
    #[pymodule_export]
    use crate::mold::{ClosestPoints, Mold};
    #[pymodule_export]
    use crate::net::Net;
    #[pymodule_export]
    use crate::outcome::{Outcome, outcome};
    #[pymodule_export]
    use crate::pickle::{restore, state};
    #[pymodule_export]
    use crate::ply::{Material, Ply};
    #[pymodule_export]
    use crate::quantity::si;
    #[pymodule_export]
    use crate::result::Result;
    #[pymodule_export]
    use crate::sample::Sample;
    #[pymodule_export]
    use crate::scene::{Scene, materials};
    #[pymodule_export]
    use crate::sheet::Sheet;
    #[pymodule_export]
    use crate::solver::Solver;
    #[pymodule_export]
    use crate::span::Span;
    #[pymodule_export]
    use crate::surface::Surface;

    /// Version of the package and of the library in it.
    #[pymodule_export]
    #[allow(non_upper_case_globals)]
    const __version__: &str = env!("CARGO_PKG_VERSION");
}
