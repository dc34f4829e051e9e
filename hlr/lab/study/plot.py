"""The plots: error over time with the Pareto front, and time by stage."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import Any

from hlr.errors import OptionError
from hlr.lab.study.frontier import frontier
from hlr.lab.study.job import EXACT, HLR, POLY, TIMED, WHO, ZBUFFER, Point
from hlr.lab.study.judge import NOTICED

STYLES = {HLR: ("#0b5fa5", "o"), POLY: ("#c8501e", "^"), EXACT: ("#b8860b", "D"), ZBUFFER: ("#5a8f3c", "s")}
STAGE_COLORS = {
    "tessellate": "#9db8d2",
    "scene": "#c9b8dc",
    "plan": "#e3d3a2",
    "visibility": "#0b5fa5",
    "linework": "#e08a5b",
}
FLOOR = 1e-5
"""Errors (mm) and shares below this are plotted at this value: the judge resolves nothing smaller."""

PANELS = (
    ("ink_p99", "visible ink: 99 % is nearer to the truth than, mm on paper"),
    ("wrong", f"visible ink more than {NOTICED:g} mm off, share"),
)


def _modules() -> tuple[Any, Any]:
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise OptionError("the plots of a study need matplotlib: pip install 'hlr-drawing[plot]'") from None
    return Figure, FigureCanvasAgg


def available() -> None:
    """Raises OptionError if matplotlib is not installed. Call it before measuring, which may take an hour."""
    _modules()


def _png(figure: Any) -> bytes:
    _, canvas = _modules()
    out = io.BytesIO()
    canvas(figure).print_figure(out, format="png", dpi=100, metadata={"Software": None})
    return out.getvalue()


def error_plot(points: Sequence[Point], title: str) -> bytes:
    """A PNG: error over processor seconds, both logarithmic, for the 99th percentile distance and the wrong share."""
    figure = _modules()[0](figsize=(11.0, 5.0), layout="constrained")
    for axes, (name, label) in zip(figure.subplots(1, 2), PANELS, strict=True):
        panel(axes, points, name)
        axes.set_title(label, fontsize=9)
    legend(figure)
    figure.suptitle(title, fontsize=11)
    return _png(figure)


def legend(figure: Any) -> None:
    """Draw one legend for all panels, below them."""
    handles, labels = figure.axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, fontsize=8, loc="outside lower center", ncols=5)


def panel(axes: Any, every: Sequence[Point], name: str) -> None:
    """Plot the error `name` over processor seconds, with the Pareto front, into the axes of a figure."""
    points = [p for p in every if p.failure is None and name in p.errors and p.processor > 0.0]
    best = frontier(points, name)
    if best:
        # No point is below and to the left of the front; to the right of its last point none is more accurate.
        x = [p.processor for p in best]
        y = [max(p.errors[name], FLOOR) for p in best]
        end = max(p.processor for p in points) * 1.3
        axes.step([*x, end], [*y, y[-1]], where="post", color="#888888", linewidth=7, alpha=0.25, label="frontier")
    for who in WHO:
        own = [p for p in points if p.who == who]
        color, mark = STYLES[who]
        if own:
            x, y = [p.processor for p in own], [max(p.errors[name], FLOOR) for p in own]
            axes.plot(x, y, color=color, marker=mark, markersize=5, linewidth=1.2, label=_legend(who))
            for k in _labelled(x, y):
                place = {"xytext": (5, 4), "textcoords": "offset points", "fontsize": 7, "color": color}
                axes.annotate(_mark(own[k]), (x[k], y[k]), **place)
    axes.set_xscale("log")
    axes.set_yscale("log")
    from matplotlib.ticker import LogLocator, NullFormatter

    # Tick labels also where the whole range lies within one decade.
    axes.xaxis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axes.xaxis.set_major_formatter("{x:g}")
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.set_xlabel("processor seconds, from shape to lines", fontsize=9)
    axes.grid(True, which="both", alpha=0.2)
    if name == "wrong":
        axes.set_ylim(0.6 * FLOOR, None)
        axes.set_yticks([FLOOR, 1e-4, 1e-3, 1e-2, 1e-1], ["none", "0.01 %", "0.1 %", "1 %", "10 %"])


def _legend(who: str) -> str:
    return {HLR: "hlr, by accuracy in mm", POLY: f"{POLY}, same deflection", ZBUFFER: "z-buffer, by pixels"}.get(
        who, who
    )


def _mark(point: Point) -> str:
    return "" if point.who == EXACT else f"{point.setting:g}"


CLOSE = 0.25
"""Decades, of both axes together, within which a second number would cover the first."""


def _labelled(x: list[float], y: list[float]) -> list[int]:
    """Indices of the points to be labelled: the first, and each that is far enough from the last labelled one."""
    out: list[int] = []
    for k in range(len(x)):
        if not out or math.hypot(math.log10(x[k] / x[out[-1]]), math.log10(y[k] / y[out[-1]])) > CLOSE:
            out.append(k)
    return out


def stage_plot(points: Sequence[Point], title: str) -> bytes:
    """A PNG: clock seconds by stage, stacked; one bar for each accuracy of hlr, and the rivals' bars beside them."""
    figure = _modules()[0](figsize=(11.0, 4.5), layout="constrained")
    shown = [who for who in WHO if any(p.who == who and p.failure is None for p in points)]
    widths = [max(sum(p.who == who and p.failure is None for p in points), 1.5) for who in shown]
    panels = figure.subplots(1, len(shown), width_ratios=widths, squeeze=False)[0]
    for axes, who in zip(panels, shown, strict=True):
        own = [p for p in points if p.who == who and p.failure is None]
        base = [0.0] * len(own)
        for stage in TIMED:
            values = [p.stages[stage].cpu if stage in p.stages else 0.0 for p in own]
            axes.bar(range(len(own)), values, bottom=base, width=0.8, color=STAGE_COLORS[stage], label=stage)
            base = [b + v for b, v in zip(base, values, strict=True)]
        axes.set_xticks(range(len(own)), [_mark(p) for p in own], rotation=60, fontsize=7)
        axes.set_title(_legend(who), fontsize=8)
        axes.tick_params(axis="y", labelsize=7)
        axes.grid(True, axis="y", alpha=0.2)
    panels[0].set_ylabel("processor seconds")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, fontsize=8, loc="outside lower center", ncols=len(TIMED))
    figure.suptitle(f"{title}: where the time goes (each panel has its own scale)", fontsize=10)
    return _png(figure)
