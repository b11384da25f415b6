"""Studies that cannot be run are refused before anything runs, with key, value and remedy."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import plydrape.study
import pytest
from plydrape.study import Study, StudyError
from plydrape.study.__main__ import main
from studies import PAPER, grid, study, table, write


def vary(**more: Any) -> dict[str, Any]:
    """Keys with two underscores for dots, as a change of the study."""
    return {"vary": {key.replace("__", "."): spec for key, spec in more.items()}}


def nested(levels: int) -> list[Any]:
    """A list in a list in a list …"""
    inner: list[Any] = []
    for _ in range(levels):
        inner = [inner]
    return inner


HEIGHT = {"from": "60 mm", "to": "90 mm"}
REFUSED: list[tuple[dict[str, Any], list[str]]] = [
    ({"sample": 3}, ["`sample` is no key", "did you mean `samples`"]),
    ({"samples": 0}, ["`samples` = 0", "whole number of 1 or more"]),
    ({"samples": 2.5}, ["`samples` = 2.5"]),
    ({"samples": 10**12}, ["`samples` = 1000000000000", "3 PB", "max_scenarios = 1000000000000"]),
    (
        {"samples": 10**5000},
        ["`samples` = a int too long to show", "the largest is 9223372036854775807"],
    ),
    ({"samples": 9, "max_scenarios": 8}, ["`samples` = 9", "more than 8", "max_scenarios = 9"]),
    ({"max_scenarios": 0}, ["`max_scenarios` = 0"]),
    ({"samples": 2**31, "max_scenarios": 2**31, "sampling": "sobol"}, ["no 2147483648 points"]),
    ({"seed": 2**63}, ["`seed` = 9223372036854775808", "the largest is 9223372036854775807"]),
    ({"seed": float("inf")}, ["`seed` = inf"]),
    ({"title": nested(40)}, ["`title` = [[[", "is no text"]),
    ({"seed": -1}, ["`seed` = -1"]),
    ({"sampling": "sobel"}, ["'sobel'", "did you mean `sobol`"]),
    ({"command": "run"}, ["`command` = 'run'", '"simulate", "plan", "follow"']),
    ({"command": "follow"}, ["`plan` is missing", "scene.plan/result.json"]),
    ({"plan": "x"}, ["`plan` = 'x' goes with", "follow"]),
    ({"scene": "none.toml"}, ["'none.toml'", "no such file"]),
    ({"scene": 3}, ["`scene` = 3 is no scene"]),
    ({"vary": {}}, ["names nothing that varies"]),
    (vary(ply__materal__mass=HEIGHT), ["`ply` has no `materal`", "grippers, cell, material"]),
    (vary(grippers__heigth=HEIGHT), ["`grippers.heigth` cannot vary", "height"]),
    (vary(limit__tilt=HEIGHT), ["`limit.tilt` is no number of a scene", "mean `limits`"]),
    (vary(ply__cell=HEIGHT), ["`ply.cell` is no number but a list", "ply.cell.0, ply.cell.1"]),
    (vary(ply__cell__2=HEIGHT), ["list of 2", "`ply.cell.0` to `ply.cell.1`"]),
    (vary(ply__material__mass={"relative": [1.2, 0.8]}), ["empty range"]),
    (vary(grippers__height={"from": "6 cm", "to": "90 mm"}), ["different units"]),
    (vary(grippers__height={"from": "60 deg", "to": "90 deg"}), ["cannot vary", "length"]),
    (vary(grippers__height={"form": "60 mm", "to": "90 mm"}), ["is no law", "from"]),
    (vary(grippers__height={"values": []}), ["no values"]),
    (vary(grippers__height={"values": ["75 mm", "75 mm"]}), ["a value twice"]),
    (vary(grippers__height={"deviation": "0 mm"}), ["does not vary"]),
    (vary(grippers__height={"from": "sixty", "to": "90 mm"}), ["'sixty' is no number"]),
    (vary(grippers__height=75), ["`grippers.height` = 75 is no law"]),
    (vary(limits__tilt={"relative": [0.9, 1.1]}), ["the scene gives none"]),
    (vary(limits__tilt={"deviation": "1 deg"}), ["no mean"]),
    (vary(motion__kind={"relative": [0.9, 1.1]}), ["has 'straight'"]),
    (vary(plan__seed={"from": 1, "to": 9}), ["`plan.seed` changes nothing"]),
    (vary(motion__steps={"deviation": 3}), ["no law of whole numbers"]),
    (vary(grippers__height={"from": 1e400, "to": 2}), ["`grippers.height`: inf is no number"]),
    (vary(grippers__height={"from": "1e400 mm", "to": "2 mm"}), ["'1e400 mm' is no number"]),
    (vary(grippers__height={"from": "9" * 5000 + " mm", "to": "2 mm"}), ["'999", "999 mm' is no"]),
    (vary(grippers__height={"values": [10**400]}), ["`grippers.height`: 1000", "is no number"]),
    (vary(grippers__height={"from": "-1.7e308 m", "to": "1.7e308 m"}), ["1.8e308"]),
    (vary(grippers__height={"mean": "1e308 m", "deviation": "1e308 m"}), ["1.8e308"]),
    (vary(grippers__height={"relative": [1e308, 1.7e308]}), ["1e+308", "1.8e308"]),
    (vary(motion__steps={"from": 1, "to": 1e300}), ["`motion.steps`", "9007199254740992"]),
    (vary(motion__steps={"from": 1, "to": 10**30}), ["`motion.steps`", "9007199254740992"]),
    (vary(motion__steps={"values": [10, 2**62]}), ["`motion.steps`", "9007199254740992"]),
    (vary(placement={"deviation": "1 mm"}), ["`placement` is no key", "errors.gripper.position"]),
    (vary(ply__material={"values": ["krogh2018"]}, ply__material__mass=HEIGHT), ["within"]),
]


@pytest.mark.parametrize(("change", "words"), REFUSED, ids=[words[0] for _, words in REFUSED])
def test_a_wrong_study_is_refused(change: dict[str, Any], words: list[str]) -> None:
    """Each message has these words: the key, its value, and what would be right."""
    with pytest.raises(StudyError) as refused:
        study(**change)
    for word in words:
        assert word in str(refused.value)
    assert isinstance(refused.value, plydrape.PlydrapeError | ValueError)


def test_a_long_value_is_cut_in_a_message() -> None:
    """A hundred characters say which it is."""
    with pytest.raises(StudyError) as refused:
        study(**vary(grippers__height={"from": "9" * 5000 + " mm", "to": "2 mm"}))
    assert len(refused.value.message) < 200


def test_studies_may_be_larger_if_they_say_so() -> None:
    """The limit is a million; `max_scenarios` changes no row and no check sum."""
    with pytest.raises(StudyError, match=r"1000001 scenarios.* 3 GB .*max_scenarios = 1000001"):
        study(10**6 + 1)
    assert len(study(10**6 + 1, max_scenarios=10**6 + 1, sampling="sobol")) == 10**6 + 1
    assert study(5, max_scenarios=5).checksum == study(5).checksum


POINTS = {"from": "60 mm", "to": "90 mm", "points": 10**12}
ABSURD: list[tuple[dict[str, Any], str]] = [
    ({"samples": 10**12}, "`samples` = 1000000000000 makes"),
    ({"vary": {"grippers.height": POINTS}}, "the grid makes 1000000000000 scenarios"),
    (
        {"vary": {f"grippers.spacing.{k}": POINTS for k in (0, 1)}},
        "the grid makes about 1e24 scenarios",
    ),
    (
        {"vary": {"motion.steps": {"from": 1, "to": 10**9, "points": 10**9}}},
        "the grid makes 1000000000 scenarios",
    ),
]


@pytest.mark.parametrize(("change", "words"), ABSURD, ids=[words for _, words in ABSURD])
def test_an_absurd_number_of_scenarios_takes_no_memory(
    tmp_path: Path, change: dict[str, Any], words: str
) -> None:
    """It is refused with exit code 2 where 2 GB are all there is, before anything is made."""
    resource = pytest.importorskip("resource")
    path = write(tmp_path, **({"samples": 1} | change))
    if "samples" not in change:
        lines = path.read_text().splitlines()
        path.write_text("\n".join(["sampling = 'grid'", *(x for x in lines if "samples" not in x)]))
    done = subprocess.run(
        [sys.executable, "-m", "plydrape.study", str(path)],
        capture_output=True,
        text=True,
        timeout=60,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (2 * 10**9, 2 * 10**9)),
    )
    assert done.returncode == 2, done.stderr
    assert words in done.stderr and "max_scenarios = " in done.stderr
    assert not (tmp_path / "study.results").exists()


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (f"seed = {'9' * 5000}", "too many digits"),
        (f"title = {'[' * 5000}{']' * 5000}", "nested too deep"),
        (f"title = {'[' * 50}{']' * 50}", "is no text"),
        (f"[{'.'.join('a' * 5000)}]", "`a` is no key of a study"),
        (f"[vary.{'.'.join('a' * 5000)}]", "`scene` is missing"),
    ],
    ids=["digits", "brackets", "lists", "keys", "vary"],
)
def test_a_file_that_python_cannot_parse_is_one_message(
    tmp_path: Path, line: str, words: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2 with the file or the key; no traceback."""
    path = tmp_path / "study.toml"
    path.write_text(f"samples = 8\n{line}\n")
    assert main([str(path)]) == 2
    said = capsys.readouterr().err
    assert words in said and said.count("×") == 1 and "help: " in said


def test_a_grid_says_what_it_needs() -> None:
    """Points of a range; no number of samples, nothing normal."""
    for spec, words in (
        (HEIGHT, "add points = 5"),
        ({"deviation": "1 mm"}, "has no grid"),
        (HEIGHT | {"points": 0}, "points"),
        ({"values": ["60 mm"], "points": 2}, "has points"),
    ):
        with pytest.raises(StudyError, match=words):
            grid(grippers__height=spec)
    with pytest.raises(StudyError, match="`samples` = 24 says nothing to a grid"):
        study(sampling="grid", vary={"grippers.height": {"values": ["60 mm"]}})


def test_a_message_names_its_file(tmp_path: Path) -> None:
    """And the line, where the file is no TOML."""
    path = write(tmp_path, 8, seed=-2)
    with pytest.raises(StudyError, match=r"study\.toml: `seed` = -2"):
        Study.read(path)
    path.write_text("samples = \n")
    with pytest.raises(StudyError, match=r"line 1.*; write `key = value`"):
        Study.read(path)
    with pytest.raises(StudyError, match="no study"):
        Study.read(tmp_path / "absent.toml")


def test_a_wrong_scene_is_refused_with_its_own_message(tmp_path: Path) -> None:
    """As `plydrape check` says it, with the line."""
    scene = tmp_path / "scene.toml"
    scene.write_text(PAPER.read_text().replace('height = "75 mm"', 'height = "75"'))
    with pytest.raises(plydrape.SceneError, match="has no unit") as refused:
        study(scene=str(scene))
    assert refused.value.line == 16


def test_scenes_come_as_files_tables_and_scenes() -> None:
    """The three have the same rows."""
    scene = plydrape.Scene.read(PAPER)
    tables = {
        "title": scene.title,
        "ply": {"grippers": [4, 2], "cell": np.array([0.1, 0.1]), "material": "krogh2018"},
        "mold": {"kind": "plane"},
        "grippers": {"spacing": ["98 mm"] * 2, "height": "75 mm", "max_tilt": "40 deg"},
        "target": {"shear": "20 deg"},
        "motion": {"kind": "straight", "steps": 30, "duration": "29 s"},
        "model": {"kind": "catenaries", "slopes": "min-force", "gravity": 9.8},
        "contact": {"tolerance": "1 mm", "stepping": "once", "end": "free"},
    }
    made = [study(3, scene=given) for given in (str(PAPER), scene, tables)]
    drapes = [plydrape.simulate(each.scene(2)).summary for each in made]
    assert drapes[0] == drapes[1] == drapes[2]
    with pytest.raises(StudyError, match="no text"):
        study(scene=scene.with_motion(scene.times, scene.positions))


def test_a_plan_of_another_array_cannot_be_followed(tmp_path: Path) -> None:
    """It is seen before the first drape."""
    other = plydrape.Scene.read(PAPER.parents[1] / "02_hanging_strip" / "scene.toml")
    plydrape.simulate(other).write(tmp_path)
    with pytest.raises(StudyError, match="cannot follow"):
        study(command="follow", plan=str(tmp_path), vary={"model.gravity": {"values": [9.8, 1.6]}})


def test_a_plan_in_a_folder_of_two_runs_or_changed_since_is_not_followed(tmp_path: Path) -> None:
    """A study reads no other files of earlier runs, and refuses these as `plydrape report` does."""
    plydrape.simulate(plydrape.Scene.read(PAPER)).write(tmp_path)
    keys: dict[str, Any] = {"command": "follow", "plan": str(tmp_path)}
    keys |= {"vary": {"model.gravity": {"values": [9.8, 1.6]}}}
    assert study(**keys).motion is not None
    files, result = tmp_path / ".plydrape", tmp_path / "result.json"
    whole = files.read_text()
    files.write_text(whole.replace('"sealed":true', '"sealed":false'))
    with pytest.raises(
        plydrape.ResultError, match=r"are of two runs.*cut off.*run `plydrape simulate`"
    ):
        study(**keys)
    files.write_text(whole)
    result.write_text(result.read_text().replace('"time":1.0', '"time":1.5', 1))
    with pytest.raises(plydrape.ResultError, match="was changed since plydrape wrote it"):
        study(**keys)


def test_the_check_sum_is_of_what_rows_depend_on(tmp_path: Path) -> None:
    """Not of a comment or the folder; but of a number, the seed, and a file of the scene."""
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "ply.toml").write_text(plydrape.Material.text("krogh2018"))
    scene = tmp_path / "a" / "scene.toml"
    scene.write_text(PAPER.read_text().replace('"krogh2018"', '"ply.toml"'))
    heights: dict[str, Any] = {"vary": {"grippers.height": HEIGHT}}
    first = study(scene=str(scene), **heights).checksum
    scene.write_text("# a comment\n" + scene.read_text())
    assert study(scene=str(scene), **heights).checksum == first
    assert study(scene=str(scene), seed=2, **heights).checksum != first
    (tmp_path / "a" / "ply.toml").write_text(
        plydrape.Material.text("krogh2018").replace("0.3143", "0.3")
    )
    assert study(scene=str(scene), **heights).checksum != first


def test_a_missing_package_is_told_before_anything_runs(monkeypatch: pytest.MonkeyPatch) -> None:
    """In one message, with what to type."""
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(plydrape.ExtraError, match=r"pyarrow is missing.*pip install pyarrow"):
        plydrape.study.run(table(4))
