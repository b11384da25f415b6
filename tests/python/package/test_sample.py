"""Drapes with errors: the sample of a scene and what a motion tolerates, as Python sees them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import plydrape
import plydrape.study

SCENE: dict[str, Any] = {
    "ply": {"grippers": [4, 2], "cell": ["100 mm", "100 mm"], "material": "krogh2018"},
    "mold": {"kind": "plane"},
    "grippers": {"spacing": ["98 mm", "98 mm"], "height": "75 mm"},
    "target": {"shear": "10 deg"},
    "motion": {"kind": "straight", "steps": 6},
    "sheet": {"mesh": "50 mm"},
}
ERRORS: dict[str, Any] = {
    "samples": 5,
    "share": "60 %",
    "gripper": {"position": {"bound": "0.5 mm"}},
}
# every drape that ends is accepted: what is judged here are the numbers
LOOSE: dict[str, Any] = {
    "height": "1 m",
    "out_of_plane": "89 deg",
    "position": "1 m",
    "strain": "100 %",
    "fiber_angle": "89 deg",
}


def scene(**tables: Any) -> plydrape.Scene:
    """The scene with more tables."""
    return plydrape.Scene(**{**SCENE, **tables})


def test_a_sample_is_the_drapes_of_its_cells(tmp_path: Path) -> None:
    """Each height is that of the cell's own scene; 60 % of the cells keep the sample's.

    The motion is in its own time, because cells of a slow one share a flight.
    """
    judged = scene(errors=ERRORS, sheet={"mesh": "50 mm", "time": "real"})
    result = plydrape.simulate(judged)
    sample = result.sample
    assert sample is not None and sample.needed == 3
    count = len(sample)
    rank = math.ceil(0.6 * count) - 1
    cells = [plydrape.simulate(judged.with_errors(n)) for n in range(count)]
    heights = [cell.summary["final"]["height_mm"] for cell in cells]
    np.testing.assert_allclose(sample.heights_mm, heights, rtol=1e-12)
    assert sample.kept.tolist() == [cell.accepted for cell in cells]
    assert sample.accepted == sum(cell.accepted for cell in cells)
    assert sample.height_mm == np.sort(sample.heights_mm)[rank]
    assert (sample.ratios > 1).tolist() == [not kept for kept in sample.kept]

    # three cells decide, whether they keep the limits or not; the confidence is that of their count
    assert sample.kept.tolist().count(sample.ok) == 3 and sample.kept[-1] == sample.ok
    counts = range(sample.accepted) if sample.ok else range(sample.accepted + 1, count + 1)
    chances = [math.comb(count, n) * 0.6**n * 0.4 ** (count - n) for n in counts]
    np.testing.assert_allclose(sample.confidence, sum(chances), rtol=1e-12)

    # at each node the height of the same rank, in four digits
    ends = [cell.sheet.heights[-1] for cell in cells if cell.sheet is not None]
    ranked = np.sort(1e3 * np.maximum(ends, 0), axis=0)[rank]
    assert sample.spread_mm.shape == ranked.shape
    on_mold = ranked > 1e-3
    np.testing.assert_allclose(sample.spread_mm[on_mold], ranked[on_mold], rtol=1e-3)
    highest = sample.highest
    assert highest is not None and highest["gripper"].startswith("gripper g")
    np.testing.assert_allclose(highest["height_mm"], sample.spread_mm.max(), rtol=1e-3)

    result.write(tmp_path)
    again = plydrape.Result.read(tmp_path / "result.json")
    assert again.summary == result.summary and again.sample is not None
    np.testing.assert_array_equal(again.sample.spread_mm, sample.spread_mm)


def test_what_a_motion_tolerates_is_asked_where_a_scene_has_errors() -> None:
    """Millimeters and multiples; nothing without errors, or where they are left out."""
    result = plydrape.simulate(scene(errors=ERRORS, limits=LOOSE))
    tolerance = result.tolerance
    assert tolerance is not None and tolerance["gripper_mm"] >= 0
    if tolerance["tried"]:
        for least, most in (tolerance[name] for name in ("shear", "mass") if name in tolerance):
            assert 0.125 <= least <= 1 <= most <= 8
    assert plydrape.simulate(scene(limits=LOOSE)).tolerance is None
    left_out = plydrape.simulate(scene(errors=ERRORS), without_errors=True)
    assert left_out.sample is None and left_out.tolerance is None
    off = plydrape.simulate(scene(errors={**ERRORS, "samples": 0}))
    assert off.sample is None and off.tolerance is None


def test_a_plan_is_accepted_only_with_its_sample() -> None:
    """A plan that keeps its limits loses its verdict with grippers that are off by 20 mm."""
    tables: dict[str, Any] = {
        "ply": {"grippers": [2, 2], "cell": ["100 mm", "100 mm"], "material": "krogh2018"},
        "grippers": {"spacing": ["98 mm", "98 mm"], "height": "75 mm"},
        "target": {"origin": ["0 mm", "0 mm"]},
        "model": {"kind": "catenaries"},
        "plan": {"steps": 12, "evaluations": 30},
    }
    far = {"samples": 4, "gripper": {"position": {"bound": "20 mm"}}}
    plan = plydrape.plan(scene(errors=far, **tables))
    assert plan.result.sample is not None and not plan.result.sample.ok
    assert not plan.accepted and not plan.result.accepted
    without = plydrape.plan(scene(errors=far, **tables), without_errors=True)
    assert without.accepted and without.result.sample is None
    plain = plydrape.plan(scene(**tables))
    assert plain.accepted and plain.result.sample is None
    assert plain.result.tolerance is not None and plain.result.tolerance["gripper_mm"] > 0


def test_a_cell_gives_the_errors_mounts_and_release_that_a_scene_leaves_out() -> None:
    """As if they were written out; keys of the scene override them."""
    named = scene(cell={"preset": "usual"})
    written = scene(
        grippers={
            **SCENE["grippers"],
            "lip": {"radius": "15 mm", "rigidity": "0.0003 N m"},
            "stiffness": {"lateral": "2 N/mm", "axial": "2 N/mm"},
            "slip_force": "10 N",
            "holding_force": "20 N",
            "max_tilt": "40 deg",
        },
        release={"order": "hollows-first"},
        errors={
            "frame": {"position": {"bound": "0.5 mm"}},
            "gripper": {"position": {"deviation": "0.1 mm"}},
            "pick_up": {"offset": {"bound": "0.5 mm"}, "yaw": {"bound": "0.2 deg"}},
            "material": {
                "areal_mass": {"deviation": "5 %"},
                "bending": {"deviation": "30 %"},
                "shear": {"factor": 2},
                "length": {"deviation": "0.05 %"},
            },
        },
    )
    assert named.errors == written.errors is not None
    alone = plydrape.simulate(named, without_errors=True)
    slip = plydrape.simulate(written, without_errors=True).measures["slip_n"]
    # nothing slips after the release
    np.testing.assert_array_equal(alone.measures["slip_n"], slip)
    own = scene(cell={"preset": "usual"}, errors={"samples": 3}).errors
    assert own is not None and own["samples"] == 3 and own["material"]["shear"] == {"factor": 2}
    assert scene(cell={"preset": "ideal"}).errors is None


def test_a_study_draws_the_errors_of_the_cell_of_its_scene(tmp_path: Path) -> None:
    """Row n has the numbers of draw n; a term that varies is that of its scenario."""
    (tmp_path / "scene.toml").write_text(
        '[cell]\npreset = "usual"\n[ply]\ngrippers = [2, 2]\ncell = ["100 mm", "100 mm"]\n'
        'material = "dry_carbon"\n[mold]\nkind = "plane"\n'
        '[grippers]\nspacing = ["98 mm", "98 mm"]\nheight = "60 mm"\n[target]\n'
        '[motion]\nkind = "straight"\nsteps = 3\n[sheet]\nmesh = "50 mm"\n'
    )
    spec = {"values": ["0.05 mm", "0.2 mm"]}
    study = plydrape.study.Study.of(
        {
            "scene": str(tmp_path / "scene.toml"),
            "samples": 4,
            "vary": {"errors.gripper.position.deviation": spec},
        }
    )
    rows = plydrape.study.run(study, workers=1).table().to_pylist()
    drawn = plydrape.Scene.read(tmp_path / "scene.toml")
    for n, row in enumerate(rows):
        draw = drawn.draw(n)
        assert row["errors.material.shear"] == draw["material"]["shear"]
        assert row["errors.pick_up.yaw"] == draw["pick_up"]["yaw"]
        size = np.array([gripper["position"] for gripper in draw["grippers"]])
        rms = float(np.sqrt(np.mean(np.sum(size**2, axis=1))))
        # in the unit of the study, where the cell has 0.1 mm
        factor = row["errors.gripper.position.deviation"] / 0.1
        np.testing.assert_allclose(row["errors.gripper.position.rms"], factor * rms, rtol=1e-12)
