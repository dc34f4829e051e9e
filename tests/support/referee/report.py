"""The referee's report: one row per drawing, and the table of all."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from support.referee.exchange import Exchange
from support.referee.judge import Verdict
from support.referee.seen import Seen

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
    "breaks",
    "missing",
    "by own",
    "longest mm",
    "broken",
    "off curve",
    "lost mm2",
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
    by_own: int = 0
    longest: float = 0.0
    faults: int = 0
    broken: int = 0
    off: int = 0
    lost: float = 0.0
    draw: float = 0.0
    judge: float = 0.0
    failure: str = ""

    @property
    def bad(self) -> bool:
        wrong = self.wrong_visible or self.wrong_hidden or self.displaced
        return bool(wrong or self.faults or self.broken or self.off or self.lost or self.failure)

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
            str(self.by_own),
            f"{self.longest:.2f}" + ("!" if self.faults else ""),
            str(self.broken),
            str(self.off),
            f"{self.lost:.1f}",
            f"{self.draw:.2f}",
            f"{self.judge:.2f}",
        ]


def row(
    file: str, drawer: str, drawing: Exchange, verdict: Verdict, seen: Seen, *, off: int, draw: float, judge: float
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
        asked=seen.gaps.asked,
        missing=len(seen.gaps.places),
        by_own=len(seen.own_gaps.places) if seen.own_gaps else 0,
        longest=seen.gaps.worst,
        faults=len(seen.gaps.faults),
        broken=len(seen.breaks),
        off=off,
        lost=sum(area for area, _ in seen.lost.areas) if seen.lost else 0.0,
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
            "by_own",
            "faults",
            "broken",
            "off",
            "lost",
            "draw",
            "judge",
        )
    }
    sums["longest"] = max((each.longest for each in rows), default=0.0)
    failures = sum(bool(each.failure) for each in rows)
    return Row(file="total", view=f"{len(rows)} views, {failures} failed", drawer="", **sums)


def _percent(part: int, whole: int) -> str:
    return f"{100 * part / whole:.2f}" if whole else "-"
