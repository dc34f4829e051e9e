"""The result of a comparison: what differs, in numbers, in words and as a picture."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

from hlr.compare.compared_view import ComparedView
from hlr.compare.difference import WORDS_OF_TWO_PROGRAMS, Difference, told
from hlr.compare.lines.motion import Motion
from hlr.compare.lines.pieces import Pieces
from hlr.compare.matching.judge import Findings
from hlr.compare.reading.sides import Side
from hlr.drawing.files import path_of, write_all
from hlr.drawing.scale import ratio
from hlr.errors import OptionError
from hlr.tables.documents import head
from hlr.tables.entry import listed

if TYPE_CHECKING:
    from hlr.compare.overlay.picture import Overlay


_MOST_NAMES = 3
"""Of parts, in a summary."""


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Comparison:
    """What differs between two drawings.

    before, after  what people call the two sides
    differences    each with its place, length, class, part and edge; by kind, the longest first
    tolerance_mm   how far apart lines may lie that count as the same, millimetres on paper
    motion         how the second drawing was moved before it was compared; None: it was not registered
    scales         of the two drawings, paper to model, where they differ: the second is compared at that of the first
    views          of two pages, each with what was found of it; empty: they were compared as a whole
    same_mm        length that is the same in both, millimetres on paper
    foreign        whether one of them is of another program: nothing is "new" then, but in one of them only
    model_side     which side hlr drew of a model, where the other is a drawing of it: "first" or "second"; else None
    badly_laid     share of the lines that lie on one another, 0 to 1, where that is so little that nothing was judged
    rehatched      names of the parts that both have hatched in the same places, with other lines: no difference
    left_out       what of each file is no line of its drawing, counted
    view_found     of a model, where it was not said: the view that the other side shows; of two models the usual one
    findings       the differences with their pieces, from which the overlay is drawn
    lines          the pieces of the second drawing, as it was moved

    >>> import hlr
    >>> old, new = (hlr.draw("part.step", view="front", hidden=shown) for shown in (True, False))
    >>> found = hlr.compare.compare(old, new)
    >>> found.same, sorted(found.lengths_mm)[:2]
    (False, ['class changed', 'gone'])
    """

    before: str
    after: str
    differences: tuple[Difference, ...]
    tolerance_mm: float
    motion: Motion | None
    scales: tuple[float, float] | None
    views: tuple[ComparedView, ...]
    same_mm: float
    foreign: bool
    model_side: Literal["first", "second"] | None
    badly_laid: float | None
    rehatched: tuple[str, ...]
    left_out: tuple[dict[str, int], dict[str, int]]
    view_found: str | None
    findings: Findings
    lines: Pieces

    @staticmethod
    def of(
        before: Side,
        after: Side,
        findings: Findings,
        tolerance_mm: float,
        *,
        motion: Motion | None = None,
        scales: tuple[float, float] | None = None,
        views: tuple[ComparedView, ...] = (),
        badly_laid: float | None = None,
    ) -> Comparison:
        """The record of what was found."""
        found = tuple(findings.differences)
        one, other = before.about, after.about
        return Comparison(
            before=before.title,
            after=after.title,
            differences=found,
            tolerance_mm=tolerance_mm,
            motion=motion,
            scales=scales,
            views=views,
            same_mm=findings.same_mm,
            foreign=one.foreign or other.foreign,
            model_side=_model_side(before, after),
            badly_laid=badly_laid,
            rehatched=findings.rehatched,
            left_out=(one.left_out, other.left_out),
            view_found=one.view_found or other.view_found,
            findings=findings,
            lines=after.pieces,
        )

    def __repr__(self) -> str:
        return f"<Comparison {self.summary}>"

    @property
    def same(self) -> bool:
        """Whether both show the same, at the same scale."""
        seen = self.scales is None and all(self.looks_same(each) for each in self.differences)
        return seen and not any(view.displaced for view in self.views)

    def looks_same(self, found: Difference) -> bool:
        """Whether a difference cannot be seen: a line drawn twice, or straight pieces within the tolerance."""
        return found.kind == "doubled" or (found.kind == "polyline" and found.moved_mm <= self.tolerance_mm)

    @property
    def shift(self) -> tuple[float, float] | None:
        """(x, y) mm by which the second drawing was moved before it was compared; None: it was not registered."""
        return None if self.motion is None else self.motion.shift

    @property
    def lengths_mm(self) -> dict[str, float]:
        """Millimetres of each kind of difference."""
        return self.findings.lengths_mm

    @property
    def verdicts_mm(self) -> dict[str, float]:
        """Millimetres of differences in which each drawing is right, where one of them was drawn of a model."""
        return self.findings.verdicts_mm

    @property
    def wrong_mm(self) -> float:
        """Millimetres of differences in which hlr's own drawing of the model is wrong, `model_side`; else 0."""
        right = (f"{self.model_side} right", "both right", "undecided", "")
        return sum((each.length_mm for each in self._counted if each.verdict not in right), 0.0)

    @property
    def unjudged_mm(self) -> float:
        """Millimetres of differences of which nobody knows which drawing is right: undecided, or not judged."""
        return sum((each.length_mm for each in self._counted if each.verdict in ("undecided", "")), 0.0)

    @property
    def _counted(self) -> list[Difference]:
        return [each for each in self.differences if not self.looks_same(each)]

    @property
    def summary(self) -> str:
        """One line: "12.4 mm gone, 3 mm new"."""
        words = WORDS_OF_TWO_PROGRAMS if self.foreign else {}
        lengths = [
            f"{told(length)} mm {words.get(kind, kind)}" for kind, length in self.lengths_mm.items() if length > 0.0
        ]
        if all(self.looks_same(each) for each in self.differences):
            lengths.insert(0, f"same: {told(self.same_mm)} mm of lines")
        text = ", ".join(lengths)
        if self.scales is not None:
            text = f"scale {ratio(self.scales[0])}, now {ratio(self.scales[1])}; at the scale of the first: {text}"
        elsewhere = [view.name for view in self.views if view.displaced]
        text += f"; elsewhere on the page: {', '.join(elsewhere)}" if elsewhere else ""
        if self.rehatched:
            text += f"; hatched with other lines: {_first_of(self.rehatched)}"
        if self.badly_laid is not None:
            share = f"{100.0 * self.badly_laid:.0f} %"
            text = f"only {share} of the lines lie on one another, too few to say who is right: {text}"
        judged = ", ".join(f"{verdict} {told(length)} mm" for verdict, length in self.verdicts_mm.items())
        text += f"; by rays on the model: {judged}" if judged else ""
        text += "" if self.view_found is None else f"; the view is {self.view_found}"
        moved = self._moved()
        return f"{text}; {' and '.join(moved)} to be compared" if moved else text

    def _moved(self) -> list[str]:
        """What was done to the second drawing."""
        if self.motion is None:
            return []
        shifted = any(abs(each) >= 0.0005 for each in self.motion.shift)
        x, y = (told(each) for each in self.motion.shift)
        return [*self.motion.words(), *([f"moved by ({x}, {y}) mm"] if shifted else [])]

    def to_dict(self) -> dict[str, Any]:
        """All of it but the picture, for JSON."""
        return {
            **head("hlr-comparison"),
            "before": self.before,
            "after": self.after,
            "same": self.same,
            "summary": self.summary,
            "tolerance_mm": self.tolerance_mm,
            "shift": None if self.shift is None else list(self.shift),
            "motion": None if self.motion is None else self.motion.as_dict(),
            "scales": None if self.scales is None else list(self.scales),
            "same_mm": self.same_mm,
            "views": [each.as_dict() for each in self.views],
            "view_found": self.view_found,
            "model_side": self.model_side,
            "badly_laid": self.badly_laid,
            "rehatched": list(self.rehatched),
            "left_out": list(self.left_out),
            "mm": self.lengths_mm,
            "verdicts_mm": self.verdicts_mm,
            "wrong_mm": self.wrong_mm,
            "unjudged_mm": self.unjudged_mm,
            "differences": [each.as_dict() for each in self.differences],
        }

    def to_json(self) -> str:
        """`to_dict` as text."""
        import json

        return json.dumps(self.to_dict(), indent=1, allow_nan=False) + "\n"

    def to_svg(self) -> str:
        """The overlay as SVG: what is the same in grey, each kind of difference in its colour, with a legend."""
        from hlr.compare.overlay.svg import svg

        return svg(self.overlay())

    def to_png(self) -> bytes:
        """The same as PNG, 8 pixels per millimetre where that is not too large."""
        from hlr.compare.overlay.png import png

        return png(self.overlay())

    def to_html(self) -> str:
        """The overlay as a web page that needs no other file: layers, zoom, and a table that leads to each place."""
        from hlr.compare.overlay.html import Told, html

        titles, others = (self.before, self.after), (self.foreign, self.tolerance_mm)
        return html(Told(titles, self.summary, self.findings, self.views, self.left_out, *others), self.overlay())

    def overlay(self) -> Overlay:
        """The picture that SVG, PNG and HTML show."""
        from hlr.compare.overlay.picture import overlay

        return overlay((self.before, self.after), self.summary, self.findings, self.lines)

    def rendered(self, ending: str) -> bytes:
        """The content of a file with this ending, a key of `WRITERS`."""
        return WRITERS[ending](self)

    def save(self, file: str | os.PathLike[str]) -> Path:
        """Write the overlay (.svg, .png, .html), or the figures (.json). Returns the path.

        Raises OptionError for another ending, WriteError where the file cannot be written.
        """
        path = path_of(file)
        write_all({path: self.rendered(ending_of(path))})
        return path


def _first_of(names: Sequence[str]) -> str:
    """The first few names, and how many there are besides."""
    more = len(names) - _MOST_NAMES
    return listed([*names[:_MOST_NAMES], *([f"{more} more"] if more > 0 else [])], "and")


def _model_side(before: Side, after: Side) -> Literal["first", "second"] | None:
    """Which side is a model, where the other is none."""
    match [side.behind is not None or bool(side.behind_views) for side in (before, after)]:
        case [True, False]:
            return "first"
        case [False, True]:
            return "second"
    return None


WRITERS: dict[str, Callable[[Comparison], bytes]] = {
    ".svg": lambda found: found.to_svg().encode(),
    ".png": Comparison.to_png,
    ".html": lambda found: found.to_html().encode("utf-8", "replace"),
    ".json": lambda found: found.to_json().encode(),
}
"""What a comparison is written as."""


def ending_of(path: Path) -> str:
    """The ending of a file for a comparison, a key of `WRITERS`. Raises OptionError for another."""
    ending = path.suffix.lower()
    if ending not in WRITERS:
        raise OptionError(f"a comparison cannot be written to {path}: its name has to end in {listed(WRITERS, 'or')}")
    return ending
