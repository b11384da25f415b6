//! `plydrape.Solver`: finds how a ply hangs from its grippers.
//!
//! Without contact. What a ply does on a mold is a drape: `plydrape.simulate`.

use crate::arrays::Numbers;
use crate::equilibrium::{Equilibrium, State};
use crate::error;
use crate::ply::Ply;
use crate::quantity::Amount;
use crate::scene::Scene;
use plydrape::draping::spans;
use plydrape::equilibrium::{self, Status};
use plydrape::layup::{Settings, SlopeRule};
use plydrape::ply;
use plydrape_io::scene::{Measured, usual};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::f64::consts::FRAC_PI_2;
use std::sync::{Arc, Mutex, PoisonError};

/// Finds equilibria of a hanging ply, one after another: each starts from the last one.
///
/// Plain numbers are in SI units, a str carries its unit. A copy, also one in another process, begins without a last one.
///
/// Parameters
/// ----------
/// ply : Ply
///     What hangs.
/// slopes : {"moment-balance", "min-force"}, default "moment-balance"
///     How shared slopes are found: "moment-balance", or "min-force" as in Krogh et al. 2018.
/// axial_stiffness : float or str, default 100000.0
///     EA of a line of ply (N); infinite for an inextensible ply.
/// gravity : float or str, default 9.81
///     Acceleration of gravity (m/s²).
/// max_tilt : float or str, optional
///     Limit of the ball joints (rad).
///
/// Raises
/// ------
/// ValueError
///     If a number makes no sense.
///
/// Examples
/// --------
/// >>> ply = plydrape.Ply(grippers=[4, 1], cell=[0.1, 0.1], material="krogh2018")
/// >>> solver = plydrape.Solver(ply)
/// >>> equilibrium = solver.solve([[0.098 * i, 0, 0] for i in range(4)])
/// >>> equilibrium.status
/// 'converged'
/// >>> bool((equilibrium.forces > 0).all())
/// True
#[pyclass(frozen, module = "plydrape")]
pub struct Solver(pub Mutex<State>);

impl Solver {
    pub fn state(&self) -> std::sync::MutexGuard<'_, State> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// A solver that remembers nothing, for another thread.
    pub fn fresh(&self) -> equilibrium::Solver {
        let mut solver = self.state().solver.clone();
        solver.forget();
        solver
    }

    /// What it solves for.
    pub fn ply(&self) -> Arc<ply::Ply> {
        Arc::clone(&self.state().ply)
    }
}

#[pymethods]
impl Solver {
    #[new]
    #[pyo3(signature = (
        ply, *, slopes: "typing.Literal['moment-balance', 'min-force']" = "moment-balance",
        axial_stiffness: "float | str" = Amount::Number(1e5), gravity: "float | str" = Amount::Number(9.81),
        max_tilt: "float | str" = Amount::Number(40_f64.to_radians())
    ))]
    fn new(
        ply: &Ply,
        slopes: &str,
        axial_stiffness: Amount,
        gravity: Amount,
        max_tilt: Amount,
    ) -> PyResult<Self> {
        let axial_stiffness =
            axial_stiffness.positive("axial_stiffness", Measured::Force, &usual::Axial::USUAL)?;
        let gravity =
            gravity.positive("gravity", Measured::Acceleration, &usual::Gravity::USUAL)?;
        let max_tilt = max_tilt.positive("max_tilt", Measured::Angle, &usual::AnyAngle::USUAL)?;
        let slopes = match slopes {
            "moment-balance" => SlopeRule::MomentBalance,
            "min-force" => SlopeRule::MinForce,
            other => {
                let text =
                    format!("slopes is {other:?}; expected \"moment-balance\" or \"min-force\"");
                return Err(PyValueError::new_err(text));
            }
        };
        if max_tilt > FRAC_PI_2 * (1.0 - f64::EPSILON) {
            let text = format!("max_tilt is {max_tilt}; expected a positive number below π/2");
            return Err(PyValueError::new_err(text));
        }
        let settings =
            Settings { slopes, axial_stiffness, gravity, max_tilt, ..Settings::default() };
        Ok(Solver(Mutex::new(State::new(&ply.0, &settings))))
    }

    /// A solver for the ply of a scene, by its rules.
    ///
    /// Parameters
    /// ----------
    /// scene : Scene
    ///     The scene.
    ///
    /// Returns
    /// -------
    /// Solver
    ///     The solver.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> plydrape.Solver.of(scene).solve(scene.positions[0]).forces.shape
    /// (16,)
    #[staticmethod]
    fn of(scene: &Scene) -> Self {
        Solver(Mutex::new(State::new(&scene.0.layup.ply, &scene.0.layup.settings)))
    }

    /// Forgets the last equilibrium: the next one starts from nothing.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    /// >>> solver = plydrape.Solver.of(scene)
    /// >>> first = solver.solve(scene.positions[0]).forces
    /// >>> solver.forget()
    /// >>> bool((solver.solve(scene.positions[0]).forces == first).all())
    /// True
    fn forget(&self) {
        self.state().solver.forget();
    }

    /// Solves for the grippers where they are.
    ///
    /// Parameters
    /// ----------
    /// positions : array_like
    ///     Positions of the grippers (m), shape (grippers, 3), i running fastest, or of a whole array (along u, along v, 3).
    /// check : bool, default True
    ///     Whether an equilibrium that was not found is an error, or just says so in its `status`.
    ///
    /// Returns
    /// -------
    /// Equilibrium
    ///     The hanging ply.
    ///
    /// Raises
    /// ------
    /// ValueError
    ///     If the shape does not fit, a coordinate is not a number up to 10⁶ m, or neighbors are (all
    ///     but) straight above each other, where the model has no solution.
    /// SolveError
    ///     If no equilibrium was found.
    ///
    /// Examples
    /// --------
    /// >>> scene = plydrape.Scene.read("examples/02_hanging_strip/scene.toml")
    /// >>> plydrape.Solver.of(scene).solve([[0, 0, 0], [0.098, 0, 0]]).status
    /// 'converged'
    #[pyo3(signature = (positions, *, check = true))]
    fn solve(&self, positions: Numbers<'_>, check: bool) -> PyResult<Equilibrium> {
        let positions = positions.places("positions", &self.ply())?;
        let mut state = self.state();
        let fault = state.ply.check_places(&positions);
        fault.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        let contacts = Arc::clone(&state.contacts);
        let outcome = state.solver.solve(&positions, &contacts);
        if check && outcome.status != Status::Converged {
            let (status, residual) = (outcome.status.name(), outcome.residual);
            let text = format!(
                "no equilibrium was found ({status} after {} iterations: slopes are {residual:.1e} off their rule, \
                 lengths {:.1e} of themselves); look at the ply with check=False, or move the grippers less far apart",
                outcome.iterations, outcome.length_residual
            );
            return Err(error::solve(&text, status, outcome.iterations, residual));
        }
        let state = state.clone();
        let shape =
            spans::Equilibrium::new(&state.ply, &state.solver, outcome, &positions, &contacts);
        Ok(Equilibrium { state: Mutex::new(state), positions, shape })
    }
}
