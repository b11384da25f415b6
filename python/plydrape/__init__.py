"""How an array of grippers must move to lay a carbon-fibre ply on a curved mold without wrinkles.

The ply is a net of catenaries with bending stiffness hung between the grippers, after Krogh,
Jakobsen and Sherwood 2018. SI units throughout, z up; arrays are NumPy's.

Example:
    >>> import plydrape
    >>> scene = plydrape.Scene.read("examples/01_flat_sheared_mold/scene.toml")
    >>> result = plydrape.simulate(scene)
    >>> result.summary["first_contact_step"]
    26

"""

from plydrape import batch, study
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
from plydrape.study.error import StudyError

__all__ = [
    "CadError",
    "ClosestPoints",
    "Equilibrium",
    "ExtraError",
    "Jacobian",
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
    "materials",
    "measures",
    "outcome",
    "plan",
    "simulate",
    "study",
]
