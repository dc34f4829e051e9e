"""The plot of what was measured: time over the number of polygons, both logarithmic."""

from __future__ import annotations

import io
from collections.abc import Sequence

from hlr.errors import OptionError
from hlr.surfaces.report import scene_name
from hlr.surfaces.timing import Timing

MARKS = "osD^vPX*hd"


def png(timings: Sequence[Timing], size: tuple[int, int]) -> bytes:
    """A PNG of one line for each method: on polygons that do not cross solid, on crossing ones dashed.

    Raises OptionError where matplotlib is not installed.
    """
    try:
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure
    except ImportError:
        raise OptionError("the plot needs matplotlib: pip install 'hlr-drawing[plot]', or leave out -o") from None
    figure = Figure(figsize=(9.0, 6.2), layout="constrained")
    axes = figure.add_subplot()
    for k, method in enumerate(dict.fromkeys(t.method for t in timings)):
        for crossing in (False, True):
            own = [
                t
                for t in timings
                if t.method == method and t.seconds is not None and t.scene == scene_name(t.count, crossing)
            ]
            if own:
                axes.plot(
                    [t.count for t in own],
                    [t.seconds for t in own if t.seconds is not None],
                    marker=MARKS[k % len(MARKS)],
                    color=f"C{k}",
                    linestyle="--" if crossing else "-",
                    markersize=5,
                    alpha=0.5 if crossing else 1.0,
                    label=None if crossing else method,
                )
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("polygons (dashed: passing through one another)")
    axes.set_ylabel(f"seconds, one core, {size[0]} x {size[1]} pixels")
    axes.grid(True, which="both", alpha=0.25)
    axes.legend(fontsize=8)
    out = io.BytesIO()
    FigureCanvasAgg(figure).print_figure(out, format="png", dpi=110, metadata={"Software": None})
    return out.getvalue()
