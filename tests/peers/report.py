"""What the referee tells: a table, the worst offenders, and a picture with the wrong samples in red."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from peers.exchange import Exchange
from peers.judge import Verdict
from peers.missing import Missing

HEADINGS = (
    "file",
    "view",
    "by",
    "lines",
    "visible",
    "wrong",
    "%",
    "hidden",
    "wrong",
    "%",
    "displaced",
    "asked",
    "missing",
    "draw s",
    "judge s",
)


@dataclass(frozen=True)
class Row:
    """One judged drawing, or in `failure` why there is none."""

    file: str
    view: str
    drawer: str
    lines: int = 0
    visible: int = 0
    wrong_visible: int = 0
    hidden: int = 0
    wrong_hidden: int = 0
    displaced: int = 0
    asked: int = 0
    missing: int = 0
    draw: float = 0.0
    judge: float = 0.0
    failure: str = ""

    @property
    def bad(self) -> bool:
        return bool(self.wrong_visible or self.wrong_hidden or self.displaced or self.missing or self.failure)

    def cells(self) -> list[str]:
        if self.failure:
            return [self.file, self.view, self.drawer, self.failure, *[""] * (len(HEADINGS) - 4)]
        return [
            self.file,
            self.view,
            self.drawer,
            str(self.lines),
            str(self.visible),
            str(self.wrong_visible),
            _percent(self.wrong_visible, self.visible),
            str(self.hidden),
            str(self.wrong_hidden),
            _percent(self.wrong_hidden, self.hidden),
            str(self.displaced),
            str(self.asked),
            str(self.missing),
            f"{self.draw:.2f}",
            f"{self.judge:.2f}",
        ]


def row(
    file: str, drawer: str, drawing: Exchange, verdict: Verdict, *, gaps: Missing | None, draw: float, judge: float
) -> Row:
    visible = verdict.samples.visible
    return Row(
        file=file,
        view=drawing.camera.name,
        drawer=drawer,
        lines=verdict.judged,
        visible=int(visible.sum()),
        wrong_visible=int(verdict.wrong_visible.sum()),
        hidden=int((~visible).sum()),
        wrong_hidden=int(verdict.wrong_hidden.sum()),
        displaced=verdict.displaced,
        asked=gaps.asked if gaps else 0,
        missing=len(gaps.places) if gaps else 0,
        draw=draw,
        judge=judge,
    )


def total(rows: Sequence[Row]) -> Row:
    sums = {
        name: sum(getattr(each, name) for each in rows)
        for name in (
            "lines",
            "visible",
            "wrong_visible",
            "hidden",
            "wrong_hidden",
            "displaced",
            "asked",
            "missing",
            "draw",
            "judge",
        )
    }
    failures = sum(bool(each.failure) for each in rows)
    return Row(file="total", view=f"{len(rows)} views, {failures} failed", drawer="", **sums)


def _percent(part: int, whole: int) -> str:
    return f"{100 * part / whole:.2f}" if whole else "-"


def markdown(headings: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A table that reads well as text too."""
    table = [list(headings), *map(list, rows)]
    widths = [max(len(line[column]) for line in table) for column in range(len(headings))]
    lines = [
        "| " + " | ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)) + " |" for line in table
    ]
    return "\n".join([lines[0], "|" + "|".join("-" * (width + 2) for width in widths) + "|", *lines[1:]])


def save_picture(path: Path, drawing: Exchange, verdict: Verdict, gaps: Missing | None = None) -> None:
    """Visible black, hidden grey; red rings: wrongly visible, orange: wrongly hidden, blue: missing."""
    axes = np.stack([drawing.camera.right, drawing.camera.up], axis=1)
    every = np.concatenate([line.points3 @ axes for line in drawing.lines] or [np.zeros((1, 2))])
    low, high = every.min(axis=0), every.max(axis=0)
    size = float(max(high - low)) or 1.0
    width, height = (high - low) + 0.04 * size

    def place(points: np.ndarray) -> np.ndarray:
        flat = points @ axes - low + 0.02 * size
        return np.stack([flat[:, 0], height - flat[:, 1]], axis=1) * (1000 / size)

    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {1000 * width / size:.1f} {1000 * height / size:.1f}">'
    ]
    out.append('<rect width="100%" height="100%" fill="#fff"/>')
    for visible, color, stroke in ((False, "#9ab", 0.5), (True, "#000", 1.0)):
        data = "".join(
            "M" + " ".join(f"{x:.2f},{y:.2f}" for x, y in place(line.points3))
            for line in drawing.lines
            if line.visible == visible
        )
        out.append(f'<path d="{data}" fill="none" stroke="{color}" stroke-width="{stroke}"/>')
    samples = verdict.samples.points
    marks = [(samples[verdict.wrong_visible], "#e00"), (samples[verdict.wrong_hidden], "#f80")]
    if gaps is not None:
        marks.append((gaps.places, "#00f"))
    for places, color in marks:
        for x, y in place(places):
            out.append(f'<circle cx="{x:.2f}" cy="{y:.2f}" r="5" fill="none" stroke="{color}" stroke-width="1.5"/>')
    path.write_text("\n".join([*out, "</svg>\n"]))
