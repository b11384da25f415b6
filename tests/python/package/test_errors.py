"""Errors of a real cell: the same draws in Rust, in Python and in studies, and what they do."""

from __future__ import annotations

from typing import Any

import numpy as np
import plydrape
import pytest
from plydrape.study import Study
from plydrape.study.error import StudyError
from plydrape.study.scenario import Motion, Task, unit

SCENE: dict[str, Any] = {
    "ply": {"grippers": [3, 2], "cell": ["100 mm", "100 mm"], "material": "krogh2018"},
    "mold": {"kind": "plane"},
    "grippers": {"spacing": ["98 mm", "98 mm"], "height": "75 mm"},
    "target": {"shear": "10 deg"},
    "motion": {"kind": "straight", "steps": 4},
    "model": {"kind": "catenaries"},
}
ERRORS: dict[str, Any] = {
    "seed": 12345678901234567,
    "frame": {"position": {"bound": "1 mm"}, "angle": {"bound": "0.2 deg"}},
    "gripper": {"position": {"bound": "0.5 mm"}, "stroke": {"bound": "0.1 %"}},
    "pick_up": {"offset": {"deviation": "1 mm"}, "yaw": {"deviation": "0.2 deg"}},
    "material": {"areal_mass": {"deviation": "5 %"}, "length": {"bound": "0.1 %"}},
    "mold": {"offset": {"bound": "0.5 mm"}},
}
MASK = 0xFFFFFFFF


def scene(errors: dict[str, Any] | None = None) -> plydrape.Scene:
    """The scene with some errors."""
    return plydrape.Scene(**SCENE, errors=ERRORS if errors is None else errors)


def rotated(x: int, by: int) -> int:
    """32 bits, turned to the left."""
    return ((x << by) | (x >> (32 - by))) & MASK


def key(seed: int) -> list[int]:
    """Eight words of key from a seed by PCG32, as `rand_core` 0.6 documents `seed_from_u64`."""
    words = []
    for _ in range(8):
        seed = (seed * 6364136223846793005 + 11634580027462260723) % 2**64
        mixed = (((seed >> 18) ^ seed) >> 27) & MASK
        words.append(rotated(mixed, (32 - (seed >> 59)) % 32))
    return words


def block(seed: int, stream: int, counter: int) -> list[int]:
    """A block of ChaCha with 8 rounds, after Bernstein 2008; 64 bits of counter and stream."""
    halves = [counter & MASK, counter >> 32, stream & MASK, stream >> 32]
    start = [0x61707865, 0x3320646E, 0x79622D32, 0x6B206574, *key(seed), *halves]
    x = list(start)

    def quarter(a: int, b: int, c: int, d: int) -> None:
        for p, q, r, by in ((a, b, d, 16), (c, d, b, 12), (a, b, d, 8), (c, d, b, 7)):
            x[p] = (x[p] + x[q]) & MASK
            x[r] = rotated(x[r] ^ x[p], by)

    for _ in range(4):
        for n in range(4):
            quarter(n, 4 + n, 8 + n, 12 + n)
        for n in range(4):
            quarter(n, 4 + (n + 1) % 4, 8 + (n + 2) % 4, 12 + (n + 3) % 4)
    return [(a + b) & MASK for a, b in zip(x, start, strict=True)]


def even(seed: int, sample: int, quantity: int, gripper: int, n: int) -> float:
    """An even number from −1 to 1 at its place in the stream."""
    words = 64 * (16 * (64 * gripper + quantity) + n)
    low, high = block(seed, sample, words // 16)[:2]
    return 2 * ((high << 32 | low) >> 11) * 2.0**-53 - 1


def test_draws_are_the_numbers_of_chacha_at_their_places() -> None:
    """ChaCha written anew gives every bounded number of the frame and of the grippers."""
    seed = ERRORS["seed"]
    for sample in (0, 1, 77):
        draw = scene().draw(sample)
        for n in range(3):
            assert draw["frame"]["shift"][n] == pytest.approx(
                1e-3 * even(seed, sample, 0, 0, n), abs=1e-17
            )
            assert draw["frame"]["turn"][n] == pytest.approx(
                np.radians(0.2) * even(seed, sample, 1, 0, n), abs=1e-17
            )
        for g, gripper in enumerate(draw["grippers"]):
            for n in range(3):
                assert gripper["position"][n] == pytest.approx(
                    5e-4 * even(seed, sample, 2, g, n), abs=1e-17
                )
                assert gripper["stroke"][n] == pytest.approx(
                    1e-3 * even(seed, sample, 3, g, n), abs=1e-17
                )


def test_a_study_drapes_the_draw_of_its_number() -> None:
    """Scenario n is `with_errors(n)` of the scene, in its scene, its motion and its row."""
    study = Study.of({"scene": {**SCENE, "errors": ERRORS}, "samples": 3})
    for n in range(3):
        real = scene().with_errors(n)
        mine = study.scene(n)
        np.testing.assert_array_equal(mine.positions, real.positions)
        assert mine.ply.lengths.tolist() == real.ply.lengths.tolist()
        row = study.task.row(n, study.values[n])
        assert row["error"] is None
        draw = scene().draw(n)
        found = [row[f"errors.frame.position.{axis}"] for axis in "xyz"]
        assert found == draw["frame"]["shift"]
        assert row["errors.pick_up.yaw"] == draw["pick_up"]["yaw"]
        assert row["errors.material.length"] == draw["material"]["length"]
        offsets = np.array([gripper["position"] for gripper in draw["grippers"]])
        rms = np.sqrt((offsets**2).sum(axis=1).mean())
        assert row["errors.gripper.position.rms"] == pytest.approx(rms)
        assert set(study.names) <= set(row)
        drape = plydrape.simulate(real)
        assert row["accepted"] == drape.accepted
        assert row["worst_force_n"] == drape.summary["worst"]["force_n"]
    assert unit("errors.frame.angle.x", study.inputs) == "rad"


def test_a_study_of_a_plan_follows_it_with_the_errors_of_the_cell() -> None:
    """The commanded motion is the one that is followed; the cell moves it off by the same draw."""
    plain = scene()
    task = Study.of({"scene": {**SCENE, "errors": ERRORS}, "samples": 1}).task
    higher = plain.with_motion(plain.times, np.asarray(plain.positions) + np.array([0, 0, 0.01]))
    motion = Motion(np.asarray(higher.times), np.asarray(higher.positions))
    followed = Task(**{**vars(task), "command": "follow", "motion": motion})
    mine = followed.scene(4, ())
    np.testing.assert_array_equal(mine.positions, higher.with_errors(4).positions)


def test_gripper_errors_are_those_of_their_law() -> None:
    """Each coordinate of each gripper has one normal number, the same in all steps."""
    nominal = scene({"gripper": {"position": {"deviation": "1 mm"}}})
    moved = np.array([nominal.with_errors(n).positions - nominal.positions for n in range(400)])
    np.testing.assert_allclose(moved, moved[:, :1] + 0 * moved, atol=1e-15)
    # the root of the mean square of 7200 numbers is within 4/√14400 of the deviation
    assert np.sqrt((moved[:, 0] ** 2).mean()) == pytest.approx(1e-3, rel=0.034)


def test_a_factor_scales_all_errors() -> None:
    """Twice the factor is twice the draw, and none of it the nominal motion."""
    nominal = scene()
    assert np.array_equal(nominal.with_errors(3, factor=0).positions, nominal.positions)
    once, twice = nominal.draw(3), nominal.draw(3, factor=2.0)
    assert [2 * x for x in once["frame"]["shift"]] == twice["frame"]["shift"]
    frame = scene({"frame": {"position": {"bound": "1 mm"}}})
    shifts = [frame.with_errors(3, factor=f).positions - frame.positions for f in (1, 2)]
    np.testing.assert_allclose(2 * shifts[0], shifts[1], atol=1e-15)


def test_what_has_no_draw_says_so() -> None:
    """A scene without errors, a drawn one, a factor that is no number, a grid, no variation."""
    plain = plydrape.Scene(**SCENE)
    assert plain.errors is None
    for refused in (plain, scene().with_errors(0)):
        with pytest.raises(ValueError, match="no errors"):
            refused.with_errors(0)
    with pytest.raises(ValueError, match="finite"):
        scene().draw(0, factor=float("nan"))
    real = {**SCENE, "errors": ERRORS}
    with pytest.raises(StudyError, match="no grid"):
        Study.of({"scene": real, "sampling": "grid"})
    with pytest.raises(StudyError, match="nothing that varies"):
        Study.of({"scene": SCENE, "samples": 4})


def test_waves_lie_on_the_mold_of_the_draw() -> None:
    """A plane with waviness is a height of that root of the mean square, and still drapes."""
    waviness = {"waviness": {"deviation": "0.2 mm"}, "wavelength": "50 mm"}
    real = scene({"mold": waviness}).with_errors(0)
    assert real.mold is not None and real.mold.kind == "wavy"
    grid = np.stack(np.meshgrid(*2 * [np.arange(200) * 0.0123]), axis=-1).reshape(-1, 2)
    points = np.column_stack([grid, np.zeros(len(grid))])
    heights = -real.mold.closest_points(points).distances
    assert np.sqrt(np.mean(heights**2)) == pytest.approx(2e-4, rel=0.02)
    assert plydrape.simulate(real).summary["steps"] == 4
