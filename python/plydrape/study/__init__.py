"""Studies: many scenes made of one, by a grid or a random sample of its numbers.

A study file (or a dict with the same keys) names a scene, what varies and how, and how many
scenarios there are. `run` drapes them all, on the cores of this machine or on a Dask cluster, and
gives one row a scenario: its inputs, its measures, its version and any error.

    definition.py   what a study file says, checked       (source.py, vary.py, keys.py)
    sample.py       the inputs of every scenario
    scenario.py     one scenario: its scene, its drape, its row     (errors.py)
    workers.py      scenarios in processes of this machine or on a Dask cluster
    folder.py       what is done is on the disk
    summary.py      distributions and what drives them
    run.py          from the definition to the rows and their summary     (outcome.py)

Needs `pip install dask distributed pandas pyarrow scipy`.

Examples
--------
>>> import plydrape.study
>>> study = plydrape.study.Study.of(
...     {
...         "scene": {
...             "ply": {"grippers": [2, 1], "cell": [0.1, 0.1], "material": "krogh2018"},
...             "grippers": {"spacing": ["98 mm", "98 mm"], "height": "75 mm"},
...             "motion": {"kind": "hold"},
...         },
...         "samples": 8,
...         "vary": {"ply.material.mass": {"relative": [0.8, 1.2]}},
...     }
... )
>>> outcome = plydrape.study.run(study, workers=1, progress=False)
>>> outcome.table().num_rows
8

"""

from .definition import Study
from .error import StudyError
from .outcome import Outcome, read
from .run import run

__all__ = ["Outcome", "Study", "StudyError", "read", "run"]
