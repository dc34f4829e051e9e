"""Finds all faults of one drawing: wrong and missing lines, lines off their curves, lost faces."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from support.referee import exchange, picture, reference, report
from support.referee.depth import PIXELS
from support.referee.judge import RayCaster, Verdict, judge, offenders
from support.referee.off_curve import Off, off_curve
from support.referee.seen import Seen, look

Curves = tuple[Callable[[str, int], Any], Callable[[str, int], float]]
"""What `off_curve` asks for: curves of edges, and their tolerances."""


@dataclass(frozen=True)
class Judged:
    """One drawing with all its faults; only the row of the report if there is no drawing."""

    row: report.Row
    drawing: exchange.Exchange | None = None
    verdict: Verdict | None = None
    seen: Seen | None = None
    off: list[Off] = field(default_factory=list)

    def why(self) -> Iterator[str]:
        """One line of text per fault: wrong lines, worst first, then missing lines, lines off curves, lost faces."""
        if self.drawing is not None and self.verdict is not None:
            yield from offenders(self.drawing, self.verdict)
        if self.drawing is not None and self.seen is not None:
            yield from self.seen.why()
            for off in self.off:
                line, (x, y) = self.drawing.lines[off.line], off.at
                yield (
                    f"off its curve by {off.accuracies:.3g} accuracies at ({x:.2f}, {y:.2f}) on paper: {line.kind} of "
                    f"part {line.part} {self.drawing.parts[line.part]!r} edge {line.edge}"
                )

    def save_picture(self, path: Path) -> None:
        """Write a PNG: the depth image with all faults marked."""
        if self.drawing is None or self.verdict is None or self.seen is None:
            return
        wrong = self.drawing.on_paper(self.verdict.samples.points[self.verdict.wrong_visible])
        seen = self.seen
        picture.save(path, self.drawing, seen.sheet, seen.image, seen.gaps, wrong=wrong, off=self.off, lost=seen.lost)


class Referee:
    """Judges drawings of one model by an independent mesh; given its curves, also whether lines lie on them."""

    def __init__(self, model: reference.Reference, curves: Curves | None = None, pixels: int = PIXELS) -> None:
        self._caster = RayCaster(model)
        self._curves, self._pixels = curves, pixels

    def judge(
        self,
        file: str,
        drawer: str,
        drawing: exchange.Exchange,
        seconds: float = 0.0,
        own: reference.Reference | None = None,
    ) -> Judged:
        """Find all faults of one drawing; `own`: the triangles from which it was made."""
        start = time.perf_counter()
        verdict = judge(drawing, self._caster)
        seen = look(drawing, self._caster, own, self._pixels)
        off = off_curve(drawing, *self._curves) if self._curves else []
        spent = time.perf_counter() - start
        row = report.row(file, drawer, drawing, verdict, seen, off=len(off), draw=seconds, judge=spent)
        return Judged(row, drawing, verdict, seen, off)
