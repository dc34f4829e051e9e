"""The plot of the measured times: seconds over the number of polygons, both logarithmic."""

from __future__ import annotations

import io
from collections.abc import Sequence

from hlr.errors import OptionError
from hlr.lab.methods.report import scene_name
from hlr.lab.methods.timing import Timing

MARKS = "osD^vPX*hd"


def png(timings: Sequence[Timing], size: tuple[int, int]) -> bytes:
    """A PNG with one line for each method: solid for polygons that do not cross, dashed for crossing ones.

    A model has larger marks at its number of polygons, with its name beside them. A method that did not finish has an
    empty mark at the limit, with an arrow upward. Raises OptionError where matplotlib is not installed.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
        from matplotlib.lines import Line2D
    except ImportError:
        raise OptionError("the plot needs matplotlib: pip install 'hlr-drawing[plot]', or leave out -o") from None
    figure = Figure(figsize=(9.0, 6.2), layout="constrained")
    axes = figure.add_subplot()
    methods = list(dict.fromkeys(t.method for t in timings))
    keys = []
    for k, method in enumerate(methods):
        mark, colour = MARKS[k % len(MARKS)], f"C{k}"
        keys.append(Line2D([], [], color=colour, marker=mark, markersize=5, label=method))
        for kind, style, alpha, large in (("even", "-", 1.0, 5), ("crossing", "--", 0.5, 5), ("model", "", 1.0, 9)):
            own = [t for t in timings if t.method == method and _kind(t) == kind]
            done = [(t.count, t.seconds) for t in own if t.seconds is not None]
            if done:
                axes.plot(*zip(*done, strict=True), mark, linestyle=style, color=colour, markersize=large, alpha=alpha)
            for t in own:
                if t.seconds is None and t.limit is not None:
                    axes.plot(t.count, t.limit, mark, color=colour, markersize=8, fillstyle="none", alpha=alpha)
                    axes.plot(t.count, t.limit * 1.25, "^", color=colour, markersize=4, fillstyle="none", alpha=alpha)
    if any(t.seconds is None for t in timings):
        keys.append(
            Line2D([], [], color="0.4", marker="o", markersize=8, fillstyle="none", linestyle="", label="not finished")
        )
    for name, count in dict.fromkeys((t.scene, t.count) for t in timings if _kind(t) == "model"):
        axes.axvline(count, color="0.7", linewidth=0.8, zorder=0)
        axes.text(
            count, 0.99, f"{name} ", transform=axes.get_xaxis_transform(), va="top", ha="right", fontsize=8, color="0.3"
        )
    axes.set_xscale("log")
    axes.set_yscale("log")
    crossing = any(_kind(t) == "crossing" for t in timings)
    axes.set_xlabel("polygons (dashed: passing through one another)" if crossing else "polygons")
    axes.set_ylabel(f"seconds, one core, {size[0]} x {size[1]} pixels")
    axes.grid(True, which="both", alpha=0.25)
    axes.legend(handles=keys, fontsize=8)
    out = io.BytesIO()
    FigureCanvasAgg(figure).print_figure(out, format="png", dpi=110, metadata={"Software": None})
    return out.getvalue()


def _kind(t: Timing) -> str:
    if t.scene == scene_name(t.count):
        return "even"
    return "crossing" if t.scene == scene_name(t.count, crossing=True) else "model"
