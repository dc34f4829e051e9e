"""Plots of change over disturbance: one picture per model, and one of all models."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np

mpl.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

Row = dict[str, Any]

STYLES = {
    "hlr": ("hlr, vertices jiggled", "#0b5fa5", "-", "o"),
    "hlr-turned": ("hlr, view turned", "#0b5fa5", "--", "s"),
    "poly": ("OpenCASCADE PolyAlgo, vertices jiggled", "#c8501e", "-", "^"),
    "exact-turned": ("OpenCASCADE exact, view turned", "#b8860b", "--", "v"),
}
FLOOR = 1e-6
"""Shares below this are drawn on the line marked 0: less than one sample of most drawings."""
SIDES = {"visible": ("lost_visible", "gained_visible"), "hidden": ("lost_hidden", "gained_hidden")}


def shares(rows: Sequence[Row], side: str) -> dict[float, list[float]]:
    """By amount, one share of the drawn length per seed."""
    found: dict[float, list[float]] = {}
    for row in rows:
        if "amount" in row and "lost_visible" in row:
            share = sum(row[name] for name in SIDES[side]) / (row["visible"] + row["hidden"])
            found.setdefault(row["amount"], []).append(share)
    return dict(sorted(found.items()))


def _panel(axes: Axes, rows: Sequence[Row], side: str) -> None:
    silent = 0
    for drawer, (label, color, line, marker) in STYLES.items():
        own = [row for row in rows if row["drawer"] == drawer]
        curve = shares(own, side)
        if not curve:
            if own:
                axes.text(1.5e-9, 0.3 / 3**silent, f"{label.split(',')[0]}: {own[-1]['failure']}", color=color, size=7)
                silent += 1
            continue
        x = np.array(list(curve))
        low, middle, high = (np.maximum([f(v) for v in curve.values()], FLOOR) for f in (min, np.median, max))
        axes.fill_between(x, low, high, color=color, alpha=0.12, linewidth=0)
        axes.plot(x, middle, line, color=color, marker=marker, markersize=3.5, linewidth=1.2, label=label)
    accuracy = next((row["accuracy"] for row in rows if "accuracy" in row), None)
    if accuracy:
        axes.axvline(accuracy, color="#555", linewidth=0.8, linestyle=":")
        axes.text(accuracy * 0.85, 0.8, "accuracy", rotation=90, size=7, color="#555", ha="right", va="top")
    axes.set(xscale="log", yscale="log", ylim=(FLOOR / 1.8, 1.5), xlim=(7e-10, 1.4e-3))
    ticks = [FLOOR, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1]
    axes.set_yticks(ticks, ["0", *(f"{100 * tick:g} %" for tick in ticks[1:])])
    axes.tick_params(labelsize=8)
    axes.minorticks_off()
    axes.grid(True, linewidth=0.3, color="#ccc")


def plot(rows: Sequence[Row], folder: Path) -> None:
    """`<model>.png` each and `stability.png`."""
    models = list(dict.fromkeys(row["model"] for row in rows))
    for model in models:
        own = [row for row in rows if row["model"] == model]
        figure, axes = plt.subplots(1, 2, figsize=(8.6, 3.9), sharey=True, layout="constrained")
        for side, panel in zip(SIDES, axes, strict=True):
            _panel(panel, own, side)
            panel.set_title(f"{side} ink", size=9)
            panel.set_xlabel("disturbance / size of the model", size=8)
        axes[0].set_ylabel("changed / drawn length", size=8)
        _finish(figure, model, axes[0], folder / f"{Path(model).stem}.png")
    figure, grid = plt.subplots(
        2,
        len(models),
        figsize=(2.3 * len(models) + 0.6, 5.4),
        sharex=True,
        sharey=True,
        squeeze=False,
        layout="constrained",
    )
    for column, model in enumerate(models):
        own = [row for row in rows if row["model"] == model]
        for row, side in enumerate(SIDES):
            _panel(grid[row][column], own, side)
            grid[row][0].set_ylabel(f"{side}: changed / drawn length", size=8)
        grid[0][column].set_title(model, size=7.5)
        grid[1][column].set_xticks([1e-9, 1e-6, 1e-3])
        grid[1][column].set_xlabel("disturbance / size", size=8)
    _finish(figure, "", grid[0][0], folder / "stability.png")


def _finish(figure: Any, title: str, axes: Axes, path: Path) -> None:
    handles, labels = axes.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=2, fontsize=8, frameon=False)
    if title:
        figure.suptitle(title, size=10)
    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)
