"""The shear map of a net: on the flat fabric, and on the mold from above."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from matplotlib.ticker import MaxNLocator

from plydrape.plot._page import BLACK, GRID, MM, RED, Page, breadth, plain, style

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from plydrape import Net, Result
    from plydrape.plot import Width

ROUND = [1, 2, 5, 10]


def figure(
    net: Net | Result, view: str, signed: bool, most: float | None, width: Width, title: str | None
) -> Page:
    """See `plydrape.plot.shear_map`."""
    if view not in ("both", "fabric", "plan"):
        raise ValueError(f'a shear map has the views "fabric", "plan" and "both", not "{view}"')
    nodes, shear, mesh = _arrays(net)
    value = shear if signed else np.abs(shear)
    top = float(np.nanmax(np.abs(shear))) if most is None else float(most)
    if not top >= 0.0:
        raise ValueError(f"the colors cannot end at {top:g} deg")
    top = max(top, 1e-3)
    scale = Normalize(-top if signed else 0.0, top)
    colors = "PuOr_r" if signed else "viridis"

    nu, nv = shear.shape
    u, v = (np.arange(n + 1) * step * 1e3 for n, step in zip((nu, nv), mesh, strict=True))
    flat = np.stack(np.broadcast_arrays(u[:, None], v[None, :]), axis=-1)
    above = nodes[..., :2] * 1e3
    panels = [("fabric", flat, "u", "v"), ("plan", above, "x", "y")]
    panels = [panel for panel in panels if view in ("both", panel[0])]

    # Panels side by side, on a narrow page one below the other.
    wide = breadth(width)
    side = len(panels) == 1 or wide > 120.0
    sizes = [np.nanmax(p[1], axis=(0, 1)) - np.nanmin(p[1], axis=(0, 1)) for p in panels]
    room = (wide - 18.0) / (len(panels) if side else 1) - 16.0
    heights = [np.clip(room * size[1] / size[0], 12.0, 1.15 * room) for size in sizes]
    high = (max(heights) + 16.0) if side else sum(heights) + 16.0 * len(panels)
    high += 8.0 if title else 2.0

    with style():
        page = Page(figsize=(wide * MM, high * MM), layout="compressed")
        shape = (1, len(panels)) if side else (len(panels), 1)
        engine = page.get_layout_engine()
        assert engine is not None
        rect = (0, 0, 1, 1 - (5.0 if title else 0.0) / high)
        engine.set(w_pad=0.08, h_pad=0.06, rect=rect)  # type: ignore[call-arg]
        axes = page.subplots(*shape, squeeze=False).ravel()
        names = {"fabric": "on the flat fabric", "plan": "on the mold, from above"}
        for letter, axis, (name, corners, right, up) in zip("ab", axes, panels, strict=False):
            _cells(axis, corners, value, scale, colors)
            _largest(axis, corners, shear, signed)
            tag = f"{letter}  " if len(panels) > 1 else ""
            even = (
                f": {np.nanmax(value):.1f}° everywhere" if _even(shear) and name == "fabric" else ""
            )
            axis.set_title(f"{tag}{names[name]}{even}", loc="left", pad=4)
            axis.set_xlabel(f"{right} (mm)")
            axis.set_ylabel(f"{up} (mm)")
        bar = page.colorbar(
            ScalarMappable(scale, colors),
            ax=list(axes),
            aspect=22,
            shrink=0.92,
            pad=0.02,
        )
        bar.set_label("shear, signed (°)" if signed else "shear (°)")
        bar.locator = MaxNLocator(6, steps=ROUND)
        plain(bar)
        bar.update_ticks()
        if title:
            page.suptitle(title, x=2.0 / wide, y=1.0 - 1.5 / high, ha="left", va="top")
    return page


def _arrays(net: Any) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Nodes (nu, nv, 3) in m, shear (nu - 1, nv - 1) in deg, mesh (2,) in m."""
    held = net if hasattr(net, "nodes") else net.net
    if held is None:
        raise ValueError(
            "this result has no ideal drape, so there is no net to map; give its scene a [target]"
        )
    nodes, shear = np.asarray(held.nodes, float), np.asarray(held.shear_deg, float)
    if shear.size == 0 or not np.isfinite(shear).any():
        raise ValueError(
            "no cell of the net has all its nodes on the mold, so there is no shear to map"
        )
    return nodes, shear, np.asarray(held.mesh, float)


def _cells(
    axis: Axes,
    corners: NDArray[np.float64],
    value: NDArray[np.float64],
    scale: Normalize,
    colors: str,
) -> None:
    """The cells as quadrilaterals in the color of their shear."""
    quads = np.stack(
        [corners[:-1, :-1], corners[1:, :-1], corners[1:, 1:], corners[:-1, 1:]], axis=2
    )
    whole = np.isfinite(value) & np.isfinite(quads).all(axis=(2, 3))
    cells = PolyCollection(
        list(quads[whole]), cmap=colors, norm=scale, edgecolors="face", linewidths=0.5
    )
    cells.set_array(value[whole])
    axis.add_collection(cells)
    axis.set_aspect("equal", adjustable="box", anchor="N")
    low, high = np.nanmin(corners, axis=(0, 1)), np.nanmax(corners, axis=(0, 1))
    edge = 0.02 * (high - low).max()
    axis.set_xlim(low[0] - edge, high[0] + edge)
    axis.set_ylim(low[1] - edge, high[1] + edge)
    axis.grid(color=GRID, lw=0.4)
    axis.set_axisbelow(True)
    axis.spines[["top", "right"]].set_visible(False)
    slim = (high - low).min() < 0.4 * (high - low).max()
    axis.xaxis.set_major_locator(MaxNLocator(5, steps=ROUND))
    axis.yaxis.set_major_locator(
        MaxNLocator(3 if slim and high[1] - low[1] < high[0] - low[0] else 5, steps=ROUND)
    )


def _largest(
    axis: Axes, corners: NDArray[np.float64], shear: NDArray[np.float64], signed: bool
) -> None:
    """A ring where the shear is largest, with its value; none where it is the same everywhere."""
    if _even(shear):
        return
    amount = np.abs(shear)
    i, j = np.unravel_index(int(np.nanargmax(amount)), shear.shape)
    x, y = corners[i : i + 2, j : j + 2].mean(axis=(0, 1))
    axis.plot(x, y, "o", ms=6, mfc="none", mec="white", mew=2.2, zorder=4)
    axis.plot(x, y, "o", ms=6, mfc="none", mec=RED, mew=1.1, zorder=5, gid="largest")
    low, high = np.nanmin(corners, axis=(0, 1)), np.nanmax(corners, axis=(0, 1))
    right, up = (-1 if at > mean else 1 for at, mean in zip((x, y), (low + high) / 2, strict=True))
    number = shear[i, j] if signed else amount[i, j]
    axis.annotate(
        f"{number:.1f}°".replace("-", "\u2212"),
        (x, y),
        (9 * right, 5 * up),
        textcoords="offset points",
        ha="left" if right > 0 else "right",
        va="center",
        fontsize=7,
        color=BLACK,
        zorder=6,
        bbox={"boxstyle": "round,pad=0.2", "fc": "white", "ec": "none", "alpha": 0.85},
    )


def _even(shear: NDArray[np.float64]) -> bool:
    """Whether the amount of shear is the same in all cells, but for rounding."""
    amount = np.abs(shear)
    return bool(np.nanmax(amount) - np.nanmin(amount) < 1e-6 * max(1.0, float(np.nanmax(amount))))
