"""How an array of grippers must move to lay a carbon-fiber ply on a curved mold without wrinkles.

The ply is a net of catenaries with bending stiffness hung between the grippers, after Krogh,
Jakobsen and Sherwood 2018. z is up; arrays are NumPy's.

Plain numbers are in SI units, angles in radians, both in arguments and in arrays. A str carries
its unit, as "100 mm" or "20 deg", wherever a single quantity is asked for. Names that end in a
unit are in that unit, as `tilts_deg` or `slack_mm`; values of limits are in their `unit`.

Examples
--------
>>> import plydrape
>>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
>>> result = plydrape.simulate(scene)
>>> result.summary["first_contact_step"]
26

"""

from plydrape import _html, _values, batch, study
from plydrape._plydrape import (
    ClosestPoints,
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
