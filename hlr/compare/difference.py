"""One difference between two drawings."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal, get_args

from hlr.common.numbers import typed

Kind = Literal["gone", "new", "moved", "class changed", "visibility changed", "polyline", "doubled"]

Verdict = Literal["", "first right", "second right", "both right", "neither right", "undecided"]

VERDICTS: tuple[Verdict, ...] = get_args(Verdict)

KINDS: tuple[Kind, ...] = get_args(Kind)
"""In the order of reports."""

WORDS_OF_TWO_PROGRAMS: dict[str, str] = {
    "gone": "in the first only",
    "new": "in the second only",
    "moved": "displaced",
    "class changed": "of another class",
    "visibility changed": "visible in one, hidden in the other",
    "polyline": "of straight pieces in one, a curve in the other",
    "doubled": "drawn twice in one",
}
"""What the kinds are called where one of the drawings is of another program, and neither is the newer one."""

UNKNOWN = "unknown"
"""Class of a line of which its file does not say one."""


@dataclass(frozen=True, slots=True)
class Difference:
    """A length of line that differs.

    kind        gone and class or visibility changed are told of the first drawing, new of the second; "polyline":
                one has straight pieces where the other has a curve; "doubled": a drawing has the line twice
    place       (x, y) of its middle, millimetres on paper, y up
    length_mm   its length, millimetres on paper
    line_class  sharp, smooth, seam, outline, boundary, intersection or hatch; "unknown" where its file does not say
    visible     whether the line is drawn as visible; None: unknown
    part, edge  as its drawing names them; None: unknown
    view        of the page; None: there is one
    side        "before" or "after": the drawing that the fields above are of
    became      the class or the visibility in the second drawing, where that has changed; else ""
    moved_mm    how far it has moved, across its direction, or how far straight pieces lie off their curve, millimetres;
                else 0
    verdict     which drawing is right, where one of them was drawn of a model; "": not judged
    reason      why, in a few words

    >>> import hlr
    >>> before, after = (hlr.draw("part.step", view=view, scale=1) for view in ("top", "front"))
    >>> {each.side for each in hlr.compare.compare(before, after).differences}
    {'before', 'after'}
    """

    kind: Kind
    place: tuple[float, float]
    length_mm: float
    line_class: str
    visible: bool | None
    part: str | None
    edge: int | None
    side: Literal["before", "after"]
    became: str = ""
    moved_mm: float = 0.0
    view: str | None = None
    verdict: Verdict = ""
    reason: str = ""

    def as_dict(self) -> dict[str, Any]:
        """The fields, for JSON."""
        return asdict(self) | {"place": list(self.place)}


def told(length: float) -> str:
    """Millimetres for people: three digits, and no more than three decimals."""
    return typed(length, 10, 3 if abs(length) < 10.0 else 1)
