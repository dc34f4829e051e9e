"""What is drawn of views: one drawing of each, or one for each of its sections, which have names and letters.

The first section of a view is called as the view is; each further one has its letter behind that: front, front-B. So a
section that is added gives no other drawing a new name. Where the view is drawn whole as well, that name is its own,
and each of its sections has its letter: front, front-A.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from hlr.request.directions import directed
from hlr.request.options import SectionPlace, View
from hlr.request.section import by_view

LETTERS = "ABCDEFGHJKLMNPRSTUVWXYZ"
"""Of sections, in their order; I, O and Q look like figures."""


@dataclass(frozen=True, slots=True)
class ShownView:
    """A view as it is drawn.

    name    of the drawing, unlike that of any other section of the view
    place   where it is cut; None: it is not
    number  of the section, in the order in which they are asked for; -1: it is none
    which   of what is drawn of the view it is; others: how many there are besides
    """

    view: View
    name: str
    place: SectionPlace | None = None
    number: int = -1
    which: int = 0
    others: int = 0

    @property
    def is_further(self) -> bool:
        """Whether the view itself, or another section of it, comes before it."""
        return self.which > 0

    @property
    def letter(self) -> str:
        """A for A-A; empty: it is not cut."""
        return letter_of(self.number) if self.place is not None else ""


def letter_of(number: int) -> str:
    """The letter of a section: A to Z, then A2 and so on."""
    turn, which = divmod(number, len(LETTERS))
    return LETTERS[which] + (str(turn + 1) if turn else "")


def shown_views(views: Sequence[View], section: Any, whole: Any = ()) -> list[ShownView]:
    """What is drawn of these views, in their order. views, section, whole: checked."""
    places = by_view(section)
    shown = []
    for k, view in enumerate(views):
        name = directed(view)[0]
        own: list[tuple[int, SectionPlace | None]] = []
        if places is not None:
            own = [(number, place) for number, (named, place) in enumerate(places) if named == name]
        elif section is not None:
            own = [(k, section)]
        if name in whole or not own:
            own.insert(0, (-1, None))
        for which, (number, place) in enumerate(own):
            called = f"{name}-{letter_of(number)}" if which else name
            shown.append(ShownView(view, called, place, number, which, len(own) - 1))
    return shown
