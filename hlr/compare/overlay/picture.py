"""The overlay of a comparison: what is the same in grey, what differs in colour, and what the colours mean.

It is made of marks, which the writers of SVG and PNG draw one by one. Millimetres, y down, from the upper left corner.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import compress, pairwise, product
from textwrap import wrap

import numpy as np

from hlr.compare.difference import KINDS, VERDICTS, told
from hlr.compare.lines.pieces import Floats, Pieces
from hlr.compare.matching.judge import Findings

COLORS = {
    "gone": "#d62222",
    "new": "#1660d0",
    "moved": "#e08a00",
    "class changed": "#8a3fc0",
    "visibility changed": "#0a9a6a",
    "polyline": "#b0a000",
    "doubled": "#7fb4c8",
}
"""Colours that people with any colour vision tell apart, beside the words of the legend."""

MEANING = {
    "gone": "in the first drawing only",
    "new": "in the second drawing only",
    "moved": "displaced; dashed: where it was",
    "class changed": "another class of line",
    "visibility changed": "visible in one, hidden in the other",
    "polyline": "straight pieces in one, a curve in the other",
    "doubled": "drawn more than once in one of them",
}

SAME, PAPER, INK, PALE = "#a8a8a8", "#ffffff", "#202020", "#606060"
_MARGIN, _ROW, _NARROWEST = 8.0, 5.5, 120.0
_LETTERS = 72
"""Of the legend in one line, on the narrowest overlay."""

_RING, _SHORT, _MOST_RINGS = 2.5, 3.0, 300


@dataclass(frozen=True, slots=True)
class Stroke:
    """Polylines (n, 2) each, of one colour and width; verdict: on the differences that they are."""

    lines: list[Floats]
    color: str
    width: float
    dashed: bool = False
    name: str = ""
    verdict: str = ""


@dataclass(frozen=True, slots=True)
class Text:
    """A line of text; at: where its base line begins; size: height of the letters' em."""

    at: tuple[float, float]
    text: str
    size: float
    color: str = INK


@dataclass(frozen=True, slots=True)
class Overlay:
    """A page with marks.

    drawn   height of what lies above the legend
    corner  what of the drawings, y up, lies in the upper left corner
    """

    width: float
    height: float
    title: str
    marks: tuple[Stroke | Text, ...]
    drawn: float
    corner: tuple[float, float]


def overlay(titles: tuple[str, str], summary: str, found: Findings, second: Pieces) -> Overlay:
    """The overlay of a comparison. titles: of both drawings; second: the lines of the second, as they were moved."""
    lines = np.stack([second.start, second.end], axis=1)
    every = np.concatenate([lines, found.moved, *found.traces]).reshape(-1, 2)
    low, high = (every.min(axis=0), every.max(axis=0)) if len(every) else (np.zeros(2), np.zeros(2))
    width = max(float(high[0] - low[0]), _NARROWEST) + 2.0 * _MARGIN
    left = low[0] - 0.5 * (width - float(high[0] - low[0]))
    corner = np.array([left, high[1] + _MARGIN])

    def placed(segments: Floats) -> list[Floats]:
        return _chains((segments - corner) * (1.0, -1.0))

    marks: list[Stroke | Text] = [Stroke(placed(lines), SAME, 0.25, name="second drawing")]
    for kind, verdict in product(reversed(KINDS), VERDICTS):
        alike = [each.kind == kind and each.verdict == verdict for each in found.differences]
        traces = list(compress(found.traces, alike))
        if traces:
            lines_of = placed(np.concatenate(traces))
            marks.append(Stroke(lines_of, COLORS[kind], 0.6, kind == "moved", kind, verdict))
            rings = [ring for trace in traces[:_MOST_RINGS] if (ring := _ring(trace, corner)) is not None]
            marks.append(Stroke(rings, COLORS[kind], 0.25, name=f"{kind}, short", verdict=verdict))
    marks.append(Stroke(placed(found.moved), COLORS["moved"], 0.4, name="moved here"))
    top = float(high[1] - low[1]) + 2.0 * _MARGIN
    legend = _legend(titles, summary, found, top)
    bottom = max(mark.at[1] for mark in legend if isinstance(mark, Text)) + _ROW
    place = float(corner[0]), float(corner[1])
    return Overlay(width, bottom, " and ".join(titles), (*marks, *legend), top - _MARGIN + _RING, place)


def _legend(titles: tuple[str, str], summary: str, found: Findings, top: float) -> list[Stroke | Text]:
    """What was compared, and a row for each kind that was found."""
    line = np.array([[_MARGIN, top], [_MARGIN + 10.0, top]])
    said = wrap(summary, _LETTERS)
    out: list[Stroke | Text] = [
        Text((_MARGIN, top), f"from {_short(titles[0])} to {_short(titles[1])}", 4.0),
        *(Text((_MARGIN, top + n * _ROW), text, 3.2, PALE) for n, text in enumerate(said, 1)),
    ]
    rows = [(kind, COLORS[kind], length, MEANING[kind]) for kind, length in found.lengths_mm.items() if length > 0.0]
    rows.append(("same", SAME, found.same_mm, "in both"))
    for number, (kind, color, length, meaning) in enumerate(rows, 1 + len(said)):
        down = np.array([0.0, number * _ROW])
        wide = 0.25 if kind == "same" else 0.8
        out.append(Stroke([line + down - (0.0, 1.1)], color, wide, kind == "moved"))
        out.append(Text((_MARGIN + 13.0, top + number * _ROW), f"{kind}, {told(length)} mm: {meaning}", 3.2))
    return out


def _short(name: str) -> str:
    return name if len(name) <= 40 else f"{name[:37]}..."


def _ring(trace: Floats, corner: Floats) -> Floats | None:
    """A circle around a trace that is too short to be seen; None for a longer one."""
    points = trace.reshape(-1, 2)
    low, high = points.min(axis=0), points.max(axis=0)
    if float((high - low).max()) > _SHORT:
        return None
    centre = (0.5 * (low + high) - corner) * (1.0, -1.0)
    turn = np.linspace(0.0, 2.0 * np.pi, 33)
    return np.asarray(centre + _RING * np.stack([np.cos(turn), np.sin(turn)], axis=1))


def _chains(segments: Floats) -> list[Floats]:
    """(n, 2, 2) segments as polylines: those that follow one another are joined."""
    if not len(segments):
        return []
    breaks = np.flatnonzero(np.abs(segments[1:, 0] - segments[:-1, 1]).max(axis=1) > 1e-9) + 1
    ends = [0, *breaks.tolist(), len(segments)]
    return [
        _straightened(np.concatenate([segments[first:last, 0], segments[last - 1 : last, 1]]))
        for first, last in pairwise(ends)
    ]


def _straightened(points: Floats) -> Floats:
    """Without the points at which a polyline does not turn."""
    if len(points) < 3:
        return points
    way = np.diff(points, axis=0)
    way = way / np.maximum(np.hypot(*way.T), 1e-12)[:, None]
    turns = np.abs(way[1:] - way[:-1]).max(axis=1) > 1e-6
    kept: Floats = points[np.concatenate([[True], turns, [True]])]
    return kept
