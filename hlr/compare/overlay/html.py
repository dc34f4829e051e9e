"""The overlay as one web page: the picture with layers and zoom, and a table of differences that leads to each place.

The page needs no other file, and may load none: its own style and scripts are named by their digests.
"""

from __future__ import annotations

import base64
import hashlib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from hlr.common.web import ASSETS, template
from hlr.compare.compared_view import ComparedView
from hlr.compare.difference import Difference, told
from hlr.compare.lines.pieces import Floats
from hlr.compare.matching.judge import Findings
from hlr.compare.overlay.cells import cells_of, left_out_lines, view_cells, words_of
from hlr.compare.overlay.picture import COLORS, SAME, Overlay
from hlr.compare.overlay.svg import class_of, drawn_alone

MOST_ROWS = 2000
"""Of the table, the longest differences of each kind first; the picture has all."""

_HOME = Path(__file__).parent / "page"
_STYLES = (ASSETS / "base.css", ASSETS / "stage.css", _HOME / "difference.css")
_SCRIPTS = (ASSETS / "start.js", ASSETS / "theme.js", ASSETS / "zoom.js", _HOME / "difference.js")

_AROUND, _LEAST_AROUND_MM = 1.6, 12.0
"""What is seen around a difference: so many times its size, and no less than that."""


@dataclass(frozen=True, slots=True)
class _Row:
    """A difference in the table. x, y: its middle in the picture, millimetres; around: how much of that is shown."""

    classes: str
    cells: tuple[str, ...]
    x: float
    y: float
    around: float


@dataclass(frozen=True, slots=True)
class Told:
    """What the page tells beside the picture: the fields of a `Comparison` of these names."""

    titles: tuple[str, str]
    summary: str
    findings: Findings
    views: tuple[ComparedView, ...]
    left_out: tuple[Mapping[str, int], Mapping[str, int]]
    foreign: bool
    tolerance_mm: float


def html(found: Told, page: Overlay) -> str:
    """The text of the file."""
    from markupsafe import Markup

    style, *scripts = ("".join(_text(path) for path in _STYLES), *(_text(path) for path in _SCRIPTS))
    words = words_of(found.foreign)
    pairs = list(zip(found.findings.differences, found.findings.traces, strict=True))
    return template(_HOME, "difference.html").render(
        found=found,
        picture=Markup(drawn_alone(page)),
        layers=_layers(found.findings.lengths_mm, words),
        verdicts=[
            {"classes": class_of(verdict), "word": verdict, "mm": f"{told(length)} mm"}
            for verdict, length in found.findings.verdicts_mm.items()
        ],
        rows=[_row(each, trace, page, words) for each, trace in pairs[:MOST_ROWS]],
        more=max(len(pairs) - MOST_ROWS, 0),
        view_rows=[view_cells(view, words) for view in found.views],
        left_out=left_out_lines(found.titles, found.left_out),
        style=Markup(style),
        scripts=[Markup(script) for script in scripts],
        allowed={"style": _digests([style]), "script": _digests(scripts)},
        version=version("hlr-drawing"),
    )


def _layers(lengths_mm: Mapping[str, float], words: dict[str, str]) -> list[dict[str, str]]:
    """What can be switched: names of classes, a colour, and words."""
    rows = [{"classes": "second-drawing", "color": SAME, "word": "second drawing", "mm": ""}]
    for kind, length in lengths_mm.items():
        if length > 0.0:
            classes = [class_of(kind), class_of(f"{kind}, short"), *(["moved-here"] if kind == "moved" else [])]
            row = {"classes": " ".join(classes), "color": COLORS[kind], "word": words.get(kind, kind)}
            rows.append(row | {"mm": f"{told(length)} mm"})
    return rows


def _row(each: Difference, trace: Floats, page: Overlay, words: dict[str, str]) -> _Row:
    points = trace.reshape(-1, 2)
    low, high = points.min(axis=0), points.max(axis=0)
    x, y = ((0.5 * (low + high) - page.corner) * (1.0, -1.0)).tolist()
    around = max(_AROUND * float(np.max(high - low)), _LEAST_AROUND_MM)
    classes = " ".join(class_of(name) for name in (each.kind, each.verdict) if name)
    return _Row(classes, cells_of(each, words), round(x, 3), round(y, 3), round(around, 3))


def _digests(texts: list[str]) -> str:
    """Of inline styles or scripts, as a security policy names them."""
    return " ".join(
        f"'sha256-{base64.b64encode(hashlib.sha256(text.encode()).digest()).decode('ascii')}'" for text in texts
    )


def _text(path: Path) -> str:
    return path.read_text("utf-8")
