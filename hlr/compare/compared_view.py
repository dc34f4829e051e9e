"""What a comparison of two pages says of one view."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import Any


@dataclass(frozen=True, slots=True)
class ComparedView:
    """A view of two pages.

    name       as its page calls it; "at (65, 165)", from the lower left corner of the page, where neither does
    before     whether the first page has it
    after      whether the second page has it
    shift      (x, y) mm by which that of the second page was moved before it was compared; None: it was not
    displaced  whether that is more than what the other views were moved by
    same_mm    length that is the same in both, millimetres on paper
    mm         millimetres of each kind of difference

    >>> import hlr
    >>> page = hlr.draw_pages("housing.FCStd")[0]
    >>> found = hlr.compare.compare(page, page)
    >>> len(found.views), found.views[0].name, found.views[0].displaced
    (7, 'ProjItem', False)
    """

    name: str
    before: bool
    after: bool
    shift: tuple[float, float] | None
    displaced: bool
    same_mm: float
    mm: dict[str, float]

    def as_dict(self) -> dict[str, Any]:
        """The fields, for JSON."""
        return asdict(self) | {"shift": None if self.shift is None else list(self.shift)}
