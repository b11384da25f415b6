"""What a notebook shows of a scene, a result, a plan's limits and a material."""

from __future__ import annotations

import html
import re
from typing import Any

import plydrape
import pytest
from program import ROOT

EXAMPLES = ROOT / "examples"


def card_of(value: Any) -> str:
    """What a notebook asks for."""
    return str(value._repr_html_())


def words(card: str) -> str:
    """The text of a card, without tags."""
    return " ".join(html.unescape(re.sub(r"<[^>]*>", " ", card)).split())


@pytest.fixture(scope="module")
def result() -> plydrape.Result:
    """The paper's example by its catenaries, which is not accepted."""
    scene = plydrape.Scene.read(EXAMPLES / "01_flat_sheared_mold" / "scene.toml")
    return plydrape.simulate(scene, model="catenaries")


def test_the_card_of_a_scene_says_what_is_laid_on_what() -> None:
    """With a picture of the array, which needs nothing from elsewhere."""
    card = card_of(plydrape.Scene.read(EXAMPLES / "04_dome" / "scene.toml"))
    assert "Dome scene grippers 4 × 4 material prepreg_warm mold sphere" in words(card)
    assert "<svg" in card and "http" not in card.replace("http://www.w3.org/", "")


def test_the_card_of_a_result_begins_with_its_verdict(result: plydrape.Result) -> None:
    """What is exceeded is in a table, with value, limit, step and place."""
    card = words(card_of(result))
    slack = result.limits["slack_ratio"]
    assert "not accepted" in card and not slack.kept
    assert f"{slack.label} {slack.value:.4g} % ≤ {slack.limit:g} % {slack.step}" in card
    assert slack.where in card
    assert slack.where in words(card_of(result.limits))


def test_the_card_of_a_material_says_where_its_rigidity_ends() -> None:
    """A material whose moment is a curve is not described by its rigidity at rest alone."""
    straight = words(card_of(plydrape.Material.shipped("cao2008_plain")))
    curved = plydrape.Material.shipped("broberg2022_strip")
    assert "at rest" not in straight and "moment" not in straight.split("source")[0]
    moment = curved.moment([20.0])
    assert moment is not None
    card = words(card_of(curved))
    assert "at rest" in card and f"moment at 20 1/m {moment[0, 0]:.4g} N along warp" in card


def test_a_title_is_text_on_its_card() -> None:
    """Not a part of the page around it."""
    scene = plydrape.Scene.read(EXAMPLES / "04_dome" / "scene.toml")
    card = card_of(scene.replace(title="<script>alert(1)</script>"))
    assert "<script" not in card and "&lt;script&gt;" in card
