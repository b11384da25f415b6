"""Programs are held to what scene files are.

Positions without a solution are refused, with place, value and remedy.
"""

from pathlib import Path

import numpy as np
import plydrape
import pytest

ROOT = Path(__file__).resolve().parents[3]
EXAMPLES = ROOT / "examples"
FAR = [np.nan, np.inf, -np.inf, 1e159, 1e200, -1.1e6]


def strip() -> plydrape.Scene:
    """Two grippers, no mold."""
    return plydrape.Scene.read(EXAMPLES / "02_hanging_strip" / "scene.toml")


@pytest.mark.parametrize("value", FAR)
def test_a_coordinate_out_of_all_range_is_refused_at_every_door(value: float) -> None:
    """What overflows was accepted once, and on a dome it never came back."""
    solver = plydrape.Solver.of(strip())
    far = [[0.0, 0.0, 0.0], [value, 0.0, 0.0]]
    with pytest.raises(ValueError, match="finite numbers"):
        solver.solve(far)
    with pytest.raises(ValueError, match="finite numbers"):
        plydrape.batch.equilibria(solver, [far])
    for name in ["02_hanging_strip", "04_dome", "05_cylinder"]:
        scene = plydrape.Scene.read(EXAMPLES / name / "scene.toml")
        positions = scene.positions.copy()
        positions[-1, 1, 0] = value
        with pytest.raises(ValueError, match="finite numbers"):
            scene.with_motion(scene.times, positions)


def test_grippers_at_one_place_are_refused_at_every_door() -> None:
    """A span straight up has no solution: once it converged, to a force that is no number."""
    scene = strip()
    solver = plydrape.Solver.of(scene)
    here = [[0.1, 0.2, 0.3]] * 2
    both = np.array([[[0, 0, 0], [0.098, 0, 0]], here])
    for call in (
        lambda: solver.solve(here),
        lambda: plydrape.batch.equilibria(solver, both),
        lambda: scene.with_motion([0.0], [here]),
    ):
        with pytest.raises(
            ValueError, match=r"g0_0 and g1_0 are only 0.000 mm apart.*move them apart"
        ):
            call()
    with pytest.raises(ValueError, match=r"positions\[1\]"):
        plydrape.batch.equilibria(solver, both)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_an_amount_that_is_not_finite_is_refused_at_every_door(value: float) -> None:
    """By the name of its argument; an axial stiffness alone may be infinite."""
    scene = plydrape.Scene.read(EXAMPLES / "04_dome" / "scene.toml")
    assert scene.mold is not None
    with pytest.raises(ValueError, match="run"):
        plydrape.Span(run=value, length=0.1, weight=3.0)
    with pytest.raises(ValueError, match="rise"):
        plydrape.Span(run=0.09, rise=value, length=0.1, weight=3.0)
    with pytest.raises(ValueError, match="gravity"):
        plydrape.Solver(scene.ply, gravity=value)
    with pytest.raises(ValueError, match="low"):
        scene.mold.patch((value, 0.0), (0.1, 0.1))


def test_the_fault_names_step_gripper_and_value() -> None:
    """Of positions and of times."""
    scene = plydrape.Scene.read(EXAMPLES / "01_flat_sheared_mold" / "scene.toml")
    positions = scene.positions.copy()
    positions[4, 5, 2] = 1e200
    with pytest.raises(ValueError, match=r"gripper g1_1 .*1e200.*in step 5.*up to 1e6 m"):
        scene.with_motion(scene.times, positions)
    times = scene.times.copy()
    times[7] = times[6]
    with pytest.raises(ValueError, match="time of step 8"):
        scene.with_motion(times, scene.positions)


def test_times_begin_at_zero_and_are_no_milliseconds() -> None:
    """Straight to its target the example takes 29 s, in milliseconds 3 um/s at most."""
    scene = plydrape.Scene.read(EXAMPLES / "01_flat_sheared_mold" / "scene.toml")
    with pytest.raises(ValueError, match=r"time of step 1 is 5.* begin at 0"):
        scene.with_motion(scene.times + 5, scene.positions)
    with pytest.raises(ValueError, match=r"did you mean ms\?.*slow=True"):
        scene.with_motion(1000 * scene.times, scene.positions)
    slow = scene.with_motion(1000 * scene.times, scene.positions, slow=True)
    assert slow.times[-1] == 1000 * scene.times[-1]


def test_plain_numbers_are_near_what_is_usual() -> None:
    """Millimeters are asked about, and a text with its unit is believed."""
    with pytest.raises(ValueError, match=r'run: .*did you mean "98 mm"'):
        plydrape.Span(run=98, length=0.1, weight=3.0)
    assert plydrape.Span(run="0.098 m", length=0.1, weight=3.0).run == 0.098
    ply = plydrape.Ply(grippers=[2, 2], cell=[0.1, 0.1], material="krogh2018")
    with pytest.raises(ValueError, match=r'max_tilt: .*did you mean "40 deg"'):
        plydrape.Solver(ply, max_tilt=40)


def test_what_is_far_too_large_is_refused_before_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    """The budget is the user's to raise."""
    scene = strip()
    steps = 20_000
    positions = np.repeat(scene.positions[:1], steps, axis=0)
    monkeypatch.setenv("PLYDRAPE_MEMORY", "1 MB")
    with pytest.raises(ValueError, match=r"20000 steps.*PLYDRAPE_MEMORY"):
        scene.with_motion(np.arange(steps), positions)
    monkeypatch.delenv("PLYDRAPE_MEMORY")
    assert scene.with_motion(np.arange(steps), positions).times.shape == (steps,)


def test_derivatives_that_are_far_too_large_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """They are one array of all catenaries by all coordinates of grippers."""
    scene = plydrape.Scene.read(EXAMPLES / "01_flat_sheared_mold" / "scene.toml")
    equilibrium = plydrape.Solver.of(scene).solve(scene.positions[0])
    monkeypatch.setenv("PLYDRAPE_MEMORY", "10 kB")
    refused = r"16 catenaries to 24 coordinates of 8 grippers.*PLYDRAPE_MEMORY"
    with pytest.raises(ValueError, match=refused):
        plydrape.outcome(scene)
    with pytest.raises(ValueError, match=refused):
        equilibrium.jacobian(wrt="grippers")
    assert equilibrium.jacobian(wrt="lengths").forces.shape == (16, 2)


def test_a_title_is_one_line_of_plain_text() -> None:
    """It goes to terminals, which obey control characters."""
    scene = strip()
    with pytest.raises(ValueError, match="control character"):
        scene.with_motion(scene.times, scene.positions, title="\x1b[31mred")


@pytest.mark.parametrize("door", [plydrape.simulate, plydrape.plan, plydrape.outcome])
@pytest.mark.parametrize("given", ["scene.toml", Path("scene.toml"), {"ply": {}}])
def test_what_is_no_scene_is_told_how_to_read_one(door: object, given: object) -> None:
    """The name of a file is no scene."""
    assert callable(door)
    with pytest.raises(TypeError, match=r'is no Scene: Scene\.read\("scene\.toml"\)'):
        door(given)


NO_NUMBERS = [
    (np.ma.array(np.zeros((2, 3)), mask=[[False] * 3, [False, False, True]]), "masked"),
    (np.zeros((2, 3), complex), "complex numbers"),
    (np.array([["0", "0", "0"], ["1", "0", "0"]]), "texts"),
    (np.array([["0", "0", "0"], ["1", "0", "0"]], object), "objects of Python"),
    (np.zeros((2, 3), "datetime64[s]"), "times of a calendar"),
]


@pytest.mark.parametrize(("array", "why"), NO_NUMBERS)
def test_what_is_no_array_of_numbers_is_refused_at_every_door(array: np.ndarray, why: str) -> None:
    """NumPy makes numbers of all of these, and leaves out what is masked or imaginary."""
    scene = strip()
    solver = plydrape.Solver.of(scene)
    triangles = [[0, 1, 2]]
    corners = array[[0, 1, 0]]
    for call in (
        lambda: solver.solve(array),
        lambda: plydrape.batch.equilibria(solver, array[None]),
        lambda: scene.with_motion([0.0], array[None]),
        lambda: plydrape.Mold.triangles(corners, triangles),
    ):
        with pytest.raises((TypeError, ValueError), match=why):
            call()


def test_an_array_with_a_mask_that_hides_nothing_is_an_array() -> None:
    """Integers and single precision too; an index that is not whole is none."""
    solver = plydrape.Solver.of(strip())
    places = [[0.0, 0.0, 0.0], [0.0625, 0.0, 0.0]]
    wanted = solver.solve(places)
    for given in (np.ma.array(places), np.array(places, np.float32)):
        assert repr(solver.solve(given)) == repr(wanted)
    with pytest.raises((TypeError, ValueError), match="not whole"):
        plydrape.Mold.triangles([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0.5, 1, 2]])


def test_points_that_were_seen_may_be_an_array() -> None:
    """The same pairs as lists, as an array and as texts move a plan alike."""
    scene = plydrape.Scene.read(EXAMPLES / "01_flat_sheared_mold" / "scene.toml")
    result = plydrape.plan(scene, without_errors=True).result
    pairs = [((0.0, 0.0), (0.001, 0.0)), ((0.3, 0.0), (0.301, 0.0)), ((0.3, 0.1), (0.301, 0.1))]
    texts = [tuple([f"{1e3 * x} mm" for x in place] for place in pair) for pair in pairs]
    moved = [result.replan(points=points).positions for points in (pairs, np.array(pairs), texts)]
    assert np.allclose(moved[0], moved[1], atol=0)
    assert np.allclose(moved[0], moved[2], atol=1e-12)
    with pytest.raises(ValueError, match=r"shape \(n, 2, 2\)"):
        result.replan(points=np.zeros((3, 2)))


def test_a_start_that_is_too_low_is_raised_with_a_warning() -> None:
    """The plan begins as much higher as the warning says, and touches nothing there."""
    scene = plydrape.Scene(
        ply={"grippers": [2, 2], "cell": ["100 mm", "100 mm"], "material": "prepreg_warm"},
        mold={"kind": "plane"},
        grippers={"spacing": ["98 mm", "98 mm"], "height": "5 mm"},
        target={},
        sheet={"mesh": "25 mm"},
        plan={"steps": 12, "evaluations": 2},
    )
    with pytest.warns(UserWarning, match="a plan starts .* mm higher") as caught:
        result = plydrape.plan(scene, without_errors=True).result
    raised = float(str(caught[0].message).split("a plan starts ")[1].split(" mm")[0])
    assert np.allclose(result.positions[0, :, 2], 5e-3 + 1e-3 * raised, atol=2e-5)
    assert result.summary["sheet"]["first_contact_step"] > 1


def test_a_ply_that_springs_back_is_warned_of_before_its_plan() -> None:
    """The plan that is made all the same leaves the ply higher than its limit once cups let go."""
    scene = plydrape.Scene(
        cell={"preset": "usual"},
        ply={"grippers": [3, 3], "cell": ["100 mm", "100 mm"], "material": "prepreg_warm"},
        mold={"kind": "sphere", "radius": "0.6 m", "position": [0, 0, "-0.6 m"]},
        grippers={"spacing": ["98 mm", "98 mm"], "height": "75 mm", "origin": "centered"},
        target={"seed": "middle"},
        contact={"friction": 0.3},
        sheet={"mesh": "20 mm"},
        plan={"steps": 24, "evaluations": 2},
    )
    with pytest.warns(UserWarning, match="no plan can keep this limit: height .* springs back"):
        result = plydrape.plan(scene, without_errors=True).result
    assert not result.accepted
    assert "height" in {limit["name"] for limit in result.summary["limits"] if not limit["ok"]}
