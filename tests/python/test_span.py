"""`plydrape span` against closed forms evaluated by the oracle, and against the strip cases."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np
import oracle_span as span
import program
import pytest


@dataclass(frozen=True)
class Strip:
    """One span to solve (m, N/m, N m^2); None is a free slope."""

    run: float
    rise: float
    length: float
    weight: float
    rigidity: float
    slopes: tuple[float | None, float | None]

    def arguments(self) -> list[str]:
        """Flags of `plydrape span`, each number to its last digit."""
        first, second = ("free" if s is None else repr(s) for s in self.slopes)
        return [
            "span",
            f"--run={self.run!r} m",
            f"--rise={self.rise!r} m",
            f"--length={self.length!r} m",
            f"--weight={self.weight!r} N/m",
            f"--rigidity={self.rigidity!r} N m^2",
            f"--slope-start={first}",
            f"--slope-end={second}",
            "--json",
        ]

    def solved(self) -> Any:
        """What the program prints."""
        return json.loads(program.run(*self.arguments()).stdout)


def check_own_force(strip: Strip, got: Any) -> None:
    """The printed H, put into the oracle's closed form, gives the printed shape and the length.

    1e-9 relative to the sag and the length; where H lies so close to a buckling load that its own
    last digit moves the shape by more, 8 roundings of H are allowed for.
    """
    one, ends = span.spans(strip.run, strip.rise, strip.weight, strip.rigidity, strip.slopes)
    force = float(got["H_N"])
    h = np.array([force])

    # Length, and what a rounding of H does to it.
    value, slopes, _ = (np.real(part) for part in span.excess(one, h, ends))
    by_force = float(span.response(one, h, ends).excess_by[0, 0])
    grain = 8.0 * np.finfo(float).eps * abs(force)
    chord = float(one.chord[0])
    off = abs(chord + float(value[0]) - strip.length)
    assert off <= 1e-9 * strip.length + grain * abs(by_force), f"length off by {off} m"

    # Shape, and what a rounding of H does to it.
    share = np.linspace(0.0, 1.0, 11)[None, :]
    bumped = span.solve(one, h + 1j * span.STEP, ends, share)
    z = share[0] * strip.rise + np.real(bumped.height[0])
    by_force_z = np.abs(np.imag(bumped.height[0])) / span.STEP
    size = max(float(np.max(np.abs(np.real(bumped.height[0])))), 1e-3 * strip.run)
    np.testing.assert_allclose(np.array(got["x_mm"]) * 1e-3, share[0] * strip.run, atol=1e-12)
    gap = np.abs(np.array(got["z_mm"]) * 1e-3 - z)
    assert np.all(gap <= 1e-9 * size + grain * by_force_z), f"shape off by {gap.max()} m"

    # End slopes and sag.
    steep = max(1.0, float(np.max(np.abs(slopes))))
    by_force_s = np.abs(np.imag(bumped.slopes[0])) / span.STEP
    for end, key in enumerate(("slope_start", "slope_end")):
        allowed = 1e-9 * steep + grain * by_force_s[end]
        assert abs(got[key] - slopes[0, end]) <= allowed, key
    depth = span.sag(one, force, ends)
    allowed = 1e-9 * size + grain * float(by_force_z.max()) * 2.0
    assert abs(got["sag_mm"] * 1e-3 - depth) <= allowed, "sag"


def test_span_has_the_small_sag_values_of_the_strip_cases() -> None:
    """100 mm of fabric, solved by others to 1e-10; 1e-6 is the promise."""
    for case in program.data("strip_cases.json")["cases"]:
        first, second = case["end_slopes"]
        run, rise, length = (case[key] / 1e3 for key in ("span_mm", "rise_mm", "length_mm"))
        strip = Strip(run, rise, length, case["w_N_per_m"], case["EI"], (first, second))
        got, wanted = strip.solved(), case["small_sag"]
        assert got["H_N"] == pytest.approx(wanted["H_N"], rel=1e-6), case["id"]
        assert got["sag_mm"] == pytest.approx(wanted["sag_vertical_mm"], rel=1e-6), case["id"]
        np.testing.assert_allclose(
            got["z_mm"], wanted["z_stations_mm"], atol=1e-6 * wanted["sag_vertical_mm"]
        )
        check_own_force(strip, got)


def test_span_of_the_description_prints_every_key() -> None:
    """The command as documented, units and all: a free start, a prescribed end."""
    flags = "--run|98 mm|--rise|0|--length|100 mm|--weight|3.08014|--rigidity|9e-6"
    flags += "|--slope-start|free|--slope-end|0.5|--json"
    got = json.loads(program.run("span", *flags.split("|")).stdout)
    assert {"H_N", "sag_mm", "slope_start", "slope_end", "x_mm", "z_mm"} <= set(got)
    assert len(got["x_mm"]) == len(got["z_mm"]) == 11
    assert got["slope_end"] == pytest.approx(0.5, abs=1e-12)
    check_own_force(Strip(0.098, 0.0, 0.1, 3.08014, 9e-6, (None, 0.5)), got)


def random_strips(seed: int, count: int, least: float = 1e-3, most: float = 1e4) -> list[Strip]:
    """Strips over all weights, slacks, rises and stiffnesses; ``least`` and ``most``: k run.

    The rigidity follows from the force of the parabola of the same slack, so that k run is what a
    limp strip would have; a stiff one is in compression instead, near its buckling load.
    """
    rng = np.random.default_rng(seed)
    out = []
    for _ in range(count):
        run = float(10.0 ** rng.uniform(-2, 0.3))
        rise = float(rng.uniform(-0.5, 0.5) * run) if rng.random() < 0.7 else 0.0
        weight = float(10.0 ** rng.uniform(-3, 3))
        chord = float(np.hypot(run, rise))
        length = chord * (1.0 + float(10.0 ** rng.uniform(-4, np.log10(0.5))))
        load = weight * chord / run
        force = float(np.sqrt(load**2 * run**3 / (24.0 * (length - chord))))
        kl = float(10.0 ** rng.uniform(np.log10(least), np.log10(most)))
        rigidity = force * run**2 / kl**2
        # Prescribed slopes near a limp strip's: forced upward, it would be on another branch.
        limp = load * run / (2.0 * force)
        ends = [
            None if rng.random() < 0.4 else float(rise / run + sign * limp * rng.uniform(-0.2, 1.2))
            for sign in (-1.0, 1.0)
        ]
        out.append(Strip(run, rise, length, weight, rigidity, (ends[0], ends[1])))
    return out


@pytest.mark.parametrize("seed", range(8))
def test_printed_force_gives_the_printed_shape_and_length(seed: int) -> None:
    """50 random strips each: weights 1e-3 to 1e3 N/m, k run 1e-3 to 1e4, slack 1e-4 to 0.5."""
    for strip in random_strips(seed, 50):
        got = strip.solved()
        try:
            check_own_force(strip, got)
        except AssertionError as error:
            raise AssertionError(f"{strip}\n{got}\n{error}") from error


def test_printed_force_is_the_oracle_s_on_the_hanging_branch() -> None:
    """Where the oracle finds H by itself, from the first buckling load up: the same H."""
    for strip in random_strips(100, 60, least=1.0):
        one, ends = span.spans(strip.run, strip.rise, strip.weight, strip.rigidity, strip.slopes)
        wanted = span.force_for(one, ends, strip.length)
        assert strip.solved()["H_N"] == pytest.approx(wanted, rel=1e-8), strip


@pytest.mark.parametrize("seed", range(3))
def test_limp_strip_is_the_parabola(seed: int) -> None:
    """EI = 0: the parabola of the same length."""
    for strip in random_strips(200 + seed, 20):
        limp = Strip(strip.run, strip.rise, strip.length, strip.weight, 0.0, (None, None))
        check_own_force(limp, limp.solved())
