"""One difference between two drawings."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any, Literal

Verdict = Literal["gone", "new", "moved", "class changed", "visibility changed"]


KINDS: tuple[Verdict, ...] = ("gone", "new", "moved", "class changed", "visibility changed")
"""In the order of reports."""


@dataclass(frozen=True, slots=True)
class Difference:
    """A length of line that differs.

    kind        gone and class or visibility changed are told of the first drawing, new of the second
    place       (x, y) of its middle, millimetres on paper, y up
    length_mm   on paper
    line_class  sharp, smooth, seam, outline, boundary or intersection
    visible     whether the line is drawn as visible
    part, edge  as its drawing names them; None: unknown
    side        "before" or "after": the drawing that the fields above are of
    became      the class or the visibility in the second drawing, where that has changed; else ""
    moved_mm    how far it has moved, across its direction; 0 where it has not

    >>> import hlr
    >>> before, after = (hlr.draw("part.step", view=view, scale=1) for view in ("top", "front"))
    >>> {each.side for each in hlr.compare.compare(before, after).differences}
    {'before', 'after'}
    """

    kind: Verdict
    place: tuple[float, float]
    length_mm: float
    line_class: str
    visible: bool
    part: str | None
    edge: int | None
    side: Literal["before", "after"]
    became: str = ""
    moved_mm: float = 0.0

    def as_dict(self) -> dict[str, Any]:
        """The fields, for JSON."""
        return asdict(self) | {"place": list(self.place)}


def told(length: float) -> str:
    """Millimetres for people: three digits, and no more than three decimals."""
    rounded = round(length, 3) if abs(length) < 10.0 else round(length, 1)
    return f"{rounded + 0.0:.10g}"
