"""`plydrape fit` and `span --theory exact` against SciPy, on strips that this file makes."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import program
import pytest
from scipy.integrate import solve_bvp

MASS, GRAVITY = 0.314, 9.81
WEIGHT = MASS * GRAVITY


def cantilever(length: float, rigidity: float, angle: float) -> np.ndarray:
    """Points [x, z] of a heavy strip that leaves its clamp at an angle: B θ'' = w (L − s) cos θ."""

    def rate(s: np.ndarray, y: np.ndarray) -> np.ndarray:
        theta, bend = y[:2]
        load = WEIGHT * (length - s) * np.cos(theta) / rigidity
        return np.vstack([bend, load, np.cos(theta), np.sin(theta)])

    def ends(a: np.ndarray, b: np.ndarray) -> np.ndarray:
        return np.array([a[0] - angle, b[1], a[2], a[3]])

    s = np.linspace(0, length, 200)
    y = np.zeros((4, s.size))
    for share in (0.01, 0.1, 0.3, 1.0):  # from a stiff strip to this one
        parts = np.array([[1], [share], [1], [1]])

        def softer(s: np.ndarray, y: np.ndarray, parts: np.ndarray = parts) -> np.ndarray:
            return np.asarray(rate(s, y) * parts)

        solution = solve_bvp(softer, ends, s, y, tol=1e-9, max_nodes=20000)
        assert solution.success
        s, y = solution.x, solution.y
    places = np.asarray(solution.sol(length * (np.arange(24) + 0.5) / 24))
    return places[2:].T


def fit(*arguments: str) -> dict[str, Any]:
    """Runs `plydrape fit`."""
    found: dict[str, Any] = json.loads(program.run("fit", *arguments, "--json").stdout)
    return found


def written(path: Path, points: np.ndarray, length: float) -> str:
    """Writes a strip as a table and gives its path."""
    rows = "\n".join(f"{1e3 * x!r},{1e3 * z!r}" for x, z in points.tolist())
    path.write_text(f"# mass = 314 g/m^2\n# length = {1e3 * length} mm\nx (mm),z (mm)\n{rows}\n")
    return str(path)


@pytest.mark.parametrize("rigidity", [2e-4, 1.5e-3])
def test_points_of_an_independent_elastica_give_its_rigidity(
    tmp_path: Path, rigidity: float
) -> None:
    """The elastica of SciPy has no line of code in common with that of the program."""
    points = cantilever(0.12, rigidity, 0.05)
    found = fit("hang", "--warp", written(tmp_path / "strip.csv", points, 0.12))
    assert found["bending_warp"]["rigidity"]["value"] == pytest.approx(rigidity, rel=3e-4)
    angle = found["bending_warp"]["strips"][0]["edge_angle"]["value"]
    assert angle == pytest.approx(0.05, abs=2e-4)


def test_noise_shows_in_the_interval(tmp_path: Path) -> None:
    """Of 20 strips with noise of 0.3 mm the intervals hold the rigidity in 19 ± 1."""
    clean = cantilever(0.12, 1.5e-3, 0.0)
    holds = 0
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(0, 3e-4, clean.shape)
        found = fit("hang", "--warp", written(tmp_path / "strip.csv", clean + noise, 0.12))
        low, high = found["bending_warp"]["rigidity"]["interval_95"]
        holds += low <= 1.5e-3 <= high
    assert holds >= 16


def test_all_reference_strips_hang_as_the_exact_elastica() -> None:
    """Force, sag, heights and end slopes of every case to 0.1 %."""
    for case in program.data("strip_cases.json")["cases"]:
        slopes = ["free" if slope is None else repr(slope) for slope in case["end_slopes"]]
        done = program.run(
            *("span", "--theory", "exact", "--json"),
            *("--run", f"{case['span_mm']} mm", "--rise", f"{case['rise_mm']} mm"),
            *("--length", f"{case['length_mm']} mm", "--weight", repr(case["w_N_per_m"])),
            *("--rigidity", repr(case["EI"])),
            *("--slope-start", slopes[0], "--slope-end", slopes[1]),
        )
        found, exact = json.loads(done.stdout), case["exact"]
        assert found["H_N"] == pytest.approx(exact["H_N"], rel=1e-3), case["id"]
        assert found["sag_mm"] == pytest.approx(exact["sag_vertical_mm"], rel=1e-3)
        scale = 1e-3 * exact["sag_vertical_mm"]
        assert found["z_mm"] == pytest.approx(exact["z_stations_mm"], rel=1e-3, abs=scale)
        assert found["slope_start"] == pytest.approx(exact["slope0"], rel=1e-3, abs=1e-3)
        assert found["slope_end"] == pytest.approx(exact["slope1"], rel=1e-3, abs=1e-3)


def test_what_is_written_is_a_material_that_is_read(tmp_path: Path) -> None:
    """Written whole, never over a file that exists."""
    (tmp_path / "o.csv").write_text("# mass = 314 g/m^2\noverhang (mm)\n61\n63\n62\n")
    overhangs = str(tmp_path / "o.csv")
    file = tmp_path / "mine.toml"
    program.run("fit", "overhang", "--warp", overhangs, "--weft", overhangs, "-o", str(file))
    done = program.run(
        *("span", "--run", "60 mm", "--length", "61 mm", "--material", str(file)),
        *("--width", "50 mm", "--json"),
    )
    assert json.loads(done.stdout)["state"] == "hanging"
    before = file.read_text()
    again = subprocess.run(
        [program.binary(), "fit", "overhang", "--warp", overhangs, "-o", str(file)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert again.returncode == 2
    assert "exists" in again.stderr
    assert file.read_text() == before


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("overhang (N)\n61\n", "is the unit of a force"),
        ("overhang (mm)\n61\nsixty\n", "is no finite number"),
        ("overhang (mm)\n61\n-3\n", "is not above zero"),
        ("length (mm)\n61\n", "the column `overhang` is missing"),
        ("overhang (mm)\n61\n", "the mass of the specimens is given nowhere"),
    ],
)
def test_a_broken_table_is_refused_with_a_remedy(tmp_path: Path, text: str, message: str) -> None:
    """With exit code 2, the fault and what to do."""
    (tmp_path / "o.csv").write_text(text)
    done = subprocess.run(
        [program.binary(), "fit", "overhang", "--warp", str(tmp_path / "o.csv")],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert message in " ".join(done.stderr.replace("│", " ").split())
    assert "help:" in done.stderr


PULL = [(4, 0.088), (8, 0.191), (12, 0.314), (16, 0.474), (20, 0.689), (24, 0.998), (28, 1.405)]


def test_a_table_of_a_laboratory_says_what_a_plain_one_says(tmp_path: Path) -> None:
    """German spreadsheets and testing machines: semicolons, decimal commas, text above, Latin-1."""
    plain, german = tmp_path / "plain.csv", tmp_path / "german.csv"
    rows = "".join(f"{x},{force}\n" for x, force in PULL)
    plain.write_text(f"displacement (mm),force (N)\n{rows}")
    rows = rows.replace(",", ";").replace(".", ",")
    head = '"Prüfer: Müller"\r\n"Standardweg";"Standardkraft"\r\n"mm";"N"\r\n'
    german.write_bytes((head + rows.replace("\n", "\r\n") + ";;\r\n").encode("latin-1"))
    measures = ("--width", "100 mm", "--length", "250 mm")
    found = [fit("bias", str(file), *measures)["shear"] for file in (plain, german)]
    assert found[0] == found[1]


def test_decimal_commas_between_commas_are_refused(tmp_path: Path) -> None:
    """A row of them has more fields than the header: a number is not read from half of one."""
    (tmp_path / "t.csv").write_text("displacement (mm),force (N)\n4,0,0,088\n8,0,0,191\n")
    done = subprocess.run(
        [program.binary(), "fit", "bias", str(tmp_path / "t.csv"), "--width", "100 mm"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    words = " ".join(done.stderr.replace("│", " ").split())
    assert "this row has 4 fields and the header 2" in words
    assert "separate the columns by semicolons" in words


def test_the_table_of_materials_is_current() -> None:
    """`scripts/materials` makes it anew."""
    done = subprocess.run(
        [str(program.ROOT / "scripts" / "materials"), "--check"],
        env={"PLYDRAPE": str(program.binary()), "PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
