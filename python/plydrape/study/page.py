"""The summary page: one HTML file without a script, for any browser, in light and dark.

From the whole to its parts: the share of accepted drapes; the limits, least often kept first;
each measure with its distribution and what drives it; what failed; the study as it was run.
"""

from __future__ import annotations

import json
from html import escape
from importlib import resources
from typing import Any

import numpy as np

import plydrape

from . import figures
from .definition import Study
from .labels import amount, is_least, name
from .outcome import Outcome
from .summary import flags, numbers

# Bars of correlations: half their width.
HALF = 60


def html(outcome: Outcome, study: Study) -> str:
    """The page of a study whose rows are complete."""
    about = outcome.summary
    judged = {key: m for key, m in about["measures"].items() if key.startswith("value_")}
    order = sorted(judged, key=lambda key: -(judged[key]["exceeded"] or 0.0))
    varying = [key for key in order if moves(judged[key])]
    still = [key for key in order if key not in varying]
    parts = [
        head(about, study),
        '<main><section class="top">',
        share(about),
        overview(about, {key: judged[key] for key in order}),
        "</section>",
        causes(about, outcome),
        "".join(card(key, about, outcome) for key in varying),
        constant(judged, still),
        failures(about),
        definition(study),
        "</main>",
    ]
    style = resources.files(__package__).joinpath("page.css").read_text(encoding="utf-8")
    title = escape(study.title)
    return (
        '<!doctype html>\n<html lang="en">\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{title} – study</title>\n<style>\n{style}</style>\n"
        + "\n".join(filter(None, parts))
        + "\n</html>\n"
    )


def moves(measure: dict[str, Any]) -> bool:
    """Whether a measure differs from scenario to scenario, by more than rounding."""
    at = measure["percentiles"]
    return bool(at["100"] - at["0"] > 1e-9 * max(abs(at["100"]), abs(at["0"])))


def label(key: str) -> str:
    """A label that may break behind a dot or an underscore."""
    text = escape(name(key))
    text = text[:1].upper() + text[1:] if key.startswith("value_") else text
    return text.replace(".", ".<wbr>").replace("_", "_<wbr>")


def percent(x: float) -> str:
    """A share in percent, with a digit behind the point.

    Examples
    --------
    >>> percent(0.1254)
    '12.5 %'

    """
    return f"{100 * x:.1f} %"


def head(about: dict[str, Any], study: Study) -> str:
    """Title, and what was run."""
    facts = [
        f"{about['scenarios']} scenarios",
        {
            "simulate": "each simulated",
            "plan": "each planned",
            "follow": "each following one finished plan",
        }[study.command],
        {"grid": "grid", "sobol": "Sobol sequence", "latin-hypercube": "Latin hypercube"}[
            study.sampling
        ],
        f"seed {study.seed}",
        f"plydrape {plydrape.__version__}",
    ]
    return (
        f"<header><h1>{escape(study.title)}</h1>"
        f'<p class="quiet">{" · ".join(map(escape, facts))}</p></header>'
    )


def share(about: dict[str, Any]) -> str:
    """The share of accepted drapes with its interval."""
    accepted = about["accepted"]
    failed = (
        f'<p class="failed">{about["failed"]} of {about["scenarios"]} scenarios failed</p>'
        if about["failed"]
        else '<p class="quiet">no scenario failed</p>'
    )
    if accepted["share"] is None:
        return f'<div class="share"><p class="big">–</p><p>nothing was draped</p>{failed}</div>'
    low, high = accepted["interval"]
    at = 100 * accepted["share"]
    bar = (
        f'<div class="meter" role="img" aria-label="accepted {percent(accepted["share"])}, '
        f'95 % interval {percent(low)} to {percent(high)}">'
        f'<i class="interval" style="left:{100 * low:.2f}%;width:{100 * (high - low):.2f}%"></i>'
        f'<i class="point" style="left:{at:.2f}%"></i></div>'
        '<div class="scale"><span>0</span><span>50</span><span>100 %</span></div>'
    )
    return (
        '<div class="share"><h2>Accepted drapes</h2>'
        f'<p class="big">{percent(accepted["share"])}</p>'
        f"{bar}<p>{accepted['count']} of {about['draped']} drapes keep every limit.</p>"
        f'<p class="quiet">95 % interval {percent(low)} to {percent(high)}</p>{failed}</div>'
    )


def overview(about: dict[str, Any], judged: dict[str, Any]) -> str:
    """The limits, least often kept first."""
    rows = []
    for key, m in judged.items():
        at, unit = m["percentiles"], escape(m["unit"])
        limit = "varies" if m["limit"] is None else amount(m["limit"])
        over = m["exceeded"] or 0.0
        by = label(m["driver"]) if m["driver"] else "–"
        text, extent = label(key), "always"
        if moves(m):
            text = f'<a href="#{key}">{text}</a>'
            extent = f"{amount(at['5'])} – {amount(at['95'])}"
        share = f"<b>{percent(over)}</b>" if over else '<span class="quiet">never</span>'
        rows.append(
            f"<tr><th>{text}</th>"
            f'<td class="over"><i style="width:{100 * over:.1f}%"></i>{share}</td>'
            f"<td>{limit}</td><td>{amount(at['50'])}</td>"
            f'<td>{extent}</td><td class="unit">{unit}</td>'
            f'<td class="by">{by}</td></tr>'
        )
    return (
        '<div class="limits"><h2>Limits</h2><table><thead><tr><th>measure</th><th>not kept in</th>'
        '<th>limit</th><th>median</th><th>5 – 95 %</th><th class="unit"></th>'
        '<th class="by">driven by</th></tr></thead>'
        f"<tbody>{''.join(rows)}</tbody></table></div>"
    )


def causes(about: dict[str, Any], outcome: Outcome) -> str:
    """What varied, and how strongly it goes with acceptance."""
    rows = []
    accepted = about["measures"].get("accepted", {}).get("correlations", {})
    for key, x in about["inputs"].items():
        if "percentiles" in x:
            at = x["percentiles"]
            extent = f"{amount(at['0'])} – {amount(at['100'])}"
        else:
            extent = ", ".join(sorted({str(v) for v in outcome.table()[key].to_pylist()}))
        rho = accepted.get(key)
        rows.append(
            f"<tr><th>{label(key)}</th><td>{escape(extent)}</td>"
            f'<td class="unit">{escape(x["unit"])}</td>'
            f'<td class="rho">{bar(rho, about["chance"])}</td></tr>'
        )
    note = (
        "Rank correlations run from −1 to +1. Gray bars, up to "
        f"±{about['chance']:.2f}, are what independent numbers show by chance."
    )
    if all(accepted.get(key) is None for key in about["inputs"]):
        note = "Every drape has the same verdict, so no input goes with it."
    return (
        '<section class="inputs"><h2>What varied</h2><table><thead><tr><th>input</th>'
        '<th>range</th><th class="unit"></th><th class="rho">rank correlation with acceptance</th>'
        f"</tr></thead><tbody>{''.join(rows)}</tbody></table>"
        f'<p class="quiet">{note}</p></section>'
    )


def bar(rho: float | None, chance: float) -> str:
    """A correlation as a bar from the middle, gray if it is no more than chance."""
    if rho is None:
        return '<span class="none">–</span>'
    width = abs(rho) * HALF
    left = HALF - width if rho < 0 else HALF
    kind = "weak" if abs(rho) <= chance else "strong"
    shown = f"{rho:+.2f}".replace("-", "−")
    return (
        f'<svg class="rho" viewBox="0 0 {2 * HALF} 12" aria-hidden="true">'
        f'<line class="axis" x1="{HALF}" x2="{HALF}" y1="0" y2="12"/>'
        f'<rect class="{kind}" x="{left:.1f}" y="2" width="{width:.1f}" height="8"/></svg>'
        f'<span class="{kind}">{shown}</span>'
    )


def card(key: str, about: dict[str, Any], outcome: Outcome) -> str:
    """One measure: its distribution, what drives it, and how."""
    m = about["measures"][key]
    limit_name = key.removeprefix("value_")
    rows = outcome.table()
    values = numbers(rows, key)
    assert values is not None
    known = np.isfinite(values)
    at_least = is_least(limit_name)
    text = label(key)
    picture = figures.histogram(values[known], m["limit"], at_least, m["unit"], name(key))

    related = {k: r for k, r in m["correlations"].items() if r is not None}
    ranked = sorted(m["correlations"], key=lambda k: -abs(related.get(k, 0.0)))
    bars = "".join(
        f'<tr><th>{label(k)}</th><td class="rho">'
        f"{bar(m['correlations'][k], about['chance'])}</td></tr>"
        for k in ranked[:8]
    )
    drawn = ""
    if related:
        cause = ranked[0]
        x = numbers(rows, cause)
        assert x is not None
        both = known & np.isfinite(x)
        oks = np.array([ok is not False for ok in flags(rows, f"ok_{limit_name}")])
        unit = about["inputs"][cause]["unit"]
        caption = f"over {name(cause)}" + (f" ({unit})" if unit else "")
        text = f"{name(key)} {caption}"
        drawn = (
            f"<figure><figcaption>{escape(caption)}</figcaption>"
            f"{figures.scatter(x[both], values[both], m['limit'], oks[both], text)}</figure>"
        )
    unit = f" ({escape(m['unit'])})" if m["unit"] else ""
    at = m["percentiles"]
    over = f"not kept in {percent(m['exceeded'])}" if m["exceeded"] else "always kept"
    return (
        f'<section class="card" id="{key}"><h2>{text}<span class="unit">{unit}</span>'
        f'<span class="{"failed" if m["exceeded"] else "kept"}">{over}</span></h2>'
        f'<div class="row"><figure><figcaption>median {amount(at["50"])}, '
        f"90 % within {amount(at['5'])} and {amount(at['95'])}</figcaption>{picture}</figure>"
        f"<figure><figcaption>rank correlation</figcaption><table>{bars}</table></figure>"
        f"{drawn}</div></section>"
    )


def constant(judged: dict[str, Any], still: list[str]) -> str:
    """Measures that are the same in every drape."""
    if not still:
        return ""
    constants = ", ".join(
        f"{escape(name(key))} {amount(judged[key]['mean'])} {escape(judged[key]['unit'])}"
        for key in still
    )
    return f'<section class="card"><h2>The same in every drape</h2><p>{constants}</p></section>'


def failures(about: dict[str, Any]) -> str:
    """What failed, by kind."""
    if not about["errors"]:
        return ""
    rows = "".join(
        f"<tr><td>{e['count']}</td><th>{escape(e['kind'])}</th><td>{escape(e['text'])}</td></tr>"
        for e in about["errors"][:20]
    )
    more = len(about["errors"]) - 20
    rest = f'<p class="quiet">and {more} more kinds</p>' if more > 0 else ""
    return (
        '<section class="failures"><h2>Failed scenarios</h2><p class="quiet">Numbers in a message '
        "are left out here; each row has its own in the column error.</p>"
        f"<table><tbody>{rows}</tbody></table>{rest}</section>"
    )


def definition(study: Study) -> str:
    """The study as it was run, on demand."""
    text = json.dumps(study.described(), indent=1, ensure_ascii=False)
    return (
        "<details><summary>The study as it was run</summary>"
        f'<p class="quiet">{escape(study.checksum)}</p><pre>{escape(text)}</pre></details>'
    )
