"""Sections: which views of a drawing are cut, and where. Planes lie across the direction of their view.

A section is said by a place: True for the middle of the model; a number for the coordinate at which a view along an
axis is cut, x for left and right, y for front and back, z for top and bottom; or a point on the plane. A plane may
step: (12.5, (30, 40)) lies at 12.5, and from 30 on at 40. It steps along the axis that runs across the view: x for
front, back, top and bottom, y for left and right. Lengths are millimetres in the world (z up), as those of an eye. One
place is for all views; a mapping says a place for each of the views that it names, and the others are not cut. Pairs of
a view and a place may name a view several times: it is drawn once for each (`hlr.request.shown_views`). A view may be
drawn whole besides its sections.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from itertools import pairwise
from typing import Any, TypeGuard, cast

from hlr.common.numbers import is_finite
from hlr.errors import OptionError, ViewError
from hlr.request.directions import NAMED, directed, pictorial
from hlr.request.options import SectionPlace, Steps, Vector, View, ViewName
from hlr.tables.entry import listed

FARTHEST = 1e12
"""Millimetres: of a plane, in any coordinate."""

_PAIR = 2
"""A view and a place."""


ByView = tuple[tuple[str, SectionPlace], ...]
"""Names of views and where they are cut, in the order in which that was asked for."""


def checked_section(section: Any) -> SectionPlace | dict[str, SectionPlace] | ByView | None:
    """What was asked for in its one form: None, a place, or places by the names of views.

    The latter are pairs where a view is cut several times, else a dictionary. Raises OptionError that says what is
    allowed.
    """
    given = list(section.items()) if isinstance(section, Mapping) else _pairs(section)
    if given is None:
        return _place(section)
    places = ((_name(view), _place(place)) for view, place in given)
    found = [(view, place) for view, place in places if place is not None]
    # True and 1.0 are equal.
    keys = [(view, place is True, place) for view, place in found]
    if twice := next((key for key in keys if keys.count(key) > 1), None):
        view, _, place = twice
        raise OptionError(f"`section` {view}{_told(place)} is asked for twice: give each plane once")
    names = [view for view, _ in found]
    return (dict(found) or None) if len(set(names)) == len(names) else tuple(found)


def checked_whole(whole: Any) -> tuple[ViewName, ...]:
    """The names of views that are drawn whole besides their sections; a single name is one.

    Raises OptionError for what is no list of views.
    """
    given = (whole,) if isinstance(whole, str) else whole
    if not isinstance(given, Sequence):
        raise OptionError(f'whole needs a list of views, such as ["left"], not {whole!r}')
    return cast("tuple[ViewName, ...]", tuple(dict.fromkeys(_name(view, "whole") for view in given)))


def by_view(section: Any) -> ByView | None:
    """Where views are cut, by their names; None: nothing is cut, or one place is for all views. section: checked."""
    if isinstance(section, Mapping):
        return tuple(section.items())
    return section if isinstance(section, tuple) and isinstance(section[0], tuple) else None


def check_sections(section: Any, views: Sequence[View], whole: Any = (), *, by_name: bool = False) -> None:
    """Raise OptionError where a section does not fit the views. section, views, whole: checked.

    by_name: views on one page, of which some are cut
    """
    if section is None:
        return
    names = [directed(view)[0] for view in views]
    if (places := by_view(section)) is not None:
        if unknown := [name for name, _ in places if name not in names]:
            raise OptionError(f"section {unknown[0]} is none of the views, {listed(names, 'and')}: add it to them")
    elif by_name:
        raise OptionError('a page of several views has sections by name: give {"front": True}, not one for all')
    cut = names if places is None else [name for name, _ in places]
    if spare := [name for name in whole if name not in cut]:
        raise OptionError(
            f"`whole` {spare[0]} is none of the sections, {listed(dict.fromkeys(cut), 'and')}: leave it out"
        )
    directions = {name: directed(view)[1] for view, name in zip(views, names, strict=True)}
    for name, place in places if places is not None else [(name, section) for name in names]:
        if isinstance(place, bool) or not pictorial(directions[name]):
            continue
        if is_stepped(place):
            raise OptionError(f"section {name}: planes step in views along an axis alone, such as front")
        if not isinstance(place, tuple):
            raise OptionError(
                f"section {name} at {place:g}: the view looks along no axis, so give a point on its plane, such as "
                "0,0,0"
            )


def with_sections(views: Sequence[View], places: ByView) -> tuple[View, ...]:
    """The views, and after them those that are cut and are not among them."""
    names = [directed(view)[0] for view in views]
    more = dict.fromkeys(name for name, _ in places if name not in names)
    return (*views, *(cast(View, _vector(name) if "," in name else name) for name in more))


def is_stepped(place: Any) -> TypeGuard[Steps]:
    """Whether a plane steps. place: checked."""
    return isinstance(place, tuple) and isinstance(place[1], tuple)


def axis_of(direction: Vector) -> int | None:
    """The axis that a direction lies along: 0, 1 or 2; None: it lies along none."""
    return None if pictorial(direction) else max(range(3), key=lambda k: abs(direction[k]))


def _pairs(section: Any) -> list[tuple[Any, Any]] | None:
    """Pairs of a view and a place; None: these are none. Raises OptionError where others are among them."""
    given = list(section) if isinstance(section, list | tuple) else []
    # A step is a pair of numbers.
    if not any(isinstance(each, list | tuple) and each and isinstance(each[0], str | list | tuple) for each in given):
        return None
    if others := [each for each in given if not isinstance(each, list | tuple) or len(each) != _PAIR]:
        raise OptionError(f'section needs pairs of a view and its place, such as ("left", 12.5), not {others[0]!r}')
    return [(view, place) for view, place in given]


def _told(place: SectionPlace) -> str:
    """A place as the command line has it."""
    if place is True:
        return ""
    if is_stepped(place):
        first, *steps = place
        return f"@{first:g}," + ",".join(f"{a:g}:{b:g}" for a, b in cast("list[tuple[float, float]]", steps))
    return "@" + ",".join(f"{c:g}" for c in (place if isinstance(place, tuple) else (place,)))


def _name(view: Any, option: str = "section") -> str:
    """The name of a view. option: what names it, in messages."""
    try:
        named = isinstance(view, str) and "," not in view
        return directed(cast(View, view.strip().lower() if named else _vector(view)))[0]
    except (ViewError, TypeError, ValueError) as error:
        why = str(error).rstrip(".") if isinstance(error, ViewError) else f"{view!r} is no view"
        raise OptionError(f"`{option}`: {why}") from None


def _vector(view: Any) -> tuple[float, ...]:
    return tuple(float(c) for c in (view.split(",") if isinstance(view, str) else view))


def _place(place: Any) -> SectionPlace | None:
    if place is None or place is False:
        return None
    if place is True:
        return True
    with suppress(TypeError):
        return _coordinate(place)
    with suppress(TypeError, ValueError):
        x, y, z = map(_coordinate, () if isinstance(place, str | bytes) else place)
        return x, y, z
    with suppress(TypeError, ValueError):
        first, *steps = [] if isinstance(place, str | bytes) else list(place)
        return _stepped(_coordinate(first), [(_coordinate(a), _coordinate(b)) for a, b in steps])
    named = isinstance(place, str) and place.strip().lower() in NAMED
    which = f"; {{{place!r}: True}} says that this view is cut" if named else ""
    raise OptionError(
        "section needs True for the middle of the model, a coordinate such as 12.5, a point on its plane such as "
        f"(0, 12.5, 0), or steps such as (12.5, (30, 40)), in millimetres, not {place!r}{which}"
    )


def _stepped(first: float, steps: list[tuple[float, float]]) -> SectionPlace:
    """A plane that steps. Raises OptionError where the steps are not in order, or do not step."""
    if not steps:
        raise TypeError
    begins, places = [begin for begin, _ in steps], [first, *(place for _, place in steps)]
    for a, b in pairwise(begins):
        if not a < b:
            raise OptionError(f"section steps from {a:g} on, then from {b:g} on: give its steps in ascending order")
    for begin, (a, b) in zip(begins, pairwise(places), strict=True):
        if a == b:
            raise OptionError(f"section steps from {a:g} to {b:g} at {begin:g}: leave this step out")
    return (first, *steps)


def _coordinate(value: Any) -> float:
    """Raises TypeError unless it is a number of a size that a model may have."""
    if not is_finite(value) or abs(value) > FARTHEST:
        raise TypeError
    return float(value)
