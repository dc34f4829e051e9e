"""Tables of what was measured: for a terminal, as Markdown and as CSV."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from dataclasses import asdict, fields

from hlr.common.printable import printable
from hlr.lab.methods import textbook
from hlr.lab.methods.render import Statistics
from hlr.lab.methods.timing import Timing

LATE = "not finished"

Table = list[list[str]]


def tables(timings: Sequence[Timing]) -> list[tuple[str, Table]]:
    """Titles and tables: relative cost in the textbook and as measured, then time, memory, comparisons and events."""
    out = [("Relative cost, depth sort at 100 polygons = 1: the textbook's estimate | today", _relative(timings))]
    shown: list[tuple[str, Callable[[Timing], str]]] = [
        ("Time", lambda t: _seconds(t.seconds)),
        ("Memory of the method, with its frame", lambda t: _bytes(t.statistics)),
        ("Comparisons of depth", lambda t: LATE if t.statistics is None else _count(t.statistics.comparisons)),
    ]
    out += [(title, _grid(timings, cell)) for title, cell in shown]
    listing = [t for t in timings if t.statistics is not None and t.statistics.edge_starts]
    if listing:
        names = {t.method for t in listing}
        grid = _grid([t for t in timings if t.method in names], _events)
        out.append(("Events of the active lists: starts and ends + crossings", grid))
    return [table for table in out if len(table[1]) > 1]


def text(timings: Sequence[Timing]) -> str:
    """All tables as text for a terminal."""
    parts = []
    for title, found in tables(timings):
        rows = [[printable(cell) for cell in row] for row in found]
        widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
        lines = [
            "  ".join(
                cell.ljust(w) if k == 0 else cell.rjust(w) for k, (cell, w) in enumerate(zip(r, widths, strict=True))
            )
            for r in rows
        ]
        parts.append("\n".join([title, *(line.rstrip() for line in lines)]))
    return "\n\n".join(parts) + "\n"


def markdown(timings: Sequence[Timing]) -> str:
    """All tables as Markdown."""
    parts = []
    for title, rows in tables(timings):
        head = "| " + " | ".join(rows[0]) + " |"
        rule = "| --- |" + " ---: |" * (len(rows[0]) - 1)
        body = ["| " + " | ".join(row) + " |" for row in rows[1:]]
        parts.append("\n".join([f"**{title}**".replace("|", "and"), "", head, rule, *body]))
    return "\n\n".join(parts) + "\n"


def comma_separated(timings: Sequence[Timing]) -> str:
    """All figures as CSV, one row for each method and scene."""
    names = [field.name for field in fields(Statistics) if field.name not in ("seconds", "polygons")]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["scene", "polygons", "method", "finished", "seconds", *names])
    for t in timings:
        counted = asdict(t.statistics) if t.statistics is not None else {}
        seconds = "" if t.seconds is None else f"{t.seconds:.6f}"
        values = [f"{v:.6f}" if isinstance(v, float) else v for v in (counted.get(name, "") for name in names)]
        writer.writerow([t.scene, t.count, t.method, "yes" if counted else "no", seconds, *values])
    return out.getvalue()


def _grid(timings: Sequence[Timing], cell: Callable[[Timing], str]) -> Table:
    scenes = list(dict.fromkeys(t.scene for t in timings))
    methods = list(dict.fromkeys(t.method for t in timings))
    at = {(t.method, t.scene): t for t in timings}
    return [["method", *scenes], *([m, *(cell(at[m, s]) for s in scenes)] for m in methods)]


def _relative(timings: Sequence[Timing]) -> Table:
    """The textbook's relative costs beside the measured ones; empty if depth sort at 100 polygons was not measured."""
    at = {(t.method, t.scene): t.seconds for t in timings}
    unit = at.get(("depth sort", scene_name(100)))
    counts = [c for c in textbook.COUNTS if any(t.scene == scene_name(c) for t in timings)]
    # The textbook's 250 may be a misprint of 2,500, so the measured column of 2,500 is shown as well.
    today = sorted({*counts, *(c for c in (2_500,) if any(t.scene == scene_name(c) for t in timings))})
    if not unit or not counts:
        return [[]]
    head = ["method", *(f"{c:,}" for c in counts), "|", *(f"{c:,}" for c in today)]
    rows = [head]
    for method, cost in textbook.COST.items():
        own = [str(c) for n, c in zip(textbook.COUNTS, cost, strict=True) if n in counts]
        times = [at.get((method, scene_name(c))) for c in today]
        rows.append([method, *own, "|", *(LATE if s is None else f"{s / unit:.3g}" for s in times)])
    return rows


def scene_name(count: int, crossing: bool = False) -> str:
    """The name of a scene of the testbed in the tables."""
    return f"{count:,}" + (" crossing" if crossing else "")


def model_name(name: str, count: int) -> str:
    """The name of a model's scene in the tables."""
    return f"{name}: {count:,}"


def _seconds(value: float | None) -> str:
    if value is None:
        return LATE
    return f"{value * 1e3:.3g} ms" if value < 1.0 else f"{value:.3g} s"


def _events(t: Timing) -> str:
    found = t.statistics
    if found is None:
        return LATE
    own = found.edge_starts + found.edge_ends + found.span_starts + found.span_ends
    return f"{_count(own)} + {_count(found.swaps)}"


def _bytes(found: Statistics | None) -> str:
    return LATE if found is None else f"{found.memory / 2**20:.3g} MiB"


def _count(value: int) -> str:
    for unit, name in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= unit:
            return f"{value / unit:.3g} {name}"
    return str(value)
