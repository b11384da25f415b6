"""`plydrape fit` and `span --theory exact` against SciPy, on strips that this file makes."""

from __future__ import annotations

import json
import math
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import program
import pytest
from scipy.integrate import solve_bvp, solve_ivp

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


def specimen(width: float, length: float) -> list[tuple[float, float]]:
    """Displacement (mm) and force (N) of a bias extension of the law 10 g + 40 g^3 N/m."""

    def law(g: float) -> float:
        return 10 * g + 40 * g**3

    d, rows = length - width, []
    for degrees in range(2, 46, 2):
        g = math.radians(degrees)
        way = d * (math.sqrt(2) * math.cos(math.pi / 4 - g / 2) - 1)
        rate = d / 2 * (math.cos(g / 2) - math.sin(g / 2))
        power = width * (2 * length - 3 * width) / 2 * law(g) + width**2 * law(g / 2) / 2
        rows.append((1e3 * way, power / rate))
    return rows


def pulled(path: Path, rows: list[tuple[float, float]], above: str = "") -> str:
    """Writes a table of displacement and force and gives its path."""
    lines = "".join(f"{way:.4f},{force:.6f}\n" for way, force in rows)
    path.write_text(f"{above}displacement (mm),force (N)\n{lines}")
    return str(path)


SIZES = ("--width", "100 mm", "--length", "250 mm")
ROWS = specimen(0.1, 0.25)


def refused(*arguments: str) -> str:
    """What is printed when `plydrape fit` refuses, in one line."""
    done = subprocess.run(
        [program.binary(), "fit", *arguments], capture_output=True, text=True, check=False
    )
    assert done.returncode == 2, done.stdout
    return " ".join(done.stderr.replace("│", " ").split())


def at(shear: dict[str, Any], degrees: float) -> float:
    """The shear force of a fitted curve at an angle (N/m)."""
    return float(np.interp(math.radians(degrees), shear["angle"], shear["force"]))


def test_every_file_is_fitted_by_the_sizes_that_it_states(tmp_path: Path) -> None:
    """By hand, 10 g + 40 g^3 is 7.69 N/m at 25 deg and 25.8 N/m at 44 deg."""
    sizes = [(0.1, 0.25), (0.05, 0.15)]
    above = [f"# width = {1e3 * w} mm\n# length = {1e3 * h} mm\n" for w, h in sizes]
    files = [
        pulled(tmp_path / f"{n}.csv", specimen(*size), above[n]) for n, size in enumerate(sizes)
    ]
    for order in (files, files[::-1]):
        shear = fit("bias", *order)["shear"]
        assert at(shear, 25) == pytest.approx(7.69, rel=0.005)
        assert at(shear, 44) == pytest.approx(25.8, rel=0.005)
        assert shear["scatter"] < 0.002
    assert "the file states another width than --width" in refused("bias", *files, *SIZES)
    silent = pulled(tmp_path / "silent.csv", ROWS)
    assert "the width of the specimens is given nowhere" in refused("bias", files[0], silent)


def in_time(path: Path, speed: float, pull: float, hold: float) -> str:
    """A strip with 20 g + 60 g^3 N/m, and resin of 150 N/m per rad and 0.8 s: pulled, held."""
    width, length, stiffness, relaxation = 0.1, 0.25, 150.0, 0.8

    def gamma(way: float) -> float:
        cosine = (length - width + way) / (math.sqrt(2) * (length - width))
        return math.pi / 2 - 2 * math.acos(cosine)

    def slope(way: float) -> float:
        return (gamma(way + 1e-7) - gamma(way - 1e-7)) / 2e-7

    def flow(t: float, q: np.ndarray) -> np.ndarray:
        turning = slope(speed * t) * speed if t < pull else 0.0
        return np.asarray(stiffness * turning * np.array([1, 0.5]) - q / relaxation)

    times = np.linspace(0, pull + hold, 40)
    q = solve_ivp(flow, (0, times[-1]), [0, 0], t_eval=times, rtol=1e-9, max_step=0.01).y
    lines = []
    for t, middle, corner in zip(times, *q, strict=True):
        way = speed * min(t, pull)
        g = gamma(way)
        # areas that shear by g and by g/2, times how fast these grow with the way
        whole = width * (length - 1.5 * width) * (20 * g + 60 * g**3 + middle)
        corners = 0.5 * width**2 * (10 * g + 60 * (g / 2) ** 3 + corner)
        lines.append(f"{t:.5f},{1e3 * way:.5f},{slope(way) * (whole + corners):.6f}\n")
    path.write_text("time (s),displacement (mm),force (N)\n" + "".join(lines))
    return str(path)


def test_strips_in_time_give_their_resin_back(tmp_path: Path) -> None:
    """Stiffness, relaxation and curve come back within 1 %; dry strips are refused."""
    slow = in_time(tmp_path / "slow.csv", 0.5e-3, 60, 0)
    fast = in_time(tmp_path / "fast.csv", 20e-3, 1.5, 3)
    found = fit("rate", slow, fast, *SIZES)
    rate = found["shear_rate"]
    assert rate["stiffness"]["value"] == pytest.approx(150, rel=0.01)
    assert rate["relaxation"]["value"] == pytest.approx(0.8, rel=0.01)
    law = math.radians(25)
    assert at(rate, 25) == pytest.approx(20 * law + 60 * law**3, rel=0.01)
    assert 'relaxation = "0.8' in found["toml"] or 'relaxation = "0.79' in found["toml"]
    timeless = pulled(tmp_path / "timeless.csv", ROWS, "# width = 100 mm\n# length = 250 mm\n")
    assert "time" in refused("rate", timeless)
    dry = tmp_path / "dry.csv"
    rows = "".join(f"{n},{way:.4f},{force:.6f}\n" for n, (way, force) in enumerate(ROWS))
    dry.write_text("time (s),displacement (mm),force (N)\n" + rows)
    assert "do not depend on how fast" in refused("rate", str(dry), *SIZES)


def test_frames_and_strips_have_their_own_measures(tmp_path: Path) -> None:
    """Frames of two sizes show one law; a strip of twice the mass is twice as stiff."""
    law = [math.radians(degrees) for degrees in range(2, 46, 2)]
    files = []
    for side in (0.2, 0.1):
        rows = []
        for g in law:
            half = (math.pi / 2 - g) / 2
            way = 2 * side * (math.cos(half) - math.sqrt(0.5))
            rows.append((1e3 * way, side * 20 * g / math.sin(half)))
        files.append(pulled(tmp_path / f"{side}.csv", rows, f"# side = {side} m\n"))
    shear = fit("frame", *files)["shear"]
    assert at(shear, 25) == pytest.approx(20 * math.radians(25), rel=1e-3)
    assert shear["scatter"] < 1e-4
    for name, mass in (("warp", 300), ("weft", 600)):
        (tmp_path / name).write_text(f"# mass = {mass} g/m^2\noverhang (mm)\n60\n")
    found = fit("overhang", "--warp", str(tmp_path / "warp"), "--weft", str(tmp_path / "weft"))
    stiff = [found[f"bending_{along}"]["rigidity"]["value"] for along in ("warp", "weft")]
    assert stiff[1] == pytest.approx(2 * stiff[0])
    assert "different masses" in found["notes"][0]


def test_what_follows_the_loading_is_left_out_and_named(tmp_path: Path) -> None:
    """The curve of the loading alone, and the lines that are no part of it."""
    alone = fit("bias", pulled(tmp_path / "alone.csv", ROWS), *SIZES)
    assert alone["notes"] == []
    slipped = [(ROWS[-1][0] + 0.8 * n, 0.05) for n in range(1, 8)]
    back = [(way, 0.3 * force) for way, force in ROWS[-2::-1]]
    for rest, note in (
        (slipped, "lines 24 to 30 are left out, because the force has fallen from its peak"),
        (back, "lines 24 to 44 are left out, because the machine runs back there"),
    ):
        file = pulled(tmp_path / "record.csv", ROWS + rest)
        found = fit("bias", file, *SIZES)
        assert found["shear"] == alone["shear"]
        assert note in found["notes"][0]
        assert note in program.run("fit", "bias", file, *SIZES).stdout


@pytest.mark.parametrize(
    ("rows", "message"),
    [
        ([(way, -force) for way, force in ROWS], "the load is below zero"),
        ([(way, force - 2) for way, force in ROWS], "the load is below zero"),
        ([(0, 2.0), *((way, force + 2) for way, force in ROWS)], "there is a load where nothing"),
        (ROWS + ROWS, "the record goes back and begins to rise again"),
        ([(way + 120, force) for way, force in ROWS], "shears between 0 and 62.1 mm"),
        ([(-way, force) for way, force in ROWS], "are from -45.3 to -2.6 mm"),
    ],
)
@pytest.mark.parametrize("test", [("bias", *SIZES), ("frame", "--side", "106 mm")])
def test_what_no_specimen_does_is_refused(
    tmp_path: Path, test: tuple[str, ...], rows: list[tuple[float, float]], message: str
) -> None:
    """A frame of 106 mm allows the same way as the strip, 62.1 mm."""
    file = pulled(tmp_path / "record.csv", rows)
    found = refused(*test, file)
    assert message in found
    assert "record.csv:" in found
    assert "help:" in found


@pytest.mark.parametrize(
    ("header", "titles"),
    [
        ("Tensile extension (mm),Load (N)", ()),
        ("Axial Displacement(mm),Axial Force(N)", ()),
        ("Displacement_(mm),Force_(N)", ()),
        ("Déplacement (mm),Force (N)", ()),
        ("Channel 1 (mm),Channel 2", ("--displacement", "Channel 1", "--force", "Channel 2 (N)")),
    ],
)
def test_titles_of_machines_are_read_and_others_are_named(
    tmp_path: Path, header: str, titles: tuple[str, ...]
) -> None:
    """All of them say what the plain table says, in each encoding."""
    file = tmp_path / "record.csv"
    plain = fit("bias", pulled(file, ROWS), *SIZES)["shear"]
    text = file.read_text().replace("displacement (mm),force (N)", header)
    for data in (
        text.encode(),
        text.encode("utf-8-sig"),
        text.encode("latin-1"),
        text.encode("utf-16"),
        text.replace("\n", "\r").encode(),
    ):
        file.write_bytes(data)
        assert fit("bias", str(file), *SIZES, *titles)["shear"] == plain
    file.write_bytes(text.encode() + b"\0")
    assert "is a NUL byte" in refused("bias", str(file), *SIZES, *titles)


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
