"""How an array of grippers must move to lay a carbon-fiber ply on a curved mold without wrinkles.

One model of the ply drapes and decides: the whole ply as a sheet of cloth, or the net of catenaries
with bending stiffness between the grippers of Krogh, Jakobsen and Sherwood 2018. z is up; arrays
are NumPy's.

Plain numbers are in SI units, angles in radians, both in arguments and in arrays. A str carries
its unit, as "100 mm" or "20 deg", wherever a single quantity is asked for. Names that end in a
unit are in that unit, as `tilts_deg` or `slack_mm`; values of limits are in their `unit`.

Examples
--------
>>> import plydrape
>>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
>>> result = plydrape.simulate(scene)
>>> result.model, result.first_contact_step, result.accepted
('sheet', 22, False)

"""

from plydrape import _html, _values, batch, study
from plydrape._plydrape import (
    ClosestPoints,
    Drape,
    Equilibrium,
    Jacobian,
    Material,
    Measure,
    Mold,
    Net,
    Outcome,
    Plan,
    Ply,
    Result,
    Sample,
    Scene,
    Sheet,
    Solver,
    Span,
    Surface,
    __version__,
    fit,
    materials,
    measures,
    outcome,
    plan,
    simulate,
)
from plydrape.errors import (
    CadError,
    ExtraError,
    OutputError,
    PlanError,
    PlydrapeError,
    ResultError,
    SceneError,
    SolveError,
)
from plydrape.limits import Limit, Limits
from plydrape.study.error import StudyError

_values.give()
_html.give()

__all__ = [
    "CadError",
    "ClosestPoints",
    "Drape",
    "Equilibrium",
    "ExtraError",
    "Jacobian",
    "Limit",
    "Limits",
    "Material",
    "Measure",
    "Mold",
    "Net",
    "Outcome",
    "OutputError",
    "Plan",
    "PlanError",
    "Ply",
    "PlydrapeError",
    "Result",
    "ResultError",
    "Sample",
    "Scene",
    "SceneError",
    "Sheet",
    "SolveError",
    "Solver",
    "Span",
    "StudyError",
    "Surface",
    "__version__",
    "batch",
    "fit",
    "materials",
    "measures",
    "outcome",
    "plan",
    "simulate",
    "study",
]
